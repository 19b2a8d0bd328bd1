//! Light that paths cannot find and no image shows: from points and luminaires by curved mirrors,
//! through refracting bodies, or over more mirrors than images follow.
//!
//! It comes from photon density. Photons are followed until they are scattered, and those that came
//! by specular surfaces alone, in no image, are counted on map elements for the vertices of paths,
//! on a disk around each sensor point, and on cells. All but the cells are biased: a mean over an
//! area stands for the value at a point. What lands on surfaces that are not plain diffuse ones is
//! left out. Each replicate has its own photons, which grow in number with its paths: paths to come
//! read all photons so far.

mod tally;

use crate::codec::{Reader, StateError, Stored, Writer};
use crate::context::{Context, Stream};
use crate::photon::batch::{PhotonBatch, trace_photons};
use crate::photon::map::QUANTA_PER_PHOTON;
use crate::photon::order::Way;
use crate::photon::trace::{Lead, Source};
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::targets::Target;
use crate::stats::watch::Watch;
use crate::world::flight::Flight;
use crate::world::grid_plane::GridPlane;
use crate::world::{Interaction, World};
use glam::DVec3;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::PoisonError;
use std::sync::atomic::Ordering;
use tally::{HiddenReceiver, Tally};

/// Photons for each path of a sensor point: so many for this many points, in these bounds.
const TARGETS_PER_PHOTON: u64 = 4;
const PHOTONS_PER_PATH: [u64; 2] = [4, 4096];
/// Elements are this share of the scene's size where nothing is asked for.
const ELEMENTS_ACROSS: f64 = 64.0;
/// Most parts of a facet's edge.
const MAX_PARTS: f64 = 16384.0;

/// The photons of all replicates.
pub(crate) struct CausticMap<S> {
    element_m: f64,
    receivers: Receivers,
    tallies: Vec<Tally>,
    maps: Vec<HiddenMap<S>>,
    /// Photons of each replicate for each index.
    photons_per_path: u64,
    photons: u64,
    /// Photons and contributions of photons that were refused.
    invalid: u64,
    flux_lm: f64,
    /// Of each target that gets no more, the photons of each replicate so far.
    ends: Vec<Option<u64>>,
    /// Of the scene.
    facets: usize,
}

/// Caustic illuminance on map elements, in one replicate.
pub(crate) struct HiddenMap<S> {
    /// By element and number of bounces.
    illuminance_lx: Vec<(Key, S)>,
}

/// What light is kept apart: it hides on few elements, so these are found by search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key {
    facet: u32,
    /// One of the facet's equal triangles, on one side.
    element: u32,
    /// Where bounces are limited.
    bounces: u32,
}

