//! What luminaires with a luminous area give straight to a point, of each over the chance to ask
//! it, at most.
//!
//! A place y on the shape S around c, drawn along the direction w0 from c to the point x, gives
//! `I(w) p(w, y) / p(w0, y) (n.-w) / |x - y|^2` with w from y to x (`lights::area_luminaires`). On
//! flat shapes the densities are equal. On solids, which are convex, `n_y.(x - y) <= n_y.(x - c)`
//! makes their ratio `|x - c| / |x - y| A(w0) / A(w)` at most, and the silhouette A is never
//! smaller than the smallest along an axis.

use super::intensities::{Hull, IntensityBound};
use crate::lights::{AreaLuminaires, Asking};
use glam::DVec3;
use quasilux_scene::light::Luminaire;
use std::array;

/// All luminaires with an area.
pub(super) struct AskedLuminaires<'l, 'a> {
    lights: &'l AreaLuminaires<'a>,
    bounds: Vec<IntensityBound>,
}

impl<'l, 'a> AskedLuminaires<'l, 'a> {
    pub(super) fn new(lights: &'l AreaLuminaires<'a>) -> Self {
        let all = (0..).map_while(|number| lights.get(number));
        Self { lights, bounds: all.map(IntensityBound::of_luminaire).collect() }
    }

    /// The most in lx that a place that is asked gives anywhere on a disc of this radius, the
    /// chance to ask a luminaire taken as in its centre.
    pub(super) fn most_lx(&self, position: DVec3, n: DVec3, disc_m: f64) -> f64 {
        let asking = Asking { position, side: Some(n), own: None };
        let of_light = |(number, bound): (usize, &IntensityBound)| {
            let luminaire = self.lights.get(number)?;
            let probability = self.lights.probability(number, asking);
            let most_lx = || most_of_one_lx(luminaire, bound, [position, n], disc_m);
            (probability > 0.0).then(|| most_lx() / probability)
        };
        self.bounds.iter().enumerate().filter_map(of_light).fold(0.0, f64::max)
    }
}

/// The least distance in m of one that may be seen from a place to the side `n`, or a little less;
/// infinite where there is none.
pub(super) fn nearest_luminaire_m(lights: &AreaLuminaires<'_>, position: DVec3, n: DVec3) -> f64 {
    let distances_m = (0..).map_while(|number| lights.get(number)).filter_map(|luminaire| {
        let height_m = n.dot(luminaire.position - position);
        (height_m > -luminaire.shape.radius_m()).then(|| box_distance_m(luminaire, position))
    });
    distances_m.fold(f64::INFINITY, f64::min)
}

/// From a place to the box around the shape of a luminaire.
fn box_distance_m(luminaire: &Luminaire, position: DVec3) -> f64 {
    let half_m = 0.5 * luminaire.shape.size_m();
    let local = luminaire.world_from_luminaire.transpose() * (position - luminaire.position);
    (local - local.clamp(-half_m, half_m)).length()
}

