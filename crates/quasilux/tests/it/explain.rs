//! What `--explain` and `list_terms` add to a run.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, number, parsed, without_seconds_and_threads};
use serde_json::Value;

fn write_room_with_terms(folder: &Folder) {
    write_room(folder, "room", &Look::GREY);
    let text = folder.read("room.toml");
    folder.write("room.toml", text.replace("rel_tol = 0.1", "rel_tol = 0.1\nlist_terms = 2"));
}

fn sum(terms: &Value) -> f64 {
    let terms = terms.as_array().expect("terms");
    assert_eq!(
        terms.iter().map(|term| &term["bounces"]).collect::<Vec<_>>(),
        [&Value::from(0), &Value::from(1), &Value::from("rest"),]
    );
    terms.iter().map(|term| number(term, "/value")).sum()
}

#[test]
fn terms_add_up_in_the_document() {
    let folder = Folder::new("explain_terms");
    write_room_with_terms(&folder);
    let document = parsed(&folder.document("room.toml", "out", &[], 0));
    for sensor in document["sensors"].as_array().expect("sensors") {
        let average = number(sensor, "/summary/average_lx/value");
        let share = sum(&sensor["summary"]["average_terms_lx"]) / average;
        assert!((share - 1.0).abs() < 1e-9, "{share}");
        for point in sensor["points"].as_array().expect("points") {
            let share = sum(&point["terms_lx"]) / number(point, "/illuminance_lx");
            assert!((share - 1.0).abs() < 1e-9, "{share}");
            let direct = number(&point["terms_lx"], "/0/value") / number(point, "/direct_lx");
            assert!((direct - 1.0).abs() < 1e-9, "{direct}");
        }
    }
}

/// The explanation is the same on any number of threads, adds to the document, and changes nothing
/// else.
#[test]
fn the_explanation_stands_beside_the_results() {
    let folder = Folder::new("explain_run");
    write_room(&folder, "room", &Look::GREY);
    let document = |more: &[&str]| {
        let more = [&["--estimator", "path"], more].concat();
        folder.document("room.toml", "out", &more, 0)
    };
    let [one, two] = ["1", "2"].map(|threads| document(&["--explain", "--threads", threads]));
    assert_eq!(without_seconds_and_threads(&one), without_seconds_and_threads(&two));
    let [mut plain, mut explained] = [document(&[]), one].map(|text| parsed(&text));
    let explanation = explained.as_object_mut().expect("an object").remove("explain");
    for document in [&mut plain, &mut explained] {
        document["run"]["seconds"] = Value::Null;
        document["run"]["threads"] = Value::Null;
        document["run"]["prediction"]["seconds"] = Value::Null;
        document["run"]["prediction"]["bytes"] = Value::Null;
    }
    assert_eq!(plain, explained);
    let explanation = explanation.expect("an explanation");
    assert_eq!(explanation["samples_are"], "paths");
    let blocks = explanation["blocks"].as_array().expect("blocks");
    assert_eq!(blocks[0]["feeds"][0]["what"], "direction from the sensor");
    assert_eq!(blocks.last().map(|block| &block["last"]), Some(&Value::Null));
    assert!(number(&explanation, "/gain/factor") > 1.0);
    for block in blocks {
        assert!(number(block, "/total/value") < 1.2, "{block}");
    }
}

#[test]
fn the_explanation_is_printed() {
    let folder = Folder::new("explain_print");
    write_room(&folder, "room", &Look::GREY);
    let run = folder.quasilux(&["run", "room.toml", "--explain", "--estimator", "path"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    for words in ["coordinates", "direction from the sensor", "The sequence helps", "average"] {
        assert!(run.stdout.contains(words), "no {words} in {}", run.stdout);
    }
    let run = folder.quasilux(&["run", "room.toml", "--explain", "--json"]);
    assert!(parsed(&run.stdout)["explain"].is_object());
    assert!(run.stderr.contains("direction from the sensor"), "{}", run.stderr);
}
