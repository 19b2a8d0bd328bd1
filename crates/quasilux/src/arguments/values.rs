//! What values on the command line mean: names, counts, shares, lux, times.

use clap::builder::PossibleValuesParser;
use quasilux_scene::project::doubt_of_tolerance;
use quasilux_transport::UnseenTolerance;
use std::fmt::Display;
use std::ops::{Range, RangeInclusive};
use std::time::Duration;

/// The names of a closed set.
pub(super) fn one_of<T: Copy>(all: &[T], name: fn(T) -> &'static str) -> PossibleValuesParser {
    PossibleValuesParser::new(all.iter().copied().map(name))
}

/// A whole number within a range.
pub(super) fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: std::str::FromStr + PartialOrd + Display + Clone,
{
    move |text| {
        let number = text.trim().parse::<T>().ok().filter(|number| range.contains(number));
        let (least, most) = (range.start(), range.end());
        number.ok_or_else(|| format!("expected a whole number from {least} to {most}"))
    }
}

/// A tolerance in (0, 1], as a number or with a percent sign; as a number up to one half.
pub(super) fn share(text: &str) -> Result<f64, String> {
    let bare = text.trim().parse::<f64>().ok().filter(|share| (0.0..=100.0).contains(share));
    match bare.and_then(doubt_of_tolerance) {
        Some(doubt) => Err(doubt),
        None => any_share(text)
            .ok_or_else(|| "expected a share above 0 and up to 100%, like 1% or 0.01".to_owned()),
    }
}

/// A tolerance of unseen light, as [`share`], or off.
pub(super) fn unseen_tolerance(text: &str) -> Result<UnseenTolerance, String> {
    if text.trim() == UnseenTolerance::OFF {
        return Ok(UnseenTolerance::Off);
    }
    let or_off = |said: String| format!("{said}, or {}", UnseenTolerance::OFF);
    share(text).map(UnseenTolerance::Share).map_err(or_off)
}

/// A share in (0, 1).
pub(super) fn level(text: &str) -> Result<f64, String> {
    let below_one = any_share(text).filter(|level| *level < 1.0);
    below_one.ok_or_else(|| "expected a share between 0 and 1, like 95% or 0.99".to_owned())
}

/// A share in (0, 1], as a number or with a percent sign.
fn any_share(text: &str) -> Option<f64> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let share = match text.strip_suffix('%') {
        Some(percent) => number(percent).map(|percent| percent / 100.0),
        None => number(text),
    };
    share.filter(|share| *share > 0.0 && *share <= 1.0)
}

/// Hours of a day, like 8-18 or 8.5-17.
pub(super) fn hours_of_day(text: &str) -> Result<Range<f64>, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let ends = text.split_once('-').and_then(|(from, to)| number(from).zip(number(to)));
    let is_in_day = |(from, to): &(f64, f64)| (0.0..*to).contains(from) && *to <= 24.0;
    ends.filter(is_in_day)
        .map(|(from, to)| from..to)
        .ok_or_else(|| "expected hours of a day, like 8-18".to_owned())
}

/// A positive illuminance in lx.
pub(super) fn illuminance(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix("lx").unwrap_or(text).trim().parse::<f64>();
    number
        .ok()
        .filter(|lx| *lx > 0.0 && lx.is_finite())
        .ok_or_else(|| "expected an illuminance above 0, like 0.5 or 0.5lx".to_owned())
}

/// Thirty years: what is longer cannot be added to a clock.
const MAX_SECONDS: f64 = 1e9;

/// A positive time in seconds, minutes or hours; seconds where no unit is given.
pub(super) fn duration(text: &str) -> Result<Duration, String> {
    let (number, unit_s) = match text.char_indices().last() {
        Some((end, 's')) => (&text[..end], 1.0),
        Some((end, 'm')) => (&text[..end], 60.0),
        Some((end, 'h')) => (&text[..end], 3600.0),
        _ => (text, 1.0),
    };
    let seconds = number.trim().parse::<f64>().ok().map(|number| number * unit_s);
    seconds
        .filter(|seconds| *seconds > 0.0 && *seconds <= MAX_SECONDS)
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "expected a time above 0, like 60s, 5m or 1.5h, and at most 1e9s".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_times_are_read() {
        assert_eq!(share("1%"), Ok(0.01));
        assert_eq!(share("0.5 %"), Ok(0.005));
        assert_eq!(share("0.02"), Ok(0.02));
        assert_eq!((share("0.5"), share("60%"), share("100%")), (Ok(0.5), Ok(0.6), Ok(1.0)));
        for (doubtful, meant) in [
            ("1", "was 1 % meant? expected 0.01 or 1%, or 100% if not"),
            ("2.5", "2.5 stands for 250 %: was 2.5 % meant? expected 0.025 or 2.5%"),
        ] {
            let said = share(doubtful).unwrap_err();
            assert!(said.ends_with(meant), "{said}");
        }
        for bad in ["0", "-1%", "101%", "x", "", "%", "nan", "inf"] {
            assert!(share(bad).is_err(), "{bad}");
        }
        assert_eq!(unseen_tolerance("5%"), Ok(UnseenTolerance::Share(0.05)));
        assert_eq!(unseen_tolerance("off"), Ok(UnseenTolerance::Off));
        assert!(unseen_tolerance("none").unwrap_err().ends_with(", or off"));
        assert!(unseen_tolerance("2").unwrap_err().contains("was 2 % meant?"));
        assert_eq!((level("99%"), illuminance("0.5 lx")), (Ok(0.99), Ok(0.5)));
        assert!(level("1").is_err() && level("100%").is_err());
        for bad in ["0", "-1lx", "lx", "inf", "nan", "1 fc"] {
            assert!(illuminance(bad).is_err(), "{bad}");
        }
        assert_eq!(duration("90"), Ok(Duration::from_secs(90)));
        assert_eq!(duration("1.5h"), Ok(Duration::from_secs(5400)));
        assert_eq!(duration("2m"), Ok(Duration::from_secs(120)));
        for bad in ["0s", "-1", "s", "", "1d", "nan", "1e300", "inf", "ü"] {
            assert!(duration(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn whole_numbers_are_read_within_their_range() {
        let number = whole::<u16>(1..=1024);
        assert_eq!((number("1"), number("1024")), (Ok(1), Ok(1024)));
        for bad in ["0", "1025", "70000", "-1", "1.5", "", "x"] {
            assert_eq!(number(bad).unwrap_err(), "expected a whole number from 1 to 1024", "{bad}");
        }
    }
}
