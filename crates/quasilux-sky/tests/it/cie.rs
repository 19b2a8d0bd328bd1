//! CIE skies: published values, closed forms.

use quasilux_sky::{CieType, Distribution, Sky, SkyLevel, SkyPoint};
use std::f64::consts::PI;

fn sky(number: i64, sun: SkyPoint) -> Sky {
    let distribution = Distribution::cie(CieType::new(number).unwrap(), sun);
    Sky::new(distribution, SkyLevel::ZenithLuminance { cd_m2: 1.0 }).unwrap()
}

/// Values of colour-science (`cie2003.py`, 2026): 45 degrees from the zenith, the sun 30 degrees
/// from it on the other side.
#[test]
fn luminances_are_those_of_another_program() {
    let sun = SkyPoint { altitude_deg: 60.0, azimuth_deg: 90.0 };
    let opposite = SkyPoint { altitude_deg: 45.0, azimuth_deg: 270.0 }.to_direction();
    for (number, expected) in [(1, 0.832_584_642_796_44), (12, 0.454_452_430_685_20)] {
        let found = sky(number, sun).luminance_cd_m2(opposite);
        assert!((found - expected).abs() < 1e-13, "type {number}: {found}");
    }
}

/// Of types that do not depend on the sun: the exact integral of (1 + a exp(b / cos Z)) cos Z for
/// a = 0, and that of Moon and Spencer's sky.
#[test]
fn illuminances_have_their_closed_form() {
    let sun = SkyPoint { altitude_deg: 20.0, azimuth_deg: 100.0 };
    for (number, expected) in [(5, PI), (16, 7.0 * PI / 9.0)] {
        let found = sky(number, sun).horizontal_illuminance_lx();
        assert!((found / expected - 1.0).abs() < 1e-12, "type {number}: {found}");
    }
}

/// Type 1 over its zenith: 2 pi integral of (1 + 4 exp(-0.7 / t)) t dt over (1 + 4 exp(-0.7)), by
/// the exponential integral E3(0.7) = 0.1613 (Abramowitz and Stegun, table 5.4, from E1(0.7)).
#[test]
fn the_overcast_sky_has_the_illuminance_of_its_exponential_integral() {
    let e1 = 0.373_768_843_233_509_3;
    let e2 = libm::exp(-0.7) - 0.7 * e1;
    let e3 = (libm::exp(-0.7) - 0.7 * e2) / 2.0;
    let expected = 2.0 * PI * (0.5 + 4.0 * e3) / (1.0 + 4.0 * libm::exp(-0.7));
    let found = sky(1, SkyPoint { altitude_deg: 33.0, azimuth_deg: 0.0 });
    let found = found.horizontal_illuminance_lx();
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} instead of {expected}");
}

#[test]
fn there_are_sixteen_types() {
    for number in [i64::MIN, -1, 0, 17, 257, i64::MAX] {
        assert!(CieType::new(number).is_err(), "{number}");
    }
    let all = (1..=16).map(|number| CieType::new(number).unwrap().description());
    assert_eq!(all.collect::<std::collections::BTreeSet<_>>().len(), 16);
}
