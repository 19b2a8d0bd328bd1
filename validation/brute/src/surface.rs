//! What triangles are made of.

/// How a triangle scatters light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Lambertian reflection.
    Grey {
        /// Reflected over incident flux.
        reflectance: f64,
        /// Whether the back reflects as the front does; else it is black.
        two_sided: bool,
    },
    /// A perfect mirror on both sides.
    Mirror {
        /// Reflected over incident flux.
        reflectance: f64,
    },
    /// The smooth surface of a clear closed body, its front outside: Fresnel's reflection and
    /// refraction.
    Glass {
        /// Refractive index inside over that outside; not 1.
        eta: f64,
    },
    /// A flat pane drawn as one sheet: two boundaries with light going to and fro between them.
    /// Light goes straight through or is mirrored.
    Pane {
        /// Refractive index; not 1.
        eta: f64,
        /// What is let through over what a clear pane lets through, at all angles.
        tint: f64,
    },
    /// Lambertian reflection and transmission, both sides alike.
    Sheet {
        /// Reflected over incident flux.
        reflectance: f64,
        /// Transmitted over incident flux; with the reflectance at most 1.
        transmittance: f64,
    },
    /// Rough metal on both sides: GGX facets with Schlick's reflectance, and light that is
    /// reflected several times between them.
    Metal {
        /// Of a facet at normal incidence.
        reflectance: f64,
        /// Width of the slopes: the square of the roughness.
        alpha: f64,
    },
}

impl Surface {
    /// Matt on both sides.
    #[must_use]
    pub const fn grey(reflectance: f64) -> Self {
        Self::Grey { reflectance, two_sided: true }
    }

    /// A clear pane.
    #[must_use]
    pub const fn clear_pane(eta: f64) -> Self {
        Self::Pane { eta, tint: 1.0 }
    }

    /// A pane of this transmittance at normal incidence; a clear one lets `2 eta / (eta^2 + 1)`
    /// through.
    #[must_use]
    pub fn tinted_pane(eta: f64, transmittance: f64) -> Self {
        Self::Pane { eta, tint: transmittance * (eta * eta + 1.0) / (2.0 * eta) }
    }

    /// Rough metal by its roughness.
    #[must_use]
    pub fn metal(reflectance: f64, roughness: f64) -> Self {
        Self::Metal { reflectance, alpha: roughness * roughness }
    }
}
