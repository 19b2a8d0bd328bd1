//! Few portals for many: each place weighs all of them, so thousands of panes would take all time.
//!
//! Triangles that lie nearly in one plane become a rectangle around them, in ever coarser steps
//! until few are left. Portals say where to look for light, and what they show besides costs noise
//! alone; so light is neither lost nor found twice.

use glam::DVec3;
use std::collections::BTreeMap;

/// More portals are put together.
const MAX_PORTALS: usize = 256;
/// The finest steps of directions and, over the size of all, of distances that are taken as one.
const FINEST: [f64; 2] = [1.0 / 64.0, 1.0 / 1024.0];
/// Each step is twice as coarse; at the last one all directions and distances are one.
const STEPS: i32 = 12;

/// The triangles themselves, or the halves of rectangles around groups of them.
pub(super) fn few(triangles: Vec<[DVec3; 3]>) -> Vec<[DVec3; 3]> {
    if triangles.len() <= MAX_PORTALS {
        return triangles;
    }
    let corners = || triangles.iter().flatten().copied();
    let low = corners().fold(DVec3::INFINITY, DVec3::min);
    let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
    let size_m = (high - low).length();
    let mut groups: Vec<Vec<[DVec3; 3]>> = Vec::new();
    for step in 0..STEPS {
        groups = in_planes(&triangles, low, size_m, libm::ldexp(1.0, step));
        if 2 * groups.len() <= MAX_PORTALS {
            break;
        }
    }
    groups.iter().flat_map(|group| halves(group)).collect()
}

/// Groups of triangles that lie in one plane, up to this many of the finest steps.
fn in_planes(
    triangles: &[[DVec3; 3]],
    origin: DVec3,
    size_m: f64,
    coarseness: f64,
) -> Vec<Vec<[DVec3; 3]>> {
    let mut groups: BTreeMap<[i64; 4], Vec<[DVec3; 3]>> = BTreeMap::new();
    for triangle in triangles {
        let Some(n) = normal(triangle) else { continue };
        let [angle, distance] = FINEST.map(|finest| finest * coarseness);
        let along = n.dot(triangle[0] - origin) / (distance * size_m);
        let key = (n / angle).extend(along).round().to_array().map(|x| x as i64);
        groups.entry(key).or_default().push(*triangle);
    }
    groups.into_values().collect()
}

/// The unit normal, on the side that looks along the first axis that it is not across; `None` of a
/// triangle without area.
fn normal([a, b, c]: &[DVec3; 3]) -> Option<DVec3> {
    let n = (b - a).cross(c - a).try_normalize()?;
    let first = n.to_array().into_iter().find(|x| x.abs() > 1e-9)?;
    Some(if first < 0.0 { -n } else { n })
}

/// The halves of a rectangle around triangles, in their mean plane, and along that edge of the
/// first one which makes it small.
fn halves(triangles: &[[DVec3; 3]]) -> Vec<[DVec3; 3]> {
    let normals = triangles.iter().filter_map(normal);
    let Some(n) = normals.sum::<DVec3>().try_normalize() else { return Vec::new() };
    let [a, b, c] = triangles[0];
    let edges = [b - a, c - b, a - c].map(|edge| edge.reject_from_normalized(n).try_normalize());
    let rectangles = edges.into_iter().flatten().map(|u| Rectangle::around(triangles, n, u));
    let smallest = rectangles.min_by(|a, b| a.area_m2().total_cmp(&b.area_m2()));
    smallest.map_or_else(Vec::new, |rectangle| rectangle.halves().to_vec())
}

struct Rectangle {
    /// Two unit vectors along its edges.
    along: [DVec3; 2],
    /// From where to where it goes along them, in m.
    ranges_m: [[f64; 2]; 2],
    /// A place in its plane, the nearest to the origin.
    foot: DVec3,
}

impl Rectangle {
    fn around(triangles: &[[DVec3; 3]], n: DVec3, u: DVec3) -> Self {
        let along = [u, n.cross(u)];
        let corners = || triangles.iter().flatten();
        let range_m = |side: DVec3| {
            let places = corners().map(|corner| side.dot(*corner));
            let all = [f64::INFINITY, f64::NEG_INFINITY];
            places.fold(all, |[low, high], x| [low.min(x), high.max(x)])
        };
        let height_m = corners().map(|corner| n.dot(*corner)).sum::<f64>();
        let foot = n * (height_m / (3 * triangles.len()) as f64);
        Self { along, ranges_m: along.map(range_m), foot }
    }

    fn area_m2(&self) -> f64 {
        self.ranges_m.iter().map(|[low, high]| high - low).product()
    }

    fn halves(&self) -> [[DVec3; 3]; 2] {
        let Self { along: [u, v], ranges_m: [[left, right], [low, high]], foot } = *self;
        let at = |x: f64, y: f64| foot + u * x + v * y;
        let [a, b, c, d] = [at(left, low), at(right, low), at(right, high), at(left, high)];
        [[a, b, c], [a, c, d]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tile(x: f64, y: f64, z: f64) -> [[DVec3; 3]; 2] {
        let at = |u: f64, v: f64| DVec3::new(x + 0.01 * u, y, z + 0.01 * v);
        [[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]]
    }

    fn area_m2(triangles: &[[DVec3; 3]]) -> f64 {
        triangles.iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).length()).sum()
    }

    #[test]
    fn few_stay_as_they_are() {
        let tiles: Vec<[DVec3; 3]> = (0..128).flat_map(|k| tile(f64::from(k), 0.0, 1.0)).collect();
        assert_eq!(few(tiles.clone()), tiles);
    }

    /// Of tiles of two windows in two walls each window becomes a rectangle of its size.
    #[test]
    fn tiles_of_windows_become_windows() {
        let grid = |k: i32| (0.01 * f64::from(k % 40), 0.01 * f64::from(k / 40));
        let tiles = (0..1600).flat_map(|k| {
            let (x, z) = grid(k);
            let turned = tile(x, 0.0, z).map(|it| it.map(|p| DVec3::new(5.0 - p.y, p.x, p.z)));
            [tile(x, 0.0, z), turned].concat()
        });
        let tiles: Vec<[DVec3; 3]> = tiles.collect();
        let windows = few(tiles.clone());
        assert_eq!(windows.len(), 4);
        assert!((area_m2(&windows) - area_m2(&tiles)).abs() < 1e-9, "{windows:?}");
    }

    /// The panes of a glass dome become few that cover it.
    #[test]
    fn domes_become_few() {
        let at = |i: i32, j: i32| {
            let (azimuth, altitude) = (f64::from(i) * 0.0628, f64::from(j) * 0.031);
            DVec3::new(
                libm::cos(azimuth) * libm::cos(altitude),
                libm::sin(azimuth) * libm::cos(altitude),
                libm::sin(altitude),
            )
        };
        let panes = (0..100).flat_map(|i| {
            (0..50).flat_map(move |j| {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
        });
        let panes: Vec<[DVec3; 3]> = panes.collect();
        let merged = few(panes.clone());
        assert!(merged.len() <= MAX_PORTALS && merged.len() >= 8, "{}", merged.len());
        assert!(area_m2(&merged) > 0.5 * area_m2(&panes));
    }
}
