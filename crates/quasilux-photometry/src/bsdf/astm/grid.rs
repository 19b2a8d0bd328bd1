//! Records in any order to lobes on full grids.

use super::Record;
use crate::bsdf::gridded::{ExitKnots, GriddedTable, Lobe, MOST_INCIDENCES};
use crate::report::Position;
use crate::{ReadError, Symmetry};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Steps of angles in a radian: closer ones are the same.
const STEPS: f64 = 1e5;

/// Widest gaps between polar angles of exits, from the best on.
const WIDEST_RAD: [f64; 3] = [PI / 72.0, PI / 36.0, PI / 18.0];

/// Exit directions of all lobes together, or as many as values where those are more.
const LEAST_DIRECTIONS: usize = 1 << 18;

/// An angle as a number that can be compared.
type Key = i64;

/// f by polar angle and azimuth of the exit direction.
type Exits = BTreeMap<(Key, Key), [f64; 3]>;

fn key(angle_rad: f64) -> Key {
    (angle_rad * STEPS).round() as Key
}

/// An azimuth, a whole turn being none.
fn azimuth_key(angle_rad: f64) -> Key {
    key(angle_rad.rem_euclid(TAU)) % key(TAU)
}

fn angle(key: Key) -> f64 {
    key as f64 / STEPS
}

/// The table. Each incidence must have a full grid of exits, and each azimuth the same polar angles.
pub(super) fn table(
    records: Vec<Record>,
    is_coloured: bool,
    at: Position,
) -> Result<GriddedTable, ReadError> {
    let azimuths: Vec<Key> = planes(&records);
    let normal = records.iter().filter(|record| key(record.angles_rad[0]) == 0).count();
    if azimuths.len().saturating_mul(normal) > 4 * records.len() {
        let found = format!("{} incident azimuths with few lines each", azimuths.len());
        return Err(ReadError::new(at, found, "a full grid of exits for each incident direction"));
    }
    let mut incidences: BTreeMap<(Key, Key), (usize, Exits)> = BTreeMap::new();
    for record in &records {
        let [theta_i, phi_i, theta_s, phi_s] = record.angles_rad;
        let exit = |plane_rad: f64| (key(theta_s), azimuth_key(phi_s - plane_rad));
        let mut add = |plane: Key, plane_rad: f64| {
            let of_plane = incidences.entry((plane, key(theta_i)));
            let (_, exits) = of_plane.or_insert_with(|| (record.line, Exits::new()));
            exits.insert(exit(plane_rad), record.f);
        };
        // Along the normal light belongs to all planes of incidence.
        if key(theta_i) == 0 {
            azimuths.iter().for_each(|&plane| add(plane, angle(plane)));
        } else {
            add(azimuth_key(phi_i), phi_i);
        }
    }
    drop(records);

    if incidences.len() > MOST_INCIDENCES {
        let found = format!("{} incident directions", incidences.len());
        return Err(ReadError::new(at, found, format_args!("no more than {MOST_INCIDENCES}")));
    }
    let mut thetas: Vec<Key> = incidences.keys().map(|(_, theta)| *theta).collect();
    thetas.sort_unstable();
    thetas.dedup();
    if incidences.len() < thetas.len() * azimuths.len() {
        let (count, azimuths) = (incidences.len(), azimuths.len());
        let found = format!("{count} incident directions");
        let expected = format!("{} polar angles for each of {azimuths} azimuths", thetas.len());
        return Err(ReadError::new(at, found, expected));
    }
    let values: usize = incidences.values().map(|(_, exits)| exits.len()).sum();
    let most = values.max(LEAST_DIRECTIONS) / incidences.len();
    let mut lobes = Vec::with_capacity(incidences.len());
    for (line, exits) in incidences.values() {
        let at = Position { line: *line, column: 1 };
        let lobe = rows(exits, at)?.refined(most).lobe(is_coloured);
        lobes.push(lobe.ok_or_else(|| {
            ReadError::new(at, "exit directions that make no grid", "ascending angles")
        })?);
    }
    let theta_rad: Vec<f64> = thetas.into_iter().map(|theta| angle(theta).min(FRAC_PI_2)).collect();
    let phi_rad =
        if azimuths.len() == 1 { vec![0.0] } else { azimuths.into_iter().map(angle).collect() };
    GriddedTable::new(theta_rad.clone(), phi_rad, theta_rad, lobes).ok_or_else(|| {
        ReadError::new(at, "incident directions that make no grid", "ascending angles")
    })
}

/// The azimuths of incidence; along the normal there is none.
fn planes(records: &[Record]) -> Vec<Key> {
    let tilted = records.iter().filter(|record| key(record.angles_rad[0]) != 0);
    let mut planes: Vec<Key> = tilted.map(|record| azimuth_key(record.angles_rad[1])).collect();
    planes.sort_unstable();
    planes.dedup();
    if planes.is_empty() {
        planes.push(records.first().map_or(0, |record| azimuth_key(record.angles_rad[1])));
    }
    planes
}

/// The azimuth on the other side of the plane of incidence.
fn opposite(azimuth: Key) -> Key {
    (key(TAU) - azimuth) % key(TAU)
}

