//! Detection of coherent runs in a batch of rays.

use crate::RayQuery;
use crate::frame::Frame;
use crate::group::rays::MAX_GROUP;
use crate::intersect::longest_axis;
use crate::traverse::Tree;
use glam::DVec3;

/// Fewer are better off alone.
const MIN_GROUP: usize = 8;

/// The least cosine between the first direction of a run and the others: 14 degrees. The axis along
/// which the first one moves most is at most 55 degrees away from it, so no ray of a run is more
/// than 69 degrees away from that axis: its slopes aside are below 3.
const MIN_COSINE: f64 = 0.97;

/// Larger than any cosine of unit vectors, as they come out of rounding.
const LARGE: f64 = 1.1;

/// How far apart rays of a run may start, in the frame.
const SPREAD: f64 = 0.25;

/// Within so much of the centre the frame leaves origins where they are.
const INSIDE: f64 = 2.0;

/// The axis along which the rays of a run advance, and whether they do so backward.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Heading {
    pub(crate) axis: usize,
    pub(crate) backward: bool,
}

/// Run of the next shots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum RayRun {
    /// Number of shots that belong together, and where they fly.
    Coherent(usize, Heading),
    /// Number of shots that do not belong together.
    Incoherent(usize),
}

/// The rays of one group, and where they fly.
#[derive(Clone, Copy)]
pub(crate) struct RayGroup<'a> {
    pub(crate) tree: &'a Tree,
    pub(crate) frame: &'a Frame,
    pub(crate) heading: Heading,
    pub(crate) shots: &'a [RayQuery],
}

impl RayRun {
    /// The first run among `shots`, of which there is at least one; at most `most` of them belong
    /// together.
    #[inline]
    pub(crate) fn first(shots: &[RayQuery], frame: &Frame, most: usize) -> Self {
        let mut start = 0;
        while start < shots.len() {
            let count = together(&shots[start..], frame, most.min(MAX_GROUP));
            if count >= MIN_GROUP {
                let heading = Heading::new(shots[0].ray.direction);
                return if start > 0 {
                    Self::Incoherent(start)
                } else {
                    Self::Coherent(count, heading)
                };
            }
            start += count;
        }
        Self::Incoherent(start)
    }
}

impl Heading {
    fn new(direction: DVec3) -> Self {
        let axis = longest_axis(direction);
        Self { axis, backward: direction[axis] < 0.0 }
    }

    /// The other two axes.
    pub(crate) fn aside(self) -> [usize; 2] {
        [(self.axis + 1) % 3, (self.axis + 2) % 3]
    }
}

/// How many of the first shots are close to the very first; 1 if they are too few to matter.
#[inline(always)]
fn together(shots: &[RayQuery], frame: &Frame, most: usize) -> usize {
    let first = &shots[0].ray;
    let near = |shot: &RayQuery| {
        (MIN_COSINE..LARGE).contains(&first.direction.dot(shot.ray.direction))
            && (shot.ray.origin == first.origin || near_by(frame, shot.ray.origin, first.origin))
    };
    // Nearly all rays that belong to no run are told by this one.
    if !shots.get(MIN_GROUP - 1).is_some_and(near) {
        return 1;
    }
    let inside = frame.point(first.origin).abs().cmple(DVec3::splat(INSIDE - SPREAD)).all();
    if !inside {
        return 1;
    }
    // Not even the first one is near itself if its direction is no unit vector.
    shots.iter().take(most).take_while(|shot| near(shot)).count().max(1)
}

fn near_by(frame: &Frame, p: DVec3, q: DVec3) -> bool {
    (frame.point(p) - frame.point(q)).abs().cmple(DVec3::splat(SPREAD)).all()
}
