//! Tests of a block of triangles against a group of rays.

use crate::frame::H;
use crate::group::rays::Rays;
use crate::group::shaft::Shaft;
use crate::lanes::Lanes;
use crate::lanes::triple::{abs, cross, dot, load, splat, store, sub};
use crate::node::{Block, NONE, Slack, WIDTH};
use crate::ray_simd::TriangleTest;
use glam::Vec3A;

/// The triangles of a block that a group may hit.
pub(crate) struct BlockTest<P> {
    /// Values that the tests of single triangles share.
    pub(crate) prepared: P,
    /// A bit for each triangle that any ray of the group may hit.
    pub(crate) met: u32,
}

/// Where rays look from.
pub(crate) trait TriangleTester<L: Lanes> {
    /// The triangles of a block as all rays see them.
    type Prepared;
    /// One of them.
    type PreparedTriangle;

    /// The triangles of a block, and a bit for each that any of the rays may hit.
    fn test_block(&self, shaft: &Shaft<L>, block: &Block, depth: f32) -> BlockTest<Self::Prepared>;

    /// One of the triangles.
    fn prepare(
        &self,
        prepared: &Self::Prepared,
        block: &Block,
        lane: usize,
    ) -> Self::PreparedTriangle;

    /// How eight of the rays see a triangle.
    fn test<'a>(
        &self,
        triangle: &'a Self::PreparedTriangle,
        rays: &Rays,
        k: usize,
    ) -> TriangleTest<'a, L>;
}

/// Rays with a common origin.
///
/// With the names of [`Slack::new`], `e2.(c x d) = (e2 x c).d` is linear in the direction, and its
/// factor is that of all rays. The bound there holds for this order of operations too: `e2 x c` is
/// off by `26.2 s` in the 2-norm and at most `5.3 s / h`, the direction by one of itself, and the
/// sum of three products by three.
///
/// For all rays at once, directions `d` are divided by their component along the heading, which
/// leaves a rectangle of slopes: with middle `m` and half-widths `r`, `a.d` lies within `|a|.r` of
/// `a.m`. Such a `d` is shorter than 4 and computed with at most six more roundings, so eight times
/// the slacks cover it.
pub(crate) struct CommonOrigin<L> {
    origin: [L; 3],
    middle: [L; 3],
    half_width: [L; 3],
}

/// Each triangle's factors, of the determinant, the weights and the distance.
pub(crate) struct LinearForms {
    normal: [[f32; WIDTH]; 3],
    second: [[f32; WIDTH]; 3],
    third: [[f32; WIDTH]; 3],
    reach: [f32; WIDTH],
    slacks: [[f32; WIDTH]; 3],
}

/// Factors of one triangle.
pub(crate) struct LinearForm<L> {
    normal: [L; 3],
    second: [L; 3],
    third: [L; 3],
    reach: L,
    slack: Slack,
}

impl<L: Lanes> CommonOrigin<L> {
    #[inline(always)]
    pub(crate) fn new(rays: &Rays, shaft: &Shaft<L>) -> Self {
        let origin = rays.first_origin();
        let axis = shaft.heading.axis;
        let mut middle = [L::splat(if shaft.heading.backward { -1.0 } else { 1.0 }); 3];
        let mut half_width = [L::splat(0.0); 3];
        for (aside, [low, high]) in shaft.heading.aside().into_iter().zip(shaft.slopes) {
            debug_assert_ne!(aside, axis);
            middle[aside] = L::splat(0.5 * (low + high));
            half_width[aside] = L::splat(0.5 * (high - low) + 32.0 * H);
        }
        Self { origin, middle, half_width }
    }

    /// How far the product of `a` and a direction is at most from that with the middle.
    #[inline(always)]
    fn spread(&self, a: [L; 3]) -> L {
        dot(abs(a), self.half_width)
    }

    /// The largest product of `a` and a direction, for a positive determinant.
    #[inline(always)]
    fn most(&self, a: [L; 3], determinant: L) -> L {
        dot(a, self.middle).flip_by(determinant).add(self.spread(a))
    }
}

impl<L: Lanes> TriangleTester<L> for CommonOrigin<L> {
    type Prepared = LinearForms;
    type PreparedTriangle = LinearForm<L>;

