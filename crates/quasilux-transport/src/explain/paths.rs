//! Paths as a pilot sees them: what each finds at some of the sensor points.

use super::beside::{BesideSource, Role};
use super::{Pilot, Points, SampleKind, SampleSource};
use crate::context::{Context, Stream};
use crate::estimator::connection::LightVertexConnections;
use crate::estimator::exact::exact;
use crate::estimator::pilot::Request;
use crate::estimator::selection::{Decision, decide};
use crate::path::end::{EndPilots, PathEnd};
use crate::path::sections::Section;
use crate::path::wave::{PathWave, WAVE};
use crate::photon::caustics::CausticMap;
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use crate::stats::tally::Quantum;
use crate::stats::targets::{Target, targets};
use crate::stats::watch::Watch;
use quasilux_sampling::DimensionHistogram;
use quasilux_scene::Scene;
use rayon::prelude::*;

/// Sensor points that are looked at, spread over all.
const TARGETS: usize = 8;
/// Paths from each.
const SAMPLES: u64 = 1 << 10;
/// Samples whose photons say how much light paths need not find.
const JOINED_SAMPLES: u64 = 1 << 6;
/// Photons on the map where it grows with the run.
const MAP_PHOTONS: u64 = 1 << 14;

pub(super) struct PathSource<'s, S> {
    context: &'s Context<'s, S>,
    targets: Vec<PathTarget>,
    end: PathEnd<S>,
    caustics: Option<CausticMap<S>>,
    /// Photons that find a part of the light, for these targets.
    light_vertices: Option<LightVertexConnections>,
    kind: SampleKind,
}

struct PathTarget {
    /// Its number among all.
    number: u64,
    target: Target,
    /// Light that is no matter of paths: direct light, what connected photons find, and what only
    /// photons find.
    given_lx: f64,
}

/// What some paths of one target found.
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
        let exact = exact(context, &all, &mut 0);
        let quantum = Quantum::for_reference(context.lights.reference_lx(&context.world));
        let (targets, exact) = (all.as_slice(), exact.as_slice());
        let request = Request { settings, replicates: 1, targets, exact, quantum };
        let Decision { light_vertices, frozen, .. } = decide(context, &request, &mut watch);
        let mut light_vertices = light_vertices
            .map(|light_vertices| light_vertices.with_targets(context, &numbers, targets));
        if let Some(light_vertices) = &mut light_vertices {
            // As many photons as say how much light they find.
            light_vertices.grow(context, JOINED_SAMPLES, &mut watch);
        }
        let targets = numbers.iter().enumerate().map(|(i, &number)| PathTarget {
            number: number as u64,
            target: all[number],
            given_lx: exact[number].sum_lx()
                + light_vertices.as_ref().map_or(0.0, |light_vertices| light_vertices.lx(0, i)),
        });
        let mut targets: Vec<PathTarget> = targets.collect();
        let pilots = EndPilots { frozen, photons: None };
        let mut end = PathEnd::prepare(context, &one, &all, pilots, &mut watch).end;
        let photons = settings.max_samples.map_or(MAP_PHOTONS, |most| most.min(MAP_PHOTONS));
        end.grow(context, photons, |_| None, &mut watch);
        let caustics = Self::caustics(context, &one, &targets, &mut watch);
        for (i, target) in targets.iter_mut().enumerate() {
            target.given_lx += caustics.as_ref().map_or(0.0, |caustics| caustics.target_lx(0, i));
        }
        let kind = match settings.estimator {
            EstimatorKind::Path => SampleKind::Paths,
            _ if light_vertices.is_some() => SampleKind::PathsBesidePhotons,
            _ if matches!(end, PathEnd::Nothing) => SampleKind::Paths,
            _ => SampleKind::PathsOnMap,
        };
        Self { context, targets, end, caustics, light_vertices, kind }
    }

    /// The photons that find a part of the light, as walks of their own, where the targets get this
    /// much in all.
    pub(super) fn beside(&self, whole_lx: &[f64]) -> impl Iterator<Item = BesideSource<'_, S>> {
        let walks = self.light_vertices.iter().flat_map(move |light_vertices| {
            // Of a target that is nearly dark, little is known but what was predicted.
            let known = whole_lx.iter().zip(light_vertices.predicted_lx());
            let whole_lx: Vec<f64> = known.map(|(lx, predicted)| lx.max(0.5 * predicted)).collect();
            [Role::Counted, Role::LightVertexConnections].map(|role| {
                let whole_lx = whole_lx.clone();
                BesideSource { context: self.context, light_vertices, role, whole_lx }
            })
        });
        walks.filter(|walk| walk.for_each_path() > 0)
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

    fn piece(&self, wave: &mut PathWave<S>, section: &Section<'_, S>, given_lx: f64) -> Piece {
        let paths = wave.trace(self.context, section.starts(self.context));
        let rays = wave.take_rays();
        let mut piece = Piece { values: Vec::new(), rays, dimensions: DimensionHistogram::new() };
        for mut path in paths {
            let path = path.end();
            let value_lx = given_lx + (path.found.direct + path.found.indirect).luminance();
            // The run counts and reports what is no number.
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
            let section = Section {
                number: 0,
                target: target.target,
                points: points(Stream::Paths(target.number)),
                rest: self.end.rest(self.context, 0, target.number as usize),
                partition: self
                    .light_vertices
                    .as_ref()
                    .map(|light_vertices| &light_vertices.connection.partition),
                caustics: self.caustics.as_ref().and_then(|caustics| caustics.map(0)),
                indices: first..(first + WAVE).min(samples),
            };
            self.piece(wave, &section, target.given_lx)
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
