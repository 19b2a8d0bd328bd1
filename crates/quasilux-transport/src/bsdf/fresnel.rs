//! Reflection and refraction at a smooth boundary between two clear media (Fresnel's equations;
//! Born and Wolf 1999, section 1.5).

/// Light that meets a boundary from one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Boundary {
    /// Reflected over incident flux of light polarised across the plane of incidence.
    pub(super) across: f64,
    /// Reflected over incident flux of light polarised in the plane of incidence.
    pub(super) within: f64,
    /// Cosine of the refracted ray with the normal; 0 where all is reflected.
    pub(super) cos_refracted: f64,
}

impl Boundary {
    /// The boundary met at an angle of cosine `cos`; `eta` is the index behind it over the index
    /// before it.
    pub(super) fn new(cos: f64, eta: f64) -> Self {
        // Snell: sin^2 behind = sin^2 before / eta^2, written without a difference near 1.
        let cos_refracted_squared = (eta * eta - (1.0 - cos) * (1.0 + cos)) / (eta * eta);
        if cos_refracted_squared <= 0.0 {
            return Self { across: 1.0, within: 1.0, cos_refracted: 0.0 };
        }
        let cos_refracted = cos_refracted_squared.sqrt();
        let across = (cos - eta * cos_refracted) / (cos + eta * cos_refracted);
        let within = (eta * cos - cos_refracted) / (eta * cos + cos_refracted);
        Self { across: across * across, within: within * within, cos_refracted }
    }

    /// Reflected over incident flux of unpolarised light.
    pub(super) fn reflectance(&self) -> f64 {
        0.5 * (self.across + self.within)
    }
}

/// Reflected over incident flux of unpolarised light.
pub(super) fn fresnel(cos: f64, eta: f64) -> f64 {
    Boundary::new(cos, eta).reflectance()
}

/// Schlick's `(1 - cos)^5`: how far reflectance has risen from its value at normal incidence to 1
/// (Schlick 1994, equation 15).
pub(super) fn schlick(cos: f64) -> f64 {
    let x = (1.0 - cos).max(0.0);
    let squared = x * x;
    squared * squared * x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closed_forms_hold() {
        // Normal incidence: ((eta - 1) / (eta + 1))^2, 4 % of glass, from both sides.
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-15);
        assert!((fresnel(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-15);
        assert_eq!(fresnel(0.0, 1.5), 1.0);
        // Brewster: at tan theta = eta nothing is reflected within the plane of incidence.
        let brewster = Boundary::new(1.0 / (1.0 + 1.5 * 1.5_f64).sqrt(), 1.5);
        assert!(brewster.within < 1e-30 && brewster.across > 0.1);
        // Total reflection beyond sin theta = 1 / 1.5, and not before.
        let critical = (1.0 - 1.0 / (1.5 * 1.5_f64)).sqrt();
        assert_eq!(fresnel(critical - 1e-9, 1.0 / 1.5), 1.0);
        assert!(fresnel(critical + 1e-6, 1.0 / 1.5) < 1.0);
    }

    #[test]
    fn both_ways_through_a_boundary_are_alike() {
        for cos in [0.05, 0.3, 0.7, 0.99] {
            for eta in [0.7, 1.33, 1.5, 2.4] {
                let there = Boundary::new(cos, eta);
                if there.cos_refracted == 0.0 {
                    continue;
                }
                let back = Boundary::new(there.cos_refracted, 1.0 / eta);
                assert!((there.across - back.across).abs() < 1e-13);
                assert!((there.within - back.within).abs() < 1e-13);
                assert!((back.cos_refracted - cos).abs() < 1e-13);
                // Snell's law.
                let sine = |cos: f64| (1.0 - cos * cos).sqrt();
                assert!((sine(cos) - eta * sine(there.cos_refracted)).abs() < 1e-13);
            }
        }
    }
}
