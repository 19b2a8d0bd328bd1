//! Measures of a year, of the illuminances of its hours at one point.

use super::calendar::Calendar;
use quasilux_scene::Thresholds;

/// A measure of a year.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Measure {
    /// The share of occupied hours with enough light (daylight autonomy, DA).
    Autonomy,
    /// The same, where an hour with less counts in part (continuous autonomy, cDA).
    ContinuousAutonomy,
    /// The share of occupied hours below what is of use.
    TooLittle,
    /// Of use, but not enough without electric light.
    Supplementary,
    /// Of use, and enough.
    Autonomous,
    /// More than is of use.
    TooMuch,
    /// Hours a year, of the occupied ones, with too much light straight from the sun.
    SunlitHours,
    /// Light exposure in lx h a year, of all hours.
    Exposure,
    /// The illuminance in lx that half of the hours with daylight exceed (EN 17037).
    MedianDaylight,
}

/// How a measure is made of the hours, and with it the unit and the bounds that it has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MeasureKind {
    /// A share of the occupied hours.
    ShareOfHours,
    /// Share of the occupied hours, where hours with too little count in part.
    ShareInPart,
    /// Occupied hours, by the light straight from the sun.
    SunlitHours,
    /// A sum over all hours, in lx h.
    Exposure,
    /// An illuminance in lx that half of the hours with daylight exceed.
    Median,
}

impl Measure {
    /// All measures, in the order of documents.
    pub const ALL: [Self; 9] = [
        Self::Autonomy,
        Self::ContinuousAutonomy,
        Self::TooLittle,
        Self::Supplementary,
        Self::Autonomous,
        Self::TooMuch,
        Self::SunlitHours,
        Self::Exposure,
        Self::MedianDaylight,
    ];

    /// Its name in documents and spreadsheets.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Autonomy => "daylight_autonomy",
            Self::ContinuousAutonomy => "continuous_daylight_autonomy",
            Self::TooLittle => "udi_too_little",
            Self::Supplementary => "udi_supplementary",
            Self::Autonomous => "udi_autonomous",
            Self::TooMuch => "udi_too_much",
            Self::SunlitHours => "sunlit_hours",
            Self::Exposure => "exposure_lx_h",
            Self::MedianDaylight => "median_daylight_lx",
        }
    }

    /// Heading, with the illuminances in lx that hours are compared with.
    #[must_use]
    pub fn title(self, thresholds: &Thresholds) -> String {
        let &Thresholds { enough_lx, useful_lx: [least_lx, most_lx], sunlight_lx } = thresholds;
        match self {
            Self::Autonomy => format!("daylight autonomy, {enough_lx} lx"),
            Self::ContinuousAutonomy => format!("continuous daylight autonomy, {enough_lx} lx"),
            Self::TooLittle => format!("useful daylight: too little, below {least_lx} lx"),
            Self::Supplementary => {
                format!("useful daylight: supplementary, {least_lx} to {enough_lx} lx")
            }
            Self::Autonomous => format!("useful daylight: autonomous, {enough_lx} to {most_lx} lx"),
            Self::TooMuch => format!("useful daylight: too much, above {most_lx} lx"),
            Self::SunlitHours => format!("hours of direct sunlight above {sunlight_lx} lx"),
            Self::Exposure => "light exposure".to_owned(),
            Self::MedianDaylight => "median daylight".to_owned(),
        }
    }

    /// Whether it is a share of hours.
    #[must_use]
    pub fn is_share(self) -> bool {
        match self.kind() {
            MeasureKind::ShareOfHours | MeasureKind::ShareInPart => true,
            MeasureKind::SunlitHours | MeasureKind::Exposure | MeasureKind::Median => false,
        }
    }

    pub(super) fn kind(self) -> MeasureKind {
        match self {
            Self::Autonomy
            | Self::TooLittle
            | Self::Supplementary
            | Self::Autonomous
            | Self::TooMuch => MeasureKind::ShareOfHours,
            Self::ContinuousAutonomy => MeasureKind::ShareInPart,
            Self::SunlitHours => MeasureKind::SunlitHours,
            Self::Exposure => MeasureKind::Exposure,
            Self::MedianDaylight => MeasureKind::Median,
        }
    }

    /// The illuminances in lx, from the first to the second, of the hours that it counts; `None`
    /// where it counts none, and of the light straight from the sun for [`Self::SunlitHours`].
    pub(super) fn counted_lx(self, thresholds: &Thresholds) -> Option<[f64; 2]> {
        let &Thresholds { enough_lx, useful_lx: [least_lx, most_lx], sunlight_lx } = thresholds;
        match self {
            Self::Autonomy => Some([enough_lx, f64::INFINITY]),
            Self::TooLittle => Some([f64::NEG_INFINITY, least_lx]),
            Self::Supplementary => Some([least_lx, enough_lx]),
            Self::Autonomous => Some([enough_lx, most_lx]),
            Self::TooMuch => Some([most_lx, f64::INFINITY]),
            Self::SunlitHours => Some([sunlight_lx, f64::INFINITY]),
            Self::ContinuousAutonomy | Self::Exposure | Self::MedianDaylight => None,
        }
    }

    pub(super) fn place(self) -> usize {
        Self::ALL.iter().position(|other| *other == self).unwrap_or(0)
    }
}

