//! Pixels by bidirectional paths.
//!
//! A pixel looks through its pinhole, over mirrors and through glass, at a first surface that
//! scatters. From there on all is as at a sensor point (`super`), with the light that this surface
//! sends to the camera in place of the illuminance: eye paths leave it, light vertices are joined
//! to it, and where scenes have narrow surfaces photons are counted on a disc around it. Light
//! without extent is asked for there, since nothing of it was computed.
//!
//! Read on at `light` for what serves all pixels, at `unit`, which traces some, at `camera_paths`
//! up to the first surface, and at `discs` for photons.

mod camera_paths;
mod discs;
mod light;
mod receivers;
mod unit;

use super::caps::PixelCaps;
use super::engine::Engine;
use super::eye_path::Sink;
use super::join_rate::JoinPilots;
use super::light_subpath::is_narrow;
use super::nearest_emitter::EmittingFacets;
use super::plan::Receiver;
use crate::context::Context;
use crate::control::watch::Watch;
use crate::spectrum::Spectrum;
use crate::stats::unseen::unseen_lx;
use crate::world::World;
use glam::DVec3;
use light::photons;
use receivers::largest_receiver;

pub(crate) use light::{MAX_PHOTONS, PictureLight};
pub(crate) use unit::PixelUnit;

/// Traces pixels.
pub(crate) struct PixelTracer<'a, S> {
    engine: Engine<'a, 'a, S>,
    pilots: JoinPilots<S>,
    /// Whether photons are counted: eye paths find all light of scenes without narrow surfaces.
    merges: bool,
    emitting: EmittingFacets<'a, S>,
    /// Receiver of places in the open.
    open: Receiver,
    caps: PixelCaps,
}

/// Receives the light that the paths of pixels find, in cd/m^2; sections are the pixels of a unit.
pub(crate) trait PixelSink<S>: Sink<S> {
    /// Tells that a path of a pixel came to a surface that scatters, where photons count on a disc
    /// of this area in m^2.
    fn arrive(&mut self, section: usize, disc_m2: f64);
}

impl<'a, S: Spectrum> PixelTracer<'a, S> {
    /// For a picture of this many pixels; `None` when the observer stopped it.
    pub(crate) fn new(
        context: &'a Context<'a, S>,
        pixels: usize,
        watch: &mut Watch<'_>,
    ) -> Option<Self> {
        let engine = Engine::new(context, &[], watch)?;
        let pilots = JoinPilots::trace(&engine);
        let merges = context.world.bsdfs().iter().any(is_narrow);
        let open = largest_receiver(&context.world, merges.then(|| photons(pixels)));
        let emitting = EmittingFacets::new(&context.world);
        Some(Self { caps: PixelCaps::new(&engine), engine, pilots, merges, emitting, open })
    }

    /// The radius in m of the discs that photons count on in the open; `None` where none count.
    pub(crate) fn disc_radius_m(&self) -> Option<f64> {
        self.open.radius_m.filter(|_| self.merges)
    }

    /// Light in cd/m^2 at most, with
    /// [`UNSEEN_CONFIDENCE`](crate::unseen::UNSEEN_CONFIDENCE), by ways on which none of this many
    /// paths lay, nor a photon on discs of this area at least.
    pub(crate) fn unseen_cd_m2(&self, paths: f64, disc_m2: f64) -> f64 {
        unseen_lx(self.caps.most_cd_m2(disc_m2), paths)
    }
}
