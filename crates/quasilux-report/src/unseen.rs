//! What samples leave open beside intervals: bounds on light that none of them met, and light that
//! is known as a mean around a point.

use crate::caveat::Caveat;
use crate::figure::finite;
use quasilux_scene::Scene;
use quasilux_transport::{Estimates, Settings, UnseenLight};

/// Merged light is told where it is more than this share of the tolerance.
const BLURRED: f64 = 0.1;

/// What the samples of one point leave open; all `None` of estimators without a bound.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointUnseen {
    /// Light in lx at most that no sample met; `None` where nothing is known, too.
    pub bound_lx: Option<f64>,
    /// The part of the value in lx that is known as a mean over the disc around the point.
    pub merged_lx: Option<f64>,
    /// Radius of that disc in m; `None` for cells.
    pub disc_radius_m: Option<f64>,
}

/// Light in lx at most that no sample met, for the figures of a sensor; `None` where nothing is
/// known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SummaryUnseen {
    /// In the average.
    pub average_lx: Option<f64>,
    /// What the smallest value may be larger by.
    pub minimum_lx: Option<f64>,
    /// What the largest value may be larger by.
    pub maximum_lx: Option<f64>,
}

impl PointUnseen {
    pub(crate) fn new(unseen: &UnseenLight, point: usize) -> Self {
        let finite_at = |values: &[f64]| values.get(point).copied().and_then(finite);
        Self {
            bound_lx: finite_at(&unseen.point_lx),
            merged_lx: finite_at(&unseen.merged_lx),
            disc_radius_m: unseen.disc_radius_m.get(point).copied().flatten().and_then(finite),
        }
    }
}

impl SummaryUnseen {
    /// `None` of estimators without a bound.
    pub(crate) fn new(estimates: &Estimates, sensor: usize) -> Option<Self> {
        Some(Self {
            average_lx: finite(estimates.unseen_of_average(sensor)?),
            minimum_lx: finite(estimates.unseen_of_minimum(sensor)?),
            maximum_lx: finite(estimates.unseen_of_maximum(sensor)?),
        })
    }
}

/// What a reader must know of bounds and discs.
pub(crate) fn caveats(scene: &Scene, estimates: &Estimates, settings: &Settings) -> Vec<Caveat> {
    let sensors = scene.sensors.iter().enumerate();
    sensors.flat_map(|(number, own)| of_sensor(&own.name, estimates, number, settings)).collect()
}

fn of_sensor(name: &str, estimates: &Estimates, sensor: usize, settings: &Settings) -> Vec<Caveat> {
    let Some(unseen) = &estimates.sensors[sensor].unseen else { return Vec::new() };
    let of_points = unseen.point_lx.len();
    let mut caveats = Vec::new();
    let points = unseen.point_lx.iter().filter(|bound_lx| !bound_lx.is_finite()).count();
    if points > 0 {
        caveats.push(Caveat::NoBound { sensor: name.to_owned(), points, of_points });
    }
    let intervals = estimates.point_intervals(sensor);
    let is_blurred = |point: &usize| {
        let tolerance_lx = settings.tolerance_lx(intervals[*point].value);
        unseen.merged_lx[*point] > BLURRED * tolerance_lx
    };
    let blurred: Vec<usize> = (0..of_points).filter(is_blurred).collect();
    let radii = || blurred.iter().filter_map(|point| unseen.disc_radius_m[*point]);
    if let Some((least, most)) = radii().reduce(f64::min).zip(radii().reduce(f64::max)) {
        caveats.push(Caveat::Blurred {
            sensor: name.to_owned(),
            points: blurred.len(),
            of_points,
            most_lx: blurred.iter().map(|point| unseen.merged_lx[*point]).fold(0.0, f64::max),
            least_radius_m: least,
            most_radius_m: most,
        });
    }
    caveats
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    fn told(change: impl FnOnce(&mut UnseenLight)) -> Vec<Caveat> {
        let (scene, mut estimates) = example::bounded();
        change(estimates.sensors[0].unseen.as_mut().expect("a bound"));
        caveats(&scene, &estimates, &Settings { abs_tol_lx: 0.1, ..Settings::default() })
    }

    /// A tenth of 1 % of 100 lx is 0.1 lx, which the first point passes; a tenth of 0.1 lx stands
    /// in the dark.
    #[test]
    fn blurred_points_are_told_with_the_radius() {
        let blurred = "sensor \"desk\": blurred at 1 of 3 points, where up to 0.5 lx is a mean \
                       over a disc of 0.1 m radius around the point";
        assert_eq!(told(|_| ()).iter().map(ToString::to_string).collect::<Vec<_>>(), [blurred]);
        assert!(told(|unseen| unseen.merged_lx = vec![0.09, 0.4, 0.009]).is_empty());
        let two = told(|unseen| {
            unseen.merged_lx[2] = 0.2;
            unseen.disc_radius_m[2] = Some(0.05);
        });
        let expected = Caveat::Blurred {
            sensor: "desk".to_owned(),
            points: 2,
            of_points: 3,
            most_lx: 0.5,
            least_radius_m: 0.05,
            most_radius_m: 0.1,
        };
        assert!(two[0].to_string().contains("a disc of 0.05 to 0.1 m radius"), "{}", two[0]);
        assert_eq!(two, [expected]);
    }

    /// JSON has no infinity: the figure is missing, and the reader is told.
    #[test]
    fn unknown_bounds_are_told() {
        let unknown = told(|unseen| {
            *unseen = UnseenLight::unknown(3);
        });
        let sensor = "desk".to_owned();
        assert_eq!(unknown, [Caveat::NoBound { sensor, points: 3, of_points: 3 }]);
        assert_eq!(PointUnseen::new(&UnseenLight::unknown(3), 1).bound_lx, None);
    }

    #[test]
    fn averages_have_their_own_bound() {
        let (_, estimates) = example::bounded();
        let SummaryUnseen { average_lx, minimum_lx, maximum_lx } =
            SummaryUnseen::new(&estimates, 0).expect("a bound");
        assert_eq!(average_lx, Some(0.4));
        // ln(3 / 0.05) / ln(1 / 0.05) = 1.3667.
        assert!((minimum_lx.unwrap() - 0.02 * 1.3667).abs() < 1e-5);
        assert!((maximum_lx.unwrap() - 20.0 * 1.3667).abs() < 1e-2);
    }
}
