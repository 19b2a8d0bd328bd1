//! Reader of MERL files: isotropic reflection over half and difference angles.
//!
//! What is read and tolerated stands in [`formats::merl`](crate::formats::merl).

use crate::defects::warn_of_defects;
use crate::distribution::Distribution;
use crate::facts::BsdfFacts;
use crate::facts::BsdfFormat;
use crate::gridded::ExitGrid;
use crate::gridded::GriddedTable;
use crate::gridded::Lobe;
use crate::gridded::WeightedNode;
use crate::gridded::pair;
use crate::gridded::table_error;
use crate::measured::MeasuredBsdf;
use crate::parsed::Parsed;
use crate::side::ScatteringMode;
use crate::side::Side;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use glam::DVec3;
use quasilux_photometry::Angles;
use quasilux_text::{ParseError, Position};
use std::f64::consts::{FRAC_PI_2, PI};

/// Bytes before the values: three counts.
const HEADER: usize = 12;

/// Channels are stored over these (Matusik et al. 2003).
const SCALES: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// Incident polar angles in degrees: each second one, and the last before the horizon.
const INCIDENCES: usize = 46;

/// Half angles whose mirrored distances are nodes of the lobes, by their number of 90.
const HALF_NODES: [u8; 22] =
    [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 18, 21, 24, 28, 32, 38, 46, 56, 68];

/// Exit directions of one lobe, at most; of small files, as many as there are values.
const DIRECTIONS: usize = 12_000;

/// Reads a MERL file. Total: any bytes give a surface or an error; its place is the byte, counted
/// from 1 in line 1.
///
/// # Errors
/// [`ParseError`] with the position where the three counts are not those of the file, or it is cut
/// short.
pub fn read_merl(bytes: &[u8]) -> Result<Parsed, ParseError> {
    let start = Position { line: 1, column: 1 };
    let counts = counts(bytes).ok_or_else(|| {
        let found = format!("{} bytes, not as many as their counts ask for", bytes.len());
        ParseError::new(start, found, "three counts from 2 to 1000 and 24 bytes for each triple")
    })?;
    let measured = Measured { bytes, counts };
    let mut warnings = Warnings::default();
    let missing = measured.check()?;
    if missing > 0 {
        let found = format!("{missing} of {} values below 0", 3 * measured.triples());
        let expected = "a measurement (those count as missing, their neighbours stand for them)";
        warnings.push(WarningKind::MissingValues, start, found, expected);
    }
    let no_table = || ParseError::new(start, "values that make no table", "finite values");
    let table = table(&measured).ok_or_else(no_table)?;
    let between: Vec<DVec3> = (0..9).map(|i| direction(f64::from(10 * i + 5))).collect();
    let error = table_error(&table, &between, |wi, wo| measured.value(wi, wo));
    let expected =
        format!("spherical angles (resampled; off by {:.2} % in the mean)", 100.0 * error);
    warnings.push(WarningKind::Resampled, start, "values over half angles", expected);

    let facts = BsdfFacts {
        format: BsdfFormat::Merl,
        name: String::new(),
        manufacturer: String::new(),
        thickness_m: None,
    };
    let mut bsdf = MeasuredBsdf::new(facts);
    bsdf.set(Side::Front, ScatteringMode::Reflection, Distribution::Gridded(table));
    warn_of_defects(&bsdf, start, &mut warnings)?;
    Ok(Parsed { bsdf, warnings: warnings.into_vec() })
}

/// The numbers of half angles, difference angles and difference azimuths, if the bytes are as many
/// as they ask for.
pub(super) fn counts(bytes: &[u8]) -> Option<[usize; 3]> {
    let word = |index: usize| bytes.get(4 * index..4 * index + 4)?.try_into().ok();
    let mut counts = [0; 3];
    for (index, count) in counts.iter_mut().enumerate() {
        *count = usize::try_from(i32::from_le_bytes(word(index)?)).ok()?;
    }
    let fits = counts.iter().all(|count| (2..=1000).contains(count));
    (fits && bytes.len() == HEADER + 24 * counts.iter().product::<usize>()).then_some(counts)
}

fn direction(theta_deg: f64) -> DVec3 {
    Angles { theta_rad: theta_deg.to_radians(), phi_rad: 0.0 }.direction()
}

