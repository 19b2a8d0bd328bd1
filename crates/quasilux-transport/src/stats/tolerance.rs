//! Which sensor points are known as well as was asked for.

use crate::settings::{Settings, ToleranceOn};
use crate::stats::estimates::{Estimates, SensorEstimates};
use crate::stats::interval::Interval;
use crate::stats::point_status::{Evidence, PointStatus};
use crate::stats::schedule::MIN_SAMPLES;

/// Paths or photons, all replicates together, that a point where nothing is found gets before a
/// run may end without it.
const MIN_TRIES: f64 = (1 << 14) as f64;
/// Paths or photons, all replicates together, that a point where rare and bright light was missed
/// gets before a run may end without it: that more paths will meet it is certain.
const MIN_TRIES_OF_RARE_LIGHT: f64 = (1 << 20) as f64;

/// Relative half-widths of what does not differ between replicates.
const ROUNDING: f64 = 1e-12;

/// How all targets stand at a checkpoint, in the order of their sensors.
pub(crate) struct Standing {
    /// Half-width over value; `None` where there is no half-width.
    pub(crate) relative_widths: Vec<Option<f64>>,
    /// Half-width over tolerance of what has to reach it: the point, or the average of its sensor.
    /// `None` where there is no half-width, or nothing to reach.
    pub(crate) excess: Vec<Option<f64>>,
    /// Bound on light that no sample met, over its tolerance: 0 where it is not waited for, `None`
    /// of estimators without one.
    pub(crate) unseen_excess: Vec<Option<f64>>,
    /// Whether more samples are of no use to a target.
    pub(crate) done: Vec<bool>,
    /// Status of each target, its number of samples left aside.
    pub(crate) statuses: Vec<PointStatus>,
    /// Points where nothing was found yet.
    pub(crate) unresolved: u64,
    /// Whether all that has to reach the tolerance has.
    pub(crate) is_reached: bool,
    /// Whether the run need not go on: points where nothing was found, and those in the dark of
    /// which nothing is asked in lx, hold it up until they had a fair chance, not for ever.
    pub(crate) may_end: bool,
}

impl Standing {
    pub(crate) fn new(estimates: &Estimates, settings: &Settings) -> Self {
        let replicates = settings.effective_replicates();
        let is_wanted = settings.has_tolerance() && replicates >= 2;
        let tries = estimates.samples as f64 * f64::from(replicates);
        let yardstick = Yardstick { settings, is_wanted, tries };
        let mut standing = Self {
            relative_widths: Vec::new(),
            excess: Vec::new(),
            unseen_excess: Vec::new(),
            done: Vec::new(),
            statuses: Vec::new(),
            unresolved: 0,
            is_reached: is_wanted,
            may_end: is_wanted,
        };
        for (sensor, figures) in estimates.sensors.iter().enumerate() {
            let unresolved = figures.evidence.iter().filter(|own| !own.is_sound()).count();
            standing.unresolved += unresolved as u64;
            let points = estimates.point_intervals(sensor);
            standing.relative_widths.extend(points.iter().map(Interval::relative_half_width));
            let average = estimates.found_average(sensor);
            let unseen_lx = estimates.unseen_of_average(sensor);
            match settings.tolerance_on {
                ToleranceOn::Points => {
                    let average = yardstick.target(&average, unseen_lx, Evidence::Sound);
                    standing.add_points(figures, &points, average, &yardstick);
                }
                ToleranceOn::Summary => {
                    let worst = [Evidence::RareLight, Evidence::Dark]
                        .into_iter()
                        .find(|worst| figures.evidence.contains(worst))
                        .filter(|worst| !yardstick.had_a_chance(*worst));
                    let target =
                        yardstick.target(&average, unseen_lx, worst.unwrap_or(Evidence::Sound));
                    for own in &figures.evidence {
                        let status = Target { evidence: *own, ..target }.status();
                        standing.add(target, status, yardstick.gives_up(target));
                    }
                }
            }
        }
        standing.is_reached &= standing.unresolved == 0;
        standing
    }

