//! Weight windows, of no width: the weight that photons leave each cell with, by splitting and
//! Russian roulette.
//!
//! A photon of weight w that lands where photons leave with weight W is followed by `m = w a / W`
//! photons on average, a the albedo: splitting where m is above one, roulette and absorption in one
//! decision where it is below (T. E. Booth and J. S. Hendricks, "Importance estimation in forward
//! Monte Carlo calculations", Nuclear Technology/Fusion 5(1), 1984). W is in inverse proportion to
//! the importance of a photon that leaves, in the mean square over its next step, so that rays
//! times variance are least; a photon at its light has the mean importance of those that leave
//! where it lands. Here is the rule ([`Split`]), which photons without windows obey too;
//! `photon::trace` draws the number of children and makes them.

use crate::codec::Writer;
use crate::importance::cells::Regions;
use crate::importance::flux_and_importance::FluxAndImportance;
use crate::importance::guiding_tree::{GuidingSample, GuidingTree};
use crate::importance::survey::{FirstLandings, Survey, SurveyCell, Transition};
use crate::stats::efficiency::Performance;
use crate::world::Interaction;
use rayon::prelude::*;

/// No photon is split into more at one landing.
pub(crate) const MAX_CHILDREN: f64 = 16.0;
/// Weights stay within these: below the first, fixed-point tallies would have no room; above the
/// second, photons that the survey took for worthless would matter too much where it was wrong.
const LIGHTEST: f64 = 1.0 / (1 << 16) as f64;
const HEAVIEST: f64 = 8.0;

/// Weight windows and guides by surveyed cell.
pub(crate) struct WeightWindows {
    regions: Regions,
    /// By number of the cell.
    windows: Vec<Window>,
}

/// Weight window of one cell.
#[derive(Clone, Debug)]
pub(crate) struct Window {
    /// Weight with which photons leave, on average over their directions.
    pub(crate) weight: f64,
    /// In which directions.
    pub(crate) guide: GuidingTree,
}

impl WeightWindows {
    /// In inverse proportion to importance.
    pub(crate) fn new(survey: &Survey, solution: &FluxAndImportance) -> Self {
        Self { regions: survey.regions(), windows: importance_windows(survey, solution) }
    }

    /// Puts them among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        self.regions.put(out);
        for Window { weight, guide } in &self.windows {
            out.value(weight);
            guide.put(out);
        }
    }

    /// A power of two that no photon leaves below, but for what guiding and rough surfaces take
    /// from it.
    pub(crate) fn lightest(&self) -> f64 {
        let least = self.windows.iter().map(|window| window.weight).fold(1.0, f64::min);
        libm::ldexp(1.0, libm::ilogb(least))
    }

    /// The window at a place; `None` where the survey found nothing.
    pub(crate) fn at(&self, at: &Interaction) -> Option<&Window> {
        self.windows.get(self.regions.number(at.position, at.n)?)
    }
}

/// Predictions for one emitted photon: its rays, and the variance of the sum over the sensors of
/// what it gives to each, in units of the sensor.
impl Performance {
    /// Of photons of equal weight.
    pub(crate) fn plain(survey: &Survey, solution: &FluxAndImportance) -> Self {
        let even = Window { weight: 1.0, guide: GuidingTree::even() };
        Self::predict(survey, solution, &vec![even; survey.known.len()])
    }

    /// Of photons that are guided.
    pub(crate) fn guided(survey: &Survey, solution: &FluxAndImportance) -> Self {
        Self::predict(survey, solution, &importance_windows(survey, solution))
    }

    /// Sums over all landings of the variance that the decision there and the next step bring. From
    /// weight w come `m = w a / W` photons, n of them by chance; what one of them brings has mean d
    /// and mean square q: in all `W^2 (m (q - d^2) + Var n d^2)`.
    fn predict(survey: &Survey, solution: &FluxAndImportance, windows: &[Window]) -> Self {
        let known = &survey.known;
        let guides = windows.iter().map(|window| &window.guide);
        let next_square = next_squares(survey, solution, guides);
        let mut performance = Self { rays: 1.0, variance: 0.0 };
        let mut land = |cell: usize, photons: f64, weight: f64| {
            let split = Split::new(weight * known[cell].albedo, windows[cell].weight);
            let (d, q) = (solution.leaving_importance[cell], next_square[cell]);
            let of_next = split.expected * (q - d * d).max(0.0) + split.variance() * d * d;
            performance.rays += photons * split.expected;
            performance.variance += photons * split.weight * split.weight * of_next;
        };
        for (cell, first) in survey.first_landings.iter().enumerate() {
            land(cell, first.flux, 1.0);
        }
        for (cell, from) in known.iter().enumerate() {
            let window = &windows[cell];
            let photons = solution.landing[cell] * from.albedo / window.weight;
            for step in from.steps() {
                let density = window.guide.density(step.u.map(f64::from));
                let weight = window.weight * step.weight / density;
                land(step.cell as usize, photons * step.share * density, weight);
            }
        }
        performance
    }
}

