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
fn clipped([a, b]: [DVec2; 2], frame: Frame) -> Option<[DVec2; 2]> {
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
