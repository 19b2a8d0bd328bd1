//! Optical coefficients of materials: shares of light that are reflected or transmitted, and the
//! refractive index.

use super::document::{Section, Value};
use crate::{LoadError, Rgb};

/// Of glass, and of most plastics and varnishes.
const DEFAULT_ETA: f64 = 1.5;

/// Expected value of a share of light, for messages.
pub(super) const SHARES: &str = "a number or [r, g, b] within 0 to 1";

/// The share of light that a surface reflects.
pub(super) fn reflectance(section: &Section<'_>) -> Result<Rgb, LoadError> {
    shares(section.require("reflectance", SHARES)?)
}

/// The refractive index of a body or a pane; that of glass if not given.
pub(super) fn eta(section: &Section<'_>) -> Result<f64, LoadError> {
    index(section, "a refractive index within 0.2 to 5, not 1", |x| {
        (0.2..=5.0).contains(&x) && x != 1.0
    })
}

/// The refractive index, which `accept` takes and `expected` describes; that of glass if not given.
pub(super) fn index(
    section: &Section<'_>,
    expected: &str,
    accept: impl Fn(f64) -> bool,
) -> Result<f64, LoadError> {
    section.get("eta").map_or(Ok(DEFAULT_ETA), |eta| eta.number(expected, accept))
}

/// One share for all channels, or one for each.
pub(super) fn shares(value: Value<'_>) -> Result<Rgb, LoadError> {
    let share = |value: &Value<'_>| value.number(SHARES, |x| (0.0..=1.0).contains(&x));
    match value.array(SHARES) {
        Err(_) => Ok(Rgb::grey(share(&value)?)),
        Ok(channels) => match channels.as_slice() {
            [r, g, b] => Ok(Rgb([share(r)?, share(g)?, share(b)?])),
            _ => Err(value.unexpected(SHARES)),
        },
    }
}
