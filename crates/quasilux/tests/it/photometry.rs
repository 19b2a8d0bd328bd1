//! `quasilux photometry`: figures, documents, drawings, and files that cannot be read.

use crate::support::{Folder, Run, number, parsed};
use std::fmt::Write;
use std::io::Write as _;
use std::process::Stdio;

/// A Lambertian luminaire of 1000 cd in steps of 2.5 degrees, and its flux in lumens.
fn lambertian() -> String {
    let mut text = "IESNA:LM-63-2002\n[TEST] formula\n[LUMINAIRE] even disk\nTILT=NONE\n\
                    1 4000 1 37 1 1 2 0 0 0\n1 1 25\n"
        .to_owned();
    let angles = || (0..=36).map(|i| 2.5 * f64::from(i));
    let cosine = |degrees: f64| 1000.0 * libm::cos(degrees.to_radians()).max(0.0);
    for line in [angles().collect(), vec![0.0], angles().map(cosine).collect::<Vec<f64>>()] {
        let numbers: Vec<String> = line.iter().map(|x| format!("{x:.9}")).collect();
        writeln!(text, "{}", numbers.join(" ")).expect("strings grow");
    }
    text
}

/// 100 cd everywhere, in EULUMDAT: 100 cd/klm of 1000 lm.
pub(crate) const EVERYWHERE_LDT: &str = "maker\n1\n1\n1\n0\n2\n180\n\nball\n\nball.ldt\n\n\
    0\n0\n0\n0\n0\n0\n0\n0\n0\n\
    50\n100\n1\n0\n1\n1\nlamp\n1000\nwhite\n80\n10\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n180\n100\n\
    100\n";

fn folder(name: &str) -> Folder {
    let folder = Folder::new(&format!("photometry-{name}"));
    folder.write("disk.ies", lambertian());
    folder.write("ball.ldt", EVERYWHERE_LDT);
    folder
}

fn photometry(folder: &Folder, arguments: &[&str], code: i32) -> Run {
    let run = folder.quasilux(&[&["photometry"], arguments].concat());
    assert_eq!(run.code, Some(code), "{arguments:?}: {}{}", run.stdout, run.stderr);
    run
}

#[test]
fn a_summary_has_the_figures_of_the_closed_forms() {
    let folder = folder("summary");
    let text = photometry(&folder, &["disk.ies", "ball.ldt"], 0).stdout;
    for words in [
        "disk.ies\n",
        "even disk",
        "LM-63-2002, type C",
        "rotational; 1 plane x 37 angles, gamma 0\u{b0} to 90\u{b0}",
        "4000 lm of the lamps",
        "1000 cd at gamma 0\u{b0}",
        "beam 120\u{b0}, field 168.5\u{b0}",
        "44 75 94 100 79",
        "EULUMDAT, type C",
        "1256.6 lm integrated (50 % upward)",
        "beam 360\u{b0}, field 360\u{b0}",
        "25 50 75 50 126; upward 25 50 75 50",
    ] {
        assert!(text.contains(words), "{words:?} in {text}");
    }
}

#[test]
fn the_document_has_all_of_it_to_full_precision() {
    let folder = folder("document");
    let document = parsed(&photometry(&folder, &["ball.ldt", "disk.ies", "--json"], 0).stdout);
    assert_eq!(document["format"], "quasilux-photometry/1");
    let flux_lm = number(&document, "/files/0/luminaire/flux_lm");
    assert!((flux_lm - 400.0 * std::f64::consts::PI).abs() < 1e-9, "{flux_lm}");
    let disk = &document["files"][1];
    assert_eq!(disk["file"], "disk.ies");
    assert!(disk["error"].is_null() && disk["luminaire"]["name"] == "even disk");
    assert_eq!(disk["luminaire"]["principal_planes"][1]["plane"], "C90-C270");
    let beam = number(disk, "/luminaire/principal_planes/0/beam/angle_deg");
    assert!((beam - 120.0).abs() < 1e-6, "{beam}");
    assert_eq!(number(disk, "/luminaire/maximum/gamma_deg"), 0.0);
    let zones = disk["luminaire"]["zones_lm"].as_array().expect("zones");
    let sum: f64 = zones.iter().filter_map(|zone| zone.as_f64()).sum();
    assert_eq!(zones.len(), 18);
    assert!((sum - number(disk, "/luminaire/flux_lm")).abs() < 1e-9);
    // 1000 lm of lamps give 1257 lm: the rule, its place and its words.
    let warning = &document["files"][0]["warnings"][0];
    assert_eq!(warning["rule"], "FluxDiffers");
    assert!(warning["line"].is_u64() && warning["message"].is_string());
}

