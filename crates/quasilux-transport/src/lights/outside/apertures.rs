//! Openings as lines from outside go through them.
//!
//! A line of direction w that is drawn through opening i, evenly over it and with the probability
//! `A_i |n_i w| g_i / S`, `S = sum A_j |n_j w| g_j`, has the density `g_i / S` across w, whatever
//! its tilt. With that of all openings which it goes through the density is `(sum g) / S`: it does
//! not matter by which of them it was drawn. The weights g say about how much of the light that
//! would come through a side of an opening gets there; none is 0, so every line may be drawn.

use super::Portal;
use glam::DVec3;
use quasilux_bvh::{Corners, PreparedRay, Ray, intersect};
use quasilux_sampling::choose_weights;
use quasilux_sampling::warp::sample_triangle;
use std::collections::BTreeMap;

/// The least g: what is found to be shut may be open a chink.
const LEAST: f64 = 1.0 / 16.0;
/// Normals that differ by less, in parts of their length, are taken together where much is asked.
const STEPS_OF_NORMALS: f64 = 16.0;

/// All openings.
pub(super) struct Apertures {
    apertures: Vec<Aperture>,
    /// Area vectors of sides by their direction, g folded in, out of the side.
    sides_m2: Vec<DVec3>,
    /// Lines are followed from so far before the place that they are drawn through, in m: from
    /// beyond everything.
    reach_m: f64,
}

/// A triangle of an opening.
struct Aperture {
    corners: Corners,
    n: DVec3,
    area_m2: f64,
    /// g, of light from where n points to, and from the other side.
    open: [f64; 2],
}

/// A line drawn through openings.
#[derive(Clone, Copy, Debug)]
pub(super) struct ThroughApertures {
    /// The place in one of them.
    pub(super) point: DVec3,
    /// One over its density in m^-2 among lines of its direction.
    pub(super) per_density_m2: f64,
}

impl Aperture {
    /// Its silhouette along a direction, g folded in.
    fn size_m2(&self, direction: DVec3) -> f64 {
        self.area_m2 * self.n.dot(direction).abs() * self.open_to(direction)
    }

    fn open_to(&self, direction: DVec3) -> f64 {
        self.open[usize::from(self.n.dot(direction) > 0.0)]
    }
}

impl Apertures {
    /// `openness` says for each portal about which part of the light that comes from where its
    /// normal points to, and from the other side, gets there.
    pub(super) fn new(portals: &[Portal], openness: &[[f64; 2]], reach_m: f64) -> Self {
        let aperture = |(portal, open): (&Portal, &[f64; 2])| Aperture {
            corners: portal.corners,
            n: portal.n,
            area_m2: portal.area_m2(),
            open: open.map(|open| open.clamp(LEAST, 1.0)),
        };
        let apertures: Vec<Aperture> = portals.iter().zip(openness).map(aperture).collect();
        let mut sides_m2: BTreeMap<[i64; 3], DVec3> = BTreeMap::new();
        for Aperture { n, area_m2, open, .. } in &apertures {
            for (n, open) in [(*n, open[0]), (-*n, open[1])] {
                let key = (n * STEPS_OF_NORMALS).round().to_array().map(|x| x as i64);
                *sides_m2.entry(key).or_default() += n * (*area_m2 * open);
            }
        }
        Self { apertures, sides_m2: sides_m2.into_values().collect(), reach_m }
    }

    /// About the sum of their silhouettes along a direction, g folded in, in m^2.
    pub(super) fn about_m2(&self, direction: DVec3) -> f64 {
        self.sides_m2.iter().map(|side| (-side.dot(direction)).max(0.0)).sum()
    }

    /// A line of this direction.
    pub(super) fn sample_line(&self, direction: DVec3, u: [f64; 2]) -> Option<ThroughApertures> {
        let sizes_m2 = || self.apertures.iter().map(|aperture| aperture.size_m2(direction));
        let choice = choose_weights(u[0], sizes_m2())?;
        let chosen = &self.apertures[choice.index];
        let [a, b, c] = chosen.corners.points();
        let weights = sample_triangle([choice.u_remapped, u[1]]);
        let point = a * weights[0] + b * weights[1] + c * weights[2];
        let sum_m2: f64 = sizes_m2().sum();
        let crossed = self.crossed(point, direction, Some(choice.index));
        Some(ThroughApertures { point, per_density_m2: sum_m2 / crossed })
    }

    /// The most that [`ThroughApertures::per_density_m2`] can be for directions within this angle
    /// in radians of one.
    pub(super) fn most_m2(&self, direction: DVec3, within: f64) -> f64 {
        let (mut least, mut sum_m2) = (f64::INFINITY, 0.0);
        for aperture in &self.apertures {
            let cos = aperture.n.dot(direction);
            // Edge-on some may come to either side.
            let [few, many] = match cos.abs() > within {
                true => [aperture.open_to(direction); 2],
                false => {
                    [aperture.open[0].min(aperture.open[1]), aperture.open[0].max(aperture.open[1])]
                }
            };
            least = least.min(few);
            sum_m2 += aperture.area_m2 * (cos.abs() + within) * many;
        }
        sum_m2 / least
    }

