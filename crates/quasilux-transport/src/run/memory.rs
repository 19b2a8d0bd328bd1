//! How much memory a run takes, predicted from counts alone: of triangles, sensor points, pixels
//! and samples. `docs/memory.md` has the measurements behind the figures.
//!
//! What is only known when photons have landed is counted as the most that it may be: maps as if
//! every landing met an element of its own, cells of surveys as if all were there.

use crate::estimator::bidirectional::MAX_PHOTONS;
use crate::importance::{MAX_NODES, Node};
use crate::lights::{coarse_tables_bytes, tables_bytes};
use crate::path::path_batch::PathSums;
use crate::photon::map::{COARSE_ELEMENTS_ACROSS, ELEMENTS_ACROSS, MAX_NEW_ELEMENTS};
use crate::pictures::integrator::INDICES;
use crate::settings::{EstimatorKind, Reconstruction, Settings, Switch};
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::tally::Sum;
use quasilux_scene::{Light, Rgb, Scene};

/// Of each triangle while the hierarchy over all of them is built: the peak, and afterwards enough
/// for the scene, its facets and the hierarchy.
const TRIANGLE_BYTES: u64 = 450;
/// Of a value of a sensor point in a replicate as it is reported: in the estimates, and in copies
/// of them.
const VALUE_BYTES: u64 = 4 * size_of::<f64>() as u64;
/// Of a pixel: what is known of it, and its part of the files.
const PIXEL_BYTES: u64 = 56;
/// Of a photon that serves pixels: two flights from narrow surfaces.
const PHOTON_BYTES: u64 = 2 * 384;
/// Cells of a survey at most, and what guides photons in each of them.
const CELLS: u64 = 1 << 13;
const GUIDE_BYTES: u64 = (MAX_NODES * size_of::<Node>()) as u64;
/// Of a counter of a map, and how many of them one landing takes memory for.
const COUNTER_BYTES: u64 = 4;
const COUNTERS_OF_A_LANDING: u64 = 256;
/// Of the table that says where the counters of a landing are.
const ENTRY_BYTES: u64 = 16;
/// Landings of a photon: as many as at a reflectance of 7/8.
const LANDINGS: u64 = 8;

/// Where the memory of a run goes, in bytes. The program itself and the buffers of its threads come
/// on top.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryNeed {
    /// Triangles, the hierarchy over them, and tables by which one of many lights is chosen.
    pub scene_bytes: u64,
    /// Sums and values of all sensor points in all replicates.
    pub sums_bytes: u64,
    /// Cells of surveys, at most.
    pub cells_bytes: u64,
    /// Tables of all counters of illumination maps, landed on or not.
    pub map_tables_bytes: u64,
    /// Illumination maps that are full.
    pub maps_bytes: u64,
    /// Bytes that a sample adds to them at most, while they are not full.
    pub maps_bytes_a_sample: u64,
    /// Pictures, and photons that serve their pixels.
    pub pictures_bytes: u64,
}

impl MemoryNeed {
    /// Of runs of any number of samples.
    #[must_use]
    pub fn new(scene: &Scene, settings: &Settings) -> Self {
        let triangles = scene.mesh.triangles.len() as u64;
        let points: u64 = scene.sensors.iter().map(|sensor| sensor.len() as u64).sum();
        let pixels = scene.cameras.iter().map(|camera| {
            let [width, height] = camera.resolution.map(u64::from);
            width.saturating_mul(height)
        });
        let need = Self {
            scene_bytes: triangles
                .saturating_mul(TRIANGLE_BYTES)
                .saturating_add(tables_bytes(scene.lights.len(), scene))
                .saturating_add(tables_bytes(emitting_triangles(scene), scene))
                .saturating_add(coarse_tables_bytes(&scene.lights)),
            sums_bytes: points.saturating_mul(point_bytes(settings)),
            cells_bytes: cells_bytes(settings),
            pictures_bytes: total(pixels)
                .saturating_mul(PIXEL_BYTES)
                .saturating_add(picture_photons_bytes(scene, settings)),
            ..Self::default()
        };
        let maps = match settings.estimator {
            EstimatorKind::BidirectionalMap => u64::from(settings.effective_replicates()),
            EstimatorKind::Auto
            | EstimatorKind::Photon
            | EstimatorKind::Path
            | EstimatorKind::Bidirectional => return need,
        };
        let channels = if is_grey(scene) { f64::CHANNELS } else { Rgb::CHANNELS } as u64;
        let moments = if settings.map_reconstruction == Reconstruction::Linear { 3 } else { 1 };
        let layers = u64::from(settings.list_terms.max(1));
        let of_landing = product([LANDINGS, COUNTERS_OF_A_LANDING, channels, COUNTER_BYTES]);
        let full = |sides: u64, layers: u64| {
            product([sides, moments, channels, layers, COUNTER_BYTES, maps])
        };
        let (across, split) = match settings.map_adaptive {
            true => (COARSE_ELEMENTS_ACROSS, MAX_NEW_ELEMENTS),
            false => (ELEMENTS_ACROSS, 0),
        };
        let sides = elements(scene, settings, across, split).saturating_mul(2);
        let counters = full(sides, layers) / COUNTER_BYTES;
        Self {
            map_tables_bytes: counters / COUNTERS_OF_A_LANDING * ENTRY_BYTES,
            maps_bytes: full(sides, layers),
            maps_bytes_a_sample: product([of_landing, settings.map_photons.into(), maps]),
            ..need
        }
    }