/// Without the choice of it, on a disc with this centre and normal.
fn most_of_one_lx(
    luminaire: &Luminaire,
    bound: &IntensityBound,
    [centre, n]: [DVec3; 2],
    disc_m: f64,
) -> f64 {
    let shape = &luminaire.shape;
    let near_m = (box_distance_m(luminaire, centre) - disc_m).max(0.0);
    let way = centre - luminaire.position;
    // Seen from its places, all of them moved to its centre.
    let half_m = 0.5 * shape.size_m() + DVec3::splat(disc_m);
    let corners: [DVec3; 8] = array::from_fn(|corner| {
        let side = |axis: usize| if corner >> axis & 1 == 0 { half_m[axis] } else { -half_m[axis] };
        centre + luminaire.world_from_luminaire * DVec3::new(side(0), side(1), side(2))
    });
    let far_m = corners.iter().map(|it| it.distance(luminaire.position)).fold(0.0, f64::max);
    let (radius_m, distances_m) = (half_m.length(), [near_m, far_m]);
    let most_cd = bound.most_cd(&Hull { corners: &corners, centre, radius_m, distances_m });
    let highest_m = (shape.radius_m() - n.dot(way)).max(0.0);
    let lx = most_cd * (highest_m / near_m).min(1.0) / (near_m * near_m);
    if !shape.is_solid() {
        return lx;
    }
    let along_axes_m2 = DVec3::AXES.map(|axis| shape.projected_area_m2(axis));
    let least_m2 = along_axes_m2.into_iter().fold(f64::INFINITY, f64::min);
    // Silhouettes change with the direction by no more than the sum of those along the axes.
    let most_m2: f64 = along_axes_m2.iter().sum();
    let toward = luminaire.world_from_luminaire.transpose() * way.normalize_or_zero();
    let seen_m2 = shape.projected_area_m2(toward) + most_m2 * disc_m / near_m;
    lx * ((way.length() + disc_m) / near_m).max(1.0) * seen_m2.min(most_m2) / least_m2
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{diffuse, room};
    use glam::DMat3;
    use quasilux_photometry::{Axis, LuminousShape, Solid, read_ies};
    use quasilux_sampling::radical_inverse;
    use quasilux_sampling::warp::sample_uniform_sphere;
    use quasilux_scene::Light;
    use std::sync::Arc;

    fn number(index: u64, dimension: usize) -> f64 {
        radical_inverse([2, 3, 5, 7, 11, 13, 17, 19, 23, 29][dimension], index + 1)
    }

    /// 1000 cd straight down, less and less to the horizon, nothing above.
    const FILE: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 4 1 1 2 0 0 0\n1 1 1\n0 30 60 90\n0\n\
                        1000 700 200 0\n";

    /// On all kinds of shapes, turned, from places near and far, no place that is drawn gives more;
    /// the most that was found is not far below what is allowed from afar.
    #[test]
    fn no_place_gives_more() {
        let photometry = Arc::new(read_ies(FILE.as_bytes()).unwrap().photometry);
        let extents = DVec3::new(1.0, 0.6, 0.3);
        let solids = [Axis::X, Axis::Y, Axis::Z].map(Solid::Cylinder);
        let solids = solids.into_iter().chain([Solid::Cuboid, Solid::Ellipsoid]);
        let shapes = solids.map(|solid| LuminousShape::new(solid, extents)).chain([
            LuminousShape::new(Solid::Cuboid, DVec3::new(1.0, 0.6, 0.0)),
            LuminousShape::new(Solid::Cylinder(Axis::Z), DVec3::new(1.0, 0.6, 0.0)),
            LuminousShape::new(Solid::Cuboid, DVec3::X),
        ]);
        let mut closest = 0.0_f64;
        for (kind, shape) in shapes.enumerate() {
            for index in 0..200_u64 {
                let turn =
                    DVec3::from_array(sample_uniform_sphere([0, 1].map(|it| number(index, it))));
                let across = turn.any_orthonormal_vector();
                let luminaire = Luminaire {
                    photometry: photometry.clone(),
                    position: DVec3::new(3.0, -2.0, 1.0),
                    world_from_luminaire: DMat3::from_cols(across, turn.cross(across), turn),
                    dimming: 0.7,
                    shape,
                };
                let bound = IntensityBound::of_luminaire(&luminaire);
                let [away, n] = [2, 4].map(|first| {
                    let u = [first, first + 1].map(|it| number(index, it));
                    DVec3::from_array(sample_uniform_sphere(u))
                });
                let position = luminaire.position + away * (0.2 + 4.0 * number(index, 6));
                if box_distance_m(&luminaire, position) == 0.0 {
                    continue;
                }
                let disc_m = 0.125 * number(index, 9) * box_distance_m(&luminaire, position);
                let most_lx = most_of_one_lx(&luminaire, &bound, [position, n], disc_m);
                let mut scene = room(DVec3::ONE, diffuse(0.0));
                scene.lights.push(Light::Luminaire(luminaire.clone()));
                let lights = AreaLuminaires::new(&scene, None);
                let across = n.any_orthonormal_vector() * disc_m;
                for place in 0..40 {
                    let position = position + [across, -across, DVec3::ZERO][place as usize % 3];
                    let toward = luminaire.world_from_luminaire.transpose()
                        * (position - luminaire.position).normalize();
                    let u = [7, 8].map(|it| number(place, it));
                    let drawn = luminaire.shape.sample_silhouette(toward, u);
                    let found = lights.incidence(0, &drawn, position, |way| n.dot(way));
                    let lx = found.map_or(0.0, |it| it.illuminance_lx);
                    assert!(lx <= most_lx * (1.0 + 1e-9), "{kind}, {index}: {lx} of {most_lx}");
                    if position.distance(luminaire.position) > 3.0 {
                        closest = closest.max(lx / most_lx);
                    }
                }
            }
        }
        assert!(closest > 0.5, "{closest}");
    }
}
