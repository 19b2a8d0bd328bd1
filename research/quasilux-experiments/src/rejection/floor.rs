//! The floor: a grid of cells, what they get exactly, and the photons that hit them.

use glam::DVec3;
use quasilux_photometry::Photometry;

/// Below the luminaire.
const HEIGHT_M: f64 = 3.0;
/// Of the square floor, which is centred below the luminaire.
const SIDE_M: f64 = 8.0;
/// Along each side.
const CELLS: usize = 16;
/// Of each cell along each side, for the exact means: with five nodes each their error is below
/// 10^-5, for the table has kinks.
const PARTS: usize = 64;
/// Gauss-Legendre on [-1, 1], five nodes and their weights over two.
const NODES: [(f64, f64); 5] = [
    (0.0, 64.0 / 225.0),
    (0.538_469_310_105_683, 0.239_314_335_249_683_2),
    (-0.538_469_310_105_683, 0.239_314_335_249_683_2),
    (0.906_179_845_938_664, 0.118_463_442_528_094_5),
    (-0.906_179_845_938_664, 0.118_463_442_528_094_5),
];

/// The floor and its exact illuminances.
pub(super) struct Floor {
    flux_lm: f64,
    /// Mean illuminance of each cell, row by row.
    cells_lx: Vec<f64>,
    pub(super) mean_lx: f64,
}

/// Photons counted on the floor.
pub(super) struct Hits<'f> {
    floor: &'f Floor,
    counts: Vec<u64>,
}

impl Floor {
    /// Integrates `I cos^3 gamma / h^2` over each cell.
    pub(super) fn under(luminaire: &Photometry) -> Self {
        let cells_lx: Vec<f64> = (0..CELLS * CELLS)
            .map(|cell| mean_lx(luminaire, cell % CELLS, cell / CELLS, PARTS))
            .collect();
        let mean_lx = cells_lx.iter().sum::<f64>() / cells_lx.len() as f64;
        Self { flux_lm: luminaire.flux_lm(), cells_lx, mean_lx }
    }

    pub(super) fn hits(&self) -> Hits<'_> {
        Hits { floor: self, counts: vec![0; CELLS * CELLS] }
    }

    /// The floor in words.
    pub(super) fn description(&self) -> String {
        format!(
            "{CELLS} x {CELLS} cells of a floor of {SIDE_M} m x {SIDE_M} m from {HEIGHT_M} m above"
        )
    }
}

impl Hits<'_> {
    /// A photon that leaves the luminaire along a direction of its frame.
    pub(super) fn record(&mut self, direction: DVec3) {
        let (x_m, y_m) =
            (direction.x / -direction.z * HEIGHT_M, direction.y / -direction.z * HEIGHT_M);
        if let (true, Some(column), Some(row)) = (direction.z < 0.0, cell(x_m), cell(y_m)) {
            self.counts[row * CELLS + column] += 1;
        }
    }

    /// After `photons` photons: mean over the cells of the squared error of their illuminance, in
    /// units of the floor's mean.
    pub(super) fn mean_square_error(&self, photons: u64) -> f64 {
        let photon_lx = self.floor.flux_lm / photons as f64 / (cell_side_m() * cell_side_m());
        let square = |(count, exact_lx): (&u64, &f64)| {
            let error = (*count as f64 * photon_lx - exact_lx) / self.floor.mean_lx;
            error * error
        };
        let sum: f64 = self.counts.iter().zip(&self.floor.cells_lx).map(square).sum();
        sum / self.counts.len() as f64
    }
}

fn cell_side_m() -> f64 {
    SIDE_M / CELLS as f64
}

/// The column or row of a place on the floor, if it is on it.
fn cell(at_m: f64) -> Option<usize> {
    let cells = (at_m + 0.5 * SIDE_M) / cell_side_m();
    (cells >= 0.0 && cells < CELLS as f64).then_some(cells as usize)
}

fn mean_lx(luminaire: &Photometry, column: usize, row: usize, parts: usize) -> f64 {
    let part_m = cell_side_m() / parts as f64;
    let nodes = |index: usize| {
        let start_m = index as f64 * cell_side_m() - 0.5 * SIDE_M;
        (0..parts).flat_map(move |part| {
            NODES.map(|(node, weight)| {
                (start_m + (part as f64 + 0.5 + 0.5 * node) * part_m, weight / parts as f64)
            })
        })
    };
    let rows = nodes(row).map(|(y_m, weight_y)| {
        let row =
            nodes(column).map(|(x_m, weight_x)| weight_x * illuminance_lx(luminaire, x_m, y_m));
        weight_y * row.sum::<f64>()
    });
    rows.sum()
}

fn illuminance_lx(luminaire: &Photometry, x_m: f64, y_m: f64) -> f64 {
    let to_floor = DVec3::new(x_m, y_m, -HEIGHT_M);
    let distance_m = to_floor.length();
    luminaire.intensity_cd(to_floor / distance_m) * HEIGHT_M
        / (distance_m * distance_m * distance_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batwing::Luminaire;

    #[test]
    fn exact_means_are_exact_enough() {
        let luminaire = Luminaire::batwing().photometry;
        for (column, row) in [(0, 0), (8, 8), (3, 12), (15, 7)] {
            let (fine, finer) = (
                mean_lx(&luminaire, column, row, PARTS),
                mean_lx(&luminaire, column, row, 3 * PARTS),
            );
            assert!((fine / finer - 1.0).abs() < 1e-5, "{column} {row}: {fine} {finer}");
        }
    }

    #[test]
    fn all_light_of_a_wide_floor_is_found() {
        let luminaire = Luminaire::batwing().photometry;
        let floor = Floor::under(&luminaire);
        let on_floor_lm = floor.mean_lx * SIDE_M * SIDE_M;
        assert!(on_floor_lm > 0.5 * floor.flux_lm && on_floor_lm < floor.flux_lm);
    }
}
