//! `[weather]`: the sky of an interval of a weather file.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{LoadError, Loaded, SkyModel};
use quasilux_sky::{LocalTime, Weather};

/// A morning and a night; West is positive.
const WEA: &str = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
    site_elevation 2\nweather_data_file_units 1\n3 20 3.5 0 0\n3 20 11.5 700 90\n\
    3 20 12.5 650 120\n";

/// The lines of a project without lamps: what is outside begins on line 4.
fn project(outside: &str) -> String {
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100\n";
    let project = PROJECT.replace(lamp, outside);
    assert_ne!(project, PROJECT);
    project
}

fn load_with(outside: &str) -> Result<Loaded, LoadError> {
    let epw = format!("LOCATION,There\n{WEA}");
    let files = MapFiles::room().with("site.wea", WEA).with("bad.epw", epw);
    load_text(&project(outside), &files)
}

const SKY: &str = "[weather]\nfile = \"site.wea\"\n[sky]\nmodel = \"weather\"\n";

#[test]
fn a_time_takes_its_interval_from_the_file() {
    let text = format!("{SKY}[sun]\ntime = 2031-03-20T11:00:00\ndirect = true\n");
    let loaded = load_with(&text).unwrap();
    let outside = loaded.scene.environment.as_ref().unwrap();
    let weather = Weather::parse(WEA.as_bytes()).unwrap().weather;
    let expected = weather.sky_of(&weather.hours[1]).unwrap().unwrap();
    assert_eq!(outside.sky, expected.sky);
    let sun = outside.sun.unwrap();
    assert_eq!(sun.centre, expected.sun);
    assert_eq!(sun.normal_illuminance_lx, expected.sun_normal_illuminance_lx);
    let facts = loaded.sky.clone().unwrap();
    assert_eq!(facts.model, SkyModel::Weather { file: "site.wea".to_owned() });
    let middle: LocalTime = "2002-03-20T11:30:00".parse().unwrap();
    assert_eq!((facts.time, facts.sun), (Some(middle), Some(expected.sun)));
    assert_eq!(loaded.scene.weather, Some(weather));
    let warnings = warnings_of(&loaded);
    assert!(warnings.len() == 1 && warnings[0].starts_with("site.wea:1:1: "), "{warnings:?}");
    // Every instant of the interval has the same sky, the next one another.
    let later = load_with(&text.replace("11:00:00", "11:59:59")).unwrap().scene.environment;
    assert_eq!(later.unwrap().sky, outside.sky);
    let next = load_with(&text.replace("11:00:00", "12:00:00")).unwrap().scene.environment;
    assert_ne!(next.unwrap().sky, outside.sky);
    let hidden = load_with(&text.replace("direct = true\n", "")).unwrap().scene.environment;
    assert!(hidden.unwrap().sun.is_none());
}

#[test]
fn nights_and_whole_years_are_dark() {
    let night = load_with(&format!("{SKY}[sun]\ntime = 2026-03-20T03:10:00\ndirect = true\n"));
    let night = night.unwrap();
    assert!(night.scene.environment.as_ref().unwrap().is_dark());
    assert!(night.sky.as_ref().unwrap().sun.unwrap().altitude_deg < 0.0);
    let warnings = warnings_of(&night).join("\n");
    assert!(warnings.contains("room.toml:9:8: nothing shines at this time"), "{warnings}");
    for rest in ["", "[sun]\ndirect = true\n", "[site]\nnorth_deg = 30\n"] {
        let year = load_with(&format!("{SKY}{rest}")).unwrap();
        assert!(year.scene.environment.as_ref().unwrap().is_dark(), "{rest}");
        assert_eq!(year.scene.weather.as_ref().unwrap().hours.len(), 3);
        assert!(year.sky.unwrap().lacks_time());
    }
}

