//! Any bytes give weather or a panorama, or an error with its position, in memory bounded by their
//! number.

mod damage;

use damage::{panorama, weather};
use quasilux_stats::damage::{Outcome, Outcomes, Seeds, examine_damaged};

/// Damaged files of each kind; `examples/mutate.rs` runs any number of them.
const FILES: u64 = 20_000;

fn expect_read_or_refused(seeds: &Seeds, examine: fn(&[u8]) -> Outcome) {
    assert!(seeds.files().iter().all(|file| examine(file).is_read));
    let Outcomes { read, max_bytes } = examine_damaged(seeds, 0..FILES, examine);
    println!("{read} of {FILES} load; at most {max_bytes} bytes allocated at one time");
    assert!(read > FILES / 50 && read < FILES - FILES / 20, "{read} load");
}

#[test]
fn damaged_weather_never_panics() {
    expect_read_or_refused(&weather::seeds(), weather::examine);
    const LENGTH: usize = 1 << 20;
    let wea = "place x\nlatitude 0\nlongitude 0\ntime_zone 0\nsite_elevation 0\n\
               weather_data_file_units 1\n";
    for text in [
        "\n".repeat(LENGTH),
        wea.to_owned() + &"\n".repeat(LENGTH),
        wea.to_owned() + &"1 1 .5 1 1\n".repeat(LENGTH / 11),
        "LOCATION".to_owned() + &",".repeat(LENGTH),
        "LOCATION\n".to_owned() + &",\n".repeat(LENGTH / 2),
        format!("place {}", "9".repeat(LENGTH)),
    ] {
        weather::examine(text.as_bytes());
    }
    weather::examine(&[&b"\xFF\xFE"[..], &b"\x11\x11".repeat(LENGTH / 2)].concat());
    weather::examine(&b"\xE9\n".repeat(LENGTH / 2));
}

#[test]
fn damaged_panoramas_never_panic() {
    expect_read_or_refused(&panorama::samples(), panorama::examine);
    // The widest picture in the fewest bytes: a pixel a row that is repeated.
    let row = [[128, 128, 128, 128], [1, 1, 1, 255], [1, 1, 1, 63]];
    let head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8192 +X 16384\n";
    for rows in [100, 8192] {
        let bytes = [head.as_bytes(), &row.as_flattened().repeat(rows)].concat();
        assert_eq!(panorama::examine(&bytes).is_read, rows == 8192);
    }
    panorama::examine(&b"\n".repeat(1 << 20));
    panorama::examine(&[b"#?RADIANCE\n", &b"EXPOSURE=2\n".repeat(1 << 16)[..]].concat());
}
