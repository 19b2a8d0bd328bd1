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
use crate::lanes::{Lanes, Portable};
use crate::traverse::{Kernel, Tree};
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

/// What is asked, of one group.
#[derive(Clone, Copy)]
pub(crate) struct Party<'a> {
    pub(crate) tree: &'a Tree,
    pub(crate) frame: &'a Frame,
    pub(crate) heading: Heading,
    pub(crate) shots: &'a [Shot],
}

/// Where answers go.
enum Answers<'a> {
    Closest(&'a mut [Option<Hit>]),
    Occluded(&'a mut [bool]),
}

impl Group {
    pub(crate) fn new() -> Self {
        Self { rays: Rays::new(), found: Found::new() }
    }

    /// The closest hits of a run of rays, and what they cost by [`Pace`]'s measure.
    pub(crate) fn closest(
        &mut self,
        kernel: Kernel,
        party: Party<'_>,
        hits: &mut [Option<Hit>],
    ) -> Result<usize, Parted> {
        self.trace_with(kernel, party, Answers::Closest(hits))
    }

    /// Whether the rays of a run are occluded, and what that cost by [`Pace`]'s measure.
    pub(crate) fn any(
        &mut self,
        kernel: Kernel,
        party: Party<'_>,
        occluded: &mut [bool],
    ) -> Result<usize, Parted> {
        self.trace_with(kernel, party, Answers::Occluded(occluded))
    }

    #[inline(always)]
    fn trace_with(
        &mut self,
        kernel: Kernel,
        party: Party<'_>,
        answers: Answers<'_>,
    ) -> Result<usize, Parted> {
        match kernel {
            Kernel::Portable => self.trace::<Portable>(party, answers),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this kernel is only chosen where the features are there.
            Kernel::Avx2 => unsafe { self.trace_avx2(party, answers) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this kernel is only chosen where the features are there.
            Kernel::Avx512 => unsafe { self.trace_avx512(party, answers) },
        }
    }

    /// # Safety
    /// The machine must have what [`crate::lanes::Avx512::is_supported`] asks for.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    unsafe fn trace_avx512(
        &mut self,
        party: Party<'_>,
        answers: Answers<'_>,
    ) -> Result<usize, Parted> {
        self.trace::<crate::lanes::Avx512>(party, answers)
    }

    /// # Safety
    /// The machine must have what [`crate::lanes::Avx2::is_supported`] asks for.
    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
    unsafe fn trace_avx2(
        &mut self,
        party: Party<'_>,
        answers: Answers<'_>,
    ) -> Result<usize, Parted> {
        self.trace::<crate::lanes::Avx2>(party, answers)
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
