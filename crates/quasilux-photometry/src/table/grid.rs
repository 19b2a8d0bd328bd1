//! A grid of spherical angles as measured, and the grid without symmetry that it stands for.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Angles that should be equal may differ by this much, in radians.
const ANGLE_TOLERANCE_RAD: f64 = 1e-9;

/// Greater values would overflow in sums and products.
const MAX_VALUE: f64 = 1e100;

/// Smaller values count as zero: their products would lose digits to underflow.
const MIN_VALUE: f64 = 1e-100;

/// What the azimuths of a grid cover, and how the rest follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Symmetry {
    /// One azimuth: the value does not depend on it.
    Rotational,
    /// A quarter turn, mirrored in its first and in its last plane.
    Quadrant,
    /// Half a turn, mirrored in the plane of its first and last azimuth.
    Bilateral,
    /// A full turn, the closing plane included.
    None,
    /// A full turn without its closing plane, which equals the first one.
    Open,
    /// Part of a turn: elsewhere the value is zero, with a jump at both borders.
    Sector,
}

/// Values on a grid of spherical angles, as measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Polar angles, strictly ascending within [0, pi]; at least two.
    pub theta_rad: Vec<f64>,
    /// Azimuths, strictly ascending; `symmetry` says what they must span.
    pub phi_rad: Vec<f64>,
    /// What the azimuths cover.
    pub symmetry: Symmetry,
    /// Non-negative values, row by row: all azimuths at the first polar angle, then the next.
    /// Those below 1e-100 count as zero.
    pub values: Vec<f64>,
}

/// Why a grid is not one.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// Fewer than two polar angles.
    #[error("a spherical table needs at least two polar angles, found {0}")]
    TooFewPolarAngles(usize),
    /// A polar angle outside [0, pi] or not above its predecessor.
    #[error("polar angle {0} is not above the one before it, or not between 0 and 180 degrees")]
    PolarAngle(usize),
    /// An azimuth that is not above its predecessor.
    #[error("azimuth {0} is not above the one before it")]
    Azimuth(usize),
    /// The azimuths do not span what the symmetry asks for.
    #[error("the azimuths span {span_deg} degrees, which does not fit the symmetry {symmetry:?}")]
    Span {
        /// Last less first azimuth.
        span_deg: f64,
        /// The symmetry asked for.
        symmetry: Symmetry,
    },
    /// The number of values is not the product of the numbers of angles.
    #[error("{expected} values expected, found {found}")]
    ValueCount {
        /// Polar angles times azimuths.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// A negative, infinite, undefined or huge value.
    #[error("value {0} is not between 0 and 1e100")]
    Value(usize),
}

/// A grid without symmetry: azimuths as offsets from the first one, from 0 to a full turn
/// or to the end of a sector.
pub(super) struct FullGrid {
    pub(super) theta_rad: Vec<f64>,
    pub(super) phi_start_rad: f64,
    pub(super) phi_rad: Vec<f64>,
    pub(super) values: Vec<f64>,
}

/// A column of a grid without symmetry.
#[derive(Clone, Copy)]
struct Column {
    /// From the first azimuth.
    offset_rad: f64,
    /// The measured column with the same values.
    measured: usize,
}

impl Grid {
    pub(super) fn without_symmetry(self) -> Result<FullGrid, TableError> {
        self.check()?;
        let columns = self.phi_rad.len();
        let start = self.phi_rad[0];
        // Which column of the measured grid stands at each offset of the full one.
        let measured: Vec<Column> = self
            .phi_rad
            .iter()
            .enumerate()
            .map(|(measured, phi)| Column { offset_rad: phi - start, measured })
            .collect();
        let end = Column { offset_rad: TAU, measured: 0 };
        let full = match self.symmetry {
            Symmetry::Rotational => vec![Column { offset_rad: 0.0, measured: 0 }, end],
            Symmetry::Quadrant => mirrored(&mirrored(&measured, FRAC_PI_2), PI),
            Symmetry::Bilateral => mirrored(&measured, PI),
            Symmetry::None => closed(measured, columns - 1),
            Symmetry::Open => {
                let mut open = measured;
                open.push(end);
                open
            }
            Symmetry::Sector => measured,
        };
        let values = self
            .values
            .chunks_exact(columns)
            .flat_map(|row| full.iter().map(|column| row[column.measured]))
            .map(|value| if value < MIN_VALUE { 0.0 } else { value })
            .collect();
        Ok(FullGrid {
            theta_rad: self.theta_rad,
            phi_start_rad: start,
            phi_rad: full.iter().map(|column| column.offset_rad).collect(),
            values,
        })
    }

    fn check(&self) -> Result<(), TableError> {
        let (rows, columns) = (self.theta_rad.len(), self.phi_rad.len());
        if rows < 2 {
            return Err(TableError::TooFewPolarAngles(rows));
        }
        if let Some(index) = first_not_ascending(&self.theta_rad, 0.0, PI) {
            return Err(TableError::PolarAngle(index));
        }
        if let Some(index) = first_not_ascending(&self.phi_rad, -4.0 * TAU, 4.0 * TAU) {
            return Err(TableError::Azimuth(index));
        }
        let span = match self.phi_rad[..] {
            [first, .., last] => last - first,
            _ => 0.0,
        };
        let near = |angle: f64| columns > 1 && (span - angle).abs() < ANGLE_TOLERANCE_RAD;
        let fits = match self.symmetry {
            Symmetry::Rotational => columns == 1,
            Symmetry::Quadrant => near(FRAC_PI_2),
            Symmetry::Bilateral => near(PI),
            Symmetry::None => near(TAU),
            Symmetry::Open | Symmetry::Sector => columns > 1 && span < TAU - ANGLE_TOLERANCE_RAD,
        };
        if !fits {
            return Err(TableError::Span { span_deg: span / PI * 180.0, symmetry: self.symmetry });
        }
        let expected = rows.saturating_mul(columns);
        if self.values.len() != expected {
            return Err(TableError::ValueCount { expected, found: self.values.len() });
        }
        match self.values.iter().position(|value| !(0.0..=MAX_VALUE).contains(value)) {
            Some(index) => Err(TableError::Value(index)),
            None => Ok(()),
        }
    }
}

fn first_not_ascending(angles: &[f64], min: f64, max: f64) -> Option<usize> {
    if angles.first().is_none_or(|first| !(min..=max).contains(first)) {
        return Some(0);
    }
    let outside = |pair: &[f64]| !(pair[1] > pair[0] && pair[1] <= max);
    angles.windows(2).position(outside).map(|index| index + 1)
}

/// Columns from offset 0 to `end_rad`, followed by their mirror images from `end_rad` to `2
/// end_rad`.
fn mirrored(columns: &[Column], end_rad: f64) -> Vec<Column> {
    let (last, before) = (columns[columns.len() - 1], &columns[..columns.len() - 1]);
    let images = before
        .iter()
        .rev()
        .map(|column| Column { offset_rad: 2.0 * end_rad - column.offset_rad, ..*column });
    let last = Column { offset_rad: end_rad, ..last };
    before.iter().copied().chain([last]).chain(images).collect()
}

/// The same columns with the last one at exactly one turn.
fn closed(mut columns: Vec<Column>, last: usize) -> Vec<Column> {
    columns[last].offset_rad = TAU;
    columns
}
