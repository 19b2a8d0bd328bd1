//! Path guiding for photons: a binary tree over the unit square that directions are drawn from, by
//! importance.
//!
//! From a lit wall to the far end of a corridor lead few directions, and whole photons that take
//! them carry far more than the end is due. A photon's direction is made from a point of the unit
//! square; a density over the square, learnt from the survey's rays and their importance where they
//! landed, makes such points more frequent, and weights as much less (importance sampling of the
//! directions, as in J. Vorba et al., "On-line learning of parametric mixture models for light
//! transport simulation", ACM Trans. Graph. 33(4), 2014). The square is halved again and again
//! where much importance is, in the manner of T. Mueller, M. Gross and J. Novak, "Practical path
//! guiding for efficient light-transport simulation", Comput. Graph. Forum 36(4), 2017, and the
//! density is constant in what is not halved: the end of a corridor fills less than a thousandth of
//! what its walls see, at a grazing angle.

use crate::codec::Writer;
use std::collections::VecDeque;

/// A region is halved if it holds more than one part in this number of all importance,
const PARTS: f64 = 128.0;
/// and at least this number of rays.
const MIN_RAYS: usize = 8;
/// Halvings, half of them along each edge.
const MAX_HALVINGS: u32 = 24;
/// No guide halves more regions.
pub(crate) const MAX_NODES: usize = 128;
const _: () = assert!(MAX_NODES <= 1 << u8::BITS, "nodes are numbered in a byte");
/// Denominator of shares of points.
const WHOLE: f64 = 65_536.0;
/// Share of the points that are left even, so that no weight grows more than its inverse.
const EVEN: f64 = 0.3;

/// A density over the unit square.
#[derive(Clone, Debug)]
pub(crate) struct GuidingTree {
    /// The regions that are halved, the whole square first: halved along the first edge, its halves
    /// along the second, and so on. Empty where all points are alike.
    nodes: Vec<Node>,
}

/// A region that is halved, small: photons ask guides of all cells in turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// Share of its points in the half where the coordinate is low, in parts of [`WHOLE`].
    low_share: u16,
    /// The halves, where they are halved too; 0 where not.
    halves: [u8; 2],
}

/// A point of the square, drawn by a guide.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guided {
    pub(crate) u: [f64; 2],
    /// With respect to the area of the square.
    pub(crate) density: f64,
}

/// Part of an edge of the square that is left, and a point of it.
#[derive(Clone, Copy)]
struct Stretch {
    corner: f64,
    size: f64,
    /// From 0 to 1 along it.
    u: f64,
}

/// A ray through a point of the square.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GuidingSample {
    /// Binary digits of both coordinates in turn, those of the first first: rays of a region follow
    /// each other.
    digits: u32,
    importance: f64,
}

/// A region that may be halved.
struct Region {
    /// The node that it is a half of, and which one.
    of: Option<(usize, usize)>,
    halvings: u32,
    /// Its rays.
    from: usize,
    to: usize,
}

impl GuidingSample {
    pub(crate) fn new(u: [f64; 2], importance: f64) -> Self {
        Self { digits: digits(u), importance }
    }
}

impl GuidingTree {
    /// By rays and their importance.
    pub(crate) fn new(mut samples: Vec<GuidingSample>) -> Self {
        samples.sort_unstable_by_key(|sample| sample.digits);
        let mut sums = vec![0.0];
        for sample in &samples {
            sums.push(sums[sums.len() - 1] + sample.importance);
        }
        let total = sums[samples.len()];
        let mut nodes: Vec<Node> = Vec::new();
        let mut open =
            VecDeque::from([Region { of: None, halvings: 0, from: 0, to: samples.len() }]);
        while let Some(Region { of, halvings, from, to }) = open.pop_front() {
            let is_halved = to - from >= MIN_RAYS
                && (sums[to] - sums[from]) * PARTS > total
                && halvings < MAX_HALVINGS
                && nodes.len() < MAX_NODES;
            if !is_halved {
                continue;
            }
            let is_low = |sample: &GuidingSample| sample.digits << halvings >> (u32::BITS - 1) == 0;
            let middle = from + samples[from..to].partition_point(is_low);
            // In proportion to the worths, but for an even share.
            let area = libm::ldexp(1.0, -1 - halvings as i32);
            let share = |from: usize, to: usize| {
                (1.0 - EVEN) * (sums[to] - sums[from]) / total + EVEN * area
            };
            let [low, high] = [share(from, middle), share(middle, to)];
            let number = nodes.len();
            if let Some((node, half)) = of {
                nodes[node].halves[half] = number as u8;
            }
            nodes.push(Node::new(low / (low + high)));
            for (half, (from, to)) in [(from, middle), (middle, to)].into_iter().enumerate() {
                let of = Some((number, half));
                open.push_back(Region { of, halvings: halvings + 1, from, to });
            }
        }
        Self { nodes }
    }

    /// All points alike.
    pub(crate) fn even() -> Self {
        Self { nodes: Vec::new() }
    }