/// f at a grid of exit directions.
struct Rows {
    knots: ExitKnots,
    /// All azimuths of the first polar angle, then of the next.
    f: Vec<Vec<[f64; 3]>>,
}

impl Rows {
    /// The same with f linear in between at narrower polar angles, as many directions as there may be: a lobe is linear in
    /// f times the cosine.
    fn refined(self, most: usize) -> Self {
        let Self { knots, f } = self;
        let columns = knots.phi_rad.len();
        let parts =
            |pair: &[f64], widest_rad: f64| ((pair[1] - pair[0]) / widest_rad).ceil().max(1.0);
        let count = |widest_rad: f64| -> f64 {
            knots.theta_rad.windows(2).map(|pair| parts(pair, widest_rad)).sum()
        };
        let fits = |widest_rad: &f64| count(*widest_rad) * columns as f64 <= most as f64;
        let Some(widest_rad) = WIDEST_RAD.into_iter().find(fits) else {
            return Self { knots, f };
        };
        let (mut theta_rad, mut finer) = (vec![], vec![]);
        for (pair, ends) in knots.theta_rad.windows(2).zip(f.windows(2)) {
            let parts = parts(pair, widest_rad);
            for part in 0..parts as u32 {
                let t = f64::from(part) / parts;
                theta_rad.push((1.0 - t) * pair[0] + t * pair[1]);
                let between = |(a, b): (&[f64; 3], &[f64; 3])| {
                    [0, 1, 2].map(|channel| (1.0 - t) * a[channel] + t * b[channel])
                };
                finer.push(ends[0].iter().zip(&ends[1]).map(between).collect());
            }
        }
        theta_rad.extend(knots.theta_rad.last());
        finer.extend(f.last().cloned());
        Self { knots: ExitKnots { theta_rad, ..knots }, f: finer }
    }

    fn lobe(&self, is_coloured: bool) -> Option<Lobe> {
        let channel = |channel: usize| self.f.iter().flatten().map(|f| f[channel]).collect();
        let channels: Vec<Vec<f64>> = (0..if is_coloured { 3 } else { 1 }).map(channel).collect();
        Lobe::new(&self.knots, &channels)
    }
}

/// A full grid of exits, whose azimuths are counted from the incident one.
fn rows(exits: &Exits, at: Position) -> Result<Rows, ReadError> {
    let mut thetas: Vec<Key> = exits.keys().map(|(theta, _)| *theta).collect();
    thetas.dedup();
    let tilted = exits.keys().filter(|(theta, _)| *theta != 0);
    let mut phis: Vec<Key> = tilted.map(|(_, phi)| *phi).collect();
    phis.sort_unstable();
    phis.dedup();
    if phis.is_empty() {
        phis.push(0);
    }
    // The azimuths of half a turn stand for both halves; one alone for all.
    let is_other_half = phis[0] == 0 && phis.len() > 2 && phis[1] >= key(PI) - 1;
    if is_other_half && phis[phis.len() - 1] > key(PI) + 10 {
        let mirrored = |(&(theta, phi), f): (&(Key, Key), &[f64; 3])| ((theta, opposite(phi)), *f);
        return rows(&exits.iter().map(mirrored).collect(), at);
    }
    let is_half = phis[0] == 0 && (phis[phis.len() - 1] - key(PI)).abs() <= 1;
    let mut phi_rad: Vec<f64> = phis.iter().map(|&phi| angle(phi)).collect();
    let symmetry = match phi_rad.len() {
        1 => Symmetry::Rotational,
        last if is_half => {
            phi_rad[last - 1] = PI;
            Symmetry::Bilateral
        }
        _ => Symmetry::Open,
    };
    let mut f: Vec<Vec<[f64; 3]>> = Vec::with_capacity(thetas.len() + 2);
    for &theta in &thetas {
        let pole = || exits.range((0, 0)..(1, 0)).next().map(|(_, f)| *f);
        let value = |&phi: &Key| {
            let given = exits.get(&(theta, phi)).copied();
            // At the pole all azimuths are one direction.
            given.or_else(|| if theta == 0 { pole() } else { None })
        };
        let row: Option<Vec<[f64; 3]>> = phis.iter().map(value).collect();
        f.push(row.ok_or_else(|| {
            let found = format!("{} exit directions for an incident one", exits.len());
            let (rows, columns) = (thetas.len(), phis.len());
            ReadError::new(
                at,
                found,
                format_args!("a full grid of {rows} polar angles by {columns} azimuths"),
            )
        })?);
    }
    let mut theta_rad: Vec<f64> = thetas.iter().map(|&theta| angle(theta).min(FRAC_PI_2)).collect();
    // f goes on to the normal and to the horizon as at the nearest polar angle.
    if theta_rad[0] > 0.0 {
        theta_rad.insert(0, 0.0);
        f.insert(0, f[0].clone());
    }
    if theta_rad[theta_rad.len() - 1] < FRAC_PI_2 {
        theta_rad.push(FRAC_PI_2);
        f.push(f[f.len() - 1].clone());
    }
    Ok(Rows { knots: ExitKnots { theta_rad, phi_rad, symmetry }, f })
}
