//! Ways out of places: where they ask for light from outside, and eye paths that are led to
//! openings.
//!
//! Where surfaces outside hide the sky from an opening, its light comes by these surfaces, which
//! eye paths meet no more often than the opening is large. So a part of them is led: with the
//! probability a they go through an opening, with the density q of asking there, else as the
//! surface scatters, with p. Through openings they go on for certain; elsewhere with the density
//! `min((1 - a) p, favour f cos)`. No surface leads more than half of what it absorbs, `a <= (1 -
//! rho) / 2`, so none of the others carries more than it came with, and paths end. Sheets that
//! scatter stand behind openings, too: paths are led to a closed shade.
//!
//! How many are led, and which part of what a place asks goes through openings, says a survey
//! ([`crate::importance::OpeningViews`]): both are functions of the place alone.

use super::engine::Engine;
use super::plan::Receiver;
use crate::bsdf::{Bsdf, BsdfSample, TransportMode};
use crate::importance::OpeningView;
use crate::lights::{Asking, DrawnDirection, OutsideLight};
use crate::spectrum::Spectrum;
use crate::world::RayOrigin;
use crate::world::frame::Frame;
use crate::world::vertex::{Surface, Vertex};
use glam::DVec3;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use std::f64::consts::FRAC_1_PI;

/// The part of the eye paths that are led where surfaces stand behind all openings, and nothing is
/// seen of the sky beside them.
const LED: f64 = 0.5;
/// The part of what surfaces absorb that they lead at most: with all of it paths would not end
/// between a room and a closed shutter.
const SPARE: f64 = 0.5;

/// Where a place asks for light from outside, and how many paths it leads there.
#[derive(Clone, Copy)]
pub(super) struct WayOut {
    pub(super) place: Asking,
    /// The part of what it asks that goes through openings.
    through: f64,
    /// The part of the paths that are led.
    led: f64,
}

/// Paths that are led, along a direction.
#[derive(Clone, Copy, Default)]
pub(super) struct Led {
    share: f64,
    /// Density in sr^-1 of those that are led.
    pdf_sr: f64,
}

/// A direction that a path is to take, with those that are led along it.
struct DrawnWay {
    direction: DVec3,
    led: Led,
}

/// A direction in which a path goes on, if it survives.
pub(super) struct OnwardSample<S> {
    pub(super) next: BsdfSample<S>,
    pub(super) led: Led,
}

/// The part of the paths that a target leads. It absorbs nothing, so all others carry as much more
/// as they are fewer.
pub(super) fn led_at_target(view: OpeningView) -> f64 {
    LED * view.surfaces_behind
}

impl<S: Spectrum> Engine<'_, '_, S> {
    /// Of a place on a surface. Rays leave it from `from`, by which eye paths and light subpaths
    /// look up the same cell.
    pub(super) fn way_out(&self, place: Asking, from: RayOrigin, bsdf: &Bsdf<S>) -> WayOut {
        let Some(n) = place.side.filter(|_| self.openings.are_known()) else {
            return WayOut { place, through: 1.0, led: 0.0 };
        };
        let view = self.openings.at(from.position(), n);
        let world = &self.context.world;
        let absorbed = |facet: u32| 1.0 - world.most_survives_at(&world.facets[facet as usize]);
        let spare = match bsdf {
            Bsdf::Diffuse(_) => SPARE * place.own.map_or(0.0, absorbed).max(0.0),
            _ => 0.0,
        };
        WayOut { place, through: view.through, led: (LED * view.surfaces_behind).min(spare) }
    }

    /// Of a target, at a place in it.
    pub(super) fn way_out_of_target(&self, receiver: &Receiver, place: Asking) -> WayOut {
        WayOut { place, through: receiver.view.through, led: led_at_target(receiver.view) }
    }

    /// Of the place where a path begins.
    pub(super) fn way_out_of_start(&self, receiver: &Receiver, start: &Vertex<'_, S>) -> WayOut {
        let place = Asking::at(start);
        match start.surface() {
            None => self.way_out_of_target(receiver, place),
            Some(surface) => self.way_out(place, start.ray_origin(receiver.n), surface.bsdf),
        }
    }

    fn outside(&self) -> &OutsideLight<'_> {
        self.context.lights.outside.as_ref().expect("only places that see outside lead there")
    }
}

