//! The most that one sample can add to a pixel.

use super::surfaces::Surfaces;
use super::{Engine, Kind, Straight, crossings_of_discs, kinds, samples_of_subpaths};
use crate::bsdf::Bsdf;
use crate::spectrum::Spectrum;
use std::f64::consts::FRAC_1_PI;

/// `K W` of pixels, of each kind of lights. Joins are left out, so it depends on no place.
pub(in crate::estimator::bidirectional) struct PixelCaps(Vec<PixelCap>);

/// Of one kind.
struct PixelCap {
    /// Of what comes straight to the camera, or to what it sees, in cd/m^2: by eye paths alone.
    straight_cd_m2: f64,
    /// Of eye paths that find the rest, in cd/m^2.
    of_eye_cd_m2: f64,
    /// Of photons on a disc, times its area, in cd.
    of_photons_cd: f64,
}

impl PixelCaps {
    pub(in crate::estimator::bidirectional) fn new<S: Spectrum>(
        engine: &Engine<'_, '_, S>,
    ) -> Self {
        let world = &engine.context.world;
        let surfaces = Surfaces::new(engine.context);
        let samples = samples_of_subpaths(world);
        let crossings = crossings_of_discs(world);
        let scale = world.bsdfs().iter().map(Bsdf::scale_inside).fold(1.0, f64::max);
        let has_specular = world.has_specular_facets();
        let of_kind = |kind: &Kind| {
            let straight_lx = match kind.straight {
                Straight::AtMost(lx) => lx,
                Straight::Computed | Straight::OfLuminaires => 0.0,
            };
            let met_lx = if has_specular { kind.met_lx } else { 0.0 };
            let eye_lx = kind.eye_samples * kind.eye_lx.max(met_lx);
            PixelCap {
                straight_cd_m2: scale * straight_lx * FRAC_1_PI,
                of_eye_cd_m2: scale * eye_lx * FRAC_1_PI,
                of_photons_cd: scale * surfaces.most_sr() * kind.flux_lm * samples * crossings,
            }
        };
        Self(kinds(engine, &surfaces, samples).iter().map(of_kind).collect())
    }

    /// Of a pixel whose photons count on discs of this area at least: 0 where none count.
    pub(in crate::estimator::bidirectional) fn most_cd_m2(&self, disc_m2: f64) -> f64 {
        let most = |cap: &PixelCap| {
            let of_photons_cd_m2 = cap.of_photons_cd / disc_m2;
            cap.straight_cd_m2.max(cap.of_eye_cd_m2.min(of_photons_cd_m2))
        };
        self.0.iter().map(most).fold(0.0, f64::max)
    }
}
