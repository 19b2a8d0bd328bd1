//! The ways to join photons, tried: how many are joined for each path, and whether they are
//! steered.
//!
//! A trial of each shows variances V of paths and U of a photon, at each sensor point and for one
//! sample, and what both cost in rays: n photons a path leave `V + U / n`. Of all powers of two for
//! n the cheapest is taken ([`crate::estimator::selection`]). Where a survey would have photons
//! steered, they are tried steered and left alone. The best is compared with what needs no joined
//! photons. Variances are relative to the tolerance, or else to the value. What paths hardly ever
//! find does not show in their spread: what they are short of counts as an error of theirs.

use super::{ConnectionPlan, LightVertexConnections};
use crate::context::Context;
use crate::estimator::exact::Exact;
use crate::estimator::pilot::{
    BY_CHANCE, ErrorTarget, MUCH_MORE, PilotCost, REPLICATES, SAMPLES, Sample, Trial,
};
use crate::importance::{self, Performance, Plan, WORTHWHILE};
use crate::path::partition::Partition;
use crate::photon::counts::PhotonCounts;
use crate::settings::{Settings, Switch};
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::Target;
use crate::stats::watch::Watch;

/// Photons for each path of a trial.
const PHOTONS: u64 = 8;
/// Most photons for a path.
const MAX_PHOTONS: u64 = 64;
/// The same for photons that are only counted.
const COARSE_PHOTONS: u64 = 64;
const MAX_COARSE_PHOTONS: u64 = 1024;
/// In a longer run, the error of the paths falls to about this part of what photons leave by then:
/// they ask for fewer coordinates. Measured on the office and the cube, where it makes the error
/// least for the rays.
const LATER: f64 = 0.125;
/// Photons are not counted by cell where sensors times cells are more than this: they would take 8
/// bytes each.
const MAX_VIEWS: usize = 1 << 24;
/// A ray that joins costs this part of a ray on a path: it only asks whether anything is in the
/// way, and its neighbours end where it does.
const JOINING_RAY: f64 = 0.25;

/// What is left to chance of photons that are steered by nothing: measured on the office and the
/// cube.
const SMALL: f64 = 0.1;
/// The most that is left to chance.
const LARGEST: f64 = 64.0;

/// What there is without joined photons.
pub(crate) struct Alone<'t> {
    /// Paths that hardly end.
    pub(crate) trial: &'t Trial,
    /// The part of their rays that the best way takes, and finds about what they find.
    pub(crate) part: f64,
    /// Whether they seem to find all light.
    pub(crate) finds_light: bool,
}

/// All ways that a survey of the scene leaves.
pub(crate) struct Ways {
    ways: Vec<Way>,
    /// That it took to try them.
    pub(crate) rays: u64,
}

/// A way to join photons, tried.
struct Way {
    connection: ConnectionPlan,
    expected_lx: Vec<f64>,
    light_vertices: Trial,
    coarse: Trial,
    beside: Trial,
    /// Rays that it takes to find out what all targets see.
    beforehand: f64,
    /// How many times what its trial promises it may cost.
    doubt: f64,
}

/// How photons are joined best in one way.
struct Best {
    /// For each path.
    photons: u64,
    /// For each path, only counted.
    cell_photons: u64,
    variances: Vec<f64>,
    of_paths: f64,
    of_photons: f64,
    beforehand: f64,
}

impl Ways {
    /// Surveys the scene, and tries what the settings leave open.
    pub(crate) fn try_all<S: Spectrum>(
        context: &Context<'_, S>,
        settings: &Settings,
        (targets, exact, sample): (&[Target], &[Exact], &Sample),
        quantum: Quantum,
        watch: &mut Watch<'_>,
    ) -> Self {
        let mut rays = 0;
        let mut ways = Vec::new();
        for (plan, doubt) in plans(context, targets, settings.importance) {
            let Plan { windows, forecast, steered, rays: of_survey, .. } = plan;
            rays += of_survey;
            let Some(forecast) = forecast else { continue };
            let expected_lx = exact.iter().enumerate();
            let expected_lx: Vec<f64> = expected_lx
                .map(|(target, exact)| exact.sum_lx() + forecast.indirect_lx(target))
                .collect();
            let asked_lx = sample.of(&expected_lx);
            let is_coarse = targets.len() * forecast.places.len() <= MAX_VIEWS;
            let connection = ConnectionPlan {
                partition: Partition {
                    landings: forecast.landings,
                    photons: PHOTONS,
                    is_guided: windows.is_some(),
                },
                places: forecast.places,
                windows,
                cell_photons: if is_coarse { COARSE_PHOTONS } else { 0 },
                small: left_to_chance(steered),
            };
            let kept = (0, quantum);
            let mut pilot = LightVertexConnections::new(
                context,
                connection,
                &sample.targets,
                asked_lx,
                REPLICATES,
                kept,
            );
            // Before the first checkpoint the observer stops nothing, so there are always counts.
            let counts = pilot.grow(context, SAMPLES, watch).unwrap_or_default();
            let [light_vertices, coarse] = found(&pilot, sample.targets.len(), &counts);
            // Photons that are counted serve all targets, not those alone that are looked at.
            let coarse = Trial { rays: coarse.rays / sample.step as f64, ..coarse };
            let beside =
                Trial::of_paths_beside(context, sample, &pilot.connection.partition, quantum);
            rays += pilot.rays + beside.rays as u64;
            rays += counts.iter().map(|counts| counts.rays).sum::<u64>();
            let beforehand = pilot.rays as f64 * sample.targets_for_each();
            let connection = pilot.connection;
            ways.push(Way {
                connection,
                expected_lx,
                light_vertices,
                coarse,
                beside,
                beforehand,
                doubt,
            });
        }
        Self { ways, rays }
    }

