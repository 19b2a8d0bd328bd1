//! Good inputs for years of daylight, measured surfaces, cases and binary geometry, from which bad
//! ones are made.

use super::limited;
use super::seeds::{Seed, TRIANGLE, gltf};
use crate::scenes::{Look, write_room};
use crate::support::Folder;
use std::f64::consts::PI;
use std::fmt::Write;
use std::fs;

const EPW: &str = "LOCATION,Nowhere,-,DEU,made up,000000,52.5,13.4,1.0,34.0\n\
    DESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\n\
    HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\nCOMMENTS 1,made up\nCOMMENTS 2,\n\
    DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";
const WEA: &str = "place Here\nlatitude 52.5\nlongitude -13.4\ntime_zone -15\n\
    site_elevation 34\nweather_data_file_units 1\n";
const CASE: &str = "name = \"spot\"\nsource = \"closed form\"\nproject = \"../../quick.toml\"\n\
    [[expect]]\nsensor = \"probes\"\nfigure = \"illuminance_lx\"\npoint = 0\nvalue = 500\n\
    tolerance_rel = 0.9\nwhy = \"none\"\n";
const ANNUAL: [&str; 8] =
    ["annual", "wea.toml", "--out", "out", "--samples", "2", "--threads", "2"];

/// Direct and diffuse irradiances of an hour.
fn light(hour: usize) -> [&'static str; 2] {
    match hour {
        7..=9 => ["0", "90"],
        10..=13 => ["500", "140"],
        14..=17 => ["200", "80"],
        _ => ["0", "0"],
    }
}

/// A floor under the sky of a day, with blinds, lamps and people by schedules.
fn write_year(folder: &Folder) {
    let [mut epw, mut wea] = [EPW, WEA].map(str::to_owned);
    let mut schedule = "hour,blinds,people\n".to_owned();
    for hour in 0..24 {
        let [direct, diffuse] = light(hour);
        let number = hour + 1;
        writeln!(wea, "6 21 {hour}.5 {direct} {diffuse}").expect("text takes everything");
        let row = "9.0,7.0,87,102000,0,0,305,0";
        writeln!(epw, "2026,6,21,{number},60,?9?9,{row},{direct},{diffuse},0,0")
            .expect("text takes everything");
        writeln!(schedule, "{hour},{},{}", hour % 2, usize::from(hour > 8))
            .expect("text takes everything");
    }
    folder.write("site.epw", epw);
    folder.write("site.wea", wea);
    folder.write("rota.csv", schedule);
    folder.write("floor.obj", "usemtl floor\nv 0 0 0\nv 6 0 0\nv 6 4 0\nv 0 4 0\nf 1 2 3 4\n");
    folder.write("shade.obj", "usemtl shade\nv 0 0 2\nv 6 0 2\nv 6 4 2\nv 0 4 2\nf 1 2 3 4\n");
    let project = "[scene]\ngeometry = [\"floor.obj\"]\n[weather]\nfile = \"site.wea\"\n\
        [sky]\nmodel = \"weather\"\n[sun]\ntime = 2026-06-21T12:10:00\ndirect = true\n\
        [materials]\nfloor = { reflectance = 0.3 }\n\
        [annual]\nschedule = \"rota.csv\"\ncolumn = \"people\"\n\
        [blinds]\ngeometry = [\"shade.obj\"]\ncontrol = \"schedule\"\nschedule = \"rota.csv\"\n\
        column = \"blinds\"\nmaterials.shade = { reflectance = 0.3, transmittance = 0.2 }\n\
        [electric_light]\nsensor = \"desk\"\ntarget_lx = 9000\npower_w = 100\n\
        [[sensors]]\nname = \"desk\"\nkind = \"grid\"\norigin = [1, 1, 0.8]\nu = [4, 0, 0]\n\
        v = [0, 2, 0]\ncounts = [2, 1]\nnormal = [0, 0, 1]\n[simulation]\nreplicates = 4\n";
    folder.write("wea.toml", project);
    folder.write("epw.toml", project.replace("site.wea", "site.epw"));
}

