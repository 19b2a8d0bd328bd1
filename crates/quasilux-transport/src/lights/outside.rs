//! Light from outside: sky, ground and sun, infinitely far away.
//!
//! A ray that leaves the scene finds the luminance of the sky or of the ground. Places indoors ask
//! for it through openings, too: one of their triangles is chosen by about what the sky gives
//! through it, a direction evenly over what is seen of it (`seen_triangle`). Both ways are weighed
//! by the power heuristic, so that an opening that stands somewhere else, or for a part, costs
//! noise and no light. The sun's disk is small: it is asked for, and found by rays alone that no
//! place could ask along. Of the pixels of a panorama those that are much brighter than the others
//! are asked for as often as openings are (`bright_sky`).
//!
//! How photons come in, see `photons`.

mod apertures;
mod directions;
mod hull;
mod photons;
mod portals;
#[cfg(test)]
mod tests;
mod views;

pub(crate) use directions::DrawnDirection;
pub(crate) use photons::{Beside, Line, OutsidePhoton, OutsidePhotons};

use crate::lights::bright_sky::BrightSky;
use crate::lights::seen_triangle::SeenTriangle;
use crate::lights::selection::{Asking, DEFENSIVE_SHARE};
use crate::spectrum::Spectrum;
use crate::world::frame::Frame;
use crate::world::vertex::Vertex;
use crate::world::visibility::LightSample;
use crate::world::{Facet, World};
use glam::DVec3;
use quasilux_bvh::{Corners, PreparedRay, Ray, intersect};
use quasilux_sampling::choose_weights;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use quasilux_scene::{Environment, Opening, Scene};
use quasilux_sky::solid_angle_of_the_sun_sr;
use std::f64::consts::{FRAC_1_PI, TAU};

/// Factor on [`OutsideLight::brightest_cd_m2`] for what may lie between the directions by which it
/// is looked up.
pub(crate) const SKY_MARGIN: f64 = 1.25;

/// The least cosine that counts: openings reach further than their centres.
const MIN_COSINE: f64 = 0.1;

/// The least luminance behind an opening that counts, over that of an even sky of the same
/// illuminance: openings show more than lies behind their centres.
const MIN_LUMINANCE: f64 = 0.1;

/// Of a portal that a place lies in, but for this part of the way to its corners, it sees nothing:
/// rounding alone would say on which side it is.
const MIN_HEIGHT: f64 = 1e-6;

/// The sky, the ground and the sun of a scene.
pub(crate) struct OutsideLight<'a> {
    environment: &'a Environment,
    /// Triangles of the openings.
    portals: Vec<Portal>,
    bright: Option<BrightSky<'a>>,
    sun: Option<SunDisk>,
    /// The least luminance that counts behind an opening.
    least_cd_m2: f64,
    /// A distance in m beyond everything.
    beyond_m: f64,
}

struct Portal {
    corners: Corners,
    n: DVec3,
}

struct SunDisk {
    frame: Frame,
    direction: DVec3,
    normal_illuminance_lx: f64,
    luminance_cd_m2: f64,
    solid_angle_sr: f64,
}

/// A direction in which a path goes on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnwardDirection {
    pub(crate) direction: DVec3,
    pub(crate) pdf_sr: f64,
    /// Cosine over density.
    pub(crate) weight: f64,
}

/// All portals as a place chooses among them, in their order; `None` for those edge-on or behind.
struct SeenPortals {
    portals: Vec<Option<Seen>>,
    /// The sum of the weights.
    total: f64,
}

/// A portal with about what comes through it.
struct Seen {
    triangle: SeenTriangle,
    weight: f64,
}

