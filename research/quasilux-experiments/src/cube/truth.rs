//! What the walls show, by solving the integral equation of the cube.
//!
//! In units of half a side, all walls having the same illuminance E(x, y) = E(|x|, |y|) = E(y, x):
//!
//! ```text
//! E(P) = I / h^2 (1 + x^2 + y^2)^(-3/2) + rho * integral of K(P, Q) E(Q) dQ
//! ```
//!
//! with K the cosines over pi and the squared distance. It is solved by collocation (K. E.
//! Atkinson, The Numerical Solution of Integral Equations of the Second Kind, 1997): E is the
//! polynomial through its values at Chebyshev points in a variable t with `1 - |x| = (1 - t)^3`,
//! for toward an edge E grows like the 0.69th power of the distance. For the opposite wall K is
//! smooth. For one that meets P's at distance d, in height z and direction y along the edge, `r^2 =
//! d^2 + z^2` and `y = v + r tan(alpha)` make it
//!
//! ```text
//! K dQ = cos^2(alpha) dalpha / pi * d z / r^3 dz
//! ```
//!
//! which is smooth in alpha, and in z on intervals that double. Results are good to about 1e-5.

use super::scene::{HALF_M, INTENSITY_CD, REFLECTANCE};
use std::f64::consts::PI;

/// Collocation points along half a side.
const NODES: usize = 16;
/// Nodes of each quadrature.
const RULE: usize = 12;
/// Times that light is reflected in the solution: what is left out is 1e-14 of it.
const BOUNCES: u32 = 80;

/// E at all places of a wall.
pub(super) struct Truth {
    interpolation: Interpolation,
    rule: Vec<Node>,
    /// In lx at collocation point (i, j), at `i * NODES + j`.
    values_lx: Vec<f64>,
}

/// A node and its weight.
#[derive(Clone, Copy)]
struct Node {
    at: f64,
    weight: f64,
}

/// Polynomials in t through [`NODES`] points, by the barycentric formula (J.-P. Berrut and L. N.
/// Trefethen, SIAM Review 46, 2004).
struct Interpolation {
    t: Vec<f64>,
    weights: Vec<f64>,
}

impl Truth {
    /// Solves the equation.
    pub(super) fn solve() -> Self {
        let (interpolation, rule) = (Interpolation::new(), gauss_legendre(RULE));
        let mut truth = Self { interpolation, rule, values_lx: Vec::new() };
        let places = truth.interpolation.places();
        let at = |k: usize| [places[k / NODES], places[k % NODES]];
        let upper = (0..NODES * NODES).filter(|k| k / NODES <= k % NODES);
        let rows: Vec<(usize, Vec<f64>)> =
            upper.map(|k| (k, truth.reflected_weights(at(k)))).collect();
        let direct: Vec<f64> = (0..NODES * NODES).map(|k| direct_lx(at(k))).collect();
        let mut values = direct.clone();
        for _ in 0..BOUNCES {
            let mut next = values.clone();
            for (k, row) in &rows {
                let value = direct[*k] + REFLECTANCE * dot(row, &values);
                next[*k] = value;
                next[k % NODES * NODES + k / NODES] = value;
            }
            values = next;
        }
        truth.values_lx = values;
        truth
    }

    /// Illuminance in lx at a place of a wall, in units of half a side, off the edges.
    pub(super) fn illuminance_lx(&self, at: [f64; 2]) -> f64 {
        direct_lx(at) + REFLECTANCE * dot(&self.reflected_weights(at), &self.values_lx)
    }

    /// What the collocation points contribute to the integral of K E at a place.
    fn reflected_weights(&self, [x, y]: [f64; 2]) -> Vec<f64> {
        let mut weights = vec![0.0; NODES * NODES];
        self.add_opposite([x, y], &mut weights);
        for [u, v] in [[x, y], [-x, y], [y, x], [-y, x]] {
            self.add_adjacent(1.0 - u, v, &mut weights);
        }
        weights
    }

    fn add_opposite(&self, [x, y]: [f64; 2], weights: &mut [f64]) {
        let half: Vec<Node> = graded(&self.rule, [0.0, 1.0]).collect();
        let side = || half.iter().flat_map(|node| [1.0, -1.0].map(|sign| (sign * node.at, *node)));
        for (qx, node_x) in side() {
            let mut along = vec![0.0; NODES];
            for (qy, node_y) in side() {
                let squared = 4.0 + (qx - x) * (qx - x) + (qy - y) * (qy - y);
                let kernel = 4.0 / (PI * squared * squared);
                self.interpolation.add(qy, kernel * node_y.weight, &mut along);
            }
            self.add_product(qx, node_x.weight, &along, weights);
        }
    }

    /// The wall whose edge is at the distance `d` from the place, which is at `v` along the edge.
    fn add_adjacent(&self, d: f64, v: f64, weights: &mut [f64]) {
        for height in heights(&self.rule, d) {
            let z = height.at;
            let r = libm::hypot(d, z);
            let mut along = vec![0.0; NODES];
            let angle = |y: f64| libm::atan((y - v) / r);
            // Between the foot of the place, the middle and the ends.
            let mut cuts = [-1.0, v, 0.0, 1.0];
            cuts.sort_by(f64::total_cmp);
            for pair in cuts.windows(2) {
                let mut ends = [pair[0], pair[1]].map(angle);
                if pair[1] <= 0.0 {
                    ends.reverse();
                }
                for node in graded(&self.rule, ends) {
                    let cosine = libm::cos(node.at);
                    let y = v + r * libm::tan(node.at);
                    let weight = node.weight.abs() * cosine * cosine / PI;
                    self.interpolation.add(y, weight, &mut along);
                }
            }
            self.add_product(z - 1.0, height.weight * d * z / (r * r * r), &along, weights);
        }
    }

