//! What the architecture test and the command `cargo xtask` know about the sources of the
//! workspace.
//!
//! [`modules`] reads which module imports which, [`ratchet`] keeps the list of known violations,
//! [`workspace`] knows where all is.

pub mod modules;
pub mod ratchet;
pub mod workspace;
