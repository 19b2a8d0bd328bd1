//! Years on disk: in parts, cut short and gone on with, put together. All end with the same bits.

use crate::support::{Folder, parsed};
use std::fs;

/// Points: more than two blocks, so that parts begin and end within them.
const POINTS: usize = 150;

/// A room that is open on one side, with blinds and lamps, and a day of weather.
pub(crate) fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    let room = "o room\nusemtl floor\nv 0 0 0\nv 6 0 0\nv 6 4 0\nv 0 4 0\nf 1 2 3 4\n\
        usemtl wall\nv 0 4 3\nv 6 4 3\nf 4 3 6 5\n";
    folder.write("room.obj", room);
    let sheet = "usemtl sheet\nv -1 -0.1 0\nv 7 -0.1 0\nv 7 -0.1 4\nv -1 -0.1 4\nf 1 2 3 4\n";
    folder.write("sheet.obj", sheet);
    let mut weather = "place Here\nlatitude 50\nlongitude -10\ntime_zone -15\nsite_elevation 2\n\
        weather_data_file_units 3\n"
        .to_owned();
    for hour in 0..24 {
        let light = match hour {
            7..=9 => "0 9000",
            10..=13 => "50000 14000",
            14..=17 => "20000 8000",
            _ => "0 0",
        };
        weather += &format!("3 20 {hour}.5 {light}\n");
    }
    folder.write("site.wea", weather);
    let project = "[scene]\ngeometry = [\"room.obj\"]\n[weather]\nfile = \"site.wea\"\n[sky]\n\
        model = \"weather\"\n[materials]\nfloor = { reflectance = 0.3 }\n\
        wall = { reflectance = 0.6 }\n[blinds]\ngeometry = [\"sheet.obj\"]\n\
        materials.sheet = { reflectance = 0.3, transmittance = 0.2 }\n[electric_light]\n\
        sensor = \"desk\"\ntarget_lx = 9000\npower_w = 100\n";
    let sensor = |name: &str, height: f64, counts: [usize; 2]| {
        format!(
            "[[sensors]]\nname = \"{name}\"\nkind = \"grid\"\norigin = [0.5, 0.5, {height}]\n\
             u = [5, 0, 0]\nv = [0, 3, 0]\ncounts = [{}, {}]\nnormal = [0, 0, 1]\n",
            counts[0], counts[1]
        )
    };
    let sensors = sensor("floor", 0.1, [10, 9]) + &sensor("desk", 0.8, [10, 6]);
    folder.write("a.toml", project.to_owned() + &sensors);
    folder
}

const YEAR: [&str; 6] = ["annual", "a.toml", "--samples", "64", "--rel-tol", "0.1%"];

/// All files of results, but for who computed and how long.
fn results(folder: &Folder, out: &str) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder.path(out))
        .unwrap()
        .map(|file| {
            let file = file.unwrap();
            let name = file.file_name().into_string().unwrap();
            let mut bytes = fs::read(file.path()).unwrap();
            if name == "annual.json" {
                let mut document = parsed(&String::from_utf8(bytes).unwrap());
                document["run"]["seconds"] = 0.into();
                document["run"]["threads"] = 0.into();
                bytes = document.to_string().into_bytes();
            }
            (name, bytes)
        })
        .collect();
    files.sort();
    files
}

fn expect_the_same(folder: &Folder, out: &str) {
    let [expected, found] = ["whole", out].map(|out| results(folder, out));
    assert_eq!(expected.len(), found.len());
    for ((name, expected), (_, found)) in expected.iter().zip(&found) {
        assert!(expected == found, "{out}: {name} differs");
    }
}

fn simulate(folder: &Folder, more: &[&str], code: i32) -> String {
    let done = folder.quasilux(&[&YEAR[..], more].concat());
    assert_eq!(done.code, Some(code), "{more:?}: {}", done.stderr);
    done.stderr
}

/// The whole year, with a checkpoint, for comparison.
fn whole(name: &str) -> Folder {
    let folder = folder(name);
    simulate(&folder, &["--out", "whole", "--checkpoint", "whole.year"], 3);
    assert_eq!(folder.read("whole/floor.annual.csv").lines().count(), 91);
    folder
}

