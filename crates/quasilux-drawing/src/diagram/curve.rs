//! A curve over the angle gamma, as polar and Cartesian diagrams draw it.

use crate::style::Stroke;

/// The intensities of one plane.
#[derive(Clone, Debug, PartialEq)]
pub struct IntensityCurve {
    /// Its name in the legend.
    pub name: String,
    /// Points (gamma in degrees from -180 to 180, ascending; candela), joined by straight lines in
    /// gamma. Two points at one gamma are a jump.
    pub points: Vec<[f64; 2]>,
    /// How it is drawn.
    pub stroke: Stroke,
}
