//! `cargo xtask arrows` and `cargo xtask order`: the imports of a crate's modules on the terminal.

use std::collections::BTreeSet;
use std::path::Path;
use xtask::modules::arrows::{Graph, Pair};
use xtask::modules::order::{circles, few_upward, upward};
use xtask::modules::rules;
use xtask::ratchet;

/// Prints the forbidden imports of a crate, each with its place.
pub(crate) fn print_forbidden(root: &Path, name: &str) -> Result<(), String> {
    let (graph, orders) = (graph(root, name)?, ratchet::orders(root)?);
    let violations = rules::violations(&graph, &orders);
    for violation in &violations {
        println!("{}", violation.key);
        violation.places.iter().for_each(|place| println!("    {place}"));
    }
    println!("{} arrows are forbidden", violations.len());
    Ok(())
}

/// Prints the order of a crate's rooms with the fewest upward arrows that a search finds, its
/// circles, and those arrows with their places.
pub(crate) fn print_order(root: &Path, name: &str) -> Result<(), String> {
    let graph = graph(root, name)?;
    let pairs = graph.between_rooms();
    let edges: BTreeSet<Pair> = pairs.keys().cloned().collect();
    let rooms: BTreeSet<String> = graph.rooms().map(str::to_owned).collect();
    let order = few_upward(&rooms, &edges);
    println!("{name} = [");
    order.iter().for_each(|room| println!("    \"{room}\","));
    println!("]");
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

fn graph(root: &Path, name: &str) -> Result<Graph, String> {
    let graphs = ratchet::graphs(root)?;
    let names: Vec<String> = graphs.iter().map(|graph| graph.tree.crate_name.clone()).collect();
    let found = graphs.into_iter().find(|graph| graph.tree.crate_name == name);
    found.ok_or_else(|| format!("no crate {name}; there are {}", names.join(", ")))
}
