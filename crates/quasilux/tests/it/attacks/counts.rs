//! Counts beyond memory: refused before the run, with the need in bytes and the place that asks.

use super::{assert_refused, limited, room};

/// Each aborted on an allocation before its first sample, or took memory without end.
#[test]
fn counts_beyond_memory_are_refused_with_what_they_need() {
    let folder = room("counts");
    let text = folder.read("room.toml");
    let line_of = |text: &str, words: &str| {
        let line = text.lines().position(|line| line.starts_with(words));
        format!("room.toml:{}:", line.expect("the words are there") + 1)
    };
    let maps = "estimator = \"bidirectional-map\"\nmap_elements = 2147483647\nmap_element_m = 1e-9";
    let cases = [
        ("counts = [3, 2]", "counts = [10000, 1000]", "[[sensors]]"),
        ("counts = [3, 2]", "spacing = 0.0006", "[[sensors]]"),
        ("counts = [3, 2]", "counts = [4294967295, 4294967295]", "counts"),
        ("counts = [3, 2]", "spacing = 1e-300", "spacing"),
        ("replicates = 8", "replicates = 65536", "replicates"),
        ("replicates = 8", maps, "map_elements"),
    ];
    for (from, to, place) in cases {
        let mut changed = text.replacen(from, to, 1);
        if to.starts_with("replicates") {
            changed = changed.replacen("counts = [3, 2]", "counts = [100, 100]", 1);
        }
        folder.write("room.toml", &changed);
        let run = limited(&folder, &["run", "room.toml", "--threads", "2"]);
        let is_cells = place == "counts" || place == "spacing";
        let words = if is_cells { "cells so far" } else { "not enough memory" };
        assert_refused(to, &run, &[&line_of(&changed, place), words]);
    }
}

/// What fits is not refused.
#[test]
fn a_run_that_fits_is_let_in() {
    let folder = room("counts_fit");
    let text = folder.read("room.toml").replacen("[3, 2]", "[30, 20]", 1);
    folder.write("room.toml", text);
    let arguments = ["run", "room.toml", "--threads", "2", "--samples", "1"];
    let run = limited(&folder, &arguments);
    assert_eq!(run.code, Some(3), "{}", run.stderr);
}
