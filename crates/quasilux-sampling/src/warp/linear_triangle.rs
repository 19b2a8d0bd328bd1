//! Triangles with a density that is linear across them.
//!
//! The weight of the first corner is drawn from its marginal, a cubic that a safeguarded Newton
//! iteration inverts; the place on the segment that is left has a linear density, inverted by a
//! quadratic in the form that does not cancel. Where the density is constant, the marginal is that
//! of the uniform triangle by square root.

use crate::unit::clamp_to_unit;

/// Newton steps and halvings; each step of either kind narrows the bracket, most need five.
const MAX_STEPS: usize = 64;

/// Barycentric coordinates of a point whose density is proportional to the linear function with
/// these values at the corners: none negative, not all 0.
///
/// ```
/// use quasilux_sampling::warp::sample_linear_triangle;
/// // All of the density lies near the last corner.
/// let [.., last] = sample_linear_triangle([0.0, 0.0, 1.0], [0.5, 0.5]);
/// assert!(last > 0.5);
/// ```
#[must_use]
pub fn sample_linear_triangle(corners: [f64; 3], u: [f64; 2]) -> [f64; 3] {
    let [first, opposite] = marginal(corners);
    // The share of the opposite edge: 3 l0 s^2 + 2 (q - l0) s^3 = (1 - u) (l0 + 2 q).
    let wanted = (1.0 - u[0]) * (first + 2.0 * opposite);
    let excess = |s: f64| s * s * (3.0 * first + 2.0 * (opposite - first) * s) - wanted;
    let slope = |s: f64| 6.0 * s * (first * (1.0 - s) + opposite * s);
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = (1.0 - u[0]).max(0.0).sqrt();
    for _ in 0..MAX_STEPS {
        let value = excess(s);
        if value > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let newton = s - value / slope(s);
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - s).abs() <= f64::EPSILON * s {
            break;
        }
        s = next;
    }
    let [a, b] = segment(corners, s);
    let root = (a * a + u[1] * (b * b - a * a)).max(0.0).sqrt();
    let along = if a + root > 0.0 { u[1] * (a + b) / (a + root) } else { u[1] };
    [1.0 - s, (s * (1.0 - along)).max(0.0), s * along]
}

/// Density of [`sample_linear_triangle`] with respect to area (m^-2), for a triangle of `area_m2`.
#[must_use]
pub fn pdf_linear_triangle(corners: [f64; 3], area_m2: f64, barycentric: [f64; 3]) -> f64 {
    let value: f64 = corners.iter().zip(barycentric).map(|(corner, share)| corner * share).sum();
    3.0 * value / (corners.iter().sum::<f64>() * area_m2)
}

/// The coordinates that [`sample_linear_triangle`] maps to `barycentric`.
#[must_use]
pub fn invert_linear_triangle(corners: [f64; 3], barycentric: [f64; 3]) -> [f64; 2] {
    let [first, opposite] = marginal(corners);
    let s = 1.0 - barycentric[0];
    let below = s * s * (3.0 * first + 2.0 * (opposite - first) * s) / (first + 2.0 * opposite);
    let along = if s > 0.0 { barycentric[2] / s } else { 0.0 };
    let [a, b] = segment(corners, s);
    let share = if a + b > 0.0 { along * (2.0 * a + (b - a) * along) / (a + b) } else { along };
    [clamp_to_unit(1.0 - below), clamp_to_unit(share)]
}

/// The density at the first corner, and its mean over the opposite edge.
fn marginal([a, b, c]: [f64; 3]) -> [f64; 2] {
    [a, 0.5 * (b + c)]
}

