//! Luminous intensities of lights without extent, at most, over cones of directions.

use glam::DVec3;
use quasilux_photometry::Angles;
use quasilux_scene::Light;
use quasilux_scene::light::Luminaire;
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
            Light::Luminaire(luminaire) => Some(Self::of_luminaire(luminaire)),
            Light::Area(_) => None,
        }
    }

    /// Of a luminaire as if all of its light came from its centre.
    pub(super) fn of_luminaire(luminaire: &Luminaire) -> Self {
        let photometry = &luminaire.photometry;
        let table = photometry.table();
        let azimuths: Vec<f64> = table.phi_rad().collect();
        let most = |theta_rad: &f64| {
            let at =
                |phi_rad: &f64| table.value_at(Angles { theta_rad: *theta_rad, phi_rad: *phi_rad });
            luminaire.dimming * azimuths.iter().map(at).fold(0.0, f64::max)
        };
        let pole = photometry.web().luminaire_from_table(DVec3::Z);
        Self {
            position: luminaire.position,
            pole: luminaire.world_from_luminaire * pole,
            theta_rad: table.theta_rad().to_vec(),
            most_cd: table.theta_rad().iter().map(most).collect(),
        }
    }

    /// At least the illuminance in lx, on a plane square to the way, at any place of a hull.
    pub(super) fn most_lx(&self, hull: &Hull<'_>) -> f64 {
        let [near_m, _] = hull.distances_m;
        let most_cd = self.most_cd(hull);
        // A light that lies in the hull, and sends nothing there.
        if most_cd == 0.0 { 0.0 } else { most_cd / (near_m * near_m) }
    }

    /// At least the intensity in cd toward any place of a hull.
    pub(super) fn most_cd(&self, hull: &Hull<'_>) -> f64 {
        let Hull { centre, radius_m, corners, distances_m: [near_m, far_m] } = *hull;
        // Around the direction of its centre.
        let way = centre - self.position;
        let distance_m = way.length();
        let theta_rad = libm::acos(self.pole.dot(way.normalize_or(self.pole)).clamp(-1.0, 1.0));
        let angle_rad = if radius_m < distance_m { libm::asin(radius_m / distance_m) } else { PI };
        // By heights along the pole.
        let heights_m = corners.iter().map(|corner| self.pole.dot(*corner - self.position));
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let [low_m, high_m] = heights_m.fold(ends, |[low, high], it| [low.min(it), high.max(it)]);
        let high_cos = high_m / if high_m > 0.0 { near_m } else { far_m };
        let low_cos = low_m / if low_m > 0.0 { far_m } else { near_m };
        self.most_between_cd([
            (theta_rad - angle_rad).max(libm::acos(high_cos.clamp(-1.0, 1.0))),
            (theta_rad + angle_rad).min(libm::acos(low_cos.clamp(-1.0, 1.0))),
        ])
    }

    /// The largest intensity in cd between two angles from the pole: a bilinear function has no
    /// more between two nodes than at them.
    fn most_between_cd(&self, [low_rad, high_rad]: [f64; 2]) -> f64 {
        let after = self.theta_rad.partition_point(|node| *node < low_rad).saturating_sub(1);
        let end = self.theta_rad.partition_point(|node| *node <= high_rad) + 1;
        self.most_cd[after..end.clamp(after, self.most_cd.len())]
            .iter()
            .copied()
            .fold(0.0, f64::max)
    }
}

/// The convex hull of some corners, as seen from a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull<'c> {
    pub(super) corners: &'c [DVec3],
    /// Of a ball around it.
    pub(super) centre: DVec3,
    pub(super) radius_m: f64,
    /// The least distance from the light, and the largest.
    pub(super) distances_m: [f64; 2],
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::radical_inverse;
    use quasilux_sampling::warp::sample_uniform_sphere;
    use std::array;

    fn number(index: u64, dimension: u32) -> f64 {
        radical_inverse([2, 3, 5, 7, 11, 13, 17, 19, 23][dimension as usize], index + 1)
    }

    /// Downward only, in degrees from its pole 90 of 1, 2, .. cd.
    fn downlight(index: u64) -> IntensityBound {
        let degrees = (0..=90_u32).map(f64::from);
        IntensityBound {
            position: DVec3::ZERO,
            pole: DVec3::from_array(sample_uniform_sphere([number(index, 0), number(index, 1)])),
            theta_rad: degrees.clone().map(f64::to_radians).collect(),
            most_cd: degrees.map(|degree| 90.0 - degree).collect(),
        }
    }

    fn hull(corners: &[DVec3; 3]) -> Hull<'_> {
        let centre = corners.iter().sum::<DVec3>() / 3.0;
        let radius_m = corners.iter().map(|it| it.distance(centre)).fold(0.0, f64::max);
        let far_m = corners.iter().map(|it| it.length()).fold(0.0, f64::max);
        Hull { corners, centre, radius_m, distances_m: [0.0, far_m] }
    }

    #[test]
    fn nothing_in_a_hull_gets_more() {
        for index in 0..2000 {
            let light = downlight(index);
            let corners: [DVec3; 3] = array::from_fn(|corner| {
                let at = |axis: u32| number(7 * index + corner as u64, 2 + axis) - 0.5;
                DVec3::new(at(0), at(1), at(2)) * 4.0 + light.pole * (number(index, 6) - 0.5)
            });
            let most_cd = light.most_cd(&hull(&corners));
            for place in 0..20 {
                let [u, v] = [number(place, 7), number(place, 8)];
                let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
                let [a, b, c] = corners;
                let way = (a + (b - a) * u + (c - a) * v).normalize();
                let degree = libm::acos(light.pole.dot(way)).to_degrees();
                let cd = (90.0 - degree).max(0.0);
                assert!(cd <= most_cd + 1e-9, "{cd} cd at {degree} degrees, at most {most_cd}");
            }
        }
    }

    /// However near the lamp it is.
    #[test]
    fn a_housing_behind_a_lamp_gets_nothing() {
        for index in 0..100 {
            let light = downlight(index);
            let across = light.pole.any_orthonormal_vector();
            let along = light.pole.cross(across);
            let corners = [across, along - across, -along - across];
            let corners = corners.map(|it| 0.6 * it - 0.01 * light.pole);
            assert_eq!(light.most_cd(&hull(&corners)), 0.0);
        }
    }

    /// A lamp in the plane of a ceiling that it sends nothing along.
    #[test]
    fn lamps_in_a_surface_may_send_nothing_there() {
        let mut lamp = IntensityBound { pole: DVec3::NEG_Z, ..downlight(0) };
        lamp.most_cd[80..].fill(0.0);
        let corners = [DVec3::new(2.0, 1.0, 0.0), DVec3::new(-2.0, 1.0, 0.0), DVec3::NEG_Y];
        assert_eq!(lamp.most_lx(&hull(&corners)), 0.0);
        let lower = corners.map(|it| it - DVec3::Z);
        assert!(lamp.most_lx(&hull(&lower)) > 0.0);
    }
}