    /// Adds all points of a sensor, each with a tolerance of its own. They wait for their average,
    /// which takes no part of points that end before others.
    fn add_points(
        &mut self,
        figures: &SensorEstimates,
        points: &[Interval],
        average: Target,
        yardstick: &Yardstick<'_>,
    ) {
        let waits = !yardstick.gives_up(average);
        for (number, point) in points.iter().enumerate() {
            let unseen_lx = figures.unseen.as_ref().map(|unseen| unseen.point_lx[number]);
            let own = yardstick.target(point, unseen_lx, figures.evidence[number]);
            let target = if waits { own.with(average) } else { own };
            let status = match own.status() {
                PointStatus::Done if !target.is_done() => PointStatus::Average,
                status => status,
            };
            self.add(target, status, yardstick.gives_up(target));
        }
    }

    /// The largest half-width over value; `None` without any.
    pub(crate) fn largest(&self) -> Option<f64> {
        let widths = self.relative_widths.iter().flatten().copied();
        widths.reduce(|a, b| if a > b { a } else { b })
    }

    /// Whether a run of this many samples may call anything done. Without sensors there is nothing
    /// to be wrong about, and what is not sampled is exact.
    pub(crate) fn has_enough(&self, samples: u64, settings: &Settings) -> bool {
        let is_exact =
            settings.max_bounces == Some(0) && self.largest().is_some_and(|w| w < ROUNDING);
        self.done.is_empty() || is_exact || samples >= MIN_SAMPLES
    }

    fn add(&mut self, target: Target, status: PointStatus, is_given_up: bool) {
        let done = target.is_done();
        self.excess.push(target.excess);
        self.unseen_excess.push(target.unseen_excess);
        self.done.push(done);
        self.statuses.push(status);
        self.is_reached &= done;
        self.may_end &= done || is_given_up;
    }
}

impl Estimates {
    /// Status of the points of each sensor: what they wait for, or that nothing is missing; `None`
    /// without a tolerance.
    #[must_use]
    pub fn point_statuses(&self, settings: &Settings) -> Option<Vec<Vec<PointStatus>>> {
        let standing = Standing::new(self, settings);
        let has_enough = standing.has_enough(self.samples, settings);
        let mut all = standing.statuses.into_iter().map(|status| match status {
            PointStatus::Done if !has_enough => PointStatus::FewSamples,
            status => status,
        });
        let points = self.sensors.iter().map(|sensor| sensor.samples.len());
        let of_sensors = points.map(|points| all.by_ref().take(points).collect());
        settings.has_tolerance().then(|| of_sensors.collect())
    }
}

/// Criteria for targets at a checkpoint.
struct Yardstick<'s> {
    settings: &'s Settings,
    /// Whether there is a tolerance that can be reached.
    is_wanted: bool,
    /// Paths or photons so far, all replicates together.
    tries: f64,
}

impl Yardstick<'_> {
    fn had_a_chance(&self, evidence: Evidence) -> bool {
        let is_rare = evidence == Evidence::RareLight;
        self.tries >= if is_rare { MIN_TRIES_OF_RARE_LIGHT } else { MIN_TRIES }
    }

    /// Whether a run need not wait for a target that is not done.
    fn gives_up(&self, target: Target) -> bool {
        let is_hopeless = !target.evidence.is_sound() || target.is_without_end();
        is_hopeless && self.had_a_chance(target.evidence)
    }

    fn target(&self, interval: &Interval, unseen_lx: Option<f64>, evidence: Evidence) -> Target {
        let excess = excess(interval, self.settings).filter(|_| self.is_wanted);
        let unseen_excess = unseen_lx.map(|lx| unseen_excess(lx, interval.value, self.settings));
        Target { excess, unseen_excess, evidence }
    }
}

/// How one target stands.
#[derive(Clone, Copy)]
struct Target {
    excess: Option<f64>,
    unseen_excess: Option<f64>,
    evidence: Evidence,
}

impl Target {
    /// Both together, with its own evidence.
    fn with(self, other: Self) -> Self {
        let larger = |[a, b]: [Option<f64>; 2]| a.zip(b).map(|(a, b)| a.max(b));
        Self {
            excess: larger([self.excess, other.excess]),
            unseen_excess: larger([self.unseen_excess, other.unseen_excess]),
            evidence: self.evidence,
        }
    }

    fn is_done(&self) -> bool {
        self.status() == PointStatus::Done
    }

