//! Skies are as bright as they are said to be.

use crate::{projected, suns};
use quasilux_sky::{CieType, Distribution, Irradiance, Perez, Sky, SkyLevel, SkyPoint};

fn all_kinds() -> Vec<(String, Distribution)> {
    let edges =
        [0.0, 1.0, 89.0, 90.0].map(|altitude_deg| SkyPoint { altitude_deg, azimuth_deg: 210.0 });
    let mut kinds = vec![("uniform".to_owned(), Distribution::uniform())];
    for (number, sun) in (1..).zip(suns(12).chain(edges)) {
        let cie = CieType::new(number).unwrap();
        kinds.push((format!("type {number}, {sun:?}"), Distribution::cie(cie, sun)));
    }
    for (number, sun) in suns(12).enumerate() {
        let share = number as f64 / 11.0;
        let irradiance = Irradiance {
            direct_normal_w_m2: 900.0 * share * share,
            diffuse_horizontal_w_m2: 60.0 + 200.0 * share,
        };
        let perez = Perez::new(irradiance, sun, 100, Perez::DEW_POINT_C).unwrap();
        kinds.push((format!("{perez:?}"), Distribution::perez(&perez)));
    }
    kinds
}

/// Against a quadrature that knows nothing of the sun.
#[test]
fn illuminances_are_the_integrals_of_luminances() {
    for (name, distribution) in all_kinds() {
        let level = SkyLevel::HorizontalIlluminance { lx: 1000.0 };
        let sky = Sky::new(distribution.clone(), level).unwrap();
        assert!((sky.horizontal_illuminance_lx() - 1000.0).abs() < 1e-9);
        let found = projected(|direction| sky.luminance_cd_m2(direction));
        assert!((found / 1000.0 - 1.0).abs() < 3e-5, "{name}: {found}");
        let zenith = sky.zenith_luminance_cd_m2();
        let again = Sky::new(distribution, SkyLevel::ZenithLuminance { cd_m2: zenith }).unwrap();
        assert!((again.horizontal_illuminance_lx() / 1000.0 - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn nothing_shines_from_below() {
    for (name, distribution) in all_kinds() {
        assert_eq!(distribution.relative([0.6, 0.0, -0.8]), 0.0, "{name}");
        assert!(distribution.relative([0.6, 0.8, 0.0]) >= 0.0, "{name}");
    }
}

#[test]
fn levels_that_make_no_sky_are_refused() {
    for wrong in [-1.0, f64::NAN, f64::INFINITY, 1e10] {
        for level in [
            SkyLevel::HorizontalIlluminance { lx: wrong },
            SkyLevel::ZenithLuminance { cd_m2: wrong },
        ] {
            assert!(Sky::new(Distribution::uniform(), level).is_err(), "{level:?}");
        }
    }
    let level = SkyLevel::HorizontalIlluminance { lx: 0.0 };
    let night = Sky::new(Distribution::uniform(), level).unwrap();
    assert_eq!(night.zenith_luminance_cd_m2(), 0.0);
}