    #[inline(always)]
    fn test_block(&self, _: &Shaft<L>, block: &Block, depth: f32) -> BlockTest<LinearForms> {
        const MARGIN: f32 = 8.0;
        let (edge_1, edge_2) = (load::<L>(&block.edge_1), load(&block.edge_2));
        let c = sub(load(&block.corner), self.origin);
        let normal = cross(edge_2, edge_1);
        let second = cross(edge_2, c);
        let third = cross(edge_1, c);
        let reach = dot(normal, c);

        let first = sub(sub(normal, second), third);
        let slacks = slacks(edge_1, edge_2);
        let margin = L::splat(MARGIN);
        let [weight, rest, distance] =
            [slacks[0].mul(margin), slacks[1].mul(margin), slacks[2].mul(margin)];
        let determinant = dot(normal, self.middle);
        let size = determinant.flip_by(determinant);
        let size_spread = self.spread(normal);
        let reach_up = reach.flip_by(determinant).add(distance);
        let second_up = self.most(second, determinant);
        let third_up = self.most(third, determinant);
        let left = size.add(size_spread).mul_sub(L::splat(depth), reach_up);
        let missed = L::any_negative([
            second_up.min(third_up).add(weight),
            self.most(first, determinant).add(rest),
            reach_up,
            left.add(distance).add(distance),
        ]);
        let may_turn = size.at_most(distance.mul_add(L::splat(Slack::TURN), size_spread));
        let there = L::differ(&block.triangles, [NONE; 3]);
        let prepared = LinearForms {
            normal: store(normal),
            second: store(second),
            third: store(third),
            reach: reach.store(),
            slacks: store(slacks),
        };
        BlockTest { prepared, met: (!missed | may_turn) & there }
    }

    #[inline(always)]
    fn prepare(&self, prepared: &LinearForms, _: &Block, lane: usize) -> LinearForm<L> {
        LinearForm {
            normal: splat(&prepared.normal, lane),
            second: splat(&prepared.second, lane),
            third: splat(&prepared.third, lane),
            reach: L::splat(prepared.reach[lane % WIDTH]),
            slack: Slack {
                weight: prepared.slacks[0][lane % WIDTH],
                rest: prepared.slacks[1][lane % WIDTH],
                distance: prepared.slacks[2][lane % WIDTH],
            },
        }
    }

    #[inline(always)]
    fn test<'a>(&self, triangle: &'a LinearForm<L>, rays: &Rays, k: usize) -> TriangleTest<'a, L> {
        let direction = rays.direction::<L>(k);
        let seen =
            [dot(triangle.second, direction), dot(triangle.third, direction), triangle.reach];
        TriangleTest::new(
            &triangle.slack,
            dot(triangle.normal, direction),
            seen,
            L::load(&rays.end[k]),
        )
    }
}

/// Rays from different points.
pub(crate) struct SeparateOrigins;

/// A triangle, and its edges' cross product.
pub(crate) struct Corners<L> {
    corner: [L; 3],
    edge_1: [L; 3],
    edge_2: [L; 3],
    normal: [L; 3],
    slack: Slack,
}

impl<L: Lanes> TriangleTester<L> for SeparateOrigins {
    type Prepared = ();
    type PreparedTriangle = Corners<L>;

    #[inline(always)]
    fn test_block(&self, shaft: &Shaft<L>, block: &Block, depth: f32) -> BlockTest<()> {
        let met = shaft.meets(block, depth) & L::differ(&block.triangles, [NONE; 3]);
        BlockTest { prepared: (), met }
    }

    #[inline(always)]
    fn prepare(&self, (): &(), block: &Block, lane: usize) -> Corners<L> {
        let (edge_1, edge_2) = (splat(&block.edge_1, lane), splat(&block.edge_2, lane));
        let corner = splat(&block.corner, lane);
        let edge = |of: &[[f32; WIDTH]; 3]| Vec3A::new(of[0][lane], of[1][lane], of[2][lane]);
        let slack = Slack::new(edge(&block.edge_1), edge(&block.edge_2));
        Corners { corner, edge_1, edge_2, normal: cross(edge_2, edge_1), slack }
    }

    #[inline(always)]
    fn test<'a>(&self, triangle: &'a Corners<L>, rays: &Rays, k: usize) -> TriangleTest<'a, L> {
        let (origin, direction) = (rays.origin::<L>(k), rays.direction::<L>(k));
        let c = sub(triangle.corner, origin);
        let r = cross(c, direction);
        let n = triangle.normal;
        let seen = [dot(triangle.edge_2, r), dot(triangle.edge_1, r), dot(n, c)];
        TriangleTest::new(&triangle.slack, dot(n, direction), seen, L::load(&rays.end[k]))
    }
}

/// Weight, rest and distance of [`Slack::new`] of eight triangles.
#[inline(always)]
fn slacks<L: Lanes>(edge_1: [L; 3], edge_2: [L; 3]) -> [L; 3] {
    let ([x, y, z], [u, v, w]) = (abs(edge_1), abs(edge_2));
    let (norm_1, norm_2) = (x.add(y).add(z), u.add(v).add(w));
    let (s, q) = (norm_1.max(norm_2), norm_1.mul(norm_2));
    let least = L::splat(Slack::UNDERFLOW);
    let [[s_weight, q_weight], [s_rest, q_rest]] = [Slack::WEIGHT, Slack::REST];
    let weight = s.mul_add(L::splat(s_weight), q.mul_add(L::splat(q_weight), least));
    let rest = s.mul_add(L::splat(s_rest), q.mul_add(L::splat(q_rest), least));
    [weight, rest, q.mul_add(L::splat(Slack::DISTANCE), least)]
}
