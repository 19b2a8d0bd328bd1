//! Rays that travel together, up to [`MOST`] at a time.
//!
//! Photons that leave a lamp in nearly the same direction meet the same boxes and the same triangles. So
//! what is alike is found out once for all of them: a box is held against the shaft around the
//! rays (Reshetov, Soupikov and Hurley 2005, "Multi-level ray tracing algorithm", SIGGRAPH; here
//! for all eight children of a node at once), and a triangle against the directions of all rays
//! before it is held against eight rays at a time. As for single rays, all of this only proposes; the
//! arithmetic of [`crate::intersect()`] decides, four rays at a time, with the same bits.
//!
//! Where rays part the shaft holds too much; then they are given up as a group.
//!
//! Where what is: `run` finds rays that belong together, `rays` has them by coordinate, `shaft` is
//! what surrounds them, `eye` what they see of triangles, `found` what they may hit, `walk` their
//! way, `decide` the decision, `pace` how many of them go together.

mod decide;
mod eye;
mod found;
mod pace;
mod rays;
mod run;
mod shaft;
mod walk;

use crate::frame::Frame;
use crate::kernel::{Errand, Kernel};
use crate::lanes::Lanes;
use crate::traverse::Tree;
use crate::{Hit, Shot};
use eye::{OnePoint, Spread};
use found::Found;
pub(crate) use pace::Pace;
use rays::Rays;
pub(crate) use run::{Heading, Run};
use shaft::Shaft;

/// Rays of a group.
pub(crate) const MOST: usize = 128;

/// Rays and what they found, for one group after the other.
pub(crate) struct Group {
    rays: Rays,
    found: Found,
}

/// The rays of a group are too far apart to be traced together.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Parted;

/// The rays of one group, and where they fly.
#[derive(Clone, Copy)]
pub(crate) struct Party<'a> {
    pub(crate) tree: &'a Tree,
    pub(crate) frame: &'a Frame,
    pub(crate) heading: Heading,
    pub(crate) shots: &'a [Shot],
}

/// What is asked of the rays, and where answers go.
pub(crate) enum Answers<'a> {
    Closest(&'a mut [Option<Hit>]),
    Occluded(&'a mut [bool]),
}

/// The way of one group.
struct Together<'a> {
    group: &'a mut Group,
    party: Party<'a>,
    answers: Answers<'a>,
}

impl Errand for Together<'_> {
    type Result = Result<usize, Parted>;

    #[inline(always)]
    fn run<L: Lanes>(self) -> Self::Result {
        self.group.trace::<L>(self.party, self.answers)
    }
}

impl Group {
    pub(crate) fn new() -> Self {
        Self { rays: Rays::new(), found: Found::new() }
    }

    /// Answers a run of rays, and returns what that cost by [`Pace`]'s measure.
    #[inline(always)]
    pub(crate) fn answer(
        &mut self,
        kernel: Kernel,
        party: Party<'_>,
        answers: Answers<'_>,
    ) -> Result<usize, Parted> {
        kernel.run(Together { group: self, party, answers })
    }

    #[inline(always)]
    fn trace<L: Lanes>(&mut self, party: Party<'_>, answers: Answers<'_>) -> Result<usize, Parted> {
        let Self { rays, found } = self;
        rays.fill(party.frame, party.shots);
        found.clear(rays);
        let shaft = Shaft::<L>::new(rays, party.heading);
        let tree = party.tree;
        let cost = match (&answers, rays.one_origin) {
            (Answers::Closest(_), true) => {
                tree.walk_together::<L, _, false>(rays, &shaft, &OnePoint::new(rays, &shaft), found)
            }
            (Answers::Closest(_), false) => {
                tree.walk_together::<L, _, false>(rays, &shaft, &Spread, found)
            }
            (Answers::Occluded(_), true) => {
                tree.walk_together::<L, _, true>(rays, &shaft, &OnePoint::new(rays, &shaft), found)
            }
            (Answers::Occluded(_), false) => {
                tree.walk_together::<L, _, true>(rays, &shaft, &Spread, found)
            }
        }?;
        match answers {
            Answers::Closest(hits) => found.decide_closest::<L::Quad>(party, rays, hits),
            Answers::Occluded(occluded) => found.decide_any(party, rays, occluded),
        }
        Ok(cost)
    }
}
