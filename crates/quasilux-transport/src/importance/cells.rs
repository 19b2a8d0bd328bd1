//! Cells of the survey: boxes of a regular grid, times six directions that a surface faces.
//!
//! Bounded whatever the mesh, and the two sides of a wall are apart in it. A box holds what faces
//! one of six ways together: coarse, which costs effort and never bias.

use crate::codec::Writer;
use crate::spectrum::Spectrum;
use crate::world::subdivision::grid_centroids;
use crate::world::{Interaction, World};
use glam::DVec3;

/// The edge of the boxes makes about this many cells of the scene's surfaces, one side each.
const CELLS: f64 = 2048.0;
/// No more boxes than this, so that tables over all cells stay small.
const MAX_BOXES: f64 = (1 << 16) as f64;
/// Cells are seen as small from this many of their edges.
const FAR_EDGES: f64 = 6.0;
/// Ways to face: along or against each axis.
const SIDES: usize = 6;
/// Parts along an edge of a facet by which its area is told to cells, at most.
const MAX_PARTS: f64 = 256.0;

/// Cells that are known by a number, told for any place.
pub(crate) struct Regions {
    cells: Cells,
    number_of_cell: Vec<u32>,
}

/// A grid of boxes over the scene.
#[derive(Clone)]
pub(crate) struct Cells {
    low: DVec3,
    edge_m: f64,
    counts: [usize; 3],
}

impl Regions {
    /// Marks cells without a number.
    pub(crate) const UNKNOWN: u32 = u32::MAX;

    /// Puts them among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        let Cells { low, edge_m, counts: _ } = self.cells;
        out.value(&[low.x, low.y, low.z, edge_m]);
        self.number_of_cell.iter().for_each(|number| out.value(number));
    }

    /// By the number of each cell, [`Self::UNKNOWN`] for none.
    pub(crate) fn new(cells: Cells, number_of_cell: Vec<u32>) -> Self {
        Self { cells, number_of_cell }
    }

    /// The number of the region that a place on the side `n` of a surface lies in.
    pub(crate) fn number(&self, position: DVec3, n: DVec3) -> Option<usize> {
        let number = self.number_of_cell[self.cells.cell_of(position, n)];
        (number != Self::UNKNOWN).then_some(number as usize)
    }
}

impl Cells {
    /// `None` where nothing has an area.
    pub(crate) fn new<S: Spectrum>(world: &World<S>) -> Option<Self> {
        let [low, high] = world.bounds()?;
        let area_m2: f64 = world.facets.iter().map(|facet| facet.area_m2()).sum();
        let mut edge_m = (area_m2 / CELLS).sqrt();
        if !(edge_m > 0.0 && edge_m.is_finite()) {
            return None;
        }
        let counts = |edge_m: f64| ((high - low) / edge_m).to_array().map(|n| n.floor() + 1.0);
        while counts(edge_m).iter().product::<f64>() > MAX_BOXES {
            edge_m *= 1.25;
        }
        Some(Self { low, edge_m, counts: counts(edge_m).map(|n| n as usize) })
    }

    /// Number of cells, most of them empty.
    pub(crate) fn len(&self) -> usize {
        self.counts.iter().product::<usize>() * SIDES
    }

    /// Two places this far apart, in m, see cells as small.
    pub(crate) fn far_m(&self) -> f64 {
        FAR_EDGES * self.edge_m
    }

    /// The cell of a place, on the side that was hit.
    pub(crate) fn cell(&self, at: &Interaction) -> usize {
        self.cell_of(at.position, at.n)
    }

    fn cell_of(&self, position: DVec3, n: DVec3) -> usize {
        let place = ((position - self.low) / self.edge_m).to_array();
        self.cell_in(place.map(|x| x.max(0.0) as usize), n)
    }

    /// The cell in a box, or the nearest box that there is, on the side `n`.
    fn cell_in(&self, boxes: [usize; 3], n: DVec3) -> usize {
        self.number(std::array::from_fn(|axis| self.bounded(boxes[axis], axis)), side(n))
    }

    fn bounded(&self, place: usize, axis: usize) -> usize {
        place.min(self.counts[axis] - 1)
    }

    fn number(&self, [x, y, z]: [usize; 3], side: usize) -> usize {
        ((z * self.counts[1] + y) * self.counts[0] + x) * SIDES + side
    }

    /// The cell and those of the boxes around it, as far as they face the same way.
    pub(crate) fn around(&self, cell: usize) -> impl Iterator<Item = usize> {
        let [nx, ny, nz] = self.counts;
        let (side, place) = (cell % SIDES, cell / SIDES);
        let [x, y, z] = [place % nx, place / nx % ny, place / (nx * ny)];
        let near = |place: usize, count: usize| place.saturating_sub(1)..(place + 2).min(count);
        near(z, nz).flat_map(move |z| {
            near(y, ny).flat_map(move |y| near(x, nx).map(move |x| self.number([x, y, z], side)))
        })
    }

    /// The area in m^2 in each cell of what keeps illuminance, to the parts that facets are cut
    /// into.
    pub(crate) fn areas_m2<S: Spectrum>(&self, world: &World<S>) -> Vec<f64> {
        let mut areas_m2 = vec![0.0; self.len()];
        for facet in &world.facets {
            if !world.bsdf_of(facet).keeps_illuminance() {
                continue;
            }
            let parts = (2.0 * facet.longest_edge_m() / self.edge_m).ceil().clamp(1.0, MAX_PARTS);
            let part_m2 = facet.area_m2() / (parts * parts);
            for weights in grid_centroids(parts as u32) {
                let position = facet.point(weights);
                for n in [facet.front_normal, -facet.front_normal] {
                    areas_m2[self.cell_of(position, n)] += part_m2;
                }
            }
        }
        areas_m2
    }
}

/// The way that a normal faces, of [`SIDES`].
fn side(n: DVec3) -> usize {
    let size = n.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    2 * axis + usize::from(n[axis] > 0.0)
}