    fn status(&self) -> PointStatus {
        let is_seen = self.unseen_excess.is_none_or(|excess| excess <= 1.0);
        match self.evidence {
            Evidence::Dark => PointStatus::Dark,
            Evidence::RareLight => PointStatus::RareLight,
            Evidence::Sound if !self.is_narrow() => PointStatus::HalfWidth,
            Evidence::Sound if !is_seen => PointStatus::Unseen,
            Evidence::Sound => PointStatus::Done,
        }
    }

    /// Whether it is known well but for a bound that no number of samples brings down to nothing,
    /// as in the dark, or that knows nothing.
    fn is_without_end(&self) -> bool {
        self.is_narrow() && self.unseen_excess == Some(f64::INFINITY)
    }

    fn is_narrow(&self) -> bool {
        self.excess.is_some_and(|excess| excess <= 1.0)
    }
}

/// Half-width over tolerance; `None` without a half-width.
fn excess(interval: &Interval, settings: &Settings) -> Option<f64> {
    let half_width = interval.half_width?;
    let tolerance_lx = settings.tolerance_lx(interval.value);
    let excess = if half_width == 0.0 { 0.0 } else { half_width / tolerance_lx };
    // NaN is not known at all.
    Some(if excess.is_nan() { f64::INFINITY } else { excess })
}

/// The bound on unseen light over what is little enough of it; 0 where it is not waited for.
fn unseen_excess(unseen_lx: f64, value_lx: f64, settings: &Settings) -> f64 {
    let Some(tolerance_lx) = settings.unseen_tolerance_lx(value_lx) else { return 0.0 };
    let excess = if unseen_lx == 0.0 { 0.0 } else { unseen_lx / tolerance_lx };
    // NaN is not known at all.
    if excess.is_nan() { f64::INFINITY } else { excess }
}

