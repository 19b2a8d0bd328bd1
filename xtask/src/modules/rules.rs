//! The two rules of the import graph: no edge against the order of the rooms, and no circle inside
//! a folder.

use super::arrows::{Graph, Import, Pair, Pairs};
use super::order::{circles, upward};
use std::collections::{BTreeMap, BTreeSet};

/// The rooms of each crate, by the crate's name, the ground floor first.
pub type Orders = BTreeMap<String, Vec<String>>;

/// Imports that a rule forbids.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Violation {
    /// The same for all of them wherever they stand: crate, modules, rule.
    pub key: String,
    /// Where each of them is.
    pub places: Vec<String>,
}

/// What is wrong between the modules of a crate.
#[must_use]
pub fn violations(graph: &Graph, orders: &Orders) -> Vec<Violation> {
    let mut found = between_rooms(graph, orders);
    for (parent, module) in graph.tree.modules.iter().enumerate().skip(1) {
        let pairs = graph.between_children(parent);
        let folder = format!("{}: in {}", graph.tree.crate_name, module.name());
        found.extend(in_circles(&pairs, &folder));
    }
    found
}

/// Rooms that the table lacks, those that it has beside, and upward edges.
fn between_rooms(graph: &Graph, orders: &Orders) -> Vec<Violation> {
    let name = &graph.tree.crate_name;
    let rooms: BTreeSet<&str> = graph.rooms().collect();
    let empty = Vec::new();
    let order = orders.get(name).unwrap_or(&empty);
    let told = |text: String| Violation { key: text, places: Vec::new() };
    let listed: BTreeSet<&str> = order.iter().map(String::as_str).collect();
    let mut found: Vec<Violation> = Vec::new();
    if rooms.len() < 2 && order.is_empty() {
        return found;
    }
    for room in rooms.difference(&listed) {
        found.push(told(format!("{name}: the room {room} has no place in the order")));
    }
    for room in listed.difference(&rooms) {
        found.push(told(format!("{name}: the order names {room}, which is not there")));
    }
    let pairs = graph.between_rooms();
    let edges: BTreeSet<Pair> = pairs.keys().cloned().collect();
    let root = graph.tree.modules[0].name();
    for pair in upward(order, &edges) {
        // The root may use every room.
        if pair.from != root {
            found.push(forbidden(name, pair, &pairs, "upward"));
        }
    }
    found
}

fn in_circles(pairs: &Pairs<'_>, folder: &str) -> Vec<Violation> {
    let edges: BTreeSet<Pair> = pairs.keys().cloned().collect();
    let circles = circles(&edges);
    let is_inside = |pair: &&Pair| {
        circles.iter().any(|circle| circle.contains(&pair.from) && circle.contains(&pair.to))
    };
    edges.iter().filter(is_inside).map(|pair| forbidden(folder, pair, pairs, "circle")).collect()
}

fn forbidden(start: &str, pair: &Pair, pairs: &Pairs<'_>, rule: &str) -> Violation {
    let key = format!("{start}: {} -> {} ({rule})", pair.from, pair.to);
    Violation { key, places: places(&pairs[pair]) }
}

/// Where imports are, without those that only repeat a name that a `use` brought in.
#[must_use]
pub fn places(imports: &[&Import]) -> Vec<String> {
    let is_whole = |import: &&&Import| {
        ["crate::", "super::", "self::"].iter().any(|start| import.path.starts_with(start))
    };
    let place = |import: &&Import| format!("{}:{}: {}", import.file, import.line, import.path);
    let whole: Vec<String> = imports.iter().filter(is_whole).map(place).collect();
    if whole.is_empty() { imports.iter().map(place).collect() } else { whole }
}

