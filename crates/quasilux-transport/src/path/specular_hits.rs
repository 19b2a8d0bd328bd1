//! Test for missed specular hits: whether one more hit of an emitting facet, over mirrors or
//! through glass, would move a value by more than its half-width.
//!
//! Next-event estimation does not see past a specular surface. A path that comes from one finds an
//! emitting facet by chance, and then all of its luminance at once: `pi L` lux where it started
//! with the cosine distribution. Of a small bright facet a run may see no hit, or one of three, and
//! its spread does not tell. With n paths one hit more or less is `pi L / n`; where that is more
//! than the half-width and hits are few, the value has no interval yet.

use crate::world::World;
use quasilux_scene::{Light, Scene};
use std::f64::consts::PI;

/// So many hits, of all replicates, show in their spread.
const MIN_HITS: u64 = 16;

/// Whether hits can be missed in a scene, and what one counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SpecularHits {
    /// Of the brightest facet, in lx; 0 where no path can come to one from a specular surface.
    largest_lx: f64,
}

impl SpecularHits {
    pub(crate) fn new<S: crate::spectrum::Spectrum>(scene: &Scene, world: &World<S>) -> Self {
        let luminances = scene.lights.iter().map(|light| match light {
            Light::Area(area) => area.luminance_cd_m2,
            _ => 0.0,
        });
        let brightest_cd_m2 = luminances.fold(0.0, f64::max);
        let largest_lx = if world.has_specular_facets() { PI * brightest_cd_m2 } else { 0.0 };
        Self { largest_lx }
    }

    /// Whether this many hits of so many paths say nothing of the error, beside this standard
    /// error.
    pub(crate) fn are_missed(&self, hits: u64, paths: u64, standard_error_lx: f64) -> bool {
        let half_width_lx = 2.0 * standard_error_lx;
        hits < MIN_HITS && self.largest_lx > half_width_lx * paths as f64
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
