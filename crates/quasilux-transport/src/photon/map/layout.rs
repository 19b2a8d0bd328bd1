//! Layout of an illumination map: the element and barycentric coordinates of a point.

use crate::codec::Writer;
use crate::settings::{Reconstruction, Settings};
use crate::spectrum::Spectrum;
use crate::world::subdivision::{InCell, locate_in_grid, locate_in_quarters};
use crate::world::{Facet, Interaction, World};

/// Elements along the scene's largest extent where no size is asked for.
pub(crate) const ELEMENTS_ACROSS: f64 = 64.0;
/// Elements along the scene's largest extent where pilot photons decide which of them are split.
pub(crate) const COARSE_ELEMENTS_ACROSS: f64 = 16.0;
/// Marks what is split in a tree.
const SPLIT: u32 = 1 << 31;
/// Most elements on one side of all facets.
const MAX_LEAVES: u64 = SPLIT as u64 - 1;
/// Most parts along an edge.
const MAX_PARTS: f64 = 32_768.0;

/// Which element a place belongs to.
pub(crate) struct MapLayout {
    facets: Vec<Subdivision>,
    trees: Trees,
    reconstruction: Reconstruction,
}

/// A place in an element of the map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MapPoint {
    /// Number of the element, its side included.
    pub(crate) element: usize,
    /// Barycentric weights within the element.
    pub(crate) barycentric: [f64; 3],
    /// The element's area in m^2.
    pub(crate) area_m2: f64,
}

/// How a facet is cut at first.
#[derive(Clone, Copy)]
struct Subdivision {
    /// Number of the facet's first tree.
    first: u32,
    /// Parts along each edge; 0 where nothing is counted.
    parts: u32,
    area_m2: f64,
}

/// One tree for each part of the facets: how it is split further. Each entry is the number of a
/// leaf, or [`SPLIT`] with the number of a list of four entries.
struct Trees {
    /// The entry of each tree; none where each is a leaf with its own number.
    roots: Vec<u32>,
    lists: Vec<[u32; 4]>,
    leaves: usize,
}

impl MapLayout {
    /// Elements no longer than is asked for, or by default a share of the scene's size, as far as
    /// `map_elements` allows.
    pub(crate) fn new<S: Spectrum>(world: &World<S>, settings: &Settings) -> Self {
        Self::regular(world, ELEMENTS_ACROSS, settings)
    }

    /// Elements with a larger default, which are split where there is need.
    pub(super) fn coarse<S: Spectrum>(world: &World<S>, settings: &Settings) -> Self {
        Self::regular(world, COARSE_ELEMENTS_ACROSS, settings)
    }

    /// The longest edge of the elements, as far as `map_elements` allows.
    pub(crate) fn longest_edge_m<S: Spectrum>(world: &World<S>, settings: &Settings) -> f64 {
        Self::edge_m(world, ELEMENTS_ACROSS, settings)
    }

    fn edge_m<S: Spectrum>(world: &World<S>, across: f64, settings: &Settings) -> f64 {
        settings.map_element_m.unwrap_or(world.size_m() / across)
    }

    fn regular<S: Spectrum>(world: &World<S>, across: f64, settings: &Settings) -> Self {
        let mut element_m = Self::edge_m(world, across, settings);
        let parts = |facet: &Facet, element_m: f64| {
            let counts = world.bsdf_of(facet).keeps_illuminance();
            let parts = (facet.longest_edge_m() / element_m).ceil().clamp(1.0, MAX_PARTS);
            if counts { parts } else { 0.0 }
        };
        let total = |element_m: f64| -> f64 {
            world.facets.iter().map(|facet| parts(facet, element_m)).map(|n| n * n).sum()
        };
        // Each facet has one element at least.
        let most = settings.map_elements.min(MAX_LEAVES).max(world.facets.len() as u64) as f64;
        while total(element_m) > most {
            element_m *= 1.125;
        }
        let mut trees = 0;
        let facets = world
            .facets
            .iter()
            .map(|facet| {
                let (parts, first) = (parts(facet, element_m) as u32, trees);
                trees += parts * parts;
                Subdivision { first, parts, area_m2: facet.area_m2() }
            })
            .collect();
        let trees = Trees { roots: Vec::new(), lists: Vec::new(), leaves: trees as usize };
        Self { facets, trees, reconstruction: settings.map_reconstruction }
    }

