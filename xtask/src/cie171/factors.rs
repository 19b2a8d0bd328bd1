//! How much of its view a point has of a flat polygon, in closed form: the references of diffuse
//! light.

pub(crate) type Point = [f64; 3];

/// The share of a point's illuminance that a polygon gives, of what a whole hemisphere of its
/// luminance would (configuration factor), where all of it stands above the point's horizon.
///
/// E = L / 2 times the sum over edges of the angle that the edge subtends times the cosine between
/// the normal and that of the edge's plane through the point (J. H. Lambert, Photometria, 1760);
/// the factor is E / (pi L).
pub(crate) fn configuration_factor(at: Point, normal: Point, corners: &[Point]) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let edge = |(a, b): (&Point, &Point)| {
        let (a, b) = (unit(minus(*a, at)), unit(minus(*b, at)));
        let across = cross(a, b);
        let sine = length(across);
        if sine == 0.0 { 0.0 } else { libm::atan2(sine, dot(a, b)) * dot(normal, across) / sine }
    };
    (edges.map(edge).sum::<f64>() / std::f64::consts::TAU).abs()
}

/// The part of a sphere that a rectangle hides from a point at `distance` in front of its middle,
/// in sr: 4 atan(a b / (d sqrt(a^2 + b^2 + d^2))) with half edges a and b.
pub(crate) fn solid_angle_sr([a, b]: [f64; 2], distance: f64) -> f64 {
    4.0 * libm::atan(a * b / (distance * libm::sqrt(a * a + b * b + distance * distance)))
}

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn length(a: Point) -> f64 {
    libm::sqrt(dot(a, a))
}

fn unit(a: Point) -> Point {
    let length = length(a);
    a.map(|x| x / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The midpoint rule on 500 x 500 cells of cos cos / (pi d^2); its error is below 1e-5 here.
    #[test]
    fn the_closed_form_is_the_integral() {
        let (corner, u, v) = ([1.0, 2.0, 3.0], [2.0, 0.0, 0.0], [0.0, 1.5, 0.0]);
        let (at, normal) = ([0.5, 1.0, 0.2], unit([0.1, 0.2, 1.0]));
        let along = |s: f64, t: f64| [0, 1, 2].map(|k| corner[k] + s * u[k] + t * v[k]);
        let corners = [along(0.0, 0.0), along(1.0, 0.0), along(1.0, 1.0), along(0.0, 1.0)];
        let cells = 500;
        let place = |k: usize| (k as f64 + 0.5) / cells as f64;
        let mut sum = 0.0;
        for (i, j) in (0..cells).flat_map(|i| (0..cells).map(move |j| (i, j))) {
            let d = minus(along(place(i), place(j)), at);
            let squared = dot(d, d);
            sum += dot(normal, d) * d[2] / (squared * squared);
        }
        let quadrature = sum * 3.0 / (cells * cells) as f64 / std::f64::consts::PI;
        let closed = configuration_factor(at, normal, &corners);
        assert!((closed / quadrature - 1.0).abs() < 1e-5, "{closed} {quadrature}");
    }

    /// The six faces of a box hide all of the sphere from its middle.
    #[test]
    fn solid_angles_of_a_box_make_a_sphere() {
        let half = [2.0, 1.5, 0.7];
        let pair = |a: usize, b: usize, d: usize| 2.0 * solid_angle_sr([half[a], half[b]], half[d]);
        let sum = pair(0, 1, 2) + pair(1, 2, 0) + pair(2, 0, 1);
        assert!((sum / (4.0 * std::f64::consts::PI) - 1.0).abs() < 1e-14, "{sum}");
    }
}
