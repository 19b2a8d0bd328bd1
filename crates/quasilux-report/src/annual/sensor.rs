//! All points of a sensor over a year.

use super::measures::Measure;
use super::point::PointSummary;
use crate::Figure;

/// A share of points, with what it may be at least and at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShareOfPoints {
    /// By the estimates.
    pub value: f64,
    /// Of the points that surely count.
    pub low: f64,
    /// Of the points that do not surely not count.
    pub high: f64,
}

/// What all points of a sensor have together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorOfYear {
    /// Points with enough light for half of the occupied hours (spatial daylight autonomy, sDA
    /// 300/50 % of IES LM-83, without blinds).
    pub autonomy: ShareOfPoints,
    /// Points with more than 250 occupied hours of direct sunlight (annual sunlight exposure, ASE
    /// 1000/250 of LM-83).
    pub sunlight: ShareOfPoints,
    /// The level of EN 17037; `None` where hours are not those of a year.
    pub en17037: Option<DaylightLevel>,
}

/// The level of EN 17037 that half and 95 % of the points reach together: 0 for none, 1 minimum
/// (300 and 100 lx), 2 medium (500 and 300 lx), 3 high (750 and 500 lx).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DaylightLevel {
    /// By the estimates.
    pub level: u8,
    /// The lowest and the highest that it may be.
    pub bounds: [u8; 2],
}

/// Hours of direct sunlight that are not too many (LM-83).
const SUNLIT_HOURS: f64 = 250.0;
/// The share of hours with enough light that a point is to have.
const AUTONOMY: f64 = 0.5;
/// EN 17037:2018, table A.1: what half of the plane is to reach, and what 95 % of it are.
const LEVELS_LX: [[f64; 2]; 3] = [[300.0, 100.0], [500.0, 300.0], [750.0, 500.0]];
const SHARES: [f64; 2] = [0.5, 0.95];

impl SensorOfYear {
    /// Of the points of a sensor with the areas that they stand for, none where all are alike, and
    /// whether their hours are those of a year.
    #[must_use]
    pub fn new(points: &[PointSummary], areas: &[f64], is_of_a_year: bool) -> Self {
        let share = |counts: &dyn Fn(&PointSummary) -> bool| share(points, areas, counts);
        let autonomy =
            |side: Side| share(&|point| side.take(point.measure(Measure::Autonomy)) >= AUTONOMY);
        let sunlight = |side: Side| {
            share(&|point| side.take(point.measure(Measure::SunlitHours)) > SUNLIT_HOURS)
        };
        let level = |side: Side| {
            let median = |point: &PointSummary| side.take(point.measure(Measure::MedianDaylight));
            let reaches = |[half, most]: &&[f64; 2]| {
                let mut wanted = [*half, *most].into_iter().zip(SHARES);
                let of = |(lx, wanted)| share(&|point| median(point) >= lx) >= wanted;
                wanted.all(of)
            };
            LEVELS_LX.iter().take_while(reaches).count() as u8
        };
        Self {
            autonomy: ShareOfPoints::new(autonomy),
            sunlight: ShareOfPoints::new(sunlight),
            en17037: is_of_a_year.then(|| DaylightLevel {
                level: level(Side::Value),
                bounds: [level(Side::Low), level(Side::High)],
            }),
        }
    }
}

impl ShareOfPoints {
    fn new(share: impl Fn(Side) -> f64) -> Self {
        Self { value: share(Side::Value), low: share(Side::Low), high: share(Side::High) }
    }
}

/// A place in an interval.
#[derive(Clone, Copy)]
enum Side {
    Low,
    Value,
    High,
}

impl Side {
    fn take(self, figure: Figure) -> f64 {
        let value = figure.value.unwrap_or(0.0);
        let half_width = figure.half_width.unwrap_or(f64::INFINITY);
        match self {
            Self::Low => value - half_width,
            Self::Value => value,
            Self::High => value + half_width,
        }
    }
}

/// The share of the area of all points that some of them have.
fn share(points: &[PointSummary], areas: &[f64], counts: &dyn Fn(&PointSummary) -> bool) -> f64 {
    if areas.len() != points.len() {
        let counting = points.iter().filter(|point| counts(point)).count();
        return counting as f64 / points.len().max(1) as f64;
    }
    let counting = points.iter().zip(areas).filter(|(point, _)| counts(point));
    counting.map(|(_, area)| area).sum::<f64>() / areas.iter().sum::<f64>()
}
