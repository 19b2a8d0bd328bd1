//! `quasilux sky`: what is outside of a project or of the options, and where the sun is.

use crate::support::{Folder, Numbers, Run, number, parsed};
use libm::{acos, cos, exp, sin, tan};
use serde_json::Value;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A floor under a sky that `outside` describes.
fn folder(name: &str, outside: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("floor.obj", "o floor\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    let project = format!(
        "[scene]\ngeometry = [\"floor.obj\"]\n{outside}[[sensors]]\nname = \"roof\"\n\
         kind = \"points\"\npoints = [[0.5, 0.5, 1]]\nnormals = [[0, 0, 1]]\n"
    );
    folder.write("a.toml", project);
    folder
}

fn must(folder: &Folder, arguments: &[&str], code: i32) -> Run {
    let run = folder.quasilux(arguments);
    assert_eq!(run.code, Some(code), "{arguments:?}: {}", run.stderr);
    run
}

/// The document of a command line.
fn document(folder: &Folder, arguments: &[&str]) -> Value {
    let run = must(folder, &[&["sky"], arguments, &["--json"]].concat(), 0);
    assert_eq!(run.stderr, "");
    let document = parsed(&run.stdout);
    assert_eq!(document["format"], "quasilux-sky/1");
    document
}

fn share_of(found: f64, expected: f64) -> f64 {
    (found / expected - 1.0).abs()
}

