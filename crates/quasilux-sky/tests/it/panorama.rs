//! Panoramas: what their files mean, and the integral of their pixels.

use libm::{asin, cos, ldexp, sin};
use quasilux_sky::{Distribution, Panorama, PanoramaWarning, Sky, SkyLevel, SkyPoint};
use quasilux_stats::SplitMix64;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// How a scanline is written.
#[derive(Clone, Copy, PartialEq)]
enum Writing {
    Flat,
    Repeats,
    Planes,
}

/// A picture file.
fn picture(header: &str, width: usize, pixels: &[[u8; 4]], writing: Writing) -> Vec<u8> {
    let height = pixels.len() / width;
    let mut bytes =
        format!("#?RADIANCE\n{header}FORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n")
            .into_bytes();
    for row in pixels.chunks(width) {
        match writing {
            Writing::Flat => bytes.extend_from_slice(row.as_flattened()),
            Writing::Repeats => {
                for run in row.chunk_by(|a, b| a == b) {
                    bytes.extend_from_slice(&run[0]);
                    let mut more = run.len() - 1;
                    while more > 0 {
                        bytes.extend_from_slice(&[1, 1, 1, (more % 256) as u8]);
                        more /= 256;
                    }
                }
            }
            Writing::Planes => {
                bytes.extend_from_slice(&[2, 2, (width / 256) as u8, (width % 256) as u8]);
                for channel in 0..4 {
                    let plane: Vec<u8> = row.iter().map(|pixel| pixel[channel]).collect();
                    for run in plane.chunk_by(|a, b| a == b) {
                        for part in run.chunks(127) {
                            // Single bytes are no runs.
                            let code = if part.len() > 2 { 128 + part.len() } else { part.len() };
                            bytes.push(code as u8);
                            let count = if part.len() > 2 { 1 } else { part.len() };
                            bytes.extend_from_slice(&part[..count]);
                        }
                    }
                }
            }
        }
    }
    bytes
}

/// Pixels in runs; none looks like a mark of a run.
fn random_pixels(count: usize, numbers: &mut SplitMix64) -> Vec<[u8; 4]> {
    let mut pixels = Vec::new();
    while pixels.len() < count {
        let colour = [0, 1, 2].map(|_| 3 + numbers.below(253) as u8);
        let pixel = [colour[0], colour[1], colour[2], 120 + numbers.below(20) as u8];
        let longest = if numbers.below(4) == 0 { 700 } else { 3 };
        let length = 1 + numbers.below(longest);
        pixels.extend(std::iter::repeat_n(pixel, length.min(count - pixels.len())));
    }
    pixels
}

/// What Radiance takes a pixel for.
fn luminance([r, g, b, exponent]: [u8; 4]) -> f64 {
    let value = |mantissa: u8| ldexp(f64::from(mantissa) + 0.5, i32::from(exponent) - 136);
    179.0 * (0.265 * value(r) + 0.670 * value(g) + 0.065 * value(b))
}

fn near(found: f64, expected: f64, share: f64) -> bool {
    (found - expected).abs() <= share * expected.abs()
}

/// Three ways of writing the same pixels, each looked up at places within its pixel, the middle of
/// the picture at some azimuth.
#[test]
fn pixels_are_where_they_belong() {
    let mut numbers = SplitMix64::new(1);
    for (width, writing) in [
        (8, Writing::Planes),
        (600, Writing::Planes),
        (2, Writing::Flat),
        (14, Writing::Flat),
        (90, Writing::Repeats),
        (1400, Writing::Repeats),
    ] {
        let height = width / 2;
        let pixels = random_pixels(width * height, &mut numbers);
        let bytes = picture("", width, &pixels, writing);
        let middle_deg = numbers.below(720) as f64 - 360.0;
        let panorama = Panorama::parse(&bytes).unwrap().panorama.with_middle_at(middle_deg);
        for _ in 0..200 {
            let (row, column) = (numbers.below(height.div_ceil(2)), numbers.below(width));
            let inside = [0, 1].map(|_| 0.01 + 0.98 * numbers.below(1000) as f64 / 1000.0);
            let altitude_deg = 90.0 - 180.0 * (row as f64 + inside[0]) / height as f64;
            let azimuth_deg =
                360.0 * (column as f64 + inside[1]) / width as f64 - 180.0 + middle_deg;
            if altitude_deg <= 0.0 {
                continue;
            }
            let direction = SkyPoint { altitude_deg, azimuth_deg }.to_direction();
            let found = panorama.luminance_cd_m2(direction);
            let expected = luminance(pixels[row * width + column]);
            assert!(near(found, expected, 1e-6), "{width}: {found}, not {expected}");
            assert_eq!(panorama.luminance_cd_m2([direction[0], direction[1], -0.1]), 0.0);
        }
    }
}

