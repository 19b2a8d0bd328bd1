//! `cargo xtask arrows` and `cargo xtask order`: the imports of a crate's modules on the terminal.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use xtask::modules::arrows::{Graph, Pair};
use xtask::modules::order::{circles, few_upward, upward};
use xtask::modules::rules;
use xtask::ratchet;
use xtask::workspace::Failure;

/// Prints the forbidden imports of a crate, each with its place.
pub(crate) fn print_forbidden(root: &Path, name: &str) -> Result<(), Failure> {
    let (graph, orders) = (graph(root, name)?, ratchet::orders(root)?);
    let violations = rules::violations(&graph, &orders);
    for violation in &violations {
        println!("{}", violation.key);
        violation.places.iter().for_each(|place| println!("    {place}"));
    }
    println!("{} arrows are forbidden", violations.len());
    Ok(())
}

/// Prints an order of a crate's rooms with few upward arrows, its circles, and those arrows with
/// their places.
pub(crate) fn print_order(root: &Path, name: &str) -> Result<(), Failure> {
    let graph = graph(root, name)?;
    let pairs = graph.between_rooms();
    let edges: BTreeSet<Pair> = pairs.keys().cloned().collect();
    let order = best_order(&graph, &edges);
    print!("{}", section(name, &order));
    for circle in circles(&edges) {
        println!("a circle of {}: {}", circle.len(), circle.join(", "));
    }
    let main = graph.tree.modules[0].name();
    for pair in upward(&order, &edges).into_iter().filter(|pair| pair.from != main) {
        println!("{} -> {}", pair.from, pair.to);
        rules::places(&pairs[pair]).iter().for_each(|place| println!("    {place}"));
    }
    Ok(())
}

/// Puts that order into `xtask/order.toml`.
pub(crate) fn write_order(root: &Path, name: &str) -> Result<(), Failure> {
    let graph = graph(root, name)?;
    let edges: BTreeSet<Pair> = graph.between_rooms().into_keys().collect();
    let new = section(name, &best_order(&graph, &edges));
    let path = root.join("xtask/order.toml");
    let told = |error: std::io::Error| format!("{}: {error}", path.display());
    let text = fs::read_to_string(&path).map_err(told)?;
    let head = section(name, &[]);
    let start = text.find(head.trim_end_matches("]\n"));
    let text = match start {
        Some(start) => {
            let end = text[start..].find("]\n").map_or(text.len(), |end| start + end + 2);
            format!("{}{new}{}", &text[..start], &text[end..])
        }
        None => format!("{text}\n{new}"),
    };
    fs::write(&path, text).map_err(told)
}

fn best_order(graph: &Graph, edges: &BTreeSet<Pair>) -> Vec<String> {
    few_upward(&graph.rooms().map(str::to_owned).collect(), edges)
}

/// A crate's section in the table of orders.
fn section(name: &str, order: &[String]) -> String {
    let key = if name.contains('/') { format!("\"{name}\"") } else { name.to_owned() };
    let rooms: String = order.iter().map(|room| format!("    \"{room}\",\n")).collect();
    format!("{key} = [\n{rooms}]\n")
}

fn graph(root: &Path, name: &str) -> Result<Graph, Failure> {
    let graphs = ratchet::graphs(root)?;
    let names: Vec<String> = graphs.iter().map(|graph| graph.tree.crate_name.clone()).collect();
    let found = graphs.into_iter().find(|graph| graph.tree.crate_name == name);
    found.ok_or_else(|| format!("no crate {name}; there are {}", names.join(", ")))
}
