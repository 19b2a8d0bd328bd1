//! The exits of one incidence as a full grid.

use super::records::{Exit, Key, angle, key};
use crate::gaps;
use crate::gaps::Gap;
use crate::gridded::ExitGrid;
use crate::gridded::Lobe;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_photometry::Symmetry;
use quasilux_text::{ParseError, Position};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Widest gaps between polar angles of exits, from the best on.
const WIDEST_RAD: [f64; 3] = [PI / 72.0, PI / 36.0, PI / 18.0];

/// Exits of one incidence that make a full grid: the same azimuths at each polar angle.
pub(super) struct Exits<const N: usize> {
    /// By polar angle, then by azimuth.
    exits: Vec<Exit<N>>,
    thetas: Vec<Key>,
    phis: Vec<Key>,
    /// How many of them lie along the normal.
    at_pole: usize,
    symmetry: Symmetry,
    line: usize,
}

impl<const N: usize> Exits<N> {
    pub(super) fn new(mut exits: Vec<Exit<N>>, line: usize) -> Result<Self, ParseError> {
        let mut phis = azimuths(&exits);
        // Azimuths of the other half turn stand for both halves, too.
        let last = phis[phis.len() - 1];
        let is_other_half = phis[0] == 0 && phis.len() > 2 && phis[1] >= key(PI) - 1;
        if is_other_half && last > key(PI) + 10 {
            exits.iter_mut().for_each(|exit| exit.phi = (key(TAU) - exit.phi) % key(TAU));
            exits.sort_unstable_by_key(|exit| (exit.theta, exit.phi));
            phis = azimuths(&exits);
        }
        let mut thetas: Vec<Key> = exits.iter().map(|exit| exit.theta).collect();
        thetas.dedup();
        let at_pole = exits.partition_point(|exit| exit.theta == 0);
        let tilted = thetas.len() - usize::from(at_pole > 0);
        if exits.len() - at_pole != tilted * phis.len() {
            let found = format!("{} exit directions for an incident one", exits.len());
            let (rows, columns) = (thetas.len(), phis.len());
            let expected = format_args!("a full grid of {rows} polar angles by {columns} azimuths")
                .to_string();
            return Err(ParseError::new(Position { line, column: 1 }, found, expected));
        }
        let is_half = phis[0] == 0 && (phis[phis.len() - 1] - key(PI)).abs() <= 1;
        let symmetry = match phis.len() {
            1 => Symmetry::Rotational,
            _ if is_half => Symmetry::Bilateral,
            _ => Symmetry::Open,
        };
        Ok(Self { exits, thetas, phis, at_pole, symmetry, line })
    }

    /// Refuses azimuths between which nothing tells what leaves the plane of incidence, and warns
    /// of wide gaps.
    pub(super) fn check_gaps(&self, warnings: &mut Warnings) -> Result<(), ParseError> {
        let azimuths: Vec<f64> = self.phis.iter().map(|&phi| angle(phi)).collect();
        let widest_rad = match self.symmetry {
            Symmetry::Bilateral => gaps::between(&azimuths),
            _ => gaps::around(&azimuths),
        };
        let at = Position { line: self.line, column: 1 };
        let degrees = widest_rad.to_degrees();
        let found = format!("exit azimuths that leave a gap of {degrees:.0} degrees");
        match gaps::judge(widest_rad) {
            Gap::Narrow => {}
            Gap::Wide => warnings.push(
                WarningKind::AzimuthGap,
                at,
                found,
                "gaps of 45 degrees at most (f is linear across it)",
            ),
            Gap::Open => {
                let expected = "gaps of 90 degrees at most: a scan in one plane does not tell what \
                                leaves that plane";
                return Err(ParseError::new(at, found, expected));
            }
        }
        Ok(())
    }

    /// The lobe, of no more than `most` directions unless the file has more.
    pub(super) fn lobe(self, most: usize, channels: usize) -> Option<Lobe> {
        let rows = self.rows(channels).refined(most);
        Lobe::new(&rows.grid, &rows.channels)
    }

