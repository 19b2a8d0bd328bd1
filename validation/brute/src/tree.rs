//! A tree of boxes around the triangles, halved at the median.

use crate::triangle::{Ray, Triangle};
use glam::DVec3;

/// Most triangles of a leaf.
const LEAF: usize = 3;

/// The tree, its root first; triangles of a leaf stand together.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    nodes: Vec<Node>,
    order: Vec<usize>,
}

#[derive(Clone, Debug)]
struct Node {
    low: DVec3,
    high: DVec3,
    first: usize,
    /// Triangles of a leaf; 0 in an inner node, whose children are the next one and `first`.
    count: usize,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) triangle: usize,
    pub(crate) distance_m: f64,
}

impl Tree {
    pub(crate) fn new(triangles: &[Triangle]) -> Self {
        let mut tree = Self { nodes: Vec::new(), order: (0..triangles.len()).collect() };
        tree.split(triangles, 0, triangles.len());
        tree
    }

    fn split(&mut self, triangles: &[Triangle], from: usize, to: usize) {
        let corners = |&number: &usize| triangles[number].corners;
        let all = || self.order[from..to].iter().flat_map(corners);
        let low = all().fold(DVec3::INFINITY, DVec3::min) - 1e-9;
        let high = all().fold(DVec3::NEG_INFINITY, DVec3::max) + 1e-9;
        let own = self.nodes.len();
        self.nodes.push(Node { low, high, first: from, count: to - from });
        if to - from <= LEAF {
            return;
        }
        let size = high - low;
        let axis = (0..3).max_by(|&i, &j| size[i].total_cmp(&size[j])).unwrap_or(0);
        let middle = |number: &usize| corners(number).iter().map(|c| c[axis]).sum::<f64>();
        self.order[from..to].sort_by(|a, b| middle(a).total_cmp(&middle(b)));
        let half = usize::midpoint(from, to);
        self.split(triangles, from, half);
        self.nodes[own].first = self.nodes.len();
        self.nodes[own].count = 0;
        self.split(triangles, half, to);
    }

    /// The nearest triangle.
    pub(crate) fn nearest(&self, triangles: &[Triangle], ray: Ray) -> Option<Hit> {
        let mut found = None;
        self.visit(triangles, ray, |hit| {
            found = Some(hit);
            false
        });
        found
    }

    /// Whether there is any.
    pub(crate) fn blocks(&self, triangles: &[Triangle], ray: Ray) -> bool {
        let mut found = false;
        self.visit(triangles, ray, |_| {
            found = true;
            true
        });
        found
    }

    /// Tells each triangle that is nearer than those before, until `is_enough`.
    fn visit(&self, triangles: &[Triangle], mut ray: Ray, mut is_enough: impl FnMut(Hit) -> bool) {
        if triangles.is_empty() {
            return;
        }
        let inverse = ray.direction.recip();
        let mut stack = [0; 64];
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let number = stack[height];
            let node = &self.nodes[number];
            if !node.is_met(&ray, inverse) {
                continue;
            }
            if node.count == 0 {
                stack[height] = node.first;
                stack[height + 1] = number + 1;
                height += 2;
                continue;
            }
            for &triangle in &self.order[node.first..node.first + node.count] {
                if let Some(distance_m) = triangles[triangle].distance_m(&ray) {
                    ray.farthest_m = distance_m;
                    if is_enough(Hit { triangle, distance_m }) {
                        return;
                    }
                }
            }
        }
    }
}

impl Node {
    fn is_met(&self, ray: &Ray, inverse: DVec3) -> bool {
        let (a, b) = ((self.low - ray.origin) * inverse, (self.high - ray.origin) * inverse);
        let near = a.min(b).max_element().max(ray.nearest_m);
        let far = a.max(b).min_element().min(ray.farthest_m);
        near <= far
    }
}
