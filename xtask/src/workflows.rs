//! Whether the workflows of the public CI can be right: they are YAML of the form that is wanted,
//! the commands of this project that they call are there, and so are the files.

use xtask::workspace::root as workspace_root;
use yaml_rust2::{Yaml, YamlLoader};

/// A workflow, by its name.
fn workflows() -> Vec<(String, Yaml)> {
    let folder = workspace_root().join(".github/workflows");
    let entries = std::fs::read_dir(folder).expect("a folder of workflows");
    let mut workflows: Vec<(String, Yaml)> = entries
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            let text = std::fs::read_to_string(&path).expect("a text");
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let mut documents =
                YamlLoader::load_from_str(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(documents.len(), 1, "{name}");
            (name, documents.remove(0))
        })
        .collect();
    workflows.sort_by(|a, b| a.0.cmp(&b.0));
    workflows
}

/// The jobs of a workflow, by their names.
fn jobs(workflow: &Yaml) -> Vec<(&str, &Yaml)> {
    let jobs = workflow["jobs"].as_hash().expect("jobs");
    jobs.iter().map(|(name, job)| (name.as_str().expect("a name"), job)).collect()
}

/// The commands of a job.
fn commands(job: &Yaml) -> Vec<&str> {
    let steps = job["steps"].as_vec().expect("steps");
    steps.iter().filter_map(|step| step["run"].as_str()).collect()
}

/// Arguments of the calls of `cargo xtask` in a command, `xtask` left out.
fn calls(command: &str) -> Vec<Vec<&str>> {
    let calls = command.split("cargo xtask ").skip(1);
    calls
        .map(|call| {
            let words = call.split_whitespace();
            words.take_while(|word| word.chars().all(|c| c.is_ascii_lowercase())).collect()
        })
        .collect()
}

/// The commands that the help of `cargo xtask` lists, with their small words.
fn known() -> Vec<Vec<&'static str>> {
    calls(crate::HELP)
}

#[test]
fn workflows_call_what_there_is() {
    let known = known();
    let mut called = 0;
    for (name, workflow) in workflows() {
        for (job, content) in jobs(&workflow) {
            assert!(content["runs-on"].as_str().is_some(), "{name}: {job} runs on nothing");
            for command in commands(content) {
                for call in calls(command) {
                    let is_known = known.iter().any(|it| it.starts_with(&call));
                    assert!(is_known, "{name}: {job}: cargo xtask {}", call.join(" "));
                    called += 1;
                }
            }
        }
    }
    assert!(called >= 5, "only {called} calls");
}

#[test]
fn jobs_wait_for_jobs_that_there_are() {
    for (name, workflow) in workflows() {
        let names: Vec<&str> = jobs(&workflow).iter().map(|(job, _)| *job).collect();
        for (job, content) in jobs(&workflow) {
            for needed in content["needs"].as_vec().into_iter().flatten() {
                let needed = needed.as_str().expect("a name");
                assert!(names.contains(&needed), "{name}: {job} waits for {needed}");
            }
        }
    }
}

/// Only from a tag, and after the tests.
#[test]
fn nothing_is_published_but_from_a_tag() {
    let mut published = 0;
    for (name, workflow) in workflows() {
        for (job, content) in jobs(&workflow) {
            if job.starts_with("publish") {
                let condition = content["if"].as_str();
                assert_eq!(condition, Some("startsWith(github.ref, 'refs/tags/v')"), "{name}");
                let waits = content["needs"].as_vec().is_some_and(|needs| !needs.is_empty());
                assert!(waits, "{name}: {job} waits for nothing");
                published += 1;
            } else {
                let publishes = ["cargo publish", "gh release"];
                let is_one = |it: &&str| publishes.iter().any(|publish| it.contains(publish));
                assert!(!commands(content).iter().any(is_one), "{name}: {job} publishes");
            }
        }
    }
    assert_eq!(published, 4);
}

#[test]
fn a_call_of_nothing_is_found() {
    assert_eq!(calls("x && cargo xtask test python; cargo xtask dist ${{ t }}").len(), 2);
    assert_eq!(calls("cargo xtask notes \"$TAG\""), [["notes"]]);
    let nothing = calls("cargo xtask testify");
    assert!(!known().iter().any(|it| it.starts_with(&nothing[0])));
}
