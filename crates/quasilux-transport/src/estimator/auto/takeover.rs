//! When bidirectional paths take a sensor point over from the selected estimator: where that misses
//! light, and where they take fewer rays than it still needs.

use crate::stats::decisions::Decisions;
use crate::stats::estimates::SensorEstimates;
use crate::stats::interval::{Interval, t_quantile_for};

/// Probability that the probe contradicts any sensor point at one look by chance.
const FALSE_ALARM: f64 = 1e-3;
/// Bidirectional paths take over where they promise the wanted error for at most this many times
/// the rays that are left to the selected estimator. Of plain paths they are the safe form, but by
/// the spreads of a few replicates each the ratio is known to a factor of two. What connections of
/// photons promise may hang on light that a survey or a pilot did not see, and what hides a tail
/// promises too much.
const FOR_PATHS: f64 = 0.5;
const FOR_CONNECTIONS: f64 = 1.0;
const FOR_A_TAIL: f64 = 2.0;

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
    pub(super) selected: Side<'e>,
    pub(super) probe: Side<'e>,
    pub(super) kind: SelectedKind,
    /// Whether few connections make the variance of each sensor point.
    pub(super) photons_hide_tails: Vec<bool>,
    /// How far each sensor point is.
    pub(super) states: Vec<PointState>,
}

/// One of them.
pub(super) struct Side<'e> {
    pub(super) sensors: &'e [SensorEstimates],
    /// Of one index of one replicate of a sensor point, on average.
    pub(super) rays: f64,
}

/// How the selected estimator works.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SelectedKind {
    /// By paths, alone or on a map.
    Paths,
    /// By photons that are connected to the sensors, too.
    Connections,
}

impl SelectedKind {
    pub(super) fn new(decisions: &Decisions) -> Self {
        match decisions.connected_photons {
            None => Self::Paths,
            Some(_) => Self::Connections,
        }
    }
}

/// A sensor point.
struct Point {
    /// What the selected estimator found.
    own: Interval,
    /// What the probe found.
    probed: Interval,
    /// Rays of each for it.
    rays: [f64; 2],
    /// Whether the selected estimator saw too few scores there.
    missed: bool,
}

