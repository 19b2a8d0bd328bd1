//! What the architecture test and the command `cargo xtask` know about the sources of the
//! workspace.
//!
//! [`modules`] reads which module imports which, [`style`] finds long functions, long lines and
//! tuples of unlike types, [`packages`] what crates lack before others can take them,
//! [`ratchet`] keeps the lists of known violations, [`messages`] lists the texts that users see,
//! [`workspace`] knows where all is.

pub mod messages;
pub mod modules;
pub mod packages;
pub mod ratchet;
pub mod style;
pub mod workspace;
