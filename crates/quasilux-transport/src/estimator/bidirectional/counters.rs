//! Photons that cross the disc of a sensor point, or a cell.
//!
//! A photon of the flux phi adds `phi / A`, weighed by the balance heuristic as the path that ends
//! where it crosses. Cells count the mean over themselves, as is asked; discs count the mean over
//! the disc for the value at their centre.

use super::arrival::{Arrival, Asks};
use super::boxes::BoxTree;
use super::engine::Engine;
use super::light_subpath::{LastVertex, Passing};
use super::plan::{JoinEdge, Receiver, favour};
use crate::lights::Asking;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::world::World;
use crate::world::flight::Flight;
use crate::world::grid_plane::GridPlane;
use crate::world::vertex::Vertex;
use glam::DVec3;
use std::ops::Range;

/// Sections of targets that photons may cross.
pub(super) struct Counters {
    boxes: BoxTree,
    things: Vec<Counter>,
}

enum Counter {
    Disc { section: usize },
    Cells(Box<Cells>),
}

/// Cells of a grid.
struct Cells {
    plane: GridPlane,
    behind: Option<GridPlane>,
    /// Cells that count, in ascending order, each with its section.
    sections: Vec<(usize, usize)>,
}

/// Light that a photon adds to a section.
pub(super) struct Crossing<S> {
    pub(super) section: usize,
    pub(super) light: S,
    pub(super) bounces: u32,
}

impl Counters {
    /// Of the sections with these receivers, in their order.
    pub(super) fn new<S>(world: &World<S>, receivers: &[&Receiver]) -> Self
    where
        S: Spectrum,
    {
        let (mut things, mut corners) = (Vec::new(), Vec::new());
        let mut section = 0;
        while let Some(receiver) = receivers.get(section) {
            match receiver.target {
                Target::Point { .. } => {
                    corners.push(receiver.corners_of_disc(world));
                    things.push(Counter::Disc { section });
                    section += 1;
                }
                Target::Cell { grid, .. } => {
                    let of_grid = cells_of_a_grid(receivers, section);
                    let plane = GridPlane::new(world, &grid);
                    let cell = |section: usize| match receivers[section].target {
                        Target::Cell { cell, .. } => cell,
                        Target::Point { .. } => 0,
                    };
                    let sections = of_grid.clone().map(|it| (cell(it), it)).collect();
                    let margin = 2.0 * world.hair_m();
                    let edges = [DVec3::ZERO, grid.u, grid.v, grid.u + grid.v];
                    let places = edges.map(|edge| grid.origin + edge);
                    let low = places.into_iter().fold(DVec3::INFINITY, DVec3::min) - margin;
                    let high = places.into_iter().fold(DVec3::NEG_INFINITY, DVec3::max) + margin;
                    corners.push([low, high]);
                    let behind = plane.behind();
                    things.push(Counter::Cells(Box::new(Cells { plane, behind, sections })));
                    section = of_grid.end;
                }
            }
        }
        Self { boxes: BoxTree::new(&corners), things }
    }

    /// Tells of all targets that a photon crosses on a flight.
    pub(super) fn cross<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        receivers: &[&Receiver],
        passing: &Passing<'_, S>,
        mut take: impl FnMut(Crossing<S>),
    ) {
        let flight = &passing.flight;
        if engine.context.max_bounces.is_some_and(|most| passing.bounces > most) {
            return;
        }
        self.boxes.on_segment(flight.from, flight.direction, flight.length_m, |thing| {
            let crossed = match &self.things[thing as usize] {
                Counter::Disc { section } => {
                    let along_m = receivers[*section].crossed_by(passing);
                    along_m.map(|along_m| Crossed { section: *section, along_m, tilt: 1.0 })
                }
                Counter::Cells(cells) => cells.crossed_by(flight),
            };
            let Some(Crossed { section, along_m, tilt }) = crossed else { return };
            let receiver = receivers[section];
            let from = engine.context.world.ray_origin_of_sensor(receiver.position, receiver.n);
            let vertex = &Vertex::sensor(from, receiver.n);
            let light = share(engine, receiver, vertex, passing, along_m) * tilt;
            receiver.assert_capped("a photon", light);
            take(Crossing { section, light, bounces: passing.bounces });
        });
    }
}

/// Where a photon crosses a target.
struct Crossed {
    section: usize,
    /// From the start of the flight.
    along_m: f64,
    /// Of a normal that is not that of the plane, the cosines over each other.
    tilt: f64,
}