    /// Puts it among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        for Node { low_share, halves } in &self.nodes {
            out.value(&u32::from(*low_share));
            halves.iter().for_each(|half| out.value(half));
        }
    }

    /// The point that an even point of the square becomes.
    pub(crate) fn sample(&self, u: [f64; 2]) -> Guided {
        // The edge that is halved next, then the other.
        let [mut this, mut other] = u.map(|u| Stretch { corner: 0.0, size: 1.0, u });
        let (mut density, mut is_first) = (1.0, true);
        let mut next = self.nodes.first();
        while let Some(node) = next {
            let low_share = node.low_share();
            let is_high = this.u >= low_share;
            let (start, share) =
                if is_high { (low_share, 1.0 - low_share) } else { (0.0, low_share) };
            let size = 0.5 * this.size;
            let corner = if is_high { this.corner + size } else { this.corner };
            (this, other) = (other, Stretch { corner, size, u: (this.u - start) / share });
            density *= 2.0 * share;
            is_first = !is_first;
            next = self.half(node, usize::from(is_high));
        }
        let most = 1.0 - f64::EPSILON / 2.0;
        let at = |stretch: Stretch| (stretch.corner + stretch.size * stretch.u).min(most);
        let [first, second] = if is_first { [this, other] } else { [other, this] };
        Guided { u: [at(first), at(second)], density }
    }

    /// Density with respect to the area of the square.
    pub(crate) fn density(&self, u: [f64; 2]) -> f64 {
        let mut digits = digits(u);
        let mut density = 1.0;
        let mut next = self.nodes.first();
        while let Some(node) = next {
            let half = (digits >> (u32::BITS - 1)) as usize;
            let low_share = node.low_share();
            density *= 2.0 * if half == 0 { low_share } else { 1.0 - low_share };
            next = self.half(node, half);
            digits <<= 1;
        }
        density
    }

    fn half(&self, node: &Node, half: usize) -> Option<&Node> {
        let number = usize::from(node.halves[half]);
        if number > 0 { self.nodes.get(number) } else { None }
    }
}

impl Node {
    /// Neither half without points; the share of the rarer is rounded up, so that weights hardly
    /// grow by it.
    fn new(low_share: f64) -> Self {
        let parts = low_share * WHOLE;
        let parts = if low_share < 0.5 { parts.ceil() } else { parts.floor() };
        Self { low_share: parts.clamp(1.0, WHOLE - 1.0) as u16, halves: [0; 2] }
    }

    fn low_share(self) -> f64 {
        f64::from(self.low_share) / WHOLE
    }
}

fn digits(u: [f64; 2]) -> u32 {
    let [first, second] = u.map(|u| ((u * 65_536.0) as u32).min(65_535)).map(spread);
    first << 1 | second
}

/// Sixteen digits with a zero before each.
fn spread(digits: u32) -> u32 {
    let mut x = digits;
    x = (x | x << 8) & 0x00ff_00ff;
    x = (x | x << 4) & 0x0f0f_0f0f;
    x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rays around three places, few of them of much importance.
    fn guide() -> GuidingTree {
        let mut samples = Vec::new();
        for i in 0..40 {
            let x = f64::from(i) / 40.0;
            samples.push(GuidingSample::new([0.3 + 0.1 * x, 0.9 - 0.2 * x], 5.0));
            samples.push(GuidingSample::new([0.31 + 0.001 * x, 0.1], 0.2));
            samples.push(GuidingSample::new([0.999, x], 1e-3));
        }
        GuidingTree::new(samples)
    }

    /// The density is the inverse of the Jacobian determinant, by differences inside a region.
    #[test]
    fn the_density_is_that_of_the_samples() {
        let (guide, step) = (guide(), 1e-9);
        let mut compared = 0;
        for i in 0..40 {
            for j in 0..40 {
                let u = [(f64::from(i) + 0.37) / 40.0, (f64::from(j) + 0.61) / 40.0];
                let at = guide.sample(u);
                assert!((guide.density(at.u) / at.density - 1.0).abs() < 1e-12, "{u:?}");
                assert!(at.density >= 0.99 * EVEN);
                let next = guide.sample([u[0] + step, u[1] + step]);
                if next.density == at.density {
                    let jacobian = (next.u[0] - at.u[0]) * (next.u[1] - at.u[1]) / (step * step);
                    assert!((jacobian * at.density - 1.0).abs() < 1e-4, "{u:?}");
                    compared += 1;
                }
            }
        }
        assert!(compared > 1500, "{compared}");
    }

    /// Samples cover the whole square: the mean reciprocal of their density is its area. They are
    /// much denser where importance is.
    #[test]
    fn much_goes_where_worth_is() {
        let guide = guide();
        let side = 512;
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
        let all = (0..side).flat_map(|i| (0..side).map(move |j| [middle(i), middle(j)]));
        let area = all.map(|u| 1.0 / guide.sample(u).density).sum::<f64>() / f64::from(side * side);
        assert!((area - 1.0).abs() < 0.01, "{area}");
        let [where_worth_is, elsewhere] = [[0.35, 0.8], [0.8, 0.3]].map(|u| guide.density(u));
        assert!(where_worth_is > 8.0 && elsewhere < 0.5, "{where_worth_is}, {elsewhere}");
    }

    #[test]
    fn nothing_learnt_leaves_points_where_they_are() {
        for guide in [GuidingTree::even(), GuidingTree::new(Vec::new())] {
            for u in [[0.0, 0.0], [0.3, 0.8], [0.999_999, 0.5]] {
                let guided = guide.sample(u);
                assert_eq!((guided.u, guided.density, guide.density(u)), (u, 1.0, 1.0));
            }
        }
    }
}
