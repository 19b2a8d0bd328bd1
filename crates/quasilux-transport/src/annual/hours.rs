//! The luminances of all hours at the nodes of a mesh, and their products with coefficients.

use super::coefficients::{Coefficients, Meshes, SunShare};
use glam::DVec3;
use quasilux_scene::Environment;
use quasilux_sky::{TabulatedSky, WeatherSky};
use rayon::prelude::*;
use std::f64::consts::FRAC_1_PI;

/// Hours that are worked out together: as many numbers as fit into registers.
const LANES: usize = 8;
/// Points that are worked out together, for the same reason.
const POINTS: usize = 4;

/// The hours as one replicate sees them.
pub(super) struct HourTable {
    hours: usize,
    /// By group of hours, by node of the sky and last the ground: luminances in cd/m2.
    luminances: Vec<[f32; LANES]>,
    rows: usize,
    /// By hour: places of the sun with the illuminances in lx that stand for its light.
    suns: Vec<Vec<(u32, f32)>>,
}

impl HourTable {
    /// The hours, with tables of their skies, that an environment places in the world.
    pub(super) fn new(
        environment: &Environment,
        hours: &[WeatherSky],
        skies: &[TabulatedSky],
        meshes: &Meshes,
    ) -> Self {
        // Below the horizon the sky goes on as it is there.
        let on_sky = |direction: DVec3| {
            let flat = DVec3 { z: direction.z.max(0.0), ..direction }.normalize_or(DVec3::X);
            environment.to_sky(flat)
        };
        let nodes: Vec<[f64; 3]> = meshes.sky.directions().map(on_sky).collect();
        let rows = nodes.len() + 1;
        let ground = |hour: &WeatherSky| {
            let lx = hour.horizontal_illuminance_lx();
            (environment.ground_reflectance * lx * FRAC_1_PI) as f32
        };
        let group = |(hours, skies): (&[WeatherSky], &[TabulatedSky])| {
            let mut rows = vec![[0.0; LANES]; rows];
            for (lane, (hour, sky)) in hours.iter().zip(skies).enumerate() {
                let exact: Vec<f64> = sky.luminances_cd_m2(&nodes).collect();
                for (row, around) in rows.iter_mut().zip(&meshes.sharpened_sky) {
                    let sharp = around.iter().map(|&(node, share)| share * exact[node]);
                    row[lane] = sharp.sum::<f64>() as f32;
                }
                rows[nodes.len()][lane] = ground(hour);
            }
            rows
        };
        let luminances =
            hours.par_chunks(LANES).zip(skies.par_chunks(LANES)).flat_map_iter(group).collect();
        let suns = |hour: &WeatherSky| {
            let lx = hour.sun_normal_illuminance_lx;
            let around = (lx > 0.0).then(|| environment.towards(hour.sun)).into_iter();
            let mut shares = std::collections::BTreeMap::new();
            for SunShare { sun, share } in around.flat_map(|direction| meshes.suns_for(direction)) {
                *shares.entry(sun).or_default() += lx * share;
            }
            shares.into_iter().map(|(sun, lx): (u32, f64)| (sun, lx as f32)).collect()
        };
        let suns = hours.par_iter().map(suns).collect();
        Self { hours: hours.len(), luminances, rows, suns }
    }

    /// The largest luminance of each hour in cd/m2.
    pub(super) fn brightest_cd_m2(&self) -> Vec<f32> {
        let of_group = |rows: &[[f32; LANES]]| {
            let none = [0.0_f32; LANES];
            rows.iter().fold(none, |most, row| std::array::from_fn(|k| most[k].max(row[k])))
        };
        self.luminances.chunks(self.rows).flat_map(of_group).take(self.hours).collect()
    }

    /// The illuminance of each hour in lx, but for what comes straight from the sun, of several
    /// points.
    pub(super) fn illuminances_lx(&self, of: &[Coefficients]) -> Vec<Vec<f32>> {
        let mut all = vec![Vec::with_capacity(self.hours + LANES); of.len()];
        let together: Vec<Vec<Row>> = of.chunks(POINTS).map(used_rows).collect();
        // The luminances of a group of hours stay in the cache for all points.
        for group in self.luminances.chunks(self.rows) {
            for (points, rows) in all.chunks_mut(POINTS).zip(&together) {
                let mut sums = [[0.0; LANES]; POINTS];
                for &Row { number, coefficients } in rows {
                    let luminances = &group[number];
                    for (sums, coefficient) in sums.iter_mut().zip(coefficients) {
                        sums.iter_mut()
                            .zip(luminances)
                            .for_each(|(sum, l)| *sum += coefficient * l);
                    }
                }
                points.iter_mut().zip(&sums).for_each(|(hours, sums)| hours.extend(sums));
            }
        }
        for (hours, of) in all.iter_mut().zip(of) {
            hours.truncate(self.hours);
            for (sum, suns) in hours.iter_mut().zip(&self.suns) {
                suns.iter().for_each(|&(sun, lx)| *sum += of.suns[sun as usize] * lx);
            }
        }
        all
    }
}

/// Coefficients of points for a node of the sky, or for the ground.
struct Row {
    number: usize,
    coefficients: [f32; POINTS],
}

/// The rows that any of these points has something of.
fn used_rows(points: &[Coefficients]) -> Vec<Row> {
    let rows = points.first().map_or(0, |point| point.sky.len() + 1);
    let row = |number: usize| {
        let mut coefficients = [0.0; POINTS];
        for (coefficient, of) in coefficients.iter_mut().zip(points) {
            *coefficient = of.sky.get(number).copied().unwrap_or(of.ground);
        }
        coefficients.iter().any(|share| *share != 0.0).then_some(Row { number, coefficients })
    };
    (0..rows).filter_map(row).collect()
}
