//! Where light is asked for: grids and single points.

use glam::DVec3;

/// Quantity of a grid's values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Quantity {
    /// The illuminance at the cell's centre.
    #[default]
    Centre,
    /// The mean illuminance over the cell.
    Mean,
}

/// A virtual receiver: it measures, and never blocks light.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Unique name, also the name of its result files.
    pub name: String,
    /// Its shape.
    pub shape: SensorShape,
}

/// The shape of a sensor: a closed set.
#[derive(Clone, Debug, PartialEq)]
pub enum SensorShape {
    /// A rectangle cut into equal cells, u fastest.
    Grid(Grid),
    /// Single points.
    Points(Vec<SensorPoint>),
}

/// A rectangle of cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Corner of the rectangle in m.
    pub origin: DVec3,
    /// First edge of the rectangle in m.
    pub u: DVec3,
    /// Second edge of the rectangle in m.
    pub v: DVec3,
    /// Number of cells along `u` and `v`, at least 1 each.
    pub counts: [u32; 2],
    /// Unit normal: light from this side counts.
    pub normal: DVec3,
    /// Quantity of its values.
    pub quantity: Quantity,
    /// The illuminance in lx that is wanted everywhere, finite and above 0: pictures have its line.
    pub target_lx: Option<f64>,
}

/// One point of measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorPoint {
    /// World position in m.
    pub position: DVec3,
    /// Unit normal: light from this side counts.
    pub normal: DVec3,
}

impl Grid {
    /// Edges of one cell in m.
    #[must_use]
    pub fn cell_edges(&self) -> [DVec3; 2] {
        [self.u / f64::from(self.counts[0]), self.v / f64::from(self.counts[1])]
    }

    /// The point at `uv` in [0, 1)^2 of cell number `cell` (u fastest).
    #[must_use]
    pub fn point_in_cell(&self, cell: usize, uv: [f64; 2]) -> DVec3 {
        let columns = self.counts[0] as usize;
        let (i, j) = ((cell % columns) as f64, (cell / columns) as f64);
        let [du, dv] = self.cell_edges();
        self.origin + du * (i + uv[0]) + dv * (j + uv[1])
    }

    /// The number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.counts[0] as usize * self.counts[1] as usize
    }
}

impl Sensor {
    /// The number of values that the sensor asks for: points, or cells of a grid.
    #[must_use]
    #[allow(clippy::len_without_is_empty, reason = "a checked scene has no empty sensor")]
    pub fn len(&self) -> usize {
        match &self.shape {
            SensorShape::Points(points) => points.len(),
            SensorShape::Grid(grid) => grid.cells(),
        }
    }

    /// The points of the sensor: cell centres for a grid, u fastest.
    #[must_use]
    pub fn points(&self) -> Vec<SensorPoint> {
        (0..self.len()).map(|index| self.point(index)).collect()
    }

    /// One of them.
    ///
    /// # Panics
    /// If there are no more than `index` points.
    #[must_use]
    pub fn point(&self, index: usize) -> SensorPoint {
        match &self.shape {
            SensorShape::Points(points) => points[index],
            SensorShape::Grid(grid) => {
                SensorPoint { position: grid.point_in_cell(index, [0.5, 0.5]), normal: grid.normal }
            }
        }
    }
}
