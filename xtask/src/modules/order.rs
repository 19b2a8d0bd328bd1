//! Circles of a directed graph, and the order of its nodes with few edges against it.

use super::arrows::Pair;
use std::collections::{BTreeMap, BTreeSet};

/// The strongly connected components with more than one node, the largest first (Tarjan 1972).
#[must_use]
pub fn circles(edges: &BTreeSet<Pair>) -> Vec<Vec<String>> {
    let mut search = Search { next: adjacency(edges), ..Search::default() };
    for node in search.next.keys().cloned().collect::<Vec<_>>() {
        if !search.index.contains_key(&node) {
            search.visit(&node);
        }
    }
    search.found.sort_by_key(|circle| std::cmp::Reverse(circle.len()));
    search.found
}

fn adjacency(edges: &BTreeSet<Pair>) -> BTreeMap<String, Vec<String>> {
    let mut next: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for pair in edges {
        next.entry(pair.to.clone()).or_default();
        next.entry(pair.from.clone()).or_default().push(pair.to.clone());
    }
    next
}

#[derive(Default)]
struct Search {
    next: BTreeMap<String, Vec<String>>,
    index: BTreeMap<String, usize>,
    low: BTreeMap<String, usize>,
    stack: Vec<String>,
    found: Vec<Vec<String>>,
}

impl Search {
    fn visit(&mut self, node: &str) {
        let index = self.index.len();
        self.index.insert(node.to_owned(), index);
        self.low.insert(node.to_owned(), index);
        self.stack.push(node.to_owned());
        for next in self.next[node].clone() {
            if !self.index.contains_key(&next) {
                self.visit(&next);
                self.lower(node, self.low[&next]);
            } else if self.stack.contains(&next) {
                self.lower(node, self.index[&next]);
            }
        }
        if self.low[node] == index {
            let start = self.stack.iter().position(|n| n == node).unwrap_or(0);
            let mut circle = self.stack.split_off(start);
            circle.sort();
            if circle.len() > 1 {
                self.found.push(circle);
            }
        }
    }

    fn lower(&mut self, node: &str, to: usize) {
        let low = self.low.entry(node.to_owned()).or_insert(to);
        *low = to.min(*low);
    }
}

/// An order of `nodes`, the most used first, against which few `edges` run: none where there is no
/// circle. Otherwise each node is moved to its best place until none gets better.
#[must_use]
pub fn few_upward(nodes: &BTreeSet<String>, edges: &BTreeSet<Pair>) -> Vec<String> {
    let mut order: Vec<String> = Vec::new();
    let mut left = nodes.clone();
    // A node that uses nothing among those left goes next; where there is none, the one that is
    // used most for each that it uses.
    while !left.is_empty() {
        let count = |node: &String, of_from: bool| {
            let ends =
                edges.iter().map(|e| if of_from { (&e.from, &e.to) } else { (&e.to, &e.from) });
            ends.filter(|(this, other)| *this == node && left.contains(*other)).count()
        };
        let badness = |node: &&String| (count(node, true), usize::MAX - count(node, false));
        let Some(best) = left.iter().min_by_key(badness).cloned() else { break };
        left.remove(&best);
        order.push(best);
    }
    while improve(&mut order, edges) {}
    order
}

/// Moves one node to where fewer edges run upward; whether there was one.
fn improve(order: &mut Vec<String>, edges: &BTreeSet<Pair>) -> bool {
    let now = upward(order, edges).len();
    for from in 0..order.len() {
        for to in 0..order.len() {
            let node = order.remove(from);
            order.insert(to, node);
            if upward(order, edges).len() < now {
                return true;
            }
            let node = order.remove(to);
            order.insert(from, node);
        }
    }
    false
}

/// The edges that lead from a node to one that stands behind it; nodes that the order does not
/// name stand behind all.
#[must_use]
pub fn upward<'a>(order: &[String], edges: &'a BTreeSet<Pair>) -> Vec<&'a Pair> {
    let floors: BTreeMap<&str, usize> =
        order.iter().enumerate().map(|(i, node)| (node.as_str(), i)).collect();
    let floor = |node: &str| floors.get(node).copied().unwrap_or(usize::MAX);
    edges.iter().filter(|pair| floor(&pair.from) <= floor(&pair.to)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(pairs: &[(&str, &str)]) -> BTreeSet<Pair> {
        let pair = |(from, to): &(&str, &str)| Pair { from: (*from).into(), to: (*to).into() };
        pairs.iter().map(pair).collect()
    }

    #[test]
    fn circles_are_found_and_nothing_else() {
        let edges =
            edges(&[("a", "b"), ("b", "c"), ("c", "a"), ("d", "a"), ("c", "e"), ("d", "e")]);
        assert_eq!(circles(&edges), [["a", "b", "c"]]);
        assert!(circles(&BTreeSet::new()).is_empty());
    }

    #[test]
    fn an_order_without_circles_has_no_upward_edge_and_one_circle_has_one() {
        let nodes = |edges: &BTreeSet<Pair>| {
            edges.iter().flat_map(|e| [e.from.clone(), e.to.clone()]).collect::<BTreeSet<_>>()
        };
        let straight = edges(&[("d", "c"), ("c", "b"), ("b", "a"), ("d", "a")]);
        let order = few_upward(&nodes(&straight), &straight);
        assert_eq!(order, ["a", "b", "c", "d"]);
        let round = edges(&[("d", "c"), ("c", "b"), ("b", "a"), ("a", "d"), ("d", "b")]);
        assert_eq!(upward(&few_upward(&nodes(&round), &round), &round).len(), 1);
    }
}
