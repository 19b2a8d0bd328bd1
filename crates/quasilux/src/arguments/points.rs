//! What can be said to `quasilux points`.

use super::values::{one_of, whole};
use clap::Args;
use quasilux_sampling::{Randomization, Sequence};
use std::path::PathBuf;

/// More points than this are no list for anybody.
const MAX_POINTS: u64 = 1 << 32;
/// The longest comparison takes minutes.
const MAX_COMPARED: u64 = 1 << 20;
const MIN_COMPARED: u64 = 1 << 6;

#[derive(Debug, Args)]
pub(crate) struct PointsArguments {
    /// The sequence
    #[arg(
        required_unless_present = "compare",
        conflicts_with = "compare",
        value_parser = one_of(&Sequence::all_for(1), Sequence::name),
    )]
    pub(crate) name: Option<String>,
    /// Number of points, like 64 or 2^6
    #[arg(
        short,
        long = "count",
        value_name = "N",
        default_value = "64",
        value_parser = points,
        conflicts_with = "compare",
    )]
    pub(crate) n: u64,
    /// The dimensions, counted from 0, with commas between them
    #[arg(
        long,
        value_name = "LIST",
        value_delimiter = ',',
        default_value = "0,1",
        value_parser = dimension,
        conflicts_with = "compare",
    )]
    pub(crate) dims: Vec<u32>,
    /// How they are randomised
    #[arg(
        long,
        value_name = "NAME",
        default_value = "none",
        conflicts_with = "compare",
        value_parser = one_of(&Randomization::ALL, Randomization::name),
    )]
    pub(crate) randomization: String,
    /// Seed of the randomisation
    #[arg(long, value_name = "N", default_value = "1", value_parser = whole::<u64>(0..=u64::MAX))]
    pub(crate) seed: u64,
    /// Draw the points of two dimensions, or the comparison
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Write the numbers to a file [default: to stdout, unless they are drawn]
    #[arg(long, value_name = "FILE")]
    pub(crate) csv: Option<PathBuf>,
    /// Cells along each side of the drawing; 1 draws none
    #[arg(
        long,
        value_name = "N",
        default_value_t = 8,
        value_parser = whole::<u32>(1..=128),
        conflicts_with = "compare",
    )]
    pub(crate) cells: u32,
    /// Compare all sequences under all randomisations: discrepancy and integration error against N
    #[arg(long)]
    pub(crate) compare: bool,
    /// Largest number of points compared
    #[arg(
        long,
        value_name = "N",
        default_value = "2^16",
        requires = "compare",
        value_parser = compared,
    )]
    pub(crate) max_n: u64,
}

fn dimension(text: &str) -> Result<u32, String> {
    let expected = |_| format!("expected dimensions from 0 to {}, like 0,1", u32::MAX);
    text.parse().map_err(expected)
}

fn points(text: &str) -> Result<u64, String> {
    count(text, 1, MAX_POINTS)
}

fn compared(text: &str) -> Result<u64, String> {
    count(text, MIN_COMPARED, MAX_COMPARED)
}

/// A whole number, as digits or as a power of two like 2^16.
fn count(text: &str, least: u64, most: u64) -> Result<u64, String> {
    let number = match text.strip_prefix("2^") {
        Some(power) => power.parse().ok().and_then(|power| 1_u64.checked_shl(power)),
        None => text.parse().ok(),
    };
    number
        .filter(|number| (least..=most).contains(number))
        .ok_or_else(|| format!("expected a whole number from {least} to {most}, like 64 or 2^6"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_numbers_or_powers_of_two() {
        assert_eq!(points("64"), Ok(64));
        assert_eq!(points("2^16"), Ok(65_536));
        assert_eq!(points("2^32"), Ok(1 << 32));
        for bad in ["0", "", "-1", "2^", "2^33", "2^64", "2^-1", "1e3", "4294967297", "x"] {
            assert!(points(bad).is_err(), "{bad}");
        }
        assert!(compared("63").is_err() && compared("2^21").is_err());
    }
}