fn table(measured: &Measured<'_>) -> Option<GriddedTable> {
    let incident_deg = |i: usize| if i + 1 == INCIDENCES { 89.5 } else { 2.0 * i as f64 };
    let half_rad = |k: u8| FRAC_PI_2 * (f64::from(k) / 90.0) * (f64::from(k) / 90.0);
    let offsets: Vec<f64> = HALF_NODES.iter().map(|&k| 2.0 * half_rad(k)).collect();
    let lobe = |i: usize| {
        let wi = direction(incident_deg(i));
        let theta_rad = incident_deg(i).to_radians();
        let most = DIRECTIONS.min(measured.triples() / INCIDENCES);
        let grid = ExitGrid::around(theta_rad, &offsets, &[], false, most);
        let values: Vec<[f64; 3]> = grid.directions().map(|wo| measured.value(wi, wo)).collect();
        let channel = |channel: usize| values.iter().map(|rgb| rgb[channel]).collect();
        Lobe::new(&grid, &[0, 1, 2].map(channel))
    };
    let lobes: Option<Vec<Lobe>> = (0..INCIDENCES).map(lobe).collect();
    let theta_rad: Vec<f64> = (0..INCIDENCES).map(|i| incident_deg(i).to_radians()).collect();
    GriddedTable::new(theta_rad.clone(), vec![0.0], theta_rad, lobes?)
}

/// The values of a file.
struct Measured<'b> {
    bytes: &'b [u8],
    counts: [usize; 3],
}

impl Measured<'_> {
    fn triples(&self) -> usize {
        self.counts.iter().product()
    }

    /// The value of a channel, scaled; negative where it is missing.
    fn at(&self, channel: usize, triple: usize) -> f64 {
        let first = HEADER + 8 * (channel * self.triples() + triple);
        let bytes = self.bytes[first..first + 8].try_into().unwrap_or_default();
        f64::from_le_bytes(bytes) * SCALES[channel]
    }

    /// The number of missing values; refuses what is no number.
    fn check(&self) -> Result<usize, ParseError> {
        let mut missing = 0;
        for index in 0..3 * self.triples() {
            let value = self.at(index / self.triples(), index % self.triples());
            if value.is_nan() || value.abs() > 1e18 {
                let at = Position { line: 1, column: HEADER + 8 * index + 1 };
                return Err(ParseError::new(at, value, "a number, no more than 1e18"));
            }
            missing += usize::from(value < 0.0);
        }
        Ok(missing)
    }

    /// f between the eight values around a pair of directions, by weight; those that are missing
    /// have none.
    fn value(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let axes = self.axes(wi, wo);
        let [_, differences, azimuths] = self.counts;
        let (mut sum, mut weights) = ([0.0; 3], [0.0; 3]);
        for corner in 0..8 {
            let parts = [0, 1, 2].map(|axis| axes[axis][corner >> axis & 1]);
            let weight: f64 = parts.iter().map(|part| part.weight).product();
            let triple =
                (parts[0].index * differences + parts[1].index) * azimuths + parts[2].index;
            for channel in 0..3 {
                let value = self.at(channel, triple);
                if value >= 0.0 && weight > 0.0 {
                    sum[channel] += weight * value;
                    weights[channel] += weight;
                }
            }
        }
        [0, 1, 2].map(|c| if weights[c] > 0.0 { sum[c] / weights[c] } else { 0.0 })
    }

    /// The nodes around a pair along each axis, with their weights (Rusinkiewicz 1998).
    fn axes(&self, wi: DVec3, wo: DVec3) -> [[WeightedNode; 2]; 3] {
        let half = (wi + wo).normalize_or(DVec3::Z);
        let Angles { theta_rad: half_rad, phi_rad: turn_rad } = Angles::from_direction(half);
        let (sin_turn, cos_turn) = libm::sincos(turn_rad);
        let (sin_half, cos_half) = libm::sincos(half_rad);
        let [x, y] = [cos_turn * wi.x + sin_turn * wi.y, cos_turn * wi.y - sin_turn * wi.x];
        let difference =
            DVec3::new(cos_half * x - sin_half * wi.z, y, sin_half * x + cos_half * wi.z);
        let Angles { theta_rad: difference_rad, phi_rad } = Angles::from_direction(difference);
        let [halves, differences, azimuths] = self.counts;
        let half_place = (half_rad / FRAC_PI_2).min(1.0).sqrt() * halves as f64;
        let difference_place = difference_rad / FRAC_PI_2 * differences as f64;
        let azimuth_place = phi_rad.rem_euclid(PI) / PI * azimuths as f64;
        let wrapped = (azimuth_place as usize).min(azimuths - 1);
        let part = (azimuth_place - wrapped as f64).clamp(0.0, 1.0);
        [
            clamped(half_place, halves),
            clamped(difference_place, differences),
            pair(wrapped, (wrapped + 1) % azimuths, part),
        ]
    }
}

/// The nodes around a place of an axis; beyond the last one that holds.
fn clamped(place: f64, count: usize) -> [WeightedNode; 2] {
    let below = (place as usize).min(count - 1);
    let part = (place - below as f64).clamp(0.0, 1.0);
    pair(below, (below + 1).min(count - 1), part)
}
