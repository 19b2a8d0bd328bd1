//! The way of a path over plane mirrors or through panes, since the vertex that asked for the light
//! of area lights behind them.

use super::Path;
use crate::bsdf::BsdfSample;
use crate::context::Context;
use crate::lights::EmitterPlace;
use crate::spectrum::Spectrum;
use crate::world::Interaction;

/// Mirrors or panes that a path met one after the other, and nothing else since it last asked for
/// light.
pub(super) struct SpecularWay {
    /// Density in sr^-1 of the direction in which it left.
    pdf_sr: f64,
    /// Over all of them, in m.
    distance_m: f64,
    passed: Passed,
}

enum Passed {
    Nothing,
    /// Mirrors, by the numbers of their planes.
    Mirrors(Vec<u32>),
    Panes,
}

/// How the last vertex of a path asks for the place on an area light that it ran into.
#[derive(Default)]
pub(super) struct Asked {
    /// Density in m^-2 with which it does.
    pub(super) pdf_m2: f64,
    /// One over the density in m^-2 with which its direction there leads to it.
    pub(super) inverse_of_direction_m2: f64,
}

impl SpecularWay {
    /// At the vertex.
    pub(super) fn new(pdf_sr: f64) -> Self {
        Self { pdf_sr, distance_m: 0.0, passed: Passed::Nothing }
    }

    /// After one more specular surface, which mirrored it or let it straight through; `None` where
    /// it did neither, or where light by mirrors and panes in turn is not asked for.
    fn past<S: Spectrum>(
        self,
        context: &Context<'_, S>,
        at: &Interaction,
        is_mirrored: bool,
    ) -> Option<Self> {
        let passed = if is_mirrored {
            let plane = context.images.plane_of(at.facet)?;
            match self.passed {
                Passed::Nothing => Passed::Mirrors(vec![plane]),
                Passed::Mirrors(mut planes) => {
                    planes.push(plane);
                    Passed::Mirrors(planes)
                }
                Passed::Panes => return None,
            }
        } else {
            context.world.bsdf(at).straight_transmittance(1.0)?;
            match self.passed {
                Passed::Nothing | Passed::Panes => Passed::Panes,
                Passed::Mirrors(_) => return None,
            }
        };
        Some(Self { passed, distance_m: self.distance_m + at.distance_m, ..self })
    }
}

impl<S: Spectrum> Path<'_, S> {
    /// Whether it asks for images of area lights: not where it ends on a map, which holds their
    /// light.
    pub(super) fn asks_for_emitter_images(&self, context: &Context<'_, S>) -> bool {
        context.images.show_emitters() && self.is_on_no_map(context)
    }

    /// Whether it asks for the light of area lights through panes, by the same rule.
    pub(super) fn asks_for_emitters_through_panes(&self, context: &Context<'_, S>) -> bool {
        context.world.has_panes() && self.is_on_no_map(context)
    }

    fn is_on_no_map(&self, context: &Context<'_, S>) -> bool {
        match self.maps.end {
            None => true,
            // With a limit, only first surfaces are ends.
            Some(_) if context.max_bounces.is_some() => self.last.bounces_asked != 1,
            Some(_) => self.last.bounces_asked == 0,
        }
    }

    /// Where a specular way begins, if what is behind specular surfaces was asked for there.
    pub(super) fn specular_way(
        &self,
        context: &Context<'_, S>,
        pdf_sr: f64,
    ) -> Option<SpecularWay> {
        let asks =
            self.asks_for_emitter_images(context) || self.asks_for_emitters_through_panes(context);
        (asks && context.lights.emitters.is_some()).then(|| SpecularWay::new(pdf_sr))
    }

    /// Notes that it goes on from a surface, to what was drawn.
    pub(super) fn note_specular_way(
        &mut self,
        context: &Context<'_, S>,
        at: &Interaction,
        next: &BsdfSample<S>,
    ) {
        let way = self.last.specular_way.take();
        self.last.specular_way = match next.pdf_sr {
            Some(pdf_sr) => self.specular_way(context, pdf_sr),
            None => way.and_then(|way| way.past(context, at, next.wi.z > 0.0)),
        };
    }

    /// How its last vertex asks for the place on an area light that it came to over mirrors or
    /// through panes.
    pub(super) fn asked_past_specular(
        &self,
        context: &Context<'_, S>,
        at: &Interaction,
    ) -> Option<Asked> {
        let way = self.last.specular_way.as_ref()?;
        let pdf_m2 = match &way.passed {
            Passed::Nothing => return None,
            Passed::Panes => self.asked_m2(context, context.lights.emitters.as_ref()?, at),
            Passed::Mirrors(planes) => {
                let asked = EmitterPlace { facet: at.facet, position: at.position };
                let (world, planes) = (&context.world, planes.iter().rev().copied());
                context.images.asked_over_m2(world, planes, self.last.asked_from?, asked)?
            }
        };
        let distance_m = way.distance_m + at.distance_m;
        let cos = at.n.dot(self.direction).abs();
        let inverse_of_direction_m2 = distance_m * distance_m / (cos * way.pdf_sr);
        Some(Asked { pdf_m2, inverse_of_direction_m2 })
    }
}
