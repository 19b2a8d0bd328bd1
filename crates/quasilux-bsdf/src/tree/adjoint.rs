//! The adjoint of an isotropic tensor tree: a tree of rank 3 for light that travels in reverse.
//!
//! f'(wi, wo) = f(wo, wi) of an isotropic tree is constant in rings of the sine of wo, for which
//! the tree has its incident axis. In the exit square of the tree wi is at the azimuth that it has
//! from where light goes: as wo turns, it runs around a circle, and concentric squares are what
//! Shirley and Chiu's map makes of circles. So, for one wi, f' is constant in runs along the four
//! sides of a square, and the azimuth is linear in the arc length along them: both coordinates are
//! inverted exactly, without a table for each incidence.
//!
//! With 2^h boxes a side, the square through wi has half a side of `column` + t boxes, t in (0, 1].
//! A ring sends (I + 2 t C) / (8 (column + t)) of its projected solid angle, I the sum of the
//! values of the boxes between the corners of all sides and C that of the four at the corners. Sums
//! of I and C over rings are stored for each column. `u[0]` picks a ring by its share and,
//! renormalised, the squared sine in it; `u[1]` runs along the sides.

use super::{DEEPEST, Incidence, TensorTree};
use crate::hemisphere::INSIDE;
use crate::hemisphere::Incident;
use crate::hemisphere::PickedStep;
use crate::hemisphere::ScatterSample;
use crate::hemisphere::pick;
use crate::hemisphere::upwards;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// Runs end so far, in boxes, from where samples may be: rounding must not carry them over.
const MARGIN: f64 = 1e-9;

/// The least t: a corner is wider than its margins.
const MIN_PART: f64 = 1e-6;

/// An isotropic tree with incident and scattered directions swapped.
#[derive(Clone, Debug)]
pub struct AdjointTree {
    tree: TensorTree,
    /// Boxes of a side, as a power of two.
    log_side: usize,
    /// Rings, and columns: half of that.
    half: usize,
    /// For each column, the sums over the rings before each one, and over all, of I times the
    /// projected solid angle of a ring.
    between_before: Vec<f64>,
    /// The same of C.
    corners_before: Vec<f64>,
}

/// The square through an incident direction.
#[derive(Clone, Copy, Debug)]
struct Square {
    column: usize,
    t: f64,
    /// Cosine and sine of the azimuth of the incident direction.
    azimuth: [f64; 2],
}

/// The ring of an exit direction.
#[derive(Clone, Copy, Debug)]
struct RingPosition {
    ring: usize,
    /// Within the ring along the squared sine, in [0, 1].
    along: f64,
}

/// A leaf of the tree.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    /// f in sr^-1.
    value: f64,
    /// The length of its sides, in boxes.
    size: usize,
}

/// Part of a side, from `start` boxes of arc length on, in which f is constant.
#[derive(Clone, Copy, Debug)]
struct Run {
    start: f64,
    width: f64,
    value: f64,
}

impl Square {
    /// The length around, in boxes.
    fn around(self) -> f64 {
        8.0 * (self.column as f64 + self.t)
    }
}

impl AdjointTree {
    /// The tree with directions swapped; `None` of a tree that is not isotropic.
    pub(crate) fn new(tree: &TensorTree) -> Option<Self> {
        if !tree.is_isotropic() {
            return None;
        }
        let log_side = tree.height.max(1);
        let half = 1_usize << (log_side - 1);
        let sums = vec![0.0; half * (half + 1)];
        let (between_before, corners_before) = (sums.clone(), sums);
        let mut adjoint =
            Self { tree: tree.clone(), log_side, half, between_before, corners_before };
        adjoint.add(0, 0, [0; 3]);
        for sums in [&mut adjoint.between_before, &mut adjoint.corners_before] {
            for column in sums.chunks_exact_mut(half + 1) {
                (1..=half).for_each(|ring| column[ring] += column[ring - 1]);
            }
        }
        Some(adjoint)
    }

    /// The tree itself.
    pub(crate) fn original(&self) -> &TensorTree {
        &self.tree
    }

    /// Boxes along an axis, where they are smallest.
    #[must_use]
    pub fn resolution(&self) -> usize {
        2 * self.half
    }