impl WayOut {
    /// A direction to ask along for sky and ground.
    pub(super) fn sample_asked(
        &self,
        outside: &OutsideLight<'_>,
        u: [f64; 2],
    ) -> Option<DrawnDirection> {
        let (direction, through_sr) = match (outside.sample_bright(u), self.place.side) {
            (Ok(direction), _) => (direction, outside.through_pdf_sr(self.place, direction)),
            (Err(u), Some(n)) if u[0] >= self.through => {
                let u = [(u[0] - self.through) / (1.0 - self.through), u[1]];
                let around = sample_cosine_hemisphere(u);
                let direction = Frame::around(n).to_world(DVec3::from_array(around));
                (direction, outside.through_pdf_sr(self.place, direction))
            }
            (Err(u), _) => {
                let u = [u[0] / self.through, u[1]];
                let DrawnDirection { direction, pdf_sr } = outside.sample_through(self.place, u)?;
                (direction, pdf_sr)
            }
        };
        let pdf_sr = self.mixed_sr(outside, direction, through_sr);
        // At the very edge of a pixel rounding may find its neighbour.
        (pdf_sr > 0.0).then_some(DrawnDirection { direction, pdf_sr })
    }

    /// Density in sr^-1 of [`Self::sample_asked`].
    pub(super) fn asked_sr(&self, outside: &OutsideLight<'_>, direction: DVec3) -> f64 {
        self.mixed_sr(outside, direction, outside.through_pdf_sr(self.place, direction))
    }

    /// Density of asking along a direction that has this density among those through openings.
    fn mixed_sr(&self, outside: &OutsideLight<'_>, direction: DVec3, through_sr: f64) -> f64 {
        let open_sr = match self.place.side {
            Some(n) if self.through < 1.0 => {
                (1.0 - self.through) * n.dot(direction).max(0.0) * FRAC_1_PI
            }
            _ => 0.0,
        };
        outside.beside_bright_sr(direction, self.through * through_sr + open_sr)
    }

    /// A direction in which paths go on from a target, its density in sr^-1; `None` where one is
    /// led behind it.
    pub(super) fn sample_start<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        n: DVec3,
        u: [f64; 2],
    ) -> Option<DrawnDirection> {
        let DrawnWay { direction, led } = if u[0] < self.led {
            self.sample_led(engine, [u[0] / self.led, u[1]])?
        } else {
            let u = [(u[0] - self.led) / (1.0 - self.led), u[1]];
            let around = Frame::around(n).to_world(DVec3::from_array(sample_cosine_hemisphere(u)));
            DrawnWay { direction: around, led: self.led(engine, around) }
        };
        let cos = n.dot(direction);
        let pdf_sr = led.mixed_sr(cos * FRAC_1_PI);
        (cos > 0.0).then_some(DrawnDirection { direction, pdf_sr })
    }

    /// A direction in which a path goes on from a surface.
    pub(super) fn sample_onward<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        surface: &Surface<'_, S>,
        front: bool,
        sampler: &mut Sampler<'_>,
    ) -> Option<OnwardSample<S>> {
        let &Surface { bsdf, frame, wo, .. } = surface;
        if self.led == 0.0 {
            let next = bsdf.sample(wo, front, TransportMode::Radiance, sampler)?;
            return Some(OnwardSample { next, led: Led::default() });
        }
        let (wi, led) = if sampler.choose_bool(self.led) {
            let DrawnWay { direction, led } = self.sample_led(engine, sampler.next_2d())?;
            (frame.to_local(direction), led)
        } else {
            let wi = bsdf.sample(wo, front, TransportMode::Radiance, sampler)?.wi;
            (wi, self.led(engine, frame.to_world(wi)))
        };
        let pdf_sr = led.mixed_sr(bsdf.pdf_sr(wo, wi, front));
        let weight = bsdf.evaluate(wo, wi, front, TransportMode::Radiance) * (wi.z.abs() / pdf_sr);
        Some(OnwardSample { next: BsdfSample { wi, weight, pdf_sr: Some(pdf_sr) }, led })
    }

    /// A direction through an opening.
    fn sample_led<S: Spectrum>(&self, engine: &Engine<'_, '_, S>, u: [f64; 2]) -> Option<DrawnWay> {
        let DrawnDirection { direction, pdf_sr } =
            engine.outside().sample_through(self.place, u)?;
        Some(DrawnWay { direction, led: Led { share: self.led, pdf_sr } })
    }

    /// Paths that are led along a direction.
    pub(super) fn led<S: Spectrum>(&self, engine: &Engine<'_, '_, S>, direction: DVec3) -> Led {
        if self.led == 0.0 {
            return Led::default();
        }
        Led { share: self.led, pdf_sr: engine.outside().through_pdf_sr(self.place, direction) }
    }

    /// Density in sr^-1 of paths that go on from a vertex here along a direction, survival in it.
    pub(super) fn survival_pdf_sr<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        vertex: &Vertex<'_, S>,
        direction: DVec3,
        favour: f64,
    ) -> f64 {
        match vertex.surface() {
            _ if self.led == 0.0 => vertex.survival_pdf_sr(direction, favour),
            None => self.start_pdf_sr(engine, vertex.cos(direction), direction),
            Some(Surface { bsdf, frame, wo, .. }) => {
                let wi = frame.to_local(direction);
                self.led(engine, direction).survival_pdf_sr(bsdf, *wo, wi, favour)
            }
        }
    }

    /// Density in sr^-1 of [`Self::sample_start`] at a direction with this cosine.
    pub(super) fn start_pdf_sr<S: Spectrum>(
        &self,
        engine: &Engine<'_, '_, S>,
        cos: f64,
        direction: DVec3,
    ) -> f64 {
        if cos > 0.0 { self.led(engine, direction).mixed_sr(cos * FRAC_1_PI) } else { 0.0 }
    }
}

