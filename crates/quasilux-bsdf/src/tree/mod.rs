//! A tensor tree: a scattering distribution constant in boxes of varied size (Ward, Kurt and
//! Bonneel 2012).
//!
//! Projected directions fill a disk, and the disk is mapped to a square (Shirley and Chiu 1997):
//! equal areas are equal projected solid angles. In rank 4 the axes are those of the incident and
//! of the exit square; in rank 3, where the surface is isotropic, one axis for the incident sine
//! and the exit square. So the albedo is pi times the mean over the exit square, and a density in
//! projected solid angle is one in that square over pi.
//!
//! Sampling goes down the tree with both coordinates (McCool and Harwood 1997; Clarberg et al.
//! 2005): `u[0]` picks a half of the first exit axis and is renormalised in it, then `u[1]` a half
//! of the second axis given the first. The shares are means over exit squares at the incident
//! direction, kept with each node (`means.rs`). No rejection, and strata stay strata.

mod adjoint;
mod build;
mod means;

use crate::hemisphere::INSIDE;
use crate::hemisphere::Incident;
use crate::hemisphere::ScatterSample;
use crate::hemisphere::upwards;
pub use adjoint::AdjointTree;
pub(super) use build::TreeBuilder;
use glam::DVec3;
use means::{IncidentBox, Means};
use quasilux_sampling::warp::{invert_disk, sample_disk};
use std::f64::consts::PI;
use std::sync::Arc;

/// Levels below the root, at most.
pub(super) const DEEPEST: usize = 12;

/// Smallest boxes along an axis.
const CELLS: f64 = (1 << DEEPEST) as f64;

/// A scattering distribution, constant in the leaves of a tree.
#[derive(Clone, Debug)]
pub struct TensorTree {
    /// 1 in rank 3, 2 in rank 4.
    incident_axes: usize,
    nodes: Arc<Vec<Node>>,
    means: Arc<Means>,
    /// Levels below the root.
    height: usize,
}

/// A box of the tree.
#[derive(Clone, Copy, Debug, Default)]
struct Node {
    /// Of a leaf: f in sr^-1.
    value: f64,
    /// Of a branch: the index of its first child. Children lie side by side; bit i of a child's
    /// number is set where it is the upper half along axis i, exit axes after incident ones. 0 in a
    /// leaf.
    first_child: u32,
    /// Of a branch: its mean over the exit square, in [`Means`].
    mean: u32,
}

/// An incident direction: its box along the incident axes, and the frame of its exit square.
#[derive(Clone, Copy, Debug)]
struct Incidence {
    axes: usize,
    cell: [u32; 2],
    /// Cosine and sine of the azimuth that light goes to; those of 0 in rank 4.
    turn: [f64; 2],
}

impl TensorTree {
    /// The number of leaves.
    #[must_use]
    pub fn leaves(&self) -> usize {
        self.nodes.iter().filter(|node| node.first_child == 0).count()
    }

    /// Boxes along an axis, where they are smallest.
    #[must_use]
    pub fn resolution(&self) -> usize {
        1 << self.height
    }

    pub(super) fn is_isotropic(&self) -> bool {
        self.incident_axes == 1
    }

    pub(super) fn value(&self, wi: DVec3, wo: DVec3) -> f64 {
        let incidence = self.incidence(wi);
        let (node, _) = self.leaf(incidence, incidence.square(wo).map(cell));
        self.nodes[node].value
    }

    /// The leaf at an incidence and a smallest box of the exit square, and its level.
    fn leaf(&self, incidence: Incidence, exit: [u32; 2]) -> (usize, usize) {
        let (mut node, mut level) = (0, 0);
        while let Some(children) = self.children(node, level, incidence) {
            node = children[half(exit[0], level) | half(exit[1], level) << 1];
            level += 1;
        }
        (node, level)
    }

    pub(super) fn albedo(&self, wi: DVec3) -> f64 {
        PI * self.mean(0, 0, self.incidence(wi))
    }