    /// Density in m^-2, among lines of its direction, of [`Self::sample_line`] at that through a
    /// point.
    pub(super) fn pdf_line(&self, point: DVec3, direction: DVec3) -> f64 {
        let sum_m2: f64 = self.apertures.iter().map(|it| it.size_m2(direction)).sum();
        if sum_m2 > 0.0 { self.crossed(point, direction, None) / sum_m2 } else { 0.0 }
    }

    /// Whether the line of this direction through a point goes through any.
    pub(super) fn is_crossed(&self, point: DVec3, direction: DVec3) -> bool {
        self.crossed(point, direction, None) > 0.0
    }

    /// Whether a ray goes through any.
    pub(super) fn is_crossed_after(&self, origin: DVec3, direction: DVec3) -> bool {
        let prepared = PreparedRay::new(&Ray::new(origin, direction));
        self.apertures.iter().any(|it| intersect(&prepared, &it.corners, 0).is_some())
    }

    /// The sum of g over those that a line goes through, `surely` among them.
    fn crossed(&self, point: DVec3, direction: DVec3, surely: Option<usize>) -> f64 {
        let prepared = PreparedRay::new(&Ray::new(point - direction * self.reach_m, direction));
        let is_crossed = |number: usize, aperture: &Aperture| {
            surely == Some(number) || intersect(&prepared, &aperture.corners, 0).is_some()
        };
        let crossed =
            self.apertures.iter().enumerate().filter(|(number, it)| is_crossed(*number, it));
        crossed.map(|(_, aperture)| aperture.open_to(direction)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::radical_inverse;

    fn portals() -> Vec<Portal> {
        let corners = |at: DVec3, u: DVec3, v: DVec3| Portal::new([at, at + u, at + v]).unwrap();
        vec![
            corners(DVec3::ZERO, DVec3::X, DVec3::Y),
            corners(DVec3::new(0.0, 0.0, 1.0), DVec3::X, DVec3::new(0.0, 0.8, 0.6)),
            corners(DVec3::new(2.0, 0.0, 0.0), DVec3::Y, DVec3::Z),
        ]
    }

    /// The area across a direction that any of the openings covers, by the lines drawn through
    /// them, against a count of lines of a grid that meet one: 1 % is found.
    #[test]
    fn lines_through_several_openings_count_once() {
        let open = [[1.0, 0.5], [0.25, 0.0], [0.7, 1.0]];
        let apertures = Apertures::new(&portals(), &open, 10.0);
        for direction in [DVec3::new(0.1, 0.2, -1.0), DVec3::new(-1.0, 0.1, 0.3), DVec3::Z] {
            let direction = direction.normalize();
            let (lines, grid) = (1_u64 << 14, 1500);
            let drawn = (0..lines).map(|index| {
                let u = [2, 3].map(|base| radical_inverse(base, index + 1));
                apertures.sample_line(direction, u).unwrap().per_density_m2
            });
            let drawn_m2 = drawn.sum::<f64>() / lines as f64;
            let a = direction.any_orthonormal_vector();
            let b = direction.cross(a);
            let (edge_m, mut met) = (8.0, 0);
            for i in 0..grid {
                for j in 0..grid {
                    let [x, y] =
                        [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(grid) * edge_m - 4.0);
                    met += i32::from(apertures.is_crossed(a * x + b * y, direction));
                }
            }
            let expected_m2 = f64::from(met) / f64::from(grid * grid) * edge_m * edge_m;
            assert!((drawn_m2 / expected_m2 - 1.0).abs() < 0.01, "{drawn_m2}, not {expected_m2}");
        }
    }

    /// Lines toward all of a disk like the sun's, high, low, and edge-on to openings: none stands
    /// for more than the most, which with the middle of the disk alone one of them does.
    #[test]
    fn no_line_from_a_disk_stands_for_more_than_the_most() {
        let apertures = Apertures::new(&portals(), &[[1.0, 0.5], [0.25, 1.0], [0.7, 1.0]], 10.0);
        let (within, mut passed_middle) = (0.00465, false);
        for middle in [DVec3::new(0.3, 0.5, -0.8), DVec3::new(1.0, 0.01, -0.001), DVec3::X] {
            let middle = middle.normalize();
            let a = middle.any_orthonormal_vector();
            let b = middle.cross(a);
            let most_m2 = apertures.most_m2(middle, within);
            for index in 0..2000 {
                let [turn, u, v] = [2, 3, 5].map(|base| radical_inverse(base, index + 1));
                let (sin, cos) = libm::sincos(std::f64::consts::TAU * turn);
                let direction = (middle + (a * cos + b * sin) * within).normalize();
                let Some(line) = apertures.sample_line(direction, [u, v]) else { continue };
                assert!(line.per_density_m2 <= most_m2, "{direction}");
                passed_middle |= line.per_density_m2 > apertures.most_m2(middle, 0.0);
            }
        }
        assert!(passed_middle);
    }

    #[test]
    fn area_vectors_give_the_silhouettes() {
        let apertures = Apertures::new(&portals(), &[[1.0, 0.5], [0.25, 1.0], [0.7, 1.0]], 10.0);
        for direction in [DVec3::new(0.3, 0.5, -0.8), DVec3::new(-0.3, 0.1, 0.6)] {
            let direction = direction.normalize();
            let sizes = apertures.apertures.iter().map(|aperture| aperture.size_m2(direction));
            assert!((sizes.sum::<f64>() - apertures.about_m2(direction)).abs() < 1e-12);
        }
    }
}