#[test]
fn one_bad_file_leaves_the_others() {
    let folder = folder("bad");
    folder.write("word.ies", lambertian().replace("1 4000 1", "1 many 1"));
    folder.write("picture.png", b"\x89PNG\r\n\x1a\n\0\0");
    let files = ["word.ies", "disk.ies", "gone.ies", "picture.png"];
    let run = photometry(&folder, &files, 2);
    assert!(run.stdout.contains("even disk"), "{}", run.stdout);
    for words in ["word.ies:5:3: found", "expected", "gone.ies: ", "picture.png:1:1: found"] {
        assert!(run.stderr.contains(words), "{words:?} in {}", run.stderr);
    }
    let run = photometry(&folder, &[&files[..], &["--json"]].concat(), 2);
    let document = parsed(&run.stdout);
    let entry = |i: usize| &document["files"][i];
    assert_eq!((&entry(0)["error"]["line"], &entry(0)["error"]["column"]), (&5.into(), &3.into()));
    assert!(entry(0)["luminaire"].is_null() && entry(1)["luminaire"].is_object());
    assert!(entry(2)["error"]["line"].is_null() && entry(2)["error"]["message"].is_string());
}

#[test]
fn warnings_matter_to_strict_callers() {
    let folder = folder("strict");
    folder.write("odd.ies", format!("{}left over\n", lambertian()));
    let run = photometry(&folder, &["odd.ies"], 0);
    assert!(run.stdout.contains("warning: odd.ies:10:1: found"), "{}", run.stdout);
    assert!(run.stdout.contains("[TrailingText]"), "{}", run.stdout);
    photometry(&folder, &["odd.ies", "--strict"], 1);
    photometry(&folder, &["odd.ies", "gone.ies", "--strict"], 2);
    // 3141.6 lm of 4000: the losses that each luminaire has. More light than the lamps give is odd.
    folder.write("disk.ies", lambertian());
    let text = photometry(&folder, &["disk.ies", "--strict"], 0).stdout;
    assert!(text.contains("[FluxDiffers]"), "{text}");
    folder.write("bright.ies", lambertian().replace(" 4000 ", " 3000 "));
    photometry(&folder, &["bright.ies", "--strict"], 1);
}

/// The ballast factor dims lamps and luminaire alike.
#[test]
fn the_output_ratio_is_that_on_one_ballast() {
    let folder = folder("ballast");
    folder.write("full.ies", lambertian());
    folder.write("dim.ies", lambertian().replace("\n1 1 25\n", "\n0.9 1 25\n"));
    let text = photometry(&folder, &["full.ies", "dim.ies"], 0).stdout;
    let ratios: Vec<&str> = text.lines().filter(|line| line.contains("output ratio")).collect();
    assert!(ratios.len() == 2 && ratios[0] == ratios[1], "{ratios:?}");
    assert!(ratios[0].ends_with("78.5 %"), "{ratios:?}");
}

#[test]
fn content_counts_more_than_the_name() {
    let folder = folder("misnamed");
    folder.write("ball.ies", EVERYWHERE_LDT);
    folder.write("disk.txt", lambertian());
    let text = photometry(&folder, &["ball.ies", "disk.txt"], 0).stdout;
    assert!(text.contains("EULUMDAT, type C (the file's name says LM-63)"), "{text}");
    assert!(text.contains("LM-63-2002, type C\n"), "{text}");
}

#[test]
fn a_file_may_come_through_stdin() {
    let folder = folder("stdin");
    let mut command = folder.command(&["photometry", "-"]);
    let mut child = command.stdin(Stdio::piped()).spawn().expect("the program starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    stdin.write_all(lambertian().as_bytes()).expect("the program reads");
    drop(stdin);
    let run = Run::new(child.wait_with_output().expect("the program ends"));
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stdout.starts_with("stdin\n") && run.stdout.contains("even disk"));
}

/// Points of the first solid curve: places in pixels.
fn polyline(svg: &str, colour: &str) -> Vec<[f64; 2]> {
    let line = svg
        .lines()
        .find(|line| line.contains(colour) && line.matches(',').count() > 20)
        .expect("a curve");
    let (_, rest) = line.split_once("points=\"").expect("points");
    let (points, _) = rest.split_once('"').expect("an end");
    let place = |pair: &str| {
        let (x, y) = pair.split_once(',').expect("a pair");
        [x, y].map(|text| text.parse().expect("a number"))
    };
    points.split(' ').map(place).collect()
}