    /// Puts it among the decisions: how facets are cut, and their parts split.
    pub(crate) fn put(&self, out: &mut Writer) {
        for Subdivision { first, parts, area_m2: _ } in &self.facets {
            out.value(first);
            out.value(parts);
        }
        let Trees { roots, lists, leaves } = &self.trees;
        let entries = roots.iter().chain(lists.iter().flatten());
        entries.for_each(|entry| out.value(entry));
        out.value(&(*leaves as u64));
    }

    /// Reconstruction of the illuminance in an element.
    pub(crate) fn reconstruction(&self) -> Reconstruction {
        self.reconstruction
    }

    /// Number of elements, each side of a facet counted.
    pub(crate) fn len(&self) -> usize {
        2 * self.trees.leaves
    }

    /// Elements on one side of all facets.
    pub(super) fn leaves(&self) -> usize {
        self.trees.leaves
    }

    /// The element under a place on a facet that keeps illuminance, on the side that was hit.
    pub(crate) fn locate(&self, at: &Interaction) -> MapPoint {
        let facet = self.facets[at.facet as usize];
        let part = locate_in_grid(at.barycentric, facet.parts);
        let cell = self.trees.descend(facet.first as usize + part.number, part);
        let leaf = cell.number;
        // Sides that see no light lie together, so that they take no memory.
        let element = if at.front { leaf } else { self.trees.leaves + leaf };
        let area_m2 = facet.area_m2 * (cell.step * cell.step);
        MapPoint { element, barycentric: cell.weights, area_m2 }
    }

    /// The layout with those leaves split for which `is_split` says so.
    pub(super) fn split(self, is_split: impl Fn(usize) -> bool) -> Self {
        Self { trees: self.trees.split(is_split), ..self }
    }
}

impl Trees {
    /// Finds a point in the leaves of a tree.
    #[inline]
    fn descend(&self, tree: usize, mut at: InCell) -> InCell {
        let Some(&root) = self.roots.get(tree) else { return InCell { number: tree, ..at } };
        let mut entry = root;
        while entry & SPLIT != 0 {
            let child = locate_in_quarters(at.weights);
            entry = self.lists[(entry & !SPLIT) as usize][child.number];
            at = InCell { step: at.step * child.step, ..child };
        }
        InCell { number: entry as usize, ..at }
    }

    /// Numbers the leaves anew, in the order of trees and of children: neighbours stay together.
    fn split(self, is_split: impl Fn(usize) -> bool) -> Self {
        let before = self;
        let count = if before.roots.is_empty() { before.leaves } else { before.roots.len() };
        let mut after = Self { roots: Vec::with_capacity(count), lists: Vec::new(), leaves: 0 };
        for tree in 0..count {
            let entry = before.roots.get(tree).map_or(tree as u32, |&root| root);
            let root = after.copy(&before, entry, &is_split);
            after.roots.push(root);
        }
        after
    }

    /// Takes over what is at `entry` of `before`, its leaves split or not.
    fn copy(&mut self, before: &Self, entry: u32, is_split: &impl Fn(usize) -> bool) -> u32 {
        let children = match entry & SPLIT {
            0 if !is_split(entry as usize) => return self.leaf(),
            0 => None,
            _ => Some(before.lists[(entry & !SPLIT) as usize]),
        };
        let list = self.lists.len();
        self.lists.push([0; 4]);
        for child in 0..4 {
            self.lists[list][child] = match children {
                None => self.leaf(),
                Some(entries) => self.copy(before, entries[child], is_split),
            };
        }
        SPLIT | list as u32
    }

