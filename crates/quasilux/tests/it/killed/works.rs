//! Work that leaves something on disk: the commands of each kind, in a folder of their own.

use crate::scenes::{Look, remove_probes, write_room};
use crate::support::{Folder, parsed, without_seconds_and_threads};
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, SystemTime};

/// Where what cannot be written elsewhere is rescued.
pub(super) const RESCUE: &str = "rescue";

/// One command, and how it goes on after it was cut short.
pub(super) struct Step {
    pub(super) begin: Vec<&'static str>,
    /// Where it keeps itself; one that does not is begun again.
    pub(super) kept: Option<&'static str>,
    pub(super) code: i32,
}

/// Commands, one after another.
pub(super) struct Work {
    pub(super) folder: Folder,
    pub(super) steps: Vec<Step>,
    /// What is there before the first.
    inputs: BTreeSet<String>,
}

/// All kinds, the folders of `name`.
pub(super) fn all(name: &str) -> Vec<Work> {
    let folder = |kind: &str| Folder::new(&format!("{name}_{kind}"));
    let estimator = |estimator, samples| {
        let folder = folder(estimator);
        write_room(&folder, "room", &Look::GREY);
        if estimator == "photon" {
            remove_probes(&folder, "room");
        }
        Work::new(folder, vec![run(estimator, samples)])
    };
    let [annual, shared] = ["annual", "shared"].map(|kind| write_year(&format!("{name}_{kind}")));
    let pictures = folder("pictures");
    write_scene_with_camera(&pictures);
    let spread = folder("spread");
    write_scene_with_camera(&spread);
    let drawings = crate::annual_kept::folder(&format!("{name}_drawings"));
    write_room(&drawings, "lamp", &Look::GREY);
    vec![
        estimator("bidirectional", "96"),
        Work::new(annual, vec![year("annual.year", None)]),
        Work::new(spread, spread_run()),
        Work::new(pictures, vec![run("auto", "24")]),
        Work::new(drawings, drawn()),
        estimator("path", "512"),
        Work::new(shared, shared_year()),
        estimator("photon", "16384"),
    ]
}

fn run(estimator: &'static str, samples: &'static str) -> Step {
    let begin = ["run", "room.toml", "--out", "out", "--quiet", "--rel-tol", "1e-9"];
    let settings = ["--estimator", estimator, "--samples", samples];
    let keeping = ["--checkpoint", "run.ck", "--checkpoint-every", "0.02s"];
    let begin = [&begin[..], &settings, &keeping].concat();
    Step { begin, kept: Some("run.ck"), code: 3 }
}

/// A year, or a part of one, which has no results of its own.
fn year(kept: &'static str, shard: Option<&'static str>) -> Step {
    let year = ["annual", "a.toml", "--samples", "2", "--rel-tol", "0.1%", "--quiet"];
    let (more, code) = match shard {
        Some(shard) => (["--shard", shard], 0),
        None => (["--out", "out"], 3),
    };
    let begin = [&year[..], &["--checkpoint", kept], &more].concat();
    Step { begin, kept: Some(kept), code }
}