/// Few values over half angles, all the same.
fn merl() -> Vec<u8> {
    let counts = [4_u32, 3, 2].map(u32::to_le_bytes).concat();
    [counts, 300_f64.to_le_bytes().repeat(3 * 4 * 3 * 2)].concat()
}

fn astm() -> String {
    let mut text = "Source: none\nNUM_POINTS 1\nVARS theta_i,phi_i,theta_s,phi_s,BRDF\n".to_owned();
    for theta_i in [0.0, 0.6, 1.2] {
        for theta_s in [0.0, 0.5, 1.0, 1.5] {
            for phi_s in [0.0, 1.05, 2.1, PI] {
                writeln!(text, "{theta_i},{PI:.7},{theta_s},{phi_s:.7},0.1")
                    .expect("text takes everything");
            }
        }
    }
    text
}

/// The binary form of glTF: a heading, then chunks.
fn glb() -> Vec<u8> {
    let chunk = |kind: &[u8; 4], mut bytes: Vec<u8>, filler: u8| {
        bytes.resize(bytes.len().next_multiple_of(4), filler);
        let length = u32::try_from(bytes.len()).expect("it is short").to_le_bytes();
        [&length[..], kind, &bytes].concat()
    };
    let text = gltf("{\"byteLength\": 36}").into_bytes();
    let triangle = TRIANGLE.map(f32::to_le_bytes).concat();
    let chunks = [chunk(b"JSON", text, b' '), chunk(b"BIN\0", triangle, 0)].concat();
    let length = u32::try_from(12 + chunks.len()).expect("it is short").to_le_bytes();
    [&b"glTF\x02\0\0\0"[..], &length, &chunks].concat()
}

/// A folder in which all commands of all seeds do well, as far as they can, and the seeds.
pub(super) fn seeds() -> (Folder, Vec<Seed>) {
    let folder = Folder::new("attacks_years");
    write_room(&folder, "room", &Look::GREY);
    write_year(&folder);
    folder.write("tiny.binary", merl());
    folder.write("list.astm", astm());
    folder.write("sails.glb", glb());
    folder.write("cases/cases/spot.toml", CASE);
    let quick = folder.read("room.toml").replace("rel_tol = 0.1", "rel_tol = \"90%\"");
    folder.write("quick.toml", quick);
    let sails = folder.read("room.toml").replace("\"room.obj\"", "\"room.obj\", \"sails.glb\"");
    folder.write("sails.toml", sails);
    let kept = [&ANNUAL[..], &["--checkpoint", "a.year", "--quiet"]].concat();
    let run = limited(&folder, &kept);
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    let of_epw = ANNUAL.map(|word| if word == "wea.toml" { "epw.toml" } else { word }).to_vec();
    let at = |file| vec!["sky", "--weather", file, "--time", "2026-06-21T12:30"];
    let year = || vec![ANNUAL.to_vec(), vec!["check", "wea.toml", "--out", "out"]];
    let run = vec!["run", "sails.toml", "--out", "out", "--samples", "2"];
    let bsdf = |file| vec![vec!["bsdf", file, "--json"], vec!["bsdf", file, "--svg", "b.svg"]];
    let list = [
        ("site.epw", vec![of_epw, at("site.epw"), vec!["check", "epw.toml", "--out", "out"]]),
        ("site.wea", [year(), vec![at("site.wea")]].concat()),
        ("wea.toml", [year(), vec![vec!["sky", "wea.toml"]]].concat()),
        ("rota.csv", year()),
        ("shade.obj", year()),
        ("a.year", vec![vec!["resume", "a.year"], vec!["merge", "a.year", "--out", "out"]]),
        ("tiny.binary", bsdf("tiny.binary")),
        ("list.astm", bsdf("list.astm")),
        ("sails.glb", vec![run]),
        ("cases/cases/spot.toml", vec![vec!["validate", "cases"]]),
    ];
    for (file, commands) in &list {
        for command in commands {
            let run = limited(&folder, command);
            assert!(matches!(run.code, Some(0 | 3)), "{file}: {command:?}: {}", run.stderr);
        }
    }
    let seed = |(file, commands)| {
        let bytes = fs::read(folder.path(file)).expect("it was made");
        Seed { file, bytes, commands }
    };
    let seeds = list.into_iter().map(seed).collect();
    (folder, seeds)
}
