//! Where a contour line carries its number: along its straightest stretch, in a gap of the line.

use super::contour::Line;
use glam::DVec2;

/// Lines shorter than this many labels carry none.
const MIN_LABELS: f64 = 2.5;
/// Distance between the places that are tried, in pixels.
const STRIDE_PX: f64 = 4.0;

/// A free place on a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LabelPlace {
    /// Centre of the label in pixels.
    pub(crate) centre: DVec2,
    /// Reading direction, never from right to left.
    pub(crate) direction: DVec2,
    /// Half its length, and thus the radius that it keeps free.
    pub(crate) radius_px: f64,
    /// The gap in the line, as lengths from its beginning.
    gap_px: [f64; 2],
}

impl LabelPlace {
    /// Disks of a radius that cover the text, from its beginning to its end.
    pub(crate) fn disks(&self, radius_px: f64) -> impl Iterator<Item = DVec2> + '_ {
        let reach_px = (self.radius_px - radius_px).max(0.0);
        let steps = (reach_px / (0.5 * radius_px)).ceil().max(1.0) as u32;
        let share = move |k: u32| 2.0 * f64::from(k) / f64::from(2 * steps) - 1.0;
        (0..=2 * steps).map(move |k| self.centre + self.direction * (reach_px * share(k)))
    }
}

/// The straightest place for a label of a length on a line: within `size`, and free.
pub(crate) fn place(
    line: &Line,
    length_px: f64,
    size: DVec2,
    is_free: impl Fn(&LabelPlace) -> bool,
) -> Option<LabelPlace> {
    let lengths = lengths_along(line);
    let total = *lengths.last()?;
    if total < MIN_LABELS * length_px {
        return None;
    }
    let radius_px = 0.5 * length_px;
    let steps = ((total - length_px) / STRIDE_PX) as usize;
    let candidates = (0..=steps).filter_map(|k| {
        let from = k as f64 * STRIDE_PX;
        let ends = [from, from + length_px].map(|s| point_at(line, &lengths, s));
        let along = ends[1] - ends[0];
        let centre = (ends[0] + ends[1]) / 2.0;
        let inside =
            centre.cmpgt(DVec2::splat(radius_px)).all() && centre.cmplt(size - radius_px).all();
        if !inside || along.length() <= 0.9 * length_px {
            return None;
        }
        let leftward = along.x < 0.0 || (along.x == 0.0 && along.y > 0.0);
        let direction = along.normalize() * if leftward { -1.0 } else { 1.0 };
        let place = LabelPlace { centre, direction, radius_px, gap_px: [from, from + length_px] };
        is_free(&place).then(|| (place, along.length()))
    });
    candidates
        .reduce(|best, next| if next.1 > best.1 + 1e-6 { next } else { best })
        .map(|(place, _)| place)
}

/// The parts of a line before and behind the gap of its label.
pub(crate) fn parts(line: &Line, label: Option<LabelPlace>) -> Vec<Line> {
    let Some(LabelPlace { gap_px: [from, to], .. }) = label else {
        return vec![line.clone()];
    };
    let lengths = lengths_along(line);
    let until = lengths.partition_point(|length| *length < from);
    let behind = lengths.partition_point(|length| *length <= to);
    let [gap, end] = [from, to].map(|s| point_at(line, &lengths, s));
    let before = line[..until].iter().copied().chain([gap]).collect();
    vec![before, std::iter::once(end).chain(line[behind..].iter().copied()).collect()]
}

/// Length of the line up to each of its points.
fn lengths_along(line: &Line) -> Vec<f64> {
    let mut total = 0.0;
    let steps = line.windows(2).map(|w| {
        total += w[0].distance(w[1]);
        total
    });
    std::iter::once(0.0).chain(steps).collect()
}

fn point_at(line: &Line, lengths: &[f64], s: f64) -> DVec2 {
    let i = lengths.partition_point(|l| *l < s).clamp(1, line.len() - 1);
    let piece = lengths[i] - lengths[i - 1];
    let t = if piece > 0.0 { ((s - lengths[i - 1]) / piece).clamp(0.0, 1.0) } else { 0.0 };
    line[i - 1].lerp(line[i], t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polyline(points: &[[f64; 2]]) -> Line {
        points.iter().map(|p| DVec2::from_array(*p)).collect()
    }

    #[test]
    fn the_straight_stretch_wins_and_the_gap_is_as_long_as_the_label() {
        let zigzag = [[10.0, 50.0], [20.0, 60.0], [30.0, 50.0], [40.0, 60.0], [160.0, 60.0]];
        let line = polyline(&zigzag);
        let place = place(&line, 30.0, DVec2::splat(200.0), |_| true).expect("room for a label");
        assert!(place.centre.x >= 55.0 && place.centre.y == 60.0);
        assert!(place.direction.distance(DVec2::X) < 1e-12);
        let total: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
        let parts = parts(&line, Some(place));
        let steps = parts.iter().flat_map(|part| part.windows(2));
        let drawn: f64 = steps.map(|w| w[0].distance(w[1])).sum();
        assert!((total - drawn - 30.0).abs() < 1e-9);
    }

    #[test]
    fn labels_keep_clear_of_each_other_and_of_the_border() {
        let line = polyline(&[[0.0, 50.0], [100.0, 50.0]]);
        let size = DVec2::splat(100.0);
        let mut taken: Vec<LabelPlace> = Vec::new();
        while let Some(next) = place(&line, 20.0, size, |next| {
            let apart = |other: &LabelPlace| {
                other.centre.distance(next.centre) > other.radius_px + next.radius_px
            };
            taken.iter().all(apart)
        }) {
            assert!((10.0..=90.0).contains(&next.centre.x));
            taken.push(next);
        }
        assert!((3..=4).contains(&taken.len()));
        let border = polyline(&[[0.0, 2.0], [100.0, 2.0]]);
        assert!(place(&border, 20.0, size, |_| true).is_none());
        assert!(place(&polyline(&[[40.0, 50.0], [60.0, 50.0]]), 20.0, size, |_| true).is_none());
    }
}