/// What sensors are to flights: the same for all replicates.
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
    /// `None` where images show all of it, or where no bounces are wanted: it takes one at least.
    pub(crate) fn new(
        context: &Context<'_, S>,
        settings: &Settings,
        targets: &[Target],
    ) -> Option<Self> {
        context.hides.as_ref().filter(|_| context.max_bounces != Some(0))?;
        let element_m = settings.map_element_m.unwrap_or(context.world.size_m() / ELEMENTS_ACROSS);
        let receivers = Receivers::new(context, targets, element_m);
        let replicates = settings.effective_replicates();
        let [least, most] = PHOTONS_PER_PATH;
        Some(Self {
            element_m,
            receivers,
            tallies: (0..replicates)
                .map(|_| Tally::new(targets.len(), context.listed_terms))
                .collect(),
            maps: Vec::new(),
            photons_per_path: (targets.len() as u64 / TARGETS_PER_PHOTON).clamp(least, most),
            photons: 0,
            invalid: 0,
            flux_lm: context.lights.flux_lm,
            ends: vec![None; targets.len()],
            facets: context.world.facets.len(),
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

    /// Photons of each replicate when so many paths are served.
    pub(crate) fn photons_for(&self, paths: u64) -> u64 {
        paths.saturating_mul(self.photons_per_path)
    }

    /// Adds the photons up to `end`: how many rays they took, `None` when the observer stopped it.
    /// Paths see them after [`Self::show`].
    pub(crate) fn grow(
        &mut self,
        context: &Context<'_, S>,
        end: u64,
        watch: &mut Watch<'_>,
    ) -> Option<u64> {
        let Self { element_m, receivers, tallies, ends, .. } = &*self;
        let tells_bounces = context.max_bounces.is_some() || context.listed_terms > 0;
        let receiver = |r: u32| {
            let tally = &tallies[r as usize];
            let (world, element_m) = (&context.world, *element_m);
            HiddenReceiver { world, element_m, receivers, ends, tally, tells_bounces, invalid: 0 }
        };
        let batch = PhotonBatch {
            stream: Stream::CausticPhotons,
            replicates: 0..tallies.len() as u32,
            indices: self.photons..end,
            way: Way::CoherentWaves,
            lead: Lead::by_chance(Source::Lights, None),
        };
        let counts = trace_photons(context, &batch, receiver, watch)?;
        self.photons = end;
        self.invalid += counts.invalid;
        Some(counts.rays)
    }

    /// Lets paths see all photons so far.
    pub(crate) fn show(&mut self, context: &Context<'_, S>) {
        self.maps = self.tallies.iter().map(|tally| self.read(&context.world, tally)).collect();
    }

    /// Puts out what the photons gave to the targets, without what paths see of them.
    pub(crate) fn put_targets(&self, out: &mut Writer) {
        out.u64(self.photons);
        out.u64(self.invalid);
        for quanta in self.tallies.iter().flat_map(|tally| tally.targets.iter().flatten()) {
            out.i64(quanta.load(Ordering::Relaxed));
        }
    }

    /// Takes that in.
    pub(crate) fn take_targets(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        from.add_u64(&mut self.photons)?;
        from.add_u64(&mut self.invalid)?;
        for quanta in self.tallies.iter_mut().flat_map(|tally| tally.targets.iter_mut().flatten()) {
            from.add_i64(quanta.get_mut())?;
        }
        Ok(())
    }

    /// Counts no more for targets that end with so many paths; the maps go on.
    pub(crate) fn freeze_converged(&mut self, ends: &[Option<u64>]) {
        self.ends = ends.iter().map(|end| end.map(|paths| self.photons_for(paths))).collect();
    }

    fn read(&self, world: &World<S>, tally: &Tally) -> HiddenMap<S> {
        let lm_per_quantum = self.lm_per_quantum(self.photons);
        let landings = tally.landings.lock().unwrap_or_else(PoisonError::into_inner);
        let illuminance_lx = landings
            .iter()
            .map(|(&key, quanta)| {
                let parts = parts(world, key.facet, self.element_m);
                let area_m2 = world.facets[key.facet as usize].area_m2() / (parts * parts);
                let factor = lm_per_quantum / area_m2;
                (key, S::from_channels(|c| quanta[c] as f64 * factor))
            })
            .collect();
        HiddenMap { illuminance_lx }
    }

    fn lm_per_quantum(&self, photons: u64) -> f64 {
        self.flux_lm / photons.max(1) as f64 / QUANTA_PER_PHOTON
    }

    fn lx_per_quantum(&self, target: usize) -> f64 {
        let photons = self.ends[target].unwrap_or(self.photons);
        self.lm_per_quantum(photons) / self.receivers.areas_m2[target]
    }

    /// What the paths of one replicate read.
    pub(crate) fn map(&self, replicate: u32) -> Option<CausticLookup<'_, S>> {
        let map = self.maps.get(replicate as usize)?;
        Some(CausticLookup { map, element_m: self.element_m })
    }

    /// What a target gets in one replicate, in lx.
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

/// Everything, landings included.
impl<S: Spectrum> Stored for CausticMap<S> {
    fn put(&self, out: &mut Writer) {
        self.put_targets(out);
        for tally in &self.tallies {
            let landings = tally.landings.lock().unwrap_or_else(PoisonError::into_inner);
            out.u64(landings.len() as u64);
            for (Key { facet, element, bounces }, quanta) in landings.iter() {
                [facet, element, bounces].into_iter().for_each(|number| out.u32(*number));
                quanta.iter().for_each(|quanta| out.i64(*quanta));
            }
        }
    }

    fn merge_from(&mut self, from: &mut Reader<'_>) -> Result<(), StateError> {
        self.take_targets(from)?;
        for tally in &mut self.tallies {
            let landings = tally.landings.get_mut().unwrap_or_else(PoisonError::into_inner);
            for _ in 0..from.length(3 * size_of::<u32>() + 3 * size_of::<i64>())? {
                let (facet, element, bounces) = (from.u32()?, from.u32()?, from.u32()?);
                if facet as usize >= self.facets {
                    return Err(StateError::Unfit("a landing"));
                }
                let quanta = landings.entry(Key { facet, element, bounces }).or_default();
                quanta.iter_mut().try_for_each(|quanta| from.add_i64(quanta))?;
            }
        }
        Ok(())
    }
}

/// The map of one replicate, as its paths read it.
#[derive(Clone, Copy)]
pub(crate) struct CausticLookup<'a, S> {
    map: &'a HiddenMap<S>,
    element_m: f64,
}

impl<S: Spectrum> CausticLookup<'_, S> {
    /// Illuminances in lx at a place, of light that took at most `most_bounces`, by their number;
    /// all in one where it does not matter.
    pub(crate) fn illuminances_lx(
        &self,
        world: &World<S>,
        at: &Interaction,
        most_bounces: u32,
    ) -> impl Iterator<Item = (u32, S)> {
        let first = Key::new(world, at, self.element_m, 0);
        let last = Key { bounces: most_bounces, ..first };
        let entries = &self.map.illuminance_lx;
        let start = entries.partition_point(|(key, _)| *key < first);
        let own = entries[start..].iter().take_while(move |(key, _)| *key <= last);
        own.map(|(key, illuminance_lx)| (key.bounces, *illuminance_lx))
    }
}

impl Key {
    fn new<S: Spectrum>(world: &World<S>, at: &Interaction, element_m: f64, bounces: u32) -> Self {
        let parts = parts(world, at.facet, element_m);
        let [_, b, c] = at.barycentric.map(|weight| weight * parts);
        // Rows and columns along two edges make rhombi, of two triangles each.
        let [row, column] = [b, c].map(|place| (place as u32).min(parts as u32 - 1));
        let hangs = (b - f64::from(row)) + (c - f64::from(column)) > 1.0;
        let rhombus = row * parts as u32 + column;
        let element = rhombus * 4 + u32::from(hangs) * 2 + u32::from(at.front);
        Self { facet: at.facet, element, bounces }
    }
}

/// In how many parts the edges of a facet are cut.
fn parts<S: Spectrum>(world: &World<S>, facet: u32, element_m: f64) -> f64 {
    let longest_m = world.facets[facet as usize].longest_edge_m();
    (longest_m / element_m).ceil().clamp(1.0, MAX_PARTS)
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
        grid: &quasilux_scene::sensor::Grid,
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