    /// All of it after this many samples; `None` stands for any number.
    #[must_use]
    pub fn total_bytes(&self, samples: Option<u64>) -> u64 {
        let filled = samples.unwrap_or(u64::MAX).saturating_mul(self.maps_bytes_a_sample);
        let maps_bytes = self.maps_bytes.min(filled);
        let Self { scene_bytes, sums_bytes, cells_bytes, pictures_bytes, .. } = *self;
        let maps_bytes = maps_bytes.saturating_add(self.map_tables_bytes);
        total([scene_bytes, sums_bytes, cells_bytes, maps_bytes, pictures_bytes])
    }
}

/// A list of scores of a sensor point: 128 counters.
const SCORES_BYTES: u64 = 128 * 8;
/// Of a sensor point whatever the replicates: where it is, what is exact of it, where it ends.
const PLACE_BYTES: u64 = 256;

/// A sensor point in all replicates.
fn point_bytes(settings: &Settings) -> u64 {
    let sum = size_of::<Sum>() as u64;
    let values = 1 + u64::from(settings.list_terms);
    let of_terms = if settings.list_terms > 0 { values * sum } else { 0 };
    let replicates = u64::from(settings.effective_replicates());
    let sums = replicates.saturating_mul(size_of::<PathSums>() as u64 + of_terms);
    let figures = replicates.saturating_mul(values * VALUE_BYTES);
    let own = [sums, figures];
    let watched = match settings.estimator {
        kind if kind.is_bounded() => 0,
        _ => SCORES_BYTES,
    };
    total(own).saturating_add(watched + PLACE_BYTES)
}

/// Elements of a map on one side of all triangles at most, as [`crate::photon::map::MapLayout`]
/// cuts them, this many to a scene's size, and splits them.
fn elements(scene: &Scene, settings: &Settings, across: f64, split: u64) -> u64 {
    let mesh = &scene.mesh;
    let size_m = mesh.bounds().map_or(0.0, |[low, high]| (high - low).length());
    let element_m = settings.map_element_m.unwrap_or(size_m / across);
    let elements = |triangle: u32| {
        let [a, b, c] = mesh.corners(triangle);
        let longest_m = (a - b).length().max((b - c).length()).max((c - a).length());
        let parts = (longest_m / element_m).ceil().max(1.0);
        parts * parts
    };
    let triangles = mesh.triangles.len() as u64;
    let cut: f64 = (0..triangles as u32).map(elements).sum();
    (cut as u64).saturating_add(split).min(settings.map_elements.max(triangles))
}

/// Bytes of what guides photons in the cells of a survey.
fn cells_bytes(settings: &Settings) -> u64 {
    let guides_photons =
        matches!(settings.estimator, EstimatorKind::Photon | EstimatorKind::BidirectionalMap);
    if guides_photons && settings.importance != Switch::Off { CELLS * GUIDE_BYTES } else { 0 }
}

/// Photons of the indices of pixels that are traced together, in all replicates, at most.
fn picture_photons_bytes(scene: &Scene, settings: &Settings) -> u64 {
    if scene.cameras.is_empty() || !settings.estimator.is_bounded() {
        return 0;
    }
    let replicates = settings.effective_replicates().into();
    product([replicates, INDICES, MAX_PHOTONS, PHOTON_BYTES])
}

fn product<const N: usize>(of: [u64; N]) -> u64 {
    of.into_iter().fold(1, u64::saturating_mul)
}

fn emitting_triangles(scene: &Scene) -> usize {
    let triangles = scene.lights.iter().map(|light| match light {
        Light::Area(area) => area.triangles.len(),
        Light::Point(_) | Light::Luminaire(_) => 0,
    });
    triangles.sum()
}

fn total(of: impl IntoIterator<Item = u64>) -> u64 {
    of.into_iter().fold(0, u64::saturating_add)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(change: impl Fn(&mut Settings)) -> MemoryNeed {
        let mut settings = Settings::default();
        change(&mut settings);
        MemoryNeed::new(&Scene::default(), &settings)
    }

    #[test]
    fn what_is_asked_for_is_paid_for() {
        assert_eq!(with(|settings| settings.estimator = EstimatorKind::Path).total_bytes(None), 0);
        let grown = |elements: u64, terms: u32| {
            with(|settings| {
                settings.estimator = EstimatorKind::BidirectionalMap;
                settings.map_elements = elements;
                settings.list_terms = terms;
            })
        };
        let few = grown(1 << 10, 0);
        // 2^11 sides of 3 counters of 4 bytes in 16 replicates.
        assert_eq!((few.maps_bytes, few.cells_bytes), ((16 * 12) << 11, CELLS * GUIDE_BYTES));
        // 16 bytes for each 256 of the counters.
        assert_eq!(few.map_tables_bytes, ((16 * 3) << 11) / 256 * 16);
        assert_eq!(grown(1 << 10, 5).maps_bytes, 5 * few.maps_bytes);
        assert!(grown(1 << 12, 0).maps_bytes > few.maps_bytes);
        assert!(few.total_bytes(Some(1)) < few.total_bytes(Some(1 << 10)));
        assert_eq!(few.total_bytes(Some(1 << 30)), few.total_bytes(None));
    }

    #[test]
    fn the_largest_numbers_are_no_panic() {
        let need = with(|settings| {
            settings.estimator = EstimatorKind::BidirectionalMap;
            (settings.map_elements, settings.replicates) = (u64::MAX, u32::MAX);
            (settings.list_terms, settings.map_photons) = (u32::MAX, u32::MAX);
        });
        assert_eq!(need.total_bytes(None), need.total_bytes(Some(u64::MAX)));
        assert!(need.total_bytes(None) > 1 << 60);
    }
}
