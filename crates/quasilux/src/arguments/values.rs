//! Names, counts, shares, lux and times: as text on the command line, and as values of a program
//! that carries this one. Both are checked here.

use clap::builder::PossibleValuesParser;
use quasilux_scene::nearest;
use quasilux_scene::project::doubt_of_tolerance;
use quasilux_transport::UnseenTolerance;
use std::fmt::Display;
use std::ops::{Range, RangeInclusive};
use std::time::Duration;

/// The names of a closed set.
pub(super) fn one_of<T: Copy>(all: &[T], name: fn(T) -> &'static str) -> PossibleValuesParser {
    PossibleValuesParser::new(all.iter().copied().map(name))
}

/// A name out of a closed set.
pub(crate) fn name_of<T: Copy>(
    text: &str,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Result<String, String> {
    let known = || all.iter().copied().map(name);
    if known().any(|known| known == text) {
        return Ok(text.to_owned());
    }
    let known: Vec<&str> = known().collect();
    Err(none_of(&known.join(", "), nearest(text, known.iter().copied())))
}

/// Names to choose from where a value is none of them, and the one that is nearest to it.
pub(super) fn none_of(known: &str, nearest: Option<&str>) -> String {
    let nearest = nearest.map_or_else(String::new, |name| format!("; did you mean \"{name}\"?"));
    format!("expected one of {known}{nearest}")
}

/// Indices of a run in each replicate.
pub(crate) const SAMPLES: RangeInclusive<u64> = 1..=1 << 48;
/// Paths of a sensor point in each replicate of a year.
pub(crate) const SAMPLES_OF_YEAR: RangeInclusive<u64> = 1..=1 << 30;
/// Rays of a run.
pub(crate) const RAYS: RangeInclusive<u64> = 1..=u64::MAX;
/// Threads of a run.
pub(crate) const THREADS: RangeInclusive<u16> = 1..=1024;
/// Seeds of randomisations.
pub(crate) const SEEDS: RangeInclusive<u64> = 0..=u64::MAX;

/// A whole number within a range, as text.
pub(super) fn whole<T>(range: RangeInclusive<T>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: std::str::FromStr + PartialOrd + Display + Clone,
{
    move |text| within(text.trim().parse::<T>().ok(), &range)
}

/// A whole number within a range.
pub(crate) fn whole_of<T>(number: i128, range: &RangeInclusive<T>) -> Result<T, String>
where
    T: TryFrom<i128> + PartialOrd + Display,
{
    within(T::try_from(number).ok(), range)
}

fn within<T: PartialOrd + Display>(
    number: Option<T>,
    range: &RangeInclusive<T>,
) -> Result<T, String> {
    let (least, most) = (range.start(), range.end());
    let number = number.filter(|number| range.contains(number));
    number.ok_or_else(|| format!("expected a whole number from {least} to {most}"))
}

/// A tolerance in (0, 1], as a number or with a percent sign; as a number up to one half.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(bare) => share_of(bare),
        Err(_) => share_or_expected(percent(text)),
    }
}

/// A tolerance in (0, 1/2].
pub(crate) fn share_of(number: f64) -> Result<f64, String> {
    let possible = Some(number).filter(|share| (0.0..=100.0).contains(share));
    possible.and_then(doubt_of_tolerance).map_or_else(|| share_or_expected(Some(number)), Err)
}

fn share_or_expected(share: Option<f64>) -> Result<f64, String> {
    share
        .filter(is_share)
        .ok_or_else(|| "expected a share above 0 and up to 100%, like 1% or 0.01".to_owned())
}

/// A tolerance of unseen light, as [`share`], or off.
pub(crate) fn unseen_tolerance(text: &str) -> Result<UnseenTolerance, String> {
    match text.trim() == UnseenTolerance::OFF {
        true => Ok(UnseenTolerance::Off),
        false => unseen(share(text)),
    }
}

/// A tolerance of unseen light, as [`share_of`].
pub(crate) fn unseen_tolerance_of(number: f64) -> Result<UnseenTolerance, String> {
    unseen(share_of(number))
}

fn unseen(share: Result<f64, String>) -> Result<UnseenTolerance, String> {
    let or_off = |said: String| format!("{said}, or {}", UnseenTolerance::OFF);
    share.map(UnseenTolerance::Share).map_err(or_off)
}

/// A share in (0, 1), as a number or with a percent sign.
pub(crate) fn level(text: &str) -> Result<f64, String> {
    level_or_expected(text.trim().parse().ok().or_else(|| percent(text)))
}

/// A share in (0, 1).
pub(crate) fn level_of(number: f64) -> Result<f64, String> {
    level_or_expected(Some(number))
}

fn level_or_expected(level: Option<f64>) -> Result<f64, String> {
    let below_one = level.filter(is_share).filter(|level| *level < 1.0);
    below_one.ok_or_else(|| "expected a share between 0 and 1, like 95% or 0.99".to_owned())
}

/// A number with a percent sign.
fn percent(text: &str) -> Option<f64> {
    let percent = text.strip_suffix('%')?.trim().parse::<f64>().ok()?;
    Some(percent / 100.0)
}

fn is_share(number: &f64) -> bool {
    *number > 0.0 && *number <= 1.0
}

/// Hours of a day, like 8-18 or 8.5-17.
pub(super) fn hours_of_day(text: &str) -> Result<Range<f64>, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let ends = text.split_once('-').and_then(|(from, to)| number(from).zip(number(to)));
    hours_or_expected(ends.map(|(from, to)| from..to))
}

/// Hours of a day, from one to the other.
pub(crate) fn hours_of(hours: Range<f64>) -> Result<Range<f64>, String> {
    hours_or_expected(Some(hours))
}

fn hours_or_expected(hours: Option<Range<f64>>) -> Result<Range<f64>, String> {
    let is_in_day =
        |hours: &Range<f64>| (0.0..hours.end).contains(&hours.start) && hours.end <= 24.0;
    hours.filter(is_in_day).ok_or_else(|| "expected hours of a day, like 8-18".to_owned())
}

/// A positive illuminance in lx, as text.
pub(crate) fn illuminance(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix("lx").unwrap_or(text).trim().parse::<f64>();
    illuminance_of(number.unwrap_or(f64::NAN))
}

/// A positive illuminance in lx.
pub(crate) fn illuminance_of(lx: f64) -> Result<f64, String> {
    let lx = Some(lx).filter(|lx| *lx > 0.0 && lx.is_finite());
    lx.ok_or_else(|| "expected an illuminance above 0, like 0.5 or 0.5lx".to_owned())
}

/// Thirty years: what is longer cannot be added to a clock.
const MAX_SECONDS: f64 = 1e9;

/// A positive time in seconds, minutes or hours; seconds where no unit is given.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let (number, unit_s) = match text.char_indices().last() {
        Some((end, 's')) => (&text[..end], 1.0),
        Some((end, 'm')) => (&text[..end], 60.0),
        Some((end, 'h')) => (&text[..end], 3600.0),
        _ => (text, 1.0),
    };
    duration_of(number.trim().parse::<f64>().map_or(f64::NAN, |number| number * unit_s))
}

/// A positive time in s.
pub(crate) fn duration_of(seconds: f64) -> Result<Duration, String> {
    let seconds = Some(seconds).filter(|seconds| *seconds > 0.0 && *seconds <= MAX_SECONDS);
    seconds
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
