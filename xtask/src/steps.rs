//! The steps of the test command, in the order in which they are cheapest to fail.

use crate::{documents, examples, gauntlet, package, python, release, same_bits};
use std::collections::BTreeSet;
use std::process::Command;
use std::time::{Duration, Instant};
use xtask::workspace::{Failure, root as workspace_root};

/// One step: its name on the command line, and what it does.
struct Step {
    name: &'static str,
    run: fn() -> Result<(), Failure>,
}

const STEPS: [Step; 11] = [
    Step { name: "fmt", run: check_format },
    Step {
        name: "clippy",
        run: || cargo(&["clippy", "--workspace", "--all-targets", "--", "-D", "warnings"], &[]),
    },
    Step { name: "deny", run: check_dependencies },
    Step { name: "fuzz", run: check_fuzz_targets },
    Step { name: "tests", run: || run_tests(&[]) },
    Step {
        name: "docs",
        run: || cargo(&["doc", "--workspace", "--no-deps"], &[("RUSTDOCFLAGS", "-D warnings")]),
    },
    Step { name: "package", run: || package::check(&workspace_root()) },
    Step { name: "release", run: || release::rehearse(&workspace_root()) },
    Step { name: "python", run: || python::check(&workspace_root()) },
    Step { name: "examples", run: || examples::run_all(&workspace_root()) },
    Step { name: "gauntlet", run: || gauntlet::run_quick(&workspace_root()) },
];

/// Every command of the documentation, some of which take minutes; left out by [`run_all`].
const DOCUMENTS: Step = Step { name: "documents", run: || documents::check(&workspace_root()) };

/// The other step that [`run_all`] leaves out: all tests, in the variants that take long and find
/// smaller errors, each crate built from its package, and the program built twice.
const DEEP: Step = Step {
    name: "deep",
    run: || {
        run_tests(&[("QUASILUX_DEEP", "1")])?;
        package::build(&workspace_root())?;
        same_bits::check(&workspace_root())
    },
};

/// Runs all steps and stops at the first that fails.
pub(crate) fn run_all() -> Result<(), Failure> {
    let mut total = Duration::ZERO;
    for step in &STEPS {
        total += run(step)?;
    }
    println!("xtask: all steps passed in {:.0} s", total.as_secs_f64());
    Ok(())
}

/// Runs the step of that name.
pub(crate) fn run_one(name: &str) -> Result<(), Failure> {
    let steps = || STEPS.iter().chain([&DOCUMENTS, &DEEP]);
    let Some(step) = steps().find(|step| step.name == name) else {
        let names: Vec<&str> = steps().map(|step| step.name).collect();
        return Err(format!("no step {name:?}; the steps are {}", names.join(", ")));
    };
    run(step).map(|_| ())
}

#[expect(clippy::disallowed_methods, reason = "the clock only tells how long a step took")]
fn run(step: &Step) -> Result<Duration, Failure> {
    println!("xtask: {} ...", step.name);
    let start = Instant::now();
    (step.run)().map_err(|failure| {
        format!("step {0} failed: {failure}\nrun it alone: cargo xtask test {0}", step.name)
    })?;
    let took = start.elapsed();
    println!("xtask: {} passed in {:.0} s", step.name, took.as_secs_f64());
    Ok(took)
}

/// Runs all tests, and tells how many were left out for want of files (`quasilux-corpus`).
fn run_tests(more: &[(&str, &str)]) -> Result<(), Failure> {
    let list = std::env::temp_dir().join(format!("quasilux-left-out-{}", std::process::id()));
    let name = list.to_string_lossy();
    let variables = [&[("QUASILUX_LEFT_OUT", name.as_ref())], more].concat();
    let outcome = cargo(&["test", "--workspace", "--profile", "ci"], &variables);
    let left_out = std::fs::read_to_string(&list).unwrap_or_default();
    let _ = std::fs::remove_file(&list);
    // A test that asks for several files has a line for each.
    let names = left_out.lines().map(|line| line.split_once(": ").map_or(line, |(name, _)| name));
    let left_out: BTreeSet<&str> = names.collect();
    println!("xtask: {} tests were left out for want of files", left_out.len());
    outcome
}

/// The fuzz targets are a workspace of their own.
const FUZZ_MANIFEST: &str = "--manifest-path=fuzz/Cargo.toml";

fn check_format() -> Result<(), Failure> {
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(&["fmt", FUZZ_MANIFEST, "--check"], &[])
}

/// Lints the fuzz targets without the fuzzer, which needs a nightly compiler and a C++ one.
fn check_fuzz_targets() -> Result<(), Failure> {
    cargo(&["clippy", FUZZ_MANIFEST, "--no-default-features", "--", "-D", "warnings"], &[])
}

/// Licences, doubles and sources of all dependencies (`deny.toml`), where cargo-deny is installed.
/// Advisories need the network: the public CI asks for them.
fn check_dependencies() -> Result<(), Failure> {
    let asked = Command::new("cargo").args(["deny", "--version"]).output();
    if !asked.is_ok_and(|output| output.status.success()) {
        println!("xtask: dependencies are left out: no cargo-deny (cargo install cargo-deny)");
        return Ok(());
    }
    cargo(&["deny", "--offline", "check", "licenses", "bans", "sources"], &[])
}

/// Runs cargo in the workspace with further environment variables.
fn cargo(arguments: &[&str], variables: &[(&str, &str)]) -> Result<(), Failure> {
    let line = format!("cargo {}", arguments.join(" "));
    let status = Command::new("cargo")
        .args(arguments)
        .envs(variables.iter().copied())
        .current_dir(workspace_root())
        .status()
        .map_err(|error| format!("`{line}` does not start: {error}"))?;
    if status.success() { Ok(()) } else { Err(format!("`{line}` ended with {status}")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_step_is_refused_with_the_names_of_all() {
        let failure = run_one("teste").unwrap_err();
        assert!(
            STEPS.iter().chain([&DOCUMENTS, &DEEP]).all(|step| failure.contains(step.name)),
            "{failure}"
        );
    }

    #[test]
    fn a_failing_command_is_a_failure() {
        let failure = cargo(&["no-such-subcommand"], &[]).unwrap_err();
        assert!(failure.contains("cargo no-such-subcommand"), "{failure}");
    }
}
