//! Luminous intensities of lights without extent, at most, over cones of directions.

use glam::DVec3;
use quasilux_photometry::Angles;
use quasilux_scene::Light;
use std::f64::consts::PI;

/// A light at a point, with its largest intensity by the angle from the pole of its table.
pub(super) struct IntensityBound {
    pub(super) position: DVec3,
    /// Unit vector.
    pole: DVec3,
    theta_rad: Vec<f64>,
    /// Over all azimuths, in cd.
    most_cd: Vec<f64>,
}

impl IntensityBound {
    /// `None` of area lights.
    pub(super) fn new(light: &Light) -> Option<Self> {
        match light {
            Light::Point(point) => Some(Self {
                position: point.position,
                pole: DVec3::Z,
                theta_rad: vec![0.0, PI],
                most_cd: vec![point.intensity_cd; 2],
            }),
            Light::Luminaire(luminaire) => {
                let photometry = &luminaire.photometry;
                let table = photometry.table();
                let azimuths: Vec<f64> = table.phi_rad().collect();
                let most = |theta_rad: &f64| {
                    let at = |phi_rad: &f64| {
                        let angles = Angles { theta_rad: *theta_rad, phi_rad: *phi_rad };
                        table.value_at(angles)
                    };
                    luminaire.dimming * azimuths.iter().map(at).fold(0.0, f64::max)
                };
                let pole = photometry.web().luminaire_from_table(DVec3::Z);
                Some(Self {
                    position: luminaire.position,
                    pole: luminaire.world_from_luminaire * pole,
                    theta_rad: table.theta_rad().to_vec(),
                    most_cd: table.theta_rad().iter().map(most).collect(),
                })
            }
            Light::Area(_) => None,
        }
    }

    /// At least the intensity in cd along any direction that is no more than an angle from this
    /// unit vector.
    pub(super) fn most_cd(&self, direction: DVec3, angle_rad: f64) -> f64 {
        let theta_rad = libm::acos(self.pole.dot(direction).clamp(-1.0, 1.0));
        let (low, high) = (theta_rad - angle_rad, theta_rad + angle_rad);
        // A bilinear function has no more between two nodes than at them.
        let after = self.theta_rad.partition_point(|node| *node < low).saturating_sub(1);
        let end =
            (self.theta_rad.partition_point(|node| *node <= high) + 1).min(self.most_cd.len());
        self.most_cd[after..end].iter().copied().fold(0.0, f64::max)
    }
}
