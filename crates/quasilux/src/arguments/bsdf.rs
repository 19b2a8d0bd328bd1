//! What can be said to `quasilux bsdf`.

use clap::Args;
use glam::DVec3;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(crate) struct BsdfArguments {
    /// Files of measured surfaces (WINDOW XML, MERL, ASTM E1392, DDR and DDT), told apart by their
    /// content, only DDT from DDR by the name; - is stdin, where both count as DDR
    #[arg(value_name = "FILE", required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Incident directions to report and draw: degrees from the normal, or from the normal and
    /// around it from x towards y; may be repeated
    #[arg(
        long = "incidence",
        value_name = "THETA[,PHI]",
        default_values = ["0", "30", "60"],
        value_parser = incidence,
    )]
    pub(crate) incidences: Vec<Incidence>,
    /// Draw where light goes in the plane of incidence: a file that ends in .svg, or a folder for
    /// one drawing of each FILE
    #[arg(long, value_name = "PATH")]
    pub(crate) svg: Option<PathBuf>,
    /// Print a document in JSON, format "quasilux-bsdf/2", and nothing else
    #[arg(long)]
    pub(crate) json: bool,
    /// Exit with code 1 where a file has warnings
    #[arg(long)]
    pub(crate) strict: bool,
}

/// An incident direction, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Incidence {
    theta_deg: f64,
    phi_deg: f64,
}

impl Incidence {
    /// Of a direction above the surface.
    pub(crate) fn from_direction(direction: DVec3) -> Self {
        let across = libm::hypot(direction.x, direction.y);
        let phi_deg = libm::atan2(direction.y, direction.x).to_degrees();
        Self {
            theta_deg: libm::atan2(across, direction.z).to_degrees(),
            // Also turns -0 into 0.
            phi_deg: if phi_deg < 0.0 { phi_deg + 360.0 } else { phi_deg.abs() },
        }
    }

    /// The unit direction.
    pub(crate) fn direction(self) -> DVec3 {
        let (sin_theta, cos_theta) = libm::sincos(self.theta_deg.to_radians());
        let (sin_phi, cos_phi) = libm::sincos(self.phi_deg.to_radians());
        DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta.max(0.0))
    }

    /// The polar angle and the azimuth.
    pub(crate) fn degrees(self) -> [f64; 2] {
        [self.theta_deg, self.phi_deg]
    }

    /// As people write it.
    pub(crate) fn text(self) -> String {
        let Self { theta_deg, phi_deg } = self;
        if phi_deg == 0.0 {
            format!("{theta_deg}\u{b0}")
        } else {
            format!("{theta_deg}\u{b0}, {phi_deg}\u{b0}")
        }
    }
}

fn incidence(text: &str) -> Result<Incidence, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    let (theta_deg, phi_deg) = match numbers.as_deref() {
        Some([theta]) => (*theta, 0.0),
        Some([theta, phi]) => (*theta, *phi),
        _ => (f64::NAN, 0.0),
    };
    if (0.0..90.0).contains(&theta_deg) && phi_deg.abs() <= 360.0 {
        Ok(Incidence { theta_deg, phi_deg })
    } else {
        Err("expected degrees from the normal, from 0 to below 90, as in 30 or 30,90".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_and_directions_belong_together() {
        for text in ["0", "30", "75,90", "45, 210"] {
            let read = incidence(text).expect("an incidence");
            let [theta_deg, phi_deg] = Incidence::from_direction(read.direction()).degrees();
            assert!((theta_deg - read.theta_deg).abs() < 1e-9, "{text}");
            assert!(theta_deg == 0.0 || (phi_deg - read.phi_deg).abs() < 1e-9, "{text}");
        }
        for text in ["", "90", "-1", "nan", "3,4,5", "30 90", "20,361"] {
            assert!(incidence(text).is_err(), "{text}");
        }
    }
}