    pub(super) fn sample(&self, wi: DVec3, mut u: [f64; 2]) -> Option<ScatterSample> {
        let incidence = self.incidence(wi);
        let mean = self.mean(0, 0, incidence);
        if mean <= 0.0 {
            return None;
        }
        let (mut node, mut level) = (0, 0);
        let mut low = [0.0; 2];
        let mut size = 1.0;
        while let Some(children) = self.children(node, level, incidence) {
            let shares = children.map(|child| self.mean(child, level + 1, incidence));
            let first = choose(&mut u[0], [shares[0] + shares[2], shares[1] + shares[3]]);
            let second = choose(&mut u[1], [shares[first], shares[first | 2]]);
            size *= 0.5;
            low = [low[0] + size * first as f64, low[1] + size * second as f64];
            node = children[first | second << 1];
            level += 1;
        }
        let place = [0, 1].map(|axis| low[axis] + size * u[axis].clamp(INSIDE, 1.0 - INSIDE));
        let wo = incidence.direction(place);
        Some(ScatterSample { wo, pdf_sr: self.nodes[node].value * wo.z / (PI * mean) })
    }

    pub(super) fn pdf_sr(&self, wi: DVec3, wo: DVec3) -> f64 {
        let albedo = self.albedo(wi);
        if albedo > 0.0 { self.value(wi, wo) * wo.z / albedo } else { 0.0 }
    }

    pub(super) fn invert(&self, wi: DVec3, wo: DVec3) -> [f64; 2] {
        let incidence = self.incidence(wi);
        let place = incidence.square(wo);
        let exit = place.map(cell);
        let (mut node, mut level) = (0, 0);
        // The coordinates that lead to the box are [before, before + width].
        let (mut before, mut width) = ([0.0; 2], [1.0; 2]);
        while let Some(children) = self.children(node, level, incidence) {
            let shares = children.map(|child| self.mean(child, level + 1, incidence));
            let halves = exit.map(|exit| half(exit, level));
            let of_axis = [
                [shares[0] + shares[2], shares[1] + shares[3]],
                [shares[halves[0]], shares[halves[0] | 2]],
            ];
            for axis in [0, 1] {
                let lower = of_axis[axis][0] / (of_axis[axis][0] + of_axis[axis][1]);
                if halves[axis] == 1 {
                    before[axis] += width[axis] * lower;
                    width[axis] *= 1.0 - lower;
                } else {
                    width[axis] *= lower;
                }
            }
            node = children[halves[0] | halves[1] << 1];
            level += 1;
        }
        let boxes = (1 << level) as f64;
        let within = |axis: usize| (place[axis] * boxes).fract();
        [0, 1].map(|axis| (before[axis] + width[axis] * within(axis)).clamp(0.0, 1.0))
    }

    /// The greatest value of the slice; cosines count as 1.
    pub(super) fn max_value(&self, wi: DVec3) -> f64 {
        self.max_value_of(0, 0, self.incidence(wi))
    }

    fn max_value_of(&self, node: usize, level: usize, incidence: Incidence) -> f64 {
        match self.children(node, level, incidence) {
            None => self.nodes[node].value,
            Some(children) => {
                let of_child = |child| self.max_value_of(child, level + 1, incidence);
                children.into_iter().map(of_child).fold(0.0, f64::max)
            }
        }
    }

    pub(super) fn incidences(&self) -> Vec<DVec3> {
        let side = 1 << self.height.clamp(1, 5);
        let middle = |i: usize| (i as f64 + 0.5) / side as f64;
        if self.is_isotropic() {
            let sine = |i: usize| 1.0 - 2.0 * middle(i);
            return (0..side / 2).rev().map(|i| upwards([sine(i), 0.0])).collect();
        }
        let pairs = (0..side).flat_map(|i| (0..side).map(move |j| [middle(i), middle(j)]));
        pairs.map(|place| upwards(sample_disk(place).map(|onwards| -onwards))).collect()
    }

    /// The centres of the boxes of incidences in which the albedo is constant.
    pub(super) fn parts(&self) -> Vec<Incident> {
        let Node { first_child, mean, .. } = self.nodes[0];
        let boxes = if first_child == 0 {
            vec![IncidentBox::default()]
        } else {
            self.means.boxes(mean, self.incident_axes)
        };
        let of_box = |found: &IncidentBox| {
            let size = 1.0 / (1_u64 << found.level) as f64;
            let [low, next] = found.cell.map(|cell| cell as f64 * size);
            if self.incident_axes == 2 {
                let [x, y] = sample_disk([low + 0.5 * size, next + 0.5 * size]);
                return Incident { wi: upwards([-x, -y]), part: size * size };
            }
            let [outer, inner] = [low, low + size].map(|place| (1.0 - 2.0 * place).max(0.0));
            let wi = upwards([0.5 * (outer + inner), 0.0]);
            Incident { wi, part: outer * outer - inner * inner }
        };
        boxes.iter().map(of_box).filter(|part| part.part > 0.0).collect()
    }

