//! Grids in the orientations that files have: first plane at C0, mirrored halves on the side that
//! the format stores.

use super::{EncodingNote, Writer};
use crate::{Angles, Grid, PhotometricType, Photometry, SphericalTable, Symmetry};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Planes nearer than this to an axis stand on it.
const TOLERANCE_RAD: f64 = 1e-9;

/// Grids that what is not of type C is resampled on, ever finer: planes around, and steps from
/// nadir to zenith. The last has 260 000 intensities.
const GRIDS: [[usize; 2]; 3] = [[72, 180], [144, 360], [360, 720]];

/// Resampling may change the flux by this part before a finer grid is taken.
const FLUX_TOLERANCE: f64 = 1e-3;

/// The half that a format stores of what is mirrored in the plane of C90 and C270.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Half {
    /// C90 to C270: LM-63.
    Back,
    /// C270 over C0 to C90, the first planes one turn lower: EULUMDAT.
    Front,
}

/// The grid of a luminaire with its planes as files order them.
///
/// One plane stands at 0; quarters go from 0 to 90; halves from 0 to 180 or as `half` says; the
/// whole turn from 0 to 360, closing plane included: that of LM-63 may differ from the first one.
/// What is mirrored here keeps its intensities.
pub(crate) fn aligned(photometry: &Photometry, half: Half, writer: &mut Writer) -> Grid {
    let kind = photometry.facts().photometric_type;
    if kind != PhotometricType::C {
        return resampled(photometry, writer);
    }
    let mut grid = photometry.table().grid();
    let start = grid.phi_rad[0];
    let quarter = (start / FRAC_PI_2).round();
    let on_axis = (start - quarter * FRAC_PI_2).abs() < TOLERANCE_RAD;
    let quarter = quarter.rem_euclid(4.0);
    match grid.symmetry {
        Symmetry::Rotational => {
            grid.phi_rad = vec![0.0];
            grid
        }
        Symmetry::Quadrant if on_axis => {
            // The quarters from 90 and from 270 are images of the one from 0 in a plane.
            let is_image = quarter == 1.0 || quarter == 3.0;
            from(if is_image { mirrored(grid) } else { grid }, 0.0)
        }
        Symmetry::Bilateral if on_axis => match (quarter == 1.0 || quarter == 3.0, half) {
            (false, _) => from(if quarter == 2.0 { mirrored(grid) } else { grid }, 0.0),
            (true, Half::Back) => {
                from(if quarter == 3.0 { mirrored(grid) } else { grid }, FRAC_PI_2)
            }
            (true, Half::Front) => {
                let front = from(if quarter == 1.0 { mirrored(grid) } else { grid }, -FRAC_PI_2);
                with_plane_at_zero(front, writer)
            }
        },
        Symmetry::Quadrant | Symmetry::Bilateral => {
            writer.note(EncodingNote::Unfolded);
            closed(photometry.table().unfolded_grid(), writer)
        }
        Symmetry::Sector => resampled(photometry, writer),
        Symmetry::None | Symmetry::Open => {
            let whole = photometry.table().unfolded_grid();
            let mut grid = closed(whole, writer);
            if half == Half::Front {
                close_with_first(&mut grid, writer);
            }
            grid
        }
    }
}

/// Intensities in planes and at angles of type C all around, on the first of the grids that keeps
/// the flux, or else on the finest.
fn resampled(photometry: &Photometry, writer: &mut Writer) -> Grid {
    let flux_lm = photometry.flux_lm();
    let [first, finer @ ..] = GRIDS;
    let with_flux = |steps| {
        let grid = sampled(photometry, steps);
        let table = SphericalTable::new(grid.clone());
        (steps, grid, table.map_or(0.0, |table| table.integral()))
    };
    let mut taken = with_flux(first);
    for steps in finer {
        if (taken.2 - flux_lm).abs() <= FLUX_TOLERANCE * flux_lm {
            break;
        }
        taken = with_flux(steps);
    }
    let ([planes, angles], grid, written_flux_lm) = taken;
    writer.note(EncodingNote::Resampled {
        photometric_type: photometry.facts().photometric_type,
        plane_step_deg: 360.0 / planes as f64,
        angle_step_deg: 180.0 / angles as f64,
        flux_lm,
        written_flux_lm,
    });
    grid
}

/// Intensities at this many planes around, and so many steps from nadir to zenith.
fn sampled(photometry: &Photometry, [planes, angles]: [usize; 2]) -> Grid {
    let even = |steps: usize, end: f64| -> Vec<f64> {
        (0..=steps).map(|i| i as f64 / steps as f64 * end).collect()
    };
    let (theta_rad, phi_rad) = (even(angles, PI), even(planes, TAU));
    let towards = |theta_rad: f64, plane: usize| {
        // The closing plane is the first one, to the bit.
        let down = Angles { theta_rad, phi_rad: phi_rad[plane % planes] }.direction();
        photometry.intensity_cd(DVec3::new(down.x, down.y, -down.z))
    };
    let values = theta_rad.iter().flat_map(|&theta| (0..=planes).map(move |plane| (theta, plane)));
    let values = values.map(|(theta, plane)| towards(theta, plane)).collect();
    Grid { theta_rad, phi_rad: phi_rad.clone(), symmetry: Symmetry::None, values }
}

