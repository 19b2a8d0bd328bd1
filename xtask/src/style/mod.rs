//! Rules on the text of the sources, each a function from text to violations.
//!
//! [`functions`] lists the functions of a crate with their lengths and the types of their
//! signatures, [`shipped`] counts lines outside tests, `tuples` looks for unlike types in tuples,
//! [`width`] for long lines, and [`files`] walks the workspace.

pub mod files;
pub mod functions;
pub mod shipped;
mod tuples;
pub mod width;