/// Parses the table of orders: for each crate a list of rooms.
///
/// # Errors
/// When it is not a table of lists of names.
pub fn parse_orders(text: &str) -> Result<Orders, String> {
    toml::from_str(text).map_err(|error| format!("the table of orders: {error}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modules::targets::Target;

    const ORDER: &str = "light = ['ground', 'middle', 'top']";

    /// Keys of the violations in a crate of the given files, which gets rooms that are not there.
    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let root = "mod ground;\nmod middle;\nmod top;\npub use ground::Stone;\nstruct Root;";
        let filled = [("lib.rs", root), ("ground.rs", ""), ("middle.rs", ""), ("top.rs", "")];
        let read = |path: &str| {
            let own = files.iter().find(|(name, _)| path == *name);
            let folder = path.replace(".rs", "/mod.rs");
            let is_folder = files.iter().any(|(name, _)| folder == *name);
            let default = filled.iter().find(|(name, _)| path == *name && !is_folder);
            own.or(default).map(|(_, text)| (*text).to_owned())
        };
        let target = Target { name: "light".to_owned(), root: "lib.rs".to_owned() };
        let read = |path: &str| read(path.trim_start_matches('/'));
        let graph = Graph::read(&target, &read).unwrap();
        let violations = violations(&graph, &parse_orders(ORDER).unwrap());
        violations.into_iter().map(|violation| violation.key).collect()
    }

    const UP: &str = "light: ground -> top (upward)";

    #[test]
    fn imports_along_the_order_and_those_of_tests_are_allowed() {
        let top = "use crate::ground::Stone;\nuse crate::middle;\nfn g() { middle::f(); }";
        let middle = "use super::ground::Stone;\nfn f() {}";
        assert_eq!(found(&[("top.rs", top), ("middle.rs", middle)]), [""; 0]);
        assert_eq!(
            found(&[(
                "ground.rs",
                "#[cfg(test)]\nmod tests { use crate::top::Roof; }\npub struct Stone;\n\
                 impl Stone { #[cfg(test)] fn f() { crate::top::f(); } }\n\
                 // crate::top::f()\nconst WORDS: &str = \"see crate::top::f\";"
            )]),
            [""; 0]
        );
    }

    #[test]
    fn upward_arrows_are_rejected_wherever_they_hide() {
        for text in [
            "use crate::top::Roof;",
            "use super::top::Roof;",
            "use crate::{middle, top::{Roof, self}};",
            "use crate::top as other;",
            "pub(crate) use crate::top::*;",
            "fn f() { crate::top::g(); }",
            "fn f() { use crate::top; top::g(); }",
            "fn f(x: super::top::Roof) {}",
            "fn f<T: super::top::Roof>() {}",
            "mod inner { fn f() { super::super::top::g(); } }",
            "impl crate::top::Roof for Stone {}",
            "fn f() { let x = vec![crate::top::g()]; }",
            "fn f() { println!(\"{}\", super::top::g()); }",
            "macro_rules! m { () => { $crate::top::g() }; }",
            "#[serde(with = \"crate::top\")] struct A;",
        ] {
            let found = found(&[("ground.rs", text)]);
            let others = "light: ground -> middle (upward)";
            assert!(found.iter().any(|key| key == UP), "{text}: {found:?}");
            assert!(found.iter().all(|key| key == UP || key == others), "{text}: {found:?}");
        }
    }

    #[test]
    fn reexports_are_followed_to_the_module_that_defines() {
        let root = "mod ground;\nmod middle;\nmod top;\npub use top::{Roof, roof as other};";
        for text in ["use crate::Roof;", "fn f() { super::other(); }", "use crate::{Roof as R};"] {
            let files =
                [("lib.rs", root), ("ground.rs", text), ("top.rs", "struct Roof; fn roof() {}")];
            assert_eq!(found(&files), [UP], "{text}");
        }
        // The folder `top` shows what its child defines, and `middle` shows what `top` does.
        let files = [
            ("top/mod.rs", "mod roof;\npub use roof::*;"),
            ("top/roof.rs", "pub struct Roof;"),
            ("middle.rs", "pub use crate::top::Roof;"),
            ("ground.rs", "use crate::middle::Roof;"),
        ];
        assert_eq!(found(&files), [UP, "light: middle -> top (upward)"]);
        // What a glob brings in belongs to who defines it.
        let files = [
            ("lib.rs", "mod ground;\nmod middle;\nmod top;\nuse top::*;"),
            ("top.rs", "pub struct Roof;"),
            ("ground.rs", "use super::*;\nfn f(x: Roof) {}"),
        ];
        assert!(found(&files).contains(&UP.to_owned()));
    }

    #[test]
    fn nobody_uses_the_items_of_the_root() {
        assert_eq!(found(&[("top.rs", "use crate::Root;")]), ["light: top -> lib (upward)"]);
    }

    #[test]
    fn a_circle_inside_a_folder_is_rejected() {
        let folder = ("middle/mod.rs", "mod a;\nmod b;\npub use b::B;\nstruct Head;");
        let a = ("middle/a.rs", "pub struct A;\nuse super::B;\nuse super::Head;");
        let straight = ("middle/b.rs", "pub struct B;");
        assert_eq!(found(&[folder, a, straight]), [""; 0]);
        let back = ("middle/b.rs", "pub struct B;\nfn f() { crate::middle::a::g(); }");
        let keys = ["light: in middle: a -> b (circle)", "light: in middle: b -> a (circle)"];
        assert_eq!(found(&[folder, a, back]), keys);
    }

    #[test]
    fn a_circle_of_rooms_has_an_arrow_against_any_order() {
        let files = [("middle.rs", "use crate::top;"), ("top.rs", "use crate::middle;")];
        assert_eq!(found(&files), ["light: middle -> top (upward)"]);
    }

    #[test]
    fn the_order_names_all_rooms_and_no_others() {
        let root = "mod ground;\nmod middle;\nmod cellar;";
        let found = found(&[("lib.rs", root), ("cellar.rs", "")]);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].contains("cellar has no place"), "{found:?}");
        assert!(found[1].contains("names top"), "{found:?}");
    }
}
