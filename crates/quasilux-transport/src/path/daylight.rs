//! What paths find outside, kept by the direction that it comes from: any sky and any sun can be
//! put there when they are over.

use crate::lights::{SunPlace, Suns};
use glam::DVec3;
use std::collections::VecDeque;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Whence {
    /// Sky or ground in this direction.
    Outside(DVec3),
    /// The same past mirrors, where nobody can ask for the sun.
    Mirrored(DVec3),
    /// One of the suns, asked for at a place.
    Sun(u32, SunPlace),
}

/// What a path found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FromOutside {
    pub(crate) whence: Whence,
    /// What its start gets in lx of 1 cd/m2 there, or of a sun of 1 lx.
    pub(crate) light: f64,
}

/// A path that keeps what it finds apart.
#[derive(Clone, Debug)]
pub(crate) struct Daylight<'p> {
    pub(crate) suns: &'p Suns,
    /// What it asked for and has not heard of, in order.
    asked: VecDeque<Whence>,
}

impl<'p> Daylight<'p> {
    pub(crate) fn new(suns: &'p Suns) -> Self {
        Self { suns, asked: VecDeque::new() }
    }

    pub(crate) fn note_asked(&mut self, whence: Whence) {
        self.asked.push_back(whence);
    }

    /// What the next answer is about: one of no light tells where no sun shines.
    pub(crate) fn answered(&mut self, light: Option<f64>) -> Option<FromOutside> {
        let whence = self.asked.pop_front()?;
        let light = light.or(self.suns.is_learning().then_some(0.0));
        light.map(|light| FromOutside { whence, light })
    }
}
