//! What `examples/cluster/local.sh` does, on every platform: plan, shards as processes at the same
//! time, merge, and the bits of the single run.

use std::fs;
use std::path::Path;
use std::process::{Child, Command};
use xtask::workspace::Failure;

const PROJECT: &str = "examples/cluster/cluster.toml";
const SAMPLES: &str = "1024";
const SHARDS: usize = 4;

/// Tries the example; results go to `out`.
pub(crate) fn run(root: &Path, out: &Path) -> Result<(), Failure> {
    println!("xtask: {PROJECT} in {SHARDS} parts");
    let path = |name: &str| out.join(name).display().to_string();
    let plan = path("plan.json");
    finish(start(root, &["plan", PROJECT, "--samples", SAMPLES, "--out", &plan])?, "plan")?;
    let parts: Vec<String> = (0..SHARDS).map(|k| path(&format!("{k}.part"))).collect();
    let shard = |(k, part): (usize, &String)| {
        let slice = format!("{k}/{SHARDS}");
        let arguments = ["shard", PROJECT, "--plan", &plan, "--shard", &slice, "--out", part];
        start(root, &[&arguments[..], &["--threads", "1", "--quiet"]].concat())
    };
    let processes: Result<Vec<Child>, Failure> = parts.iter().enumerate().map(shard).collect();
    processes?.into_iter().try_for_each(|process| finish(process, "shard"))?;
    let (merged, single) = (path("merged"), path("single"));
    let names: Vec<&str> = parts.iter().rev().map(String::as_str).collect();
    let merge = [&["merge"], &names[..], &["--out", &merged, "--quiet"]].concat();
    finish(start(root, &merge)?, "merge")?;
    let run = ["run", PROJECT, "--plan", &plan, "--out", &single, "--quiet"];
    finish(start(root, &run)?, "run")?;
    if result(&merged)? == result(&single)? {
        Ok(())
    } else {
        Err(format!("{merged} and {single} differ in more than seconds and threads"))
    }
}

fn start(root: &Path, arguments: &[&str]) -> Result<Child, Failure> {
    Command::new("cargo")
        .args(["run", "--profile", "ci", "--quiet", "--package", "quasilux", "--"])
        .args(arguments)
        .current_dir(root)
        .spawn()
        .map_err(|error| format!("cargo does not start: {error}"))
}

/// Waits for a process; results may be written before their tolerance is reached.
fn finish(mut process: Child, what: &str) -> Result<(), Failure> {
    let status = process.wait().map_err(|error| format!("`quasilux {what}`: {error}"))?;
    match status.code() {
        Some(0 | 3) => Ok(()),
        _ => Err(format!("`quasilux {what}` ended with {status}")),
    }
}

/// A result document without seconds and threads, which have lines of their own.
fn result(folder: &str) -> Result<String, Failure> {
    let path = Path::new(folder).join("result.json");
    let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
    let is_result = |line: &&str| !line.contains("\"seconds\":") && !line.contains("\"threads\":");
    Ok(text.lines().filter(is_result).collect::<Vec<_>>().join("\n"))
}
