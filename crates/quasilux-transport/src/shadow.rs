//! Light that waits for its visibility: many questions are asked first and answered together.
//!
//! Whoever may get light from a place says so with an [`Offer`] and goes on with what does not depend on
//! it. The rays toward all these places are traced at once, in the order they were asked for.

use crate::spectrum::Spectrum;
use crate::world::{Vantage, World};
use glam::DVec3;
use quasilux_bvh::Shot;

/// What a light gives to one side of a surface unless something stands in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Offer {
    /// Unit direction from the surface to the place on the light.
    pub(crate) direction: DVec3,
    pub(crate) distance_m: f64,
    /// The facet that the place lies on, [`Shot::NONE`] for none.
    pub(crate) facet: u32,
    /// The part of an estimate of the illuminance that hangs on the visibility.
    pub(crate) illuminance_lx: f64,
}

/// Somebody who asks for light on one side of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asker {
    pub(crate) who: u32,
    pub(crate) from: Vantage,
    pub(crate) n: DVec3,
}

/// Questions that are open, and working space for their answers.
#[derive(Default)]
pub(crate) struct Shadows {
    /// Rays traced so far.
    pub(crate) rays: u64,
    sights: Vec<Shot>,
    questions: Vec<Question>,
    visible: Vec<bool>,
}

/// Light that somebody gets if nothing stands in the way.
struct Question {
    who: u32,
    illuminance_lx: f64,
}

impl Offer {
    /// The offer of a place in the open; `None` where it is nothing.
    pub(crate) fn unless_dark(
        direction: DVec3,
        distance_m: f64,
        illuminance_lx: f64,
    ) -> Option<Self> {
        let offer = Self { direction, distance_m, facet: Shot::NONE, illuminance_lx };
        (illuminance_lx != 0.0).then_some(offer)
    }

    /// The offer where no light could be chosen: nothing shines here, or a distance of zero made a
    /// figure that the tally must refuse, whatever stands in the way.
    pub(crate) fn without_choice(total_lx: f64, n: DVec3) -> Option<Self> {
        (total_lx != 0.0).then_some(Self {
            direction: n,
            distance_m: 0.0,
            facet: Shot::NONE,
            illuminance_lx: f64::NAN,
        })
    }
}

impl Shadows {
    /// Notes that `who`, at `from`, gets the offer if nothing stands in the way.
    pub(crate) fn ask(&mut self, who: u32, from: Vantage, offer: &Offer) {
        self.sights.push(from.sight(offer.direction, offer.distance_m, offer.facet));
        self.questions.push(Question { who, illuminance_lx: offer.illuminance_lx });
    }

    /// Tells `receive` who gets how much light in lx, in the order asked, and closes all questions.
    pub(crate) fn answer<S: Spectrum>(
        &mut self,
        world: &World<S>,
        mut receive: impl FnMut(u32, f64),
    ) {
        world.are_visible(&self.sights, &mut self.visible);
        for (question, visible) in self.questions.iter().zip(&self.visible) {
            if *visible {
                receive(question.who, question.illuminance_lx);
            }
        }
        self.rays += self.sights.len() as u64;
        self.sights.clear();
        self.questions.clear();
    }
}
