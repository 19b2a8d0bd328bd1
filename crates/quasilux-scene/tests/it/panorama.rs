//! `[sky] model = "panorama"`: the sky of a picture.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use quasilux_scene::{LoadError, Loaded, SkyModel};
use std::f64::consts::PI;

/// A picture of 8 x 4 pixels: those of the upper half right of the middle, in the east, are twice
/// as bright as the others.
fn picture() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n".to_vec();
    for row in 0..4 {
        for column in 0..8 {
            let exponent = 132 + u8::from(row < 2 && (4..8).contains(&column));
            bytes.extend_from_slice(&[128, 128, 128, exponent]);
        }
    }
    bytes
}

/// Luminances of the two kinds of pixels in cd/m2.
const DIM: f64 = 179.0 * 128.5 / 16.0;

const SKY: &str = "[sky]\nmodel = \"panorama\"\nfile = \"sky.hdr\"\n";

/// The small project under another sky, which begins on line 4.
fn load_under(sky: &str) -> Result<Loaded, LoadError> {
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2.0]\nintensity_cd = 100\n";
    let mut dark = picture();
    let header = dark.len() - 4 * 8 * 4;
    dark[header..].fill(0);
    let files = MapFiles::room().with("sky.hdr", picture()).with("dark.hdr", dark);
    let files = files.with("other.hdr", "#?RADIANCE\n\n-Y 4 +X 4\n");
    load_text(&PROJECT.replace(lamp, sky), &files)
}

fn load_sky(keys: &str) -> Result<Loaded, LoadError> {
    load_under(&format!("{SKY}{keys}"))
}

fn luminances(keys: &str) -> [f64; 4] {
    let outside = load_sky(keys).unwrap().scene.environment.expect("a sky");
    let towards = |x: f64, y: f64| outside.luminance_cd_m2(glam::DVec3::new(x, y, 1.0).normalize());
    // Between the edges of pixels: from north-north-east on, clockwise.
    [towards(0.3, 0.7), towards(0.7, -0.3), towards(-0.3, -0.7), towards(-0.7, 0.3)]
}

#[test]
fn the_middle_is_north_and_azimuths_grow_to_the_right() {
    let near = |found: [f64; 4], expected: [f64; 4]| {
        assert!(found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{found:?}");
    };
    near(luminances(""), [2.0 * DIM, 2.0 * DIM, DIM, DIM]);
    near(luminances("middle_azimuth_deg = 90\n"), [DIM, 2.0 * DIM, 2.0 * DIM, DIM]);
    // North to the west of +y: the east is at +y.
    near(luminances("[site]\nnorth_deg = 90\n"), [2.0 * DIM, DIM, DIM, 2.0 * DIM]);
}

#[test]
fn a_picture_is_as_bright_as_it_says_or_scaled() {
    let outside = |keys: &str| load_sky(keys).unwrap().scene.environment.expect("a sky");
    let own = outside("").sky.horizontal_illuminance_lx();
    assert!((own / (1.5 * PI * DIM) - 1.0).abs() < 1e-6, "{own}");
    let scaled = outside("horizontal_illuminance_lx = 9000\n[ground]\nreflectance = 0.5\n");
    assert!((scaled.sky.horizontal_illuminance_lx() - 9000.0).abs() < 1e-6);
    // The lower half of the picture is not the ground.
    assert!((scaled.luminance_cd_m2(-glam::DVec3::Z) - 4500.0 / PI).abs() < 1e-6);
    let zenith = outside("zenith_luminance_cd_m2 = 100\n").sky.zenith_luminance_cd_m2();
    assert!((zenith - 100.0).abs() < 1e-9);
    let sun = "[sun]\naltitude_deg = 30\nazimuth_deg = 90\ndirect = true\n\
        normal_illuminance_lx = 1000\n";
    let loaded = load_sky(sun).unwrap();
    assert_eq!(
        loaded.scene.environment.as_ref().unwrap().sun.unwrap().normal_illuminance_lx,
        1000.0
    );
    assert_eq!(
        loaded.sky.as_ref().unwrap().model,
        SkyModel::Panorama { file: "sky.hdr".to_owned() }
    );
    assert_eq!(warnings_of(&loaded), Vec::<String>::new());
}

#[test]
fn what_is_no_picture_is_refused_with_its_place() {
    let cases = [
        ("sky.hdr", "other.hdr", "other.hdr:3:1: ", "a picture of 4 x 4 pixels"),
        ("sky.hdr", "dark.hdr", "room.toml:6:8: ", "the upper half of \"dark.hdr\" is dark"),
        ("sky.hdr", "room.obj", "room.obj:1:1: ", "#?RADIANCE"),
        ("sky.hdr", "none.hdr", "room.toml:6:8: ", "none.hdr"),
        ("file =", "fyle =", "room.toml:6:1: ", "did you mean \"file\"?"),
    ];
    for (from, to, place, words) in cases {
        let message = load_under(&SKY.replace(from, to)).unwrap_err().to_string();
        assert!(message.starts_with(place) && message.contains(words), "{message}");
    }
    for (keys, words) in [
        ("middle_azimuth_deg = 361\n", "degrees from north"),
        ("horizontal_illuminance_lx = 1\nzenith_luminance_cd_m2 = 1\n", "exclude each other"),
        ("type = 1\n", "unknown key \"type\""),
        ("horizontal_illuminance_lx = -1\n", "0 to 1e9"),
    ] {
        let message = load_sky(keys).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
}
