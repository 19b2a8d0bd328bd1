//! Runs that end before the tolerance: results, exit codes, and the bits of a `--samples` run.

use crate::scenes::{Look, remove_probes, write_room};
use crate::support::{Folder, number, parsed, without_seconds_and_threads};
use serde_json::Value;

/// A tolerance that no run of a test reaches.
const OUT_OF_REACH: [&str; 2] = ["--rel-tol", "1e-9"];

#[test]
fn samples_end_a_run_with_exit_code_3() {
    let folder = room("limits_samples");
    for samples in ["1", "37", "100", "256"] {
        let more = [&OUT_OF_REACH[..], &["--samples", samples]].concat();
        let document = parsed(&folder.document("room.toml", samples, &more, 3));
        assert_eq!(number(&document, "/run/samples").to_string(), samples);
        assert_eq!(document["run"]["tolerance_reached"], false);
    }
}

#[test]
fn a_reached_tolerance_gives_exit_code_0() {
    let folder = room("limits_reached");
    let more = ["--rel-tol", "20%", "--samples", "100000", "--time", "10m"];
    let document = parsed(&folder.document("room.toml", "out", &more, 0));
    assert_eq!(document["run"]["tolerance_reached"], true);
    assert!(number(&document, "/run/samples") < 100_000.0);
}

/// The kinds of the caveats in a document.
fn caveats(document: &Value) -> Vec<&str> {
    let all = document["caveats"].as_array().expect("a list of caveats");
    all.iter().map(|caveat| caveat["kind"].as_str().expect("a kind")).collect()
}

/// Half-widths of a handful of samples say nothing, however small.
#[test]
fn a_handful_of_samples_reaches_no_tolerance() {
    let folder = room("limits_handful");
    for (samples, code) in [("2", 3), ("64", 3), ("128", 0)] {
        let more = ["--rel-tol", "100%", "--samples", samples, "--estimator", "path"];
        let document = parsed(&folder.document("room.toml", samples, &more, code));
        assert_eq!(document["run"]["tolerance_reached"], code == 0);
        let warned = caveats(&document).contains(&"few_samples");
        assert_eq!(warned, code == 3, "{samples}: {}", document["caveats"]);
    }
}

#[test]
fn rays_end_a_run_with_exit_code_3() {
    let folder = room("limits_rays");
    // Without pilots, which may take more by themselves.
    let more = [&OUT_OF_REACH[..], &["--rays", "300000", "--estimator", "path"]].concat();
    let document = folder.document("room.toml", "rays", &more, 3);
    assert!(number(&parsed(&document), "/run/rays") <= 300_000.0);
    assert_is_a_samples_run(&folder, &document, "path");
}

#[test]
fn what_is_enough_can_be_said_in_lx_and_for_averages() {
    let folder = room("limits_tolerances");
    let more = ["--rel-tol", "0.01%", "--abs-tol", "500lx", "--samples", "100000"];
    let document = parsed(&folder.document("room.toml", "lx", &more, 0));
    assert_eq!(document["run"]["abs_tol_lx"], 500.0);
    assert!(number(&document, "/run/samples") < 1000.0);
    let more = ["--rel-tol", "20%", "--tolerance-on", "summary", "--confidence", "90%"];
    let document = parsed(&folder.document("room.toml", "summary", &more, 0));
    assert_eq!(document["run"]["tolerance_on"], "summary");
    assert_eq!(document["run"]["confidence"], 0.9);
}

/// The option goes before the project file, and both before 5 %.
#[test]
fn what_may_stay_unseen_can_be_said() {
    let folder = room("limits_unseen");
    let unseen = |project: &str, more: &[&str]| {
        let options = [&["--samples", "16", "--estimator", "path"], more].concat();
        parsed(&folder.document(project, "out", &options, 3))["run"]["unseen_tol"].clone()
    };
    assert_eq!(unseen("room.toml", &[]), 0.05);
    assert_eq!(unseen("room.toml", &["--unseen-tol", "off"]), "off");
    let project =
        folder.read("room.toml").replace("replicates", "unseen_tol = \"off\"\nreplicates");
    folder.write("off.toml", project);
    assert_eq!(unseen("off.toml", &[]), "off");
    assert_eq!(unseen("off.toml", &["--unseen-tol", "2%"]), 0.02);
}

/// Limits stand beside points and averages where they are asked for: both with random points, and
/// with Sobol' points the lower one, with a warning.
#[test]
fn certified_limits_can_be_asked_for() {
    let folder = room("limits_certified");
    let found = |more: &[&str]| {
        let options = [&["--samples", "128", "--rel-tol", "0.01%"], more].concat();
        parsed(&folder.document("room.toml", "out", &options, 3))
    };
    assert!(found(&[])["sensors"][0]["points"][0].get("certified_lx").is_none());
    for sequence in ["random", "sobol"] {
        let document = found(&["--interval", "certified", "--sequence", sequence]);
        let of_average = ["/sensors/0/summary/average_lx", "value"];
        for [of, name] in [["/sensors/0/points/0", "illuminance_lx"], of_average] {
            let value = number(&document, &format!("{of}/{name}"));
            let lower = number(&document, &format!("{of}/certified_lx/lower"));
            assert!(0.0 < lower && lower < value, "{lower}, {value}");
            let upper = document.pointer(&format!("{of}/certified_lx/upper")).expect("there");
            let is_above = upper.as_f64().is_some_and(|upper| upper > value);
            assert_eq!((is_above, upper.is_null()), (sequence == "random", sequence == "sobol"));
        }
        let told = caveats(&document).contains(&"no_certified_limit");
        assert_eq!(told, sequence == "sobol", "{}", document["caveats"]);
    }
    let refused = ["run", "room.toml", "--interval", "certified", "--estimator", "path"];
    let run = folder.quasilux(&refused);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("needs bounds, which the estimator \"path\" does not have"),
        "{}",
        run.stderr
    );
}

