//! Whether tests run in their deep variants, which find smaller errors and take longer.

/// The variable that asks for the deep variants with the value `1`.
pub const DEEP: &str = "QUASILUX_DEEP";

/// Whether the deep variants are asked for, as `cargo xtask test deep` does: never in the run that
/// each change has to pass.
///
/// A test states the smallest error that it finds in both variants.
#[must_use]
pub fn deep() -> bool {
    std::env::var_os(DEEP).is_some_and(|value| value == "1")
}