    fn add_product(&self, x: f64, weight: f64, along: &[f64], weights: &mut [f64]) {
        let mut across = vec![0.0; NODES];
        self.interpolation.add(x, weight, &mut across);
        for (i, a) in across.iter().enumerate() {
            for (b, sum) in along.iter().zip(&mut weights[i * NODES..]) {
                *sum += a * b;
            }
        }
    }
}

impl Interpolation {
    fn new() -> Self {
        let angle = |k: usize| PI * (k as f64 + 0.5) / NODES as f64;
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        Self {
            t: (0..NODES).map(|k| 0.5 - 0.5 * libm::cos(angle(k))).collect(),
            weights: (0..NODES).map(|k| sign(k) * libm::sin(angle(k))).collect(),
        }
    }

    /// The collocation points as x.
    fn places(&self) -> Vec<f64> {
        self.t.iter().map(|t| 1.0 - (1.0 - t) * (1.0 - t) * (1.0 - t)).collect()
    }

    /// Adds `factor` times what each of the values counts at x.
    fn add(&self, x: f64, factor: f64, to: &mut [f64]) {
        let t = 1.0 - libm::cbrt((1.0 - x.abs()).max(0.0));
        let mut terms = [0.0; NODES];
        for ((term, node), weight) in terms.iter_mut().zip(&self.t).zip(&self.weights) {
            let distance = t - node;
            *term = weight / if distance == 0.0 { f64::MIN_POSITIVE } else { distance };
        }
        let scale = factor / terms.iter().sum::<f64>();
        for (sum, term) in to.iter_mut().zip(terms) {
            *sum += scale * term;
        }
    }
}

/// Straight from the light.
fn direct_lx([x, y]: [f64; 2]) -> f64 {
    let squared = 1.0 + x * x + y * y;
    INTENSITY_CD / (HALF_M * HALF_M) / (squared * squared.sqrt())
}

/// Nodes in height above the edge, from 0 to 2: as fine as `d` at first, on intervals that double
/// then.
fn heights(rule: &[Node], d: f64) -> Vec<Node> {
    let mut low = d.min(1.0);
    let mut nodes: Vec<Node> = graded(rule, [low, 0.0]).collect();
    for node in &mut nodes {
        node.weight = node.weight.abs();
    }
    while low < 1.0 {
        let high = (2.0 * low).min(1.0);
        let within = |node: &Node| Node {
            at: low + (high - low) * node.at,
            weight: (high - low) * node.weight,
        };
        nodes.extend(rule.iter().map(within));
        low = high;
    }
    nodes.extend(graded(rule, [1.0, 2.0]));
    nodes
}

/// Nodes from one end to the other, dense toward the second, where E is not smooth.
fn graded(rule: &[Node], [first, second]: [f64; 2]) -> impl Iterator<Item = Node> {
    rule.iter().map(move |node| {
        let rest = 1.0 - node.at;
        let at = first + (second - first) * (1.0 - rest * rest * rest);
        Node { at, weight: 3.0 * rest * rest * (second - first) * node.weight }
    })
}

/// The rule of Gauss and Legendre on [0, 1], by Newton's method.
fn gauss_legendre(nodes: usize) -> Vec<Node> {
    let n = nodes as f64;
    let node = |k: usize| {
        let mut x = libm::cos(PI * (k as f64 + 0.75) / (n + 0.5));
        let mut slope = 1.0;
        for _ in 0..50 {
            let (mut before, mut value) = (1.0, x);
            for degree in 2..=nodes {
                let m = degree as f64;
                (before, value) = (value, ((2.0 * m - 1.0) * x * value - (m - 1.0) * before) / m);
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        Node { at: 0.5 - 0.5 * x, weight: 1.0 / ((1.0 - x * x) * slope * slope) }
    };
    (0..nodes).map(node).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The walls enclose every place: what they contribute to a wall of illuminance 1 is 1.
    #[test]
    fn walls_enclose_all_places() {
        let truth = Truth::solve();
        for at in [[0.0, 0.0], [0.3, -0.7], [1.0 - 1e-9, 0.5], [1.0 - 1e-6, 1.0 - 1e-6]] {
            let sum: f64 = truth.reflected_weights(at).iter().sum();
            assert!((sum - 1.0).abs() < 1e-7, "{at:?}: {sum}");
        }
    }

    /// All light is absorbed in the end: the mean is the flux over the area over 1 - reflectance,
    /// and what E is at the nodes of the rule says so.
    #[test]
    fn the_mean_is_that_of_the_energy_balance() {
        let truth = Truth::solve();
        let nodes: Vec<Node> = graded(&truth.rule, [0.0, 1.0]).collect();
        let sum = nodes.iter().flat_map(|x| {
            nodes.iter().map(|y| x.weight * y.weight * truth.illuminance_lx([x.at, y.at]))
        });
        let mean_lx: f64 = sum.sum();
        let area_m2 = 24.0 * HALF_M * HALF_M;
        let wanted = 4.0 * PI * INTENSITY_CD / (area_m2 * (1.0 - REFLECTANCE));
        assert!((mean_lx / wanted - 1.0).abs() < 5e-6, "{mean_lx}, wanted {wanted}");
    }
}
