//! Triangles that share corners, as a forest of disjoint sets with path halving.

use glam::DVec3;
use std::collections::BTreeMap;

/// For each triangle, the first of those that it hangs together with by equal corners.
#[must_use]
pub fn first_of_each(triangles: &[[DVec3; 3]]) -> Vec<usize> {
    let mut parents: Vec<usize> = (0..triangles.len()).collect();
    let mut at: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    for (triangle, corners) in triangles.iter().enumerate() {
        for corner in corners {
            // Adding zero makes one of both zeros.
            let place = (*corner + DVec3::ZERO).to_array().map(f64::to_bits);
            let other = *at.entry(place).or_insert(triangle);
            let [a, b] = [other, triangle].map(|triangle| root(&mut parents, triangle));
            parents[a.max(b)] = a.min(b);
        }
    }
    (0..triangles.len()).map(|triangle| root(&mut parents, triangle)).collect()
}

fn root(parents: &mut [usize], mut triangle: usize) -> usize {
    while parents[triangle] != triangle {
        parents[triangle] = parents[parents[triangle]];
        triangle = parents[triangle];
    }
    triangle
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The third meets the first at a zero of the other sign, the fourth the second.
    #[test]
    fn triangles_hang_together_by_equal_corners() {
        let corner = |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x, 1.0, 0.0)];
        let triangle = |x: f64, tip: f64| [corner(x)[0], corner(x)[1], DVec3::new(tip, 0.0, 0.0)];
        let triangles =
            [triangle(0.0, 0.5), triangle(2.0, 2.5), triangle(1.0, -0.0), triangle(3.0, 2.5)];
        assert_eq!(first_of_each(&triangles), [0, 1, 0, 1]);
    }
}