#[test]
fn parts_make_the_same_year_in_any_order() {
    let folder = whole("annual_parts");
    for part in 0..4 {
        let (shard, file) = (format!("{part}/4"), format!("{part}.year"));
        let threads = (1 + part % 2).to_string();
        let more = ["--shard", &shard, "--checkpoint", &file, "--threads", &threads];
        let told = simulate(&folder, &more, 0);
        let last = POINTS * (part + 1) / 4 - 1;
        assert!(told.contains(&format!("to {last} of {POINTS} in {file}")), "{told}");
    }
    let merge = ["merge", "2.year", "0.year", "3.year", "1.year", "--out", "merged"];
    let done = folder.quasilux(&merge);
    assert_eq!(done.code, Some(3), "{}", done.stderr);
    expect_the_same(&folder, "merged");
    let done = folder.quasilux(&["merge", "whole.year", "--out", "one", "--json"]);
    assert_eq!(done.code, Some(3), "{}", done.stderr);
    assert!(parsed(&done.stdout)["complete"].as_bool().unwrap());
    expect_the_same(&folder, "one");
    let again = folder.quasilux(&["resume", "1.year"]);
    assert_eq!(again.code, Some(0), "{}", again.stderr);
    assert!(again.stderr.contains("points 37 to 74 of 150 in 1.year"), "{}", again.stderr);
    let other = ["--shard", "1/4", "--checkpoint", "other.year", "--seed", "2"];
    simulate(&folder, &other, 0);
    let bytes = fs::read(folder.path("1.year")).unwrap();
    folder.write("short.year", &bytes[..bytes.len() - 1]);
    folder.write("empty.year", "");
    for (parts, needle) in [
        (&["0.year", "1.year", "3.year"][..], "points are missing"),
        (&["1.year", "2.year", "3.year"], "expected 0: points are missing"),
        (&["0.year", "1.year", "2.year"], "ends before point 112 of 150"),
        (&["0.year", "1.year", "1.year", "2.year", "3.year"], "points come twice"),
        (&["0.year", "other.year", "2.year", "3.year"], "a setting or the seed differs"),
        (&["0.year", "short.year", "2.year", "3.year"], "cut short or changed"),
        (&["0.year", "empty.year"], "no file of the format quasilux-year/1"),
    ] {
        let refused = folder.quasilux(&[&["merge"], parts, &["--out", "refused"]].concat());
        assert_eq!(refused.code, Some(2), "{parts:?}: {}", refused.stderr);
        assert!(refused.stderr.contains(needle), "{parts:?}: {}", refused.stderr);
    }
    assert!(!folder.path("refused/hours.npy").exists());
}

#[test]
fn years_that_were_cut_short_go_on_with_the_same_bits() {
    let folder = whole("annual_resumed");
    let bytes = fs::read(folder.path("whole.year")).unwrap();
    let simulated = |out: &str| {
        let done = folder.quasilux(&["resume", "cut.year", "--out", out, "--threads", "1"]);
        assert_eq!(done.code, Some(3), "{}", done.stderr);
        expect_the_same(&folder, out);
        done.stderr
    };
    // Behind the heading; within the first block and the second; all of it.
    let heading =
        bytes.windows(16).skip(16).position(|it| it == b"quasilux-year/1\n").unwrap() + 16;
    for (length, is_damaged) in [
        (heading, false),
        (heading + 77, true),
        (bytes.len() / 2, true),
        (bytes.len() - 1, true),
        (bytes.len(), false),
    ] {
        folder.write("cut.year", &bytes[..length]);
        let told = simulated(&format!("of_{length}"));
        assert_eq!(told.contains("cut short or changed"), is_damaged, "{length}: {told}");
        let again = fs::read(folder.path("cut.year")).unwrap();
        assert!(again.len().abs_diff(bytes.len()) < 1000, "{length}");
    }
    folder.write("cut.year", &bytes[..heading / 2]);
    let refused = folder.quasilux(&["resume", "cut.year"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
}

#[test]
fn years_that_are_not_over_are_not_overwritten() {
    let folder = whole("annual_kept");
    simulate(&folder, &["--out", "again", "--checkpoint", "whole.year"], 3);
    let bytes = fs::read(folder.path("whole.year")).unwrap();
    folder.write("whole.year", &bytes[..bytes.len() / 2]);
    let told = simulate(&folder, &["--checkpoint", "whole.year"], 2);
    assert!(told.contains("go on with `quasilux resume whole.year`"), "{told}");
    let told = simulate(&folder, &["--checkpoint", "room.obj"], 2);
    assert!(told.contains("no file of the format"), "{told}");
    let told = simulate(&folder, &["--checkpoint", "a.toml"], 2);
    assert!(told.contains("is read by this command"), "{told}");
    let told = simulate(&folder, &["--shard", "0/2"], 2);
    assert!(told.contains("--checkpoint"), "{told}");
    let told = simulate(&folder, &["--shard", "0/151", "--checkpoint", "new.year"], 2);
    assert!(told.contains("more parts than the 150 sensor points"), "{told}");
    folder.write("site.wea", folder.read("site.wea").replace("9000", "9001"));
    let refused = folder.quasilux(&["resume", "whole.year"]);
    assert_eq!(refused.code, Some(2), "{}", refused.stderr);
    assert!(refused.stderr.contains("site.wea has changed"), "{}", refused.stderr);
}
