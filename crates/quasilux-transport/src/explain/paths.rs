//! Paths as a pilot sees them: what each finds at some of the sensor points.

use super::{Pilot, Points, SampleKind, SampleSource};
use crate::context::{Context, Stream};
use crate::control::watch::Watch;
use crate::estimator::UNSTOPPED;
use crate::estimator::exact::computed_light;
use crate::path::end::PathEnd;
use crate::path::path_batch::PathBatch;
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::sensors::{Target, targets};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use quasilux_sampling::DimensionHistogram;
use quasilux_scene::Scene;
use rayon::prelude::*;

/// Sensor points that are looked at, spread over all.
const TARGETS: usize = 8;
/// Paths from each.
const SAMPLES: u64 = 1 << 10;
/// Photons on the map where it grows with the run.
const MAP_PHOTONS: u64 = 1 << 14;

pub(super) struct PathSource<'s, S> {
    context: &'s Context<'s, S>,
    targets: Vec<PathTarget>,
    end: PathEnd<S>,
    caustics: Option<CausticMap<S>>,
    kind: SampleKind,
}

struct PathTarget {
    /// Its number among all.
    number: u64,
    target: Target,
    /// Light that is no matter of paths: direct light, and what only photons find.
    given_lx: f64,
}

/// Values that some paths of one target found.
struct Piece {
    values: Vec<f64>,
    rays: u64,
    dimensions: DimensionHistogram,
}

impl<'s, S: Spectrum> PathSource<'s, S> {
    pub(super) fn new(context: &'s Context<'s, S>, scene: &Scene, settings: &Settings) -> Self {
        let all = targets(scene);
        let count = all.len().min(TARGETS);
        let number = |i| (2 * i + 1) * all.len() / (2 * count);
        let numbers: Vec<usize> = (0..count).map(number).collect();
        let mut observer = ();
        let mut watch = Watch::new(&mut observer);
        let one = Settings { replicates: 1, ..settings.clone() };
        let computed = computed_light(context, &all, &mut watch).expect(UNSTOPPED);
        let targets = numbers.iter().map(|&number| PathTarget {
            number: number as u64,
            target: all[number],
            given_lx: computed.of_targets[number].sum_lx(),
        });
        let mut targets: Vec<PathTarget> = targets.collect();
        let mut end = PathEnd::prepare(context, &one, &all, &mut watch).end;
        let photons = settings.max_samples.map_or(MAP_PHOTONS, |most| most.min(MAP_PHOTONS));
        end.grow(context, photons, |_| None, &mut watch);
        let caustics = Self::caustics(context, &one, &targets, &mut watch);
        for (i, target) in targets.iter_mut().enumerate() {
            target.given_lx += caustics.as_ref().map_or(0.0, |caustics| caustics.target_lx(0, i));
        }
        let kind = match &end {
            PathEnd::Nothing => SampleKind::Paths,
            PathEnd::Maps(_) => SampleKind::PathsOnMap,
        };
        Self { context, targets, end, caustics, kind }
    }

    /// Light that only photons find, as far as paths read it.
    fn caustics(
        context: &Context<'_, S>,
        settings: &Settings,
        targets: &[PathTarget],
        watch: &mut Watch<'_>,
    ) -> Option<CausticMap<S>> {
        let targets: Vec<Target> = targets.iter().map(|target| target.target).collect();
        let mut caustics = CausticMap::new(context, settings, &targets)?;
        caustics.grow(context, caustics.photons_for(SAMPLES), watch)?;
        Some(caustics)
    }

    fn piece(&self, wave: &mut PathWave<S>, batch: &PathBatch<'_, S>, given_lx: f64) -> Piece {
        let paths = wave.trace(self.context, batch.starts(self.context));
        let rays = wave.take_rays();
        let mut piece = Piece { values: Vec::new(), rays, dimensions: DimensionHistogram::new() };
        for mut path in paths {
            let path = path.end();
            let value_lx = given_lx + (path.found.direct + path.found.indirect).luminance();
            // The run counts and reports NaN.
            piece.values.push(if value_lx.is_finite() { value_lx } else { 0.0 });
            piece.dimensions.record(path.dimensions);
        }
        piece
    }
}

impl<S: Spectrum> SampleSource for PathSource<'_, S> {
    fn kind(&self) -> SampleKind {
        self.kind
    }

    fn samples(&self) -> u64 {
        SAMPLES
    }

    fn trace(&self, samples: u64, points: &Points<'_>) -> Pilot {
        let pieces_each = samples.div_ceil(WAVE);
        let piece = |wave: &mut PathWave<S>, number: u64| {
            let target = &self.targets[(number / pieces_each) as usize];
            let first = number % pieces_each * WAVE;
            let batch = PathBatch {
                number: 0,
                target: target.target,
                points: points(Stream::Paths(target.number)),
                map_end: self.end.map_end(self.context, 0),
                caustics: self.caustics.as_ref().and_then(|caustics| caustics.map(0)),
                indices: first..(first + WAVE).min(samples),
            };
            self.piece(wave, &batch, target.given_lx)
        };
        let pieces = (0..self.targets.len() as u64 * pieces_each).into_par_iter();
        let pieces: Vec<Piece> = pieces.map_init(PathWave::default, piece).collect();
        let mut dimensions = DimensionHistogram::new();
        pieces.iter().for_each(|piece| dimensions.merge(&piece.dimensions));
        let of_target = |pieces: &[Piece]| pieces.iter().flat_map(|p| &p.values).copied().collect();
        Pilot {
            values: pieces.chunks(pieces_each as usize).map(of_target).collect(),
            rays: pieces.iter().map(|piece| piece.rays).sum(),
            dimensions,
        }
    }
}
