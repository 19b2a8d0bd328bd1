//! `quasilux points`: numbers, drawings, the comparison, and refusals.

use std::path::PathBuf;
use std::process::{Command, Output};

fn points(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_quasilux"))
        .arg("points")
        .args(arguments)
        .output()
        .expect("the program starts")
}

fn stdout(arguments: &[&str]) -> String {
    let output = points(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).expect("text")
}

/// A file of this name that does not exist, in a folder of its own.
fn fresh(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("points-{name}"));
    let _ = std::fs::remove_dir_all(&folder);
    folder.join(name)
}

fn rows(csv: &str) -> Vec<Vec<f64>> {
    let row = |line: &str| line.split(',').map(|field| field.parse().expect("a number")).collect();
    csv.lines().skip(1).map(row).collect()
}

#[test]
fn numbers_go_to_stdout() {
    let text = stdout(&["sobol", "-n", "4", "--dims", "0,1"]);
    assert_eq!(text, "index,u0,u1\n0,0.0,0.0\n1,0.5,0.5\n2,0.25,0.75\n3,0.75,0.25\n");
    let text = stdout(&["sobol", "-n", "2^3", "--dims", "7"]);
    assert_eq!((text.lines().next(), text.lines().count()), (Some("index,u7"), 9));
}

#[test]
fn the_seed_makes_the_points_and_every_sequence_has_some() {
    let owen = |seed| stdout(&["sobol", "-n", "16", "--randomization", "owen", "--seed", seed]);
    assert_eq!(owen("1"), owen("1"));
    assert_ne!(owen("1"), owen("2"));
    for name in quasilux_sampling::Sequence::all_for(8).map(quasilux_sampling::Sequence::name) {
        let rows = rows(&stdout(&[name, "-n", "8", "--dims", "0,1,40"]));
        assert!(rows.len() == 8 && rows.iter().all(|row| row.len() == 4), "{name}");
        assert!(rows.iter().flat_map(|row| &row[1..]).all(|u| (0.0..1.0).contains(u)), "{name}");
    }
}

/// Figure 6 of the paper: one point in each of the 64 cells, and as many circles in the drawing.
#[test]
fn figure_six_is_drawn_and_listed() {
    let (svg, csv) = (fresh("fig6.svg"), fresh("fig6.csv"));
    let files = [svg.to_str().expect("text"), csv.to_str().expect("text")];
    let text =
        stdout(&["sobol", "-n", "64", "--dims", "0,1", "--svg", files[0], "--csv", files[1]]);
    assert!(text.contains("1 point in each of 8 x 8 cells"), "{text}");
    let drawing = std::fs::read_to_string(&svg).expect("a drawing");
    assert_eq!(drawing.matches("<circle").count(), 64);
    let mut counts = [0; 64];
    for row in rows(&std::fs::read_to_string(&csv).expect("numbers")) {
        counts[(row[2] * 8.0) as usize * 8 + (row[1] * 8.0) as usize] += 1;
    }
    assert_eq!(counts, [1; 64]);
}

#[test]
fn a_comparison_has_every_sequence_and_its_slopes() {
    let (svg, csv) = (fresh("compare.svg"), fresh("compare.csv"));
    let files = [svg.to_str().expect("text"), csv.to_str().expect("text")];
    let text = stdout(&["--compare", "--max-n", "2^10", "--svg", files[0], "--csv", files[1]]);
    let drawing = std::fs::read_to_string(&svg).expect("a drawing");
    assert_eq!(drawing.matches("<clipPath").count(), 12);
    let table = std::fs::read_to_string(&csv).expect("numbers");
    for name in quasilux_sampling::Sequence::all_for(1).map(quasilux_sampling::Sequence::name) {
        assert!(text.contains(name) && table.contains(&format!(",{name},")), "{name}");
        assert!(drawing.contains(&format!(">{name}</text>")), "{name}");
    }
    let slope = |measure: &str, setup: &str| -> f64 {
        let wanted = |line: &&str| line.starts_with(measure) && line.contains(setup);
        let line = table.lines().find(wanted).expect("a line");
        line.rsplit(',').next().expect("a field").parse().expect("a slope")
    };
    assert!(slope("gaussian", ",sobol,owen,") < -1.0);
    assert!((slope("gaussian", ",random,") + 0.5).abs() < 0.3);
    assert!(slope("star-discrepancy", ",sobol,none,") < -0.75);
}

#[test]
fn refusals_have_exit_code_two_and_name_what_is_wrong() {
    for (arguments, words) in [
        (&["sobl"][..], "did you mean \"sobol\""),
        (&["sobol", "--randomization", "own"], "did you mean \"owen\""),
        (&["sobol", "-n", "0"], "from 1 to 4294967296"),
        (&["sobol", "-n", "2^33"], "from 1 to 4294967296"),
        (&["sobol", "--dims", "0,x"], "expected dimensions"),
        (&["sobol", "--dims", "-1"], "-1"),
        (&["sobol", "--dims", "0", "--svg", "never.svg"], "two dimensions"),
        (&["sobol", "-n", "2^17", "--svg", "never.svg"], "at most 65536 points"),
        (&["sobol", "--cells", "0"], "--cells"),
        (&["sobol", "--compare"], "--compare"),
        (&["--compare", "--max-n", "2^21"], "from 64 to 1048576"),
        (&["sobol", "--csv", "."], "is a folder"),
        (&[], "NAME"),
    ] {
        let output = points(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {errors}");
        assert!(errors.contains(words), "{arguments:?}: {errors}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}
