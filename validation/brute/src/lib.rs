//! A brute-force reference: plain Monte Carlo in f64 with pseudo-random numbers.
//!
//! It shares no code with quasilux, and takes no decision from what it finds: no pilot, no
//! adaptation, no map. A [`Scene`] has surfaces ([`Surface`]), point lights, emitting triangles, a
//! [`Sky`] with ground, the [`Sun`], and [`Sensor`]s: points, discs and cells. A [`Mode`] says how
//! light is found, by paths from the sensors or by walks from the lights; each mode says what it
//! misses. As light adds up, each [`Source`] may be given to the mode that suits it, in [`Part`]s.
//!
//! Where light is hard to find, the scene lists [`Lookout`]s: parallelograms worth looking at from
//! the sensors (hints), or worth aiming at from the lights (aims). They change the error and never
//! the mean.
//!
//! A standard error that comes from few rare paths is too small: run two seeds, see
//! [`largest_disagreement`], and look at [`Estimate::largest_share`].

mod direct;
mod emission;
mod estimate;
mod hint;
mod light;
mod metal;
mod mode;
mod optics;
mod path;
mod random;
mod roulette;
mod run;
mod scene;
mod sensor;
mod sky;
mod solve;
mod start;
mod surface;
mod tree;
mod triangle;
mod vertex;
mod walk;
mod world;

#[cfg(test)]
mod tests;

pub use estimate::{Estimate, largest_disagreement};
pub use hint::Lookout;
pub use light::{Candela, CandelaRow, PointLight};
pub use mode::Mode;
pub use random::Xoshiro;
pub use scene::{Scene, Source};
pub use sensor::{Extent, Sensor};
pub use sky::{Sky, SkyModel, Sun};
pub use solve::{
    Limits, Part, direct_point_lx, solve, solve_by, solve_by_until, solve_parts, solve_until,
};
pub use surface::Surface;
pub use triangle::Triangle;
