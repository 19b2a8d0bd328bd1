//! The all-weather sky against Radiance's programs.

use crate::suns;
use quasilux_sky::{Distribution, Irradiance, Perez, Sky, SkyLevel, SkyPoint, sun_luminance_cd_m2};

/// 32 skies, four of each category of clearness.
const GENDAYLIT: &str = include_str!("gendaylit.txt");

/// `gendaylit -ang` computes as on day 0 of a year.
const DAY: u32 = 0;

/// Clearness, brightness, illuminances and luminances.
#[test]
fn skies_are_those_of_gendaylit() {
    let mut rows = 0;
    for row in GENDAYLIT.lines().filter(|row| !row.starts_with('#')) {
        let numbers: Vec<f64> = row.split(' ').map(|field| field.parse().unwrap()).collect();
        let [
            altitude_deg,
            azimuth_deg,
            direct_normal_w_m2,
            diffuse_horizontal_w_m2,
            dew_point_c,
            clearness,
            brightness,
            diffuse_lx,
            sun_cd_m2,
            a,
            b,
            c,
            d,
            e,
        ] = numbers[..]
        else {
            panic!("{row}")
        };
        let sun = SkyPoint { altitude_deg, azimuth_deg };
        let irradiance = Irradiance { direct_normal_w_m2, diffuse_horizontal_w_m2 };
        let perez = Perez::new(irradiance, sun, DAY, dew_point_c).unwrap();
        assert!((perez.clearness() - clearness).abs() < 1e-4 * clearness, "{row}: {perez:?}");
        assert!((perez.brightness() - brightness).abs() < 1e-4, "{row}: {perez:?}");
        // Four digits of two numbers.
        let found = perez.diffuse_illuminance_lx();
        assert!((found / diffuse_lx - 1.0).abs() < 1e-3, "{row}: {found}");
        let found = sun_luminance_cd_m2(perez.normal_illuminance_lx());
        assert!((found - sun_cd_m2).abs() < 5e-4 * sun_cd_m2 + 1.0, "{row}: {found}");
        let ours = Distribution::perez(&perez);
        let theirs = |direction: [f64; 3]| {
            let towards_sun = sun.to_direction();
            let cosine: f64 = direction.iter().zip(towards_sun).map(|(x, y)| x * y).sum();
            let indicatrix = 1.0 + c * libm::exp(d * libm::acos(cosine)) + e * cosine * cosine;
            (1.0 + a * libm::exp(b / direction[2].max(0.01))) * indicatrix
        };
        for point in suns(1000) {
            let direction = point.to_direction();
            let (found, expected) = (ours.relative(direction), theirs(direction).max(0.0));
            assert!((found - expected).abs() <= 1e-3 * expected + 1e-5, "{row}: {point:?} {found}");
        }
        rows += 1;
    }
    assert_eq!(rows, 32);
}

/// What `gendaylit` refuses: b above 0. Of skies at random, vertical and horizontal illuminances by
/// sums over the hemisphere. No vertical plane has more of the sky than the CIE's clearest sky
/// gives one towards a low sun, about three times the horizontal; and turned by right angles from
/// the sun less than what a horizon of the CIE gives.
#[test]
fn skies_that_gendaylit_refuses_have_no_blazing_horizon() {
    let mut held = 0;
    for (number, point) in (0_u32..).zip(suns(4000)) {
        let random = |k: f64| (f64::from(number) * k).fract();
        let sun =
            SkyPoint { altitude_deg: 30.0 * libm::pow(random(0.618_033_988_75), 2.0), ..point };
        let irradiance = Irradiance {
            direct_normal_w_m2: 1200.0 * random(0.754_877_666_2),
            diffuse_horizontal_w_m2: 1.0 + 400.0 * libm::pow(random(0.569_840_291), 2.0),
        };
        let perez = Perez::new(irradiance, sun, 1 + number % 365, Perez::DEW_POINT_C).unwrap();
        if !perez.is_held() {
            continue;
        }
        held += 1;
        let lx = perez.diffuse_illuminance_lx();
        let sky =
            Sky::new(Distribution::perez(&perez), SkyLevel::HorizontalIlluminance { lx }).unwrap();
        let (mut horizontal, mut towards, mut aside) = (0.0, 0.0, 0.0);
        const RINGS: u32 = 120;
        for i in 0..RINGS {
            for j in 0..4 * RINGS {
                let altitude = (f64::from(i) + 0.5) / f64::from(RINGS) * 90.0;
                let azimuth = (f64::from(j) + 0.5) / f64::from(RINGS) * 90.0;
                let towards_deg = azimuth - sun.azimuth_deg;
                let part = SkyPoint { altitude_deg: altitude, azimuth_deg: azimuth };
                let (sine, cosine) = libm::sincos(altitude.to_radians());
                let step = 90.0_f64.to_radians() / f64::from(RINGS);
                let light = sky.luminance_cd_m2(part.to_direction()) * cosine * step * step;
                horizontal += light * sine;
                let (across, along) = libm::sincos(towards_deg.to_radians());
                towards += light * cosine * along.max(0.0);
                aside += light * cosine * across.max(0.0);
            }
        }
        assert!((horizontal / lx - 1.0).abs() < 0.02, "{perez:?}: {horizontal} for {lx}");
        assert!(
            towards < 4.0 * lx && aside < 1.5 * lx,
            "{perez:?}: {} {}",
            towards / lx,
            aside / lx
        );
    }
    assert!(held > 300, "{held}");
}

/// Any hour has a sky, also those that the formula makes nothing of.
#[test]
fn every_hour_has_a_sky() {
    let mut levels = 0;
    for altitude_deg in [-90.0, -5.0, 0.0, 0.1, 3.0, 20.0, 45.0, 80.0, 87.0, 90.0] {
        for diffuse_horizontal_w_m2 in [0.0, 0.5, 5.0, 50.0, 200.0, 700.0, 2000.0] {
            for direct_normal_w_m2 in [0.0, 0.1, 1.0, 10.0, 100.0, 1000.0, 2000.0] {
                let irradiance = Irradiance { direct_normal_w_m2, diffuse_horizontal_w_m2 };
                let sun = SkyPoint { altitude_deg, azimuth_deg: 10.0 };
                let perez = Perez::new(irradiance, sun, 200, Perez::DEW_POINT_C).unwrap();
                let lx = perez.diffuse_illuminance_lx();
                assert!(lx >= 0.0 && perez.normal_illuminance_lx() >= 0.0, "{perez:?}");
                let level = SkyLevel::HorizontalIlluminance { lx };
                let sky = Sky::new(Distribution::perez(&perez), level).unwrap();
                for direction in suns(30).map(SkyPoint::to_direction) {
                    let luminance = sky.luminance_cd_m2(direction);
                    assert!(luminance >= 0.0 && luminance.is_finite(), "{perez:?} {luminance}");
                }
                levels += usize::from(lx > 0.0);
            }
        }
    }
    assert!(levels > 400);
}

#[test]
fn irradiances_that_no_hour_has_are_refused() {
    let sun = SkyPoint { altitude_deg: 30.0, azimuth_deg: 180.0 };
    for wrong in [-1.0, f64::NAN, 2001.0, f64::INFINITY] {
        for irradiance in [
            Irradiance { direct_normal_w_m2: wrong, diffuse_horizontal_w_m2: 100.0 },
            Irradiance { direct_normal_w_m2: 100.0, diffuse_horizontal_w_m2: wrong },
        ] {
            assert!(Perez::new(irradiance, sun, 1, 11.0).is_err(), "{irradiance:?}");
        }
    }
}
