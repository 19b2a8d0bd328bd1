//! Everything that stays the same while light moves.

use crate::lights::Lights;
use crate::lights::images::{ImageQuery, SpecularImages, UnshownWay};
use crate::prepared::PreparedScene;
use crate::purpose::{Purpose, PurposeRecorder};
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use crate::world::vertex::{Surface, Vertex};
use crate::world::{Interaction, World};
use glam::DVec3;
use quasilux_bvh::SimdLevel;
use quasilux_sampling::{PointSet, Sampler, Sequence, stream_key};

/// Step of a wave, for measurements of time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Making coordinates, where they are made for many photons at once.
    Sampling,
    /// From coordinates to light, place and direction.
    Emission,
    /// From rays to places on facets.
    Traversal,
    /// Counting flights and landings.
    Tally,
    /// Survival and the next direction.
    Scattering,
}

/// A clock that is told when a wave ends a step, to measure the steps apart.
pub trait Stopwatch: Sync {
    /// The thread that calls has just ended a piece of this step.
    fn lap(&self, step: Step);
}

/// A scene made ready for one simulation.
pub(crate) struct Context<'a, S> {
    pub(crate) world: World<S>,
    pub(crate) lights: Lights<'a>,
    /// Of the point-like lights, in mirrors.
    pub(crate) images: SpecularImages,
    /// How light of points and luminaires comes that only photons find.
    pub(crate) caustic_ways: Vec<UnshownWay>,
    pub(crate) max_bounces: Option<u32>,
    /// Coordinates that photons on maps may have used.
    pub(crate) map_dimensions: Option<u32>,
    /// Terms of the Neumann series to keep apart; 0 for none.
    pub(crate) listed_terms: u32,
    /// Luminaires whose luminous shape a surface passes through.
    pub(crate) cut_shapes: u64,
    /// Told of the steps of waves, in benchmarks.
    pub(crate) stopwatch: Option<&'a dyn Stopwatch>,
    /// Told what coordinates are drawn for, where that is to be explained.
    pub(crate) purposes: PurposeRecorder<'a>,
    settings: &'a Settings,
}

/// Purpose of a stream of coordinates. Streams never share coordinates; but at one index they have
/// the same digits in each dimension, permuted, so what is drawn together must come from different
/// dimensions.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Stream {
    /// Photons that enter the estimate.
    Photons,
    /// Photons of a plan, left out of the estimate.
    PlanPhotons,
    /// Photons that show where the elements of a map are to be split.
    MapPilots,
    /// Photons that show whether to begin where light lands.
    FirstShotPilots,
    /// Pilot photons that confirm weight windows where sensors count photons.
    WindowPilots,
    /// Photons of caustics that paths cannot sample.
    CausticPhotons,
    /// Pilot rays that plan where photons are split, numbered by what they start from.
    Survey(u64),
    /// Paths from one sensor point, numbered through all sensors.
    Paths(u64),
    /// Paths from one sensor point that know where light was reflected, numbered through all
    /// sensors.
    DaylightPaths(u64),
    /// The sun as one sensor point sees it straight, numbered through all sensors.
    SunDisks(u64),
    /// Where meshes of directions lie.
    Meshes,
    /// Eye subpaths from one sensor point, numbered through all sensors.
    EyeSubpaths(u64),
    /// Light subpaths that serve all sensor points.
    SharedSubpaths,
    /// Pilots of those, left out of the estimate.
    SubpathPilots,
    /// Which vertices of them are joined to a sensor point, and where in its cell, numbered through
    /// all sensors.
    Joins(u64),
    /// Light subpaths that serve all pixels.
    PictureSubpaths,
    /// Photons that serve all pixels: those that come from narrow surfaces count.
    PicturePhotons,
    /// Paths through one pixel of one camera.
    Pixel {
        /// Number of the camera.
        camera: u32,
        /// Number of the pixel in its picture.
        pixel: u32,
    },
}

impl Stream {
    /// The stream's number in keys.
    pub(crate) fn id(self) -> u64 {
        match self {
            Self::Photons => 0,
            Self::PlanPhotons => 1,
            Self::MapPilots => 1 << 62,
            Self::FirstShotPilots => 1 << 62 | 1,
            Self::WindowPilots => u64::MAX - 65,
            Self::CausticPhotons => u64::MAX,
            Self::Survey(kind) => u64::MAX - 1 - kind,
            Self::PictureSubpaths => u64::MAX - 68,
            Self::PicturePhotons => u64::MAX - 72,
            Self::SharedSubpaths => u64::MAX - 70,
            Self::SubpathPilots => u64::MAX - 71,
            Self::Joins(point) => (7 << 60) + point,
            Self::SunDisks(point) => (3 << 60) + point,
            Self::DaylightPaths(point) => (5 << 60) + point,
            Self::Meshes => u64::MAX - 69,
            Self::Paths(point) => 2 + point,
            Self::EyeSubpaths(point) => (1 << 60) + 2 * point,
            Self::Pixel { camera, pixel } => 1 << 63 | u64::from(camera) << 32 | u64::from(pixel),
        }
    }

    /// The sequence of its points in a run with this one.
    pub(crate) fn sequence(self, of_run: Sequence) -> Sequence {
        match (self, of_run) {
            // A plan has its own number of photons.
            (
                Self::PlanPhotons
                | Self::MapPilots
                | Self::FirstShotPilots
                | Self::WindowPilots
                | Self::CausticPhotons
                | Self::Survey(_)
                | Self::PictureSubpaths
                | Self::PicturePhotons
                | Self::DaylightPaths(_)
                | Self::SunDisks(_)
                | Self::Meshes
                | Self::EyeSubpaths(_)
                | Self::SharedSubpaths
                | Self::SubpathPilots
                | Self::Joins(_),
                Sequence::Hammersley { .. },
            ) => Sequence::Halton,
            _ => of_run,
        }
    }
}

