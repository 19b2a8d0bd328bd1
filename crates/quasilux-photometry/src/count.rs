//! A count that a file states, with its position.

use quasilux_text::Position;

/// A number of things, such as planes or lamps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Count {
    pub(crate) value: usize,
    pub(crate) at: Position,
}
