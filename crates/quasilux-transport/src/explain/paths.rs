//! Paths as a pilot sees them: what each finds at some of the sensor points.

use super::{Pilot, Points, Walk, WalkKind};
use crate::gathering::exact;
use crate::path_end::PathEnd;
use crate::path_wave::{PathWave, WAVE};
use crate::sections::Section;
use crate::settings::{Estimator, Settings};
use crate::spectrum::Spectrum;
use crate::specular::HiddenLight;
use crate::stage::{Stage, Stream};
use crate::targets::{Target, targets};
use crate::watch::Watch;
use quasilux_sampling::DimensionHistogram;
use quasilux_scene::Scene;
use rayon::prelude::*;

/// Sensor points that are looked at, spread over all.
const TARGETS: usize = 8;
/// Paths from each.
const SAMPLES: u64 = 1 << 10;
/// Photons on the map where it grows with the run.
const MAP_PHOTONS: u64 = 1 << 14;

pub(super) struct PathWalk<'s, S> {
    stage: &'s Stage<'s, S>,
    targets: Vec<PathTarget>,
    end: PathEnd<S>,
    hidden: Option<HiddenLight<S>>,
    ends_on_map: bool,
}

struct PathTarget {
    /// Its number among all.
    number: u64,
    target: Target,
    /// Direct light that is no matter of paths.
    exact_lx: f64,
}

/// What some paths of one target found.
struct Piece {
    values: Vec<f64>,
    rays: u64,
    dimensions: DimensionHistogram,
}

impl<'s, S: Spectrum> PathWalk<'s, S> {
    pub(super) fn new(stage: &'s Stage<'s, S>, scene: &Scene, settings: &Settings) -> Self {
        let all = targets(scene);
        let count = all.len().min(TARGETS);
        let numbers = (0..count).map(|i| (2 * i + 1) * all.len() / (2 * count));
        let targets = numbers.map(|number| PathTarget {
            number: number as u64,
            target: all[number],
            exact_lx: exact(stage, &[all[number]], &mut 0)[0].sum_lx(),
        });
        let targets: Vec<PathTarget> = targets.collect();
        let mut observer = ();
        let mut watch = Watch::new(&mut observer);
        let one = Settings { replicates: 1, ..settings.clone() };
        let (mut end, _) = PathEnd::prepare(stage, &one, &all, false, &mut watch);
        let photons = settings.max_samples.map_or(MAP_PHOTONS, |most| most.min(MAP_PHOTONS));
        end.grow(stage, 0..photons, |_| None, &mut watch);
        let hidden = Self::hidden(stage, &one, &targets, &mut watch);
        Self { stage, targets, end, hidden, ends_on_map: settings.estimator != Estimator::Path }
    }

    /// Light that only photons find, as far as paths read it.
    fn hidden(
        stage: &Stage<'_, S>,
        settings: &Settings,
        targets: &[PathTarget],
        watch: &mut Watch<'_>,
    ) -> Option<HiddenLight<S>> {
        let targets: Vec<Target> = targets.iter().map(|target| target.target).collect();
        let mut hidden = HiddenLight::new(stage, settings, &targets)?;
        hidden.grow(stage, &(0..SAMPLES), watch)?;
        Some(hidden)
    }

    fn piece(&self, wave: &mut PathWave<S>, section: &Section<'_, S>, exact_lx: f64) -> Piece {
        let paths = wave.trace(self.stage, section.starts(self.stage));
        let rays = wave.take_rays();
        let mut piece = Piece { values: Vec::new(), rays, dimensions: DimensionHistogram::new() };
        for path in paths {
            let path = path.end();
            let value_lx = exact_lx + (path.found.direct + path.found.indirect).luminance();
            // The run counts and reports what is no number.
            piece.values.push(if value_lx.is_finite() { value_lx } else { 0.0 });
            piece.dimensions.record(path.dimensions);
        }
        piece
    }
}

impl<S: Spectrum> Walk for PathWalk<'_, S> {
    fn kind(&self) -> WalkKind {
        if self.ends_on_map { WalkKind::PathsOnMap } else { WalkKind::Paths }
    }

    fn samples(&self) -> u64 {
        SAMPLES
    }

    fn trace(&self, samples: u64, points: &Points<'_>) -> Pilot {
        let pieces_each = samples.div_ceil(WAVE);
        let piece = |wave: &mut PathWave<S>, number: u64| {
            let target = &self.targets[(number / pieces_each) as usize];
            let first = number % pieces_each * WAVE;
            let section = Section {
                number: 0,
                target: target.target,
                points: points(Stream::Paths(target.number).id()),
                rest: self.end.rest(0),
                joining: None,
                hidden: self.hidden.as_ref().and_then(|hidden| hidden.map(0)),
                indices: first..(first + WAVE).min(samples),
            };
            self.piece(wave, &section, target.exact_lx)
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