    /// Adds a node of that level whose box begins at `low`: an incident and two exit axes.
    fn add(&mut self, node: usize, level: usize, low: [usize; 3]) {
        let super::Node { value, first_child, .. } = self.tree.nodes[node];
        let size = (2 * self.half) >> level;
        // The upper half of the incident axis is not in use.
        if low[0] >= self.half {
            return;
        }
        // A leaf that holds all is looked at by quadrants.
        if first_child != 0 || level == 0 {
            for child in 0..8 {
                let low = [0, 1, 2].map(|axis| low[axis] + (child >> axis & 1) * size / 2);
                let next = if first_child != 0 { first_child as usize + child } else { node };
                self.add(next, level + 1, low);
            }
            return;
        }
        let from_centre =
            |low: usize| if low >= self.half { low - self.half } else { self.half - low - size };
        let [x, y] = [from_centre(low[1]), from_centre(low[2])];
        for step in 0..size {
            // A box on the diagonal has parts of two sides.
            let (between, corner) =
                if x == y { (2.0 * step as f64, 1.0) } else { (size as f64, 0.0) };
            let first = (x.max(y) + step) * (self.half + 1);
            for incident in low[0]..low[0] + size {
                let ring = self.half - 1 - incident;
                let weight = value * self.ring_projected_sr(ring);
                self.between_before[first + ring + 1] += between * weight;
                self.corners_before[first + ring + 1] += corner * weight;
            }
        }
    }

    fn ring_projected_sr(&self, ring: usize) -> f64 {
        PI * (2 * ring + 1) as f64 / (self.half * self.half) as f64
    }

    fn square(&self, wi: DVec3) -> Square {
        let sine = (wi.x * wi.x + wi.y * wi.y).sqrt();
        let place = sine.min(1.0) * self.half as f64;
        let column = (place as usize).min(self.half - 1);
        let t = (place - column as f64).clamp(MIN_PART, 1.0);
        let azimuth = if sine > 0.0 { [wi.x / sine, wi.y / sine] } else { [1.0, 0.0] };
        Square { column, t, azimuth }
    }

    /// The ring of an exit direction, and the place in it along the squared sine.
    fn ring(&self, wo: DVec3) -> RingPosition {
        let place2 = (wo.x * wo.x + wo.y * wo.y).min(1.0) * (self.half * self.half) as f64;
        let ring = (place2.sqrt() as usize).min(self.half - 1);
        let inner2 = (ring * ring) as f64;
        let along = ((place2 - inner2) / (2 * ring + 1) as f64).clamp(0.0, 1.0);
        RingPosition { ring, along }
    }

    /// The arc length to an incident direction as seen from where light goes.
    fn arc(&self, square: Square, wo: DVec3) -> f64 {
        let [x, y] = square.azimuth;
        // Light goes to the opposite of wo, whatever the length.
        let azimuth_rad = libm::atan2(x * wo.y - y * wo.x, -(x * wo.x + y * wo.y));
        let turns = (azimuth_rad + FRAC_PI_4) / TAU;
        (turns - turns.floor()) * square.around()
    }

    /// The leaf that holds a box on a side; `step` counts boxes along the side from its middle.
    fn leaf(&self, ring: usize, column: usize, side: usize, step: isize) -> Leaf {
        let half = self.half as isize;
        let (out, along) = (column as isize, step);
        let cell = match side {
            0 => [half + out, half + along],
            1 => [half - 1 - along, half + out],
            2 => [half - 1 - out, half - 1 - along],
            _ => [half + along, half - 1 - out],
        };
        let shift = DEEPEST - self.log_side;
        let incident = ((self.half - 1 - ring) << shift) as u32;
        let incidence = Incidence { axes: 1, cell: [incident, 0], turn: [1.0, 0.0] };
        let (node, level) = self.tree.leaf(incidence, cell.map(|cell| (cell as u32) << shift));
        let size = (2 * self.half) >> level.min(self.log_side);
        Leaf { value: self.tree.nodes[node].value, size }
    }

    /// Calls `visit` with the runs of a ring around the square until it returns true.
    fn walk(&self, square: Square, ring: usize, mut visit: impl FnMut(Run) -> bool) {
        let Square { column, t, .. } = square;
        let end = column as f64 + t;
        let last = column as isize;
        for side in 0..4 {
            let mut step = -last - 1;
            while step <= last {
                let Leaf { value, size } = self.leaf(ring, column, side, step);
                // Leaves are aligned with the middle of the side.
                let next = ((step.div_euclid(size as isize) + 1) * size as isize).min(last + 1);
                let low = (step as f64).max(-end);
                let high = (next as f64).min(end);
                let start = 2.0 * end * side as f64 + low + end;
                if visit(Run { start, width: high - low, value }) {
                    return;
                }
                step = next;
            }
        }
    }

