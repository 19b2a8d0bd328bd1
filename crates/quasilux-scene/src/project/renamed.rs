//! Keys of `[simulation]` that were renamed: the old names are refused, and messages give the new
//! ones.

/// A key of `[simulation]`, of plans and of checkpoints that was renamed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenamedKey {
    /// The name that is refused.
    pub old: &'static str,
    /// The name that replaces it.
    pub new: &'static str,
}

/// All renamed keys.
pub const RENAMED_KEYS: [RenamedKey; 2] = [
    RenamedKey { old: "steering", new: "importance" },
    RenamedKey { old: "joining", new: "connections" },
];
