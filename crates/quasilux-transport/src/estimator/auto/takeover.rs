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
    let &Judged { selected, probe, rays, kind, .. } = judged;
    let values = |sensor: usize, point: usize| {
        [selected, probe].map(|of| {
            let rows = of[sensor].replicate_lx.iter();
            Interval::of_mean(rows.map(|row| row[point]), Some(1.0))
        })
    };
    let points = selected.iter().enumerate().flat_map(|(sensor, figures)| {
        let missed = figures.missed.iter().enumerate();
        missed.map(move |(point, missed)| (values(sensor, point), *missed))
    });
    let replicates = selected.first().map_or(0, |sensor| sensor.replicate_lx.len());
    let of_each = FALSE_ALARM / states.len().max(1) as f64;
    let Some(t) = t_quantile_for(replicates, 2.0 * of_each) else {
        return vec![Takeover::No; states.len()];
    };
    let states = states.iter().zip(&judged.photons_hide_tails);
    let takeovers = points.zip(states).map(|(([own, probed], missed), (state, hides_tail))| {
        let [Some(own_error), Some(error)] = [own.half_width, probed.half_width] else {
            return Takeover::No;
        };
        let misses = probed.value - own.value > t * libm::hypot(own_error, error);
        let cost = |error: f64, rays: u64| error * error * rays as f64;
        let worthwhile = match kind {
            _ if missed || *hides_tail => FOR_A_TAIL,
            SelectedKind::Connections => FOR_CONNECTIONS,
            SelectedKind::GuidedConnections => FOR_GUIDED_CONNECTIONS,
            SelectedKind::Paths => FOR_PATHS,
        };
        let pays = error > 0.0 && cost(error, rays[1]) < worthwhile * cost(own_error, rays[0]);
        match state {
            PointState::Open | PointState::Converged if misses => Takeover::MissesLight,
            PointState::Open if pays => Takeover::Pays,
            _ => Takeover::No,
        }
    });
    takeovers.collect()
}
