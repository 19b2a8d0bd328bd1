//! Weights of bidirectional paths: the balance heuristic (Veach and Guibas 1995) over all vertices
//! at which an eye subpath and a light subpath can be connected.
//!
//! A way of light with n surfaces is found by n + 2 techniques at most: the light subpath makes its
//! first j surfaces, the eye subpath the others. With `p_j` the density of technique j, its
//! contribution `f / p_j` gets the weight `p_j / (p_0 + p_1 + ...)`. What it counts is therefore
//! `f / (p_0 + p_1 + ...)`: never more than the contribution of the same way in plain path tracing,
//! nor than that of a plain photon that is connected to the sensor, however badly the technique
//! suits the scene. No survey and no pilot enters these densities.
//!
//! The sums over all techniques are kept as two numbers a vertex, after I. Georgiev, "Implementing
//! vertex connection and merging", Saarland University 2012, section 4 (without merging): with `p`
//! the density of the vertex as its own subpath makes it, and all densities of the techniques that
//! leave it to the other subpath over that of the technique that does not,
//!
//! ```text
//! sum over the shorter subpaths = reverse density * (vcm + vc * density back from the vertex)
//! ```
//!
//! Russian roulette and the choice of one connection among several are left out of the densities:
//! the weights of a way still sum up to one.

/// What the techniques that leave vertices of a subpath to the other one weigh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct SubpathWeights {
    /// Of the technique that leaves this vertex alone, in m^2 once the vertex is reached.
    vcm: f64,
    /// Of those that leave more of them, in m^2 sr.
    vc: f64,
}

impl SubpathWeights {
    /// At a sensor point, which no light subpath can meet.
    pub(crate) const SENSOR: Self = Self { vcm: 0.0, vc: 0.0 };

    /// At the first surface, where light without extent lands with this density in m^-2: an eye
    /// subpath that ends here asks the light, and nothing meets it.
    pub(crate) fn of_landing(density_m2: f64) -> Self {
        Self { vcm: 1.0 / density_m2, vc: 0.0 }
    }

    /// On an emitting facet that a photon leaves with the density `emission` in m^-2 sr^-1 at this
    /// cosine, and that is asked for light with the density `pdf_m2`.
    pub(crate) fn of_emission(emission: f64, pdf_m2: f64, cos: f64) -> Self {
        Self { vcm: pdf_m2 / emission, vc: cos / emission }
    }

    /// After a flight of this length that ends at this cosine.
    pub(crate) fn arrived(self, distance_m: f64, cos: f64) -> Self {
        Self { vcm: self.vcm * distance_m * distance_m / cos, vc: self.vc / cos }
    }

    /// After a direction at this cosine was drawn with the density `pdf_sr`, where the opposite
    /// way has `reverse_pdf_sr`.
    pub(crate) fn scattered(self, cos: f64, pdf_sr: f64, reverse_pdf_sr: f64) -> Self {
        Self { vcm: 1.0 / pdf_sr, vc: cos / pdf_sr * self.towards(reverse_pdf_sr) }
    }

    /// After one of finitely many directions was taken, at this cosine.
    pub(crate) fn mirrored(self, cos: f64) -> Self {
        Self { vcm: 0.0, vc: self.vc * cos }
    }

    /// Sum over the techniques that leave this vertex and perhaps more to the other subpath, over
    /// the density in m^-2 with which that makes this vertex; `reverse_pdf_sr` is its density of
    /// the direction to the vertex before.
    pub(crate) fn towards(self, reverse_pdf_sr: f64) -> f64 {
        // Nothing may come of what is not possible, not even where it would be infinitely likely.
        let more = if reverse_pdf_sr > 0.0 { self.vc * reverse_pdf_sr } else { 0.0 };
        self.vcm + more
    }

    /// The weight of an eye subpath that runs into a facet: `pdf_m2` as it is asked for light,
    /// `emission` as a photon leaves it.
    pub(crate) fn of_hit(self, pdf_m2: f64, emission: f64) -> f64 {
        1.0 / (1.0 + pdf_m2 * self.vcm + emission * self.vc)
    }
}

/// The weight of a connection: the sums over the techniques to either side, each a density times
/// [`SubpathWeights::towards`].
pub(crate) fn of_connection(to_eye: f64, to_light: f64) -> f64 {
    1.0 / (1.0 + to_eye + to_light)
}

/// A density times the weight of what it leads to.
pub(crate) fn product(density: f64, weight: f64) -> f64 {
    if density > 0.0 { density * weight } else { 0.0 }
}
