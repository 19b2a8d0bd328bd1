//! Certified intervals, where they were asked for.

use crate::caveat::Caveat;
use crate::figure::finite;
use quasilux_transport::{CertifiedInterval, Estimates, IntervalKind, Settings};
use serde::Serialize;

/// Limits in lx that hold for any number of samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CertifiedFigure {
    /// The figure is this at least.
    pub lower: f64,
    /// And this at most; `None` where nothing certain is known.
    pub upper: Option<f64>,
}

/// Those of a sensor; all `None` where they were not asked for, or there are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct CertifiedFigures {
    pub(crate) points: Option<Vec<CertifiedFigure>>,
    pub(crate) average: Option<CertifiedFigure>,
}

impl CertifiedFigures {
    pub(crate) fn new(estimates: &Estimates, sensor: usize, settings: &Settings) -> Self {
        if settings.interval != IntervalKind::Certified {
            return Self::default();
        }
        let points = estimates.certified_points(sensor);
        Self {
            points: points.map(|all| all.into_iter().map(Into::into).collect()),
            average: estimates.certified_average(sensor).map(Into::into),
        }
    }
}

impl From<CertifiedInterval> for CertifiedFigure {
    fn from(interval: CertifiedInterval) -> Self {
        Self { lower: interval.lower_lx, upper: finite(interval.upper_lx) }
    }
}

/// What a reader must know of the certified intervals of a sensor: which were asked for and are not
/// there.
pub(crate) fn caveats(name: &str, figures: &CertifiedFigures) -> Vec<Caveat> {
    let CertifiedFigures { points: Some(points), average } = figures else { return Vec::new() };
    let sensor = || name.to_owned();
    let of_points = points.len();
    let open = points.iter().filter(|point| point.upper.is_none()).count();
    let missing = average.is_none().then(|| Caveat::NoCertifiedAverage { sensor: sensor() });
    let open =
        (open > 0).then(|| Caveat::NoCertifiedLimit { sensor: sensor(), points: open, of_points });
    missing.into_iter().chain(open).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;
    use quasilux_transport::{IndexTotals, UnseenLight};

    /// With one look.
    fn bounded() -> Estimates {
        let (_, mut estimates) = example::bounded();
        estimates.miss_probability = 1.0 - estimates.confidence;
        let unseen: &mut UnseenLight = estimates.sensors[0].unseen.as_mut().expect("bounds");
        unseen.totals = Some(IndexTotals::unknown(3));
        estimates
    }

    fn asked() -> Settings {
        Settings { interval: IntervalKind::Certified, ..Settings::default() }
    }

    /// Four equal replicates of 100 lx at 95 %: between what bets of everything make and twice as
    /// much, `100 / 80^(1/4)` and `100 / 40^(1/4)`.
    #[test]
    fn limits_are_there_where_they_are_asked_for() {
        let estimates = bounded();
        let nothing = CertifiedFigures::new(&estimates, 0, &Settings::default());
        assert_eq!(nothing, CertifiedFigures::default());
        assert!(caveats("a", &nothing).is_empty());
        let all = CertifiedFigures::new(&estimates, 0, &asked());
        let CertifiedFigure { lower, upper } = all.points.as_ref().expect("points")[0];
        assert!((33.4..39.8).contains(&lower) && upper.is_none(), "{lower}");
        let sensor = "a".to_owned();
        let expected = Caveat::NoCertifiedLimit { sensor, points: 3, of_points: 3 };
        assert_eq!(caveats("a", &all), [expected]);
    }

    /// 10 lx may come from an index, and there were 4000 of them: `(10 + sqrt(10 ln 40 / 4000))^2`.
    #[test]
    fn upper_limits_are_there_where_indices_are_known() {
        let mut estimates = bounded();
        let sensor = &mut estimates.sensors[0];
        let unseen: &mut UnseenLight = sensor.unseen.as_mut().expect("bounds");
        unseen.totals.as_mut().expect("totals").most_lx = vec![10.0; 3];
        sensor.samples = vec![1000, 1000, 500];
        let all = CertifiedFigures::new(&estimates, 0, &asked());
        let upper = all.points.as_ref().expect("points")[0].upper.expect("a limit");
        assert!((upper - 101.9).abs() < 0.1, "{upper}");
        assert_eq!(all.average, None);
        let expected = Caveat::NoCertifiedAverage { sensor: "a".to_owned() };
        assert_eq!(caveats("a", &all), [expected]);
    }
}
