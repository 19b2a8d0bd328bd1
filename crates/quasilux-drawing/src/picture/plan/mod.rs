//! A room in plan and elevations, with its lights, sensors and cameras, and remarks at their
//! places.

mod cut;
mod model;
mod projection;
mod sheet;

pub use model::{
    PlanAreaLight, PlanCamera, PlanGrid, PlanLuminaire, PlanMark, PlanPicture, PlanPoint,
    PlanPoints, Surfaces,
};
pub use sheet::plan;
