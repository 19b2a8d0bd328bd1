//! Batches of rays: the same results as one query at a time, in less time.

use crate::frame::Framed;
use crate::group::{Answers, Diverged, GroupSize, GroupTracer, RayGroup, RayRun};
use crate::intersect::intersect_with;
use crate::lanes::Quad;
use crate::stream::{ActiveRay, RaySource};
use crate::{Hit, PreparedRay, RayQuery, TriangleBvh};

impl TriangleBvh {
    /// [`Self::closest_hit`] of each of `shots`, in their order.
    ///
    /// Shots that follow each other in nearly the same direction from nearly the same place are
    /// traced together.
    ///
    /// # Panics
    /// If there are not as many `hits` as `shots`, or more than 2^32 of them.
    pub fn closest_hit_batch(&self, shots: &[RayQuery], hits: &mut [Option<Hit>]) {
        self.answer(shots, hits);
    }

    /// [`Self::is_occluded`] of each of `shots`, in their order.
    ///
    /// # Panics
    /// If there are not as many answers as `shots`, or more than 2^32 of them.
    pub fn occluded_batch(&self, shots: &[RayQuery], occluded: &mut [bool]) {
        self.answer(shots, occluded);
    }

    /// Answers runs of shots that belong together as groups, and all others alone.
    fn answer<A: Answer>(&self, mut shots: &[RayQuery], mut answers: &mut [A]) {
        assert_eq!(shots.len(), answers.len(), "as many answers as questions");
        let mut tracer = GroupTracer::new();
        let mut group_size = GroupSize::new();
        while !shots.is_empty() {
            let run = match group_size.take_pause() {
                0 => RayRun::first(shots, &self.frame, group_size.most()),
                pause => RayRun::Incoherent(pause.min(shots.len())),
            };
            let (RayRun::Coherent(count, _) | RayRun::Incoherent(count)) = run;
            let (now, later) = answers.split_at_mut(count);
            let cost = match run {
                RayRun::Coherent(_, heading) => {
                    let (tree, frame) = (&self.tree, &self.frame);
                    let group = RayGroup { tree, frame, heading, shots: &shots[..count] };
                    let cost = tracer.answer(self.simd, group, A::for_group(now));
                    group_size.learn(count, cost);
                    cost
                }
                RayRun::Incoherent(_) => Err(Diverged),
            };
            if cost.is_err() {
                self.tree.stream(self.simd, &mut SingleRays::new(self, &shots[..count], now));
            }
            (shots, answers) = (&shots[count..], later);
        }
    }
}

/// Rays that fly alone, and where their answers go.
struct SingleRays<'a, A> {
    bvh: &'a TriangleBvh,
    shots: &'a [RayQuery],
    answers: &'a mut [A],
    next: u32,
}

/// Answer that is asked of a ray: the closest hit, or whether there is any.
trait Answer: Copy {
    /// The answer of a ray that hits nothing.
    const MISS: Self;

    /// The answer of a ray by itself.
    fn trace_one(bvh: &TriangleBvh, shot: &RayQuery) -> Self;

    /// Where the answers of a group go.
    fn for_group(answers: &mut [Self]) -> Answers<'_>;

    /// Takes account of a hit and says where the search for others ends, if that has changed.
    fn take(&mut self, hit: Hit, end: impl Fn(f64) -> f32) -> Option<f32>;

    /// Whether a triangle can still change the answer.
    fn needs(&self, triangle: u32) -> bool;
}

impl<'a, A: Answer> SingleRays<'a, A> {
    fn new(bvh: &'a TriangleBvh, shots: &'a [RayQuery], answers: &'a mut [A]) -> Self {
        assert!(u32::try_from(shots.len()).is_ok(), "too many rays for 32-bit indices");
        Self { bvh, shots, answers, next: 0 }
    }
}

impl<A: Answer> RaySource for SingleRays<'_, A> {
    #[inline(always)]
    fn next_ray(&mut self) -> Option<ActiveRay> {
        loop {
            let number = self.next;
            let shot = self.shots.get(number as usize)?;
            self.next += 1;
            self.answers[number as usize] = A::MISS;
            match self.bvh.frame.ray(&shot.ray) {
                Framed::Ray(ray) => {
                    return Some(ActiveRay { ray, number, excluded: shot.excluded });
                }
                Framed::Misses => {}
                Framed::TooFar => self.trace_alone(number),
            }
        }
    }

    #[inline(always)]
    fn decide<Q: Quad>(
        &mut self,
        &ActiveRay { ray, number, .. }: &ActiveRay,
        triangles: impl Iterator<Item = u32>,
    ) -> f32 {
        let prepared = PreparedRay::new(&self.shots[number as usize].ray);
        let answer = &mut self.answers[number as usize];
        let mut end = ray.end;
        for triangle in triangles {
            // SAFETY: the triangles of a valid tree exist.
            let corners = unsafe { self.bvh.tree.corners.get_unchecked(triangle as usize) };
            if answer.needs(triangle)
                && let Some(hit) = intersect_with::<Q>(&prepared, corners, triangle)
                && let Some(new) = answer.take(hit, |t| self.bvh.frame.end(ray.moved, t))
            {
                end = new;
            }
        }
        end
    }

    #[cold]
    fn trace_alone(&mut self, number: u32) {
        self.answers[number as usize] = A::trace_one(self.bvh, &self.shots[number as usize]);
    }
}

impl Answer for Option<Hit> {
    const MISS: Self = None;

    fn trace_one(bvh: &TriangleBvh, shot: &RayQuery) -> Self {
        bvh.closest_hit(&shot.ray, &shot.excluded)
    }

    fn for_group(answers: &mut [Self]) -> Answers<'_> {
        Answers::Closest(answers)
    }

    #[inline(always)]
    fn take(&mut self, hit: Hit, end: impl Fn(f64) -> f32) -> Option<f32> {
        hit.precedes(self).then(|| {
            *self = Some(hit);
            end(hit.distance)
        })
    }

    /// One that was cut lies in several blocks.
    #[inline(always)]
    fn needs(&self, triangle: u32) -> bool {
        self.is_none_or(|best| best.triangle != triangle)
    }
}

impl Answer for bool {
    const MISS: Self = false;

    fn trace_one(bvh: &TriangleBvh, shot: &RayQuery) -> Self {
        bvh.is_occluded(&shot.ray, &shot.excluded)
    }

    fn for_group(answers: &mut [Self]) -> Answers<'_> {
        Answers::Occluded(answers)
    }

    #[inline(always)]
    fn take(&mut self, _hit: Hit, _end: impl Fn(f64) -> f32) -> Option<f32> {
        *self = true;
        Some(-1.0)
    }

    #[inline(always)]
    fn needs(&self, _triangle: u32) -> bool {
        !*self
    }
}
