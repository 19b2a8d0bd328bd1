//! Photons from outside: lines that come into the scene, by one of up to four ways in.
//!
//! Light of the luminance L from direction w carries `L dA dw` through an area dA across it. Lines
//! that go through openings ([`super::apertures`]) are drawn through these; all others that come
//! into a box around the scene ([`super::hull`]) are drawn evenly over its silhouette, where a line
//! through an opening that came up is dropped. So each line belongs to one of the two, and openings
//! that stand elsewhere, or for a part, cost noise and no light. Either way directions of sky and
//! ground are drawn by a table of the luminance times the size of what they are drawn through
//! ([`super::directions`]), those of the sun over its disk. Every photon starts where its line
//! comes into the box, so whatever stands before an opening shades it.
//!
//! A photon carries `L S / p`, S being one over the density of its place across w and p that of the
//! direction in sr^-1: about the flux of its way in, over the number of photons. How many take each
//! way is of no matter to the mean. Through openings come as many as the flux is, as far as short
//! views tell that it gets there; of all others as many as the sensors see of the outside past the
//! openings, with a least share.

use super::apertures::Apertures;
use super::directions::DirectionTable;
use super::hull::Hull;
use super::views::{Views, view_past_openings};
use super::{OutsideLight, SunDisk};
use crate::spectrum::Spectrum;
use crate::world::World;
use glam::DVec3;
use quasilux_scene::{Scene, SensorShape};
use std::f64::consts::FRAC_1_PI;

/// The least share of the photons, where there are openings, for lines beside them, and the most.
const BESIDE_OPENINGS: [f64; 2] = [0.03, 0.9];
/// Light from outside gets this many times the photons of the lamps at most, and lamps as many
/// times those of it: either may be what the sensors see.
const MAX_BESIDE_LAMPS: f64 = 4.0;
/// Squares that count photons around sensor points reach so far at most, as a share of the scene.
const AROUND_SENSORS: f64 = 1.0 / 16.0;
/// Lines are followed from this many radii of the box.
const REACH: f64 = 4.0;

/// Light beside that from outside, and whether sensors count the photons.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beside {
    /// Whether photons are counted on their way at sensors, wherever these stand.
    pub(crate) counts_at_sensors: bool,
    /// Flux of the lamps.
    pub(crate) lamps_lm: f64,
}

/// How photons come in.
pub(crate) struct OutsidePhotons {
    hull: Hull,
    /// Openings that lines beside them must not go through.
    openings: Apertures,
    ways: Vec<WayIn>,
}

/// A photon where it comes in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OutsidePhoton {
    pub(crate) position: DVec3,
    /// Unit vector.
    pub(crate) direction: DVec3,
    /// Its flux over that of a photon of all lights.
    pub(crate) share: f64,
}

struct WayIn {
    gate: Gate,
    /// `None` of the sun.
    directions: Option<DirectionTable>,
    /// Flux by which photons are counted out to it: about what comes this way, or a share that
    /// suits better.
    counted_lm: f64,
}

/// Surfaces that lines are drawn through.
enum Gate {
    Hull,
    Openings(Apertures),
}

/// Luminance from a direction over the density that it was drawn with.
struct Shining {
    /// Where it comes from.
    towards: DVec3,
    lm_m2: f64,
}

