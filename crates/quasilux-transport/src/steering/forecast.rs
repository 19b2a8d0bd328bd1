//! What a survey foretells of a run: where photons will land, and how much light sensors will get.
//!
//! Whoever shares work between photons and paths goes by it; a wrong forecast costs effort and never
//! bias.

use crate::steering::balance::Balance;
use crate::steering::cells::Regions;
use crate::steering::survey::Survey;
use glam::DVec3;
use std::sync::Arc;

/// What to expect of photons and sensors.
pub(crate) struct Forecast {
    pub(crate) landings: Landings,
    /// Illuminance at each surveyed sensor after reflections, in lx.
    indirect_lx: Vec<f64>,
    /// Each surveyed sensor stands for so many that follow each other.
    step: usize,
}

/// How close to each other photons land.
pub(crate) struct Landings {
    regions: Arc<Regions>,
    /// Of each region.
    per_m2: Vec<Density>,
}

/// Photons that land on a square metre, for each that is emitted.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Density {
    /// Straight from their lights.
    pub(crate) first: f64,
    /// Later.
    pub(crate) rest: f64,
}

impl Forecast {
    /// Of photons that leave each surveyed cell with these weights.
    pub(super) fn new(
        survey: &Survey,
        regions: Arc<Regions>,
        balance: &Balance,
        areas_m2: &[f64],
        weights: &[f64],
    ) -> Self {
        let mut per_m2: Vec<Density> = survey
            .first_landings
            .iter()
            .zip(areas_m2)
            .map(|(photons, area_m2)| Density { first: photons / area_m2, rest: 0.0 })
            .collect();
        for (cell, from) in survey.known.iter().enumerate() {
            let leaving = balance.landing[cell] * from.albedo / weights[cell];
            for step in from.steps() {
                let number = step.cell as usize;
                per_m2[number].rest += leaving * step.share / areas_m2[number];
            }
        }
        let landings = Landings { regions, per_m2 };
        let sensors = balance.sensors_lx.iter().zip(&survey.sensors);
        let indirect_lx = sensors.map(|(lx, sensor)| lx - sensor.direct_lx).collect();
        Self { landings, indirect_lx, step: survey.sensor_step }
    }

    /// Illuminance to expect at a target after reflections, in lx, by its number among all: that of the
    /// next one that was surveyed.
    pub(crate) fn indirect_lx(&self, target: usize) -> f64 {
        self.indirect_lx[target / self.step]
    }
}

impl Landings {
    /// What to expect at a place on the side `n` of a surface; nothing where the survey found nothing.
    pub(crate) fn at(&self, position: DVec3, n: DVec3) -> Density {
        let number = self.regions.number(position, n);
        number.map_or(Density::default(), |number| self.per_m2[number])
    }
}