    fn leaf(&mut self) -> u32 {
        self.leaves += 1;
        (self.leaves - 1) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::photon::map::fixture::{Numbers, at, square};

    /// The layout of [`square`] with leaves split by chance, three times over.
    fn ragged(world: &World<f64>, numbers: &mut Numbers) -> MapLayout {
        let settings = Settings { map_element_m: Some(0.8), ..Settings::default() };
        let mut layout = MapLayout::new(world, &settings);
        for _ in 0..3 {
            let chosen: Vec<bool> = (0..layout.leaves()).map(|_| numbers.next() < 0.4).collect();
            layout = layout.split(|leaf| chosen[leaf]);
        }
        layout
    }

    /// Corners of all leaves as facet and second and third weights, by bisecting edges: in the
    /// order of their numbers.
    fn leaves_by_brute_force(layout: &MapLayout) -> Vec<(u32, [[f64; 2]; 3])> {
        fn add(trees: &Trees, entry: u32, facet: u32, t: [[f64; 2]; 3], leaves: &mut [Vec<Leaf>]) {
            if entry & SPLIT == 0 {
                leaves[entry as usize].push((facet, t));
                return;
            }
            let middle = |i: usize, j: usize| [0, 1].map(|k| 0.5 * (t[i][k] + t[j][k]));
            let (far_a, far_b, far_c) = (middle(1, 2), middle(2, 0), middle(0, 1));
            let children = [
                [t[0], far_c, far_b],
                [far_c, t[1], far_a],
                [far_b, far_a, t[2]],
                [far_a, far_b, far_c],
            ];
            for (child, t) in trees.lists[(entry & !SPLIT) as usize].into_iter().zip(children) {
                add(trees, child, facet, t, leaves);
            }
        }
        type Leaf = (u32, [[f64; 2]; 3]);
        let mut leaves: Vec<Vec<Leaf>> = vec![Vec::new(); layout.leaves()];
        for (facet, cut) in (0..).zip(&layout.facets) {
            let n = f64::from(cut.parts);
            let mut tree = cut.first;
            for row in 0..cut.parts {
                for column in 0..cut.parts - row {
                    let corner =
                        |i: u32, j: u32| [f64::from(row + i) / n, f64::from(column + j) / n];
                    let mut cells = vec![[corner(0, 0), corner(1, 0), corner(0, 1)]];
                    if row + column + 1 < cut.parts {
                        cells.push([corner(1, 1), corner(0, 1), corner(1, 0)]);
                    }
                    for cell in cells {
                        let root = layout.trees.roots[tree as usize];
                        add(&layout.trees, root, facet, cell, &mut leaves);
                        tree += 1;
                    }
                }
            }
        }
        assert!(leaves.iter().all(|found| found.len() == 1), "numbers come once each");
        leaves.into_iter().map(|found| found[0]).collect()
    }

    #[test]
    fn places_are_found_as_by_brute_force() {
        let (world, numbers) = (square(), &mut Numbers(1));
        let layout = ragged(&world, numbers);
        let leaves = leaves_by_brute_force(&layout);
        assert_eq!(layout.len(), 2 * leaves.len());
        for _ in 0..20_000 {
            let at = at(&world, numbers);
            let place = layout.locate(&at);
            let leaf = if at.front { place.element } else { place.element - leaves.len() };
            let (facet, corners) = leaves[leaf];
            assert_eq!(facet, at.facet);
            // The place is where its weights say that it is.
            for (k, weight) in [(0, at.barycentric[1]), (1, at.barycentric[2])] {
                let moved: f64 = (0..3).map(|i| corners[i][k] * place.barycentric[i]).sum();
                assert!((moved - weight).abs() < 1e-12);
            }
            let [a, b, c] = corners;
            let share = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            let area_m2 = world.facets[facet as usize].area_m2() * share.abs();
            assert!((place.area_m2 / area_m2 - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn elements_stay_within_their_bound() {
        let world = square();
        for map_elements in [1, 2, 100, 1000] {
            let settings =
                Settings { map_elements, map_element_m: Some(0.001), ..Settings::default() };
            let leaves = MapLayout::new(&world, &settings).leaves() as u64;
            assert!(leaves <= map_elements.max(2) && 2 * leaves > map_elements, "{leaves}");
        }
    }
}
