//! Rules on the text of the sources, each a function from text to violations.
//!
//! [`functions`] lists the functions of a crate with their lengths and the types of their
//! signatures, [`declarations`] the names that a file declares, [`shipped`] counts lines outside
//! tests, `tuples` looks for unlike types in tuples, [`width`] for long lines, [`openers`] for
//! documentation that opens without a noun, [`words`] for old words, and [`files`] walks the
//! workspace.

pub mod declarations;
pub mod files;
pub mod functions;
pub mod openers;
pub mod shipped;
mod tuples;
pub mod width;
pub mod words;
