//! What paths find outside, kept by the direction that it comes from and by where it was reflected
//! last: any sky and any sun can be put there when they are over.

use crate::lights::{SunPlace, Suns};
use glam::DVec3;
use std::collections::VecDeque;

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum OutsideSource {
    /// Sky or ground in this direction.
    Outside(DVec3),
    /// Sky or ground in this direction past mirrors, where no vertex can ask for the sun.
    Mirrored(DVec3),
    /// One of the suns, asked for at a place.
    Sun(u32, SunPlace),
}

/// Where light was reflected last on its way to the start of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LastReflection {
    /// Nowhere: it comes straight from where it comes from, or through sheets.
    Nowhere,
    /// Beyond an opening, as the start sees it.
    Beyond,
    /// On this side of all openings.
    Within,
}

/// Light from outside that a path found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FromOutside {
    pub(crate) source: OutsideSource,
    pub(crate) reflection: LastReflection,
    /// Light in lx at its start for 1 cd/m2 there, or for a sun of 1 lx; for what shines there
    /// where the scene has its own sky.
    pub(crate) light: f64,
}

/// How paths keep what they find apart.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DaylightSearch<'p> {
    pub(crate) suns: &'p Suns,
    /// Whether light that was reflected within does not count: they end there.
    pub(crate) only_from_beyond: bool,
}

/// A path that keeps what it finds apart.
#[derive(Clone, Debug)]
pub(crate) struct Daylight<'p> {
    pub(crate) search: DaylightSearch<'p>,
    /// Whether it has passed an opening.
    is_beyond: bool,
    reflection: LastReflection,
    /// Requests for light that are not answered yet, in their order: the source, and the first
    /// reflection.
    asked: VecDeque<Asked>,
}

#[derive(Clone, Copy, Debug)]
struct Asked {
    source: OutsideSource,
    reflection: LastReflection,
}

impl<'p> Daylight<'p> {
    pub(crate) fn new(search: DaylightSearch<'p>) -> Self {
        let reflection = LastReflection::Nowhere;
        Self { search, is_beyond: false, reflection, asked: VecDeque::new() }
    }

    /// Passes an opening.
    pub(crate) fn pass_opening(&mut self) {
        self.is_beyond = true;
    }

    /// Leaves a surface on the side that it came to.
    pub(crate) fn reflect(&mut self) {
        self.reflection = self.after_reflection();
    }

    /// Where light was reflected last that this vertex reflects to it.
    fn after_reflection(&self) -> LastReflection {
        match self.reflection {
            LastReflection::Nowhere if self.is_beyond => LastReflection::Beyond,
            LastReflection::Nowhere => LastReflection::Within,
            known => known,
        }
    }

    /// Whether what a surface reflects would not count.
    pub(crate) fn leaves_reflected(&self) -> bool {
        self.search.only_from_beyond && self.after_reflection() == LastReflection::Within
    }

    /// Light from outside that it finds where it leaves the scene.
    pub(crate) fn found(&self, source: OutsideSource, light: f64) -> FromOutside {
        FromOutside { source, reflection: self.reflection, light }
    }

    /// Asks for light; `is_reflected` where it would be reflected here.
    pub(crate) fn note_asked(&mut self, source: OutsideSource, is_reflected: bool) {
        let reflection = if is_reflected { self.after_reflection() } else { self.reflection };
        self.asked.push_back(Asked { source, reflection });
    }

    /// Light of the oldest request that is not answered yet. Blocked light is 0 while it is learnt
    /// where the suns shine, else `None`.
    pub(crate) fn answered(&mut self, light: Option<f64>) -> Option<FromOutside> {
        let Asked { source, reflection } = self.asked.pop_front()?;
        let light = light.or(self.search.suns.is_learning().then_some(0.0));
        light.map(|light| FromOutside { source, reflection, light })
    }
}
