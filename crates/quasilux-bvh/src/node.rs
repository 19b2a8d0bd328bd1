//! The memory layout of the hierarchy: eight-wide nodes and blocks of eight triangles.
//!
//! An inner node holds the boxes of up to eight children, a block up to eight triangles, both by
//! coordinate, so that one vector instruction sees all eight.

use crate::frame::H;
use glam::{DVec3, Vec3A};

/// Children of a node and triangles of a block.
pub(crate) const WIDTH: usize = 8;

/// Distance by which each box is grown, in the frame.
///
/// Take a hit at distance `t` and an axis along which the ray rises; the other direction and the
/// far planes are symmetric. With `d` and `o` direction and origin and `'` for what single
/// precision makes of them, the lower plane is met at `t_low = ((low - g) r - o' r (1 + e)) (1 +
/// e)`, `r = (1 + e) / d'`, each `|e| <= h`, and `low <= o + t d` up to the box's own rounding `h`.
/// So `t_low <= t` if `g >= h + t |d - d'| + |o - o'| + h |o'| + 2.1 h t d'`, and with the frame's
/// bounds the right side is at most `h (1 + 3.7 + 0.1 + 2.7 + 2.7 + 7.8) = 18 h`. Rounding the
/// grown plane takes another `h`.
///
/// A hit is what [`crate::intersect`] says, and its point of the ray is off that of the triangle by
/// up to `15 e D + 4 e S / f`, with `e = 2^-53`, `f = 2^-20`, corners at most `D = 2^20 + 1` from
/// the origin of a ray that starts as far away as one can, and at most `S = 2` from each other: `h
/// / 20`, however nearly edge-on the triangle is seen, for which there is room here and in
/// [`Slack::new`].
pub(crate) const GROWTH: f32 = 24.0 * H;

/// An inner node.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Node {
    /// Low and high planes of the children's boxes by axis: x low, x high, y low, ...
    /// Children that are not there have their low planes at plus and their high planes at minus
    /// infinity. Still they lead to a block, the first one, so that even a ray that is not a number
    /// comes to an end.
    pub(crate) planes: [[f32; WIDTH]; 6],
    pub(crate) children: [Child; WIDTH],
}

/// The index of a node, or of a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(transparent)]
pub(crate) struct Child(pub(crate) u32);

/// Up to eight triangles in single precision.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(32))]
pub(crate) struct Block {
    /// Which they are, [`NONE`] where there is none.
    pub(crate) triangles: [u32; WIDTH],
    /// First corner.
    pub(crate) corner: [[f32; WIDTH]; 3],
    /// First corner minus second.
    pub(crate) edge_1: [[f32; WIDTH]; 3],
    /// Third corner minus first.
    pub(crate) edge_2: [[f32; WIDTH]; 3],
    pub(crate) slack: Slack,
}

/// A triangle with corners in the frame's coordinates.
pub(crate) struct FramedTriangle {
    pub(crate) triangle: u32,
    pub(crate) corners: [DVec3; 3],
}

/// No triangle.
pub(crate) const NONE: u32 = u32::MAX;

/// How far the single-precision figures of a triangle can be from the truth; see
/// [`Slack::new`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[repr(C)]
pub(crate) struct Slack {
    /// Of the weights of the second and third corner.
    pub(crate) weight: f32,
    /// Of the weight of the first corner.
    pub(crate) rest: f32,
    /// Of the distance times the determinant.
    pub(crate) distance: f32,
}

impl Node {
    pub(crate) const EMPTY: Self = {
        let (low, high) = ([f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]);
        Self { planes: [low, high, low, high, low, high], children: [Child::block(0); WIDTH] }
    };

    /// Sets a child and its box, which is grown by what single precision may lose.
    pub(crate) fn set(&mut self, slot: usize, low: Vec3A, high: Vec3A, child: Child) {
        for axis in 0..3 {
            self.planes[2 * axis][slot] = low[axis] - GROWTH;
            self.planes[2 * axis + 1][slot] = high[axis] + GROWTH;
        }
        self.children[slot] = child;
    }
}

impl Child {
    const BLOCK: u32 = 1 << 31;
    const ENDS: u32 = 1 << 30;
    /// No child: all has been met.
    pub(crate) const DONE: Self = Self(Self::BLOCK | Self::ENDS);
    /// No child: there was no room.
    pub(crate) const OVERFLOWED: Self = Self(Self::BLOCK | Self::ENDS | 1);

    pub(crate) const fn node(index: usize) -> Self {
        Self(index as u32)
    }

