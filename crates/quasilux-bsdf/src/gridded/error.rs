//! How far a table of lobes is off, at the incidences that it stores and between them.

use super::mixture::{Mixture, Part};
use super::{GriddedTable, LobeTransform, TurnedMixture, as_in_file};
use crate::color::luminance;
use crate::hemisphere::lattice;
use crate::hemisphere::upwards;
use glam::DVec3;
use quasilux_sampling::warp::sample_disk;
use std::f64::consts::PI;

/// Exits that are looked at for one incidence.
const EXITS: usize = 610;

/// Incidences at which neighbours are tried, at most.
const TRIED: usize = 128;

impl GriddedTable {
    /// The mean of |f - f'| over the mean of f, over projected solid angle, that is to be expected
    /// in the middle between two incident polar angles; `None` of less than three.
    ///
    /// What is stored at an angle is compared to what its two neighbours would say without it. The
    /// difference is of second order in the gap, which is twice as wide there: a quarter is
    /// expected of neighbours. That is an estimate, good where gaps are even and lobes change
    /// little from one angle to the next; beyond the last angle nothing is known.
    #[must_use]
    pub fn error_between(&self) -> Option<f64> {
        let rows = self.theta_rad.len();
        let middles = rows.checked_sub(2).filter(|middles| *middles > 0)?;
        let tried = (1..rows - 1).step_by(middles.div_ceil(TRIED));
        let planes = self.phi_rad.len();
        let (mut difference, mut sum) = (0.0, 0.0);
        for theta in tried {
            let neighbours = [theta - 1, theta + 1];
            let stretch = self.stretch(neighbours);
            let [low, high] = neighbours.map(|theta| self.theta_rad[theta]);
            let above = (self.theta_rad[theta] - low) / (high - low);
            for plane in (0..planes).step_by(planes.div_ceil(TRIED)) {
                let part = |theta_of_lobe: usize, weight: f64| Part {
                    lobe: &self.lobes[plane * rows + theta_of_lobe],
                    weight,
                    transform: LobeTransform::new(
                        self.mirrors[theta_of_lobe],
                        self.mirrors[theta],
                        stretch,
                    ),
                };
                let stored = part(theta, 1.0);
                let none = Part { weight: 0.0, ..stored };
                let parts = [part(theta - 1, 1.0 - above), part(theta + 1, above), none, none];
                let (off, all) = off(&Mixture { parts: [stored, none, none, none] }, |exit| {
                    Mixture { parts }.luminance(exit)
                });
                difference += off;
                sum += all;
            }
        }
        (sum > 0.0).then(|| 0.25 * difference / sum)
    }
}

/// The mean of |f - f'| over the mean of f', f' the exact function, at incident directions and over
/// projected solid angle, both in the frame of the file.
pub(crate) fn table_error(
    table: &GriddedTable,
    incidences: &[DVec3],
    exact: impl Fn(DVec3, DVec3) -> [f64; 3],
) -> f64 {
    let (mut difference, mut sum) = (0.0, 0.0);
    for &wi in incidences {
        let TurnedMixture { mixture, turn } = table.mixture(as_in_file(wi));
        let (off, all) = off(&mixture, |direction| {
            let wo = as_in_file(super::turned(direction, turn));
            luminance(exact(wi, wo)) * direction.z
        });
        difference += off;
        sum += all;
    }
    if sum > 0.0 { difference / sum } else { 0.0 }
}

/// The integrals of |g - g'| and of g', of which one is a mixture: over exits that are spread
/// evenly by one half and drawn from the mixture by the other. `g` is the other one.
fn off(mixture: &Mixture<'_>, g: impl Fn(DVec3) -> f64) -> (f64, f64) {
    let (mut difference, mut sum) = (0.0, 0.0);
    for index in 0..EXITS {
        let u = lattice(index / 2, EXITS / 2, 0.0);
        let even = upwards(sample_disk(u));
        let exit = if index % 2 == 0 { even } else { mixture.sample(u).unwrap_or(even) };
        let density = 0.5 * (exit.z / PI + mixture.pdf_sr(exit));
        if density > 0.0 {
            let g = g(exit);
            difference += (mixture.luminance(exit) - g).abs() / density;
            sum += g / density;
        }
    }
    (difference / EXITS as f64, sum / EXITS as f64)
}
