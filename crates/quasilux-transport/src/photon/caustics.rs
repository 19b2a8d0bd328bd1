//! Caustics (paths LS+D of Heckbert 1990) that path tracing cannot sample and no mirror image
//! shows, by density estimation of photons (Jensen 1996): from points and luminaires over curved
//! mirrors, through refracting bodies, or over more mirrors than images follow.
//!
//! Photons are followed until a surface that is not specular. Those of
//! [`LightPathClass::Caustic`](crate::lights::images::LightPathClass) are counted on the elements
//! of an illumination map for the vertices of paths, on a disc around each sensor point, and on
//! grid cells. All but the cells are biased: a mean over an area stands for the value at a point.
//! Light on surfaces that are not plain diffuse ones is left out. Each replicate has its own
//! photons, whose number grows with that of its paths: a path reads all photons before it.

mod tally;

use crate::codec::{Reader, StateError, Stored, Writer};
use crate::context::{Context, Stream};
use crate::control::watch::Watch;
use crate::cutoff::MAX_EVENTS;
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::map::{BounceTerm, IlluminationMap, MapLayout, QUANTA_PER_PHOTON};
use crate::photon::order::PhotonOrder;
use crate::photon::trace::{PhotonSetup, Source};
use crate::sensors::Target;
use crate::settings::{Reconstruction, Settings};
use crate::spectrum::Spectrum;
use crate::world::Interaction;
use crate::world::flight::Flight;
use crate::world::grid_plane::GridPlane;
use glam::DVec3;
use quasilux_scene::sensor::Grid;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::atomic::Ordering;
use tally::{CausticReceiver, CausticTally};

/// Photons for each path of a sensor point: one for this many points, within these bounds.
const TARGETS_PER_PHOTON: u64 = 4;
const PHOTONS_PER_PATH: [u64; 2] = [4, 4096];

/// The photons of all replicates.
pub(crate) struct CausticMap<S> {
    layout: MapLayout,
    receivers: Receivers,
    tallies: Vec<CausticTally<S>>,
    /// Photons of each replicate for each index.
    photons_per_path: u64,
    photons: u64,
    /// Photons and contributions of photons that were refused.
    invalid: u64,
    flux_lm: f64,
    /// Photons of each replicate at which a converged target was frozen.
    ends: Vec<Option<u64>>,
}

/// The sensors, the same for all replicates.
struct Receivers {
    planes: Vec<CellReceiver>,
    discs: Vec<Disc>,
    /// Behind each target, in m^2.
    areas_m2: Vec<f64>,
}

struct CellReceiver {
    plane: GridPlane,
    /// Where the grid's normal is tilted.
    behind: Option<GridPlane>,
    first_target: usize,
    cells: Range<usize>,
}

struct Disc {
    target: usize,
    centre: DVec3,
    normal: DVec3,
    square_radius_m2: f64,
}

impl<S: Spectrum> CausticMap<S> {
    /// `None` where images show all of it, or where no bounces are wanted: a caustic has at least
    /// one.
    pub(crate) fn new(
        context: &Context<'_, S>,
        settings: &Settings,
        targets: &[Target],
    ) -> Option<Self> {
        if context.caustic_ways.is_empty() || context.max_bounces == Some(0) {
            return None;
        }
        let constant =
            Settings { map_reconstruction: Reconstruction::Constant, ..settings.clone() };
        let layout = MapLayout::new(&context.world, &constant);
        // Bounces are told apart as far as a limit on them or a listed term asks for it.
        let layers = context.max_bounces.unwrap_or(context.listed_terms).clamp(1, MAX_EVENTS);
        let tally = |_| CausticTally::new(&layout, layers, targets.len(), context.listed_terms);
        let tallies = (0..settings.effective_replicates()).map(tally).collect();
        let radius_m = MapLayout::longest_edge_m(&context.world, settings);
        let [least, most] = PHOTONS_PER_PATH;
        Some(Self {
            layout,
            receivers: Receivers::new(context, targets, radius_m),
            tallies,
            photons_per_path: (targets.len() as u64 / TARGETS_PER_PHOTON).clamp(least, most),
            photons: 0,
            invalid: 0,
            flux_lm: context.lights.flux_lm,
            ends: vec![None; targets.len()],
        })
    }

    /// Photons of each replicate so far.
    pub(crate) fn photons(&self) -> u64 {
        self.photons
    }

    /// Photons, and contributions of photons, that were not finite, negative or too large.
    pub(crate) fn invalid(&self) -> u64 {
        self.invalid
    }

    /// Photons that belong to each path.
    pub(crate) fn photons_per_path(&self) -> u64 {
        self.photons_per_path
    }

    /// Photons of each replicate for a number of paths.
    pub(crate) fn photons_for(&self, paths: u64) -> u64 {
        paths.saturating_mul(self.photons_per_path)
    }

    /// Adds the photons up to `end` and returns the number of rays; `None` when the observer
    /// stopped it.
    pub(crate) fn grow(
        &mut self,
        context: &Context<'_, S>,
        end: u64,
        watch: &mut Watch<'_>,
    ) -> Option<u64> {
        let Self { layout, receivers, tallies, ends, .. } = &*self;
        let receiver = |r: u32| {
            let tally = &tallies[r as usize];
            CausticReceiver { layout, receivers, ends, tally, invalid: 0 }
        };
        let batch = PhotonBatch {
            stream: Stream::CausticPhotons,
            replicates: 0..tallies.len() as u32,
            indices: self.photons..end,
            order: PhotonOrder::CoherentWaves,
            setup: PhotonSetup::by_chance(Source::Lights, None),
        };
        let counts = trace_photons(context, &batch, receiver, watch)?;
        self.photons = end;
        self.invalid += counts.invalid;
        Some(counts.rays)
    }

