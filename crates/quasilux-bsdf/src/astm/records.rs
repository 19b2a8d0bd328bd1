//! What a file measured, in few bytes: a number that tells both directions, the line and f in 24
//! bits.

use super::lines::{Lines, NumberedLine};
use crate::gridded::MAX_INCIDENCES;
use crate::side::ScatteringMode;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::{ParseError, Position};
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;

/// Steps of angles in a radian: closer ones are the same.
const STEPS: f64 = 1e5;

/// Bits of an angle of an exit.
const BITS: u32 = 20;

/// An angle as a number that can be compared.
pub(super) type Key = i64;

pub(super) fn key(angle_rad: f64) -> Key {
    (angle_rad * STEPS).round() as Key
}

/// An azimuth, a whole turn being none.
pub(super) fn azimuth_key(angle_rad: f64) -> Key {
    key(angle_rad.rem_euclid(TAU)) % key(TAU)
}

pub(super) fn angle(key: Key) -> f64 {
    key as f64 / STEPS
}

/// f at one pair of directions: 16 bytes where it is grey, 24 in colours.
#[derive(Clone, Copy, Debug)]
struct Record<const N: usize> {
    /// The number of the incidence, the polar angle and the azimuth of the exit.
    key: u64,
    line: u32,
    f: [f32; N],
}

/// f at one exit direction, its azimuth counted from that of the incident one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exit<const N: usize> {
    pub(super) theta: Key,
    pub(super) phi: Key,
    pub(super) f: [f32; N],
}

/// An incident direction of light that is reflected, or of light that is transmitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Incidence {
    mode: usize,
    /// The azimuth; 0 along the normal, which belongs to all.
    pub(super) plane: Key,
    pub(super) theta: Key,
}

/// An incidence and where it begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct IncidenceEntry<'r> {
    pub(super) incidence: &'r Incidence,
    pub(super) beginning: &'r Beginning,
}

/// Where an incidence begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beginning {
    number: u64,
    pub(super) line: usize,
    /// The azimuth of incidence that the line has.
    pub(super) phi: Key,
}

/// All lines of a file, by incidence, polar angle and azimuth of the exit.
pub(super) struct Records<const N: usize> {
    records: Vec<Record<N>>,
    incidences: BTreeMap<Incidence, Beginning>,
}

impl<const N: usize> Records<N> {
    /// The lines in order. Of several with the same directions the first one is kept.
    pub(super) fn read<'t>(
        lines: &Lines<impl Iterator<Item = NumberedLine<'t>> + Clone>,
        warnings: &mut Warnings,
    ) -> Result<Self, ParseError> {
        let mut records = Vec::with_capacity(lines.count());
        let mut incidences: BTreeMap<Incidence, Beginning> = BTreeMap::new();
        lines.read(warnings, |line| {
            let [theta_i, phi_i, theta_s, phi_s] = line.angles_rad;
            let theta = key(theta_i);
            let is_tilted = theta != 0;
            let incidence = Incidence {
                mode: usize::from(line.is_transmitted),
                plane: if is_tilted { azimuth_key(phi_i) } else { 0 },
                theta,
            };
            let number = incidences.len() as u64;
            let known = incidences.entry(incidence).or_insert(Beginning {
                number,
                line: line.line,
                phi: azimuth_key(phi_i),
            });
            let number = known.number;
            if number >= 2 * MAX_INCIDENCES as u64 {
                let at = Position { line: line.line, column: 1 };
                return Err(too_many(at));
            }
            let phi = azimuth_key(if is_tilted { phi_s - phi_i } else { phi_s });
            let key = (number << BITS | key(theta_s) as u64) << BITS | phi as u64;
            let f = std::array::from_fn(|channel| line.f[channel] as f32);
            records.push(Record { key, line: u32::try_from(line.line).unwrap_or(u32::MAX), f });
            Ok(())
        })?;
        if !records.is_sorted_by_key(|record| (record.key, record.line)) {
            records.sort_unstable_by_key(|record| (record.key, record.line));
        }
        let mut all = Self { records, incidences };
        all.keep_first(warnings);
        Ok(all)
    }

    fn keep_first(&mut self, warnings: &mut Warnings) {
        self.records.dedup_by(|record, first| {
            let is_again = record.key == first.key;
            if is_again && record.f != first.f {
                let at = Position { line: record.line as usize, column: 1 };
                let found = format_args!("other values for the directions of line {}", first.line);
                let expected = "each pair of directions once (the first one is read)";
                warnings.push(WarningKind::RepeatedDirection, at, found.to_string(), expected);
            }
            is_again
        });
    }

    /// The incidences of one scattering mode, by azimuth and then by polar angle.
    pub(super) fn incidences(
        &self,
        mode: ScatteringMode,
    ) -> impl Iterator<Item = IncidenceEntry<'_>> + Clone {
        let entries = self.incidences.iter();
        let entries = entries.map(|(incidence, beginning)| IncidenceEntry { incidence, beginning });
        entries.filter(move |entry| entry.incidence.mode == mode as usize)
    }

    pub(super) fn beginning(
        &self,
        mode: ScatteringMode,
        plane: Key,
        theta: Key,
    ) -> Option<&Beginning> {
        let plane = if theta == 0 { 0 } else { plane };
        self.incidences.get(&Incidence { mode: mode as usize, plane, theta })
    }

    /// How many exits an incidence has.
    pub(super) fn count(&self, beginning: &Beginning) -> usize {
        self.range(beginning).len()
    }

    /// The exits of an incidence, azimuths counted from `plane` on where it is along the normal.
    pub(super) fn exits(&self, beginning: &Beginning, plane: Option<Key>) -> Vec<Exit<N>> {
        let mask = (1 << BITS) - 1;
        let turn = plane.unwrap_or(0);
        let exit = |record: &Record<N>| Exit {
            theta: (record.key >> BITS & mask) as Key,
            phi: ((record.key & mask) as Key - turn).rem_euclid(key(TAU)),
            f: record.f,
        };
        let mut exits: Vec<Exit<N>> =
            self.records[self.range(beginning)].iter().map(exit).collect();
        if turn != 0 {
            exits.sort_unstable_by_key(|exit| (exit.theta, exit.phi));
        }
        exits
    }

    fn range(&self, beginning: &Beginning) -> Range<usize> {
        let start =
            |number: u64| self.records.partition_point(|record| record.key >> (2 * BITS) < number);
        start(beginning.number)..start(beginning.number + 1)
    }
}

pub(super) fn too_many(at: Position) -> ParseError {
    let found = format!("more than {MAX_INCIDENCES} incident directions");
    ParseError::new(at, found, format_args!("no more than {MAX_INCIDENCES}"))
}