impl Cells {
    /// The cell that a flight crosses, on the one side that counts or on the other.
    fn crossed_by(&self, flight: &Flight) -> Option<Crossed> {
        let mut planes = std::iter::once(&self.plane).chain(&self.behind);
        planes.find_map(|plane| {
            let cell = plane.cell(flight)?;
            let own = self.sections.binary_search_by_key(&cell, |(cell, _)| *cell).ok()?;
            let (section, tilt) = (self.sections[own].1, plane.tilt_factor(flight.direction));
            let along_m = plane.distance_m(flight);
            (tilt > 0.0).then_some(Crossed { section, along_m, tilt })
        })
    }
}

impl Receiver {
    /// Of a box around its disc.
    pub(super) fn corners_of_disc<S: Spectrum>(&self, world: &World<S>) -> [DVec3; 2] {
        // A disc reaches along an axis as far as that is in its plane.
        let reach = (DVec3::ONE - self.n * self.n).max(DVec3::ZERO);
        let reach = DVec3::new(reach.x.sqrt(), reach.y.sqrt(), reach.z.sqrt());
        let reach = reach * self.radius_m.unwrap_or_default() + world.hair_m();
        [self.position - reach, self.position + reach]
    }

    /// Where a photon crosses its disc from its front, with light that is not computed there.
    pub(super) fn crossed_by<S: Spectrum>(&self, passing: &Passing<'_, S>) -> Option<f64> {
        let &Flight { from, direction, length_m } = &passing.flight;
        let approach = self.n.dot(direction);
        if approach >= 0.0 || passing.is_computed_at_points() {
            return None;
        }
        let along_m = (self.position - from).dot(self.n) / approach;
        let part = self.straight_part(passing.is_straight_from_area());
        let square_m2 = self.radius_m? * self.radius_m? * part;
        let aside = from + direction * along_m - self.position;
        let is_on_way = 0.0 < along_m && along_m < length_m;
        (is_on_way && aside.length_squared() < square_m2).then_some(along_m)
    }
}

/// Light that a photon adds where it crosses: `vertex` is the place that measures.
pub(super) fn share<S: Spectrum>(
    engine: &Engine<'_, '_, S>,
    receiver: &Receiver,
    vertex: &Vertex<'_, S>,
    passing: &Passing<'_, S>,
    along_m: f64,
) -> S {
    let direction = passing.flight.direction;
    let position = passing.flight.from + direction * along_m;
    let cos = vertex.cos(-direction);
    let place = Asking { position, side: vertex.only_side(), own: vertex.facet() };
    let way_out = match vertex.surface() {
        None => engine.way_out_of_target(receiver, place),
        Some(surface) => engine.way_out(place, vertex.ray_origin(receiver.n), surface.bsdf),
    };
    let arrival = Arrival {
        way_out,
        n: receiver.n,
        along_m,
        direction,
        cos,
        asks: if receiver.is_cell() { Asks::AllPointlikes } else { Asks::One },
    };
    let weights = passing.weights_at(engine, &arrival);
    let (alone, is_narrow) = match passing.leg.last {
        LastVertex::Light => (1.0, false),
        LastVertex::Surface { is_narrow, .. } if passing.leg.is_asked_for() => (1.0, is_narrow),
        LastVertex::Surface { cos: cos_there, is_narrow } => {
            let distance_m = passing.distance_m(along_m);
            let square_m2 = distance_m * distance_m;
            let edge = JoinEdge { cos, cos_there, square_m2, is_narrow };
            (receiver.joins(&edge), is_narrow)
        }
    };
    let part = receiver.straight_part(passing.is_straight_from_area());
    let found_by = passing.found_by(engine);
    let photons = receiver.photons(is_narrow, found_by) * part;
    let eye_sr = way_out.survival_pdf_sr(engine, vertex, -direction, favour(0));
    let others = weights.times(alone, 1.0).towards(eye_sr);
    let weight = photons / (photons + others);
    let traced = receiver.traced(is_narrow, found_by);
    vertex.weight(-direction) * passing.flux_lm * (weight / (receiver.area_m2 * part * traced))
}

/// The sections that follow one of a cell with others of the same grid, in ascending order of
/// their cells.
fn cells_of_a_grid(receivers: &[&Receiver], first: usize) -> Range<usize> {
    let cell_after = |before: &Receiver, next: &Receiver| match (&before.target, &next.target) {
        (Target::Cell { grid: a, cell: m }, Target::Cell { grid: b, cell: n }) => {
            m < n
                && a.origin == b.origin
                && [a.u, a.v, a.normal] == [b.u, b.v, b.normal]
                && a.counts == b.counts
        }
        _ => false,
    };
    let pairs = receivers[first..].windows(2);
    let more = pairs.take_while(|pair| cell_after(pair[0], pair[1])).count();
    first..first + more + 1
}
