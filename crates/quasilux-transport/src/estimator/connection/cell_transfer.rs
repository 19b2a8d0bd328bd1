//! Cell transfer (form factors with visibility): the illuminance that each target gets of a unit of
//! flux that leaves each cell of the survey.
//!
//! What a photon gives to a sensor changes little within a cell. What it gives on the mean is found
//! once, from the few places that the survey remembers of each cell, before any photon counts: a
//! coarse picture of the sensors' views. It need not be right, see [`super`].

use super::ConnectionPlan;
use super::exitant_flux::{CellFlux, ExitantFlux, Side};
use super::receiver_element::ReceiverElement;
use super::view::View;
use crate::codec::Writer;
use crate::context::Context;
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Where in cells of grids places are looked at from: each from another quarter than the one
/// before.
const IN_CELL: [[f64; 2]; 4] = [[0.25, 0.25], [0.75, 0.75], [0.25, 0.75], [0.75, 0.25]];
/// Photons straight from their lights, and others: their shares differ.
pub(super) const CLASSES: usize = 2;

/// Illuminance in lx that each of some targets gets of a lm/sr that leaves a cell, mean over the
/// cell.
pub(super) struct CellTransfer {
    targets: usize,
    /// Rays that it took.
    pub(super) rays: u64,
    /// Of target t by class k from cell c at `(c * CLASSES + k) * targets + t`.
    lx_sr_lm: Vec<f32>,
}

impl CellTransfer {
    /// Looks from all targets at all cells.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        connection: &ConnectionPlan,
        elements: &[ReceiverElement],
    ) -> Self {
        let look = |places: &Vec<Interaction>| look(context, connection, places, elements);
        let rows: Vec<Row> = connection.places.par_iter().map(look).collect();
        let rays = rows.iter().map(|row| row.rays).sum();
        let lx_sr_lm = rows.into_iter().flat_map(|row| row.lx_sr_lm).collect();
        Self { targets: elements.len(), rays, lx_sr_lm }
    }

    /// Puts it among the decisions.
    pub(super) fn put(&self, out: &mut Writer) {
        self.lx_sr_lm.iter().for_each(|lx| out.value(lx));
    }

    /// What all targets get from a cell, by what comes there straight from the lights or otherwise.
    pub(super) fn of_cell(&self, cell: usize, is_first: bool) -> &[f32] {
        let row = cell * CLASSES + usize::from(!is_first);
        &self.lx_sr_lm[row * self.targets..(row + 1) * self.targets]
    }

    /// Finds out what all targets are taken to get of what leaves a place.
    pub(super) fn predict(&self, leaving: &ExitantFlux, is_first: bool, lx: &mut [f64]) {
        lx.fill(0.0);
        for CellFlux { cell, lm_sr } in leaving.sides.iter().flat_map(Side::by_cell) {
            let seen = self.of_cell(cell, is_first);
            let sums = lx.iter_mut().zip(seen);
            sums.for_each(|(sum, lx_sr_lm)| *sum += lm_sr * f64::from(*lx_sr_lm));
        }
    }

    /// How many targets it has.
    pub(super) fn targets(&self) -> usize {
        self.targets
    }
}

/// The transfer from one cell to all targets: first light that comes there straight, then other
/// light.
struct Row {
    lx_sr_lm: Vec<f32>,
    rays: u64,
}

fn look<S: Spectrum>(
    context: &Context<'_, S>,
    connection: &ConnectionPlan,
    places: &[Interaction],
    elements: &[ReceiverElement],
) -> Row {
    let densities: Vec<_> =
        places.iter().map(|at| connection.partition.density(at.position, at.n)).collect();
    let (mut shadow_rays, mut light_samples) = (Vec::new(), Vec::new());
    for (number, element) in elements.iter().enumerate() {
        for ((at, density), in_cell) in places.iter().zip(&densities).zip(IN_CELL.iter().cycle()) {
            let Some(view) = View::new(&context.world, element, at, *in_cell) else { continue };
            if view.behind {
                continue;
            }
            let weights_of_paths = connection.partition.path_weights(view.pdf_m2, *density);
            let lx = PI * view.pdf_m2 * view.weight / places.len() as f64;
            shadow_rays.push(view.shadow_ray());
            light_samples.push((
                number,
                lx * (1.0 - weights_of_paths.first),
                lx * (1.0 - weights_of_paths.rest),
            ));
        }
    }
    let mut visible = Vec::new();
    context.world.are_visible(&shadow_rays, &mut visible);
    let mut row = vec![0.0; CLASSES * elements.len()];
    for ((number, first, rest), _) in
        light_samples.into_iter().zip(visible).filter(|(_, seen)| *seen)
    {
        row[number] += first as f32;
        row[elements.len() + number] += rest as f32;
    }
    row.iter_mut().filter(|lx| !lx.is_finite()).for_each(|lx| *lx = 0.0);
    Row { lx_sr_lm: row, rays: shadow_rays.len() as u64 }
}