#[cfg(test)]
mod large_grids;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::UnseenTolerance;
    use crate::stats::unseen::UnseenLight;

    /// Points of one sensor that all replicates agree on but for one part in a thousand, each with
    /// its bound on unseen light; `average_lx` is that of the average.
    fn made_up(points: &[(f64, f64)], average_lx: f64) -> Estimates {
        let row = |replicate: usize| {
            let sign = if replicate.is_multiple_of(2) { 1.0 } else { -1.0 };
            points.iter().map(|(value_lx, _)| value_lx * (1.0 + 1e-3 * sign)).collect()
        };
        let n = points.len();
        let unseen = UnseenLight {
            point_lx: points.iter().map(|(_, unseen_lx)| *unseen_lx).collect(),
            average_lx,
            ..UnseenLight::unknown(n)
        };
        let sensor = SensorEstimates {
            replicate_lx: (0..16).map(row).collect(),
            direct_lx: vec![0.0; n],
            evidence: vec![Evidence::Sound; n],
            samples: vec![1 << 10; n],
            average: None,
            terms: Vec::new(),
            unseen: Some(unseen),
        };
        Estimates {
            sensors: vec![sensor],
            samples: 1 << 10,
            miss_probability: 0.05,
            ..Estimates::default()
        }
    }

    fn standing(points: &[(f64, f64)], settings: &Settings) -> Standing {
        Standing::new(&made_up(points, 0.0), settings)
    }

    #[test]
    fn a_point_waits_for_both_numbers() {
        let settings = Settings { rel_tol: 0.03, ..Settings::default() };
        let points = [(100.0, 4.9), (100.0, 5.1)];
        let at_5_percent = standing(&points, &settings);
        assert_eq!(at_5_percent.done, [true, false]);
        assert_eq!(at_5_percent.unseen_excess[0], Some(4.9 / 5.0));
        assert!(!at_5_percent.is_reached && !at_5_percent.may_end);
        let wide = Settings { rel_tol: 0.06, ..settings.clone() };
        assert!(standing(&points, &wide).is_reached, "rel_tol is larger than 5 %");
        let strict = Settings { unseen_tol: UnseenTolerance::Share(0.04), ..settings.clone() };
        assert_eq!(standing(&points, &strict).done, [false, false]);
        let off = Settings { unseen_tol: UnseenTolerance::Off, ..settings };
        assert!(standing(&points, &off).is_reached, "it is told, not waited for");
    }

    #[test]
    fn points_say_what_they_wait_for() {
        use PointStatus::{Average, Dark, Done, FewSamples, HalfWidth, Unseen};
        let settings = Settings { rel_tol: 0.03, ..Settings::default() };
        let statuses = |estimates: &Estimates, settings: &Settings| {
            estimates.point_statuses(settings).map(|all| all.concat())
        };
        let points = [(100.0, 4.9), (100.0, 5.1)];
        let estimates = made_up(&points, 0.0);
        assert_eq!(statuses(&estimates, &settings), Some(vec![Done, Unseen]));
        let narrow = Settings { rel_tol: 1e-5, ..settings.clone() };
        assert_eq!(statuses(&estimates, &narrow), Some(vec![HalfWidth; 2]));
        let open = made_up(&points, 50.0);
        assert_eq!(statuses(&open, &settings), Some(vec![Average, Unseen]));
        assert!(!Standing::new(&open, &settings).done[0], "it waits for the average");
        let few = Estimates { samples: 64, ..estimates.clone() };
        assert_eq!(statuses(&few, &settings), Some(vec![FewSamples, Unseen]));
        let mut dark = estimates.clone();
        dark.sensors[0].evidence[1] = Evidence::Dark;
        assert_eq!(statuses(&dark, &settings), Some(vec![Done, Dark]));
        let nothing_asked = Settings { rel_tol: 0.0, abs_tol_lx: 0.0, ..settings };
        assert_eq!(statuses(&estimates, &nothing_asked), None);
    }

    /// `0 +- 0, at most 0.02 lx unseen` is an answer where so little is enough; where nothing is
    /// said of lx, no number of samples is, and the run ends without it after 2^14 tries.
    #[test]
    fn the_dark_is_done_where_its_bound_is_little_in_lx() {
        let points = [(0.0, 0.02)];
        let in_lx = |abs_tol_lx| Settings { abs_tol_lx, ..Settings::default() };
        assert!(standing(&points, &in_lx(0.02)).is_reached);
        let too_much = standing(&points, &in_lx(0.01));
        assert!(!too_much.is_reached && !too_much.may_end);
        let relative = standing(&points, &Settings::default());
        assert!(!relative.is_reached && relative.may_end);
        let few = Estimates { samples: 1 << 9, ..made_up(&points, 0.0) };
        assert!(!Standing::new(&few, &Settings::default()).may_end);
        assert!(standing(&[(0.0, 0.0)], &Settings::default()).is_reached);
    }

    #[test]
    fn averages_wait_for_their_own_bound() {
        let settings =
            Settings { tolerance_on: ToleranceOn::Summary, abs_tol_lx: 0.5, ..Settings::default() };
        let points = [(100.0, 20.0), (100.0, f64::INFINITY)];
        assert!(Standing::new(&made_up(&points, 4.9), &settings).is_reached);
        let open = Standing::new(&made_up(&points, 5.1), &settings);
        assert!(!open.is_reached && !open.may_end);
        assert!(Standing::new(&made_up(&points, f64::INFINITY), &settings).may_end);
    }

    /// Bounds that hold at three points at once are ln(3 / 0.05) / ln(1 / 0.05) times as large: the
    /// smallest value is at most that of the second point with its bound.
    #[test]
    fn bounds_of_extremes_hold_at_all_points() {
        let factor_of_3 = libm::log(60.0) / libm::log(20.0);
        let estimates = made_up(&[(1.0, 0.1), (1.0, 0.02), (3.0, 0.5)], 0.2);
        let minimum = estimates.unseen_of_minimum(0).unwrap();
        assert!((minimum - 0.02 * factor_of_3).abs() < 1e-12, "{minimum}");
        let maximum = estimates.unseen_of_maximum(0).unwrap();
        assert!((maximum - 0.5 * factor_of_3).abs() < 1e-12, "{maximum}");
        assert_eq!(estimates.unseen_of_average(0), Some(0.2));
        let dark = made_up(&[(0.0, 0.0), (1.0, f64::INFINITY)], 0.0);
        assert_eq!(dark.unseen_of_minimum(0), Some(0.0));
        assert_eq!(dark.unseen_of_maximum(0), Some(f64::INFINITY));
    }
}
