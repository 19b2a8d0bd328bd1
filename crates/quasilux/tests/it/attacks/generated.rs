//! Inputs made at random of good ones ([`changes`](super::changes)), and command lines of words
//! that do not belong together.
//!
//! A share of the deep variants is in the usual tests: 200 of 3000 for rooms, 50 of 1000 for years,
//! measured surfaces and cases. A fault that one input in a hundred has is found with probability
//! 0.87 by 200 of them, and 0.39 by 50.

use super::changes::changed;
use super::seeds::{Seed, seeds};
use super::{Seconds, fault_of, limited_for, years};
use crate::support::{Folder, Numbers, Run};
use quasilux_stats::deep;
use std::fmt::Write;

/// Each takes a fraction of a second on a machine that has nothing else to do.
const MOST: Seconds = Seconds(20);

/// Words of command lines.
const WORDS: [&str; 40] = [
    "run",
    "points",
    "photometry",
    "bsdf",
    "plan",
    "shard",
    "merge",
    "resume",
    "check",
    "validate",
    "completions",
    "room.toml",
    "lamp.ies",
    "sheet.xml",
    "a.part",
    "run.ck",
    "plan.json",
    "sobol",
    "--out",
    "out",
    "--samples",
    "2",
    "--time",
    "0.1s",
    "--rel-tol",
    "1e-300",
    "--threads",
    "1025",
    "--seed",
    "18446744073709551615",
    "--json",
    "--quiet",
    "--plan",
    "--shard",
    "0/1",
    "--csv",
    "-n",
    "2^3",
    "--dims",
    "4294967295",
];

fn words(numbers: &mut Numbers) -> Vec<&'static str> {
    // The first word is a command most of the time.
    let commands = if numbers.below(8) == 0 { WORDS.len() } else { 11 };
    let first = WORDS[numbers.below(commands)];
    let more = numbers.below(7);
    std::iter::once(first).chain((0..more).map(|_| WORDS[numbers.below(WORDS.len())])).collect()
}

/// Files of bytes, and of what a library reads by names instead of lines.
const WITHOUT_LINES: [&str; 6] = [".glb", ".gltf", ".ck", ".part", ".year", ".binary"];
/// What is wrong with a file as a whole.
const OF_ALL: [&str; 3] = ["no triangles", "are degenerate", "its sha256 differs"];

/// Why a refusal does not say what is wrong with which file and where, if so.
fn muteness_of(run: &Run, seeds: &[Seed], file: &str) -> Option<String> {
    let message = run.stderr.lines().find(|line| line.starts_with("error: "))?;
    let names_a_file = seeds.iter().any(|seed| message.contains(seed.file));
    let has_lines = !WITHOUT_LINES.iter().any(|ending| file.ends_with(ending));
    let is_of_all = OF_ALL.iter().any(|words| message.contains(words));
    let names_a_line = message.split(':').any(|part| part.parse::<u32>().is_ok());
    let is_mute = !names_a_file || has_lines && !is_of_all && !names_a_line;
    is_mute.then(|| format!("no file and line are named, {file} was changed: {message}"))
}

/// Attack `number` on a folder of good files: what was done, and what came of it.
fn attack(number: usize, folder: &Folder, seeds: &[Seed], faults: &mut String) -> Run {
    let numbers = &mut Numbers(number as u64);
    numbers.below(2);
    let kind = number % (seeds.len() + 1);
    let (what, run, muteness);
    if let Some(Seed { file, bytes, commands }) = seeds.get(kind) {
        folder.write(file, changed(bytes, numbers));
        let command = &commands[numbers.below(commands.len())];
        run = limited_for(MOST, folder, command);
        what = format!("{file} of {command:?}");
        muteness = muteness_of(&run, seeds, file);
    } else {
        let words = words(numbers);
        run = limited_for(MOST, folder, &words);
        what = format!("{words:?}");
        muteness = None;
    }
    for fault in [fault_of(&run), muteness].into_iter().flatten() {
        writeln!(faults, "{number}: {what}: {fault}").expect("text takes everything");
    }
    // What runs have written over.
    for Seed { file, bytes, .. } in seeds {
        folder.write(file, bytes);
    }
    run
}

/// This many attacks; some are refused, and some are not.
fn attack_often(count: usize, folder: &Folder, seeds: &[Seed]) {
    let mut faults = String::new();
    let runs = (0..count).map(|number| attack(number, folder, seeds, &mut faults));
    let refused = runs.filter(|run| run.code == Some(2)).count();
    println!("{refused} of {count} refused");
    assert!(faults.is_empty(), "\n{faults}");
    assert!((count / 4..count).contains(&refused), "{refused} of {count} are refused");
}

#[test]
fn inputs_at_random_are_refused_or_done() {
    let (folder, seeds) = seeds();
    attack_often(if deep() { 3000 } else { 200 }, &folder, &seeds);
}

#[test]
fn years_surfaces_and_cases_at_random_are_refused_or_done() {
    let (folder, seeds) = years::seeds();
    attack_often(if deep() { 1000 } else { 50 }, &folder, &seeds);
}
