//! Shadow rays in batches: light samples wait in a queue until their visibility is known.
//!
//! Whoever may get light from a place says so with an [`LightSample`] and goes on with what does
//! not depend on it. The rays toward all these places are traced at once, in the order they were
//! asked for.

use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::panes::{Passage, transmittances};
use crate::world::vertex::Vertex;
use glam::DVec3;
use quasilux_bvh::RayQuery;

/// Direct light from a place on a light, unless something stands in the way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightSample<S> {
    /// Unit direction to the place on the light.
    pub(crate) direction: DVec3,
    pub(crate) distance_m: f64,
    /// The facet that the place lies on, [`RayQuery::NONE`] for none.
    pub(crate) facet: u32,
    /// The term of the path's estimate that depends on the visibility.
    pub(crate) light: S,
    /// Illuminance in lx that the light gives to the place, about what photons of it bring there.
    pub(crate) illuminance_lx: f64,
    /// Whether it is asked for through panes, too.
    pub(crate) through_panes: bool,
}

/// A place that requests direct light, and the number of who does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightRequest<'w, S> {
    pub(crate) who: u32,
    pub(crate) vertex: Vertex<'w, S>,
}

/// Questions that are open, and working space for their answers.
pub(crate) struct ShadowQueue<S> {
    /// Rays traced so far.
    pub(crate) rays: u64,
    shadow_rays: Vec<RayQuery>,
    questions: Vec<Question<S>>,
    visible: Vec<bool>,
    passages: Vec<Option<Passage<S>>>,
    /// Largest number of mirrors and panes in the way of the light that is asked for next.
    pub(crate) max_bounces: u32,
}

/// Light that a vertex requests, and gets if nothing stands in the way.
struct Question<S> {
    who: u32,
    light: S,
    /// How many of the rays, in their order, look along the way.
    shadow_rays: u32,
    /// How many mirrors the way leads over.
    mirrors: u32,
    /// Largest number of panes in the way, all together.
    max_panes: u32,
}

/// Outcome of a request for light.
pub(crate) struct Answer<S> {
    pub(crate) who: u32,
    pub(crate) light: S,
    /// Mirrors and panes on its way; `None` where something stands in it.
    pub(crate) bounces: Option<u32>,
}

impl<S: Copy> Question<S> {
    fn blocked(&self) -> Answer<S> {
        let &Self { who, light, .. } = self;
        Answer { who, light, bounces: None }
    }
}

impl<S: Spectrum> LightSample<S> {
    /// The offer of a place in the open; `None` where it is nothing.
    pub(crate) fn unless_dark(
        direction: DVec3,
        distance_m: f64,
        light: S,
        illuminance_lx: f64,
    ) -> Option<Self> {
        let (facet, through_panes) = (RayQuery::NONE, true);
        let light_sample =
            Self { direction, distance_m, facet, light, illuminance_lx, through_panes };
        // What is not a number counts: the tally must refuse it.
        (light.luminance() != 0.0).then_some(light_sample)
    }

    /// The offer where no light could be chosen: nothing shines here, or a distance of zero made a
    /// figure that the tally must refuse, whatever stands in the way.
    pub(crate) fn without_choice(total: f64) -> Option<Self> {
        (total != 0.0).then_some(Self {
            direction: DVec3::Z,
            distance_m: 0.0,
            facet: RayQuery::NONE,
            light: S::white() * f64::NAN,
            illuminance_lx: 0.0,
            through_panes: true,
        })
    }
}

impl<S> Default for ShadowQueue<S> {
    fn default() -> Self {
        Self {
            rays: 0,
            shadow_rays: Vec::new(),
            questions: Vec::new(),
            visible: Vec::new(),
            passages: Vec::new(),
            max_bounces: u32::MAX,
        }
    }
}

impl<S: Spectrum> ShadowQueue<S> {
    /// Notes that `who`, at `vertex`, gets the offer if nothing stands in the way.
    pub(crate) fn ask(&mut self, who: u32, vertex: &Vertex<'_, S>, light_sample: &LightSample<S>) {
        let from = vertex.ray_origin(light_sample.direction);
        self.shadow_rays.push(from.shadow_ray(
            light_sample.direction,
            light_sample.distance_m,
            light_sample.facet,
        ));
        let max_panes = if light_sample.through_panes { self.max_bounces } else { 0 };
        let light = light_sample.light;
        let (shadow_rays, mirrors) = (1, 0);
        let question = Question { who, light, shadow_rays, mirrors, max_panes };
        self.questions.push(question);
    }

    /// Notes that `who` gets this light if nothing stands in any of the rays that `look` adds, as
    /// they follow a way over this many mirrors to a light on this facet or on none. Paths run into
    /// facets that emit, behind mirrors and panes too: only other light is let through panes.
    pub(crate) fn push_polyline(
        &mut self,
        who: u32,
        light: S,
        mirrors: u32,
        facet: u32,
        look: impl FnOnce(&mut Vec<RayQuery>),
    ) {
        let before = self.shadow_rays.len();
        look(&mut self.shadow_rays);
        let shadow_rays = (self.shadow_rays.len() - before) as u32;
        let is_open = facet == RayQuery::NONE;
        let max_panes = if is_open { self.max_bounces.saturating_sub(mirrors) } else { 0 };
        let question = Question { who, light, shadow_rays, mirrors, max_panes };
        self.questions.push(question);
    }

    /// Tells `receive` who gets how much light after how many mirrors and panes, in the order
    /// asked, and closes all questions.
    pub(crate) fn answer(&mut self, world: &World<S>, mut receive: impl FnMut(u32, S, u32)) {
        self.answer_all(world, |Answer { who, light, bounces, .. }| {
            if let Some(bounces) = bounces {
                receive(who, light, bounces);
            }
        });
    }

    /// Tells `receive` the outcome of all questions, of blocked light too, in the order asked, and
    /// closes them.
    pub(crate) fn answer_all(&mut self, world: &World<S>, mut receive: impl FnMut(Answer<S>)) {
        self.rays += self.shadow_rays.len() as u64;
        if world.has_panes() {
            transmittances(world, &self.shadow_rays, &mut self.passages);
            let mut passages = self.passages.iter();
            for question in &self.questions {
                let open = Some(Passage { transmitted: question.light, panes: 0 });
                let own = passages.by_ref().take(question.shadow_rays as usize);
                let passage = own.fold(open, |way, next| way.zip(*next).map(|(a, b)| a.and(b)));
                let passage = passage.filter(|passage| passage.panes <= question.max_panes);
                receive(match passage {
                    Some(Passage { transmitted, panes }) => Answer {
                        who: question.who,
                        light: transmitted,
                        bounces: Some(question.mirrors + panes),
                    },
                    None => question.blocked(),
                });
            }
        } else {
            world.are_visible(&self.shadow_rays, &mut self.visible);
            let mut visible = self.visible.iter();
            for question in &self.questions {
                let own = visible.by_ref().take(question.shadow_rays as usize);
                let is_blocked = own.filter(|visible| !**visible).count() > 0;
                let blocked = question.blocked();
                let bounces = (!is_blocked).then_some(question.mirrors);
                receive(Answer { bounces, ..blocked });
            }
        }
        self.shadow_rays.clear();
        self.questions.clear();
    }
}