impl<'a> OutsideLight<'a> {
    /// `None` where nothing is outside.
    pub(super) fn new<S: Spectrum>(scene: &'a Scene, world: &World<S>) -> Option<Self> {
        let environment = scene.environment.as_ref()?;
        let named = environment.openings.iter().flat_map(Opening::triangles);
        let mut portals: Vec<[DVec3; 3]> = named.collect();
        if portals.is_empty() {
            let lets_through = |facet: &&Facet| world.bsdf_of(facet).lets_through();
            let panes = world.facets.iter().filter(lets_through);
            portals = panes.map(|facet| facet.corners()).collect();
        }
        let portals = portals::few(portals);
        let portals: Vec<Portal> = portals.into_iter().filter_map(Portal::new).collect();
        let bright = BrightSky::new(environment, !portals.is_empty());
        let sun =
            environment.sun.zip(environment.sun_direction()).map(|(sun, direction)| SunDisk {
                frame: Frame::around(direction),
                direction,
                normal_illuminance_lx: sun.normal_illuminance_lx,
                luminance_cd_m2: environment.sun_luminance_cd_m2(),
                solid_angle_sr: solid_angle_of_the_sun_sr(),
            });
        let far_m = world.bounds().map_or(0.0, |[low, high]| low.length().max(high.length()));
        let openings = environment.openings.iter();
        let far_m = openings.map(|it| it.origin.length()).fold(far_m, f64::max);
        let beyond_m = 1e3 * (far_m + world.size_m() + 1.0);
        let least_cd_m2 = MIN_LUMINANCE * (environment.horizontal_illuminance_lx() * FRAC_1_PI);
        Some(Self { environment, portals, bright, sun, least_cd_m2, beyond_m })
    }

    /// An illuminance in lx that is large for this scene.
    pub(super) fn reference_lx(&self) -> f64 {
        let of_sun = self.sun.as_ref().map_or(0.0, |sun| sun.normal_illuminance_lx);
        self.environment.horizontal_illuminance_lx() + of_sun
    }

    /// Whether its light may come straight to a place, were nothing in the way: where there are
    /// openings, through them.
    pub(crate) fn may_light(&self, place: Asking) -> bool {
        !self.has_portals() || self.seen(place).total > 0.0
    }

    /// Whether places ask for its light, through openings or in bright pixels.
    pub(crate) fn is_asked_for(&self) -> bool {
        !self.portals.is_empty() || self.bright.is_some()
    }

    /// Whether the openings are named, and not found.
    pub(crate) fn names_openings(&self) -> bool {
        !self.environment.openings.is_empty()
    }

    /// Whether the way from one place to another passes an opening.
    pub(crate) fn opens(&self, [from, to]: [DVec3; 2]) -> bool {
        let prepared = PreparedRay::new(&Ray::new(from, to - from));
        let passed = |portal: &Portal| intersect(&prepared, &portal.corners, 0);
        self.portals.iter().filter_map(passed).any(|hit| hit.distance <= 1.0)
    }

    /// How far in m a ray goes to the first opening in its way; `None` where there is none.
    pub(crate) fn opening_distance_m(&self, origin: DVec3, direction: DVec3) -> Option<f64> {
        let prepared = PreparedRay::new(&Ray::new(origin, direction));
        let met = |portal: &Portal| intersect(&prepared, &portal.corners, 0);
        self.portals.iter().filter_map(met).map(|hit| hit.distance).reduce(f64::min)
    }

    /// Whether there are openings.
    pub(crate) fn has_portals(&self) -> bool {
        !self.portals.is_empty()
    }

    /// Corners of the triangles that they ask through.
    pub(super) fn portal_corners(&self) -> impl Iterator<Item = [DVec3; 3]> {
        self.portals.iter().map(|portal| portal.corners.points())
    }

    /// A distance in m beyond everything.
    pub(crate) fn beyond_m(&self) -> f64 {
        self.beyond_m
    }

    /// Whether the disk of the sun shines.
    pub(crate) fn has_sun(&self) -> bool {
        self.sun.is_some()
    }

    /// Luminance in cd/m2 along a ray that leaves the scene, without the sun.
    pub(crate) fn luminance_cd_m2(&self, direction: DVec3) -> f64 {
        self.environment.luminance_cd_m2(direction)
    }

