//! Wrong scenes of which each is told by name and place, and right ones of which nothing is told.

mod any_room;
mod any_window;
mod dark;
mod furnished;
mod others;
mod random;
mod right;
mod room;
mod spoil;
mod windows;
mod wrong;