impl<'a, S: Spectrum> Context<'a, S> {
    pub(crate) fn new(scene: impl Into<PreparedScene<'a>>, settings: &'a Settings) -> Self {
        Self::on(SimdLevel::chosen(), scene, settings)
    }

    /// Makes a scene ready as [`Self::new`] does, for a ray kernel of choice: no result depends on
    /// it.
    pub(crate) fn on(
        simd: SimdLevel,
        scene: impl Into<PreparedScene<'a>>,
        settings: &'a Settings,
    ) -> Self {
        let prepared = scene.into();
        let scene = prepared.scene();
        let world = World::new(prepared, simd);
        let lights = Lights::new(scene, &world, settings.estimator);
        let images = SpecularImages::new(&world, &lights.pointlikes, settings.image_depth);
        let caustic_ways = images.unshown_ways(&world, &lights);
        let cut_shapes = lights.area_luminaires.cut_by_surfaces(&world);
        Self {
            world,
            lights,
            images,
            caustic_ways,
            max_bounces: settings.max_bounces,
            map_dimensions: settings.map_dimensions,
            listed_terms: settings.list_terms,
            cut_shapes,
            stopwatch: None,
            purposes: PurposeRecorder::default(),
            settings,
        }
    }

    /// The question of `who` for the light that comes to a vertex by images.
    pub(crate) fn image_query<'q>(
        &'q self,
        who: u32,
        vertex: &'q Vertex<'q, S>,
    ) -> ImageQuery<'q, S> {
        ImageQuery { world: &self.world, pointlikes: &self.lights.pointlikes, who, vertex }
    }

    /// The illuminance in lx that an image of a lamp gives where a photon lands that came in this
    /// direction, as if nothing stood in the path; `None` where no vertex there asks it.
    pub(crate) fn landing_of_image_lx(
        &self,
        image: u32,
        at: &Interaction,
        direction: DVec3,
    ) -> Option<f64> {
        let surface = Surface::new(&self.world, at, direction);
        let vertex = &Vertex::on(&self.world, at, &surface, S::white());
        self.images.illuminance_lx(&self.image_query(0, vertex), image)
    }

    /// The point set of a trial: a Halton sequence where the run has a fixed number of points,
    /// since a few of these are no sample of the set.
    pub(crate) fn points_of_trial(&self, replicate: u32, stream: Stream) -> PointSet {
        let Settings { sequence, randomization, seed, .. } = *self.settings;
        let sequence = if sequence.points().is_some() { Sequence::Halton } else { sequence };
        PointSet::new(sequence, randomization, stream_key(seed, replicate, stream.id()))
    }

    /// The randomised point set of one stream in one replicate.
    pub(crate) fn points(&self, replicate: u32, stream: Stream) -> PointSet {
        let Settings { sequence, randomization, seed, .. } = *self.settings;
        let mut sequence = stream.sequence(sequence);
        if let (Sequence::Hammersley { points }, Stream::Photons, EstimatorKind::BidirectionalMap) =
            (&mut sequence, stream, self.settings.estimator)
        {
            *points = points.saturating_mul(u64::from(self.settings.map_photons.max(1)));
        }
        PointSet::new(sequence, randomization, stream_key(seed, replicate, stream.id()))
    }

    /// Draws coordinates for a purpose.
    #[inline]
    pub(crate) fn draw<'p, T>(
        &self,
        sampler: &mut Sampler<'p>,
        purpose: Purpose,
        draw: impl FnOnce(&mut Sampler<'p>) -> T,
    ) -> T {
        self.purposes.draw(sampler, purpose, draw)
    }
}

#[cfg(test)]
mod tests {
    use super::Stream;

    /// Small numbers, powers of two and their neighbours, all below `end`.
    fn numbers(end: u64) -> impl Iterator<Item = u64> + Clone {
        let powers = (9..64).flat_map(|k| [(1 << k) - 1, 1 << k, (1 << k) + 1]);
        (0..256).chain(powers).filter(move |number| *number < end)
    }

    /// No two streams of a scene share a number, and so coordinates: all streams without a number
    /// of their own, and those of the first 2^40 points and groups, 62 surveys and 2^20 cameras,
    /// at the numbers that bits can confuse. A single pair that shares one is found.
    #[test]
    fn streams_have_numbers_of_their_own() {
        use Stream::{
            CausticPhotons, DaylightPaths, EyeSubpaths, FirstShotPilots, Joins, MapPilots, Meshes,
            Paths, Photons, PicturePhotons, PictureSubpaths, PlanPhotons, SharedSubpaths,
            SubpathPilots, SunDisks, Survey, WindowPilots,
        };
        let single =
            [Photons, PlanPhotons, MapPilots, FirstShotPilots, WindowPilots, CausticPhotons];
        let pixels = numbers(1 << 20).flat_map(|camera| {
            numbers(1 << 32)
                .map(move |pixel| Stream::Pixel { camera: camera as u32, pixel: pixel as u32 })
        });
        let numbered = numbers(1 << 40).flat_map(|number| {
            [Paths, DaylightPaths, SunDisks, EyeSubpaths, Joins].map(|stream| stream(number))
        });
        let others = [PicturePhotons, PictureSubpaths, Meshes, SharedSubpaths, SubpathPilots];
        let streams = single.into_iter().chain(others).chain(numbered);
        let streams = streams.chain(numbers(62).map(Survey)).chain(pixels);
        let mut ids: Vec<u64> = streams.map(Stream::id).collect();
        let count = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), count, "two streams share a number");
    }
}