/// E = pi L of an even sky, E = 7 pi Lz / 9 of the traditional overcast sky.
#[test]
fn figures_are_those_of_closed_forms() {
    let even = "[sky]\nmodel = \"uniform\"\nzenith_luminance_cd_m2 = 3000\n[ground]\n\
        reflectance = 0.5\n";
    let even = document(&folder("sky_even", even), &["a.toml"]);
    assert!(share_of(number(&even, "/sky/horizontal_illuminance_lx/total"), 3000.0 * PI) < 1e-9);
    assert!(share_of(number(&even, "/sky/ground_luminance_cd_m2"), 1500.0) < 1e-9);
    assert_eq!((&even["sky"]["sun"], &even["site"]), (&Value::Null, &Value::Null));
    let overcast = "[sky]\nmodel = \"cie\"\ntype = 16\nzenith_luminance_cd_m2 = 9000\n[sun]\n\
        altitude_deg = 30\nazimuth_deg = 100\ndirect = true\nnormal_illuminance_lx = 5000\n";
    let folder = folder("sky_overcast", overcast);
    let found = document(&folder, &["a.toml"]);
    let of_sky = number(&found, "/sky/horizontal_illuminance_lx/sky");
    assert!(share_of(of_sky, 7000.0 * PI) < 1e-9, "{of_sky}");
    assert!(share_of(number(&found, "/sky/horizontal_illuminance_lx/sun"), 2500.0) < 1e-9);
    let total = number(&found, "/sky/horizontal_illuminance_lx/total");
    assert!(share_of(total, 7000.0 * PI + 2500.0) < 1e-9);
    assert_eq!(number(&found, "/sky/sun/normal_illuminance_lx"), 5000.0);
    for entry in found["sky"]["luminances"].as_array().expect("luminances") {
        let sine = sin(number(entry, "/altitude_deg").to_radians());
        let expected = 9000.0 * (1.0 + 2.0 * sine) / 3.0;
        assert!(share_of(number(entry, "/luminance_cd_m2"), expected) < 1e-9, "{entry}");
    }
    let text = must(&folder, &["sky", "a.toml"], 0).stdout;
    for words in [
        "traditional overcast sky",
        "30.00° high, 100.00° from north; 5000 lx across its rays",
        "21991 lx of the sky, 2500 lx of the sun, 24491 lx in all",
        "9000 cd/m²",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

/// a to e of CIE S 011/E:2003, table 1, of some types.
const TYPES: [(u8, [f64; 5]); 6] = [
    (1, [4.0, -0.70, 0.0, -1.0, 0.0]),
    (4, [1.1, -0.8, 2.0, -1.5, 0.15]),
    (8, [0.0, -1.0, 10.0, -3.0, 0.45]),
    (10, [-1.0, -0.55, 5.0, -2.5, 0.30]),
    (12, [-1.0, -0.32, 10.0, -3.0, 0.45]),
    (15, [-1.0, -0.15, 24.0, -2.8, 0.15]),
];

/// The relative luminance of the standard's formula.
fn cie([a, b, c, d, e]: [f64; 5], altitude: f64, azimuth: f64, sun: [f64; 2]) -> f64 {
    let gradation = if altitude <= 1e-12 { 1.0 } else { 1.0 + a * exp(b / sin(altitude)) };
    let cosine = sin(altitude) * sin(sun[0]) + cos(altitude) * cos(sun[0]) * cos(azimuth - sun[1]);
    let away = acos(cosine.clamp(-1.0, 1.0));
    let indicatrix = 1.0 + c * (exp(d * away) - exp(d * FRAC_PI_2)) + e * cos(away) * cos(away);
    gradation * indicatrix
}

/// Random suns: luminances by the formula, and their integral by midpoints.
#[test]
fn cie_skies_are_those_of_the_standard() {
    let folder = Folder::new("sky_cie");
    let mut numbers = Numbers(7);
    for (number_of, parameters) in TYPES {
        let degrees = [numbers.below(85) as f64 + 0.5, numbers.below(360) as f64 + 0.25];
        let [altitude, azimuth] = degrees.map(|degrees| degrees.to_string());
        let (number_text, lx) = (number_of.to_string(), 1000.0 + numbers.below(50_000) as f64);
        let lux = lx.to_string();
        let found = document(
            &folder,
            &["--type", &number_text, "--altitude", &altitude, "--azimuth", &azimuth, "--lx", &lux],
        );
        let sun = degrees.map(f64::to_radians);
        const STEPS: [u32; 2] = [600, 1200];
        let mut integral = 0.0;
        for i in 0..STEPS[0] {
            let altitude = FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(STEPS[0]);
            let ring: f64 = (0..STEPS[1])
                .map(|j| TAU * (f64::from(j) + 0.5) / f64::from(STEPS[1]))
                .map(|azimuth| cie(parameters, altitude, azimuth, sun))
                .sum();
            integral += ring * sin(altitude) * cos(altitude);
        }
        integral *= FRAC_PI_2 * TAU / f64::from(STEPS[0] * STEPS[1]);
        let zenith = number(&found, "/sky/zenith_luminance_cd_m2");
        let expected = lx * cie(parameters, FRAC_PI_2, 0.0, sun) / integral;
        assert!(share_of(zenith, expected) < 2e-5, "type {number_of}: {zenith}, not {expected}");
        for entry in found["sky"]["luminances"].as_array().expect("luminances") {
            let [altitude, azimuth] =
                ["/altitude_deg", "/azimuth_deg"].map(|key| number(entry, key).to_radians());
            let expected = lx * cie(parameters, altitude, azimuth, sun) / integral;
            assert!(share_of(number(entry, "/luminance_cd_m2"), expected) < 2e-5, "{entry}");
        }
    }
}

/// Reda and Andreas (2008), appendix A.5: topocentric zenith angle 50.11162 with the refraction of
/// 820 mbar and 11 degrees Celsius, azimuth 194.34024.
#[test]
fn the_sun_is_that_of_the_published_example() {
    let text = "[site]\nlatitude_deg = 39.742476\nlongitude_deg = -105.1786\ntime_zone_h = -7\n\
        north_deg = 15\n[sky]\nmodel = \"cie\"\ntype = 12\nhorizontal_illuminance_lx = 100\n\
        [sun]\ntime = 2003-10-17T12:30:30\n";
    let folder = folder("sky_nrel", text);
    let found = document(&folder, &["a.toml", "--positions", "2003-10-17"]);
    let altitude = number(&found, "/sky/sun/altitude_deg");
    let lifted = altitude + 10.3 / (altitude + 5.11);
    let refraction = 820.0 / 1010.0 * 283.0 / 284.0 * 1.02 / (60.0 * tan(lifted.to_radians()));
    assert!((90.0 - altitude - refraction - 50.11162).abs() < 4e-4, "{altitude}");
    assert!((number(&found, "/sky/sun/azimuth_deg") - 194.34024).abs() < 4e-4);
    assert_eq!(found["sky"]["time"], "2003-10-17T12:30:30");
    assert_eq!(number(&found, "/sky/north_deg"), 15.0);
    let noon = &found["days"][0]["hours"][12];
    assert_eq!(noon["time"], "2003-10-17T12:00:00");
    assert!((number(noon, "/altitude_deg") - altitude).abs() < 1.5);
}

/// The hours of a day by their document, for a site of the options.
fn hours(folder: &Folder, site: &str, date: &str) -> Vec<[f64; 2]> {
    let found = document(folder, &["--site", site, "--positions", date]);
    let hours = found["days"][0]["hours"].as_array().expect("hours");
    assert_eq!(hours.len(), 24);
    hours.iter().map(|at| [number(at, "/altitude_deg"), number(at, "/azimuth_deg")]).collect()
}

/// A clock that is an hour ahead shows each sun an hour later.
#[test]
fn all_time_zones_have_the_same_sun() {
    let folder = Folder::new("sky_zones");
    let greenwich = hours(&folder, "48.2,16.4,0", "2026-05-02");
    for zone in -12_i32..=12 {
        let found = hours(&folder, &format!("48.2,16.4,{zone}"), "2026-05-02");
        for (hour, there) in (0_i32..).zip(&found) {
            let Some(here) = usize::try_from(hour - zone).ok().and_then(|i| greenwich.get(i))
            else {
                continue;
            };
            let far = (there[0] - here[0]).abs().max((there[1] - here[1]).abs());
            assert!(far < 1e-6, "{zone}, {hour}: {there:?}, not {here:?}");
        }
    }
}

#[test]
fn poles_and_midnight_suns_have_their_days() {
    let folder = Folder::new("sky_poles");
    let text = |site: &str, date: &str| {
        must(&folder, &["sky", "--site", site, "--positions", date], 0).stdout
    };
    assert!(text("90,0,0", "2026-06-21").contains("the sun does not set"));
    assert!(text("90,0,0", "2026-12-21").contains("the sun does not rise"));
    assert!(text("-90,0,0", "2026-12-21").contains("the sun does not set"));
    assert!(text("70,25,2", "2026-06-21").contains("the sun does not set"));
    let pole = hours(&folder, "90,0,0", "2026-06-21");
    assert!(pole.iter().all(|[altitude, _]| (altitude - 23.43).abs() < 0.02), "{pole:?}");
    let north = hours(&folder, "70,25,2", "2026-06-21");
    assert!(north.iter().all(|[altitude, _]| *altitude > 0.0));
    let winter = hours(&folder, "52.5,13.4,1", "2026-12-21");
    assert_eq!(winter.iter().filter(|[altitude, _]| *altitude > 0.0).count(), 7);
    assert!(winter[0][0] < -55.0, "{winter:?}");
    // Twelve hours at the equator, where the date line's clock has the night in the middle.
    let found = document(&folder, &["--site", "0,180,0", "--positions", "2026-03-20"]);
    let up: Vec<Vec<f64>> = serde_json::from_value(found["days"][0]["up"].clone()).expect("spans");
    assert_eq!((up.len(), up[0][0], up[1][1]), (2, 0.0, 24.0));
    let total: f64 = up.iter().map(|span| span[1] - span[0]).sum();
    assert!((total - 12.0).abs() < 0.02, "{up:?}");
}

#[test]
fn tables_and_pictures_are_written() {
    let folder = Folder::new("sky_files");
    let site = ["sky", "--site", "-33.9,151.2,10", "--positions", "2026", "--csv", "t/sun.csv"];
    let text = must(&folder, &site, 0).stdout;
    assert_eq!(text.lines().filter(|line| line.contains("the sun is up from")).count(), 12);
    let table = folder.read("t/sun.csv");
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("time,altitude_deg,azimuth_deg"));
    let rows: Vec<&str> = lines.collect();
    assert_eq!(rows.len(), 12 * 24);
    assert!(rows[0].starts_with("2026-01-21T00:00:00,-"), "{}", rows[0]);
    assert!(rows[287].starts_with("2026-12-21T23:00:00,-"), "{}", rows[287]);
    // The sun of the south stands in the north at noon.
    let noon: Vec<f64> = rows[12].split(',').skip(1).map(|x| x.parse().unwrap()).collect();
    assert!(noon[0] > 70.0 && !(60.0..300.0).contains(&noon[1]), "{noon:?}");
    let draw = ["sky", "--type", "12", "--altitude", "40", "--azimuth", "150"];
    must(&folder, &[&draw[..], &["--png", "a.png", "--svg", "b/a.svg"]].concat(), 0);
    let png = std::fs::read(folder.path("a.png")).expect("a picture");
    assert!(png.starts_with(b"\x89PNG"));
    let svg = folder.read("b/a.svg");
    for words in ["CIE standard general sky 12", ">N<", ">sun<", "sky 10000 lx", "cd/m²"] {
        assert!(svg.contains(words), "{words}");
    }
    let night = ["sky", "--type", "12", "--altitude", "-4", "--azimuth", "150", "--svg", "c.svg"];
    let night = must(&folder, &night, 0);
    assert!(night.stdout.contains("4.00° below the horizon"), "{}", night.stdout);
    assert!(!folder.read("c.svg").contains(">sun<"));
}

#[test]
fn a_weather_file_has_places_of_the_sun_without_a_time() {
    let wea = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\nsite_elevation 2\n\
        weather_data_file_units 3\n3 20 11.5 50000 9000\n";
    let outside = "[weather]\nfile = \"site.wea\"\n[sky]\nmodel = \"weather\"\n";
    let year = folder("sky_year", outside);
    year.write("site.wea", wea);
    let refused = must(&year, &["sky", "a.toml"], 2).stderr;
    assert!(refused.contains("a.toml: ") && refused.contains("set time in [sun]"), "{refused}");
    let listed = document(&year, &["a.toml", "--positions", "2026-03-20"]);
    assert_eq!((&listed["sky"], number(&listed, "/site/time_zone_h")), (&Value::Null, -8.0));
    let drawn = ["sky", "a.toml", "--positions", "2026", "--png", "a.png"];
    assert!(must(&year, &drawn, 2).stderr.contains("there is no sky to draw"));
    let moment = format!("{outside}[sun]\ntime = 2026-03-20T11:10:00\ndirect = true\n");
    let moment = folder("sky_moment", &moment);
    moment.write("site.wea", wea);
    let found = document(&moment, &["a.toml"]);
    assert_eq!(
        (&found["sky"]["model"], &found["sky"]["file"]),
        (&"weather".into(), &"site.wea".into())
    );
    assert!(share_of(number(&found, "/sky/horizontal_illuminance_lx/sky"), 9000.0) < 1e-9);
    assert_eq!(number(&found, "/sky/sun/normal_illuminance_lx"), 50_000.0);
    let sine = sin(number(&found, "/sky/sun/altitude_deg").to_radians());
    let of_sun = number(&found, "/sky/horizontal_illuminance_lx/sun");
    assert!(share_of(of_sun, 50_000.0 * sine) < 1e-9);
    let told = must(&moment, &["sky", "a.toml"], 0);
    assert!(told.stdout.contains("03-20 11:30:00, the middle of its interval"), "{}", told.stdout);
    assert!(told.stderr.contains("warning: site.wea:1:1: "), "{}", told.stderr);
}

#[test]
fn bad_input_is_refused() {
    let folder = folder(
        "sky_bad",
        "[[lights]]\nkind = \"point\"\nposition = [0, 0, 1]\n\
        intensity_cd = 1\n",
    );
    folder.write(
        "even.toml",
        folder.read("a.toml").replace(
            "[[sensors]]",
            "[sky]\nmodel = \"uniform\"\nzenith_luminance_cd_m2 = 1\n[[sensors]]",
        ),
    );
    let cases: &[(&[&str], &str)] = &[
        (&[], "lacks <PROJECT>"),
        (&["a.toml"], "a.toml: nothing is outside; add [sky]"),
        (&["none.toml"], "none.toml: "),
        (&["even.toml", "--positions", "2026"], "even.toml: --positions needs a site"),
        (&["even.toml", "--type", "1"], "--type"),
        (&["even.toml", "--png", "even.toml"], "is read by this command"),
        (&["even.toml", "--png", "."], "is a folder"),
        (&["--type", "17"], "expected a whole number from 1 to 16"),
        (&["--type", "12"], "give --altitude and --azimuth"),
        (&["--type", "12", "--altitude", "5"], "--azimuth"),
        (&["--type", "1", "--lx", "0"], "expected an illuminance above 0"),
        (&["--type", "12", "--altitude", "91", "--azimuth", "0"], "degrees from -90 to 90"),
        (&["--type", "1", "--positions", "2026"], "give --site"),
        (&["--type", "1", "--csv", "a.csv"], "--positions"),
        (&["--site", "1,2,3"], "--positions"),
        (&["--site", "91,2,3", "--positions", "2026"], "latitude_deg is 91; expected -90 to 90"),
        (&["--site", "1,2", "--positions", "2026"], "hours ahead of Greenwich"),
        (&["--site", "1,2,3", "--positions", "2026-02-29"], "expected a date like"),
        (&["--site", "1,2,3", "--positions", "2026", "--png", "a.png"], "no sky to draw"),
    ];
    for (arguments, words) in cases {
        let run = must(&folder, &[&["sky"], *arguments].concat(), 2);
        assert!(run.stderr.contains(words), "{arguments:?}: {}", run.stderr);
        assert_eq!(run.stdout, "", "{arguments:?}");
    }
}

/// A picture of 16 x 8 pixels of one luminance, but for one in the east, 34 degrees high, that is
/// 4096 times as bright.
fn panorama() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    for pixel in 0..8 * 16 {
        let exponent = if pixel == 2 * 16 + 12 { 142 } else { 130 };
        bytes.extend_from_slice(&[128, 128, 128, exponent]);
    }
    bytes
}

