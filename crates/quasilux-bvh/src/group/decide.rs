//! The decision, of four rays at a time.
//!
//! What [`crate::intersect()`] does with one ray and one triangle, operation by operation, so that
//! the bits are the same.

use crate::group::candidates::{ExtraCandidate, GroupCandidates};
use crate::group::coherence::{Heading, RayGroup};
use crate::group::rays::Rays;
use crate::intersect::least_area;
use crate::lanes::Quad;
use crate::node::{NONE, WIDTH};
use crate::{Corners, Hit, PreparedRay, RayQuery, intersect};
use glam::DVec3;

/// Rays decided at once.
const FOUR: usize = 4;

impl GroupCandidates {
    /// The closest hit of each ray.
    #[inline(always)]
    pub(crate) fn decide_closest<Q: Quad>(
        &mut self,
        group: RayGroup<'_>,
        rays: &Rays,
        hits: &mut [Option<Hit>],
    ) {
        let (corners, shots) = (&group.tree.corners, group.shots);
        let ones = self.one.as_flattened();
        for (i, (shots, hits)) in shots.chunks(FOUR).zip(hits.chunks_mut(FOUR)).enumerate() {
            let triangles = &ones[FOUR * i..FOUR * (i + 1)];
            if let (Ok(shots), Ok(hits)) = (shots.try_into(), (&mut *hits).try_into())
                && let Ok(triangles) = triangles.try_into()
                && decide_four::<Q>(group.heading, corners, shots, triangles, hits)
            {
                continue;
            }
            for ((shot, hit), &triangle) in shots.iter().zip(hits).zip(triangles) {
                *hit = decide(corners, shot, triangle);
            }
        }
        for ExtraCandidate { ray, triangle, earliest } in self.more.drain(..) {
            if earliest <= rays.end[ray / WIDTH][ray % WIDTH]
                && let Some(hit) = decide(corners, &shots[ray], triangle)
                && hit.precedes(&hits[ray])
            {
                hits[ray] = Some(hit);
            }
        }
    }

    /// Whether each ray hits anything.
    pub(crate) fn decide_any(&mut self, group: RayGroup<'_>, rays: &Rays, occluded: &mut [bool]) {
        let corners = &group.tree.corners;
        for (i, (shot, occluded)) in group.shots.iter().zip(&mut *occluded).enumerate() {
            let (k, lane) = (i / WIDTH, i % WIDTH);
            *occluded = self.occluded[k] >> lane & 1 == 1
                || decide(corners, shot, self.one[k][lane]).is_some();
        }
        for ExtraCandidate { ray, triangle, .. } in self.more.drain(..) {
            if !occluded[ray] && rays.active[ray / WIDTH] >> (ray % WIDTH) & 1 == 1 {
                occluded[ray] = decide(corners, &group.shots[ray], triangle).is_some();
            }
        }
    }
}

#[inline(never)]
fn decide(corners: &[Corners], shot: &RayQuery, triangle: u32) -> Option<Hit> {
    if triangle == NONE {
        return None;
    }
    intersect(&PreparedRay::new(&shot.ray), &corners[triangle as usize], triangle)
}

/// Decides about four rays and the triangle of each, if there is one for each and the rays are
/// sheared along the same axis.
#[inline(always)]
fn decide_four<Q: Quad>(
    heading: Heading,
    corners: &[Corners],
    shots: &[RayQuery; FOUR],
    triangles: &[u32; FOUR],
    hits: &mut [Option<Hit>; FOUR],
) -> bool {
    let z = heading.axis;
    let [mut x, mut y] = heading.aside();
    if heading.backward {
        std::mem::swap(&mut x, &mut y);
    }
    let rays = [&shots[0].ray, &shots[1].ray, &shots[2].ray, &shots[3].ray];
    let [r0, r1, r2, r3] = rays;
    let directions = [&r0.direction, &r1.direction, &r2.direction, &r3.direction];
    let d = [gather::<Q>(directions, x), gather(directions, y), gather(directions, z)];
    if triangles.contains(&NONE) || !most_along_last(d, heading) {
        return false;
    }
    let shear = [d[0].div(d[2]), d[1].div(d[2]), Q::splat(1.0).div(d[2])];
    let origins = [&r0.origin, &r1.origin, &r2.origin, &r3.origin];
    let o = [gather::<Q>(origins, x), gather(origins, y), gather(origins, z)];
    let [t0, t1, t2, t3] = *triangles;
    let at = [t0 as usize, t1 as usize, t2 as usize, t3 as usize];
    let faces = [&corners[at[0]], &corners[at[1]], &corners[at[2]], &corners[at[3]]];
    let one_face = (t0 == t1) & (t0 == t2) & (t0 == t3);
    let axes = [x, y, z];
    let a = sheared(shear, o, corner(faces, 0, axes, one_face));
    let b = sheared(shear, o, corner(faces, 1, axes, one_face));
    let c = sheared(shear, o, corner(faces, 2, axes, one_face));
    let t_max = Q::from_array([r0.t_max, r1.t_max, r2.t_max, r3.t_max]);
    let Some(found) = intersect_four([a, b, c], t_max) else { return false };
    let [u, v, w] = found.barycentric.map(Q::store);
    let distance = found.distance.store();
    for i in 0..FOUR {
        hits[i] = if found.counts >> i & 1 == 1 {
            let barycentric = [u[i], v[i], w[i]];
            Some(Hit { triangle: triangles[i], distance: distance[i], barycentric })
        } else {
            None
        };
    }
    true
}

