//! Largest values over surfaces, never too low: best-first search over boxes and triangles.
//!
//! What a place p with the height h over the plane of a triangle gives there, and what is joined to
//! it from there, goes with `cos / d^2 = h / d^3`: with the height known, it is largest at the
//! point of the triangle that is nearest to p. Other factors, intensities and cosines, are bounded
//! over the directions of the triangle.

use super::boxes::{BoxTree, Inside};
use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// The search ends where the bound is this many times what was found at most, or after this many
/// steps.
const CLOSENESS: f64 = 1.15;
const STEPS: usize = 600;

/// A triangle seen from a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenPart {
    pub(super) corners: [DVec3; 3],
    pub(super) facet: u32,
}

/// From bounds over boxes and triangles to the largest value over all facets.
pub(super) trait Bounded {
    /// At least the largest value in a box of the tree, by its number and corners.
    fn over_box(&self, number: u32, low: DVec3, high: DVec3) -> f64;

    /// At least the largest value on a triangle.
    fn over_part(&self, part: &SeenPart) -> f64;

    /// The value at its centre.
    fn at_centre(&self, part: &SeenPart) -> f64;
}

struct Open {
    bound: f64,
    what: What,
}

enum What {
    Box(u32),
    Part(SeenPart),
}

impl PartialEq for Open {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// At least the largest value over all facets of a tree.
pub(super) fn supremum<S: Spectrum>(
    world: &World<S>,
    tree: &BoxTree,
    facets: &[usize],
    value: &impl Bounded,
) -> f64 {
    let root = tree.root().into_iter();
    let open = root.map(|root| Open { bound: f64::INFINITY, what: What::Box(root) });
    let part = |thing: u32| {
        let facet = facets[thing as usize];
        SeenPart { corners: world.facets[facet].corners(), facet: thing }
    };
    search(
        open.collect(),
        value,
        |number| match tree.inside(number) {
            Inside::Boxes(children) => children.map(What::Box).into_iter().collect(),
            Inside::Things(things) => things.iter().map(|it| What::Part(part(*it))).collect(),
        },
        |number| {
            let node = tree.node(number);
            value.over_box(number, node.low, node.high)
        },
    )
}

/// At least the largest value over some triangles.
pub(super) fn supremum_over(parts: impl Iterator<Item = SeenPart>, value: &impl Bounded) -> f64 {
    let open = parts.map(|it| Open { bound: f64::INFINITY, what: What::Part(it) });
    search(open.collect(), value, |_| Vec::new(), |_| 0.0)
}

fn search(
    mut open: BinaryHeap<Open>,
    value: &impl Bounded,
    inside: impl Fn(u32) -> Vec<What>,
    over_box: impl Fn(u32) -> f64,
) -> f64 {
    let mut found = 0.0_f64;
    for _ in 0..STEPS {
        let Some(Open { bound, what }) = open.pop() else { return found };
        if bound <= CLOSENESS * found {
            return bound.max(found);
        }
        let parts = match what {
            What::Box(number) => inside(number),
            What::Part(part) => part.quarters().map(What::Part).into_iter().collect(),
        };
        open.extend(parts.into_iter().filter_map(|what| {
            let bound = match &what {
                What::Box(number) => over_box(*number),
                What::Part(part) => {
                    found = found.max(value.at_centre(part));
                    value.over_part(part)
                }
            };
            // Of NaN nothing is known.
            let bound = if bound.is_nan() { f64::INFINITY } else { bound };
            (bound > 0.0).then_some(Open { bound, what })
        }));
    }
    open.pop().map_or(found, |open| open.bound.max(found))
}

impl SeenPart {
    pub(super) fn centre(&self) -> DVec3 {
        self.corners.iter().sum::<DVec3>() / 3.0
    }

    /// The radius of a ball around its centre.
    pub(super) fn radius_m(&self) -> f64 {
        self.farthest_m(self.centre())
    }

    /// The largest distance of a place, in m.
    pub(super) fn farthest_m(&self, place: DVec3) -> f64 {
        self.corners.iter().map(|corner| corner.distance(place)).fold(0.0, f64::max)
    }

    fn quarters(&self) -> [Self; 4] {
        let [a, b, c] = self.corners;
        let [ab, bc, ca] = [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            .map(|corners| Self { corners, facet: self.facet })
    }

    /// The least distance of a place, in m (C. Ericson, "Real-Time Collision Detection", 2005,
    /// section 5.1.5, by the regions of the plane).
    pub(super) fn distance_m(&self, place: DVec3) -> f64 {
        let [a, b, c] = self.corners;
        let n = (b - a).cross(c - a);
        let is_over = |p: DVec3, q: DVec3| n.cross(q - p).dot(place - p) >= 0.0;
        if is_over(a, b) && is_over(b, c) && is_over(c, a) {
            let n = n.normalize_or_zero();
            if n != DVec3::ZERO {
                return n.dot(place - a).abs();
            }
        }
        let to_edge = |p: DVec3, q: DVec3| {
            let edge = q - p;
            let along = ((place - p).dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            let along = if along.is_nan() { 0.0 } else { along };
            (p + edge * along).distance(place)
        };
        to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a))
    }
}