#[test]
fn a_site_may_only_repeat_that_of_the_file() {
    let with = |latitude: f64, longitude: f64, zone: f64| {
        load_with(&format!(
            "{SKY}[site]\nlatitude_deg = {latitude}\nlongitude_deg = {longitude}\n\
             time_zone_h = {zone}\nnorth_deg = 12\n"
        ))
    };
    let same = with(37.7, -122.25, -8.0).unwrap().scene.environment.unwrap();
    assert_eq!(same.north_deg, 12.0);
    for (latitude, longitude, zone) in
        [(37.72, 122.22, -8.0), (38.72, -122.22, -8.0), (37.72, -122.22, -7.0)]
    {
        let error = with(latitude, longitude, zone).unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with("room.toml:8:1: [site] is at"), "{message}");
        assert!(message.contains("is of (37.72, -122.22, -8 h)"), "{message}");
    }
}

#[test]
fn what_gives_no_weather_is_refused_with_its_place() {
    let uniform = "[sky]\nmodel = \"uniform\"\nhorizontal_illuminance_lx = 1\n";
    let cases: &[(String, &str, &str)] = &[
        ("[weather]\nfile = \"site.wea\"\n".to_owned(), "room.toml:4:1: ", "goes with [sky]"),
        ("[sky]\nmodel = \"weather\"\n".to_owned(), "room.toml:5:9: ", "needs a weather file"),
        (format!("{uniform}[weather]\nfile = \"site.wea\"\n"), "room.toml:7:1: ", "is \"uniform\""),
        (SKY.replace("file =", "fille ="), "room.toml:5:1: ", "did you mean \"file\"?"),
        (SKY.replace("file = \"site.wea\"", "file = 1"), "room.toml:5:8: ", "EPW or WEA"),
        (SKY.replace("site.wea", "none.epw"), "room.toml:5:8: ", "none.epw"),
        (SKY.replace("site.wea", "room.obj"), "room.obj:1:1: ", "LOCATION (EPW) or place (WEA)"),
        (SKY.replace("site.wea", "bad.epw"), "bad.epw:1:15: ", "latitude"),
        (format!("{SKY}type = 1\n"), "room.toml:8:1: ", "unknown key \"type\""),
        (format!("{SKY}[sun]\naltitude_deg = 1\n"), "room.toml:9:16: ", "not \"altitude_deg\""),
        (format!("{SKY}[sun]\ntime = \"2026-02-29T12:00\"\n"), "room.toml:9:8: ", "calendar"),
        (format!("{SKY}[sun]\ntime = 2024-02-29T12:00:00\n"), "room.toml:9:8: ", "02-29 12:00"),
        (format!("{SKY}[sun]\ntime = 2026-03-20T13:00:00\n"), "room.toml:9:8: ", "no interval"),
    ];
    for (outside, place, needle) in cases {
        let message = load_with(outside).expect_err(outside).to_string();
        assert!(message.starts_with(place) && message.contains(needle), "{outside}{message}");
    }
}

/// A leap day and a value that is missing, in a file of EnergyPlus.
#[test]
fn leap_days_and_missing_values_are_told_apart() {
    let row = |month: u32, day: u32, hour: u32, direct: u32| {
        let before = "9,".repeat(8);
        format!("2024,{month},{day},{hour},0,x,10,7,{before}{direct},90\n").replacen(
            "x,10,7,9,",
            "x,10,7,",
            1,
        )
    };
    let head = "LOCATION,A,B,C,D,E,37.72,-122.22,-8,2\n";
    let others = "X\n".repeat(6);
    let periods = "DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
    let rows = [row(2, 29, 12, 700), row(2, 29, 13, 9999)].concat();
    let text = format!("{head}{others}{periods}{rows}");
    let files = MapFiles::room().with("site.epw", text);
    let load = |time: &str| {
        let sky = SKY.replace("site.wea", "site.epw");
        load_text(&project(&format!("{sky}[sun]\ntime = {time}\n")), &files)
    };
    let leap = load("2024-02-29T11:20:00").unwrap().sky.unwrap();
    assert_eq!(leap.time, Some("2000-02-29T11:30:00".parse().unwrap()));
    let message = load("2024-02-29T12:20:00").unwrap_err().to_string();
    assert!(message.starts_with("room.toml:9:8: \"site.epw\" has no direct or no"), "{message}");
}
