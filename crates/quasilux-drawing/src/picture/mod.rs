//! Raster pictures: false colours with a scale for grids and images, tone-mapped images, alone or
//! side by side.
//!
//! The false-colour picture of a grid has flat cells in true proportion, contour lines at round
//! values, the number of each cell where it fits, axes in metres and a legend. Cells show one
//! computed value each; only the contour lines interpolate (smoothly between cell centres, linearly
//! beyond them up to the border), and leave out what may be noise.

mod axis;
mod caption;
mod cells;
mod colour_map;
mod contour;
mod decades;
mod extremes;
mod false_colours;
mod frame;
mod grid;
mod image;
mod label;
mod layout;
mod luminance;
mod luminance_scale;
mod numbers;
mod overlay;
mod plan;
mod plot;
mod scale;
mod series;
mod sky;
mod steady;
mod tone_map;
mod window;
mod words;
mod year;

pub use caption::Caption;
pub use cells::{Cell, GridPicture, Surroundings};
pub use false_colours::{ContourLevel, FalseColourScale, false_colours};
pub use grid::grid;
pub use image::Image;
pub use luminance::{LuminancePicture, luminance};
pub use plan::{
    PlanAreaLight, PlanCamera, PlanGrid, PlanLuminaire, PlanMark, PlanPicture, PlanPoint,
    PlanPoints, Surfaces, first_of_each, plan,
};
pub use series::{LabelledImage, series};
pub use sky::{SkyPicture, sky};
pub use tone_map::tone_mapped_png;
pub use year::{YearPicture, year};