/// Intersections of four rays with a triangle each.
struct FourHits<Q> {
    /// A bit for each ray that hits its triangle.
    counts: u32,
    distance: Q,
    barycentric: [Q; 3],
}

/// Intersects four rays with a triangle each, given by its sheared corners; `None` if one of the
/// triangles is seen so nearly edge-on that rounding could decide.
#[inline(always)]
fn intersect_four<Q: Quad>([a, b, c]: [[Q; 3]; 3], t_max: Q) -> Option<FourHits<Q>> {
    let (first, second, third) =
        (EdgeFunction::new(c, b), EdgeFunction::new(a, c), EdgeFunction::new(b, a));
    let (u, v, w) = (first.value, second.value, third.value);
    let products = first.products.add(second.products).add(third.products);
    let zero = Q::splat(0.0);
    let negative = u.below(zero) | v.below(zero) | w.below(zero);
    let positive = zero.below(u) | zero.below(v) | zero.below(w);
    let sum = u.add(v).add(w);
    let distance = u.mul(a[2]).add(v.mul(b[2])).add(w.mul(c[2])).div(sum);
    let mixed = negative & positive;
    let wide =
        least_area(products).below(sum.abs()) & distance.abs().below(Q::splat(f64::INFINITY));
    if !(mixed | wide) & 0xf != 0 {
        return None;
    }
    let counts = !mixed & zero.below(distance) & distance.below(t_max);
    Some(FourHits { counts, distance, barycentric: [u.div(sum), v.div(sum), w.div(sum)] })
}

/// The edge function of two sheared corners.
struct EdgeFunction<Q> {
    value: Q,
    /// The sum of the sizes of the two products that it is the difference of.
    products: Q,
}

impl<Q: Quad> EdgeFunction<Q> {
    #[inline(always)]
    fn new(p: [Q; 3], q: [Q; 3]) -> Self {
        let (left, right) = (p[0].mul(q[1]), p[1].mul(q[0]));
        Self { value: left.sub(right), products: left.abs().add(right.abs()) }
    }
}

/// A coordinate of four points.
#[inline(always)]
fn gather<Q: Quad>(of: [&DVec3; FOUR], axis: usize) -> Q {
    Q::from_array([of[0][axis], of[1][axis], of[2][axis], of[3][axis]])
}

/// A corner of each of four triangles, which may be known to be the same.
#[inline(always)]
fn corner<Q: Quad>(
    faces: [&Corners; FOUR],
    number: usize,
    [x, y, z]: [usize; 3],
    one_face: bool,
) -> [Q; 3] {
    if one_face {
        let face = faces[0];
        let at = |axis: usize| Q::splat(face.along(axis)[number]);
        [at(x), at(y), at(z)]
    } else {
        let [a, b, c, d] = faces;
        let at = |axis: usize| {
            let [a, b, c, d] = [a.along(axis), b.along(axis), c.along(axis), d.along(axis)];
            Q::from_array([a[number], b[number], c[number], d[number]])
        };
        [at(x), at(y), at(z)]
    }
}

/// A corner in the sheared frame.
#[inline(always)]
fn sheared<Q: Quad>(shear: [Q; 3], origin: [Q; 3], corner: [Q; 3]) -> [Q; 3] {
    let [x, y, z] = [corner[0].sub(origin[0]), corner[1].sub(origin[1]), corner[2].sub(origin[2])];
    [x.sub(shear[0].mul(z)), y.sub(shear[1].mul(z)), shear[2].mul(z)]
}

/// Whether [`PreparedRay::new`] takes the last of the axes in their order for all of four
/// directions.
#[inline(always)]
fn most_along_last<Q: Quad>(direction: [Q; 3], heading: Heading) -> bool {
    let [a, b, z] = [direction[0].abs(), direction[1].abs(), direction[2].abs()];
    // The axes are 0, 1 and 2 in a cycle, and ties go to the lower one.
    let less = match (heading.axis, heading.backward) {
        (0, _) => z.below(a) | z.below(b),
        (1, false) => z.below(a) | !b.below(z),
        (1, true) => z.below(b) | !a.below(z),
        (_, _) => !a.below(z) | !b.below(z),
    };
    less & 0xf == 0
}
