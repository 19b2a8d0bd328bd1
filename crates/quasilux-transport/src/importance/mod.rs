//! Importance of photons to the sensors: the survey (FW-CADIS), weight windows that split photons
//! or end them, and guiding of their directions.
//!
//! In a long corridor lit from one end photons die out, and the far end is found by hardly any. A
//! coarse [`survey`] of the scene says, by linear algebra ([`flux_and_importance`]), how much light
//! there is and its importance to the sensors; [`weight_windows`] then say how many photons
//! should follow each that lands, and [`guiding_tree`] in which directions. The survey has pilot
//! rays of its own, their number is fixed and their coordinates serve nothing else: whatever it
//! says, the estimate has the same mean. Of the default light subpaths take only the number of
//! their [`copies`] from it, and eye paths how places see outside ([`openings`]). It also predicts
//! what guiding saves; where that is little, as in a plain room, photons are left alone.

mod cells;
mod copies;
mod flux_and_importance;
mod guiding_tree;
mod openings;
mod survey;
#[cfg(test)]
mod tests;
mod weight_windows;

pub(crate) use copies::Copies;
pub(crate) use guiding_tree::{GuidingTree, MAX_NODES, Node};
pub(crate) use openings::{Looked, LookingPlace, OpeningView, OpeningViews};
pub(crate) use survey::{PilotPhoton, Survey};
pub(crate) use weight_windows::{Split, WeightWindows};

use crate::context::Context;
use crate::lights::Emitted;
use crate::sensors::Target;
use crate::settings::Switch;
use crate::spectrum::Spectrum;
use crate::stats::efficiency::Performance;
use flux_and_importance::FluxAndImportance;
use quasilux_sampling::Sampler;

/// Photons are guided by themselves where the same error then costs this many times fewer rays. A
/// small gain would not repay the closer look that guiding takes.
pub(crate) const WORTHWHILE: f64 = 8.0;

/// Times that far cells are connected on a closer look, each time chosen by what was learnt before.
const LOOKS: u32 = 2;

/// Result of the survey.
#[derive(Default)]
pub(crate) struct Plan {
    /// `None` where photons are left alone.
    pub(crate) windows: Option<WeightWindows>,
    /// Rays of the survey.
    pub(crate) rays: u64,
}

/// Surveys the scene, if `importance` asks for it, and decides.
pub(crate) fn plan<S: Spectrum>(
    context: &Context<'_, S>,
    targets: &[Target],
    importance: Switch,
) -> Plan {
    if importance == Switch::Off {
        return Plan::default();
    }
    let survey = Survey::new(context, targets, |sampler| pilot_photon(context, sampler));
    let Some(mut survey) = survey else { return Plan::default() };
    let Some(solution) = connect_far_cells(context, &mut survey, 1) else {
        return Plan { rays: survey.rays, ..Plan::default() };
    };
    let plain = Performance::plain(&survey, &solution).cost_of_error();
    let gain = plain / Performance::guided(&survey, &solution).cost_of_error();
    if importance == Switch::Auto && gain < WORTHWHILE {
        return Plan { rays: survey.rays, ..Plan::default() };
    }
    survey.refine(context);
    let refined = connect_far_cells(context, &mut survey, LOOKS);
    let windows = refined.map(|solution| WeightWindows::new(&survey, &solution));
    Plan { windows, rays: survey.rays }
}

/// A photon of those that lights emit in proportion to their flux.
fn pilot_photon<S: Spectrum>(
    context: &Context<'_, S>,
    sampler: &mut Sampler<'_>,
) -> Option<PilotPhoton> {
    let Emitted { emission, share, .. } =
        context.lights.emit(&context.world, context.purposes, sampler)?;
    Some(PilotPhoton { emission, share })
}

/// Connects cells over distances, to those of most importance by the solution so far, and solves
/// for flux and importance anew.
fn connect_far_cells<S: Spectrum>(
    context: &Context<'_, S>,
    survey: &mut Survey,
    short_looks: u32,
) -> Option<FluxAndImportance> {
    let flux_lm = context.lights.flux_lm;
    let areas_m2 = areas_m2(context, survey);
    for _ in 0..short_looks {
        let solution = FluxAndImportance::new(survey, &areas_m2, flux_lm)?;
        survey.connect(context, &areas_m2, &solution.landed_importance);
    }
    FluxAndImportance::new(survey, &areas_m2, flux_lm)
}

/// Areas of the known cells in m^2. Where facets were told to cells too coarsely for one, it gets
/// the least that another has.
fn areas_m2<S: Spectrum>(context: &Context<'_, S>, survey: &Survey) -> Vec<f64> {
    let of_cell = survey.cells.areas_m2(&context.world);
    let least = of_cell.iter().copied().filter(|area| *area > 0.0).fold(f64::INFINITY, f64::min);
    let mut areas_m2 = vec![least; survey.known.len()];
    for (number, area_m2) in survey.number_of_cell.iter().zip(of_cell) {
        if let (Some(area), true) = (areas_m2.get_mut(*number as usize), area_m2 > 0.0) {
            *area = area_m2;
        }
    }
    areas_m2
}
