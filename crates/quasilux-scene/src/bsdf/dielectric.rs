//! Clear bodies: glass, water, lenses.

/// The smooth surface of a clear body that absorbs nothing: Fresnel reflection, refraction, total
/// reflection. The body is closed, and the front side of its facets is outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Refractive index inside over that outside; not 1.
    pub eta: f64,
}