#[test]
fn without_intervals_samples_end_a_run() {
    let folder = room("limits_unrandomised");
    let project = folder.read("room.toml").replace("replicates = 8", "randomization = \"none\"");
    folder.write("room.toml", project);
    let document = parsed(&folder.document("room.toml", "out", &["--samples", "64"], 3));
    assert!(document["sensors"][0]["points"][0]["half_width_lx"].is_null());
    assert!(number(&document, "/sensors/0/points/0/illuminance_lx") > 0.0);
    assert_eq!(document["run"]["replicates"], 1);
    assert_eq!(caveats(&document), ["one_replicate"]);
    assert_eq!(document["warnings"][0], document["caveats"][0]["message"]);
}

#[test]
fn time_only_picks_the_last_checkpoint() {
    for estimator in ["auto", "path", "bidirectional", "bidirectional-map", "photon"] {
        let folder = room(&format!("limits_time_{estimator}"));
        if estimator == "photon" {
            remove_probes(&folder, "room");
        }
        let more = [&OUT_OF_REACH[..], &["--estimator", estimator, "--time", "2s"]].concat();
        let document = folder.document("room.toml", "time", &more, 3);
        let seconds = number(&parsed(&document), "/run/seconds");
        assert!(seconds < 20.0, "{estimator}: {seconds} s instead of two");
        assert_is_a_samples_run(&folder, &document, estimator);
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_results_and_exit_code_130() {
    use crate::support::{Run, interrupt};
    use std::thread::sleep;
    use std::time::Duration;

    let folder = room("limits_interrupt");
    let kept = ["--checkpoint", "run.ck", "--checkpoint-every", "0.01s"];
    let arguments =
        [&["run", "room.toml", "--out", "interrupt"][..], &kept, &OUT_OF_REACH].concat();
    let child = folder.command(&arguments).spawn().expect("the program starts");
    // Written once before the first sample, and again when there are some.
    let kept = || std::fs::read(folder.path("run.ck"));
    let first = loop {
        match kept() {
            Ok(first) => break first,
            Err(_) => sleep(Duration::from_millis(5)),
        }
    };
    while kept().is_ok_and(|now| now == first) {
        sleep(Duration::from_millis(5));
    }
    interrupt(&child);
    let run = Run::new(child.wait_with_output().expect("the program ends"));
    assert_eq!(run.code, Some(130), "{}", run.stderr);
    assert!(run.stdout.contains("average"), "{}", run.stdout);
    assert_is_a_samples_run(&folder, &folder.read("interrupt/result.json"), "auto");
}

/// So many sensor points that not all of them have a sample after a second.
fn with_many_points(name: &str) -> Folder {
    let folder = room(name);
    let project = folder.read("room.toml").replace("counts = [3, 2]", "counts = [100, 100]");
    folder.write("room.toml", project.replace("replicates = 8", "replicates = 256"));
    folder
}

fn assert_nothing_is_known(document: &str) {
    let document = parsed(document);
    assert_eq!((&document["run"]["samples"], number(&document, "/run/samples")), (&0.into(), 0.0));
    assert_eq!(document["run"]["tolerance_reached"], false);
    let points = document["sensors"][0]["points"].as_array().expect("points");
    assert!(points.len() == 10_000 && points.iter().all(|it| it["illuminance_lx"].is_null()));
    assert_eq!(caveats(&document)[0], "no_values");
}

#[test]
fn time_holds_before_the_first_checkpoint() {
    for estimator in ["auto", "path"] {
        let folder = with_many_points(&format!("limits_at_once_{estimator}"));
        let more = ["--time", "0.01s", "--estimator", estimator, "--rel-tol", "1e-9"];
        assert_nothing_is_known(&folder.document("room.toml", "time", &more, 3));
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_is_obeyed_before_the_first_checkpoint() {
    use crate::support::{Run, interrupt};

    let folder = with_many_points("limits_interrupt_at_once");
    let child = folder
        .command(&["run", "room.toml", "--out", "interrupt", "--checkpoint", "run.ck"])
        .spawn()
        .expect("the program starts");
    // Written once before the first sample.
    while !folder.path("run.ck").exists() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    interrupt(&child);
    let run = Run::new(child.wait_with_output().expect("the program ends"));
    assert_eq!(run.code, Some(130), "{}", run.stderr);
    assert_nothing_is_known(&folder.read("interrupt/result.json"));
}

/// A run that ended early wrote what a run with as many samples writes.
fn assert_is_a_samples_run(folder: &Folder, document: &str, estimator: &str) {
    let samples = number(&parsed(document), "/run/samples").to_string();
    let more = ["--estimator", estimator, "--samples", &samples];
    let again = folder.document("room.toml", "samples", &[&OUT_OF_REACH[..], &more].concat(), 3);
    assert_eq!(
        without_seconds_and_threads(document),
        without_seconds_and_threads(&again),
        "{estimator}, {samples} samples"
    );
}

fn room(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    folder
}
