//! Intensities of several emitters of one luminaire, added.
//!
//! Emitters on the same grid are added value by value. Otherwise each table is evaluated at all
//! angles of all of them: on a finer grid a bilinear function stays what it is, so the sum is
//! exact. An emitter whose vertical angles end early counts as dark beyond them, which a bilinear
//! table can only show if it is dark at that end already; for the same reason emitters of types A
//! and B, which shine into a sector, must be on one grid.

use crate::{Angles, Grid, SphericalTable, Symmetry};
use quasilux_text::{ParseError, Position};
use std::f64::consts::TAU;

/// Azimuths closer than this are one.
const SAME_AZIMUTH_RAD: f64 = 1e-12;

/// Values of a sum for each one that is given: what symmetries unfold, and room for unequal grids.
const MAX_VALUES_PER_POINT: usize = 64;
/// Values of a sum whatever is given: far more than the finest goniometer measures.
const MAX_VALUES: usize = 2_000_000;

/// One emitter of a sum.
pub(crate) struct Summand<'a> {
    /// Its intensities, as measured.
    pub(crate) grid: &'a Grid,
    /// The table of that grid.
    pub(crate) table: &'a SphericalTable,
    /// Where it stands in its file.
    pub(crate) at: Position,
}

/// The sum of at least one emitter.
///
/// # Errors
/// For emitters that no bilinear table can add up: see the module.
pub(crate) fn sum(emitters: &[Summand<'_>]) -> Result<SphericalTable, ParseError> {
    let first = &emitters[0];
    let is_same = |emitter: &Summand<'_>| {
        let (a, b) = (emitter.grid, first.grid);
        a.theta_rad == b.theta_rad && a.phi_rad == b.phi_rad && a.symmetry == b.symmetry
    };
    let grid = if emitters.iter().all(is_same) {
        let mut grid = first.grid.clone();
        for emitter in &emitters[1..] {
            for (value, other) in grid.values.iter_mut().zip(&emitter.grid.values) {
                *value += other;
            }
        }
        grid
    } else {
        union(emitters)?
    };
    SphericalTable::new(grid)
        .map_err(|error| ParseError::new(first.at, error, "a photometric table"))
}

fn union(emitters: &[Summand<'_>]) -> Result<Grid, ParseError> {
    if let Some(sector) = emitters.iter().find(|e| e.grid.symmetry == Symmetry::Sector) {
        let found = "an emitter of type A or B whose angles are not those of the others";
        return Err(ParseError::new(sector.at, found, "the same angles in all emitters"));
    }
    let tables = || emitters.iter().map(|emitter| emitter.table);
    let mut theta_rad: Vec<f64> = tables().flat_map(|table| table.theta_rad()).copied().collect();
    theta_rad.sort_by(f64::total_cmp);
    theta_rad.dedup();
    let mut phi_rad: Vec<f64> = tables()
        .flat_map(SphericalTable::phi_rad)
        .map(|phi| phi - (phi / TAU).floor() * TAU)
        .collect();
    phi_rad.sort_by(f64::total_cmp);
    phi_rad.dedup_by(|next, kept| *next - *kept < SAME_AZIMUTH_RAD);
    let start = phi_rad[0];
    phi_rad.retain(|phi| start + TAU - phi > SAME_AZIMUTH_RAD);
    phi_rad.push(start + TAU);

    let points: usize = emitters.iter().map(|emitter| emitter.grid.values.len()).sum();
    let values = theta_rad.len().saturating_mul(phi_rad.len());
    if values > points.saturating_mul(MAX_VALUES_PER_POINT).min(MAX_VALUES) {
        let found = format!("emitters whose sum has {values} values");
        return Err(ParseError::new(emitters[1].at, found, "emitters with angles in common"));
    }
    for emitter in emitters {
        check_ends(emitter, theta_rad[0], theta_rad[theta_rad.len() - 1])?;
    }
    let value = |theta_rad: f64, phi_rad: f64| {
        tables().map(|table| table.value_at(Angles { theta_rad, phi_rad })).sum()
    };
    let values = theta_rad
        .iter()
        .flat_map(|&theta| {
            phi_rad[..phi_rad.len() - 1]
                .iter()
                .map(move |&phi| (theta, phi))
                .chain([(theta, start)])
        })
        .map(|(theta, phi)| value(theta, phi))
        .collect();
    Ok(Grid { theta_rad, phi_rad, symmetry: Symmetry::None, values })
}

/// Refuses an emitter that is cut off while it shines, at angles where another one goes on.
fn check_ends(emitter: &Summand<'_>, first_rad: f64, last_rad: f64) -> Result<(), ParseError> {
    let grid = emitter.grid;
    let (columns, rows) = (grid.phi_rad.len(), grid.theta_rad.len());
    let shines = |row: usize| grid.values[row * columns..][..columns].iter().any(|&cd| cd > 0.0);
    let is_cut = (grid.theta_rad[0] > first_rad && shines(0))
        || (grid.theta_rad[rows - 1] < last_rad && shines(rows - 1));
    if is_cut {
        let found = "an emitter with light at its last vertical angle, and others beyond";
        let expected = "the same range of vertical angles in all emitters, or intensities that \
                        end in 0";
        return Err(ParseError::new(emitter.at, found, expected));
    }
    Ok(())
}
