//! Photons on discs around the surfaces that pixels see.

use super::Spectrum;
use crate::estimator::bidirectional::boxes::BoxTree;
use crate::estimator::bidirectional::counters::share;
use crate::estimator::bidirectional::engine::Engine;
use crate::estimator::bidirectional::eye_path::Sink;
use crate::estimator::bidirectional::light_subpath::{KeptFlight, Passing};
use crate::estimator::bidirectional::pixels::camera_paths::Seen;
use crate::estimator::bidirectional::pixels::receivers::SeenPlace;
use crate::estimator::bidirectional::plan::Receiver;
use crate::world::vertex::{Surface, Vertex};

/// Discs of one index.
pub(super) struct Discs<'s, 'p, S> {
    boxes: BoxTree,
    discs: Vec<Disc<'s, 'p, S>>,
}

/// One side of the disc around a surface.
struct Disc<'s, 'p, S> {
    seen: &'s Seen<'p, S>,
    /// Whose front it is.
    receiver: Receiver,
}

impl<'s, 'p, S: Spectrum> Discs<'s, 'p, S> {
    pub(super) fn new(
        engine: &Engine<'_, '_, S>,
        places: impl Iterator<Item = &'s SeenPlace<'p, S>>,
    ) -> Self
    where
        'p: 's,
    {
        let world = &engine.context.world;
        let (mut discs, mut corners) = (Vec::new(), Vec::new());
        for SeenPlace { seen, receiver } in places {
            let at = &seen.surface.at;
            let mut add = |receiver: Receiver| {
                corners.push(receiver.corners_of_disc(world));
                discs.push(Disc { seen, receiver });
            };
            add(receiver.clone());
            if world.bsdf(at).transmits() {
                let position = world.ray_origin_behind(at).position();
                // Light vertices are joined to its front alone.
                let (n, per_sure_m2) = (-receiver.n, 0.0);
                add(Receiver { position, n, per_sure_m2, ..receiver.clone() });
            }
        }
        Self { boxes: BoxTree::new(&corners), discs }
    }

    /// Adds what the photons of their index give.
    pub(super) fn cross_all(
        &self,
        engine: &Engine<'_, '_, S>,
        flights: &[KeptFlight<S>],
        found: &mut dyn Sink<S>,
    ) {
        flights.iter().for_each(|kept| self.cross(engine, &kept.passing(), found));
    }

    fn cross(&self, engine: &Engine<'_, '_, S>, passing: &Passing<'_, S>, found: &mut dyn Sink<S>) {
        let context = engine.context;
        let flight = &passing.flight;
        self.boxes.on_segment(flight.from, flight.direction, flight.length_m, |disc| {
            let Disc { seen, receiver } = &self.discs[disc as usize];
            let Some(along_m) = receiver.crossed_by(passing) else { return };
            let first = &seen.surface;
            let bounces = first.bounces + 1 + passing.bounces;
            if context.max_bounces.is_some_and(|most| bounces > most) {
                return;
            }
            let surface = &Surface::new(&context.world, &first.at, first.direction);
            let vertex = &Vertex::on(&context.world, &first.at, surface, first.beta);
            let light = share(engine, receiver, vertex, passing, along_m);
            found.add_merged(seen.section, bounces, light);
        });
    }
}
