//! Dimensions of a point set whose coordinates are replaced or moved.

/// Dimensions that are not those of the point set itself.
#[derive(Clone, Copy)]
pub(crate) struct Variation {
    /// The first of them.
    pub(crate) first: u32,
    /// The first behind them.
    pub(crate) end: u32,
    pub(crate) change: Change,
}

#[derive(Clone, Copy)]
pub(crate) enum Change {
    /// Randomised under another key.
    Exchange { key: u64 },
    /// Moved by a step.
    Move { by: f64 },
}
