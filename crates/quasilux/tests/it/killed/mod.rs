//! All commands that leave something on disk, killed and interrupted at random moments, some of
//! them on a full disk, some gone on with by another clock: then they end with the same bits.
//!
//! 5 of 100 kills are in the usual tests: one of every second kind of command. A fault that one
//! kill in twenty shows is found with probability 0.99 by 100 of them, and 0.23 by 5.

mod full;
mod works;

use crate::support::{Numbers, Run};
use quasilux_stats::deep;
use std::collections::BTreeMap;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;
use works::{RESCUE, Step, Work};

const SIGNALS: [&str; 3] = ["-KILL", "-TERM", "-INT"];
/// Between two looks at a process, and how many looks it has to end in after a signal.
const LOOK: Duration = Duration::from_millis(5);
const MAX_LOOKS: usize = 6000;

/// What happens to one step.
struct Fault {
    signal: &'static str,
    /// Whether the signal waits for what the step keeps of itself.
    waits: bool,
    delay: Duration,
    /// The disk is full behind this many blocks of a file.
    full_behind: Option<usize>,
    /// Files have another time before the step goes on, in years.
    clock: Option<u64>,
}

impl Fault {
    fn new(number: usize, numbers: &mut Numbers) -> Self {
        let full_behind = (number % 4 == 3).then(|| 1 << numbers.below(9));
        let clock = (number % 2 == 1).then(|| [1, 130][numbers.below(2)]);
        Self {
            signal: SIGNALS[number % SIGNALS.len()],
            waits: numbers.below(2) == 0,
            delay: Duration::from_millis(numbers.below(400) as u64),
            full_behind,
            clock,
        }
    }
}

/// A command of a step, on a disk that may be full.
fn start(work: &Work, arguments: &[&str], full_behind: Option<usize>) -> Child {
    let limit = full_behind.map_or_else(String::new, |blocks| format!("ulimit -f {blocks}; "));
    let mut command = Command::new("sh");
    command.args(["-c", &format!("{limit}exec \"$@\""), "sh", env!("CARGO_BIN_EXE_quasilux")]);
    command.args(arguments).current_dir(work.folder.path(""));
    command.env("TMPDIR", work.folder.path(RESCUE)).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("the shell starts")
}

fn finish(child: Child) -> Run {
    Run::new(child.wait_with_output().expect("the program ends"))
}

fn has_ended(child: &mut Child) -> bool {
    child.try_wait().expect("it is ours").is_some()
}

/// What a step does now: it goes on where it keeps itself.
fn command(work: &Work, step: &Step) -> Vec<&'static str> {
    let is_there = |kept: &&str| {
        let previous = format!("{kept}.previous");
        work.folder.path(kept).exists() || work.folder.path(&previous).exists()
    };
    match step.kept.filter(is_there) {
        Some(kept) => vec!["resume", kept, "--quiet"],
        None => step.begin.clone(),
    }
}

/// A step to its end, without faults.
fn complete(work: &Work, step: &Step) {
    let arguments = command(work, step);
    let run = finish(start(work, &arguments, None));
    assert_eq!(run.code, Some(step.code), "{arguments:?}: {}", run.stderr);
}

/// A step that a fault befalls; whether it was at work when the signal came.
fn befall(work: &Work, step: &Step, fault: &Fault) -> bool {
    let arguments = command(work, step);
    let mut child = start(work, &arguments, fault.full_behind);
    let is_kept = || step.kept.is_none_or(|kept| work.folder.path(kept).exists());
    while fault.waits && !is_kept() && !has_ended(&mut child) {
        sleep(LOOK);
    }
    sleep(fault.delay);
    let was_at_work = !has_ended(&mut child);
    if was_at_work {
        // It may have ended since.
        let kill = Command::new("kill").args([fault.signal, &child.id().to_string()]).output();
        kill.expect("there is a command that sends signals");
    }
    let looks = (0..MAX_LOOKS).find(|_| {
        sleep(LOOK);
        has_ended(&mut child)
    });
    if looks.is_none() {
        child.kill().expect("the program can be killed");
        panic!("{arguments:?} is deaf to {}", fault.signal);
    }
    let run = finish(child);
    let is_expected = match run.code {
        None | Some(130) => was_at_work,
        Some(2) if fault.full_behind.is_some() => {
            run.stderr.contains("cannot ") && run.stderr.contains("File too large")
        }
        code => code == Some(step.code),
    };
    assert!(is_expected, "{arguments:?}: {:?}: {}", run.code, run.stderr);
    was_at_work
}

/// Kills `count` times, in turn through all kinds of work, up to three times in the same.
fn kill(count: usize, name: &str) {
    let works = works::all(name);
    let mut whole: Vec<Option<BTreeMap<String, Vec<u8>>>> = works.iter().map(|_| None).collect();
    let numbers = &mut Numbers(7);
    let (mut kills, mut at_work, mut round) = (0, 0, 0);
    while kills < count {
        let which = round % works.len();
        let work = &works[which];
        round += 1;
        let expected = whole[which].get_or_insert_with(|| {
            work.clear();
            work.steps.iter().for_each(|step| complete(work, step));
            work.products()
        });
        work.clear();
        let victim = numbers.below(work.steps.len());
        let times = 1 + numbers.below(3);
        let times = if count < 10 { 1 } else { times.min(count - kills) };
        for (number, step) in work.steps.iter().enumerate() {
            for _ in 0..if number == victim { times } else { 0 } {
                let fault = Fault::new(kills, numbers);
                at_work += usize::from(befall(work, step, &fault));
                kills += 1;
                if let Some(years) = fault.clock {
                    work.date(years);
                }
            }
            complete(work, step);
        }
        let found = work.products();
        assert!(found.keys().eq(expected.keys()), "{:?} {:?}", found.keys(), expected.keys());
        for (name, bytes) in &found {
            let begin = &work.steps[victim].begin;
            assert!(expected[name] == *bytes, "{name} differs after {begin:?} was killed");
        }
    }
    println!("{at_work} of {count} were at work");
    assert!(at_work >= count / 4, "only {at_work} of {count} were at work");
}

#[test]
fn all_that_is_killed_ends_with_the_same_bits() {
    kill(if deep() { 100 } else { 5 }, "killed");
}