    /// The best of them, where that is asked for, or where it promises fewer rays than there are
    /// without, or finds much more light where that was to be feared: of light that is seldom
    /// found, a spread says nothing.
    pub(crate) fn choose<S: Spectrum>(
        mut self,
        context: &Context<'_, S>,
        settings: &Settings,
        sample: &Sample,
        alone: &Alone<'_>,
        (targets, (quantum, replicates)): (&[Target], (Quantum, u32)),
    ) -> Option<LightVertexConnections> {
        let Alone { trial: alone, part, finds_light } = *alone;
        let wanted = ErrorTarget::new(settings, sample, self.means_lx(&sample.exact_lx, alone));
        let noise = wanted.variances(alone).iter().sum::<f64>()
            + self.ways.iter().flat_map(|way| way.variances(&wanted)).sum::<f64>();
        let noise = noise / (REPLICATES.len() * wanted.seen().count().max(1)) as f64;
        let found_alone_lx = |target: usize| sample.exact_lx[target] + alone.moments(target).mean;
        let missed = wanted.shortfall(found_alone_lx, noise);
        let of_alone: Vec<f64> = wanted.variances(alone).iter().map(|v| v + missed).collect();
        let plain = PilotCost::of_paths(&of_alone, alone.rays);
        let pays = |best: &Best, way: &Way| {
            let finds_more = |target: usize| {
                let found_lx = sample.exact_lx[target] + way.found_lx(target);
                let more_lx = found_lx - found_alone_lx(target);
                let noise = (way.variance(target) + alone.moments(target).variance)
                    / REPLICATES.len() as f64;
                found_lx > MUCH_MORE * found_alone_lx(target)
                    && more_lx * more_lx > BY_CHANCE * noise
            };
            (!finds_light && wanted.seen().any(finds_more))
                || way.doubt * wanted.rays(&plain, &best.pilot_cost())
                    < part * wanted.rays(&plain, &plain)
        };
        let tried = self.ways.iter().map(|way| way.best(&sample.exact_lx, &wanted, noise));
        let effort = |(best, way): &(Best, &Way)| way.doubt * wanted.effort(&best.pilot_cost());
        let best = tried.zip(&self.ways).enumerate();
        let best = best.min_by(|(_, a), (_, b)| effort(a).total_cmp(&effort(b)));
        let best =
            best.filter(|(_, (best, way))| settings.connections() == Some(true) || pays(best, way));
        let best = best.map(|(number, (best, _))| (number, best));
        best.map(|(number, Best { photons, cell_photons, .. })| {
            let way = self.ways.swap_remove(number);
            let partition = Partition { photons, ..way.connection.partition };
            let connection = ConnectionPlan { partition, cell_photons, ..way.connection };
            let replicates = 0..replicates;
            let kept = (context.listed_terms, quantum);
            LightVertexConnections::new(
                context,
                connection,
                targets,
                way.expected_lx,
                replicates,
                kept,
            )
        })
    }

    /// The illuminance at each target, as far as known: the most that any way found, for what is
    /// seldom found is found too little by most.
    fn means_lx(&self, exact_lx: &[f64], alone: &Trial) -> Vec<f64> {
        let mean_lx = |(target, exact_lx): (usize, &f64)| {
            let found = |way: &Way| way.found_lx(target);
            let most = self.ways.iter().map(found).fold(alone.moments(target).mean, f64::max);
            exact_lx + most
        };
        exact_lx.iter().enumerate().map(mean_lx).collect()
    }
}

/// Photons as the survey says, and how far to doubt what a trial of them promises. Where the survey
/// says that they should be steered, they are also left alone; their trial then hardly sees what
/// the survey predicts, and what it promises is taken for as much dearer as the survey is surer of
/// itself.
fn plans<S: Spectrum>(
    context: &Context<'_, S>,
    targets: &[Target],
    importance: Switch,
) -> Vec<(Plan, f64)> {
    let plan = importance::foresee(context, targets, importance);
    let is_open = importance == Switch::Auto && plan.windows.is_some();
    let doubt = plan.gain / WORTHWHILE;
    let plain = is_open.then(|| (importance::foresee(context, targets, Switch::Off), doubt));
    std::iter::once((plan, 1.0)).chain(plain).collect()
}

impl Way {
    /// By photons and by paths beside them, at one target.
    fn found_lx(&self, target: usize) -> f64 {
        let all = [&self.light_vertices, &self.coarse, &self.beside];
        all.into_iter().map(|trial| trial.moments(target).mean).sum()
    }

