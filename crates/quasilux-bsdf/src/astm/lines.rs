//! Lines of data: which unit their angles have, then one at a time.
//!
//! The text is gone through twice, so that nothing is kept of a line before the unit of its angles
//! is known.

use super::{Columns, colour};
use crate::tokens;
use crate::tokens::Style;
use crate::tokens::Tokens;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::{ParseError, Position, Token, quoted};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Angles in radians are not larger than a half or a whole turn by more than this rounding.
const ROUNDING_RAD: f64 = 0.01;

/// Exits nearer to the horizon are on it.
const HORIZON_RAD: f64 = 1e-3;

/// A line of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberedLine<'t> {
    /// From 1.
    pub(super) number: usize,
    pub(super) text: &'t str,
}

/// The lines of data of a file.
pub(super) struct Lines<L> {
    lines: L,
    columns: Columns,
    count: usize,
    first: usize,
    in_degrees: bool,
    /// Whether no exit but those on the horizon is on the side of the incident light.
    passes_only: bool,
}

/// One line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    pub(super) line: usize,
    /// Polar angle and azimuth of the incident, then of the scattered direction; that on its own
    /// side.
    pub(super) angles_rad: [f64; 4],
    pub(super) is_transmitted: bool,
    /// Linear RGB, or a grey value thrice.
    pub(super) f: [f64; 3],
}

/// The range of angles of a file as it writes them.
struct Range {
    incident: f64,
    exit: [f64; 2],
    azimuth: f64,
}

impl<'t, L: Iterator<Item = NumberedLine<'t>> + Clone> Lines<L> {
    /// The lines behind the names of columns. Polar angles over half a turn and azimuths over a
    /// whole one can only be degrees. `None` without any.
    pub(super) fn survey(lines: L, columns: Columns, warnings: &mut Warnings) -> Option<Self> {
        let mut range =
            Range { incident: 0.0, exit: [f64::INFINITY, f64::NEG_INFINITY], azimuth: 0.0 };
        let (mut count, mut first) = (0, None);
        for line in lines.clone().filter(|line| is_data(line.text)) {
            count += 1;
            first.get_or_insert(line.number);
            range.take(line.text);
        }
        let at = Position { line: first?, column: 1 };
        let polar = range.incident.max(range.exit[1]);
        let in_degrees = polar > PI + ROUNDING_RAD || range.azimuth > TAU + ROUNDING_RAD;
        if in_degrees {
            let (found, most) = if polar > PI + ROUNDING_RAD {
                (format!("a polar angle of {polar}"), "pi")
            } else {
                (format!("an azimuth of {}", range.azimuth), "2 pi")
            };
            let expected = format!("radians, {most} at most (all angles are read as degrees)");
            warnings.push(WarningKind::AnglesInDegrees, at, found, expected);
        }
        let exit = range.exit.map(|angle| if in_degrees { angle.to_radians() } else { angle });
        let passes_only = exit[0] >= FRAC_PI_2 - HORIZON_RAD && exit[1] > FRAC_PI_2 + HORIZON_RAD;
        Some(Self { lines, columns, count, first: at.line, in_degrees, passes_only })
    }

    /// Where the first line is.
    pub(super) fn first(&self) -> Position {
        Position { line: self.first, column: 1 }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// Gives all lines to `take`.
    pub(super) fn read(
        &self,
        warnings: &mut Warnings,
        mut take: impl FnMut(Line) -> Result<(), ParseError>,
    ) -> Result<(), ParseError> {
        for line in self.lines.clone().filter(|line| is_data(line.text)) {
            take(self.line(line, warnings)?)?;
        }
        Ok(())
    }

    fn line(
        &self,
        NumberedLine { number: line, text }: NumberedLine<'_>,
        warnings: &mut Warnings,
    ) -> Result<Line, ParseError> {
        let at = Position { line, column: 1 };
        let mut tokens = Tokens::new(text, at, Style::Plain);
        let count = if self.columns == Columns::Grey { 5 } else { 7 };
        let mut next = |index: usize| {
            let end = tokens.at();
            tokens.next().ok_or_else(|| {
                let expected = format_args!("{count} numbers a line").to_string();
                ParseError::new(end, format_args!("{index} of them"), expected)
            })
        };
        let mut angles_rad = [0.0; 4];
        for (index, angle) in angles_rad.iter_mut().enumerate() {
            *angle = next(index)?.number("an angle")?.value;
        }
        let mut values = [0.0; 3];
        for (index, value) in values.iter_mut().take(count - 4).enumerate() {
            *value = tokens::value(next(4 + index)?, warnings)?;
        }
        if let Some(further) = tokens.next() {
            let expected = format!("the end of the line after {count} numbers");
            return Err(ParseError::new(further.at, quoted(further.text), expected));
        }
        let f = match self.columns {
            Columns::Grey => [values[0]; 3],
            Columns::Rgb => values,
            Columns::Xyz => colour::rgb(values, at, warnings),
        };
        if self.in_degrees {
            angles_rad = angles_rad.map(f64::to_radians);
        }
        angles_rad[0] = polar(angles_rad[0], FRAC_PI_2, "the incident light", at)?;
        let exit = polar(angles_rad[2], PI, "an exit", at)?;
        let beyond = exit - FRAC_PI_2;
        let is_transmitted = beyond > HORIZON_RAD || self.passes_only && beyond >= -HORIZON_RAD;
        let exit = if is_transmitted { PI - exit } else { exit };
        angles_rad[2] = exit.min(FRAC_PI_2);
        for azimuth in [1, 3] {
            angles_rad[azimuth] = angles_rad[azimuth].rem_euclid(TAU);
        }
        Ok(Line { line, angles_rad, is_transmitted, f })
    }
}

impl Range {
    /// What is no number is told when the line is read.
    fn take(&mut self, text: &str) {
        let is_gap = |character: char| character.is_whitespace() || character == ',';
        let tokens = text.split(is_gap).filter(|token| !token.is_empty());
        let at = Position { line: 1, column: 1 };
        for (index, text) in tokens.take(4).enumerate() {
            let Ok(number) = (Token { text, at }).number("an angle") else {
                continue;
            };
            let angle = number.value;
            match index {
                0 => self.incident = self.incident.max(angle),
                2 => self.exit = [self.exit[0].min(angle), self.exit[1].max(angle)],
                _ => self.azimuth = self.azimuth.max(angle.abs()),
            }
        }
    }
}

/// Not empty, and no comment.
fn is_data(line: &str) -> bool {
    let line = line.trim_start();
    !line.is_empty() && !line.starts_with('#')
}

/// A polar angle within 0 and `most_rad`, but for rounding.
fn polar(angle_rad: f64, most_rad: f64, what: &str, at: Position) -> Result<f64, ParseError> {
    if (-1e-9..=most_rad + ROUNDING_RAD).contains(&angle_rad) {
        return Ok(angle_rad.clamp(0.0, most_rad));
    }
    let found = format!("{what} at {:.3} degrees from the normal", angle_rad.to_degrees());
    Err(ParseError::new(at, found, format_args!("0 to {:.0} degrees", most_rad.to_degrees())))
}
