//! Pilots of connection plans: how many photons are connected for each path, and whether weight
//! windows guide them.
//!
//! A pilot shows variances V of paths and U of a photon, at each sensor point and for one sample,
//! and the rays of both: n photons a path leave `V + U / n`. Of all powers of two for n the
//! cheapest is taken ([`crate::estimator::selection`]). Where a survey recommends weight windows,
//! photons are tried with and without them. The best plan is compared with the estimators that need
//! no connections. Variances are relative to the tolerance, or else to the value. Light that paths
//! hardly ever find does not show in their spread: their shortfall counts as an error.

use super::{ConnectionPlan, LightVertexConnections, TallySettings};
use crate::context::Context;
use crate::estimator::pilot::{
    BY_CHANCE, ErrorTarget, MUCH_MORE, PilotCost, REPLICATES, Request, SAMPLES, Sample, Trial,
};
use crate::importance::{self, Plan, WORTHWHILE};
use crate::path::partition::Partition;
use crate::photon::counts::PhotonCounts;
use crate::settings::Switch;
use crate::spectrum::Spectrum;
use crate::stats::efficiency::{Performance, cheapest};
use crate::stats::targets::Target;
use crate::stats::watch::Watch;

/// Photons for each path of a trial.
const PHOTONS: u64 = 8;
/// Most photons for a path.
const MAX_PHOTONS: u64 = 64;
/// The same for photons that are only counted by cell.
const CELL_PHOTONS: u64 = 64;
const MAX_CELL_PHOTONS: u64 = 1024;
/// In a longer run, the error of the paths falls to about this part of the photons' error: paths
/// use fewer coordinates. Measured on the office and the cube, where it makes the error least for
/// the rays.
const LATER: f64 = 0.125;
/// Photons are not counted by cell where sensors times cells are more than this: each pair takes 8
/// bytes.
const MAX_VIEWS: usize = 1 << 24;
/// Cost of a shadow ray of a connection, in rays of a path: it needs no closest hit, and its
/// neighbours end near it.
const SHADOW_RAY: f64 = 0.25;

/// [`ConnectionPlan::small`] of photons without weight windows, measured on the office and the
/// cube; and the largest of all.
const SMALL: f64 = 0.1;
const MAX_SMALL: f64 = 64.0;

/// The best estimate without connections.
pub(crate) struct PathsAlone<'t> {
    /// Paths without Russian roulette.
    pub(crate) trial: &'t Trial,
    /// The part of their rays that the best estimator takes, which finds about the same light.
    pub(crate) part: f64,
    /// Whether they seem to find all light.
    pub(crate) finds_light: bool,
}

/// Pilots of all plans that the survey and the settings leave open.
pub(crate) struct ConnectionPilots {
    pilots: Vec<ConnectionPilot>,
    /// Rays of all pilots.
    pub(crate) rays: u64,
}

/// The pilot of one plan.
struct ConnectionPilot {
    connection: ConnectionPlan,
    expected_lx: Vec<f64>,
    light_vertices: Trial,
    cells: Trial,
    beside: Trial,
    /// Rays by which all targets look at the survey's cells.
    beforehand: f64,
    /// Factor on the cost that its trial predicts.
    doubt: f64,
}

/// Numbers of photons for a plan, and its cost with them.
struct PhotonNumbers {
    /// For each path.
    connected: u64,
    /// For each path, only counted.
    cell_photons: u64,
    variances: Vec<f64>,
    of_paths: f64,
    of_photons: f64,
    beforehand: f64,
}

/// A plan of the survey, and the factor on the cost that its trial predicts.
struct Proposal {
    plan: Plan,
    doubt: f64,
}

