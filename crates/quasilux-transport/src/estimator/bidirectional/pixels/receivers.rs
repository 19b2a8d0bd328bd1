//! What surfaces that pixels see take: how photons are counted around them, and joined to them.

use super::camera_paths::Seen;
use super::light::SUBPATHS;
use super::{DVec3, PixelTracer, Spectrum, World};
use crate::estimator::bidirectional::plan::{
    PhotonDisc, Receiver, around, largest_disc_m2, largest_radius_m, per_sure_before_pilots_m2,
};
use crate::importance::OpeningView;
use crate::path::path_batch::WorkCounts;
use crate::sensors::Target;
use crate::world::Interaction;
use quasilux_bvh::{Hit, RayQuery};

/// Directions in which walls are looked for in the plane of a disc.
const LOOKS: u32 = 16;

/// A place in the open, where this many photons of an index count that come from narrow surfaces;
/// its rate of joins holds until pilots know more.
pub(super) fn largest_receiver<S: Spectrum>(world: &World<S>, photons: Option<u64>) -> Receiver {
    Receiver {
        target: Target::Point { position: DVec3::ZERO, normal: DVec3::Z },
        position: DVec3::ZERO,
        n: DVec3::Z,
        area_m2: photons.map_or(0.0, |_| largest_disc_m2(world)),
        radius_m: Some(photons.map_or(0.0, |_| largest_radius_m(world))),
        near_part: 1.0,
        radiance_scale: 1.0,
        subpaths: SUBPATHS,
        photons: photons.unwrap_or(SUBPATHS),
        per_sure_m2: per_sure_before_pilots_m2(world),
        view: OpeningView::UNKNOWN,
        most_lx: f64::INFINITY,
    }
}

/// Surface that a path sees, with its receiver.
pub(super) struct SeenPlace<'p, S> {
    pub(super) seen: Seen<'p, S>,
    pub(super) receiver: Receiver,
}

impl<S: Spectrum> PixelTracer<'_, S> {
    /// Surfaces that paths see, with their receivers.
    pub(super) fn places<'p>(
        &self,
        per_sure_m2: f64,
        seen: Vec<Seen<'p, S>>,
        work: &mut WorkCounts,
    ) -> Vec<SeenPlace<'p, S>> {
        let world = &self.engine.context.world;
        let place = |seen: Seen<'p, S>| {
            let at = &seen.surface.at;
            let position = world.ray_origin(at).position();
            let target = Target::Point { position, normal: at.n };
            let receiver = Receiver { target, position, n: at.n, per_sure_m2, ..self.open.clone() };
            SeenPlace { seen, receiver }
        };
        let mut places: Vec<SeenPlace<'p, S>> = seen.into_iter().map(place).collect();
        if self.merges {
            self.shrink_discs(&mut places, work);
        }
        places
    }

    /// Discs end at walls, and are smaller for light straight from lights with an area near by.
    fn shrink_discs(&self, places: &mut [SeenPlace<'_, S>], work: &mut WorkCounts) {
        let context = self.engine.context;
        let world = &context.world;
        let queries = places.iter().flat_map(|place| {
            let at = &place.seen.surface.at;
            let from = world.ray_origin(at);
            around(at.n, LOOKS).map(move |direction| from.query(direction))
        });
        let queries: Vec<RayQuery> = queries.collect();
        let (mut hits, mut met) = (Vec::<Option<Hit>>::new(), Vec::<Option<Interaction>>::new());
        world.trace_all(&queries, &mut hits, &mut met);
        work.rays += queries.len() as u64;
        for (place, met) in places.iter_mut().zip(met.chunks_exact(LOOKS as usize)) {
            let receiver = &mut place.receiver;
            let distances_m = met.iter().flatten().map(|at| at.distance_m);
            let free_m = distances_m.fold(f64::INFINITY, f64::min);
            let (position, n) = (receiver.position, receiver.n);
            let disc = PhotonDisc::new(context, &self.emitting, position, n, free_m);
            receiver.radius_m = Some(disc.radius_m);
            (receiver.area_m2, receiver.near_part) = (disc.area_m2, disc.near_part);
        }
    }
}
