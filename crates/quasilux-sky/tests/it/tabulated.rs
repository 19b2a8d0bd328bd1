//! Tables of skies against the skies.

use quasilux_sky::{
    CieType, Distribution, Irradiance, Perez, Sky, SkyLevel, SkyPoint, TabulatedSky,
};

/// All CIE skies and the skies of measured hours, over many directions, some near the sun.
#[test]
fn tables_have_the_luminances_of_their_skies() {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut distributions = vec![Distribution::uniform()];
    for number in 1..=16 {
        let sun = SkyPoint { altitude_deg: 90.0 * next(), azimuth_deg: 360.0 * next() };
        distributions.push(Distribution::cie(CieType::new(number).unwrap(), sun));
    }
    for _ in 0..100 {
        let sun = SkyPoint { altitude_deg: 90.0 * next(), azimuth_deg: 360.0 * next() };
        let irradiance = Irradiance {
            direct_normal_w_m2: 900.0 * next(),
            diffuse_horizontal_w_m2: 1.0 + 400.0 * next(),
        };
        let perez = Perez::new(irradiance, sun, 100, Perez::DEW_POINT_C).unwrap();
        distributions.push(Distribution::perez(&perez));
    }
    for distribution in distributions {
        let sky = Sky::new(distribution, SkyLevel::HorizontalIlluminance { lx: 1e4 }).unwrap();
        let table = TabulatedSky::new(&sky);
        let directions: Vec<[f64; 3]> = (0..500)
            .map(|_| SkyPoint { altitude_deg: -2.0 + 92.0 * next(), azimuth_deg: 360.0 * next() })
            .flat_map(|point| [point, SkyPoint { azimuth_deg: 200.0, ..point }])
            .map(SkyPoint::to_direction)
            .collect();
        for (direction, found) in directions.iter().zip(table.luminances_cd_m2(&directions)) {
            let expected = sky.luminance_cd_m2(*direction);
            let off = (found - expected).abs();
            assert!(off <= 1e-4 * expected.max(300.0), "{direction:?}: {found} not {expected}");
        }
    }
}
