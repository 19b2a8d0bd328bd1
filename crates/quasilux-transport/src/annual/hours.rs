//! The luminances of all hours at the nodes of a mesh, and their products with coefficients.

use super::coefficients::{Coefficients, Meshes, SunShare};
use glam::DVec3;
use quasilux_scene::Environment;
use quasilux_sky::WeatherSky;
use rayon::prelude::*;
use std::f64::consts::FRAC_1_PI;

/// Hours that are worked out together: as many numbers as fit into registers.
const LANES: usize = 8;

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
    /// The hours with the skies of a site that an environment places in the world.
    pub(super) fn new(environment: &Environment, hours: &[WeatherSky], meshes: &Meshes) -> Self {
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
        let group = |hours: &[WeatherSky]| {
            let mut rows = vec![[0.0; LANES]; rows];
            for (lane, hour) in hours.iter().enumerate() {
                let exact: Vec<f64> =
                    nodes.iter().map(|node| hour.sky.luminance_cd_m2(*node)).collect();
                for (row, around) in rows.iter_mut().zip(&meshes.sharpened_sky) {
                    let sharp = around.iter().map(|&(node, share)| share * exact[node]);
                    row[lane] = sharp.sum::<f64>() as f32;
                }
                rows[nodes.len()][lane] = ground(hour);
            }
            rows
        };
        let luminances = hours.par_chunks(LANES).flat_map_iter(group).collect();
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

    /// The illuminance of each hour in lx, but for what comes straight from the sun.
    pub(super) fn illuminances_lx(&self, of: &Coefficients) -> Vec<f32> {
        let mut all = Vec::with_capacity(self.luminances.len() / self.rows * LANES);
        let used = |(row, share): (usize, f32)| (share != 0.0).then_some((row, share));
        let coefficients = of.sky.iter().copied().chain([of.ground]).enumerate();
        let coefficients: Vec<(usize, f32)> = coefficients.filter_map(used).collect();
        for group in self.luminances.chunks(self.rows) {
            let mut sums = [0.0; LANES];
            for &(row, coefficient) in &coefficients {
                sums.iter_mut().zip(&group[row]).for_each(|(sum, l)| *sum += coefficient * l);
            }
            all.extend(sums);
        }
        all.truncate(self.hours);
        for (sum, suns) in all.iter_mut().zip(&self.suns) {
            suns.iter().for_each(|&(sun, lx)| *sum += of.suns[sun as usize] * lx);
        }
        all
    }
}