/// The density at the ends of the segment a share `s` of the way to the opposite edge.
fn segment([a, b, c]: [f64; 3], s: f64) -> [f64; 2] {
    [b, c].map(|end| a * (1.0 - s) + end * s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PointSet, Randomization, Sequence};
    use quasilux_stats::{CellCount, chi_square_test, jacobian_determinant};

    const CORNERS: [[f64; 3]; 6] = [
        [1.0, 1.0, 1.0],
        [3.0, 1.0, 0.5],
        [0.0, 1.0, 2.0],
        [1.0, 0.0, 0.0],
        [0.0, 0.0, 1.0],
        [1e-9, 1.0, 0.0],
    ];

    fn grid() -> impl Iterator<Item = [f64; 2]> {
        (0..121).map(|i| [i / 11, i % 11].map(|i| (f64::from(i) + 0.5) / 11.0))
    }

    /// In barycentric weights of the two last corners a triangle has an area of 1/2.
    #[test]
    fn the_density_is_the_inverse_of_the_stretch() {
        for corners in CORNERS {
            for u in grid() {
                let map = |u| {
                    let [_, b, c] = sample_linear_triangle(corners, u);
                    [b, c]
                };
                let stretch = jacobian_determinant(map, u, 1e-6).abs();
                let pdf = pdf_linear_triangle(corners, 0.5, sample_linear_triangle(corners, u));
                assert!((pdf * stretch - 1.0).abs() < 2e-4, "{corners:?} {u:?}: {}", pdf * stretch);
            }
        }
    }

    #[test]
    fn inversion_leads_back() {
        for corners in CORNERS {
            for u in grid() {
                let place = sample_linear_triangle(corners, u);
                assert!((place.iter().sum::<f64>() - 1.0).abs() < 1e-15);
                let back = invert_linear_triangle(corners, place);
                let error = (back[0] - u[0]).abs().max((back[1] - u[1]).abs());
                assert!(error < 1e-9, "{corners:?} {u:?}: {back:?}");
            }
        }
    }

    #[test]
    fn the_ends_of_the_square_stay_inside() {
        for corners in CORNERS {
            for u in [[0.0, 0.0], [0.0, crate::unit::ONE_BELOW], [crate::unit::ONE_BELOW, 0.0]] {
                let place = sample_linear_triangle(corners, u);
                assert!(place.iter().all(|w| (0.0..=1.0).contains(w)), "{corners:?} {u:?}");
            }
        }
    }

    /// Counts of 2^16 pseudo-random points (key 1) in the 64 equal parts of a triangle, family of
    /// six, each at 1e-4; a density that is wrong by 2 % at one corner is rejected.
    #[test]
    fn counts_follow_the_density() {
        let points = PointSet::new(Sequence::Independent, Randomization::None, 1);
        let samples = 1 << 16;
        let test = |corners: [f64; 3], claimed: [f64; 3], samples: u64| {
            let mut cells = [CellCount { observed: 0, expected: 0.0 }; 64];
            for (number, cell) in cells.iter_mut().enumerate() {
                let pdf = pdf_linear_triangle(claimed, 1.0, centre(number));
                cell.expected = pdf / 64.0 * samples as f64;
            }
            for index in 0..samples {
                let u = [0, 1].map(|dimension| points.coordinate(index, dimension));
                cells[part(sample_linear_triangle(corners, u))].observed += 1;
            }
            chi_square_test(&cells)
        };
        for corners in CORNERS {
            let p = test(corners, corners, samples);
            assert!(p > 1e-4, "{corners:?}: {p}");
        }
        let wrong = test(CORNERS[1], [3.0, 1.02, 0.5], 1 << 22);
        assert!(wrong < 1e-4, "{wrong}");
    }

    /// Rows along the second weight, standing and hanging parts taking turns.
    fn part([_, b, c]: [f64; 3]) -> usize {
        let (row, column) = ((8.0 * b) as usize, (8.0 * c) as usize);
        let hangs = 8.0 * b - row as f64 + (8.0 * c - column as f64) > 1.0;
        row * (16 - row) + 2 * column + usize::from(hangs)
    }

    fn centre(number: usize) -> [f64; 3] {
        let row = (0..8).rev().find(|row| row * (16 - row) <= number).unwrap();
        let rest = number - row * (16 - row);
        let inner = if rest % 2 == 1 { 2.0 / 3.0 } else { 1.0 / 3.0 };
        let [b, c] = [row, rest / 2].map(|i| (i as f64 + inner) / 8.0);
        [1.0 - b - c, b, c]
    }
}
