//! Projects whose sky is that of a weather file, through `run`.

use crate::support::{Folder, number, parsed};

/// Three hours of a spring day.
const WEA: &str = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
    site_elevation 2\nweather_data_file_units 3\n3 20 3.5 0 0\n3 20 11.5 0 9000\n\
    3 20 12.5 60000 12000\n";

/// A floor that looks up.
const FLOOR: &str = "o floor\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

/// A sensor under the open sky of a weather file; `rest` is what else is outside.
fn project(rest: &str) -> String {
    format!(
        "[scene]\ngeometry = [\"floor.obj\"]\n[weather]\nfile = \"site.wea\"\n\
         [sky]\nmodel = \"weather\"\n{rest}\n[[sensors]]\nname = \"roof\"\nkind = \"points\"\n\
         points = [[0.5, 0.5, 1]]\nnormals = [[0, 0, 1]]\n[simulation]\nreplicates = 4\n"
    )
}

fn folder(name: &str, rest: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("floor.obj", FLOOR);
    folder.write("site.wea", WEA);
    folder.write("a.toml", project(rest));
    folder
}

/// Under an open sky the illuminance is that of the file.
#[test]
fn a_run_has_the_light_of_its_interval() {
    let folder = folder("weather_run", "[sun]\ntime = 2026-03-20T11:10:00\ndirect = true");
    let run = ["run", "a.toml", "--out", "out", "--samples", "4096"];
    let done = folder.quasilux(&run);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    assert!(done.stdout.contains("site.wea:1:1: found 3 intervals"), "{}", done.stdout);
    let document = parsed(&folder.read("out/result.json"));
    let found = number(&document, "/sensors/0/points/0/illuminance_lx");
    assert!((found / 9000.0 - 1.0).abs() < 0.01, "{found}");
    assert!((number(&document, "/outside/horizontal_illuminance_lx") - 9000.0).abs() < 1e-6);
}

/// The weather is a part of what a scene is: parts of a run refuse another.
#[test]
fn another_weather_is_another_scene() {
    let folder = folder("weather_identity", "[sun]\ntime = 2026-03-20T12:10:00\ndirect = true");
    let planned = folder.quasilux(&["plan", "a.toml", "--samples", "64", "--out", "p.json"]);
    assert_eq!(planned.code, Some(0), "{}", planned.stderr);
    folder.write("site.wea", WEA.replace("12000", "12001"));
    let refused = folder.quasilux(&["run", "a.toml", "--plan", "p.json"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("site.wea has changed"), "{}", refused.stderr);
}

#[test]
fn years_and_nights_are_refused_where_no_lamp_shines() {
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2]\nintensity_cd = 9\n";
    let night = "[sun]\ntime = 2026-03-20T03:10:00\n";
    let with_lamp = format!("{night}{lamp}");
    let run = |name: &str, rest: &str| {
        let folder = folder(name, rest);
        let run = folder.quasilux(&["run", "a.toml", "--samples", "64", "--rel-tol", "90%"]);
        let checked = folder.quasilux(&["check", "a.toml"]);
        assert_eq!(checked.code, Some(0), "{}", checked.stderr);
        run
    };
    let year = run("weather_year", "");
    assert_eq!(year.code, Some(2), "{}", year.stderr);
    let words = ["a.toml: ", "set time in [sun]", "`quasilux annual` computes the year"];
    assert!(words.iter().all(|word| year.stderr.contains(word)), "{}", year.stderr);
    let lit_year = run("weather_lit_year", lamp);
    assert_eq!(lit_year.code, Some(2), "{}", lit_year.stderr);
    let dark = run("weather_night", night);
    assert_eq!(dark.code, Some(2), "{}", dark.stderr);
    assert!(dark.stderr.contains("nothing shines"), "{}", dark.stderr);
    let lit = run("weather_lit_night", &with_lamp);
    assert!(matches!(lit.code, Some(0 | 3)), "{}", lit.stderr);
    assert!(lit.stdout.contains("nothing shines at this time in \"site.wea\""), "{}", lit.stdout);
}

/// A weather file needs no project: the light is that of the file, and its clock is the site's.
#[test]
fn a_weather_file_alone_says_what_shines_at_a_time() {
    let folder = folder("weather_alone", "");
    let sky = |more: &[&str]| folder.quasilux(&[&["sky", "--weather", "site.wea"], more].concat());
    let shown = sky(&["--time", "2031-03-20T12:10", "--json"]);
    assert_eq!(shown.code, Some(0), "{}", shown.stderr);
    let document = parsed(&shown.stdout);
    assert!((number(&document, "/sky/horizontal_illuminance_lx/sky") - 12000.0).abs() < 1e-6);
    assert_eq!(number(&document, "/sky/sun/normal_illuminance_lx"), 60000.0);
    assert_eq!(
        (document["sky"]["file"].as_str(), document["sky"]["time"].as_str()),
        (Some("site.wea"), Some("2002-03-20T12:30:00"))
    );
    let days = sky(&["--positions", "2026-03-20"]);
    assert!(days.code == Some(0) && days.stdout.contains("2026-03-20"), "{}", days.stderr);
    for (more, expected) in [
        (&[][..], "site.wea: no time says which interval; give --time"),
        (&["--time", "2026-03-20T20:00"], "site.wea: no interval with 03-20 20:00 in it"),
        (&["--time", "2026-03-20T03:40"], "site.wea: nothing shines at 03-20 03:30:00"),
        (&["--time", "noon"], "--time is \"noon\"; expected 2026-03-20T12:00:00"),
    ] {
        let refused = sky(more);
        assert_eq!(refused.code, Some(2), "{more:?}");
        assert!(refused.stderr.contains(expected), "{}", refused.stderr);
    }
}
