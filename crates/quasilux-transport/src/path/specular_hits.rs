//! Test for missed specular hits: whether one more hit of an emitting facet, over mirrors or
//! through glass, would move a value by more than its half-width.
//!
//! Next-event estimation sees past specular surfaces where plane mirrors show images, and through
//! flat panes. Past others, and where light comes over mirrors and through panes, a path finds an
//! emitting facet by chance, and then all of its luminance at once: `pi L` lux where it started
//! with the cosine distribution. Of a small bright facet a run may see no hit, or one of three, and
//! its spread does not tell. With n paths one hit more or less is `pi L / n`; where that is more
//! than the half-width and hits of this light are few, the value has no interval yet. Hits of
//! another light, however many, say nothing of it.

use crate::codec::{Sums, add_count};
use crate::spectrum::Spectrum;
use crate::world::World;
use quasilux_scene::{Light, Scene};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// So many hits, of all replicates, show in their spread.
const MIN_HITS: u64 = 16;

/// How often paths met each area light from specular surfaces, by its material.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct HitCounts(BTreeMap<u32, u64>);

impl HitCounts {
    pub(crate) fn count(&mut self, material: u32) {
        *self.0.entry(material).or_default() += 1;
    }

    /// Adds those of other paths.
    pub(crate) fn merge(&mut self, other: &Self) {
        other.0.iter().for_each(|(material, hits)| *self.0.entry(*material).or_default() += hits);
    }
}

impl Sums for HitCounts {
    fn checked_add(&mut self, other: &Self) -> Option<()> {
        let mut counts = other.0.iter();
        counts
            .try_for_each(|(material, hits)| add_count(self.0.entry(*material).or_default(), *hits))
    }
}

/// Lights that can be missed in a scene, and what one hit counts.
#[derive(Clone, Debug)]
pub(crate) struct SpecularHits {
    /// None where no path can come to one from a specular surface.
    lights: Vec<Glint>,
}

/// An area light behind a mirror or glass.
#[derive(Clone, Copy, Debug)]
struct Glint {
    material: u32,
    /// By one hit, in lx, times the number of paths.
    hit_lx: f64,
}

impl SpecularHits {
    /// Of paths that are reflected `most` at surfaces past which they do not ask for lights.
    pub(crate) fn new<S: Spectrum>(scene: &Scene, world: &World<S>, most: f64) -> Self {
        let glint = |light: &Light| match light {
            Light::Area(area) => {
                Some(Glint { material: area.material, hit_lx: PI * area.luminance_cd_m2 * most })
            }
            _ => None,
        };
        let is_seen = world.has_specular_facets();
        Self { lights: scene.lights.iter().filter(|_| is_seen).filter_map(glint).collect() }
    }

    /// Whether this many hits of so many paths say nothing of the error, beside this standard
    /// error.
    pub(crate) fn are_missed(&self, hits: &HitCounts, paths: u64, standard_error_lx: f64) -> bool {
        let half_width_lx = 2.0 * standard_error_lx;
        self.lights.iter().any(|light| {
            let own = hits.0.get(&light.material).copied().unwrap_or_default();
            own < MIN_HITS && light.hit_lx > half_width_lx * paths as f64
        })
    }
}

/// Warning about this number of sensor points.
pub(crate) fn warning(points: usize) -> Option<String> {
    (points > 0).then(|| {
        format!(
            "at {points} sensor points a single path that meets a bright light over a mirror or \
             through glass would change the value by more than its half-width, and fewer than \
             {MIN_HITS} did: values may be too low, and have no interval there"
        )
    })
}
