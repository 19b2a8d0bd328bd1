//! What counts photons for the sensors: grids as virtual planes, map elements under sensor points,
//! and small squares around those in the air.

use crate::photon::map::MapLayout;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::world::flight::Flight;
use crate::world::frame::Frame;
use crate::world::grid_plane::GridPlane;
use crate::world::{Interaction, World};
use glam::DVec3;
use quasilux_scene::sensor::Grid;
use quasilux_scene::{Light, Quantity, Scene, SensorPoint, SensorShape};
use std::f64::consts::{SQRT_2, TAU};

/// Marks elements that no sensor reads.
const UNREAD: u32 = u32::MAX;
/// Directions in which a square looks for surfaces that it must not reach through.
const DIRECTIONS: u32 = 32;
/// Its corners come so near to them, as a share of their distance.
const AS_NEAR: f64 = 0.9;
/// Its edges are at most this share of the distance to the nearest light: light of a point in front
/// differs by 0.5 % from the middle to the mean.
const BESIDE_LIGHT: f64 = 1.0 / 8.0;
/// They are at least this many hairs.
const MIN_HAIRS: f64 = 8.0;

/// Grids and map elements that count photons, the same for all replicates.
pub(crate) struct Receivers {
    grids: Vec<GridReceiver>,
    layout: MapLayout,
    /// Whether a sensor reads an element of the facet: most facets have none, and the table of
    /// elements is too large for the caches.
    reads_facet: Vec<bool>,
    /// The counter that an element feeds, or [`UNREAD`].
    counter_of_element: Vec<u32>,
    /// For each target, in order: the counter it reads and the area behind it in m^2.
    pub(crate) targets: Vec<(u32, f64)>,
    pub(crate) counters: usize,
}

/// A grid as photons see it.
struct GridReceiver {
    plane: GridPlane,
    first_counter: usize,
}

impl Receivers {
    pub(crate) fn new<S: Spectrum>(world: &World<S>, scene: &Scene, settings: &Settings) -> Self {
        let layout = MapLayout::new(world, settings);
        let mut receivers = Self {
            grids: Vec::new(),
            reads_facet: vec![false; world.facets.len()],
            counter_of_element: vec![UNREAD; layout.len()],
            layout,
            targets: Vec::new(),
            counters: 0,
        };
        for sensor in &scene.sensors {
            match &sensor.shape {
                SensorShape::Grid(grid) => receivers.add_grid(world, grid),
                SensorShape::Points(points) => {
                    let longest_m = MapLayout::longest_edge_m(world, settings);
                    for point in points {
                        let to_light_m = distance_to_light_m(world, scene, point.position);
                        let edge_m = longest_m.min(BESIDE_LIGHT * to_light_m);
                        let under = world.facet_under(point.position, point.normal);
                        match under.filter(|at| world.bsdf(at).keeps_illuminance()) {
                            Some(at) => receivers.add_element(&at),
                            None => receivers.add_grid(world, &square(world, point, edge_m)),
                        }
                    }
                }
            }
        }
        receivers
    }

    fn add_grid<S: Spectrum>(&mut self, world: &World<S>, grid: &Grid) {
        let plane = GridPlane::new(world, grid);
        let cell_area_m2 = plane.cell_area_m2();
        self.grids.push(GridReceiver { plane, first_counter: self.counters });
        let first = self.counters as u32;
        self.targets.extend((0..grid.cells() as u32).map(|cell| (first + cell, cell_area_m2)));
        self.counters += grid.cells();
    }

    /// The map element under a sensor point.
    fn add_element(&mut self, at: &Interaction) {
        self.reads_facet[at.facet as usize] = true;
        let place = self.layout.locate(at);
        let counter = &mut self.counter_of_element[place.element];
        if *counter == UNREAD {
            *counter = self.counters as u32;
            self.counters += 1;
        }
        self.targets.push((*counter, place.area_m2));
    }

    /// The counters of the grids that a flight passes through.
    pub(crate) fn passed<'s>(&'s self, flight: &'s Flight) -> impl Iterator<Item = usize> + 's {
        let cell = |grid: &'s GridReceiver| Some(grid.first_counter + grid.plane.cell(flight)?);
        self.grids.iter().filter_map(cell)
    }

    /// The counter of the map element that a photon lands on, if a sensor reads it.
    pub(crate) fn landed_on(&self, at: &Interaction) -> Option<usize> {
        if !self.reads_facet[at.facet as usize] {
            return None;
        }
        let counter = self.counter_of_element[self.layout.locate(at).element];
        (counter != UNREAD).then_some(counter as usize)
    }
}

/// A square around a sensor point, with edges of `edge_m`, or as small as the surfaces beside it
/// leave room for: no photon behind a wall is to be counted.
fn square<S: Spectrum>(world: &World<S>, point: &SensorPoint, edge_m: f64) -> Grid {
    let &SensorPoint { position, normal } = point;
    let frame = Frame::around(normal);
    let from = world.ray_origin_of_sensor(position, normal);
    let surfaces_m = (0..DIRECTIONS).filter_map(|step| {
        let (sin, cos) = libm::sincos(TAU * f64::from(step) / f64::from(DIRECTIONS));
        let surface = world.trace(from, frame.to_world(DVec3::new(cos, sin, 0.0)))?;
        Some((surface.position - from.position()).length())
    });
    let fits_m = surfaces_m.map(|distance_m| SQRT_2 * AS_NEAR * distance_m).fold(edge_m, f64::min);
    let edge_m = fits_m.max(MIN_HAIRS * world.hair_m());
    let [u, v] = [DVec3::X, DVec3::Y].map(|edge| frame.to_world(edge) * edge_m);
    let origin = position - (u + v) / 2.0;
    let quantity = Quantity::Mean;
    Grid { origin, u, v, counts: [1, 1], normal, quantity, target_lx: None }
}

/// Distance to the nearest light: to its position, or to a corner of its facets or their middle.
fn distance_to_light_m<S: Spectrum>(world: &World<S>, scene: &Scene, from: DVec3) -> f64 {
    let nearest = |light: &Light| match light {
        Light::Point(light) => light.position.distance(from),
        Light::Luminaire(light) => light.position.distance(from),
        Light::Area(light) => {
            let facets = light.triangles.iter().map(|&facet| &world.facets[facet as usize]);
            let places = facets
                .flat_map(|facet| facet.corners().into_iter().chain([facet.point([1.0 / 3.0; 3])]));
            places.map(|place| place.distance(from)).fold(f64::INFINITY, f64::min)
        }
    };
    scene.lights.iter().map(nearest).fold(f64::INFINITY, f64::min)
}