/// The integral of one luminance is pi times it, and that of random ones the sum over the solid
/// angle of each pixel, by the projected area of its piece of the sphere.
#[test]
fn illuminances_are_exact() {
    let even = picture("", 64, &[[128, 128, 128, 136]; 64 * 32], Writing::Planes);
    let even = Panorama::parse(&even).unwrap().panorama;
    let expected = PI * 179.0 * 128.5;
    assert!(near(even.horizontal_illuminance_lx(), expected, 1e-12));
    let mut numbers = SplitMix64::new(2);
    for (width, height) in [(2, 1), (10, 5), (60, 30), (126, 63)] {
        let pixels = random_pixels(width * height, &mut numbers);
        let panorama = Panorama::parse(&picture("", width, &pixels, Writing::Flat)).unwrap();
        let panorama = panorama.panorama;
        let mut expected = 0.0;
        const PARTS: usize = 400;
        for row in 0..height.div_ceil(2) {
            for column in 0..width {
                let cd_m2 = luminance(pixels[row * width + column]);
                let [top, bottom] = [row, row + 1].map(|row| PI * row as f64 / height as f64);
                let step = (bottom.min(FRAC_PI_2) - top) / PARTS as f64;
                let part = |i: usize| top + (i as f64 + 0.5) * step;
                let projected: f64 = (0..PARTS).map(|i| sin(part(i)) * cos(part(i)) * step).sum();
                expected += cd_m2 * projected * TAU / width as f64;
            }
        }
        let found = panorama.horizontal_illuminance_lx();
        assert!(near(found, expected, 1e-5), "{width}: {found}, not {expected}");
        // A sky of it: as it is, or scaled.
        let sky = |level| Sky::new(Distribution::panorama(panorama.clone()), level).unwrap();
        let own = sky(SkyLevel::Absolute);
        assert_eq!(own.horizontal_illuminance_lx(), found);
        let scaled = sky(SkyLevel::HorizontalIlluminance { lx: 5000.0 });
        let direction = SkyPoint { altitude_deg: 33.0, azimuth_deg: 78.0 }.to_direction();
        let share = scaled.luminance_cd_m2(direction) / own.luminance_cd_m2(direction);
        assert!(near(share, 5000.0 / found, 1e-12));
        let zenith = sky(SkyLevel::ZenithLuminance { cd_m2: 777.0 });
        assert!(near(zenith.zenith_luminance_cd_m2(), 777.0, 1e-12));
    }
}

#[test]
fn headers_say_what_values_mean() {
    let pixels = [[100, 50, 200, 130]; 16 * 8];
    let read = |header: &str| Panorama::parse(&picture(header, 16, &pixels, Writing::Planes));
    let at = SkyPoint { altitude_deg: 50.0, azimuth_deg: 10.0 }.to_direction();
    let cd_m2 = |header: &str| read(header).unwrap().panorama.luminance_cd_m2(at);
    let plain = luminance(pixels[0]);
    assert!(near(cd_m2(""), plain, 1e-6));
    assert!(near(cd_m2("EXPOSURE=2\nEXPOSURE= 4.0\npcomb x.hdr\n"), plain / 8.0, 1e-6));
    let unit = ldexp(1.0, 130 - 136);
    let corrected = 179.0 * unit * (0.265 * 100.5 / 2.0 + 0.670 * 50.5 + 0.065 * 200.5 / 0.5);
    assert!(near(cd_m2("COLORCORR=2 1 0.5\n"), corrected, 1e-6));
    let warned = read("PRIMARIES=.64 .33 .3 .6 .15 .06 .3127 .329\n").unwrap();
    assert_eq!(warned.warnings[0].kind(), PanoramaWarning::Primaries);
    assert_eq!(warned.warnings[0].line(), 2);
    let text = picture("", 16, &pixels, Writing::Planes);
    let xyz = String::from_utf8_lossy(&text[..60]).replace("rgbe", "xyze");
    let end = text.len() - text.windows(2).position(|pair| pair == b"\n\n").unwrap();
    let xyz = [&xyz.as_bytes()[..xyz.find("\n\n").unwrap()], &text[text.len() - end..]].concat();
    let xyz = Panorama::parse(&xyz).unwrap().panorama.luminance_cd_m2(at);
    assert!(near(xyz, 179.0 * 50.5 * unit, 1e-6), "{xyz}");
}

/// The brightest pixel, and the mean of the first row at the zenith itself.
#[test]
fn suns_and_zeniths_are_found() {
    let mut pixels = [[128, 128, 128, 128]; 36 * 18];
    pixels[3 * 36 + 27] = [128, 128, 128, 150];
    pixels[0] = [128, 128, 128, 129];
    let bytes = picture("", 36, &pixels, Writing::Repeats);
    let panorama = Panorama::parse(&bytes).unwrap().panorama.with_middle_at(20.0);
    let brightest = panorama.brightest();
    assert!((brightest.altitude_deg - 55.0).abs() < 1e-9, "{brightest:?}");
    assert!((brightest.azimuth_deg - 115.0).abs() < 1e-9, "{brightest:?}");
    let zenith = panorama.luminance_cd_m2([0.0, 0.0, 1.0]);
    assert!(near(zenith, luminance([128, 128, 128, 128]) * 37.0 / 36.0, 1e-6));
    let text = format!("{panorama:?}");
    assert!(text.len() < 200 && text.contains("width: 36"), "{text}");
    pixels[40] = [128, 129, 128, 128];
    let other = Panorama::parse(&picture("", 36, &pixels, Writing::Flat)).unwrap().panorama;
    assert_ne!(format!("{:?}", other.with_middle_at(20.0)), text);
    assert!((asin(panorama.brightest().to_direction()[2]).to_degrees() - 55.0).abs() < 1e-9);
}

