//! Vertex of a path as lights see it: a sensor point or a surface, with its cosine, BSDF value and
//! pdf.

use crate::bsdf::{Bsdf, TransportMode};
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::{Interaction, RayOrigin, World};
use glam::DVec3;
use std::f64::consts::FRAC_1_PI;

/// A place of a path as lights see it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex<'w, S> {
    from: RayOrigin,
    n: DVec3,
    /// Throughput from the start of the path to here, without the scattering here.
    beta: S,
    surface: Option<&'w Surface<'w, S>>,
}

/// A surface that a path meets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface<'w, S> {
    pub(crate) bsdf: &'w Bsdf<S>,
    pub(crate) frame: Frame,
    /// Direction that the path came from, in that frame.
    pub(crate) wo: DVec3,
    front: bool,
    /// Where light from the other side passes through.
    behind: Option<RayOrigin>,
}

impl<'w, S: Spectrum> Surface<'w, S> {
    /// Met along `direction`.
    #[inline(always)]
    pub(crate) fn new(world: &'w World<S>, at: &Interaction, direction: DVec3) -> Self {
        let bsdf = world.bsdf(at);
        let frame = world.frame(at);
        let behind = bsdf.transmits().then(|| world.ray_origin_behind(at));
        Self { bsdf, frame, wo: frame.to_local(-direction), front: at.front, behind }
    }
}

impl<'w, S: Spectrum> Vertex<'w, S> {
    /// The start of a path: a sensor point with the side `n`, where a lux counts as one.
    pub(crate) fn sensor(from: RayOrigin, n: DVec3) -> Self {
        Self { from, n, beta: S::white(), surface: None }
    }

    /// A place on a surface.
    #[inline]
    pub(crate) fn on(
        world: &World<S>,
        at: &Interaction,
        surface: &'w Surface<'w, S>,
        beta: S,
    ) -> Self {
        Self { from: world.ray_origin(at), n: at.n, beta, surface: Some(surface) }
    }

    /// The surface that it lies on; `None` for a sensor point.
    pub(crate) fn surface(&self) -> Option<&'w Surface<'w, S>> {
        self.surface
    }

    /// Whether paths start here.
    pub(crate) fn is_sensor(&self) -> bool {
        self.surface.is_none()
    }

    pub(crate) fn position(&self) -> DVec3 {
        self.from.position()
    }

    /// The place itself, the same from both sides of a surface that lets light through.
    pub(crate) fn place(&self) -> DVec3 {
        let behind = self.surface.and_then(|surface| surface.behind);
        behind.map_or(self.position(), |behind| 0.5 * (self.position() + behind.position()))
    }

    /// The facet that it lies on; `None` for a sensor point.
    pub(crate) fn facet(&self) -> Option<u32> {
        self.from.facet()
    }

    /// Whether it sends light from a direction back to the side that the path came from.
    pub(crate) fn reflects(&self, direction: DVec3) -> bool {
        !self.is_sensor() && self.n.dot(direction) > 0.0
    }

    /// A number for the side of the facet that the path met; `None` for a sensor point.
    pub(crate) fn facet_side(&self) -> Option<u32> {
        let front = u32::from(self.surface?.front);
        self.facet().map(|facet| 2 * facet + front)
    }

    /// The cosine that makes illuminance of what arrives from `direction`; not above 0 where
    /// nothing of it counts.
    pub(crate) fn cos(&self, direction: DVec3) -> f64 {
        let cos = self.n.dot(direction);
        if self.takes_both_sides() { cos.abs() } else { cos }
    }

    /// Whether light from behind counts.
    pub(crate) fn takes_both_sides(&self) -> bool {
        self.surface.is_some_and(|surface| surface.behind.is_some())
    }

    /// The normal on the only side where light counts; `None` where it counts on both.
    pub(crate) fn only_side(&self) -> Option<DVec3> {
        (!self.takes_both_sides()).then_some(self.n)
    }

    /// Weight, where the path starts, of each lux that arrives here from `direction`.
    pub(crate) fn weight(&self, direction: DVec3) -> S {
        match &self.surface {
            None => self.beta,
            Some(Surface { bsdf, frame, wo, front, .. }) => {
                let wi = frame.to_local(direction);
                self.beta * bsdf.evaluate(*wo, wi, *front, TransportMode::Radiance)
            }
        }
    }

    /// Whether [`Self::weight`] is the same for all directions on the only side.
    pub(crate) fn is_plain(&self) -> bool {
        self.surface.is_none_or(|surface| surface.bsdf.keeps_illuminance())
    }

    /// Density in sr^-1 with which a path goes on from here along `direction`.
    pub(crate) fn pdf_sr(&self, direction: DVec3) -> f64 {
        match &self.surface {
            None => self.n.dot(direction).max(0.0) * FRAC_1_PI,
            Some(Surface { bsdf, frame, wo, front, .. }) => {
                bsdf.pdf_sr(*wo, frame.to_local(direction), *front)
            }
        }
    }

    /// Density in sr^-1 of paths that go on from here along `direction`, survival in it.
    pub(crate) fn survival_pdf_sr(&self, direction: DVec3, favour: f64) -> f64 {
        match &self.surface {
            None => self.pdf_sr(direction),
            Some(Surface { bsdf, frame, wo, .. }) => {
                bsdf.survival_pdf_sr(*wo, frame.to_local(direction), favour)
            }
        }
    }

    /// Density in sr^-1 of light that arrives from `direction` and goes on toward the start of the
    /// path, survival in it; 0 at the start.
    pub(crate) fn reverse_survival_pdf_sr(&self, direction: DVec3) -> f64 {
        self.surface.as_ref().map_or(0.0, |Surface { bsdf, frame, wo, .. }| {
            bsdf.survival_pdf_sr(frame.to_local(direction), *wo, 1.0)
        })
    }

    /// Where a ray leaves from along `direction`.
    pub(crate) fn ray_origin(&self, direction: DVec3) -> RayOrigin {
        let behind = self.surface.and_then(|surface| surface.behind);
        behind.filter(|_| self.n.dot(direction) < 0.0).unwrap_or(self.from)
    }
}
