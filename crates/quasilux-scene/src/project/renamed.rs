//! Keys of `[simulation]` that were renamed or are gone: they are refused, and messages say what
//! replaces them.

/// A key of `[simulation]`, of plans and of checkpoints that there is no more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefusedKey {
    /// The name that is refused.
    pub old: &'static str,
    /// Replacement of the key, as messages go on after the name.
    pub now: &'static str,
}

const ALWAYS_CONNECTED: &str =
    "is gone: \"auto\" connects paths to light subpaths wherever that helps";

/// All of them.
pub const REFUSED_KEYS: [RefusedKey; 3] = [
    RefusedKey { old: "steering", now: "is \"importance\" now" },
    RefusedKey { old: "joining", now: ALWAYS_CONNECTED },
    RefusedKey { old: "connections", now: ALWAYS_CONNECTED },
];