/// In the polar diagram a Lambertian curve is a circle that touches the centre: each place is half
/// the diameter from the middle of the curve.
#[test]
fn a_lambertian_polar_curve_is_a_circle() {
    let folder = folder("polar");
    photometry(&folder, &["disk.ies", "--svg", "disk.svg", "--diagram", "polar"], 0);
    let svg = folder.read("disk.svg");
    assert!(svg.contains(">cd/klm</text>") && svg.contains("C0\u{2013}C180"), "{svg}");
    for colour in ["#0072b2", "#d55e00"] {
        let points = polyline(&svg, colour);
        let lowest = points.iter().copied().fold([0.0; 2], |a, b| if b[1] > a[1] { b } else { a });
        let top = points.iter().map(|point| point[1]).fold(f64::INFINITY, f64::min);
        let (middle, radius) = ([lowest[0], 0.5 * (lowest[1] + top)], 0.5 * (lowest[1] - top));
        // 1000 cd of 4000 lm are 250 cd/klm, on a scale to 250: the radius of the diagram.
        assert!((2.0 * radius - 205.0).abs() < 0.02, "{radius}");
        for [x, y] in points {
            let distance =
                ((x - middle[0]) * (x - middle[0]) + (y - middle[1]) * (y - middle[1])).sqrt();
            // Between knots the table is linear, not a cosine: h^2/8 of the diameter.
            assert!((distance - radius).abs() < 0.1, "{x} {y}: {distance} {radius}");
        }
    }
}

#[test]
fn drawings_of_several_files_go_to_a_folder() {
    let folder = folder("drawings");
    photometry(&folder, &["disk.ies", "ball.ldt", "--svg", "new/drawings"], 0);
    for name in ["disk", "ball"] {
        let svg = folder.read(&format!("new/drawings/{name}.svg"));
        assert!(svg.starts_with("<?xml") && svg.ends_with("</svg>\n"), "{name}");
        assert!(svg.contains("intensity / cd") && svg.contains("cd/klm"), "{name}");
    }
}

#[test]
fn outputs_that_cannot_be_are_refused_before_anything_is_written() {
    let folder = folder("outputs");
    folder.write("other/disk.ies", lambertian());
    folder.write("plain", "a file, not a folder");
    folder.write("trap.svg", lambertian());
    for (arguments, words) in [
        (&["disk.ies", "--svg", "disk.png"][..], "ends in .svg"),
        (&["disk.ies", "ball.ldt", "--svg", "one.svg"], "name a folder"),
        (&["disk.ies", "other/disk.ies", "--svg", "out"], "folders of their own"),
        (&["disk.ies", "--svg", "plain/disk.svg"], "plain"),
        (&["trap.svg", "--svg", "trap.svg"], "would replace the measured file"),
        (&["disk.ies", "--convert", "disk.ies"], "would replace the measured file"),
        (&["disk.ies", "--convert", "disk.txt"], ".ies or .ldt"),
        (&["disk.ies", "ball.ldt", "--convert", "new.ldt"], "one by one"),
        (&["disk.ies", "--convert", "plain/new.ldt"], "plain"),
        (&["disk.ies", "--diagram", "polar"], "--svg"),
        (&["disk.ies", "--svg", "a.svg", "--diagram", "round"], "polar"),
        (&[], "FILE"),
    ] {
        let run = photometry(&folder, arguments, 2);
        assert!(run.stderr.contains(words), "{arguments:?}: {}", run.stderr);
        assert!(run.stdout.is_empty(), "{arguments:?}: {}", run.stdout);
    }
    assert_eq!(folder.read("trap.svg"), lambertian());
    assert!(!folder.path("out/disk.svg").exists());
}

/// There and back: the figures of both formats are the same but for the rounding of cd/klm.
#[test]
fn a_luminaire_can_change_its_format() {
    let folder = folder("convert");
    photometry(&folder, &["disk.ies", "--convert", "new/disk.ldt"], 0);
    photometry(&folder, &["new/disk.ldt", "--convert", "new/disk.ies"], 0);
    let files = ["disk.ies", "new/disk.ldt", "new/disk.ies"];
    let document = parsed(&photometry(&folder, &[&files[..], &["--json"]].concat(), 0).stdout);
    let standards: Vec<&str> =
        (0..3).filter_map(|i| document["files"][i]["luminaire"]["standard"].as_str()).collect();
    assert_eq!(standards, ["LM-63-2002", "EULUMDAT", "LM-63-2002"]);
    for figure in ["flux_lm", "rated_flux_lm", "maximum/intensity_cd", "input_watts"] {
        let value = |i: usize| number(&document, &format!("/files/{i}/luminaire/{figure}"));
        for i in 1..3 {
            assert!(
                (value(i) / value(0) - 1.0).abs() < 1e-9,
                "{figure}: {} {}",
                value(i),
                value(0)
            );
        }
    }
    assert_eq!(document["files"][2]["luminaire"]["name"], "even disk");
    photometry(&folder, &["gone.ies", "--convert", "never.ldt"], 2);
    assert!(!folder.path("never.ldt").exists());
}

/// The page on luminaire files shows what the example prints.
#[test]
fn the_page_on_luminaires_is_right() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let page = std::fs::read_to_string(format!("{root}/docs/luminaires.md")).expect("a page");
    let mut command =
        Folder::new("photometry-page").command(&["photometry", "examples/office/batwing.ies"]);
    let run = Run::new(command.current_dir(root).output().expect("the program starts"));
    assert!(page.contains(&format!("```\n{}```\n", run.stdout)), "{}", run.stdout);
}
