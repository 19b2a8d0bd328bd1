//! Many rays at once: the same answers as one by one, sooner.

use crate::frame::Framed;
use crate::group::{Answers, Group, Pace, Parted, Party, Run};
use crate::intersect::intersect_with;
use crate::lanes::Quad;
use crate::stream::{Passenger, Voyage};
use crate::triangle_bvh::wins;
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
        self.answer(shots, hits);
    }

    /// [`Self::is_occluded`] of each of `shots`, in their order.
    ///
    /// # Panics
    /// If there are not as many answers as `shots`, or more than 2^32 of them.
    pub fn are_occluded(&self, shots: &[Shot], occluded: &mut [bool]) {
        self.answer(shots, occluded);
    }

    /// Answers runs of shots that belong together as groups, and all others alone.
    fn answer<A: Answer>(&self, mut shots: &[Shot], mut answers: &mut [A]) {
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
                    let cost = group.answer(self.kernel, party, A::of_group(now));
                    pace.learn(count, cost);
                    cost
                }
                Run::Alone(_) => Err(Parted),
            };
            if cost.is_err() {
                self.tree.stream(self.kernel, &mut Alone::new(self, &shots[..count], now));
            }
            (shots, answers) = (&shots[count..], later);
        }
    }
}

/// Rays that fly alone, and where their answers go.
struct Alone<'a, A> {
    bvh: &'a TriangleBvh,
    shots: &'a [Shot],
    answers: &'a mut [A],
    next: u32,
}

/// What is asked of a ray: the closest hit, or whether there is any.
trait Answer: Copy {
    /// The answer of a ray that hits nothing.
    const NOTHING: Self;

    /// The answer of a ray by itself.
    fn of(bvh: &TriangleBvh, shot: &Shot) -> Self;

    /// Where the answers of a group go.
    fn of_group(answers: &mut [Self]) -> Answers<'_>;

    /// Takes account of a hit and says where the search for others ends, if that has changed.
    fn take(&mut self, hit: Hit, end: impl Fn(f64) -> f32) -> Option<f32>;

    /// Whether a triangle can still change the answer.
    fn needs(&self, triangle: u32) -> bool;
}

impl<'a, A: Answer> Alone<'a, A> {
    fn new(bvh: &'a TriangleBvh, shots: &'a [Shot], answers: &'a mut [A]) -> Self {
        assert!(u32::try_from(shots.len()).is_ok(), "too many rays for 32-bit indices");
        Self { bvh, shots, answers, next: 0 }
    }
}

impl<A: Answer> Voyage for Alone<'_, A> {
    #[inline(always)]
    fn embark(&mut self) -> Option<Passenger> {
        loop {
            let number = self.next;
            let shot = self.shots.get(number as usize)?;
            self.next += 1;
            self.answers[number as usize] = A::NOTHING;
            match self.bvh.frame.ray(&shot.ray) {
                Framed::Ray(ray) => {
                    return Some(Passenger { ray, number, excluded: shot.excluded });
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
    fn strand(&mut self, number: u32) {
        self.answers[number as usize] = A::of(self.bvh, &self.shots[number as usize]);
    }
}

impl Answer for Option<Hit> {
    const NOTHING: Self = None;

    fn of(bvh: &TriangleBvh, shot: &Shot) -> Self {
        bvh.closest_hit(&shot.ray, &shot.excluded)
    }

    fn of_group(answers: &mut [Self]) -> Answers<'_> {
        Answers::Closest(answers)
    }

    #[inline(always)]
    fn take(&mut self, hit: Hit, end: impl Fn(f64) -> f32) -> Option<f32> {
        wins(&hit, self).then(|| {
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
    const NOTHING: Self = false;

    fn of(bvh: &TriangleBvh, shot: &Shot) -> Self {
        bvh.is_occluded(&shot.ray, &shot.excluded)
    }

    fn of_group(answers: &mut [Self]) -> Answers<'_> {
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
