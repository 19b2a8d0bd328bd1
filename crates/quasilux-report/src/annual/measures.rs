//! Measures of a year, of the illuminances of its hours at one point.

use super::calendar::Calendar;

/// What illuminances are compared with, in lx.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thresholds {
    /// Enough light: 300 lx (IES LM-83).
    pub enough_lx: f64,
    /// Below it daylight is of no use, and above the other it is too much: 100 and 3000 lx (A.
    /// Nabil and J. Mardaljevic, "Useful daylight illuminances", Energy and Buildings 38, 2006,
    /// with the bounds in use since 2012).
    pub useful_lx: [f64; 2],
    /// Sunlight that glares or heats, straight from the sun: 1000 lx (LM-83).
    pub sunlight_lx: f64,
}

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

impl Default for Thresholds {
    fn default() -> Self {
        Self { enough_lx: 300.0, useful_lx: [100.0, 3000.0], sunlight_lx: 1000.0 }
    }
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

    /// What it is called in headings.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Autonomy => "daylight autonomy",
            Self::ContinuousAutonomy => "continuous daylight autonomy",
            Self::TooLittle => "useful daylight: too little",
            Self::Supplementary => "useful daylight: supplementary",
            Self::Autonomous => "useful daylight: autonomous",
            Self::TooMuch => "useful daylight: too much",
            Self::SunlitHours => "hours of direct sunlight",
            Self::Exposure => "light exposure",
            Self::MedianDaylight => "median daylight",
        }
    }

    /// Whether it is a share of hours.
    #[must_use]
    pub fn is_share(self) -> bool {
        !matches!(self, Self::SunlitHours | Self::Exposure | Self::MedianDaylight)
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
    let &Thresholds { enough_lx, useful_lx: [least_lx, most_lx], sunlight_lx } = thresholds;
    let (mut occupied, mut sums) = (0.0, [0.0; 6]);
    let (mut sunlit, mut exposure) = (0.0, 0.0);
    let mut daylit = Vec::with_capacity(calendar.intervals.len() / 2 + 1);
    for interval in &calendar.intervals {
        let lx = interval.sky.map_or(0.0, |sky| illuminance_lx[sky]);
        exposure += lx;
        if interval.is_daylit {
            daylit.push(lx);
        }
        if !interval.is_occupied {
            continue;
        }
        occupied += 1.0;
        let is_enough = lx >= enough_lx;
        sums[0] += f64::from(u8::from(is_enough));
        sums[1] += (lx / enough_lx).min(1.0);
        let kind = match lx {
            lx if lx < least_lx => 2,
            lx if lx > most_lx => 5,
            _ if is_enough => 4,
            _ => 3,
        };
        sums[kind] += 1.0;
        let is_sunlit = interval.sky.is_some_and(|sky| sun_lx[sky] > sunlight_lx);
        sunlit += f64::from(u8::from(is_sunlit));
    }
    let [a, b, c, d, e, f] = sums.map(|sum| if occupied > 0.0 { sum / occupied } else { 0.0 });
    let h = calendar.interval_h;
    [a, b, c, d, e, f, sunlit * h, exposure * h, median(&mut daylit)]
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
