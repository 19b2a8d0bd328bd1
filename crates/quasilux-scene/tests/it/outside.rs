//! `[site]`, `[sky]`, `[sun]`, `[ground]` and `[[openings]]` of a project.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{Environment, LoadError};

/// The small project with other light: what is outside begins on line 4.
fn load_outside(outside: &str) -> Result<Environment, LoadError> {
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100\n";
    let project = PROJECT.replace(lamp, outside);
    assert_ne!(project, PROJECT);
    load_text(&project, &MapFiles::room()).map(|loaded| loaded.scene.environment.expect("a sky"))
}

const CLEAR: &str = "[sky]\nmodel = \"cie\"\ntype = 12\nhorizontal_illuminance_lx = 20000\n";

#[test]
fn a_sky_needs_no_lamp() {
    let overcast = "[sky]\nmodel = \"cie\"\ntype = 16\nzenith_luminance_cd_m2 = 9000\n";
    let outside = load_outside(overcast).unwrap();
    assert_eq!(outside.sky.zenith_luminance_cd_m2(), 9000.0);
    assert!(outside.sun.is_none() && outside.openings.is_empty());
    assert_eq!((outside.ground_reflectance, outside.north_deg), (0.2, 0.0));
    let with_lamp = format!("{PROJECT}{overcast}");
    let loaded = load_text(&with_lamp, &MapFiles::room()).unwrap();
    assert_eq!(loaded.scene.lights.len(), 1);
    assert!(loaded.scene.environment.is_some());
}

#[test]
fn every_key_is_read() {
    let text = format!(
        "{CLEAR}[site]\nlatitude_deg = 52.5\nlongitude_deg = 13.4\ntime_zone_h = 1\n\
         north_deg = -20\n[sun]\ntime = 2026-06-21T12:00:00\ndirect = true\n\
         normal_illuminance_lx = 80000\n[ground]\nreflectance = 0.3\n\
         [[openings]]\norigin = [0, 0, 1]\nu = [1, 0, 0]\nv = [0, 0, 2]\n"
    );
    let outside = load_outside(&text).unwrap();
    let sun = outside.sun.unwrap();
    assert!((sun.centre.altitude_deg - 60.9).abs() < 0.1, "{sun:?}");
    assert_eq!(sun.normal_illuminance_lx, 80_000.0);
    assert_eq!((outside.ground_reflectance, outside.north_deg), (0.3, -20.0));
    assert_eq!(outside.openings.len(), 1);
    assert!((outside.sky.horizontal_illuminance_lx() - 20_000.0).abs() < 1e-6);
    // The same as a string, in another notation of the same time.
    let quoted = text.replace("2026-06-21T12:00:00", "\"2026-06-21 12:00\"");
    assert_eq!(load_outside(&quoted).unwrap().sun, Some(sun));
}

/// Berlin at any hour of some days, under a clear sky: by night neither the sky nor the sun can
/// shine, and by day both may.
#[test]
fn light_by_night_is_told() {
    let warned = |zone_h: f64, longitude_deg: f64, time: &str, sky: &str| {
        let text = format!(
            "{sky}[site]\nlatitude_deg = 52.5\nlongitude_deg = {longitude_deg}\n\
             time_zone_h = {zone_h}\n\
             [sun]\ntime = {time}\ndirect = true\nnormal_illuminance_lx = 80000\n"
        );
        let lamp = "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100\n";
        let loaded = load_text(&PROJECT.replace(lamp, &text), &MapFiles::room()).unwrap();
        warnings_of(&loaded)
    };
    for (day, sunrise_h, sunset_h) in
        [("03-20", 6.2, 18.4), ("06-21", 3.8, 20.6), ("12-21", 8.2, 16.0)]
    {
        for hour in 0..24 {
            let told = warned(1.0, 13.4, &format!("2026-{day}T{hour:02}:00:00"), CLEAR);
            let past_h = (sunrise_h - f64::from(hour)).max(f64::from(hour) - sunset_h);
            if past_h < -0.3 {
                assert!(told.is_empty(), "{day} {hour}: {told:?}");
            } else if past_h > 1.5 {
                let [sky, direct] = &told[..] else { panic!("{day} {hour}: {told:?}") };
                assert!(sky.contains("20000 lx with the sun"), "{sky}");
                assert!(direct.contains("direct = true has no effect"), "{direct}");
            }
        }
    }
    let noon = "2026-06-21T12:00:00";
    let [zone] = &warned(8.0, 13.4, "2026-06-21T16:00:00", CLEAR)[..] else {
        panic!("one warning")
    };
    assert!(zone.contains("set it to about 1, in hours ahead of Greenwich"), "{zone}");
    for (zone_h, longitude_deg) in
        [(5.75, 85.3), (-9.0, -150.0), (8.0, 87.6), (13.0, 178.0), (2.0, -4.0)]
    {
        assert!(
            warned(zone_h, longitude_deg, noon, CLEAR).is_empty(),
            "{zone_h} at {longitude_deg}"
        );
    }
    let [overcast] = &warned(1.0, 13.4, noon, &CLEAR.replace("12", "1"))[..] else {
        panic!("one warning")
    };
    assert!(overcast.contains("CIE type 1,"), "{overcast}");
}