impl OutsidePhotons {
    /// `None` where nothing shines, or on nothing.
    pub(crate) fn new<S: Spectrum>(
        outside: &OutsideLight<'_>,
        scene: &Scene,
        world: &World<S>,
        beside: Beside,
    ) -> Option<Self> {
        let hull = hull_of(scene, world, beside.counts_at_sensors)?;
        let corners = outside.portals.iter().flat_map(|portal| portal.corners.points());
        let distances_m = corners.map(|corner| corner.distance(hull.centre()));
        let reach_m = REACH * distances_m.fold(hull.radius_m(), f64::max);
        let views = Views::new(outside, world);
        let apertures = |openness: &[[f64; 2]]| Apertures::new(&outside.portals, openness, reach_m);
        let openings = apertures(&views.of_sky());
        let sun = outside.sun.as_ref();
        let mut ways: Vec<WayIn> = Vec::new();
        if outside.has_portals() {
            ways.extend(WayIn::of_sky(outside, Gate::Openings(apertures(&views.of_sky())), &hull));
            let of_sun = |sun: &SunDisk| {
                let gate = Gate::Openings(apertures(&views.of_sun(sun.direction)));
                WayIn::of_sun(sun, gate, &hull)
            };
            ways.extend(sun.and_then(of_sun));
        }
        let through_lm: f64 = ways.iter().map(|way| way.counted_lm).sum();
        let mut past: Vec<WayIn> = WayIn::of_sky(outside, Gate::Hull, &hull).into_iter().collect();
        past.extend(sun.and_then(|sun| WayIn::of_sun(sun, Gate::Hull, &hull)));
        if through_lm > 0.0 {
            let [least, most] = BESIDE_OPENINGS;
            let share = view_past_openings(outside, scene, world, &openings).clamp(least, most);
            scale_to(&mut past, through_lm * share / (1.0 - share));
        }
        ways.extend(past);
        let all_lm: f64 = ways.iter().map(|way| way.counted_lm).sum();
        if beside.lamps_lm > 0.0 {
            let [least, most] = [1.0 / MAX_BESIDE_LAMPS, MAX_BESIDE_LAMPS];
            scale_to(&mut ways, all_lm.clamp(least * beside.lamps_lm, most * beside.lamps_lm));
        }
        let shines = all_lm > 0.0 && all_lm.is_finite();
        shines.then_some(Self { hull, openings, ways })
    }

    /// By which photons are counted out to each way in, in lm.
    pub(crate) fn fluxes_lm(&self) -> impl Iterator<Item = f64> {
        self.ways.iter().map(|way| way.counted_lm)
    }

    /// A photon that comes in by one of the ways, its direction by `u` and its place by `v`; `None`
    /// for a line that belongs to another way, or passes by the scene.
    pub(crate) fn emit(
        &self,
        outside: &OutsideLight<'_>,
        way: usize,
        u: [f64; 2],
        v: [f64; 2],
    ) -> Option<OutsidePhoton> {
        let way = self.ways.get(way)?;
        let Shining { towards, lm_m2 } = match &way.directions {
            Some(table) => {
                let drawn = table.sample_direction(u);
                let lm_m2 = outside.luminance_cd_m2(drawn.direction) / drawn.pdf_sr;
                Shining { towards: drawn.direction, lm_m2 }
            }
            None => {
                let sun = outside.sun.as_ref()?;
                let lm_m2 = sun.luminance_cd_m2 * sun.solid_angle_sr;
                Shining { towards: sun.sample_direction(u), lm_m2 }
            }
        };
        let direction = -towards;
        let (position, size_m2) = match &way.gate {
            Gate::Hull => {
                let entry = self.hull.sample_entry(direction, v)?;
                let is_other = self.openings.is_crossed(entry, direction);
                let size_m2 = self.hull.silhouette_m2(direction);
                (!is_other).then_some((entry, size_m2))?
            }
            Gate::Openings(apertures) => {
                let line = apertures.sample_line(direction, v)?;
                (self.hull.entry(line.point, direction)?, line.per_density_m2)
            }
        };
        let share = lm_m2 * size_m2 / way.counted_lm;
        (share != 0.0).then_some(OutsidePhoton { position, direction, share })
    }
}

impl OutsidePhotons {
    /// Density in m^-2 sr^-1, across and over directions, of the photons of one way in along the
    /// line through a point with this direction; those of the sun or of the sky.
    pub(crate) fn pdf_line(&self, outside: &OutsideLight<'_>, way: usize, line: &Line) -> f64 {
        let way = &self.ways[way];
        let &Line { point, direction, of_sun } = line;
        let pdf_sr = match (&way.directions, of_sun) {
            (Some(table), false) => table.pdf_direction_sr(-direction),
            (None, true) => outside.sun_pdf_sr(-direction),
            _ => return 0.0,
        };
        let pdf_m2 = match &way.gate {
            Gate::Hull if self.openings.is_crossed(point, direction) => 0.0,
            Gate::Hull => self.hull.silhouette_m2(direction).recip(),
            Gate::Openings(apertures) => apertures.pdf_line(point, direction),
        };
        pdf_sr * pdf_m2
    }