    /// The sums over the rings before each one, at a square.
    fn before(&self, square: Square) -> impl Fn(usize) -> f64 {
        let first = square.column * (self.half + 1);
        let t = square.t;
        move |ring| self.between_before[first + ring] + 2.0 * t * self.corners_before[first + ring]
    }

    pub(crate) fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        let square = self.square(wi);
        let end = square.column as f64 + square.t;
        let arc = self.arc(square, wo);
        let side = ((arc / (2.0 * end)) as usize).min(3);
        let step = (arc - 2.0 * end * side as f64 - end).floor() as isize;
        let last = square.column as isize;
        self.leaf(self.ring(wo).ring, square.column, side, step.clamp(-last - 1, last)).value
    }

    pub(crate) fn albedo(&self, wi: DVec3) -> f64 {
        let square = self.square(wi);
        self.before(square)(self.half) / square.around()
    }

    pub(crate) fn sample(&self, wi: DVec3, u: [f64; 2]) -> Option<ScatterSample> {
        let square = self.square(wi);
        let before = self.before(square);
        let sum = before(self.half);
        if sum <= 0.0 {
            return None;
        }
        let PickedStep { index: ring, u_remapped: along } = pick(self.half, u[0], &before);
        let mut rest = u[1] * (before(ring + 1) - before(ring)) / self.ring_projected_sr(ring);
        let mut found = None;
        self.walk(square, ring, |run| {
            let share = run.value * run.width;
            if share > 0.0 {
                let arc = (rest / run.value).min(run.width - MARGIN).max(MARGIN);
                found = Some((run.start + arc, run.value));
            }
            let is_reached = rest < share;
            rest -= share;
            is_reached
        });
        let (arc, value) = found?;
        let (sin, cos) = libm::sincos(TAU * arc / square.around() - FRAC_PI_4);
        let along = along.clamp(INSIDE, 1.0 - INSIDE);
        let place2 = (ring * ring) as f64 + along * (2 * ring + 1) as f64;
        let sine = place2.sqrt() / self.half as f64;
        let [x, y] = square.azimuth;
        let wo = upwards([-sine * (cos * x + sin * y), -sine * (cos * y - sin * x)]);
        Some(ScatterSample { wo, pdf_sr: value * wo.z * square.around() / sum })
    }

    pub(crate) fn pdf_sr(&self, wi: DVec3, wo: DVec3) -> f64 {
        let albedo = self.albedo(wi);
        if albedo > 0.0 { self.value(wi, wo) * wo.z / albedo } else { 0.0 }
    }

    pub(crate) fn invert(&self, wi: DVec3, wo: DVec3) -> [f64; 2] {
        let square = self.square(wi);
        let before = self.before(square);
        let RingPosition { ring, along } = self.ring(wo);
        let [low, high] = [before(ring), before(ring + 1)];
        let arc = self.arc(square, wo);
        let mut sum = 0.0;
        self.walk(square, ring, |run| {
            sum += run.value * (arc - run.start).clamp(0.0, run.width);
            arc < run.start + run.width
        });
        let u = [
            (low + along * (high - low)) / before(self.half),
            sum * self.ring_projected_sr(ring) / (high - low),
        ];
        u.map(|u| u.clamp(0.0, 1.0))
    }

    /// The greatest value, with the cosine at the inner edge of each ring.
    pub(crate) fn max_value(&self, wi: DVec3) -> f64 {
        let square = self.square(wi);
        let mut max_value = 0.0_f64;
        for ring in 0..self.half {
            let sine = ring as f64 / self.half as f64;
            let cosine = (1.0 - sine * sine).sqrt();
            self.walk(square, ring, |run| {
                max_value = max_value.max(cosine * run.value);
                false
            });
        }
        max_value
    }

    /// The middles of columns, each for its ring: what a column sends is linear in the area before
    /// it.
    pub(crate) fn parts(&self) -> Vec<Incident> {
        let half = self.half as f64;
        let of_column = |column: usize| {
            let wi = upwards([(column as f64 + 0.5) / half, 0.0]);
            Incident { wi, part: (2 * column + 1) as f64 / (half * half) }
        };
        (0..self.half).map(of_column).collect()
    }
}
