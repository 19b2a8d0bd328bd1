//! Holes in walls of single sheets: where an upright sheet ends at a sill, and one in its plane
//! begins at a lintel above, with nothing between.

use super::edges::Edge;
use glam::DVec3;

/// Holes are at least this long and high.
const MIN_M: f64 = 0.1;
/// What lies this near lies in one place.
const NEAR_M: f64 = 1e-3;
/// With more level borders of upright sheets than this none are looked at.
const MOST: usize = 1500;

/// A level border of an upright sheet.
#[derive(Clone, Copy)]
struct Rim {
    ends_m: [DVec3; 2],
    /// Unit direction from the first end to the second one.
    along: DVec3,
    /// Whether the sheet stands on it; else it ends there.
    goes_up: bool,
}

/// A stretch of a rim, as lengths along another one.
#[derive(Clone, Copy)]
struct Stretch {
    from_m: f64,
    to_m: f64,
}

/// The rectangles of the holes, the corners of each in turn.
pub(crate) fn holes(edges: &[Edge]) -> Vec<[DVec3; 4]> {
    let rims: Vec<Rim> = edges.iter().filter_map(Rim::new).take(MOST + 1).collect();
    if rims.len() > MOST {
        return Vec::new();
    }
    let (lintels, sills): (Vec<Rim>, Vec<Rim>) = rims.iter().partition(|rim| rim.goes_up);
    let pairs = sills.iter().flat_map(|sill| lintels.iter().map(move |lintel| [sill, lintel]));
    pairs.filter_map(|[sill, lintel]| hole(sill, lintel, &rims)).collect()
}

fn hole(sill: &Rim, lintel: &Rim, rims: &[Rim]) -> Option<[DVec3; 4]> {
    let height_m = lintel.z() - sill.z();
    let stretch =
        sill.shared(lintel).filter(|it| height_m > MIN_M && it.to_m - it.from_m > MIN_M)?;
    let between = |rim: &&Rim| {
        let above_m = rim.z() - sill.z();
        let [least_m, most_m] =
            if rim.goes_up { [-NEAR_M, height_m - NEAR_M] } else { [NEAR_M, height_m + NEAR_M] };
        (least_m..=most_m).contains(&above_m)
    };
    let fills = |rim: &Rim| {
        let covers =
            |it: Stretch| it.from_m < stretch.to_m - NEAR_M && it.to_m > stretch.from_m + NEAR_M;
        sill.shared(rim).is_some_and(covers)
    };
    if rims.iter().filter(between).any(fills) {
        return None;
    }
    let [a, b] =
        [stretch.from_m, stretch.to_m].map(|length_m| sill.ends_m[0] + sill.along * length_m);
    let up = DVec3::Z * height_m;
    Some([a, b, b + up, a + up])
}

impl Rim {
    fn new(edge: &Edge) -> Option<Self> {
        let leaving = edge.border.filter(|leaving| leaving.z.abs() > 1.0 - 1e-6)?;
        let along = (edge.ends_m[1] - edge.ends_m[0]).normalize_or_zero();
        Some(Self { ends_m: edge.ends_m, along, goes_up: leaving.z > 0.0 })
    }

    fn z(&self) -> f64 {
        self.ends_m[0].z
    }

    /// What another one has of this one's line, seen from above, within its length.
    fn shared(&self, other: &Self) -> Option<Stretch> {
        let [a, b] = other.ends_m.map(|end| end - self.ends_m[0]);
        let aside = |to: DVec3| (to - self.along * to.dot(self.along)).truncate().length();
        let [a_m, b_m] = [a, b].map(|to| to.dot(self.along));
        let length_m = self.ends_m[0].distance(self.ends_m[1]);
        let (from_m, to_m) = (a_m.min(b_m).max(0.0), a_m.max(b_m).min(length_m));
        let is_on_line = aside(a) < NEAR_M && aside(b) < NEAR_M;
        (is_on_line && from_m < to_m).then_some(Stretch { from_m, to_m })
    }
}

#[cfg(test)]
mod tests {
    use super::super::edges::edges;
    use super::super::fixtures::{Shell, room, room_with_window, upright};
    use super::*;

    fn found(shell: &Shell) -> Vec<[DVec3; 4]> {
        holes(&edges(shell.surfaces(), &[DVec3::Z], 0.0))
    }

    #[test]
    fn a_hole_lies_between_sill_and_lintel() {
        let holes = found(&room_with_window(None));
        assert_eq!(holes.len(), 1);
        let fold = |pick: fn(DVec3, DVec3) -> DVec3| holes[0].into_iter().reduce(pick);
        assert_eq!(fold(DVec3::min), Some(DVec3::new(2.0, 0.0, 1.2)));
        assert_eq!(fold(DVec3::max), Some(DVec3::new(4.0, 0.0, 2.2)));
    }

    #[test]
    fn what_is_filled_is_no_hole() {
        assert!(found(&room()).is_empty());
        assert!(found(&room_with_window(Some(1))).is_empty());
        // In two pieces that do not meet the corners of the hole.
        let halves = [[2.0, 3.0], [3.0, 4.0]].map(|[a, b]| upright(0.0, [a, 1.2], [b, 2.2]));
        let [left, right] = halves;
        let half = room_with_window(None).with_sheet(left, 1);
        assert_eq!(found(&half).len(), 0, "a part is left to its pane");
        assert!(found(&half.with_sheet(right, 1)).is_empty());
    }

    /// Sheets that hang freely, and shelves.
    #[test]
    fn furniture_has_no_holes() {
        let hung = room().with_sheet(upright(2.0, [1.0, 1.0], [2.0, 1.5]), 0);
        assert!(found(&hung).is_empty());
        let shelf = [0.4, 0.9, 1.4].into_iter().fold(room(), |shell, z| {
            shell.with_box(DVec3::new(4.0, 1.0, z), DVec3::new(5.0, 1.4, z + 0.03))
        });
        assert!(found(&shelf).is_empty());
    }
}