#[test]
fn other_files_are_refused_with_their_line() {
    let good = picture("", 16, &[[9, 9, 9, 130]; 16 * 8], Writing::Planes);
    let text = |text: &str| text.as_bytes().to_vec();
    let head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
    let mut wrong_width = good.clone();
    let at = good.windows(2).position(|pair| pair == [2, 2]).unwrap();
    wrong_width[at + 3] = 15;
    let bright = picture("", 16, &[[255, 255, 255, 255]; 16 * 8], Writing::Planes);
    let cases: Vec<(Vec<u8>, usize, &str)> = vec![
        (Vec::new(), 1, "#?RADIANCE"),
        (vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0, 10], 1, "OpenEXR"),
        (text("\u{89}PNG\n"), 1, "#?RADIANCE"),
        (text("#?RADIANCE\n"), 2, "the end of the file"),
        (text("#?RADIANCE\nFORMAT=16-bit\n\n-Y 1 +X 2\n"), 2, "32-bit_rle_rgbe"),
        (text("#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 2\n"), 2, "1 numbers"),
        (text("#?RADIANCE\nCOLORCORR=1 2\n\n-Y 1 +X 2\n"), 2, "3 numbers"),
        (text(&format!("{head}+X 2 -Y 1\n")), 4, "-Y HEIGHT +X WIDTH"),
        (text(&format!("{head}-Y 4294967296 +X 2\n")), 4, "-Y HEIGHT +X WIDTH"),
        (text(&format!("{head}-Y 5 +X 5\n")), 4, "a picture of 5 x 5 pixels"),
        (text(&format!("{head}-Y 0 +X 0\n")), 4, "a picture of 0 x 0 pixels"),
        (text(&format!("{head}-Y 2147483648 +X 4294967295\n")), 4, "twice as wide as high"),
        (text(&format!("{head}-Y 8192 +X 16384\n")), 4, "row 1 of 8192"),
        (good[..good.len() - 1].to_vec(), 4, "row 8 of 8"),
        (wrong_width, 4, "row 1 of 8"),
        (bright, 4, "at most 1e12 cd/m2"),
    ];
    for (bytes, line, words) in cases {
        let error = Panorama::parse(&bytes).expect_err(words);
        assert_eq!(error.line(), line, "{error}");
        assert!(error.to_string().contains(words), "{words}: {error}");
    }
}

/// A photograph of the sky: a fisheye picture, of which the header is Radiance's own.
#[test]
fn a_fisheye_picture_is_no_panorama() {
    let Some(folder) = quasilux_corpus::find("daylight") else { return };
    let bytes = std::fs::read(folder.join("radiance-evalglare-testimage.hdr")).unwrap();
    let error = Panorama::parse(&bytes).expect_err("no panorama");
    assert!(error.to_string().contains("twice as wide as high"), "{error}");
}

/// Bright pixels: their solid angles add up to that of the sky, and directions in them are theirs.
#[test]
fn bright_pixels_are_those_far_above_the_mean() {
    let mut pixels = [[128, 128, 128, 128]; 50 * 25];
    let suns = [3 * 50 + 7, 11 * 50 + 49, 12 * 50];
    suns.iter().for_each(|index| pixels[*index] = [128, 128, 128, 137]);
    let parse = |pixels: &[[u8; 4]]| {
        let bytes = picture("", 50, pixels, Writing::Planes);
        Panorama::parse(&bytes).unwrap().panorama.with_middle_at(77.0)
    };
    let panorama = parse(&pixels);
    let bright = panorama.bright_pixels();
    assert_eq!(bright.iter().map(|pixel| pixel.index).collect::<Vec<_>>(), suns);
    let mut numbers = SplitMix64::new(5);
    for pixel in &bright {
        let row = pixel.index / 50;
        let [top, bottom] = [row, row + 1].map(|row| cos((PI * row as f64 / 25.0).min(FRAC_PI_2)));
        assert!(near(pixel.solid_angle_sr, TAU / 50.0 * (top - bottom), 1e-12));
        for _ in 0..200 {
            let u = [0, 1].map(|_| 1e-6 + numbers.below(999_998) as f64 / 1e6);
            let direction = panorama.direction_in(pixel.index, u);
            assert_eq!(panorama.pixel_of(direction), Some(pixel.index), "{u:?}");
            // Uniform in height.
            assert!((direction[2] - (top + (bottom - top) * u[0])).abs() < 1e-12);
        }
    }
    assert_eq!(panorama.pixel_of([0.6, 0.0, -0.8]), None);
    assert!(parse(&[[128, 128, 128, 128]; 50 * 25]).bright_pixels().is_empty());
}
