//! Wrong scenes of which each is told by name and place, and right ones of which nothing is told.

mod dark;
mod others;
mod random;
mod right;
mod room;
mod windows;
mod wrong;
