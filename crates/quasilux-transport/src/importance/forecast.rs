//! Predictions of a survey: densities of landing photons, and indirect illuminances of the sensors.
//!
//! Whoever shares work between photons and paths goes by it; a wrong forecast costs effort and
//! never bias.

use crate::codec::Writer;
use crate::importance::cells::{Around, CellWeight, Regions};
use crate::importance::flux_and_importance::FluxAndImportance;
use crate::importance::survey::Survey;
use crate::world::Interaction;
use glam::DVec3;
use std::sync::Arc;

/// Times that light is gathered from what cells see: each evens out what the one before left
/// uneven.
const SWEEPS: u32 = 2;

/// What to expect of photons and sensors.
pub(crate) struct Forecast {
    pub(crate) landings: Landings,
    /// Some places in each cell.
    pub(crate) places: Arc<[Vec<Interaction>]>,
    /// Illuminance at each surveyed sensor after reflections, in lx.
    indirect_lx: Vec<f64>,
    /// Number of consecutive sensors that each surveyed one stands for.
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
        solution: &FluxAndImportance,
        areas_m2: &[f64],
        weights: &[f64],
    ) -> Self {
        let lit_per_m2 = lit_per_m2(survey, solution, areas_m2);
        let first = survey.first_landings.iter().zip(areas_m2);
        let per_m2 = first.enumerate().map(|(cell, (photons, area_m2))| Density {
            first: photons / area_m2,
            rest: seen_from(survey, cell, |there| lit_per_m2[there] / weights[there]),
        });
        let per_m2 = per_m2.collect();
        let landings = Landings { regions, per_m2 };
        let sensors = solution.sensors_lx.iter().zip(&survey.sensors);
        let indirect_lx = sensors.map(|(lx, sensor)| lx - sensor.direct_lx).collect();
        let places = survey.known.iter().map(|cell| cell.places.clone()).collect();
        Self { landings, places, indirect_lx, step: survey.sensor_step }
    }

    /// Illuminance to expect at a target after reflections, in lx, by its number among all: that of
    /// the next one that was surveyed.
    pub(crate) fn indirect_lx(&self, target: usize) -> f64 {
        self.indirect_lx[target / self.step]
    }
}

/// Flux that lands on a square metre of each surveyed cell, as a share of what all lights emit. Few
/// of the steps that the balance is made of end in any one cell; many cells are seen from it, so
/// what comes after a bounce is gathered from there.
fn lit_per_m2(survey: &Survey, solution: &FluxAndImportance, areas_m2: &[f64]) -> Vec<f64> {
    let per_m2 = |flux: &[f64]| -> Vec<f64> {
        flux.iter().zip(areas_m2).map(|(flux, area_m2)| flux / area_m2).collect()
    };
    let first = per_m2(&survey.first_landings);
    let mut lit = per_m2(&solution.landing);
    for _ in 0..SWEEPS {
        let gather = |cell: usize| first[cell] + seen_from(survey, cell, |there| lit[there]);
        lit = (0..first.len()).map(gather).collect();
    }
    lit
}

/// Density of flux that a cell gets from the cells it sees, given the density that lands on each.
fn seen_from(survey: &Survey, cell: usize, lit_per_m2: impl Fn(usize) -> f64) -> f64 {
    let steps = survey.known[cell].steps();
    let from = steps.map(|step| {
        let there = step.cell as usize;
        step.share * step.weight * survey.known[there].albedo * lit_per_m2(there)
    });
    from.sum()
}

impl Landings {
    /// Puts them among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        self.regions.put(out);
        self.per_m2
            .iter()
            .flat_map(|density| [density.first, density.rest])
            .for_each(|x| out.value(&x));
    }

    /// The surveyed cells around a place on the side `n` of a surface.
    pub(crate) fn around(&self, position: DVec3, n: DVec3) -> Around {
        self.regions.around(position, n)
    }

    /// What to expect at a place with these cells around it; nothing where the survey found
    /// nothing. It changes smoothly along a surface.
    pub(crate) fn density(&self, around: &Around) -> Density {
        let mut density = Density::default();
        for CellWeight { cell, weight } in around.iter() {
            let there = self.per_m2[cell];
            density.first += weight * there.first;
            density.rest += weight * there.rest;
        }
        density
    }
}