    /// The brightest that a ray finds, but for the sun, in the middle of small cells, in cd/m2.
    pub(crate) fn brightest_cd_m2(&self) -> f64 {
        let middles = directions::DirectionTable::middles();
        middles.map(|direction| self.luminance_cd_m2(direction)).fold(0.0, f64::max)
    }

    /// Luminance of the sun in cd/m2 along a ray that leaves the scene; 0 beside its disk.
    pub(crate) fn sun_cd_m2(&self, direction: DVec3) -> f64 {
        // One less the cosine of an angle is half of the squared chord.
        let chord_squared = |sun: &SunDisk| (direction - sun.direction).length_squared();
        let on_disk = |sun: &&SunDisk| 0.5 * TAU * chord_squared(sun) <= sun.solid_angle_sr;
        self.sun.as_ref().filter(on_disk).map_or(0.0, |sun| sun.luminance_cd_m2)
    }

    /// A direction to the disk of the sun, evenly over it.
    pub(crate) fn sample_sun(&self, u: [f64; 2]) -> Option<DVec3> {
        Some(self.sun.as_ref()?.sample_direction(u))
    }

    /// Density in sr^-1 of [`Self::sample_sun`].
    pub(crate) fn sun_pdf_sr(&self, direction: DVec3) -> f64 {
        let is_met = self.sun_cd_m2(direction) > 0.0;
        self.sun.as_ref().filter(|_| is_met).map_or(0.0, |sun| sun.solid_angle_sr.recip())
    }

    /// Luminance of the disk of the sun in cd/m^2, and what all of it gives on a plane across its
    /// rays in lx; 0 without one.
    pub(crate) fn sun_brightness(&self) -> [f64; 2] {
        self.sun
            .as_ref()
            .map_or([0.0; 2], |sun| [sun.luminance_cd_m2, sun.luminance_cd_m2 * sun.solid_angle_sr])
    }

