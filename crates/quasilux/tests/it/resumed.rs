//! What a resumed run still knows: where its results go, what it took, and whether it was over.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, parsed};
use serde_json::Value;

const SHORT: [&str; 4] = ["--rel-tol", "1e-9", "--samples", "64"];

/// A run that was kept to its end, its results in `results`.
fn over(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    let kept = [&SHORT[..], &["--checkpoint", "run.ck"]].concat();
    folder.document("room.toml", "results", &kept, 3);
    folder
}

fn seconds(document: &Value) -> [f64; 2] {
    let run = &document["run"];
    [&run["seconds"], &run["earlier"]["seconds"]].map(|s| s.as_f64().expect("a number"))
}

#[test]
fn results_go_where_the_run_was_told_to_put_them() {
    let folder = over("resumed_out");
    let gone = |out: &str| std::fs::remove_file(folder.path(out)).expect("results are there");
    gone("results/result.json");
    assert_eq!(folder.quasilux(&["resume", "run.ck"]).code, Some(3));
    gone("results/result.json");
    // From another folder, where the project is not to be found as it was given.
    let mut elsewhere = folder.command(&["resume", "../run.ck"]);
    elsewhere.current_dir(folder.path("results"));
    assert_eq!(elsewhere.output().expect("the program starts").status.code(), Some(3));
    gone("results/result.json");
    assert!(!folder.path("results/results").exists());
    // Told anew, the new place is the one that is kept.
    for more in [&["--out", "other"][..], &[]] {
        assert_eq!(folder.quasilux(&[&["resume", "run.ck"], more].concat()).code, Some(3));
        gone("other/result.json");
        assert!(!folder.path("results/result.json").exists());
    }
}

#[test]
fn seconds_are_those_of_the_whole_run() {
    let folder = over("resumed_seconds");
    let [whole, earlier] = seconds(&parsed(&folder.read("results/result.json")));
    assert!(whole > 0.0 && earlier == 0.0, "{whole} {earlier}");
    let mut before = 0.0;
    for _ in 0..3 {
        let run = folder.quasilux(&["resume", "run.ck"]);
        assert!(run.stdout.contains(" s before it was resumed) on "), "{}", run.stdout);
        let [whole, earlier] = seconds(&parsed(&folder.read("results/result.json")));
        // What came after the last checkpoint of a run is not in it.
        assert!(earlier > before && whole >= earlier, "{before}, then {earlier} of {whole}");
        before = earlier;
    }
}

#[test]
fn a_run_that_is_over_says_so() {
    let folder = over("resumed_over");
    let note = "note: run.ck: the run was over; its results are written again\n";
    assert_eq!(folder.quasilux(&["resume", "run.ck"]).stderr, note);
    assert_eq!(folder.quasilux(&["resume", "run.ck", "--quiet"]).stderr, "");
    let begin = ["run", "room.toml", "--rel-tol", "1e-9", "--quiet", "--time", "0.05s"];
    let run = folder.quasilux(&[&begin[..], &["--checkpoint", "long.ck"]].concat());
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    let run = folder.quasilux(&["resume", "long.ck", "--time", "0.05s"]);
    assert!(!run.stderr.contains("over"), "{}", run.stderr);
}
