//! A year of hours for about the work of one: [`simulate_year`].
//!
//! Paths from a sensor point (`path::daylight_paths`) know nothing of any hour: what they find of
//! the sky, of the ground and of places of the sun is kept apart (`coefficients`), on a mesh of
//! directions (`mesh`). An hour is a product of these coefficients with its luminances (`hours`),
//! and what comes straight from its sun, for which every hour has its own rays (`sun_disks`). All
//! is done in independent replicates, mesh included, so that the spread of an hour's values makes
//! its interval.
//!
//! Points are simulated block by block (`state`), and a block is over before the next begins
//! (`year`): the hours of all points are never held at once. Blinds make other rooms of a room,
//! each of which has its hours; when they close, the sun on the points may decide (`sunlit`).

mod coefficients;
mod hours;
mod mesh;
mod pilot;
mod results;
mod state;
mod sun_disks;
mod sunlit;
mod year;

pub use results::{PointOfYear, YearProgress, YearWork};
pub use sunlit::{Sunlight, seen_suns, sunlit_points};
pub use year::{OtherRoom, YearHours, YearObserver, YearRun, simulate_year};