    /// Direct light through one point of the openings or from a bright pixel, weighted against the
    /// direction in which the path goes on, which is drawn in the same way with some probability.
    pub(crate) fn light_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        onward_share: f64,
        u: [f64; 2],
    ) -> Option<LightSample<S>> {
        let place = Asking::at(vertex);
        let seen = self.seen(place);
        let direction = self.sample_direction(&seen, place, u)?;
        let cos = vertex.cos(direction);
        if cos <= 0.0 {
            return None;
        }
        let pdf_sr = self.pdf_of(&seen, place, direction);
        // At the very edge of a pixel rounding may find its neighbour.
        if pdf_sr <= 0.0 {
            return None;
        }
        let beside_sr = mixed(seen.share(onward_share), pdf_sr, vertex.pdf_sr(direction));
        let lx_sr = self.luminance_cd_m2(direction) * cos;
        let illuminance_lx = lx_sr / (pdf_sr + beside_sr * (beside_sr / pdf_sr));
        let light = vertex.weight(direction) * illuminance_lx;
        self.light_sample_of(direction, light, illuminance_lx)
    }

    /// A direction through one point of the openings or to a bright pixel.
    fn sample_direction(&self, seen: &SeenPortals, place: Asking, u: [f64; 2]) -> Option<DVec3> {
        match self.sample_bright(u) {
            Ok(direction) => Some(direction),
            Err(u) => self.sample_portal(seen, place, u),
        }
    }

    fn sample_portal(&self, seen: &SeenPortals, place: Asking, u: [f64; 2]) -> Option<DVec3> {
        let choice = choose_weights(u[0], seen.portals.iter().map(Seen::weight))?;
        let portal = seen.portals[choice.index].as_ref()?;
        let point = portal.triangle.sample_point([choice.u_remapped, u[1]]);
        Some((point - place.position).normalize_or_zero())
    }

    /// A direction in which a path goes on from a place with the side `n`: a share of them like
    /// those that [`Self::light_sample`] asks along, the others cosine-distributed. `None` for one
    /// that gives nothing.
    pub(crate) fn sample_onward(
        &self,
        place: Asking,
        n: DVec3,
        onward_share: f64,
        u: [f64; 2],
    ) -> Option<OnwardDirection> {
        let seen = self.seen(place);
        let share = seen.share(onward_share);
        let direction = if u[0] < share {
            self.sample_direction(&seen, place, [u[0] / share, u[1]])?
        } else {
            let u = [(u[0] - share) / (1.0 - share), u[1]];
            Frame::around(n).to_world(DVec3::from_array(sample_cosine_hemisphere(u)))
        };
        let cos = n.dot(direction).max(0.0);
        let asked_sr = self.pdf_of(&seen, place, direction);
        let pdf_sr = mixed(share, asked_sr, cos * FRAC_1_PI);
        (cos > 0.0).then_some(OnwardDirection { direction, pdf_sr, weight: cos / pdf_sr })
    }

    /// A direction through an opening, with its density in sr^-1.
    pub(crate) fn sample_through(&self, place: Asking, u: [f64; 2]) -> Option<DrawnDirection> {
        let seen = self.seen(place);
        let direction = self.sample_portal(&seen, place, u)?;
        let pdf_sr = self.pdf_through(&seen, place, direction);
        (pdf_sr > 0.0).then_some(DrawnDirection { direction, pdf_sr })
    }

    /// Density in sr^-1 of [`Self::sample_through`].
    pub(crate) fn through_pdf_sr(&self, place: Asking, direction: DVec3) -> f64 {
        // Most directions go through none, and then weights of openings do not matter.
        match self.opening_distance_m(place.position, direction) {
            Some(_) => self.pdf_through(&self.seen(place), place, direction),
            None => 0.0,
        }
    }

    /// A bright pixel that a sample with this coordinate asks for, by two more; else the coordinate
    /// for other ways of asking.
    pub(crate) fn sample_bright(&self, u: [f64; 2]) -> Result<DVec3, [f64; 2]> {
        let share = self.bright_share();
        match &self.bright {
            Some(bright) if u[0] < share => Ok(bright.sample([u[0] / share, u[1]])),
            _ => Err([(u[0] - share) / (1.0 - share), u[1]]),
        }
    }

    /// Density in sr^-1 of asking along a direction, where `other_sr` is that of other ways than by
    /// bright pixels.
    pub(crate) fn beside_bright_sr(&self, direction: DVec3, other_sr: f64) -> f64 {
        self.bright.as_ref().map_or(other_sr, |bright| {
            bright.share * bright.pdf_sr(direction) + (1.0 - bright.share) * other_sr
        })
    }

    /// Density in sr^-1 with which [`Self::light_sample`] asks along a direction.
    pub(crate) fn pdf_sr(&self, place: Asking, direction: DVec3) -> f64 {
        self.beside_bright_sr(direction, self.through_pdf_sr(place, direction))
    }

    /// The share of the samples that asks for bright pixels.
    fn bright_share(&self) -> f64 {
        self.bright.as_ref().map_or(0.0, |bright| bright.share)
    }

    /// Direct light from one point of the sun's disk.
    pub(crate) fn sun_sample<S: Spectrum>(
        &self,
        vertex: &Vertex<'_, S>,
        u: [f64; 2],
    ) -> Option<LightSample<S>> {
        let sun = self.sun.as_ref()?;
        let direction = sun.sample_direction(u);
        let cos = vertex.cos(direction);
        if cos <= 0.0 {
            return None;
        }
        let illuminance_lx = sun.luminance_cd_m2 * sun.solid_angle_sr * cos;
        let light = vertex.weight(direction) * illuminance_lx;
        self.light_sample_of(direction, light, illuminance_lx)
    }

    fn light_sample_of<S: Spectrum>(
        &self,
        direction: DVec3,
        light: S,
        illuminance_lx: f64,
    ) -> Option<LightSample<S>> {
        LightSample::unless_dark(direction, self.beyond_m, light, illuminance_lx)
    }

    /// The portals as a place sees them.
    fn seen(&self, place: Asking) -> SeenPortals {
        let see = |portal| self.seen_portal(portal, place);
        let mut portals: Vec<Option<Seen>> = self.portals.iter().map(see).collect();
        let total: f64 = portals.iter().map(Seen::weight).sum();
        let each = DEFENSIVE_SHARE * total / portals.iter().flatten().count().max(1) as f64;
        for seen in portals.iter_mut().flatten() {
            seen.weight = (1.0 - DEFENSIVE_SHARE) * seen.weight + each;
        }
        SeenPortals { portals, total }
    }

    fn seen_portal(&self, portal: &Portal, place: Asking) -> Option<Seen> {
        let corners = portal.corners.points();
        let is_behind = |n: DVec3| corners.iter().all(|it| n.dot(*it - place.position) <= 0.0);
        if place.side.is_some_and(is_behind) {
            return None;
        }
        let [a, b, c] = corners;
        let height_m = portal.n.dot(place.position - a);
        let far_m = corners.map(|corner| corner.distance(place.position));
        if height_m.abs() <= MIN_HEIGHT * far_m[0].max(far_m[1]).max(far_m[2]) {
            return None;
        }
        let side = height_m.signum();
        let triangle = SeenTriangle::new(corners, side * portal.n, place.position)?;
        let towards = ((a + b + c) / 3.0 - place.position).normalize_or_zero();
        let cos = place.side.map_or(1.0, |n| n.dot(towards).max(0.0) + MIN_COSINE);
        let cd_m2 = self.luminance_cd_m2(towards).max(self.least_cd_m2);
        let weight = triangle.solid_angle_sr() * cos * cd_m2;
        Some(Seen { triangle, weight })
    }

    /// Density in sr^-1 with which a place that sees the portals so asks along a direction.
    fn pdf_of(&self, seen: &SeenPortals, place: Asking, direction: DVec3) -> f64 {
        self.beside_bright_sr(direction, self.pdf_through(seen, place, direction))
    }

    /// Density in sr^-1 of a direction where a portal has been chosen.
    fn pdf_through(&self, seen: &SeenPortals, place: Asking, direction: DVec3) -> f64 {
        if seen.total <= 0.0 {
            return 0.0;
        }
        let ray = Ray::new(place.position, direction);
        let prepared = PreparedRay::new(&ray);
        let of_portal = |(portal, seen): (&Portal, &Option<Seen>)| {
            let seen = seen.as_ref()?;
            let distance_m = intersect(&prepared, &portal.corners, 0)?.distance;
            let per_m2 = distance_m * distance_m / portal.n.dot(direction).abs();
            Some(seen.weight * seen.triangle.pdf_m2(ray.at(distance_m)) * per_m2)
        };
        let all = self.portals.iter().zip(&seen.portals);
        all.filter_map(of_portal).sum::<f64>() / seen.total
    }
}

