//! When bidirectional paths take a sensor point over from the selected estimator.

use crate::stats::decisions::Decisions;
use crate::stats::estimates::SensorEstimates;
use crate::stats::interval::{Interval, t_quantile_for};

/// Probability that the probe contradicts any sensor point at one look by chance.
const FALSE_ALARM: f64 = 1e-3;
/// Bidirectional paths take over where they promise the same error for at most this many times the
/// rays. Of plain paths they are the safe form. What connections of photons promise may hang on
/// light that a survey or a pilot did not see, most of all where nothing guides the photons, and
/// what hides a tail promises nothing.
const FOR_PATHS: f64 = 1.0;
const FOR_GUIDED_CONNECTIONS: f64 = 2.0;
const FOR_CONNECTIONS: f64 = 4.0;
const FOR_A_TAIL: f64 = 8.0;

/// How the probe judges the selected estimator at a sensor point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Takeover {
    /// It goes on.
    No,
    /// The probe found more light than it.
    MissesLight,
    /// Bidirectional paths need fewer rays.
    Pays,
}

impl Takeover {
    pub(super) fn is_due(self) -> bool {
        self != Self::No
    }
}

/// How far a sensor point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PointState {
    /// The selected estimator works at it.
    Open,
    /// It has reached its tolerance.
    Converged,
    /// Bidirectional paths have taken it over.
    TakenOver,
}

impl PointState {
    /// Of all sensor points.
    pub(super) fn of_all(converged: &[bool], taken_over: &[bool]) -> Vec<Self> {
        let state = |(converged, taken_over): (&bool, &bool)| match (converged, taken_over) {
            (_, true) => Self::TakenOver,
            (true, false) => Self::Converged,
            (false, false) => Self::Open,
        };
        converged.iter().zip(taken_over).map(state).collect()
    }
}

/// The selected estimator and the probe at a checkpoint.
pub(super) struct Judged<'e> {
    pub(super) selected: &'e [SensorEstimates],
    pub(super) probe: &'e [SensorEstimates],
    /// Rays that each of them took.
    pub(super) rays: [u64; 2],
    pub(super) kind: SelectedKind,
    /// Whether few connections make the variance of each sensor point.
    pub(super) photons_hide_tails: Vec<bool>,
}

/// How the selected estimator works.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SelectedKind {
    /// By paths, alone or on a map.
    Paths,
    /// By photons that are connected to the sensors, too.
    Connections,
    /// By such photons that are guided.
    GuidedConnections,
}

impl SelectedKind {
    pub(super) fn new(decisions: &Decisions) -> Self {
        match decisions {
            Decisions { connected_photons: None, .. } => Self::Paths,
            Decisions { uses_importance: true, .. } => Self::GuidedConnections,
            _ => Self::Connections,
        }
    }
}

/// Of all sensor points.
pub(super) fn all(judged: &Judged<'_>, states: &[PointState]) -> Vec<Takeover> {
    let replicates = judged.selected.first().map_or(0, |sensor| sensor.replicate_lx.len());
    let of_each = FALSE_ALARM / states.len().max(1) as f64;
    let quantiles = [of_each, FALSE_ALARM].map(|alarm| t_quantile_for(replicates, 2.0 * alarm));
    let [Some(t_of_each), Some(t_of_all)] = quantiles else {
        return vec![Takeover::No; states.len()];
    };
    let all_miss = miss_light_together(judged, states, t_of_all);
    let points = points(judged);
    let states = states.iter().zip(&judged.photons_hide_tails);
    let takeovers = points.zip(states).map(|(point, (state, hides_tail))| {
        let Point { own, probed, missed } = point;
        let [Some(own_error), Some(error)] = [own.half_width, probed.half_width] else {
            return Takeover::No;
        };
        let misses =
            all_miss || probed.value - own.value > t_of_each * libm::hypot(own_error, error);
        let cost = |error: f64, rays: u64| error * error * rays as f64;
        let worthwhile = match judged.kind {
            _ if missed || *hides_tail => FOR_A_TAIL,
            SelectedKind::Connections => FOR_CONNECTIONS,
            SelectedKind::GuidedConnections => FOR_GUIDED_CONNECTIONS,
            SelectedKind::Paths => FOR_PATHS,
        };
        let [own_rays, rays] = judged.rays;
        let pays = error > 0.0 && cost(error, rays) < worthwhile * cost(own_error, own_rays);
        match state {
            PointState::Open | PointState::Converged if misses => Takeover::MissesLight,
            PointState::Open if pays => Takeover::Pays,
            _ => Takeover::No,
        }
    });
    takeovers.collect()
}

/// A sensor point.
struct Point {
    /// What the selected estimator found.
    own: Interval,
    /// What the probe found.
    probed: Interval,
    /// Whether the selected estimator saw too few scores there.
    missed: bool,
}

fn points<'j>(judged: &'j Judged<'_>) -> impl Iterator<Item = Point> + 'j {
    let &Judged { selected, probe, .. } = judged;
    selected.iter().zip(probe).flat_map(|(selected, probe)| {
        let missed = selected.missed.iter().enumerate();
        missed.map(move |(point, missed)| {
            let [own, probed] = [selected, probe].map(|of| {
                let rows = of.replicate_lx.iter();
                Interval::of_mean(rows.map(|row| row[point]), Some(1.0))
            });
            Point { own, probed, missed: *missed }
        })
    })
}

/// Whether the probe finds more light than the selected estimator in the mean over all points that
/// this works at, each relative to its value: a miss that they share shows there long before it
/// shows at one of them. Replicates are independent, points of one need not be.
fn miss_light_together(judged: &Judged<'_>, states: &[PointState], t: f64) -> bool {
    let &Judged { selected, probe, .. } = judged;
    let values: Vec<f64> = points(judged).map(|point| point.own.value).collect();
    let replicates = selected.first().map_or(0, |sensor| sensor.replicate_lx.len());
    let differences = (0..replicates).map(|replicate| {
        let of_sensors = selected.iter().zip(probe);
        let lx = of_sensors.flat_map(|(selected, probe)| {
            probe.replicate_lx[replicate].iter().zip(&selected.replicate_lx[replicate])
        });
        let known = lx.zip(&values).zip(states);
        let counted =
            known.filter(|((_, value), state)| **state != PointState::TakenOver && **value > 0.0);
        counted.map(|(((probed, own), value), _)| (probed - own) / value).sum::<f64>()
    });
    let Interval { value, half_width } = Interval::of_mean(differences, Some(t));
    half_width.is_some_and(|half_width| value > half_width)
}