/// The same planes with the first one at `start`, if its angle differs by whole quarters only.
fn from(mut grid: Grid, start: f64) -> Grid {
    let shift = start - grid.phi_rad[0];
    let last = grid.phi_rad.len() - 1;
    if shift.abs() > TOLERANCE_RAD {
        for phi in &mut grid.phi_rad {
            *phi += shift;
        }
    }
    // Rounding of the shift must not widen the span.
    grid.phi_rad[last] = start
        + match grid.symmetry {
            Symmetry::Quadrant => FRAC_PI_2,
            _ => PI,
        };
    grid.phi_rad[0] = start;
    grid
}

/// The same grid, with a plane at 0 between those that it has.
fn with_plane_at_zero(mut grid: Grid, writer: &mut Writer) -> Grid {
    if grid.phi_rad.iter().any(|phi| phi.abs() < TOLERANCE_RAD) {
        return grid;
    }
    writer.note(EncodingNote::FirstPlaneAdded);
    let columns = grid.phi_rad.len();
    let place = grid.phi_rad.partition_point(|&phi| phi < 0.0);
    let (before, after) = (grid.phi_rad[place - 1], grid.phi_rad[place]);
    let t = before / (before - after);
    let rows = grid.values.chunks_exact(columns);
    grid.values = rows
        .flat_map(|row| {
            let at_zero = (1.0 - t) * row[place - 1] + t * row[place];
            row[..place].iter().copied().chain([at_zero]).chain(row[place..].iter().copied())
        })
        .collect();
    grid.phi_rad.insert(place, 0.0);
    grid
}

/// The mirror image: the last plane first, at the same distances.
fn mirrored(mut grid: Grid) -> Grid {
    let columns = grid.phi_rad.len();
    let (first, last) = (grid.phi_rad[0], grid.phi_rad[columns - 1]);
    for row in grid.values.chunks_exact_mut(columns) {
        row.reverse();
    }
    grid.phi_rad.reverse();
    for phi in &mut grid.phi_rad {
        *phi = first + (last - *phi);
    }
    grid
}

/// Puts the first plane in the place of the closing one.
fn close_with_first(grid: &mut Grid, writer: &mut Writer) {
    let last = grid.phi_rad.len() - 1;
    let mut difference_cd = 0.0_f64;
    for row in grid.values.chunks_exact_mut(last + 1) {
        difference_cd = difference_cd.max((row[0] - row[last]).abs());
        row[last] = row[0];
    }
    if difference_cd > 0.0 {
        writer.note(EncodingNote::ClosingPlaneDropped { difference_cd });
    }
}

/// A whole turn from 0 to 360.
fn closed(grid: Grid, writer: &mut Writer) -> Grid {
    let columns = grid.phi_rad.len();
    let turns = (grid.phi_rad[0] / TAU).floor() * TAU;
    let mut azimuths: Vec<f64> = grid.phi_rad.iter().map(|phi| phi - turns).collect();
    if azimuths[0].abs() < TOLERANCE_RAD || (azimuths[0] - TAU).abs() < TOLERANCE_RAD {
        let first = azimuths[0];
        azimuths.iter_mut().for_each(|phi| *phi -= first);
        (azimuths[0], azimuths[columns - 1]) = (0.0, TAU);
        return Grid { phi_rad: azimuths, symmetry: Symmetry::None, ..grid };
    }
    // Planes from 360 on come first, one turn lower; the first one closes the turn of old.
    let split = azimuths.partition_point(|&phi| phi < TAU - TOLERANCE_RAD);
    let meets = azimuths[split] < TAU + TOLERANCE_RAD;
    let order: Vec<usize> = (split + usize::from(meets)..columns - 1).chain(0..split).collect();
    let t = (TAU - azimuths[split - 1]) / (azimuths[split] - azimuths[split - 1]);
    let at_zero = |row: &[f64]| {
        if meets { row[split] } else { (1.0 - t) * row[split - 1] + t * row[split] }
    };
    if !meets {
        writer.note(EncodingNote::FirstPlaneAdded);
    }
    let mut phi_rad = vec![0.0];
    phi_rad.extend(order.iter().map(|&column| match azimuths[column] {
        phi if phi > TAU => phi - TAU,
        phi => phi,
    }));
    phi_rad.push(TAU);
    let mut difference_cd = 0.0_f64;
    let mut values = Vec::with_capacity(grid.theta_rad.len() * phi_rad.len());
    for row in grid.values.chunks_exact(columns) {
        difference_cd = difference_cd.max((row[0] - row[columns - 1]).abs());
        values.push(at_zero(row));
        values.extend(order.iter().map(|&column| row[column]));
        values.push(at_zero(row));
    }
    if difference_cd > 0.0 {
        writer.note(EncodingNote::ClosingPlaneDropped { difference_cd });
    }
    Grid { theta_rad: grid.theta_rad, phi_rad, symmetry: Symmetry::None, values }
}
