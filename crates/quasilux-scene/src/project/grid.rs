//! How many cells a grid has.
//!
//! Grid rule: EN 12464-1:2021, "illuminance grid": the largest cell size is p = 0.2 * 5^(log10 d)
//! metres, at most 10 m, where d is the longer edge of the area, or the shorter one when the edges
//! are as 2 to 1 or more. Deviation: the count along an edge is edge / p rounded up, so that no
//! cell is larger than p.

/// Largest cell size of EN 12464-1 in m.
const MAX_CELL_M: f64 = 10.0;

/// Rounding slack: an edge of 4.2 m holds 6 cells of 0.7 m, though their floating-point quotient
/// is a little above 6.
const SLACK: f64 = 1.0 - 1e-9;

/// The largest cell size in m of EN 12464-1 for a rectangle with these edges.
pub(super) fn en12464_cell_m(edges_m: [f64; 2]) -> f64 {
    let longer = edges_m[0].max(edges_m[1]);
    let shorter = edges_m[0].min(edges_m[1]);
    let d = if longer >= 2.0 * shorter { shorter } else { longer };
    (0.2 * libm::pow(5.0, libm::log10(d))).min(MAX_CELL_M)
}

/// The smallest number of equal cells along an edge that are no longer than `cell_m`; as a
/// floating-point number, for it may be beyond any integer.
pub(super) fn cells_along(edge_m: f64, cell_m: f64) -> f64 {
    (edge_m / cell_m * SLACK).ceil().max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotients_that_are_whole_stay_whole() {
        for (edge, cell, cells) in [
            (4.2, 0.7, 6.0),
            (0.7, 0.1, 7.0),
            (5.0, 0.25, 20.0),
            (5.1, 0.25, 21.0),
            (0.1, 3.0, 1.0),
        ] {
            assert_eq!(cells_along(edge, cell), cells, "{edge} / {cell}");
        }
    }

    #[test]
    fn cell_sizes_of_the_standard() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 5e-4, "{a} is not {b}");
        close(en12464_cell_m([1.0, 1.0]), 0.2);
        close(en12464_cell_m([10.0, 8.0]), 1.0);
        close(en12464_cell_m([6.0, 10.0]), 1.0);
        close(en12464_cell_m([100.0, 60.0]), 5.0);
        // 5^log10(5) = 3.0801: p = 0.616 m.
        close(en12464_cell_m([5.0, 4.0]), 0.616);
        // Twice as long as wide: the shorter edge counts.
        close(en12464_cell_m([20.0, 10.0]), 1.0);
        close(en12464_cell_m([1e6, 1e6]), 10.0);
    }
}