impl Judged<'_> {
    /// Whether the probe finds more light at each sensor point than the selected estimator, which
    /// works there or did, by more than chance allows.
    pub(super) fn misses_light(&self) -> Vec<bool> {
        let replicates = self.selected.sensors.first().map_or(0, |own| own.replicate_lx.len());
        let of_each = FALSE_ALARM / self.states.len().max(1) as f64;
        let t = |alarm: f64| t_quantile_for(replicates, 2.0 * alarm);
        let [Some(t_of_each), Some(t_of_all)] = [t(of_each), t(FALSE_ALARM)] else {
            return vec![false; self.states.len()];
        };
        let all_miss = self.all_miss_light(t_of_all);
        let misses = |Point { own, probed, .. }: Point| {
            let errors = own.half_width.zip(probed.half_width);
            errors.is_some_and(|(own_error, error)| {
                probed.value - own.value > t_of_each * libm::hypot(own_error, error)
            })
        };
        let points = self.points().zip(&self.states);
        let known = |(point, state): (Point, &PointState)| {
            *state != PointState::TakenOver && (all_miss || misses(point))
        };
        points.map(known).collect()
    }

    /// Whether bidirectional paths need fewer rays to the tolerance at each sensor point than the
    /// selected estimator, which works there. `excess` are its half-widths over the tolerance.
    pub(super) fn pays(&self, excess: &[Option<f64>]) -> Vec<bool> {
        let points = self.points().zip(&self.photons_hide_tails).zip(excess).zip(&self.states);
        let pays = points.map(|(((point, hides_tail), excess), state)| {
            let Point { own, probed, rays: [own_rays, rays], missed } = point;
            let Some((own_error, error)) = own.half_width.zip(probed.half_width) else {
                return false;
            };
            let worthwhile = match self.kind {
                _ if missed || *hides_tail => FOR_A_TAIL,
                SelectedKind::Connections => FOR_CONNECTIONS,
                SelectedKind::Paths => FOR_PATHS,
            };
            // Without a half-width nothing of the way is behind it.
            let left = excess.map_or(1.0, |excess| 1.0 - 1.0 / (excess * excess).max(1.0));
            let own_cost = own_error * own_error * own_rays * left;
            let is_open = *state == PointState::Open;
            is_open && error > 0.0 && error * error * rays < worthwhile * own_cost
        });
        pays.collect()
    }

    /// Whether the probe finds more light than the selected estimator in the mean over all points
    /// that this works at, each relative to its value: a miss that they share shows there long
    /// before it shows at one of them. Replicates are independent, points of one need not be.
    fn all_miss_light(&self, t: f64) -> bool {
        let Self { selected, probe, states, .. } = self;
        let values: Vec<f64> = self.points().map(|point| point.own.value).collect();
        let replicates = selected.sensors.first().map_or(0, |sensor| sensor.replicate_lx.len());
        let differences = (0..replicates).map(|replicate| {
            let of_sensors = selected.sensors.iter().zip(probe.sensors);
            let lx = of_sensors.flat_map(|(selected, probe)| {
                probe.replicate_lx[replicate].iter().zip(&selected.replicate_lx[replicate])
            });
            let known = lx.zip(&values).zip(states);
            let counted = known
                .filter(|((_, value), state)| **state != PointState::TakenOver && **value > 0.0);
            counted.map(|(((probed, own), value), _)| (probed - own) / value).sum::<f64>()
        });
        let Interval { value, half_width } = Interval::of_mean(differences, Some(t));
        half_width.is_some_and(|half_width| value > half_width)
    }

    fn points(&self) -> impl Iterator<Item = Point> {
        let Self { selected, probe, .. } = self;
        selected.sensors.iter().zip(probe.sensors).flat_map(|(own, probed)| {
            (0..own.missed.len()).map(|point| {
                let interval = |of: &SensorEstimates| {
                    Interval::of_mean(of.replicate_lx.iter().map(|row| row[point]), Some(1.0))
                };
                let rays = [
                    selected.rays * own.samples[point] as f64,
                    probe.rays * probed.samples[point] as f64,
                ];
                Point {
                    own: interval(own),
                    probed: interval(probed),
                    rays,
                    missed: own.missed[point],
                }
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};

    const REPLICATES: u64 = 16;
    const POINTS: usize = 12;

    /// Points of `lx` with a spread of `spread` between replicates, by numbers of their own.
    fn sensor(lx: f64, spread: f64, seed: u64) -> SensorEstimates {
        let numbers = PointSet::new(Sequence::Independent, Randomization::None, seed);
        let row = |replicate: u64| {
            let mut sampler = Sampler::new(&numbers, replicate);
            let mut noise = || 12.0_f64.sqrt() * spread * (sampler.next_1d() - 0.5);
            (0..POINTS).map(|_| lx + noise()).collect()
        };
        SensorEstimates {
            replicate_lx: (0..REPLICATES).map(row).collect(),
            direct_lx: vec![0.0; POINTS],
            resolved: vec![true; POINTS],
            missed: vec![false; POINTS],
            contradicted: vec![false; POINTS],
            samples: vec![128; POINTS],
            terms: Vec::new(),
            unseen: None,
        }
    }

    fn judge<T>(probed_lx: f64, spread: f64, seed: u64, of: impl Fn(&Judged<'_>) -> T) -> T {
        let selected = [sensor(100.0, 1.0, 2 * seed)];
        let probe = [sensor(probed_lx, spread, 2 * seed + 1)];
        of(&Judged {
            selected: Side { sensors: &selected, rays: 1.0 },
            probe: Side { sensors: &probe, rays: 1.0 },
            kind: SelectedKind::Paths,
            photons_hide_tails: vec![false; POINTS],
            states: vec![PointState::Open; POINTS],
        })
    }

    /// Twelve points lack 15 % that a probe finds with a standard error of 10 % at each: seen in
    /// most seeds. Where nothing is missing, one of 200 seeds may raise the alarm.
    #[test]
    fn what_all_points_miss_is_found_in_their_mean() {
        let alarms = |probed_lx: f64| {
            let found = |seed: &u64| {
                judge(probed_lx, 40.0, *seed, |own| own.misses_light()).iter().all(|misses| *misses)
            };
            (0..200).filter(found).count()
        };
        let (found, false_alarms) = (alarms(115.0), alarms(100.0));
        assert!(found > 150 && false_alarms <= 2, "{found} of 200, {false_alarms} by chance");
    }

    /// A way that costs a third of the other's takes over where there is something left to do.
    #[test]
    fn bidirectional_paths_take_over_what_is_left() {
        let spread = (1.0_f64 / 3.0).sqrt();
        let mean = |excess: f64| {
            let pays = |seed| judge(100.0, spread, seed, |own| own.pays(&[Some(excess); POINTS]));
            let taken = (0..100).flat_map(pays).filter(|pays| *pays).count();
            taken as f64 / (100 * POINTS) as f64
        };
        let (far, near) = (mean(10.0), mean(1.05));
        assert!(far > 0.6 && near < 0.02, "{far} {near}");
    }
}