impl Led {
    fn mixed_sr(self, scattered_sr: f64) -> f64 {
        (1.0 - self.share) * scattered_sr + self.share * self.pdf_sr
    }

    /// The chance to go on over the light that is left, where that is no more than a certainty.
    pub(super) fn favour(self, favour: f64) -> f64 {
        if self.share * self.pdf_sr > 0.0 { f64::MAX } else { favour }
    }

    /// Density in sr^-1 of paths that go on along `wi` after `wo`, survival in it.
    pub(super) fn survival_pdf_sr<S: Spectrum>(
        self,
        bsdf: &Bsdf<S>,
        wo: DVec3,
        wi: DVec3,
        favour: f64,
    ) -> f64 {
        if self.share == 0.0 {
            return bsdf.survival_pdf_sr(wo, wi, favour);
        }
        let side = 1.0_f64.copysign(wo.z);
        let (wo, wi) = (wo * side, wi * side);
        let scattered = bsdf.evaluate(wo, wi, true, TransportMode::Importance).max_channel();
        let mixed_sr = self.mixed_sr(bsdf.pdf_sr(wo, wi, true));
        mixed_sr.min(self.favour(favour) * (scattered * wi.z.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::context::{Context, Stream};
    use crate::control::watch::Watch;
    use crate::estimator::bidirectional::light_subpath::way_out as light_way_out;
    use crate::estimator::bidirectional::surveyed::survey;
    use crate::importance::LookingPlace;
    use crate::scenes::{diffuse, points, room};
    use crate::sensors::targets;
    use crate::settings::Settings;
    use crate::world::Interaction;
    use quasilux_scene::{Environment, Opening, Scene};
    use quasilux_sky::{Distribution, Sky, SkyLevel};
    use quasilux_stats::SplitMix64;
    use std::f64::consts::PI;

    const SAMPLES: u64 = 1 << 15;

    /// A grey cube with an opening in place of the wall y = 0, before a wall as high, under an even
    /// sky.
    fn scene() -> Scene {
        let mut scene = room(DVec3::splat(3.0), diffuse(0.6));
        scene.mesh.triangles.drain(8..10);
        let first = scene.mesh.positions.len() as u32;
        let corners = [[-3.0, 0.0], [6.0, 0.0], [6.0, 3.0], [-3.0, 3.0]];
        scene.mesh.positions.extend(corners.map(|[x, z]| DVec3::new(x, -2.0, z)));
        scene.mesh.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        let opening = Opening { origin: DVec3::ZERO, u: DVec3::X * 3.0, v: DVec3::Z * 3.0 };
        let level = SkyLevel::ZenithLuminance { cd_m2: 100.0 };
        scene.environment = Some(Environment {
            sky: Sky::new(Distribution::uniform(), level).unwrap(),
            sun: None,
            ground_reflectance: 0.2,
            north_deg: 0.0,
            openings: vec![opening],
        });
        scene.sensors = vec![points("points", &[(DVec3::new(1.5, 1.0, 0.8), DVec3::Z)])];
        scene
    }

    /// Runs a test on the engine of that scene after its survey.
    fn with_engine(test: impl Fn(&Engine<'_, '_, f64>)) {
        let (scene, settings) = (scene(), Settings::default());
        let context: Context<'_, f64> = Context::new(&scene, &settings);
        let mut nobody = ();
        let watch = &mut Watch::new(&mut nobody);
        let targets = targets(&scene);
        let mut engine = Engine::new(&context, &targets, watch).expect("nobody stops it");
        survey(&mut engine, &targets, watch).expect("nobody stops it");
        test(&engine);
    }

    /// A place on the floor of the room, on its back wall, and on the wall outside.
    fn places(engine: &Engine<'_, '_, f64>) -> [Interaction; 3] {
        let world = &engine.context.world;
        let meet = |from: DVec3, direction: DVec3| {
            let from = world.ray_origin_of_sensor(from, direction);
            world.trace(from, direction).expect("a surface is there")
        };
        let inside = DVec3::new(1.4, 1.3, 1.2);
        [
            meet(inside, DVec3::NEG_Z),
            meet(inside, DVec3::Y),
            meet(DVec3::new(-1.3, -1.0, 1.9), DVec3::NEG_Y),
        ]
    }

    fn way_out(engine: &Engine<'_, '_, f64>, at: &Interaction) -> WayOut {
        let place = Asking { position: at.position, side: Some(at.n), own: Some(at.facet) };
        let world = &engine.context.world;
        engine.way_out(place, world.ray_origin(at), world.bsdf(at))
    }

    /// The mean of values within 4.5 standard errors.
    fn assert_mean(what: &str, values: impl Iterator<Item = f64>, expected: f64) {
        let values: Vec<f64> = values.collect();
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        let error = squares.sum::<f64>().sqrt() / n;
        assert!(
            (mean - expected).abs() <= 4.5 * error,
            "{what}: {mean} +- {error}, not {expected}"
        );
        assert!(error < 0.05, "{what}: +- {error}");
    }

    #[test]
    fn rooms_ask_through_openings_and_walls_outside_the_open_sky() {
        with_engine(|engine| {
            let [floor, back, outside] = places(engine).map(|at| way_out(engine, &at));
            let of_all = [floor, back, outside].map(|it| [it.through, it.led]);
            assert!(floor.through == 1.0 && back.through == 1.0, "{of_all:?}");
            assert!(floor.led > 0.05 && back.led > 0.1, "{of_all:?}");
            assert!(outside.through < 0.2 && outside.led < 0.05, "{of_all:?}");
            assert!([floor, back, outside].iter().all(|it| it.led <= 0.2 + 1e-12));
            let receiver = &engine.receivers[0];
            let from = engine.context.world.ray_origin_of_sensor(receiver.position, receiver.n);
            let place = |_| LookingPlace { from, n: receiver.n };
            let look =
                |looks| OpeningView::look(engine.context, Stream::Survey(5), 0, place, looks);
            let (few, many) = (receiver.view, look(1 << 10).view);
            assert!((few.surfaces_behind - many.surfaces_behind).abs() < 0.25, "{few:?}, {many:?}");
            assert!(many.through == 1.0 && many.surfaces_behind > 0.1, "{many:?}");
        });
    }

    /// Eye paths and light subpaths that come to one place by other rays, on walls that lie in
    /// borders of cells: the room's area makes edges of 3/16 m.
    #[test]
    fn both_kinds_of_subpaths_look_up_the_same_cell() {
        with_engine(|engine| {
            let (world, mut random) = (&engine.context.world, SplitMix64::new(5));
            let mut compared = 0;
            let mut inside = || DVec3::new(random.uniform(), random.uniform(), random.uniform());
            for _ in 0..2000 {
                let (from, to) = (inside() * 2.8 + 0.1, inside() * 2.8 + 0.1);
                let meet = |from: DVec3, direction: DVec3| {
                    world.trace(world.ray_origin_of_sensor(from, direction), direction)
                };
                let Some(met) = meet(from, (to - from).normalize()) else { continue };
                let other = inside() * 2.8 + 0.1;
                let Some(again) = meet(other, (met.position - other).normalize()) else { continue };
                let is_same = met.facet == again.facet && met.front == again.front;
                if is_same && met.position.distance(again.position) < 1e-9 {
                    let bsdf = world.bsdf(&met);
                    let surface = &Surface::new(world, &met, (to - from).normalize());
                    let vertex = &Vertex::on(world, &met, surface, 1.0);
                    let eye = engine.way_out(Asking::at(vertex), world.ray_origin(&met), bsdf);
                    let light = light_way_out(engine, &again, bsdf);
                    assert_eq!((eye.through, eye.led), (light.through, light.led), "{met:?}");
                    compared += 1;
                }
            }
            assert!(compared > 500, "{compared}");
        });
    }

    /// 2^15 directions at random over the sphere: a density that is 20 % off is found.
    #[test]
    fn the_density_of_asking_is_one_in_all() {
        with_engine(|engine| {
            let outside = engine.outside();
            let mut random = SplitMix64::new(3);
            for at in places(engine) {
                let way_out = way_out(engine, &at);
                let density = |_| {
                    let z = 2.0 * random.uniform() - 1.0;
                    let (sin, cos) = libm::sincos(2.0 * PI * random.uniform());
                    let level = (1.0 - z * z).sqrt();
                    4.0 * PI * way_out.asked_sr(outside, DVec3::new(level * cos, level * sin, z))
                };
                assert_mean("asking", (0..SAMPLES).map(density), 1.0);
            }
        });
    }

    /// Surfaces and targets send on what they scatter, counted by its weight: all of it, and the
    /// part toward y < 0, which is a half on floors.
    #[test]
    fn paths_that_are_led_carry_what_surfaces_scatter() {
        with_engine(|engine| {
            let points = engine.context.points(0, Stream::Survey(9));
            let sampler = |index| Sampler::new(&points, index);
            let [floor, ..] = places(engine);
            let world = &engine.context.world;
            let surface = &Surface::new(world, &floor, floor.n * -1.0);
            let way_out = way_out(engine, &floor);
            let sampled =
                |index| way_out.sample_onward(engine, surface, floor.front, &mut sampler(index));
            let weight = |of: fn(DVec3) -> bool| {
                move |onward: Option<OnwardSample<f64>>| {
                    let next = onward.map(|it| it.next);
                    next.filter(|it| of(surface.frame.to_world(it.wi))).map_or(0.0, |it| it.weight)
                }
            };
            assert_mean("all", (0..SAMPLES).map(sampled).map(weight(|_| true)), 0.6);
            assert_mean("half", (0..SAMPLES).map(sampled).map(weight(|it| it.y < 0.0)), 0.3);

            let receiver = &engine.receivers[0];
            let start = Vertex::sensor(
                engine.context.world.ray_origin_of_sensor(receiver.position, receiver.n),
                receiver.n,
            );
            let way_out = engine.way_out_of_start(receiver, &start);
            let started =
                |index| way_out.sample_start(engine, receiver.n, sampler(index).next_2d());
            let weight = |of: fn(DVec3) -> bool| {
                move |drawn: Option<DrawnDirection>| {
                    let drawn = drawn.filter(|it| of(it.direction));
                    drawn.map_or(0.0, |it| it.direction.z * FRAC_1_PI / it.pdf_sr)
                }
            };
            assert_mean("start", (0..SAMPLES).map(started).map(weight(|_| true)), 1.0);
            assert_mean("half", (0..SAMPLES).map(started).map(weight(|it| it.y < 0.0)), 0.5);
        });
    }

    /// The density of survival is that of the sample times its chance, in all directions.
    #[test]
    fn survival_has_the_density_of_the_sample_and_its_chance() {
        with_engine(|engine| {
            let points = engine.context.points(0, Stream::Survey(9));
            for at in places(engine) {
                let surface = &Surface::new(&engine.context.world, &at, at.n * -1.0);
                let way_out = way_out(engine, &at);
                for index in 0..200 {
                    let sampler = &mut Sampler::new(&points, index);
                    let onward = way_out.sample_onward(engine, surface, at.front, sampler);
                    let Some(OnwardSample { next, led }) = onward else { continue };
                    let pdf_sr = next.pdf_sr.expect("it scatters");
                    let survival = (led.favour(1.0) * next.weight).min(1.0);
                    let expected = led.survival_pdf_sr(surface.bsdf, surface.wo, next.wi, 1.0);
                    assert!((pdf_sr * survival / expected - 1.0).abs() < 1e-9, "{index}");
                    assert!(next.weight / survival <= 1.0 + 1e-9, "{index}: it carries more");
                }
            }
        });
    }
}