impl ConnectionPilots {
    /// Surveys the scene, and tries the plans that the settings leave open.
    pub(crate) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        request: &Request<'_>,
        sample: &Sample,
        watch: &mut Watch<'_>,
    ) -> Self {
        let mut all = Self { pilots: Vec::new(), rays: 0 };
        for proposal in proposals(context, request.targets, request.settings.importance) {
            all.rays += proposal.plan.rays;
            all.add(context, request, sample, proposal, watch);
        }
        all
    }

    /// Tries one plan, if the survey found light on its way to sensors.
    fn add<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        request: &Request<'_>,
        sample: &Sample,
        Proposal { plan, doubt }: Proposal,
        watch: &mut Watch<'_>,
    ) {
        let Plan { windows, forecast: Some(forecast), guided, .. } = plan else { return };
        let expected_lx = request.exact.iter().enumerate();
        let expected_lx: Vec<f64> = expected_lx
            .map(|(target, exact)| exact.sum_lx() + forecast.indirect_lx(target))
            .collect();
        let counts_cells = request.targets.len() * forecast.places.len() <= MAX_VIEWS;
        let connection = ConnectionPlan {
            partition: Partition {
                landings: forecast.landings,
                photons: PHOTONS,
                is_guided: windows.is_some(),
            },
            places: forecast.places,
            windows,
            cell_photons: if counts_cells { CELL_PHOTONS } else { 0 },
            small: small_deviation(guided),
        };
        let quantum = request.quantum;
        let tallies = TallySettings { replicates: REPLICATES, listed_terms: 0, quantum };
        let sampled_lx = sample.select(&expected_lx);
        let mut pilot =
            LightVertexConnections::new(context, connection, &sample.targets, sampled_lx, tallies);
        // Before the first checkpoint the observer stops nothing, so there are always counts.
        let counts = pilot.grow(context, SAMPLES, watch).unwrap_or_default();
        let [light_vertices, cells] = trials(&pilot, sample.targets.len(), &counts);
        // Photons that are counted serve all targets, not those of the sample alone.
        let cells = Trial { rays: cells.rays / sample.step as f64, ..cells };
        let beside = Trial::of_paths(context, sample, Some(&pilot.connection.partition), quantum);
        self.rays += pilot.rays + beside.rays as u64;
        self.rays += counts.iter().map(|counts| counts.rays).sum::<u64>();
        let beforehand = pilot.rays as f64 * sample.targets_for_each();
        let connection = pilot.connection;
        self.pilots.push(ConnectionPilot {
            connection,
            expected_lx,
            light_vertices,
            cells,
            beside,
            beforehand,
            doubt,
        });
    }

    /// The best plan, where the settings ask for connections, where it predicts fewer rays than the
    /// best estimator without them, or where it finds much more light and paths are known to miss
    /// some: the spread of light that is seldom found says nothing.
    pub(crate) fn select<S: Spectrum>(
        mut self,
        context: &Context<'_, S>,
        request: &Request<'_>,
        sample: &Sample,
        alone: &PathsAlone<'_>,
    ) -> Option<LightVertexConnections> {
        let settings = request.settings;
        let means_lx = self.means_lx(&sample.exact_lx, alone.trial);
        let wanted = ErrorTarget::new(settings, sample, means_lx);
        let noise = wanted.variances(alone.trial).iter().sum::<f64>()
            + self.pilots.iter().flat_map(|pilot| pilot.variances(&wanted)).sum::<f64>();
        let noise = noise / (REPLICATES.len() * wanted.seen().count().max(1)) as f64;
        let numbers = |pilot: &ConnectionPilot| pilot.photon_numbers(sample, &wanted, noise);
        let priced = self.pilots.iter().map(numbers).zip(&self.pilots).enumerate();
        let (best, (numbers, pilot)) = cheapest(priced, |(_, (numbers, pilot))| {
            pilot.doubt * wanted.effort(&numbers.pilot_cost())
        })?;
        let pays = || alone.is_worse_than(pilot, &numbers, sample, &wanted, noise);
        if settings.connections() != Some(true) && !pays() {
            return None;
        }
        let PhotonNumbers { connected, cell_photons, .. } = numbers;
        let ConnectionPilot { connection, expected_lx, .. } = self.pilots.swap_remove(best);
        let partition = Partition { photons: connected, ..connection.partition };
        let connection = ConnectionPlan { partition, cell_photons, ..connection };
        let tallies = TallySettings {
            replicates: 0..request.replicates,
            listed_terms: context.listed_terms,
            quantum: request.quantum,
        };
        let targets = request.targets;
        Some(LightVertexConnections::new(context, connection, targets, expected_lx, tallies))
    }

    /// Illuminances at the targets of the sample, as far as known: the largest of all pilots, for
    /// most of them underestimate light that is seldom found.
    fn means_lx(&self, exact_lx: &[f64], alone: &Trial) -> Vec<f64> {
        let mean_lx = |(target, exact_lx): (usize, &f64)| {
            let sampled_lx = |pilot: &ConnectionPilot| pilot.sampled_lx(target);
            let start_lx = alone.moments(target).mean;
            exact_lx + self.pilots.iter().map(sampled_lx).fold(start_lx, f64::max)
        };
        exact_lx.iter().enumerate().map(mean_lx).collect()
    }
}

