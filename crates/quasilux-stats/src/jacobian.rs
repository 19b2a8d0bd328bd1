//! How much a map stretches: finite differences, for checking densities without random numbers.
//!
//! If `sample` maps uniform coordinates to a point with density `pdf`, then `pdf * |det J| = 1`.

/// The determinant of the Jacobian matrix of `f` at `u`, by central differences of half-width
/// `step`. The error is of order `step^2`, and of order `1e-16 / step` from rounding.
pub fn jacobian_determinant(f: impl Fn([f64; 2]) -> [f64; 2], u: [f64; 2], step: f64) -> f64 {
    let along = |axis| difference(|u| f(u).to_vec(), u, axis, step);
    let (a, b) = (along(0), along(1));
    a[0] * b[1] - a[1] * b[0]
}

/// Solid angle per unit square at `u` of a map to unit vectors: the length of the cross product of
/// both derivatives, by central differences of half-width `step`.
pub fn sphere_jacobian(f: impl Fn([f64; 2]) -> [f64; 3], u: [f64; 2], step: f64) -> f64 {
    let along = |axis| difference(|u| f(u).to_vec(), u, axis, step);
    let (a, b) = (along(0), along(1));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    cross.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn difference(f: impl Fn([f64; 2]) -> Vec<f64>, u: [f64; 2], axis: usize, step: f64) -> Vec<f64> {
    let at = |offset: f64| {
        let mut moved = u;
        moved[axis] += offset;
        f(moved)
    };
    at(step).iter().zip(at(-step)).map(|(high, low)| (high - low) / (2.0 * step)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_map_has_its_determinant() {
        let f = |[x, y]: [f64; 2]| [3.0 * x + y, x - 2.0 * y];
        assert!((jacobian_determinant(f, [0.3, 0.4], 1e-3) + 7.0).abs() < 1e-10);
    }

    #[test]
    fn the_uniform_sphere_has_four_pi() {
        let uniform = |[u, v]: [f64; 2]| {
            let (z, phi) = (1.0 - 2.0 * u, 2.0 * std::f64::consts::PI * v);
            let r = (1.0 - z * z).sqrt();
            [r * libm::cos(phi), r * libm::sin(phi), z]
        };
        let stretch = sphere_jacobian(uniform, [0.3, 0.4], 1e-4);
        assert!((stretch - 4.0 * std::f64::consts::PI).abs() < 1e-5);
    }
}