/// How many photons follow one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Split {
    /// Their mean number.
    pub(crate) expected: f64,
    /// The weight of each.
    pub(crate) weight: f64,
}

impl Split {
    /// Of what is left of a photon after absorption, where photons leave with `target`; of more
    /// than [`MAX_CHILDREN`] each carries more.
    pub(crate) fn new(left: f64, target: f64) -> Self {
        let expected = if left > 0.0 { (left / target).min(MAX_CHILDREN) } else { 0.0 };
        Self { expected, weight: if expected < MAX_CHILDREN { target } else { left / expected } }
    }

    /// Of their number, which is one of the two integers next to the mean.
    pub(super) fn variance(self) -> f64 {
        let rest = self.expected - self.expected.floor();
        rest * (1.0 - rest)
    }
}

/// Weight windows of the known cells, by importance.
fn importance_windows(survey: &Survey, solution: &FluxAndImportance) -> Vec<Window> {
    let guides = guides(survey, solution);
    let weights = importance_weights(survey, solution, &guides, |first| first.flux);
    let windows = weights.into_iter().zip(guides);
    windows.map(|(weight, guide)| Window { weight, guide }).collect()
}

/// Directions from each known cell by the importance of its rays and of its neighbours' rays.
fn guides(survey: &Survey, solution: &FluxAndImportance) -> Vec<GuidingTree> {
    let hints = |cell: &SurveyCell| -> Vec<GuidingSample> {
        let hint = |step: Transition| {
            let importance =
                step.share * step.weight * solution.landed_importance[step.cell as usize];
            GuidingSample::new(step.u.map(f64::from), importance)
        };
        cell.steps().map(hint).collect()
    };
    let own: Vec<Vec<GuidingSample>> = survey.known.par_iter().map(hints).collect();
    let guide = |cell: &SurveyCell| {
        let around = survey.numbers_around(cell);
        GuidingTree::new(around.flat_map(|number| own[number].iter().copied()).collect())
    };
    survey.known.par_iter().map(guide).collect()
}

/// Mean squares of the importance, where they land, of photons that leave each known cell by its
/// guide: over even rays, importance^2 / density.
pub(super) fn next_squares<'g>(
    survey: &Survey,
    solution: &FluxAndImportance,
    guides: impl Iterator<Item = &'g GuidingTree>,
) -> Vec<f64> {
    let of_cell = |(cell, guide): (&SurveyCell, &GuidingTree)| {
        let squares = cell.steps().map(|step| {
            let importance = step.weight * solution.landed_importance[step.cell as usize];
            step.share * importance * importance / guide.density(step.u.map(f64::from))
        });
        squares.sum::<f64>()
    };
    survey.known.iter().zip(guides).map(of_cell).collect()
}

/// The weight with which photons leave each known cell: in inverse proportion to the root mean
/// square of their next importance, which makes rays times variance least. Mean squares are
/// those of the cells around. Where
/// photons `start`, by cells that they land in first, it is one on average.
pub(super) fn importance_weights(
    survey: &Survey,
    solution: &FluxAndImportance,
    guides: &[GuidingTree],
    start: impl Fn(&FirstLandings) -> f64,
) -> Vec<f64> {
    let squares = next_squares(survey, solution, guides.iter());
    let root_mean = |cell: &SurveyCell| {
        let around = survey.numbers_around(cell);
        let (sum, count) =
            around.fold((0.0, 0.0), |(sum, n), number| (sum + squares[number], n + 1.0));
        (sum / count).sqrt()
    };
    let importances: Vec<f64> = survey.known.iter().map(root_mean).collect();
    let leaving: Vec<f64> = survey
        .first_landings
        .iter()
        .zip(&survey.known)
        .map(|(first, cell)| start(first) * cell.albedo)
        .collect();
    let total: f64 = leaving.iter().zip(&importances).map(|(share, it)| share * it).sum();
    let mean_importance = total / leaving.iter().sum::<f64>();
    let weight = |importance: &f64| (mean_importance / importance).clamp(LIGHTEST, HEAVIEST);
    if mean_importance > 0.0 {
        importances.iter().map(weight).collect()
    } else {
        vec![1.0; importances.len()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_keep_the_weight() {
        for (left, target) in [(0.5, 1.0), (1.0, 0.3), (1.0, 1e-6), (1e-3, 8.0), (0.7, 0.7)] {
            let split = Split::new(left, target);
            assert!((split.expected * split.weight / left - 1.0).abs() < 1e-12, "{split:?}");
            assert!(split.expected <= MAX_CHILDREN && split.variance() <= 0.25);
        }
    }
}