impl PathsAlone<'_> {
    fn sampled_lx(&self, sample: &Sample, target: usize) -> f64 {
        sample.exact_lx[target] + self.trial.moments(target).mean
    }

    /// Whether a pilot with these numbers of photons predicts fewer rays, or found much more light
    /// where paths seem to miss some. Trial means have the variance `noise`.
    fn is_worse_than(
        &self,
        pilot: &ConnectionPilot,
        numbers: &PhotonNumbers,
        sample: &Sample,
        wanted: &ErrorTarget,
        noise: f64,
    ) -> bool {
        let finds_more = |target: usize| {
            let (own_lx, other_lx) = (
                self.sampled_lx(sample, target),
                sample.exact_lx[target] + pilot.sampled_lx(target),
            );
            let more_lx = other_lx - own_lx;
            let variance = pilot.variance(target) + self.trial.moments(target).variance;
            other_lx > MUCH_MORE * own_lx
                && more_lx * more_lx > BY_CHANCE * variance / REPLICATES.len() as f64
        };
        if !self.finds_light && wanted.seen().any(finds_more) {
            return true;
        }
        let missed = wanted.shortfall(|target| self.sampled_lx(sample, target), noise);
        let variances: Vec<f64> = wanted.variances(self.trial).iter().map(|v| v + missed).collect();
        let plain = PilotCost::of_paths(&variances, self.trial.rays);
        pilot.doubt * wanted.rays(&plain, &numbers.pilot_cost())
            < self.part * wanted.rays(&plain, &plain)
    }
}

/// Plans of photons. Where the survey recommends weight windows, photons without them are also
/// tried; their trial hardly sees the light that the survey predicts, so that its cost is raised by
/// as much as the survey's gain exceeds the threshold.
fn proposals<S: Spectrum>(
    context: &Context<'_, S>,
    targets: &[Target],
    importance: Switch,
) -> Vec<Proposal> {
    let plan = importance::survey(context, targets, importance);
    let is_open = importance == Switch::Auto && plan.windows.is_some();
    let doubt = plan.gain / WORTHWHILE;
    let plain = is_open
        .then(|| Proposal { plan: importance::survey(context, targets, Switch::Off), doubt });
    std::iter::once(Proposal { plan, doubt: 1.0 }).chain(plain).collect()
}

impl ConnectionPilot {
    fn all_trials(&self) -> [&Trial; 3] {
        [&self.light_vertices, &self.cells, &self.beside]
    }

    /// Light by photons and by paths beside them at one target.
    fn sampled_lx(&self, target: usize) -> f64 {
        self.all_trials().into_iter().map(|trial| trial.moments(target).mean).sum()
    }

    /// Its variance in one replicate, in lx^2.
    fn variance(&self, target: usize) -> f64 {
        self.all_trials().into_iter().map(|trial| trial.moments(target).variance).sum()
    }

    /// Of one sample with the photons of the trial, by target.
    fn variances(&self, wanted: &ErrorTarget) -> Vec<f64> {
        let [mut sums, light_vertices, cells] =
            [&self.beside, &self.light_vertices, &self.cells].map(|trial| wanted.variances(trial));
        sums.iter_mut()
            .zip(light_vertices.iter().zip(&cells))
            .for_each(|(sum, (a, b))| *sum += a + b);
        sums
    }

