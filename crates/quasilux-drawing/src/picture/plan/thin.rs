//! Many lines as few: ends are moved to a lattice of a fraction of a pixel, and lines that become
//! equal, or points, are drawn once or not at all. Where too many are left the lattice is made
//! coarser, so that a drawing is bounded however many lines there are.

use crate::drawing::Frame;
use glam::DVec2;

/// Points of the finest lattice in a pixel.
const FINEST: f64 = 4.0;

/// A line between two points of the lattice.
type Step = [[i32; 2]; 2];

/// At most `most` lines that look like the given ones inside a frame.
pub(crate) fn thinned(
    segments: impl Iterator<Item = [DVec2; 2]>,
    frame: Frame,
    most: usize,
) -> Vec<[DVec2; 2]> {
    let lattice = |point: DVec2| (point * FINEST).round().to_array().map(|x| x as i32);
    let mut steps: Vec<Step> =
        segments.filter_map(|ends| clipped(ends, frame)).map(|ends| ends.map(lattice)).collect();
    let mut unit = 1.0 / FINEST;
    loop {
        steps.iter_mut().for_each(|ends| ends.sort_unstable());
        steps.retain(|[a, b]| a != b);
        steps.sort_unstable();
        steps.dedup();
        if steps.len() <= most {
            break;
        }
        let coarser = |point: [i32; 2]| point.map(|x| x.div_euclid(2));
        steps.iter_mut().for_each(|ends| *ends = ends.map(coarser));
        unit *= 2.0;
    }
    let place = |point: [i32; 2]| DVec2::from(point.map(f64::from)) * unit;
    steps.into_iter().map(|ends| ends.map(place)).collect()
}

/// The part of a segment inside a frame (Liang and Barsky 1984, "A new concept and method for line
/// clipping").
pub(crate) fn clipped([a, b]: [DVec2; 2], frame: Frame) -> Option<[DVec2; 2]> {
    let low = DVec2::from(frame.corner_px);
    let high = low + DVec2::from(frame.size_px);
    let along = b - a;
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for axis in 0..2 {
        for (slope, room) in
            [(-along[axis], a[axis] - low[axis]), (along[axis], high[axis] - a[axis])]
        {
            match slope {
                s if s < 0.0 => from = from.max(room / s),
                s if s > 0.0 => to = to.min(room / s),
                _ if room < 0.0 => return None,
                _ => {}
            }
        }
    }
    (from <= to).then(|| [from, to].map(|t| a + along * t))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Frame = Frame { corner_px: [10.0, 20.0], size_px: [100.0, 50.0] };

    fn line(from: [f64; 2], to: [f64; 2]) -> [DVec2; 2] {
        [from, to].map(DVec2::from)
    }

    #[test]
    fn lines_end_at_the_frame_and_appear_once() {
        let lines = [
            line([0.0, 30.0], [200.0, 30.0]),
            line([1e12, 30.0], [-1e12, 30.0]),
            line([0.0, 0.0], [5.0, 5.0]),
            line([50.0, 40.0], [50.05, 40.0]),
        ];
        let found = thinned(lines.into_iter(), FRAME, 100);
        assert_eq!(found, [line([10.0, 30.0], [110.0, 30.0])]);
    }

    #[test]
    fn however_many_there_are_few_are_left() {
        let place =
            |k: u32| [10.0 + f64::from(k % 997) / 10.0, 20.0 + f64::from(k / 997 % 499) / 10.0];
        let lines = (0..200_000).map(|k| line(place(k), place(k * 7 + 3)));
        let found = thinned(lines, FRAME, 500);
        assert!((50..=500).contains(&found.len()), "{}", found.len());
    }
}