    /// Whether the photons of a way in are those of the sun.
    pub(crate) fn is_sun(&self, way: usize) -> bool {
        self.ways[way].directions.is_none()
    }

    /// About the most flux in lm that a photon carries, where one in each is of this way.
    pub(crate) fn most_lm(&self, outside: &OutsideLight<'_>, way: usize) -> f64 {
        let way = &self.ways[way];
        let size_m2 = |direction: DVec3, within: f64| match &way.gate {
            Gate::Hull => self.hull.most_m2(direction, within),
            Gate::Openings(apertures) => apertures.most_m2(direction, within),
        };
        match (&way.directions, &outside.sun) {
            (Some(table), _) => DirectionTable::middles()
                .map(|towards| {
                    let lm_m2 = outside.luminance_cd_m2(towards) / table.pdf_direction_sr(towards);
                    lm_m2 * size_m2(-towards, 0.0)
                })
                .fold(0.0, f64::max),
            (None, Some(sun)) => {
                let radius = (sun.solid_angle_sr * FRAC_1_PI).sqrt();
                let lm_m2 = sun.luminance_cd_m2 * sun.solid_angle_sr;
                // The disk is that of a plane within a part in 10^5.
                lm_m2 * size_m2(-sun.direction, 1.001 * radius)
            }
            (None, None) => 0.0,
        }
    }
}

/// A line that light from outside comes along.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub(crate) point: DVec3,
    /// Unit vector in which the light goes.
    pub(crate) direction: DVec3,
    pub(crate) of_sun: bool,
}

impl WayIn {
    /// Of sky and ground; `None` where they are dark.
    fn of_sky(outside: &OutsideLight<'_>, gate: Gate, hull: &Hull) -> Option<Self> {
        let directions = DirectionTable::new(|towards| {
            outside.luminance_cd_m2(towards) * gate.about_m2(hull, -towards)
        })?;
        let counted_lm = directions.integral();
        Some(Self { gate, directions: Some(directions), counted_lm })
    }

    /// Of the sun; `None` where it comes in edge-on.
    fn of_sun(sun: &SunDisk, gate: Gate, hull: &Hull) -> Option<Self> {
        let counted_lm = sun.normal_illuminance_lx * gate.about_m2(hull, -sun.direction);
        (counted_lm > 0.0).then_some(Self { gate, directions: None, counted_lm })
    }
}

impl Gate {
    /// About the size of what lines of a direction are drawn through, in m^2.
    fn about_m2(&self, hull: &Hull, direction: DVec3) -> f64 {
        match self {
            Self::Hull => hull.silhouette_m2(direction),
            Self::Openings(apertures) => apertures.about_m2(direction),
        }
    }
}

/// Gives these ways so much flux together.
fn scale_to(ways: &mut [WayIn], counted_lm: f64) {
    let all_lm: f64 = ways.iter().map(|way| way.counted_lm).sum();
    if all_lm > 0.0 {
        ways.iter_mut().for_each(|way| way.counted_lm *= counted_lm / all_lm);
    }
}

/// The box around the geometry, and around the sensors where they count photons.
fn hull_of<S: Spectrum>(scene: &Scene, world: &World<S>, counts_at_sensors: bool) -> Option<Hull> {
    let geometry = world.bounds().into_iter().flatten();
    let around_m = AROUND_SENSORS * world.size_m();
    let sensors = scene.sensors.iter().filter(|_| counts_at_sensors);
    let counting = sensors.flat_map(|sensor| match &sensor.shape {
        SensorShape::Grid(grid) => {
            let [u, v] = [grid.u, grid.v];
            [DVec3::ZERO, u, v, u + v].map(|corner| grid.origin + corner).to_vec()
        }
        SensorShape::Points(points) => {
            let corners = [DVec3::splat(-around_m), DVec3::splat(around_m)];
            points.iter().flat_map(|point| corners.map(|by| point.position + by)).collect()
        }
    });
    Hull::around(geometry.chain(counting))
}