/// All measures of a point, in the order of [`Measure::ALL`]: of its illuminances in lx hour by
/// hour, those with a sky, and of the part that comes straight from the sun.
pub(super) fn measures(
    calendar: &Calendar,
    thresholds: &Thresholds,
    illuminance_lx: &[f64],
    sun_lx: &[f64],
) -> [f64; Measure::ALL.len()] {
    let counted = Measure::ALL.map(|measure| measure.counted_lx(thresholds));
    let (mut occupied, mut exposure, mut sums) = (0.0, 0.0, [0.0; Measure::ALL.len()]);
    for interval in &calendar.intervals {
        let of = |lx: &[f64]| interval.sky.map_or(0.0, |sky| lx[sky]);
        let (lx, straight_lx) = (of(illuminance_lx), of(sun_lx));
        exposure += lx;
        if !interval.is_occupied {
            continue;
        }
        occupied += 1.0;
        for ((sum, measure), counted) in sums.iter_mut().zip(Measure::ALL).zip(&counted) {
            let counts = |lx: f64| {
                let within = counted.is_some_and(|[from_lx, to_lx]| (from_lx..to_lx).contains(&lx));
                f64::from(u8::from(within))
            };
            *sum += match measure.kind() {
                MeasureKind::ShareOfHours => counts(lx),
                MeasureKind::SunlitHours => counts(straight_lx),
                MeasureKind::ShareInPart => (lx / thresholds.enough_lx).min(1.0),
                MeasureKind::Exposure | MeasureKind::Median => 0.0,
            };
        }
    }
    Measure::ALL.map(|measure| match measure.kind() {
        MeasureKind::SunlitHours => sums[measure.place()] * calendar.interval_h,
        MeasureKind::Exposure => exposure * calendar.interval_h,
        MeasureKind::Median => median(&mut daylit_lx(calendar, illuminance_lx)),
        MeasureKind::ShareOfHours | MeasureKind::ShareInPart if occupied > 0.0 => {
            sums[measure.place()] / occupied
        }
        MeasureKind::ShareOfHours | MeasureKind::ShareInPart => 0.0,
    })
}

/// How far a measure with this value may be off because nothing is known of some intervals, of a
/// point with these illuminances; `None` where it may be anything.
pub(super) fn off_by_missing(
    measure: Measure,
    value: f64,
    calendar: &Calendar,
    illuminance_lx: &[f64],
) -> Option<f64> {
    let unknown = calendar.count(|interval| !interval.is_known);
    let unknown_occupied = calendar.unknown_occupied as f64;
    if unknown == 0 {
        return Some(0.0);
    }
    match measure.kind() {
        MeasureKind::SunlitHours => Some(unknown_occupied * calendar.interval_h),
        // None of them is taken to be brighter than the brightest known one.
        MeasureKind::Exposure => {
            let brightest_lx = illuminance_lx.iter().copied().reduce(f64::max)?;
            Some(unknown as f64 * brightest_lx * calendar.interval_h)
        }
        MeasureKind::Median => {
            let mut daylit = daylit_lx(calendar, illuminance_lx);
            daylit.sort_by(f64::total_cmp);
            let half = daylit.len() / 2;
            let low_lx = daylit.get(half.checked_sub(unknown)?)?;
            let high_lx = daylit.get(half + unknown)?;
            Some((value - low_lx).max(high_lx - value))
        }
        MeasureKind::ShareOfHours | MeasureKind::ShareInPart => {
            let known = calendar.count(|interval| interval.is_occupied) as f64;
            let share = unknown_occupied / (known + unknown_occupied).max(1.0);
            Some(share * value.max(1.0 - value))
        }
    }
}

fn daylit_lx(calendar: &Calendar, illuminance_lx: &[f64]) -> Vec<f64> {
    let daylit = calendar.intervals.iter().filter(|interval| interval.is_daylit);
    daylit.map(|interval| interval.sky.map_or(0.0, |sky| illuminance_lx[sky])).collect()
}

/// The largest value that half of them reach; 0 of none.
fn median(values: &mut [f64]) -> f64 {
    let half = values.len() / 2;
    if values.is_empty() {
        return 0.0;
    }
    let (_, median, _) = values.select_nth_unstable_by(half, f64::total_cmp);
    *median
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_values_reach_the_median() {
        assert_eq!(median(&mut []), 0.0);
        assert_eq!(median(&mut [7.0]), 7.0);
        assert_eq!(median(&mut [4.0, 1.0, 3.0]), 3.0);
        assert_eq!(median(&mut [4.0, 1.0, 3.0, 2.0]), 3.0);
    }
}
