//! A year of hours for about the work of one: [`simulate_year`].
//!
//! Paths from a sensor point (`paths`) know nothing of any hour: what they find of the sky, of the
//! ground and of places of the sun is kept apart (`coefficients`), on a mesh of directions
//! (`mesh`). An hour is a product of these coefficients with its luminances (`hours`), and what
//! comes straight from its sun, for which every hour has its own rays (`sun_disks`). All is done in
//! independent replicates, mesh included, so that the spread of an hour's values makes its
//! interval.
//!
//! Points are simulated block by block (`year`), and a block is over before the next begins: nobody
//! holds the hours of all points.

mod coefficients;
mod hours;
mod mesh;
mod paths;
mod sun_disks;
mod year;

pub use year::{PointOfYear, YearProgress, YearWork, simulate_year};