impl SeenPortals {
    /// The share of paths that go on through portals: none where none are seen.
    fn share(&self, onward_share: f64) -> f64 {
        if self.total > 0.0 { onward_share } else { 0.0 }
    }
}

/// A density of a mixture.
fn mixed(share: f64, pdf: f64, other: f64) -> f64 {
    share * pdf + (1.0 - share) * other
}

impl SunDisk {
    /// A direction to it, evenly over its solid angle.
    fn sample_direction(&self, u: [f64; 2]) -> DVec3 {
        let down = self.solid_angle_sr / TAU * u[0];
        let aside = (down * (2.0 - down)).sqrt();
        let (sin, cos) = libm::sincos(TAU * u[1]);
        self.frame.to_world(DVec3::new(aside * cos, aside * sin, 1.0 - down))
    }
}

impl Seen {
    fn weight(seen: &Option<Self>) -> f64 {
        seen.as_ref().map_or(0.0, |seen| seen.weight)
    }
}

impl Portal {
    /// `None` without area.
    fn new(corners: [DVec3; 3]) -> Option<Self> {
        let [a, b, c] = corners;
        let n = (b - a).cross(c - a).try_normalize()?;
        Some(Self { corners: Corners::new(corners), n })
    }

    fn area_m2(&self) -> f64 {
        let [a, b, c] = self.corners.points();
        0.5 * (b - a).cross(c - a).length()
    }
}