#[test]
fn a_measured_hour_has_its_own_sun() {
    let text = "[sky]\nmodel = \"perez\"\ndirect_normal_w_m2 = 700\ndiffuse_horizontal_w_m2 = 90\n\
        [sun]\naltitude_deg = 40\nazimuth_deg = 170\ndirect = true\n";
    let outside = load_outside(text).unwrap();
    let sun_lx = outside.sun.unwrap().normal_illuminance_lx;
    // Some 100 lm/W of both.
    assert!((60_000.0..90_000.0).contains(&sun_lx), "{sun_lx}");
    let sky_lx = outside.sky.horizontal_illuminance_lx();
    assert!((9_000.0..15_000.0).contains(&sky_lx), "{sky_lx}");
    let hidden = load_outside(&text.replace("direct = true", "direct = false")).unwrap();
    assert!(hidden.sun.is_none());
    let night = load_outside(&text.replace("altitude_deg = 40", "altitude_deg = -3")).unwrap();
    assert!(night.sun.is_none());
}

#[test]
fn what_makes_no_sky_is_refused_with_its_line() {
    let sun = "[sun]\naltitude_deg = 30\nazimuth_deg = 90\n";
    let cases: &[(&str, usize, &str)] = &[
        ("[sun]\naltitude_deg = 30\nazimuth_deg = 0\n", 4, "goes with [sky], which is missing"),
        ("[sky]\ntype = 1\n", 4, "lacks \"model\"; expected \"cie\""),
        ("[sky]\nmodel = \"cei\"\n", 5, "did you mean \"cie\"?"),
        ("[sky]\nmodel = \"panorama\"\n", 4, "lacks \"file\"; expected the name of a panorama"),
        ("[sky]\nmodel = \"cie\"\ntype = 17\n", 6, "is 17; expected 1 to 16"),
        (CLEAR, 6, "depend on the sun; expected [sun]"),
        ("[sky]\nmodel = \"uniform\"\n", 4, "lacks one of horizontal_illuminance_lx"),
        ("[sky]\nmodel = \"uniform\"\nhorizontal_illuminance_lx = -1\n", 6, "0 to 1e9"),
        ("[sky]\nmodel = \"uniform\"\ntype = 5\n", 6, "unknown key \"type\""),
        ("[sky]\nmodel = \"perez\"\ndirect_normal_w_m2 = 1\n", 5, "needs the sun"),
    ];
    let with_sun: &[(&str, usize, &str)] = &[
        ("[sun]\naltitude_deg = 91\nazimuth_deg = 0\n", 9, "is 91; expected"),
        ("[sun]\ntime = 2026-06-21T12:00:00\n", 9, "needs a site; expected [site]"),
        ("[sun]\ntime = 12\n", 9, "needs a site"),
        ("[sun]\naltitude_deg = 30\n", 8, "lacks \"azimuth_deg\""),
        ("[sun]\naltitude_deg = 30\nazimuth_deg = 0\ndirect = true\n", 8, "lacks \"normal_illumi"),
        ("[sun]\naltitude_deg = 30\nazimuth_deg = 0\ndirect = 1\n", 11, "true or false"),
    ];
    let site = "[site]\nlatitude_deg = 91\nlongitude_deg = 0\ntime_zone_h = 0\n";
    let day = "[site]\nlatitude_deg = 9\nlongitude_deg = 0\ntime_zone_h = 0\n";
    let after: &[(String, usize, &str)] = &[
        (format!("{CLEAR}{sun}{site}"), 12, "latitude_deg is 91; expected -90 to 90"),
        (format!("{CLEAR}{sun}[site]\nlatitude_deg = 9\n"), 11, "lacks \"longitude_deg\""),
        (format!("{CLEAR}{sun}[ground]\nreflectance = 2\n"), 12, "is 2; expected a share"),
        (format!("{CLEAR}{sun}[[openings]]\norigin = [0, 0, 0]\n"), 11, "lacks \"u\""),
        (
            format!("{CLEAR}{sun}[[openings]]\norigin = [0, 0, 0]\nu = [1, 0, 0]\nv = [2, 0, 0]\n"),
            11,
            "has no area",
        ),
        (format!("{CLEAR}{day}[sun]\ntime = 12\n"), 13, "expected a date and a time"),
        (format!("{CLEAR}{day}[sun]\ntime = 2026-02-20T12:00:00Z\n"), 13, "the time is"),
    ];
    let own = |cases: &[(&str, usize, &'static str)], before: &str| -> Vec<_> {
        cases
            .iter()
            .map(|(text, line, needle)| (format!("{before}{text}"), *line, *needle))
            .collect()
    };
    let mut all: Vec<(String, usize, &str)> = own(cases, "");
    all.extend(own(with_sun, CLEAR));
    all.extend(after.iter().cloned());
    for (text, line, needle) in all {
        let error = load_outside(&text).expect_err(&text);
        let (found, message) = (error.place().map(|place| place.line), error.to_string());
        assert_eq!(found, Some(line), "{text}: {message}");
        assert!(message.contains(needle), "{text}: {message}");
    }
}