/// The same figures as an open roof under the picture measures, its bright pixel included.
#[test]
fn a_panorama_shines_on_a_roof() {
    let outside = "[sky]\nmodel = \"panorama\"\nfile = \"sky.hdr\"\nmiddle_azimuth_deg = -11.25\n";
    let folder = folder("sky_panorama", outside);
    folder.write("sky.hdr", panorama());
    let found = document(&folder, &["a.toml", "--png", "sky.png"]);
    let dim = 179.0 * 128.5 / 64.0;
    // The projected solid angle of the bright pixel, between 45 and 67.5 degrees from the zenith.
    let [low, high] = [45.0_f64, 67.5].map(|zenith| sin(zenith.to_radians()));
    let bright = PI / 16.0 * (high * high - low * low) * 4095.0;
    let expected = dim * (PI + bright);
    let lx = number(&found, "/sky/horizontal_illuminance_lx/sky");
    assert!(share_of(lx, expected) < 1e-6, "{lx}, not {expected}");
    assert_eq!(
        (&found["sky"]["model"], &found["sky"]["file"]),
        (&"panorama".into(), &"sky.hdr".into())
    );
    let luminances = found["sky"]["luminances"].as_array().expect("luminances");
    for entry in luminances {
        let at = [number(entry, "/altitude_deg"), number(entry, "/azimuth_deg")];
        // 45 degrees is the edge of the bright pixel.
        let is_bright = at == [30.0, 90.0] || at == [45.0, 90.0];
        let expected = if is_bright { 4096.0 * dim } else { dim };
        assert!(share_of(number(entry, "/luminance_cd_m2"), expected) < 1e-6, "{at:?}");
    }
    let run = ["run", "a.toml", "--out", "out", "--quiet", "--rel-tol", "1%"];
    let done = must(&folder, &run, 0);
    assert_eq!(done.stderr, "");
    let result = parsed(&folder.read("out/result.json"));
    let lx = number(&result, "/sensors/0/points/0/illuminance_lx");
    assert!(share_of(lx, expected) < 0.02, "{lx}, not {expected}");
    let broken = folder.read("a.toml").replace("sky.hdr", "floor.obj");
    folder.write("b.toml", broken);
    let refused = must(&folder, &["run", "b.toml"], 2).stderr;
    assert!(refused.contains("floor.obj:1:1: ") && refused.contains("#?RADIANCE"), "{refused}");
}
