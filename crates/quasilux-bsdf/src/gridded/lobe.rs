//! What one incident direction is scattered to.

use super::ExitGrid;
use crate::color::luminance;
use glam::DVec3;
use quasilux_photometry::{Grid, SphericalTable};
use std::f64::consts::{FRAC_PI_2, PI};

/// Less than this counts as nothing, as in tables of what is above it: shares of such values would
/// lose digits to underflow.
const MIN_VALUE: f64 = 1e-100;

/// What one incident direction is scattered to, its azimuth being 0: f is the least of its values,
/// as of Lambert's surface, and what there is above that.
#[derive(Clone, Debug)]
pub(crate) struct Lobe {
    /// The least f, in sr^-1, by linear RGB.
    least: [f64; 3],
    /// The luminance of g = (f - least) cos(theta), in sr^-1.
    luminance: SphericalTable,
    /// g by linear RGB, where it is not grey.
    channels: Option<[SphericalTable; 3]>,
}

impl Lobe {
    /// A lobe from f at exit directions: one list for grey, three for linear RGB, each all azimuths
    /// at the first polar angle, then at the next. `None` where they are no grid.
    pub(crate) fn new(grid: &ExitGrid, channels: &[Vec<f64>]) -> Option<Self> {
        let columns = grid.phi_rad.len();
        // At the horizon f may be anything, and g is zero.
        let cosine = |index: usize| {
            let theta_rad = grid.theta_rad[index / columns];
            if theta_rad >= FRAC_PI_2 { 0.0 } else { libm::cos(theta_rad).max(0.0) }
        };
        let least = |values: &Vec<f64>| {
            let above = values.iter().enumerate().filter(|(index, _)| cosine(*index) > 0.0);
            let least = above.map(|(_, f)| *f).fold(f64::INFINITY, f64::min);
            if least.is_finite() && least >= MIN_VALUE { least } else { 0.0 }
        };
        let g = |values: &Vec<f64>, least: f64| -> Vec<f64> {
            let g = |(index, f): (usize, &f64)| match cosine(index) {
                0.0 => 0.0,
                cosine => (f - least) * cosine,
            };
            values.iter().enumerate().map(g).collect()
        };
        let table = |values: Vec<f64>| {
            let (theta_rad, phi_rad) = (grid.theta_rad.clone(), grid.phi_rad.clone());
            SphericalTable::new(Grid { theta_rad, phi_rad, symmetry: grid.symmetry, values }).ok()
        };
        match channels {
            [grey] => {
                let least = least(grey);
                let luminance = table(g(grey, least))?;
                Some(Self { least: [least; 3], luminance, channels: None })
            }
            [red, green, blue] => {
                let least = [red, green, blue].map(least);
                let [red, green, blue] = [g(red, least[0]), g(green, least[1]), g(blue, least[2])];
                let mixed = |index: usize| luminance([red[index], green[index], blue[index]]);
                let luminance = table((0..red.len()).map(mixed).collect())?;
                let channels = Some([table(red)?, table(green)?, table(blue)?]);
                Some(Self { least, luminance, channels })
            }
            _ => None,
        }
    }

    pub(super) fn is_coloured(&self) -> bool {
        self.channels.is_some()
    }

    pub(super) fn least(&self) -> [f64; 3] {
        self.least
    }

    /// The luminance of what is above the least, times the cosine.
    pub(super) fn above(&self) -> &SphericalTable {
        &self.luminance
    }

    /// The same by channel.
    pub(super) fn g(&self, direction: DVec3) -> [f64; 3] {
        match &self.channels {
            Some(channels) => [0, 1, 2].map(|channel| channels[channel].value(direction)),
            None => [self.luminance.value(direction); 3],
        }
    }

    /// The share that is scattered, by linear RGB.
    pub(crate) fn albedo(&self) -> [f64; 3] {
        let above = match &self.channels {
            Some(channels) => [0, 1, 2].map(|channel| channels[channel].integral()),
            None => [self.luminance.integral(); 3],
        };
        [0, 1, 2].map(|channel| PI * self.least[channel] + above[channel])
    }
}