    fn incidence(&self, wi: DVec3) -> Incidence {
        let axes = self.incident_axes;
        let [x, y] = [-wi.x, -wi.y];
        if axes == 2 {
            return Incidence { axes, cell: invert_disk([x, y]).map(cell), turn: [1.0, 0.0] };
        }
        let sine = (x * x + y * y).sqrt().min(1.0);
        let turn = if sine > 0.0 { [x / sine, y / sine] } else { [1.0, 0.0] };
        // The upper half of the axis is not in use.
        let in_use = CELLS as u32 / 2 - 1;
        Incidence { axes, cell: [cell(0.5 - 0.5 * sine).min(in_use), 0], turn }
    }

    /// The children of a branch at an incidence: bit 0 of the index is the half along the first
    /// exit axis, bit 1 that along the second. `None` for a leaf.
    fn children(&self, node: usize, level: usize, incidence: Incidence) -> Option<[usize; 4]> {
        let first = self.nodes[node].first_child as usize;
        let incident = incidence.half(level);
        (first != 0).then(|| [0, 1, 2, 3].map(|exit| first + incident + (exit << incidence.axes)))
    }

    /// The mean over the exit square of a node of that level, at an incidence.
    fn mean(&self, node: usize, level: usize, incidence: Incidence) -> f64 {
        let Node { value, first_child, mean } = self.nodes[node];
        if first_child == 0 { value } else { self.means.at(mean, level, incidence) }
    }
}

impl Incidence {
    /// The half along each incident axis, a bit each, of a box of that level.
    fn half(&self, level: usize) -> usize {
        (0..self.axes).map(|axis| half(self.cell[axis], level) << axis).sum()
    }

    /// The place of an exit direction in the exit square.
    fn square(&self, wo: DVec3) -> [f64; 2] {
        let [cos, sin] = self.turn;
        invert_disk([cos * wo.x + sin * wo.y, cos * wo.y - sin * wo.x])
    }

    /// The exit direction at a place of the exit square.
    fn direction(&self, place: [f64; 2]) -> DVec3 {
        let [cos, sin] = self.turn;
        let [x, y] = sample_disk(place);
        upwards([cos * x - sin * y, sin * x + cos * y])
    }
}

/// The smallest box that holds a place of an axis.
fn cell(place: f64) -> u32 {
    (place * CELLS).clamp(0.0, CELLS - 1.0) as u32
}

/// Whether a smallest box is in the upper half of the box of that level which holds it.
fn half(cell: u32, level: usize) -> usize {
    (cell >> (DEEPEST - 1 - level) & 1) as usize
}

/// The half that `u` falls into, by the shares of both; `u` becomes its place in that half.
fn choose(u: &mut f64, [lower, upper]: [f64; 2]) -> usize {
    let target = *u * (lower + upper);
    if lower > 0.0 && (target < lower || upper <= 0.0) {
        *u = (target / lower).min(1.0);
        return 0;
    }
    *u = ((target - lower) / upper).clamp(0.0, 1.0);
    1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Also where the shares are so unlike that their sum is the greater one.
    #[test]
    fn a_half_without_light_is_never_chosen() {
        for (u, shares, expected) in [
            (0.25, [1.0, 1.0], (0, 0.5)),
            (0.75, [1.0, 1.0], (1, 0.5)),
            (0.0, [0.0, 1.0], (1, 0.0)),
            (1.0, [1.0, 0.0], (0, 1.0)),
            (1.0, [1e18, 0.1], (1, 0.0)),
            (1.0, [0.1, 1e18], (1, 1.0)),
            (0.0, [0.1, 1e18], (0, 0.0)),
        ] {
            let mut place = u;
            let half = choose(&mut place, shares);
            assert_eq!((half, place), expected, "{u} of {shares:?}");
        }
    }
}