    fn rows(self, channels: usize) -> Rows {
        let Self { exits, thetas, phis, at_pole, symmetry, .. } = self;
        let columns = phis.len();
        let mut phi_rad: Vec<f64> = phis.iter().map(|&phi| angle(phi)).collect();
        if symmetry == Symmetry::Bilateral {
            phi_rad[columns - 1] = PI;
        }
        let mut theta_rad: Vec<f64> =
            thetas.iter().map(|&theta| angle(theta).min(FRAC_PI_2)).collect();
        // f goes on to the normal and to the horizon as at the nearest polar angle.
        let (is_opened, is_closed) =
            (theta_rad[0] > 0.0, theta_rad[theta_rad.len() - 1] < FRAC_PI_2);
        let (pole, tilted) = exits.split_at(at_pole);
        let channel = |channel: usize| {
            let mut f: Vec<f64> = Vec::with_capacity((thetas.len() + 2) * columns);
            if at_pole > 0 {
                // At the pole all azimuths are one direction.
                let at = |phi: &Key| {
                    let given = pole.binary_search_by_key(phi, |exit| exit.phi).unwrap_or(0);
                    f64::from(pole[given].f[channel])
                };
                f.extend(phis.iter().map(at));
            }
            f.extend(tilted.iter().map(|exit| f64::from(exit.f[channel])));
            if is_opened {
                let first = f[..columns].to_vec();
                f.splice(..0, first);
            }
            if is_closed {
                f.extend_from_within(f.len() - columns..);
            }
            f
        };
        let channels = (0..channels).map(channel).collect();
        if is_opened {
            theta_rad.insert(0, 0.0);
        }
        if is_closed {
            theta_rad.push(FRAC_PI_2);
        }
        Rows { grid: ExitGrid { theta_rad, phi_rad, symmetry }, channels }
    }
}

/// The azimuths of exits off the normal, ascending; 0 where there are none.
fn azimuths<const N: usize>(exits: &[Exit<N>]) -> Vec<Key> {
    let tilted = exits.iter().filter(|exit| exit.theta != 0);
    let mut phis: Vec<Key> = tilted.map(|exit| exit.phi).collect();
    phis.sort_unstable();
    phis.dedup();
    if phis.is_empty() {
        phis.push(0);
    }
    phis
}

/// f at a grid of exit directions.
struct Rows {
    grid: ExitGrid,
    /// Of each channel all azimuths of the first polar angle, then of the next.
    channels: Vec<Vec<f64>>,
}

impl Rows {
    /// The same with f linear in between at narrower polar angles, as many directions as there may
    /// be: a lobe is linear in f times the cosine.
    fn refined(self, most: usize) -> Self {
        let Self { grid, channels } = self;
        let columns = grid.phi_rad.len();
        let parts =
            |pair: &[f64], widest_rad: f64| ((pair[1] - pair[0]) / widest_rad).ceil().max(1.0);
        let count = |widest_rad: f64| -> f64 {
            grid.theta_rad.windows(2).map(|pair| parts(pair, widest_rad)).sum()
        };
        let fits = |widest_rad: &f64| count(*widest_rad) * columns as f64 <= most as f64;
        let Some(widest_rad) = WIDEST_RAD.into_iter().find(fits) else {
            return Self { grid, channels };
        };
        let places = grid.theta_rad.windows(2).enumerate().flat_map(|(row, pair)| {
            let parts = parts(pair, widest_rad);
            (0..parts as u32).map(move |part| (row, f64::from(part) / parts))
        });
        let between =
            |row: usize, t: f64| (1.0 - t) * grid.theta_rad[row] + t * grid.theta_rad[row + 1];
        let mut theta_rad: Vec<f64> = places.clone().map(|(row, t)| between(row, t)).collect();
        theta_rad.extend(grid.theta_rad.last());
        let finer = |f: Vec<f64>| {
            let mut finer = Vec::with_capacity(theta_rad.len() * columns);
            for (row, t) in places.clone() {
                let [above, below] = [row, row + 1].map(|row| &f[row * columns..][..columns]);
                finer.extend(above.iter().zip(below).map(|(a, b)| (1.0 - t) * a + t * b));
            }
            finer.extend_from_slice(&f[f.len() - columns..]);
            finer
        };
        let channels = channels.into_iter().map(finer).collect();
        Self { grid: ExitGrid { theta_rad, ..grid }, channels }
    }
}
