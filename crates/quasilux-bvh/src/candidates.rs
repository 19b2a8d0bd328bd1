//! Triangles that a ray may hit, until it is known which of them are worth a decision.
//!
//! A decision takes double precision and often a trip to memory. Most rays meet several triangles
//! in front of which a nearer one turns up later, so all decisions wait until the end.

use std::mem::MaybeUninit;

/// A triangle, and the distance in the frame before which it cannot be hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate {
    pub(crate) triangle: u32,
    pub(crate) earliest: f32,
}

/// As many candidates as most rays ever have.
const ROOM: usize = 16;

/// Candidates that await their decision.
pub(crate) struct Candidates {
    candidates: [MaybeUninit<Candidate>; ROOM],
    count: usize,
    /// The least of their distances.
    first: f32,
    /// Candidates for which there was no room.
    more: Vec<Candidate>,
}

impl Candidates {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self {
            candidates: [MaybeUninit::uninit(); ROOM],
            count: 0,
            first: f32::INFINITY,
            more: Vec::new(),
        }
    }

    /// Adds a candidate that cannot be hit behind `latest`, infinite if it may not be hit at all;
    /// one that is hit for sure before all others takes their place.
    #[inline(always)]
    pub(crate) fn push(&mut self, candidate: Candidate, latest: f32) {
        if self.count == ROOM {
            self.make_room();
        }
        let alone = latest < self.first;
        let earlier = alone | (candidate.earliest < self.first);
        self.count = if alone { 0 } else { self.count };
        self.first = if earlier { candidate.earliest } else { self.first };
        self.candidates[self.count % ROOM].write(candidate);
        self.count += 1;
    }

    /// Takes out the candidate that was added last.
    #[inline(always)]
    pub(crate) fn pop(&mut self) -> Option<Candidate> {
        if self.count == 0 {
            return self.more.pop();
        }
        self.count -= 1;
        // SAFETY: everything below `count` was written.
        Some(unsafe { self.candidates[self.count % ROOM].assume_init() })
    }

    #[cold]
    #[inline(never)]
    fn make_room(&mut self) {
        while self.count > 0 {
            self.count -= 1;
            // SAFETY: everything below `count` was written.
            self.more.push(unsafe { self.candidates[self.count].assume_init() });
        }
    }
}
