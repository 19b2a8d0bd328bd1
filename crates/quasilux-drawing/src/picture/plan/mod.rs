//! A room in plan and elevations, with its lights, sensors and cameras, and remarks at their
//! places.

pub(super) use bounds::Bounds;
pub(super) use cut::Plane;
pub(super) use edges::edges;
pub(super) use labels::{Box, Labels};
pub(super) use projection::Projection;
pub(super) use region::outlines;
pub(super) use scope::Scope;
pub(super) use symbols::{Ink, TICK_PX, north, opening, star};
pub(super) use thin::{clipped, thinned};
pub(super) use windows::{WindowSet, WindowView};

mod axes;
mod bounds;
mod contents;
mod cut;
mod draw;
mod edges;
#[cfg(test)]
pub(super) mod fixtures;
mod forest;
mod holes;
mod hull;
pub(super) mod ink;
mod key;
mod labels;
mod layout;
mod model;
mod notes;
mod pieces;
mod projection;
mod region;
mod scope;
mod sheet;
mod symbols;
mod thin;
mod view;
mod windows;
mod words;

pub use forest::first_of_each;
pub use model::{
    PlanAreaLight, PlanCamera, PlanGrid, PlanLuminaire, PlanMark, PlanPicture, PlanPoint,
    PlanPoints, Surfaces,
};
pub use sheet::plan;
