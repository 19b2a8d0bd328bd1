//! Many rays at once: the same answers as one by one, sooner.

use crate::frame::Framed;
use crate::group::{Group, Pace, Parted, Party, Run};
use crate::intersect::intersect_with;
use crate::kernel::wins;
use crate::lanes::Quad;
use crate::stream::{Passenger, Voyage};
use crate::{Hit, PreparedRay, Shot, TriangleBvh};

impl TriangleBvh {
    /// [`Self::closest_hit`] of each of `shots`, in their order.
    ///
    /// Shots that follow each other in nearly the same direction from nearly the same place are traced
    /// together.
    ///
    /// # Panics
    /// If there are not as many `hits` as `shots`, or more than 2^32 of them.
    pub fn closest_hits(&self, shots: &[Shot], hits: &mut [Option<Hit>]) {
        self.each_run(
            shots,
            hits,
            |group, party, hits| group.closest(self.kernel, party, hits),
            |questions, hits| self.tree.stream(self.kernel, &mut Closest { questions, hits }),
        );
    }

    /// [`Self::is_occluded`] of each of `shots`, in their order.
    ///
    /// # Panics
    /// If there are not as many answers as `shots`, or more than 2^32 of them.
    pub fn are_occluded(&self, shots: &[Shot], occluded: &mut [bool]) {
        self.each_run(
            shots,
            occluded,
            |group, party, occluded| group.any(self.kernel, party, occluded),
            |questions, occluded| {
                self.tree.stream(self.kernel, &mut Occlusion { questions, occluded });
            },
        );
    }

    /// Answers runs of shots that belong together by `together`, and all others by `apart`.
    #[inline(always)]
    fn each_run<A>(
        &self,
        mut shots: &[Shot],
        mut answers: &mut [A],
        together: impl Fn(&mut Group, Party<'_>, &mut [A]) -> Result<usize, Parted>,
        apart: impl Fn(Questions<'_>, &mut [A]),
    ) {
        assert_eq!(shots.len(), answers.len(), "as many answers as questions");
        let mut group = Group::new();
        let mut pace = Pace::new();
        while !shots.is_empty() {
            let run = match pace.pause() {
                0 => Run::first(shots, &self.frame, pace.most()),
                pause => Run::Alone(pause.min(shots.len())),
            };
            let (Run::Together(count, _) | Run::Alone(count)) = run;
            let (now, later) = answers.split_at_mut(count);
            let cost = match run {
                Run::Together(_, heading) => {
                    let (tree, frame) = (&self.tree, &self.frame);
                    let party = Party { tree, frame, heading, shots: &shots[..count] };
                    let cost = together(&mut group, party, now);
                    pace.learn(count, cost);
                    cost
                }
                Run::Alone(_) => Err(Parted),
            };
            if cost.is_err() {
                apart(Questions::new(self, &shots[..count]), now);
            }
            (shots, answers) = (&shots[count..], later);
        }
    }
}

/// Rays that wait for their turn.
struct Questions<'a> {
    bvh: &'a TriangleBvh,
    shots: &'a [Shot],
    next: u32,
}

/// The search for the closest hits.
struct Closest<'a> {
    questions: Questions<'a>,
    hits: &'a mut [Option<Hit>],
}

/// The search for any hits.
struct Occlusion<'a> {
    questions: Questions<'a>,
    occluded: &'a mut [bool],
}

impl<'a> Questions<'a> {
    fn new(bvh: &'a TriangleBvh, shots: &'a [Shot]) -> Self {
        assert!(u32::try_from(shots.len()).is_ok(), "too many rays for 32-bit indices");
        Self { bvh, shots, next: 0 }
    }

    /// The number of the next ray, and what becomes of it.
    #[inline(always)]
    fn next(&mut self) -> Option<(u32, Framed)> {
        let number = self.next;
        let shot = self.shots.get(number as usize)?;
        self.next += 1;
        Some((number, self.bvh.frame.ray(&shot.ray)))
    }

    #[inline(always)]
    fn shot(&self, number: u32) -> &'a Shot {
        &self.shots[number as usize]
    }

    /// What the ray hits of one triangle.
    #[inline(always)]
    fn hit<Q: Quad>(&self, ray: &PreparedRay, triangle: u32) -> Option<Hit> {
        // SAFETY: the triangles of a valid tree exist.
        let corners = unsafe { self.bvh.tree.corners.get_unchecked(triangle as usize) };
        intersect_with::<Q>(ray, corners, triangle)
    }
}

impl Voyage for Closest<'_> {
    #[inline(always)]
    fn embark(&mut self) -> Option<Passenger> {
        loop {
            let (number, framed) = self.questions.next()?;
            self.hits[number as usize] = None;
            match framed {
                Framed::Ray(ray) => {
                    let excluded = self.questions.shot(number).excluded;
                    return Some(Passenger { ray, number, excluded });
                }
                Framed::Misses => {}
                Framed::TooFar => self.strand(number),
            }
        }
    }

    #[inline(always)]
    fn decide<Q: Quad>(
        &mut self,
        &Passenger { ray, number, .. }: &Passenger,
        triangles: impl Iterator<Item = u32>,
    ) -> f32 {
        let prepared = PreparedRay::new(&self.questions.shot(number).ray);
        let best = &mut self.hits[number as usize];
        let mut end = ray.end;
        for triangle in triangles {
            // A triangle that was cut lies in several blocks.
            if best.is_none_or(|best| best.triangle != triangle)
                && let Some(hit) = self.questions.hit::<Q>(&prepared, triangle)
                && wins(&hit, best)
            {
                end = self.questions.bvh.frame.end(ray.moved, hit.distance);
                *best = Some(hit);
            }
        }
        end
    }

    #[cold]
    fn strand(&mut self, number: u32) {
        let Shot { ray, excluded } = self.questions.shot(number);
        self.hits[number as usize] = self.questions.bvh.closest_hit(ray, excluded);
    }
}

impl Voyage for Occlusion<'_> {
    #[inline(always)]
    fn embark(&mut self) -> Option<Passenger> {
        loop {
            let (number, framed) = self.questions.next()?;
            self.occluded[number as usize] = false;
            match framed {
                Framed::Ray(ray) => {
                    let excluded = self.questions.shot(number).excluded;
                    return Some(Passenger { ray, number, excluded });
                }
                Framed::Misses => {}
                Framed::TooFar => self.strand(number),
            }
        }
    }

    #[inline(always)]
    fn decide<Q: Quad>(
        &mut self,
        &Passenger { ray, number, .. }: &Passenger,
        mut triangles: impl Iterator<Item = u32>,
    ) -> f32 {
        let prepared = PreparedRay::new(&self.questions.shot(number).ray);
        let occluded =
            triangles.any(|triangle| self.questions.hit::<Q>(&prepared, triangle).is_some());
        self.occluded[number as usize] = occluded;
        if occluded { -1.0 } else { ray.end }
    }

    #[cold]
    fn strand(&mut self, number: u32) {
        let Shot { ray, excluded } = self.questions.shot(number);
        self.occluded[number as usize] = self.questions.bvh.is_occluded(ray, excluded);
    }
}
