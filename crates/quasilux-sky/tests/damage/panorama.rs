//! Panoramas: small undamaged ones, and what must hold of the reader's answer to any bytes.

use super::measured;
use quasilux_sky::Panorama;
use quasilux_stats::damage::{Outcome, Seeds, check_message};

/// What the documentation of the reader states: bytes for each pixel above the horizon, for each
/// byte of a file that is refused (a row of the widest picture takes no less than 12), and besides.
const BYTES_PER_PIXEL: usize = 12;
const BYTES_PER_BYTE: usize = 16_384;
const BYTES_BESIDES: usize = 256 << 10;

/// A picture in each of the three ways in which pixels are written.
pub(crate) fn samples() -> Seeds {
    let head = |more: &str, format: &str, height: usize| {
        let width = 2 * height;
        format!("#?RADIANCE\n{more}FORMAT=32-bit_rle_{format}\n\n-Y {height} +X {width}\n")
    };
    let with = |head: String, pixels: &[u8]| [head.as_bytes(), pixels].concat();
    let flat: Vec<u8> = (0..32).flat_map(|k| [k, 90, 7 * k, 128 + k % 3]).collect();
    let run = [[200, 100, 50, 130], [1, 1, 1, 7]].as_flattened().repeat(4);
    let plane = [136, 77, 8, 1, 2, 3, 4, 5, 6, 7, 8];
    let scanline = [&[2, 2, 0, 16][..], &plane, &plane, &plane, &plane].concat();
    Seeds::new(vec![
        with(head("", "rgbe", 4), &flat),
        with(head("EXPOSURE=2\n", "xyze", 4), &run),
        with(head("COLORCORR=1 2 3\n", "rgbe", 8), &scanline.repeat(8)),
    ])
}

/// Reads any bytes and checks the answer: no more memory than stated, messages with a line of the
/// header, and a sky of numbers.
pub(crate) fn examine(bytes: &[u8]) -> Outcome {
    let (answer, peak_bytes) = measured(|| Panorama::parse(bytes));
    let is_read = answer.is_ok();
    let max = match answer {
        Ok(read) => {
            for warning in &read.warnings {
                check_message(warning.line(), warning.column(), &warning.to_string(), bytes);
            }
            let lx = read.panorama.horizontal_illuminance_lx();
            assert!(lx.is_finite() && lx >= 0.0, "{lx} lx");
            let bright = read.panorama.bright_pixels();
            assert!(bright.iter().all(|pixel| pixel.solid_angle_sr > 0.0));
            BYTES_PER_PIXEL * read.panorama.pixels() + BYTES_BESIDES
        }
        Err(error) => {
            check_message(error.line(), error.column(), &error.to_string(), bytes);
            BYTES_PER_BYTE * bytes.len() + BYTES_BESIDES
        }
    };
    assert!(peak_bytes <= max, "{peak_bytes} bytes for a file of {}, over {max}", bytes.len());
    Outcome { is_read, peak_bytes }
}
