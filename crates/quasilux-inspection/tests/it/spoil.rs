//! Spoils rooms at random, and asks whether each fault is told.

use crate::furnished::Furnished;
use crate::room::Case;
use quasilux_inspection::{Check, Finding};
use quasilux_stats::SplitMix64;
use std::ops::Range;

/// A fault, and where it has to be told.
pub(crate) struct Fault {
    name: &'static str,
    checks: &'static [Check],
    section: &'static str,
    number: usize,
    /// What the cure has to say.
    cure: String,
}

/// Puts a fault in a room; `None` where the room has no place for it.
pub(crate) type Spoil = fn(&mut Furnished, &mut SplitMix64) -> Option<Fault>;

/// One that has to be told by any of some checks, at the first section of a kind.
pub(crate) fn fault(name: &'static str, checks: &'static [Check], section: &'static str) -> Fault {
    Fault { name, checks, section, number: 1, cure: String::new() }
}

impl Fault {
    /// At another one of the sections of that kind, from 1.
    pub(crate) fn at(self, number: usize) -> Self {
        Self { number, ..self }
    }

    pub(crate) fn saying(self, cure: &str) -> Self {
        Self { cure: cure.to_owned(), ..self }
    }

    fn is_told(&self, project: &str, findings: &[Finding]) -> bool {
        let lines: Vec<&str> = project.lines().collect();
        findings.iter().any(|finding| {
            let Some(place) = finding.place else { return false };
            let sections = lines[..place.line].iter().filter(|line| line.starts_with(self.section));
            self.checks.contains(&finding.check)
                && lines[place.line - 1].starts_with(self.section)
                && sections.count() == self.number
                && finding.cure.contains(&self.cure)
        })
    }
}

fn said(case: &Case) -> Vec<String> {
    case.findings().iter().map(|it| format!("    {it}")).collect()
}

/// Each room is right, and wrong in each of these ways.
pub(crate) fn told(seeds: Range<u64>, new: fn(&mut SplitMix64) -> Furnished, spoils: &[Spoil]) {
    let mut wrong = Vec::new();
    let mut tried = vec![0_u32; spoils.len()];
    for seed in seeds {
        let room = new(&mut SplitMix64::new(seed));
        let alarms = said(&room.case());
        if !alarms.is_empty() {
            wrong.push(format!("room {seed} is right:\n{}", alarms.join("\n")));
        }
        for (spoil, tried) in spoils.iter().zip(&mut tried) {
            let mut room = room.clone();
            let Some(fault) = spoil(&mut room, &mut SplitMix64::new(seed ^ 0x5EED)) else {
                continue;
            };
            *tried += 1;
            let case = room.case();
            if !fault.is_told(&case.project, &case.findings()) {
                wrong.push(format!("room {seed}, {}:\n{}", fault.name, said(&case).join("\n")));
            }
        }
    }
    assert!(wrong.is_empty(), "{} not told:\n{}", wrong.len(), wrong.join("\n"));
    assert!(tried.iter().all(|tried| *tried > 1), "{tried:?}");
}

/// Each room stays right with each of these changes.
pub(crate) fn quiet(
    seeds: Range<u64>,
    new: fn(&mut SplitMix64) -> Furnished,
    changes: &[fn(&mut Furnished, &mut SplitMix64)],
) {
    let mut wrong = Vec::new();
    for seed in seeds {
        for (number, change) in changes.iter().enumerate() {
            let mut room = new(&mut SplitMix64::new(seed));
            change(&mut room, &mut SplitMix64::new(seed ^ 0x5EED));
            let alarms = said(&room.case());
            if !alarms.is_empty() {
                wrong.push(format!("room {seed}, change {number}:\n{}", alarms.join("\n")));
            }
        }
    }
    assert!(wrong.is_empty(), "{} alarms:\n{}", wrong.len(), wrong.join("\n"));
}
