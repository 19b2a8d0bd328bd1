//! Light that would not end: where photons and paths are cut.
//!
//! Flux falls from bounce to bounce wherever something absorbs. It stays in halls of perfect
//! mirrors. It grows between surfaces whose tables say that they give more than they get: the
//! series of bounces has no sum there, and no estimate of it would ever be done.

/// After this many events a photon or path is cut: only halls of perfect mirrors get there.
pub(crate) const MAX_EVENTS: u32 = 4096;

/// Light that became this many times as much on its way is cut: a single bounce is taken as its
/// table says, however much that is.
pub(crate) const MAX_GAIN: f64 = 100.0;

/// Gain of light by the surfaces on its way, expected values of all choices: the product of their
/// albedos.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gain(f64);

impl Gain {
    /// At the start.
    pub(crate) const NONE: Self = Self(1.0);

    /// Adds one more surface, which others came before where `bounces` is not 0; whether light goes
    /// on from there, or has grown too much.
    pub(crate) fn grow(&mut self, albedo: f64, bounces: u32) -> bool {
        self.0 *= albedo;
        bounces == 0 || !self.is_cut()
    }

    /// Whether it has grown too much.
    pub(crate) fn is_cut(self) -> bool {
        self.0 > MAX_GAIN
    }
}
