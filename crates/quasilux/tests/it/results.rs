//! What a run leaves behind and prints, and that it is the same again and on more threads.

use crate::scenes::{Look, remove_probes, write_floor, write_room};
use crate::support::{Folder, Run, illuminances, number, parsed, without_seconds_and_threads};
use serde_json::Value;

const ESTIMATORS: [&str; 3] = ["path", "bidirectional", "bidirectional-map"];

#[test]
fn a_document_a_spreadsheet_a_sensor_and_a_picture_a_grid() {
    let folder = Folder::new("results_files");
    write_room(&folder, "room", &Look::GREY);
    let run = folder.quasilux(&["run", "room.toml"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let mut names: Vec<String> = std::fs::read_dir(folder.path("out/room"))
        .expect("the default folder is out/NAME")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
        .collect();
    names.sort();
    assert_eq!(names, ["plane.csv", "plane.png", "probes.csv", "result.json"]);

    let png = std::fs::read(folder.path("out/room/plane.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG\r\n\x1a\n") && png.ends_with(b"IEND\xaeB`\x82"));
    let document = parsed(&folder.read("out/room/result.json"));
    check_csv(&folder.read("out/room/plane.csv"), &document["sensors"][0], 2);
    check_csv(&folder.read("out/room/probes.csv"), &document["sensors"][1], 0);
    for word in ["plane", "probes", "average", "minimum", "maximum", "uniformity", "out/room"] {
        assert!(run.stdout.contains(word), "no {word} in {}", run.stdout);
    }
}

/// Keys of a point's light, which the spreadsheet has as columns.
const LIGHT: [&str; 5] =
    ["/illuminance_lx", "/half_width_lx", "/direct_lx", "/unseen_lx", "/merged_lx"];

/// The spreadsheet has the document's numbers, after `indices` columns of grid indices.
fn check_csv(csv: &str, sensor: &Value, indices: usize) {
    let points = sensor["points"].as_array().expect("points");
    let mut lines = csv.lines();
    let header = lines.next().expect("a header");
    assert!(header.ends_with(&LIGHT.join(",")[1..].replace(",/", ",")), "{header}");
    assert_eq!(lines.clone().count(), points.len());
    for (line, point) in lines.zip(points) {
        // A field is empty where the document has no number.
        let field = |x: &str| (!x.is_empty()).then(|| x.parse().expect("a number"));
        let fields: Vec<Option<f64>> = line.split(',').map(field).collect();
        let mut expected: Vec<Option<f64>> = Vec::new();
        for key in ["position", "normal"] {
            expected.extend((0..3).map(|axis| Some(number(point, &format!("/{key}/{axis}")))));
        }
        let value = |key: &str| point.pointer(key).expect("a key").as_f64();
        expected.extend(LIGHT.map(value));
        assert_eq!(fields[indices..], expected, "{line}");
    }
}

#[test]
fn the_document_has_the_agreed_keys() {
    let folder = Folder::new("results_keys");
    write_room(&folder, "room", &Look::GREY);
    let document = parsed(&folder.document("room.toml", "out", &[], 0));
    assert_eq!(document["format"], "quasilux-result/1");
    assert_eq!(document["biased"], false);
    assert!(document["warnings"].is_array() && document["caveats"].is_array());
    let kinds = [("plane", "grid", 6), ("probes", "points", 2)];
    for (sensor, (name, kind, points)) in
        document["sensors"].as_array().expect("sensors").iter().zip(kinds)
    {
        assert_eq!((&sensor["name"], &sensor["kind"]), (&name.into(), &kind.into()));
        assert_eq!(sensor["points"].as_array().map(Vec::len), Some(points));
        for figure in ["average_lx", "minimum_lx", "maximum_lx", "uniformity"] {
            let value = number(sensor, &format!("/summary/{figure}/value"));
            let half_width = number(sensor, &format!("/summary/{figure}/half_width"));
            assert!(value > 0.0 && half_width >= 0.0 && half_width < value, "{figure}: {value}");
        }
        for (i, point) in sensor["points"].as_array().into_iter().flatten().enumerate() {
            let [all, direct] = ["/illuminance_lx", "/direct_lx"].map(|key| number(point, key));
            assert!(0.0 < direct && direct < all, "{name}[{i}]: {direct} of {all}");
            let keys = ["unseen_lx", "merged_lx", "disc_radius_m"];
            assert!(keys.iter().all(|key| point.get(key).is_some()), "{name}[{i}]");
            let half_width = number(point, "/half_width_lx");
            assert!(0.0 < half_width && half_width <= 0.1 * all, "{name}[{i}]: {half_width}");
        }
    }
    let run = &document["run"];
    for key in ["samples", "rays", "seconds", "threads", "mean_dimension/path", "flux_emitted_lm"] {
        assert!(number(run, &format!("/{key}")) > 0.0, "{key}");
    }
    assert!(run["cannot_see"].is_array());
    for (key, value) in [
        ("replicates", 8.0),
        ("confidence", 0.95),
        ("unseen_confidence", 0.95),
        ("unseen_tol", 0.05),
        ("invalid_contributions", 0.0),
    ] {
        assert_eq!(number(run, &format!("/{key}")), value, "{key}");
    }
    for (key, value) in [("estimator", "auto"), ("sequence", "sobol"), ("version", "0.1.0")] {
        assert_eq!(run[key], value);
    }
    assert_eq!(run["tolerance_reached"], true);
    assert!(run["mean_dimension"].as_object().is_some_and(|of| of.contains_key("photon")));
    let [emitted, absorbed, lost] =
        ["emitted", "absorbed", "lost"].map(|which| number(run, &format!("/flux_{which}_lm")));
    assert_eq!(lost, 0.0, "a closed room loses nothing");
    assert!((absorbed / emitted - 1.0).abs() < 1e-6, "{absorbed} of {emitted} lm");
}

#[test]
fn an_open_scene_accounts_for_what_it_loses() {
    let folder = Folder::new("results_open");
    write_floor(&folder, "floor", &Look::GREY);
    let document = parsed(&folder.document("floor.toml", "out", &[], 0));
    let [emitted, absorbed, lost] = ["emitted", "absorbed", "lost"]
        .map(|which| number(&document, &format!("/run/flux_{which}_lm")));
    assert!(absorbed > 0.0 && lost > 0.0, "{absorbed} lm, {lost} lm");
    assert!(((absorbed + lost) / emitted - 1.0).abs() < 1e-6, "{absorbed} + {lost} of {emitted}");
}

/// Several checkpoints, and paths beyond one block of work in the last.
#[test]
fn threads_change_nothing_but_their_number() {
    let folder = Folder::new("results_threads");
    write_room(&folder, "room", &Look::GREY);
    write_floor(&folder, "floor", &Look { reflectance: "[0.7, 0.4, 0.1]", ..Look::GREY });
    for project in ["room", "floor"] {
        for estimator in [&ESTIMATORS[..], &["photon"]].concat() {
            if estimator == "photon" {
                remove_probes(&folder, project);
            }
            let document = |threads: &str| {
                let more = ["--estimator", estimator, "--threads", threads];
                let more = [&more[..], &["--samples", "1000", "--rel-tol", "1e-9"]].concat();
                folder.document(&format!("{project}.toml"), threads, &more, 3)
            };
            let one = document("1");
            assert_eq!(number(&parsed(&one), "/run/threads"), 1.0);
            let one = without_seconds_and_threads(&one);
            for threads in ["2", "3"] {
                let again = document(threads);
                assert_eq!(number(&parsed(&again), "/run/threads").to_string(), threads);
                assert_eq!(
                    without_seconds_and_threads(&again),
                    one,
                    "{project}, {estimator}, {threads} threads"
                );
            }
        }
    }
}

#[test]
fn another_seed_gives_other_values() {
    let folder = Folder::new("results_seed");
    write_room(&folder, "room", &Look::GREY);
    let own = parsed(&folder.document("room.toml", "a", &[], 0));
    let other = parsed(&folder.document("room.toml", "b", &["--seed", "2"], 0));
    assert_eq!(number(&other, "/run/seed"), 2.0);
    assert_ne!(illuminances(&own)[0], illuminances(&other)[0]);
}

#[test]
fn json_prints_the_document_and_nothing_else() {
    let folder = Folder::new("results_json");
    write_room(&folder, "room", &Look::GREY);
    let run = folder.quasilux(&["run", "room.toml", "--json", "--out", "somewhere/deep"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    parsed(&run.stdout);
    assert_eq!(run.stdout, folder.read("somewhere/deep/result.json"));
    assert_eq!(run.stderr, "");
}

#[test]
fn quiet_prints_nothing() {
    let folder = Folder::new("results_quiet");
    write_room(&folder, "room", &Look::GREY);
    // Reads points from a map, which is worth a warning.
    let arguments = ["run", "room.toml", "--quiet", "--estimator", "bidirectional-map"];
    let run = folder.quasilux(&arguments);
    assert_eq!((run.code, &*run.stdout, &*run.stderr), (Some(0), "", ""));
    let document = parsed(&folder.read("out/room/result.json"));
    assert_eq!(document["biased"], true);
    assert_eq!(document["warnings"].as_array().map(Vec::len), Some(1));
    assert_eq!(document["caveats"][0]["kind"], "means_over_map_elements");
}

#[test]
fn no_escape_codes_without_a_terminal() {
    let folder = Folder::new("results_plain");
    write_room(&folder, "room", &Look::GREY);
    for no_colour in ["", "1"] {
        let mut command = folder.command(&["run", "room.toml"]);
        let output = command.env("NO_COLOR", no_colour).output().expect("the program starts");
        let run = Run::new(output);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(run.stdout.contains("average"));
        assert!(!run.stdout.contains('\x1b') && !run.stderr.contains('\x1b'));
    }
}

#[test]
fn dimming_scales_every_result() {
    const DIMMING: f64 = 1e-9;
    let folder = Folder::new("results_dimming");
    write_room(&folder, "bright", &Look::GREY);
    write_room(&folder, "dim", &Look { dimming: DIMMING, ..Look::GREY });
    for estimator in ESTIMATORS {
        let document = |project: &str| {
            let more = ["--estimator", estimator];
            parsed(&folder.document(&format!("{project}.toml"), project, &more, 0))
        };
        let (bright, dim) = (document("bright"), document("dim"));
        for key in ["/run/samples", "/run/rays"] {
            assert_eq!(number(&bright, key), number(&dim, key), "{estimator}, {key}");
        }
        for (i, (bright, dim)) in
            illuminances(&bright).into_iter().zip(illuminances(&dim)).enumerate()
        {
            for (bright, dim) in [(bright.0, dim.0), (bright.1, dim.1)] {
                let ratio = dim / bright / DIMMING;
                assert!((ratio - 1.0).abs() < 1e-6, "{estimator}, point {i}: ratio {ratio}");
            }
        }
    }
}

/// Light is linear: a coloured room shows the mean of the grey rooms of its three reflectances,
/// weighted as luminance is (ITU-R BT.709-6, item 3.2). Values agree within the sum of their 95 %
/// intervals, about three standard errors of the difference, in 8 points at a fixed seed. Equal
/// weights would be 1.6 to 3.5 times as far apart, exchanged ones more.
#[test]
fn a_coloured_room_is_a_mean_of_grey_rooms() {
    let folder = Folder::new("results_colour");
    let looks = [
        ("colour", "[0.8, 0.4, 0.1]", 0.0),
        ("red", "[0.8, 0.8, 0.8]", 0.2126),
        ("green", "0.4", 0.7152),
        ("blue", "0.1", 0.0722),
    ];
    let mut coloured = Vec::new();
    let mut mean = vec![(0.0, 0.0); 8];
    for (project, reflectance, weight) in looks {
        write_room(&folder, project, &Look { reflectance, ..Look::GREY });
        let more = ["--rel-tol", "2%"];
        let document = folder.document(&format!("{project}.toml"), project, &more, 0);
        let values = illuminances(&parsed(&document));
        for (sum, value) in mean.iter_mut().zip(&values) {
            *sum = (sum.0 + weight * value.0, sum.1 + weight * value.1);
        }
        if weight == 0.0 {
            coloured = values;
        }
    }
    for (i, (colour, mean)) in coloured.iter().zip(&mean).enumerate() {
        let apart = (colour.0 - mean.0).abs();
        assert!(apart <= colour.1 + mean.1, "point {i}: {colour:?} and {mean:?}");
    }
}

#[test]
fn a_grey_triple_is_a_number() {
    let folder = Folder::new("results_grey");
    write_room(&folder, "room", &Look { reflectance: "[0.5, 0.5, 0.5]", ..Look::GREY });
    let triple = folder.document("room.toml", "a", &[], 0);
    write_room(&folder, "room", &Look::GREY);
    let number = folder.document("room.toml", "b", &[], 0);
    // The project files differ, and so does what names them.
    let [triple, number] = [triple, number].map(|document| {
        let lines = document.lines().filter(|line| !line.contains("\"scene_sha256\""));
        without_seconds_and_threads(&lines.collect::<Vec<_>>().join("\n"))
    });
    assert_eq!(triple, number);
}

/// Files of two runs would be mixed: the second is told at once, and the first loses nothing.
#[cfg(unix)]
#[test]
fn a_folder_of_results_is_one_runs() {
    let folder = Folder::new("results_of_two");
    write_room(&folder, "room", &Look::GREY);
    let run =
        || folder.quasilux(&["run", "room.toml", "--samples", "64", "--out", "both", "--quiet"]);
    assert_eq!(run().code, Some(3));
    let before = folder.read("both/result.json");
    let held = std::fs::File::open(folder.path("both")).unwrap();
    held.lock().unwrap();
    let second = run();
    assert_eq!(second.code, Some(2), "{}", second.stderr);
    assert!(
        second.stderr.contains("both: another run writes its results there"),
        "{}",
        second.stderr
    );
    assert_eq!(folder.read("both/result.json"), before);
    drop(held);
    assert_eq!(run().code, Some(3));
}