    /// The variance of that in one replicate, in lx^2.
    fn variance(&self, target: usize) -> f64 {
        let all = [&self.light_vertices, &self.coarse, &self.beside];
        all.into_iter().map(|trial| trial.moments(target).variance).sum()
    }

    /// Of one sample with the photons that were tried.
    fn variances(&self, wanted: &ErrorTarget) -> Vec<f64> {
        let [mut sums, light_vertices, coarse] =
            [&self.beside, &self.light_vertices, &self.coarse].map(|trial| wanted.variances(trial));
        sums.iter_mut()
            .zip(light_vertices.iter().zip(&coarse))
            .for_each(|(sum, (a, b))| *sum += a + b);
        sums
    }

    fn best(&self, exact_lx: &[f64], wanted: &ErrorTarget, noise: f64) -> Best {
        let found_lx = |target: usize| exact_lx[target] + self.found_lx(target);
        // What is seldom found, joined photons would have found.
        let shortfall = wanted.shortfall(found_lx, noise);
        let beside = wanted.variances(&self.beside);
        let light_vertices: Vec<f64> =
            wanted.variances(&self.light_vertices).iter().map(|v| v + shortfall).collect();
        let coarse = wanted.variances(&self.coarse);
        let with = |part: f64, photons: u64, cell_photons: u64| {
            let of_connected = photons as f64 / PHOTONS as f64;
            let of_coarse = cell_photons as f64 / COARSE_PHOTONS as f64;
            let variances = beside
                .iter()
                .zip(light_vertices.iter().zip(&coarse))
                .map(|(v, (light_vertices, coarse))| {
                    v * part + light_vertices / of_connected + coarse / of_coarse
                })
                .collect();
            let of_photons = self.light_vertices.rays * of_connected + self.coarse.rays * of_coarse;
            let (of_paths, beforehand) = (self.beside.rays, self.beforehand);
            Best { photons, cell_photons, variances, of_paths, of_photons, beforehand }
        };
        let is_coarse = self.coarse.rays > 0.0;
        let most_coarse = if is_coarse { MAX_COARSE_PHOTONS } else { 1 };
        let pairs = powers_up_to(MAX_PHOTONS)
            .flat_map(|photons| powers_up_to(most_coarse).map(move |coarse| (photons, coarse)));
        let later = |&(photons, coarse): &(u64, u64)| {
            wanted.effort(&with(LATER, photons, coarse).pilot_cost())
        };
        let best = pairs.min_by(|a, b| later(a).total_cmp(&later(b)));
        let (photons, cell_photons) = best.unwrap_or((1, 1));
        let best = with(1.0, photons, cell_photons);
        Best { cell_photons: if is_coarse { cell_photons } else { 0 }, ..best }
    }
}

impl Best {
    fn pilot_cost(&self) -> PilotCost<'_> {
        let Self { variances, of_paths, of_photons, beforehand, .. } = self;
        let (of_paths, of_photons, beforehand) = (*of_paths, *of_photons, *beforehand);
        PilotCost { variances, of_paths, of_photons, beforehand }
    }
}

/// 1, 2, 4 and so on.
fn powers_up_to(most: u64) -> impl Iterator<Item = u64> {
    std::iter::successors(Some(1), |power| Some(2 * power)).take_while(move |power| *power <= most)
}

/// The part of what a target gets below which deviations are left to chance.
///
/// Where a deviation c, in parts of what a target gets, is asked for with probability c / t, that
/// adds c t to the variance of a photon there, and saves 1 - c / t of a ray. Variance times cost is
/// least where `t^2 = V r / R`: V the sum over the targets of the relative variance of a photon, R
/// its rays, and r what a join costs (compare A. Rath et al., "EARS: efficiency-aware Russian
/// roulette and splitting", ACM Trans. Graph. 41(4), 2022). V is what the survey predicts of
/// photons that are steered: a trial hardly sees the rare ones that make most of it.
fn left_to_chance(steered: Option<Performance>) -> f64 {
    let of_steered = |Performance { rays, variance }: Performance| {
        (variance * JOINING_RAY / rays).sqrt().clamp(SMALL, LARGEST)
    };
    // Quasi-random points leave little of the variance of the others.
    steered.map_or(SMALL, of_steered)
}

/// What joined and counted photons found.
fn found(pilot: &LightVertexConnections, targets: usize, counts: &[PhotonCounts; 2]) -> [Trial; 2] {
    let pairs = || (0..targets).flat_map(|target| (0..REPLICATES.len()).map(move |r| (r, target)));
    let fine_lx = pairs().map(|(r, target)| pilot.fine_lx(r, target)).collect();
    let cells_lx = pairs().map(|(r, target)| pilot.cells_lx(r, target, None)).collect();
    let [fine, coarse] = counts;
    let connections = fine.connections as f64;
    let rays = fine.rays as f64 - connections + JOINING_RAY * connections;
    [Trial { lx: fine_lx, rays }, Trial { lx: cells_lx, rays: coarse.rays as f64 }]
}
