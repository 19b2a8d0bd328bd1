//! Hard rooms at random, by quasilux and by `quasilux-brute`, which shares no code with it:
//! `cargo xtask gauntlet`.
//!
//! A room follows from its family and its number ([`room_of`]): parameters come from a hash of
//! both. It is written as a project of quasilux ([`Room::project`]) and as a scene of the reference
//! ([`brute_scene()`]), which is told where to look. One run is looked at when its limits pass
//! ([`trial::RunSettings::run`]), and each value is held against its reference: an interval that is
//! more than 5 standard errors off is false, of values with a bound on unseen light only where the
//! truth is above that as well. What chance allows is counted beside ([`likelihood`]).
//!
//! Runs and references are kept in a folder ([`record`], [`references`]), so that a command that
//! was broken off goes on.

mod brute_scene;
pub mod command;
mod count;
mod dice;
mod digest;
pub mod effort;
mod families;
mod judgement;
pub mod likelihood;
mod project;
pub mod record;
pub mod references;
mod report;
mod room;
mod shell;
mod solids;
pub mod trial;
pub mod truth;

pub use brute_scene::{brute_parts, brute_scene};
pub use dice::Parameter;
pub use families::room_of;
pub use project::{NamedFile, ProjectFiles, Slot};
pub use report::{Report, Subject};
pub use room::{
    Face, FoundBy, Lamp, Lookout, Outside, Parallelogram, Room, SensorPlace, Shine, SkyKind,
    SunPlace, Surface,
};

#[cfg(test)]
mod tests;