    /// The numbers of photons of least cost.
    fn photon_numbers(&self, sample: &Sample, wanted: &ErrorTarget, noise: f64) -> PhotonNumbers {
        let found_lx = |target: usize| sample.exact_lx[target] + self.sampled_lx(target);
        // Light that is seldom found, connected photons would have found.
        let shortfall = wanted.shortfall(found_lx, noise);
        let beside = wanted.variances(&self.beside);
        let light_vertices: Vec<f64> =
            wanted.variances(&self.light_vertices).iter().map(|v| v + shortfall).collect();
        let cells = wanted.variances(&self.cells);
        let with = |part: f64, connected: u64, cell_photons: u64| {
            let of_connected = connected as f64 / PHOTONS as f64;
            let of_cells = cell_photons as f64 / CELL_PHOTONS as f64;
            let variances = beside
                .iter()
                .zip(light_vertices.iter().zip(&cells))
                .map(|(v, (light_vertices, cells))| {
                    v * part + light_vertices / of_connected + cells / of_cells
                })
                .collect();
            let of_photons = self.light_vertices.rays * of_connected + self.cells.rays * of_cells;
            let of_paths = self.beside.rays;
            let beforehand = self.beforehand;
            PhotonNumbers { connected, cell_photons, variances, of_paths, of_photons, beforehand }
        };
        let counts_cells = self.cells.rays > 0.0;
        let max_cell_photons = if counts_cells { MAX_CELL_PHOTONS } else { 1 };
        let pairs = powers_up_to(MAX_PHOTONS)
            .flat_map(|n| powers_up_to(max_cell_photons).map(move |cells| [n, cells]));
        let later = |&[n, cells]: &[u64; 2]| wanted.effort(&with(LATER, n, cells).pilot_cost());
        let [connected, cell_photons] = cheapest(pairs, later).unwrap_or([1, 1]);
        let best = with(1.0, connected, cell_photons);
        PhotonNumbers { cell_photons: if counts_cells { cell_photons } else { 0 }, ..best }
    }
}

impl PhotonNumbers {
    fn pilot_cost(&self) -> PilotCost<'_> {
        let Self { variances, of_paths, of_photons, beforehand, .. } = self;
        let (of_paths, of_photons, beforehand) = (*of_paths, *of_photons, *beforehand);
        PilotCost { variances, of_paths, of_photons, beforehand }
    }
}

/// 1, 2, 4 and so on.
fn powers_up_to(max: u64) -> impl Iterator<Item = u64> {
    std::iter::successors(Some(1), |power| Some(2 * power)).take_while(move |power| *power <= max)
}

/// [`ConnectionPlan::small`]: the part of a target's illuminance below which deviations are left to
/// Russian roulette.
///
/// Where a deviation c, in parts of the target's illuminance, gets a shadow ray with probability c
/// / t, that adds c t to the variance of a photon there, and saves 1 - c / t of a ray. Variance
/// times cost is least where `t^2 = V r / R`: V the sum over the targets of the relative variance
/// of a photon, R its rays, and r the cost of a shadow ray (compare A. Rath et al., "EARS:
/// efficiency-aware Russian roulette and splitting", ACM Trans. Graph. 41(4), 2022). V is the
/// survey's prediction for photons with weight windows: a trial hardly sees the rare ones that make
/// most of it.
fn small_deviation(guided: Option<Performance>) -> f64 {
    let cost = |Performance { rays, variance }: Performance| {
        (variance * SHADOW_RAY / rays).sqrt().clamp(SMALL, MAX_SMALL)
    };
    // Quasi-random points leave little of the variance of the others.
    guided.map_or(SMALL, cost)
}

/// Light by connected photons, and by photons counted by cell.
fn trials(
    pilot: &LightVertexConnections,
    targets: usize,
    counts: &[PhotonCounts; 2],
) -> [Trial; 2] {
    let values_lx = |value_lx: &dyn Fn(usize, usize) -> f64| -> Vec<f64> {
        let replicates = 0..REPLICATES.len();
        (0..targets).flat_map(|t| replicates.clone().map(move |r| value_lx(r, t))).collect()
    };
    let fine_lx = values_lx(&|r, target| pilot.fine_lx(r, target));
    let cells_lx = values_lx(&|r, target| pilot.cells_lx(r, target, None));
    let [fine, cells] = counts;
    let connections = fine.connections as f64;
    let rays = fine.rays as f64 - connections + SHADOW_RAY * connections;
    [Trial { lx: fine_lx, rays }, Trial { lx: cells_lx, rays: cells.rays as f64 }]
}
