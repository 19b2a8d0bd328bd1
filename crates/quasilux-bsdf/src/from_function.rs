//! Tables of a function: what a laboratory would write down of a surface with a closed form.
//!
//! All take f(wi, wo) in sr^-1 without the cosine, in the frame of the [module](super). Boxes and
//! patches hold means of f over midpoints, two along each axis, so that lobes little wider than a
//! box keep their light; f, being constant in it, is of first order in its width.

use crate::gridded::ExitGrid;
use crate::gridded::GriddedTable;
use crate::gridded::Lobe;
use crate::gridded::as_in_file;
use crate::hemisphere::upwards;
use crate::klems::AngleBasis;
use crate::klems::KlemsTable;
use crate::tree::DEEPEST;
use crate::tree::TensorTree;
use crate::tree::TreeBuilder;
use glam::DVec3;
use quasilux_photometry::Angles;
use quasilux_sampling::warp::sample_disk;

/// Midpoints of the two halves of a box.
const HALVES: [f64; 2] = [0.25, 0.75];

impl KlemsTable {
    /// The means of f over pairs of patches. `None` where one is negative or no number.
    #[must_use]
    pub fn from_function(
        incident: AngleBasis,
        exit: AngleBasis,
        f: impl Fn(DVec3, DVec3) -> f64,
    ) -> Option<Self> {
        let directions = |basis: &AngleBasis, sign: f64| -> Vec<[DVec3; 4]> {
            let inside = |fraction: [f64; 2], cell| {
                let [x, y, z] = basis.place_in(cell, fraction);
                DVec3::new(sign * x, sign * y, z)
            };
            basis.cells().map(|cell| quarters().map(|fraction| inside(fraction, cell))).collect()
        };
        let (arriving, leaving) = (directions(&incident, -1.0), directions(&exit, 1.0));
        let mean = |wi: &[DVec3; 4], wo: &[DVec3; 4]| {
            let of_wi = |&wi: &DVec3| wo.iter().map(|&wo| f(wi, wo)).sum::<f64>();
            wi.iter().map(of_wi).sum::<f64>() / 16.0
        };
        let row = |wi: &[DVec3; 4]| leaving.iter().map(|wo| mean(wi, wo)).collect::<Vec<f64>>();
        let values = arriving.iter().flat_map(row).collect();
        Self::new(incident, exit, values)
    }
}

impl TensorTree {
    /// The means of f over 2^`log_side` boxes along each axis, in rank 3 where `is_isotropic`,
    /// which takes f with wi at azimuth pi, and in rank 4 otherwise. `None` where one is negative
    /// or no number, and unless boxes are 2 to 2^12 a side and fewer than 2^32 in all.
    #[must_use]
    pub fn from_function(
        is_isotropic: bool,
        log_side: usize,
        f: impl Fn(DVec3, DVec3) -> f64,
    ) -> Option<Self> {
        let incident_axes = if is_isotropic { 1 } else { 2 };
        let axes = incident_axes + 2;
        if !(1..=DEEPEST).contains(&log_side) || log_side * axes >= 32 {
            return None;
        }
        let side = 1_usize << log_side;
        let value = |index: usize| {
            let cell = |axis: usize| index >> (log_side * (axes - 1 - axis)) & (side - 1);
            // The upper half of the incident axis of rank 3 is not in use.
            if is_isotropic && 2 * cell(0) >= side {
                return 0.0;
            }
            let point = |point: usize| {
                let place =
                    |axis: usize| (cell(axis) as f64 + HALVES[point >> axis & 1]) / side as f64;
                let onwards = match incident_axes {
                    1 => [1.0 - 2.0 * place(0), 0.0],
                    _ => sample_disk([place(0), place(1)]),
                };
                let exit = sample_disk([place(incident_axes), place(incident_axes + 1)]);
                f(upwards(onwards.map(|x| -x)), upwards(exit))
            };
            (0..1 << axes).map(point).sum::<f64>() / f64::from(1_u32 << axes)
        };
        let values: Vec<f64> = (0..1_usize << (log_side * axes)).map(value).collect();
        let is_right = |value: &f64| value.is_finite() && *value >= 0.0;
        if !values.iter().all(is_right) {
            return None;
        }
        let mut builder = TreeBuilder::new(incident_axes);
        builder.grid(0, 0, &values, log_side)?;
        builder.finish()
    }
}

impl GriddedTable {
    /// Lobes of a surface that is isotropic and mirrored in the plane of incidence, at ascending
    /// incident polar angles `theta_rad` up to pi/2. Their nodes lie at distances `offsets_rad`
    /// from the mirror direction, in the plane of incidence and across, and wherever gaps would be
    /// wider than 2.5 degrees in polar angle or 5 in azimuth: f is of second order in both.
    ///
    /// `None` where angles do not ascend or are no angles, and where f is negative or no number.
    #[must_use]
    pub fn from_function(
        theta_rad: &[f64],
        offsets_rad: &[f64],
        f: impl Fn(DVec3, DVec3) -> f64,
    ) -> Option<Self> {
        let is_angle = |angle: &f64| (0.0..=std::f64::consts::FRAC_PI_2).contains(angle);
        let are_distances = offsets_rad.iter().all(|offset| offset.is_finite() && *offset >= 0.0);
        if !theta_rad.iter().all(is_angle) || !are_distances {
            return None;
        }
        let lobe = |&theta_rad: &f64| {
            let wi = as_in_file(Angles { theta_rad, phi_rad: 0.0 }.direction());
            let wi = DVec3::new(wi.x, wi.y, wi.z.max(0.0));
            let grid = ExitGrid::around(theta_rad, offsets_rad, &[], true, usize::MAX);
            let values = grid.directions().map(|wo| f(wi, as_in_file(wo))).collect();
            Lobe::new(&grid, &[values])
        };
        let lobes: Option<Vec<Lobe>> = theta_rad.iter().map(lobe).collect();
        Self::new(theta_rad.to_vec(), vec![0.0], theta_rad.to_vec(), lobes?)
    }
}

/// The middles of the four quarters of a patch.
fn quarters() -> [[f64; 2]; 4] {
    [0, 1, 2, 3].map(|quarter| [HALVES[quarter & 1], HALVES[quarter >> 1]])
}
