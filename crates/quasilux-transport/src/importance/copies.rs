//! Copies of light subpaths by place: one where lights shine, more where what leaves matters more
//! to the sensors. A function of the place alone, so it may stand in the densities of paths.

use super::cells::Regions;
use super::connect_far_cells;
use super::guiding_tree::GuidingTree;
use super::survey::Survey;
use super::weight_windows::importance_weights;
use crate::codec::Writer;
use crate::context::Context;
use crate::spectrum::Spectrum;
use crate::stats::targets::Target;
use crate::world::Interaction;

/// Copies at most: rarer light is left to the bound.
const MAX_COPIES: f64 = 64.0;

/// How many copies of a light subpath leave each surveyed cell on average, were nothing absorbed.
pub(crate) struct Copies {
    /// `None` where there is one everywhere.
    regions: Option<Regions>,
    by_cell: Vec<f64>,
    /// Rays of the survey.
    pub(crate) rays: u64,
}

impl Copies {
    /// One copy everywhere, after a survey of so many rays.
    pub(crate) fn single(rays: u64) -> Self {
        Self { regions: None, by_cell: Vec::new(), rays }
    }

    /// By a survey of the scene: in proportion to the importance of what leaves a cell, in the mean
    /// square over its next step, over the mean importance of what leaves where light lands first.
    /// Powers of two, so the survey's noise changes few.
    pub(crate) fn new<S: Spectrum>(context: &Context<'_, S>, targets: &[Target]) -> Self {
        let Some(mut survey) = Survey::new(context, targets) else { return Self::single(0) };
        let solution = connect_far_cells(context, &mut survey, 1);
        let Some(solution) = solution else { return Self::single(survey.rays) };
        let even = vec![GuidingTree::even(); survey.known.len()];
        let weights = importance_weights(&survey, &solution, &even);
        let copies = |weight: f64| libm::exp2(libm::round(-libm::log2(weight)));
        let by_cell = weights.into_iter().map(|weight| copies(weight).clamp(1.0, MAX_COPIES));
        let by_cell: Vec<f64> = by_cell.collect();
        let regions = by_cell.iter().any(|copies| *copies > 1.0).then(|| survey.regions());
        Self { regions, by_cell, rays: survey.rays }
    }

    /// Those that leave a place.
    pub(crate) fn at(&self, at: &Interaction) -> f64 {
        let number = self.regions.as_ref().and_then(|it| it.number(at.position, at.n));
        number.map_or(1.0, |number| self.by_cell[number])
    }

    /// Whether there is more than one anywhere.
    pub(crate) fn are_several(&self) -> bool {
        self.regions.is_some()
    }

    /// Puts them among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        self.regions.iter().for_each(|regions| regions.put(out));
        out.value(&self.by_cell);
    }
}