fn step(begin: &[&'static str], code: i32) -> Step {
    Step { begin: begin.to_vec(), kept: None, code }
}

fn shared_year() -> Vec<Step> {
    let merge = ["merge", "b.year", "a.year", "--out", "out", "--quiet"];
    vec![year("a.year", Some("0/2")), year("b.year", Some("1/2")), step(&merge, 3)]
}

fn spread_run() -> Vec<Step> {
    let shard = ["shard", "room.toml", "--plan", "plan.json", "--quiet", "--shard"];
    vec![
        step(&["plan", "room.toml", "--samples", "8", "--out", "plan.json"], 0),
        step(&[&shard[..], &["0/2", "--out", "a.part"]].concat(), 0),
        step(&[&shard[..], &["1/2", "--out", "b.part"]].concat(), 0),
        step(&["merge", "b.part", "a.part", "--out", "out", "--quiet"], 3),
    ]
}

/// Commands that write a file or some.
fn drawn() -> Vec<Step> {
    let sky = ["sky", "--weather", "site.wea", "--time", "2026-03-20T12:30", "--svg", "sky.svg"];
    vec![
        step(&["check", "a.toml", "--out", "out", "--quiet"], 0),
        step(&[&sky[..], &["--png", "sky.png"]].concat(), 0),
        step(&["photometry", "lamp.ies", "--svg", "lamp.svg"], 0),
        step(&["photometry", "lamp.ies", "--convert", "lamp.ldt"], 0),
        step(&["points", "sobol", "-n", "2^12", "--csv", "points.csv", "--svg", "points.svg"], 0),
    ]
}

/// With points of more than one block, and hours of half a day.
fn write_year(name: &str) -> Folder {
    let folder = crate::annual_kept::folder(name);
    let project = folder.read("a.toml").replace("[10, 9]", "[10, 5]").replace("[10, 6]", "[5, 4]");
    folder.write("a.toml", project);
    let weather = folder.read("site.wea");
    let is_needed = |row: &&str| !row.starts_with("3 20") || row.starts_with("3 20 1");
    let fewer: Vec<&str> = weather.lines().filter(is_needed).collect();
    folder.write("site.wea", fewer.join("\n") + "\n");
    folder
}

fn write_scene_with_camera(folder: &Folder) {
    write_room(folder, "room", &Look::GREY);
    let camera = "[[cameras]]\nname = \"view\"\nposition = [0.3, 0.3, 1]\n\
        target = [1.5, 1.5, 1]\nvertical_fov_deg = 60\nresolution = [3, 2]\n[simulation]";
    let project = folder.read("room.toml").replace("[simulation]", camera);
    folder.write("room.toml", project.replace("replicates = 8", "replicates = 4"));
}

impl Work {
    fn new(folder: Folder, steps: Vec<Step>) -> Self {
        let inputs = names(&folder.path(""));
        Self { folder, steps, inputs }
    }

    /// Nothing has been done yet.
    pub(super) fn clear(&self) {
        for name in names(&self.folder.path("")).difference(&self.inputs) {
            let path = self.folder.path(name);
            let removed =
                if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
            removed.expect("what was made can go");
        }
        fs::create_dir(self.folder.path(RESCUE)).expect("folders can be made");
    }

    /// Everything that was made, but for seconds and threads and what steps keep of themselves.
    pub(super) fn products(&self) -> BTreeMap<String, Vec<u8>> {
        let mut products = BTreeMap::new();
        for name in names(&self.folder.path("")).difference(&self.inputs) {
            let is_kept = |step: &Step| step.kept.is_some_and(|kept| name.starts_with(kept));
            if *name == RESCUE || self.steps.iter().any(is_kept) {
                continue;
            }
            if !self.folder.path(name).is_dir() {
                products.insert(name.clone(), self.product(name));
                continue;
            }
            for file in names(&self.folder.path(name)) {
                let path = format!("{name}/{file}");
                products.insert(path.clone(), self.product(&path));
            }
        }
        products
    }

    fn product(&self, path: &str) -> Vec<u8> {
        if path.ends_with("/result.json") {
            return without_seconds_and_threads(&self.folder.read(path)).into_bytes();
        }
        if path.ends_with("/annual.json") {
            let mut document = parsed(&self.folder.read(path));
            document["run"]["seconds"] = 0.into();
            document["run"]["threads"] = 0.into();
            return document.to_string().into_bytes();
        }
        fs::read(self.folder.path(path)).expect("it was listed")
    }

    /// All files are of another time, as if the clock had jumped since.
    pub(super) fn date(&self, years_after_1970: u64) {
        let time = SystemTime::UNIX_EPOCH + Duration::from_hours(8766 * years_after_1970);
        date(&self.folder.path(""), time);
    }
}

fn date(folder: &Path, time: SystemTime) {
    for name in names(folder) {
        let path = folder.join(name);
        if path.is_dir() {
            date(&path, time);
        }
        let dated = File::open(path).and_then(|file| file.set_modified(time));
        dated.expect("files of one's own can be dated");
    }
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let name = |entry: fs::DirEntry| entry.file_name().into_string().expect("a plain name");
    entries.map(|entry| name(entry.expect("an entry"))).collect()
}
