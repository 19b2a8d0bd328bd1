//! Values and directional-hemispherical shares of published files are those of Radiance.

use super::{direction, surface};
use quasilux_bsdf::{MeasuredBsdf, ScatteringMode, Side};

/// Made by Radiance: the head of the table says how.
const TABLE: &str = include_str!("radiance.txt");

/// Radiance stores values as f32 and takes the least value of a table apart.
const TOLERANCE: f64 = 0.001;

struct Row<'t> {
    name: &'t str,
    side: Side,
    mode: ScatteringMode,
    wi_deg: [f64; 2],
    /// `None`: the value is the share of light from `wi` over all exits.
    wo_deg: Option<[f64; 2]>,
    value: f64,
}

fn rows() -> impl Iterator<Item = Row<'static>> {
    TABLE.lines().filter(|line| !line.starts_with('#')).map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        let number = |index: usize| words[index].parse::<f64>();
        Row {
            name: words[0],
            side: if words[1] == "front" { Side::Front } else { Side::Back },
            mode: if words[2] == "reflection" {
                ScatteringMode::Reflection
            } else {
                ScatteringMode::Transmission
            },
            wi_deg: [3, 4].map(|index| number(index).unwrap()),
            wo_deg: number(5).ok().map(|theta| [theta, number(6).unwrap()]),
            value: number(7).unwrap(),
        }
    })
}

fn value(bsdf: &MeasuredBsdf, row: &Row<'_>) -> f64 {
    let Some(distribution) = bsdf.scattering(row.side, row.mode) else {
        return 0.0;
    };
    let at = |[theta_deg, phi_deg]: [f64; 2]| direction(theta_deg, phi_deg);
    let wi = at(row.wi_deg);
    match row.wo_deg {
        Some(wo_deg) => distribution.evaluate(wi, at(wo_deg))[0],
        None => distribution.albedo(wi)[0],
    }
}

#[test]
fn values_and_shares_are_those_of_radiance() {
    let mut surfaces: Vec<(&str, MeasuredBsdf)> = Vec::new();
    let (mut compared, mut worst) = (0, 0.0_f64);
    for row in rows() {
        if surfaces.last().is_none_or(|(name, _)| *name != row.name) {
            let Some(bsdf) = surface(row.name) else {
                return;
            };
            surfaces.push((row.name, bsdf));
        }
        let label = format!("{} {} {}", row.name, row.side.name(), row.mode.name());
        let found = value(&surfaces[surfaces.len() - 1].1, &row);
        let off = (found / row.value - 1.0).abs();
        assert!(off < TOLERANCE, "{label}: {found} for {} at {:?}", row.value, row.wi_deg);
        worst = worst.max(off);
        compared += 1;
    }
    println!("{compared} values of {} files, at most {worst:.1e} apart", surfaces.len());
    assert!(compared > 250 && surfaces.len() == 10, "{compared} of {}", surfaces.len());
}

/// Of a file with transmission from the back alone, which is turned round, Radiance gives no shares
/// from the front. They are the mean of its values, which the test above compares: here over rings
/// of exits, cut finely in azimuth.
#[test]
fn shares_of_a_tree_turned_round_are_those_of_its_values() {
    const PARTS: u32 = 1 << 17;
    let Some(bsdf) = surface("tt-pyradiance-t3.xml") else {
        return;
    };
    let [front, back] =
        Side::ALL.map(|side| bsdf.scattering(side, ScatteringMode::Transmission).unwrap());
    for theta_deg in [0.5, 2.0, 10.0, 33.0, 64.0, 80.0] {
        let wi = direction(theta_deg, 13.0);
        let mut share = 0.0;
        for ring in 0..32 {
            let sine = (f64::from(ring) + 0.5) / 32.0;
            let ring_deg = libm::asin(sine).to_degrees();
            let value = |part: u32| {
                let wo = direction(ring_deg, 360.0 * (f64::from(part) + 0.5) / f64::from(PARTS));
                back.evaluate(wo, wi)[0]
            };
            let mean = (0..PARTS).map(value).sum::<f64>() / f64::from(PARTS);
            share += mean * std::f64::consts::PI * (2.0 * f64::from(ring) + 1.0) / 1024.0;
        }
        let found = front.albedo(wi)[0];
        println!("{theta_deg} degrees: {found:.6}, by its values {share:.6}");
        assert!((found / share - 1.0).abs() < 5e-4, "{theta_deg}: {found} for {share}");
    }
}