    pub(crate) const fn block(index: usize) -> Self {
        Self(index as u32 | Self::BLOCK)
    }

    #[inline(always)]
    pub(crate) const fn is_block(self) -> bool {
        self.0 & Self::BLOCK != 0
    }

    #[inline(always)]
    pub(crate) const fn index(self) -> usize {
        (self.0 & !(Self::BLOCK | Self::ENDS)) as usize
    }
}

impl Block {
    /// A block of up to eight triangles.
    pub(crate) fn new(triangles: impl Iterator<Item = FramedTriangle>) -> Self {
        let mut block = Self {
            triangles: [NONE; WIDTH],
            corner: [[0.0; WIDTH]; 3],
            edge_1: [[0.0; WIDTH]; 3],
            edge_2: [[0.0; WIDTH]; 3],
            slack: Slack::default(),
        };
        for (lane, FramedTriangle { triangle, corners: [a, b, c] }) in triangles.enumerate() {
            let (edge_1, edge_2) = ((a - b).as_vec3a(), (c - a).as_vec3a());
            block.triangles[lane] = triangle;
            for axis in 0..3 {
                block.corner[axis][lane] = a[axis] as f32;
                block.edge_1[axis][lane] = edge_1[axis];
                block.edge_2[axis][lane] = edge_2[axis];
            }
            block.slack = block.slack.max(Slack::new(edge_1, edge_2));
        }
        block
    }
}

impl Slack {
    /// Bounds for a triangle with these edges.
    ///
    /// With first corner `v` and edges `e1` and `e2` as stored, `c = v - o`, `r = c x d` and `n =
    /// e2 x e1`, the ray meets the plane where the determinant `n.d` times distance, second and
    /// third weight are `n.c`, `e2.r` and `e1.r` (Möller and Trumbore 1997). Let `s` be the larger
    /// 1-norm of the edges and `q` the product of both, `q <= 6 s`. In each coordinate, in units of
    /// `h`: `c` is off by `1 + 2.7 + 3.7`, `r` by `sqrt 2 (7.4 + 3.7 + 7.4) < 26.2` and at most
    /// `5.3 / h`, so `e2.r` and `e1.r` by `(26.2 + 5.3 + 3 * 5.3) s < 48 s`. The terms of `n` sum
    /// to at most `q` and are off by `4` of themselves each, so `n.d` by `8 q`, `n.c` by
    /// `(7.4 + 4 * 3.7 + 3 * 3.7) q < 34 q`, and determinant minus both weights by
    /// `(2 * 48 + 8 * 6 + 2 * 17) s < 192 s`.
    ///
    /// Signs are those of the determinant. Where that comes out wrong the determinant is within
    /// `8 q` of zero, a hit's weights within `16 q` and its distance times the determinant within
    /// `7 * 16 q`; where it comes out right, a hit's distance in front of the `end <= 7` may fall
    /// `(34 + 7 * 8 + 14) q` behind it. The sums below cover both.
    pub(crate) fn new(edge_1: Vec3A, edge_2: Vec3A) -> Self {
        let [norm_1, norm_2] = [edge_1, edge_2].map(|e| e.abs().element_sum());
        let (s, q) = (norm_1.max(norm_2), norm_1 * norm_2);
        let [weight, rest] = [Self::WEIGHT, Self::REST].map(|[of_s, of_q]| of_s * s + of_q * q);
        Self {
            weight: weight + Self::UNDERFLOW,
            rest: rest + Self::UNDERFLOW,
            distance: Self::DISTANCE * q + Self::UNDERFLOW,
        }
    }

    /// The factors of `s` and `q` in the bound of the weights of second and third corner.
    pub(crate) const WEIGHT: [f32; 2] = [48.0 * H, 16.0 * H];
    /// The factors of `s` and `q` in the bound of the weight of the first corner.
    pub(crate) const REST: [f32; 2] = [192.0 * H, 48.0 * H];
    /// The factor of `q` in the bound of the distance.
    pub(crate) const DISTANCE: f32 = 256.0 * H;
    /// More than all that is lost where products underflow.
    pub(crate) const UNDERFLOW: f32 = 1e-36;
    /// The bound of the determinant, twice, by that of the distance.
    pub(crate) const TURN: f32 = 16.0 / 256.0;

    /// Of the determinant, twice.
    #[inline(always)]
    pub(crate) fn determinant(&self) -> f32 {
        self.distance * Self::TURN
    }

    fn max(self, other: Self) -> Self {
        Self {
            weight: self.weight.max(other.weight),
            rest: self.rest.max(other.rest),
            distance: self.distance.max(other.distance),
        }
    }
}
