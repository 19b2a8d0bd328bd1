//! A room in plan and elevations, with its lights, sensors and cameras, and remarks at their
//! places.

mod axes;
mod bounds;
mod contents;
mod cut;
mod draw;
mod edges;
mod hull;
mod ink;
mod key;
mod labels;
mod layout;
mod model;
mod notes;
mod projection;
mod region;
mod sheet;
mod symbols;
mod thin;
mod view;
mod words;

pub use model::{
    PlanAreaLight, PlanCamera, PlanGrid, PlanLuminaire, PlanMark, PlanPicture, PlanPoint,
    PlanPoints, Surfaces,
};
pub use sheet::plan;
