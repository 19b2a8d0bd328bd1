//! Conservative tests of one ray against eight boxes (slabs) or triangles at a time.

use crate::frame::{FrameRay, H};
use crate::lanes::Lanes;
use crate::lanes::triple::{cross, dot, load, sub};
use crate::node::{Block, Node, Slack};

/// Distances between which a ray is inside each of eight boxes: it meets those where `near` is not
/// above `far`.
pub(crate) struct Crossing<L> {
    pub(crate) near: L,
    pub(crate) far: L,
}

/// A ray as boxes see it.
pub(crate) struct Slabs<L> {
    inverse: [L; 3],
    /// Origin times inverse direction.
    offset: [L; 3],
    /// Which of a node's planes come first along each axis, and which last.
    first: [usize; 3],
    last: [usize; 3],
}

impl<L: Lanes> Slabs<L> {
    #[inline(always)]
    pub(crate) fn new(ray: &FrameRay) -> Self {
        let (o, r) = (ray.origin.to_array(), ray.inverse.to_array());
        let below = [r[0] < 0.0, r[1] < 0.0, r[2] < 0.0].map(usize::from);
        Self {
            inverse: r.map(L::splat),
            offset: [L::splat(o[0] * r[0]), L::splat(o[1] * r[1]), L::splat(o[2] * r[2])],
            first: [below[0], 2 + below[1], 4 + below[2]],
            last: [1 - below[0], 3 - below[1], 5 - below[2]],
        }
    }

    /// Where the ray enters and leaves the children's boxes; those are met where it enters no
    /// later than it leaves.
    #[inline(always)]
    pub(crate) fn cross(&self, node: &Node, end: f32) -> Crossing<L> {
        let plane = |at: usize, axis: usize| {
            // SAFETY: `first` and `last` are numbers of planes.
            let planes = unsafe { node.planes.get_unchecked(at) };
            L::load(planes).mul_sub(self.inverse[axis], self.offset[axis])
        };
        let [x, y, z] = self.first;
        let near = plane(x, 0).max(plane(y, 1)).max(plane(z, 2).max(L::splat(0.0)));
        let [x, y, z] = self.last;
        let far = plane(x, 0).min(plane(y, 1)).min(plane(z, 2).min(L::splat(end)));
        Crossing { near, far }
    }
}

/// A ray as triangles see it.
pub(crate) struct RaySimd<L> {
    origin: [L; 3],
    direction: [L; 3],
}

impl<L: Lanes> RaySimd<L> {
    #[inline(always)]
    pub(crate) fn new(ray: &FrameRay) -> Self {
        Self {
            origin: [L::splat(ray.origin.x), L::splat(ray.origin.y), L::splat(ray.origin.z)],
            direction: [
                L::splat(ray.direction.x),
                L::splat(ray.direction.y),
                L::splat(ray.direction.z),
            ],
        }
    }

    /// [`Self::new`] of a ray in memory.
    #[inline(always)]
    pub(crate) fn from_memory(ray: &FrameRay) -> Self {
        let (origin, direction): (&[f32; 3], &[f32; 3]) =
            (ray.origin.as_ref(), ray.direction.as_ref());
        Self {
            origin: [0, 1, 2].map(|axis| L::splat_from(&origin[axis])),
            direction: [0, 1, 2].map(|axis| L::splat_from(&direction[axis])),
        }
    }

    /// Tests the triangles of a block, up to `end`.
    #[inline(always)]
    pub(crate) fn test<'a>(&self, block: &'a Block, end: f32) -> TriangleTest<'a, L> {
        let (edge_1, edge_2) = (load::<L>(&block.edge_1), load(&block.edge_2));
        let c = sub(load(&block.corner), self.origin);
        let r = cross(c, self.direction);
        let n = cross(edge_2, edge_1);
        let (second, third) = (dot(edge_2, r), dot(edge_1, r));
        TriangleTest::new(
            &block.slack,
            dot(n, self.direction),
            [second, third, dot(n, c)],
            L::splat(end),
        )
    }
}

/// Test of a ray against the triangles of a block, or of rays against a triangle, all times the
/// size of the determinant.
pub(crate) struct TriangleTest<'a, L> {
    slack: &'a Slack,
    /// The smaller of the weights of second and third corner.
    weights: L,
    /// The weight of the first corner.
    rest: L,
    /// The distance.
    reach: L,
    /// One.
    size: L,
    /// Length of the ray behind the hit.
    left: L,
}

impl<'a, L: Lanes> TriangleTest<'a, L> {
    /// A test of the determinant and, times that, of the weights of second and third corner and the
    /// distance.
    #[inline(always)]
    pub(crate) fn new(
        slack: &'a Slack,
        determinant: L,
        [second, third, reach]: [L; 3],
        end: L,
    ) -> Self {
        let size = determinant.flip_by(determinant);
        let (second, third) = (second.flip_by(determinant), third.flip_by(determinant));
        let reach = reach.flip_by(determinant);
        TriangleTest {
            slack,
            weights: second.min(third),
            rest: size.sub(second).sub(third),
            reach,
            size,
            left: size.mul_sub(end, reach),
        }
    }

    /// A bit for each triangle that the ray may hit.
    #[inline(always)]
    pub(crate) fn possible(&self) -> u32 {
        let slack = self.slack;
        let distance = L::splat(slack.distance);
        let any = [
            self.weights.add(L::splat(slack.weight)),
            self.rest.add(L::splat(slack.rest)),
            self.reach.add(distance),
            self.left.add(distance),
        ];
        !L::any_negative(any)
    }

    /// A bit for each triangle that the ray hits for sure, if it is there.
    #[inline(always)]
    pub(crate) fn sure(&self) -> u32 {
        let slack = self.slack;
        let distance = L::splat(slack.distance);
        let one = L::any_negative([
            self.weights.sub(L::splat(slack.weight)),
            self.rest.sub(L::splat(slack.rest)),
            self.reach.sub(distance),
            self.left.sub(distance),
        ]);
        !one & L::splat(slack.determinant()).at_most(self.size)
    }

    /// Before which distances the triangles cannot be hit.
    #[inline(always)]
    pub(crate) fn earliest(&self) -> L {
        let size = self.size.add(L::splat(self.slack.determinant()));
        self.reach.sub(L::splat(self.slack.distance)).div(size).mul(L::splat(DOWN))
    }

    /// Behind which distances those that are hit for sure cannot be hit.
    #[inline(always)]
    pub(crate) fn latest(&self) -> L {
        let size = self.size.sub(L::splat(0.5 * self.slack.determinant()));
        self.reach.add(L::splat(self.slack.distance)).div(size).mul(L::splat(UP))
    }
}

/// Rounds a distance down, and up, by more than its own arithmetic does.
const DOWN: f32 = 1.0 - 8.0 * H;
const UP: f32 = 1.0 + 8.0 * H;
