//! Copies of light subpaths by place: one where lights shine, more where what leaves matters more
//! to the sensors. A function of the place alone, so it may stand in the densities of paths.

use super::cells::Regions;
use super::connect_far_cells;
use super::flux_and_importance::{FluxAndImportance, landing};
use super::guiding_tree::GuidingTree;
use super::survey::Survey;
use super::weight_windows::{Split, importance_weights, next_squares};
use crate::codec::Writer;
use crate::context::Context;
use crate::spectrum::Spectrum;
use crate::stats::efficiency::Performance;
use crate::world::Interaction;

/// Copies at most: rarer light is left to the bound.
const MAX_COPIES: f64 = 64.0;
/// Light subpaths have copies where the same error then costs this many times fewer rays: the bound
/// on unseen light doubles with them, and takes as many more.
const WORTHWHILE: f64 = 2.0;

/// How many copies of a light subpath leave each surveyed cell on average, were nothing absorbed.
pub(crate) struct Copies {
    /// `None` where there is one everywhere.
    regions: Option<Regions>,
    by_cell: Vec<f64>,
    /// Rays of the survey.
    pub(crate) rays: u64,
}

impl Copies {
    /// One copy everywhere, after a survey of this many rays.
    pub(crate) fn single(rays: u64) -> Self {
        Self { regions: None, by_cell: Vec::new(), rays }
    }

    /// By a survey of the scene: in proportion to the importance of what leaves a cell, in the mean
    /// square over its next step, over the mean importance of what leaves where the photons that
    /// lights `emit` land first. The mean is over their number, whatever they carry: where a faint
    /// lamp has its photons, copies would cost more than they bring. Powers of two, so the survey's
    /// noise changes few.
    pub(crate) fn new<S: Spectrum>(context: &Context<'_, S>, mut survey: Survey) -> Self {
        let solution = connect_far_cells(context, &mut survey, 1);
        let Some(solution) = solution else { return Self::single(survey.rays) };
        let even = vec![GuidingTree::even(); survey.known.len()];
        let weights = importance_weights(&survey, &solution, &even, |first| first.photons);
        let copies = |weight: f64| libm::exp2(libm::round(-libm::log2(weight)));
        let by_cell = weights.into_iter().map(|weight| copies(weight).clamp(1.0, MAX_COPIES));
        let by_cell: Vec<f64> = by_cell.collect();
        let single = vec![1.0; by_cell.len()];
        let [without, with] = predict(&survey, &solution, [&single, &by_cell]);
        let is_worthwhile = without.cost_of_error() > WORTHWHILE * with.cost_of_error();
        let regions = is_worthwhile.then(|| survey.regions());
        Self { regions, by_cell, rays: survey.rays }
    }

    /// Mean number of copies of a light subpath that leave a place, were nothing absorbed.
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

/// Predictions for one emitted photon: its rays, and the variance of the sum over the sensors of
/// what it gives to each, were nothing but photons seen. As for windows
/// ([`super::weight_windows`]), but photons have the weights that their lights gave them. For each
/// choice of the copies.
fn predict<const N: usize>(
    survey: &Survey,
    solution: &FluxAndImportance,
    choices: [&[f64]; N],
) -> [Performance; N] {
    let known = &survey.known;
    let even = GuidingTree::even();
    let next_square = next_squares(survey, solution, known.iter().map(|_| &even));
    let photons = landing(survey, |first| first.photons);
    let squares = landing(survey, |first| first.squares);
    choices.map(|copies| {
        let mut performance = Performance { rays: 1.0, variance: 0.0 };
        for (cell, from) in known.iter().enumerate() {
            let leaving = from.albedo * copies[cell];
            let d = solution.leaving_importance[cell];
            performance.rays += photons[cell] * leaving;
            let of_next = (next_square[cell] - d * d).max(0.0);
            performance.variance += squares[cell] * from.albedo / copies[cell] * of_next;
        }
        let mut decide = |cell: usize, square: f64, before: f64| {
            let expected = known[cell].albedo * copies[cell] / before;
            let split = Split { expected, weight: 1.0 / copies[cell] };
            let d = solution.leaving_importance[cell] * split.weight;
            performance.variance += square * before * split.variance() * d * d;
        };
        for (cell, first) in survey.first_landings.iter().enumerate() {
            decide(cell, first.squares, 1.0);
        }
        for (cell, from) in known.iter().enumerate() {
            for step in from.steps() {
                let square = squares[cell] * from.albedo * step.share * step.weight;
                decide(step.cell as usize, square, copies[cell]);
            }
        }
        performance
    })
}