    /// Puts out what the photons gave to the targets, without what paths see of them.
    pub(crate) fn put_targets(&self, out: &mut Writer) {
        out.value(&self.photons);
        out.value(&self.invalid);
        for quanta in self.tallies.iter().flat_map(|tally| tally.targets.iter().flatten()) {
            out.value(&quanta.load(Ordering::Relaxed));
        }
    }

    /// Takes in what [`Self::put_targets`] put out.
    pub(crate) fn take_targets(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        from.add_count(&mut self.photons)?;
        from.add_count(&mut self.invalid)?;
        for quanta in self.tallies.iter_mut().flat_map(|tally| tally.targets.iter_mut().flatten()) {
            from.add_quanta(quanta.get_mut())?;
        }
        Ok(())
    }

    /// Freezes targets at their numbers of paths; the maps go on.
    pub(crate) fn freeze_converged(&mut self, ends: &[Option<u64>]) {
        self.ends = ends.iter().map(|end| end.map(|paths| self.photons_for(paths))).collect();
    }

    fn lx_per_quantum(&self, target: usize) -> f64 {
        let photons = self.ends[target].unwrap_or(self.photons).max(1) as f64;
        self.flux_lm / photons / QUANTA_PER_PHOTON / self.receivers.areas_m2[target]
    }

    /// The map that the paths of one replicate read; `None` before the first photon.
    pub(crate) fn map(&self, replicate: u32) -> Option<CausticLookup<'_, S>> {
        let photon_lm = (self.photons > 0).then(|| self.flux_lm / self.photons as f64)?;
        let map = self.tallies[replicate as usize].map.read(photon_lm);
        Some(CausticLookup { layout: &self.layout, map })
    }

    /// Illuminance of a target in one replicate, in lx.
    pub(crate) fn target_lx(&self, replicate: usize, target: usize) -> f64 {
        let terms = self.tallies[replicate].targets.iter();
        let quanta: i64 = terms.map(|counts| counts[target].load(Ordering::Relaxed)).sum();
        quanta as f64 * self.lx_per_quantum(target)
    }

    /// The part of it of one number of bounces, where terms are listed; the last is the rest.
    pub(crate) fn term_lx(&self, replicate: usize, target: usize, term: usize) -> f64 {
        let quanta = self.tallies[replicate].targets[term][target].load(Ordering::Relaxed);
        quanta as f64 * self.lx_per_quantum(target)
    }
}

/// All of it, the map included.
impl<S: Spectrum> Stored for CausticMap<S> {
    fn put(&self, out: &mut Writer) {
        self.put_targets(out);
        self.tallies.iter().for_each(|tally| tally.map.put(out));
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.take_targets(from)?;
        self.tallies.iter_mut().try_for_each(|tally| tally.map.merge_from(from))
    }
}

/// The map of one replicate.
#[derive(Clone, Copy)]
pub(crate) struct CausticLookup<'a, S> {
    layout: &'a MapLayout,
    map: IlluminationMap<'a, S>,
}

impl<S: Spectrum> CausticLookup<'_, S> {
    /// Caustic illuminances in lx at a place by the number of bounces, up to `max_bounces`; in one
    /// sum where bounces are not told apart.
    pub(crate) fn illuminances_lx(
        &self,
        at: &Interaction,
        max_bounces: u32,
    ) -> impl Iterator<Item = BounceTerm<S>> {
        let terms = self.map.terms_lx(self.layout.locate(at), max_bounces);
        terms.filter(|term| term.illuminance_lx.max_channel() > 0.0)
    }
}

impl Receivers {
    fn new<S: Spectrum>(context: &Context<'_, S>, targets: &[Target], radius_m: f64) -> Self {
        let mut receivers = Self { planes: Vec::new(), discs: Vec::new(), areas_m2: Vec::new() };
        for (number, target) in targets.iter().enumerate() {
            match target {
                Target::Point { position, normal } => {
                    receivers.discs.push(Disc {
                        target: number,
                        centre: context.world.ray_origin_of_sensor(*position, *normal).position(),
                        normal: *normal,
                        square_radius_m2: radius_m * radius_m,
                    });
                    receivers.areas_m2.push(PI * radius_m * radius_m);
                }
                Target::Cell { grid, cell } => receivers.add_cell(context, number, grid, *cell),
            }
        }
        receivers
    }

    /// Cells of a grid follow each other, but cells may be asked for without those before.
    fn add_cell<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        number: usize,
        grid: &Grid,
        cell: usize,
    ) {
        let plane = GridPlane::new(&context.world, grid);
        self.areas_m2.push(plane.cell_area_m2());
        match self.planes.last_mut() {
            Some(last) if cell != 0 && cell == last.cells.end => last.cells.end = cell + 1,
            _ => {
                let (behind, cells) = (plane.behind(), cell..cell + 1);
                self.planes.push(CellReceiver { plane, behind, first_target: number, cells });
            }
        }
    }
}

impl Disc {
    /// Whether a flight passes through it from the front.
    fn is_met(&self, &Flight { from, direction, length_m }: &Flight) -> bool {
        let approach = self.normal.dot(direction);
        let height = self.normal.dot(self.centre - from);
        if !(approach < 0.0 && height < 0.0) {
            return false;
        }
        let t = height / approach;
        t < length_m
            && (from + direction * t - self.centre).length_squared() <= self.square_radius_m2
    }
}
