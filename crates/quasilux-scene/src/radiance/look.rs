//! Materials of Radiance to surfaces that quasilux has: one mapping for all readers.
//!
//! Radiance's materials are described in its reference manual ("The RADIANCE 5.1 Synthetic Imaging
//! System", 2016); docs/from-radiance.md compares them with those of a project file. Shares are
//! from 0 to 1, of linear light; readers check them.

use super::findings::Findings;
use super::glass;
use crate::bsdf::{AngularTable, Conductor, Diffuse, Mirror, Plastic, Translucent};
use crate::bsdf::{Dielectric, Pane};
use crate::{Bsdf, Rgb};
use glam::DVec3;
use quasilux_text::Position;
use std::sync::Arc;

/// Lumens a watt of Radiance's white.
pub(crate) const EFFICACY_LM_W: f64 = 179.0;
/// Radiance's weights of red, green and blue in a luminance.
const RADIANCE_WEIGHTS: [f64; 3] = [0.265, 0.670, 0.065];
/// The width that a smooth highlight gets.
const MIN_ALPHA: f64 = 0.0004;
/// Largest index of a surface with a highlight.
const MAX_ETA: f64 = 5.0;

/// Surface that a material makes.
#[derive(Clone, Debug)]
pub(crate) enum Look {
    /// A surface.
    Surface(Arc<Bsdf>),
    /// A measured sheet: its modifier, the text of its XML file, and where its tables point upward.
    Sheet { name: Arc<str>, xml: Arc<str>, up: DVec3 },
    /// A black surface that shines with this luminance in cd/m2 to its front.
    Light(f64),
    /// Nothing at all.
    Open,
    /// Something that quasilux has nothing for, in the words of a refusal.
    Unknown(Unusable),
}

/// Why a material is refused, and where it is defined.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unusable {
    pub(crate) message: String,
    pub(crate) place: Option<(Arc<str>, Position)>,
}

impl From<String> for Unusable {
    fn from(message: String) -> Self {
        Self { message, place: None }
    }
}

impl From<Bsdf> for Look {
    fn from(bsdf: Bsdf) -> Self {
        Self::Surface(Arc::new(bsdf))
    }
}

/// Colour and highlight of a `plastic` or a `metal`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coated {
    pub(crate) reflectance: Rgb,
    pub(crate) specularity: f64,
    pub(crate) roughness: f64,
}

/// The looks of materials at a place that findings name.
pub(crate) struct Looks<'f> {
    pub(crate) place: &'f str,
    pub(crate) findings: &'f mut Findings,
}

impl Looks<'_> {
    pub(crate) fn note(&mut self, message: &str) {
        self.findings.note(self.place, message);
    }

    pub(crate) fn plastic(&mut self, coated: Coated) -> Look {
        let Coated { reflectance, specularity, roughness } = coated;
        if specularity == 0.0 {
            return Look::from(Bsdf::Diffuse(Diffuse { reflectance }));
        }
        self.note("its highlight follows Fresnel's equations, near Radiance's and not the same");
        // The index whose reflectance at normal incidence is the specularity.
        let root = specularity.sqrt();
        let eta = (1.0 + root) / (1.0 - root);
        if eta > MAX_ETA {
            self.note("its specularity is above 0.44, and taken as 0.44");
        }
        let eta = eta.clamp(1.0 + 1e-9, MAX_ETA);
        let alpha = roughness.max(MIN_ALPHA);
        Look::from(Bsdf::Plastic(Plastic { reflectance, eta, alpha }))
    }

    pub(crate) fn metal(&mut self, coated: Coated) -> Look {
        let Coated { reflectance, specularity, roughness } = coated;
        Look::from(if specularity == 0.0 {
            Bsdf::Diffuse(Diffuse { reflectance })
        } else if roughness == 0.0 && specularity == 1.0 {
            Bsdf::Mirror(Mirror { reflectance })
        } else {
            self.note(
                "all of the metal's light is in its highlight, near Radiance's and not the same",
            );
            Bsdf::Conductor(Conductor { reflectance, alpha: roughness.max(MIN_ALPHA) })
        })
    }

    /// Of `transmitted`, the share that is not reflected, `straight` is the share that goes on in
    /// its direction.
    pub(crate) fn trans(&mut self, coated: Coated, transmitted: f64, straight: f64) -> Look {
        let Coated { reflectance: colour, specularity, roughness } = coated;
        let rest = colour * (1.0 - specularity);
        let is_straight = specularity > 0.0 || transmitted * straight > 0.0;
        if is_straight && roughness > 0.0 {
            self.note("its roughness is left out");
        }
        if transmitted == 1.0 && straight == 1.0 && colour.is_grey() {
            let passed = rest.luminance();
            if passed == 1.0 {
                return Look::Open;
            }
            let [through, back] = [passed, specularity].map(AngularTable::constant);
            return Look::from(Bsdf::Pane(Pane::measured(through, back)));
        }
        if is_straight {
            self.note(
                "light that Radiance mirrors or lets straight through it is scattered in all \
                 directions here, as much of it",
            );
        }
        let reflectance = rest * (1.0 - transmitted) + Rgb::grey(specularity);
        let transmittance = rest * transmitted;
        Look::from(Bsdf::Translucent(Translucent { reflectance, transmittance }))
    }

    /// By index and transmissivity, the share that is left after one way straight through.
    pub(crate) fn glass(&mut self, eta: f64, transmissivity: Rgb) -> Look {
        let pane = if transmissivity.is_grey() {
            glass::grey(eta, transmissivity.luminance())
        } else {
            self.note("coloured glass takes as much of slant light as of straight light");
            glass::coloured(eta, transmissivity)
        };
        Look::from(Bsdf::Pane(pane))
    }

    /// A closed body, by the index inside over that outside.
    pub(crate) fn dielectric(&mut self, eta: f64) -> Look {
        if (eta - 1.0).abs() < 1e-6 {
            self.note("a body of the index of what is around it is left out");
            return Look::Open;
        }
        Look::from(Bsdf::Dielectric(Dielectric { eta }))
    }

    /// By the radiance in W/sr/m2 of three channels; the light of `glow` reaches `max_radius`.
    pub(crate) fn light(&mut self, radiance: [f64; 3], max_radius: f64) -> Look {
        if radiance.iter().any(|&channel| channel != radiance[0]) {
            self.note("the colour of its light is left out");
        }
        if max_radius < 0.0 {
            self.note("a glow that lights nothing is black here");
        } else if max_radius > 0.0 {
            self.note("its light reaches beyond max_radius here");
        }
        let luminance = luminance_cd_m2(radiance);
        if max_radius < 0.0 || luminance == 0.0 {
            return Look::from(Bsdf::Diffuse(Diffuse { reflectance: Rgb::BLACK }));
        }
        Look::Light(luminance)
    }
}

/// The luminance in cd/m2 of a radiance in W/sr/m2.
pub(crate) fn luminance_cd_m2(radiance: [f64; 3]) -> f64 {
    let weighted = radiance.iter().zip(RADIANCE_WEIGHTS).map(|(&it, weight)| it * weight);
    EFFICACY_LM_W * weighted.sum::<f64>()
}

/// A surface that is there, and that light passes as if it were not.
pub(crate) fn invisible() -> Bsdf {
    let [through, back] = [1.0, 0.0].map(AngularTable::constant);
    Bsdf::Pane(Pane::measured(through, back))
}
