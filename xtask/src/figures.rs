//! `cargo xtask figures`: the size of each crate and of its module graph, to compare two states of
//! the workspace.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::Path;
use xtask::modules::arrows::{Graph, Pair};
use xtask::modules::order::{circles, few_upward, upward};
use xtask::modules::targets;
use xtask::ratchet;
use xtask::style::files::{self, TextFile};
use xtask::style::functions::{self, Function, MAX_LINES};
use xtask::style::shipped::LineCounts;
use xtask::workspace::Failure;

const HEAD: &str = "\
| crate | files | lines | outside tests | code | rooms | arrows | upward | circles | functions \
over 55 lines | longest | tuples |
|---|---|---|---|---|---|---|---|---|---|---|---|
";

/// The figures of one package: all its libraries and binaries together.
#[derive(Default)]
struct Figures {
    files: usize,
    lines: LineCounts,
    rooms: usize,
    arrows: usize,
    upward: usize,
    circles: Vec<usize>,
    functions: Vec<Function>,
}

/// Prints a table with a row for each package of the workspace at `root`, and its long functions.
///
/// Arrows are pairs of rooms, the root's own left out; upward are those against the order that has
/// the fewest that `cargo xtask order` finds. Test files outside `src` are not counted.
pub(crate) fn print(root: &Path) -> Result<(), Failure> {
    let files = files::of_workspace(root, &[".rs"])?;
    let graphs = ratchet::graphs(root)?;
    let mut table = HEAD.to_owned();
    let mut long = String::new();
    for folder in targets::members(root)? {
        let figures = Figures::new(&folder, &files, &graphs)?;
        let name = folder.rsplit('/').next().unwrap_or(&folder);
        table += &figures.row(name);
        let mut over: Vec<&Function> = figures.long_functions().collect();
        over.sort_by_key(|function| std::cmp::Reverse(function.lines));
        for Function { lines, name, file, .. } in over {
            let _ = writeln!(long, "- {lines} {name} {file}");
        }
    }
    println!("{table}\n## Functions over {MAX_LINES} lines\n{long}");
    Ok(())
}

impl Figures {
    fn new(folder: &str, files: &[TextFile], graphs: &[Graph]) -> Result<Self, Failure> {
        let mut figures = Self::default();
        let source = format!("{folder}/src/");
        let is_own = |graph: &&Graph| graph.tree.modules[0].file.starts_with(&source);
        let graphs: Vec<&Graph> = graphs.iter().filter(is_own).collect();
        let modules = || graphs.iter().flat_map(|graph| &graph.tree.modules);
        let shipped: BTreeSet<&str> = modules().map(|module| module.file.as_str()).collect();
        for file in files.iter().filter(|file| file.path.starts_with(&source)) {
            figures.files += 1;
            figures.lines.add(if shipped.contains(file.path.as_str()) {
                LineCounts::new(&file.text).map_err(|error| format!("{}: {error}", file.path))?
            } else {
                LineCounts::of_test_file(&file.text)
            });
        }
        graphs.iter().for_each(|graph| figures.add_graph(graph));
        Ok(figures)
    }

    fn add_graph(&mut self, graph: &Graph) {
        let rooms: BTreeSet<String> = graph.rooms().map(str::to_owned).collect();
        let root = graph.tree.modules[0].name();
        let mut edges: BTreeSet<Pair> = graph.between_rooms().into_keys().collect();
        edges.retain(|pair| pair.from != root);
        self.rooms += rooms.len();
        self.arrows += edges.len();
        self.upward += upward(&few_upward(&rooms, &edges), &edges).len();
        self.circles.extend(circles(&edges).iter().map(Vec::len));
        self.functions.extend(functions::of_crate(&graph.tree));
    }

    fn long_functions(&self) -> impl Iterator<Item = &Function> {
        self.functions.iter().filter(|function| function.lines > MAX_LINES)
    }

    fn row(&self, name: &str) -> String {
        let LineCounts { all, shipped, code } = self.lines;
        let (rooms, arrows, upward) = (self.rooms, self.arrows, self.upward);
        let circles: Vec<String> = self.circles.iter().map(usize::to_string).collect();
        let circles = if circles.is_empty() { "none".to_owned() } else { circles.join(", ") };
        let longest = self.functions.iter().max_by_key(|function| function.lines);
        let longest = longest.map_or(String::new(), |f| format!("{} {}", f.lines, f.name));
        let tuples: usize = self.functions.iter().map(|function| function.tuples.len()).sum();
        let (files, long) = (self.files, self.long_functions().count());
        format!(
            "| {name} | {files} | {all} | {shipped} | {code} | {rooms} | {arrows} | {upward} | \
             {circles} | {long} | {longest} | {tuples} |\n"
        )
    }
}
