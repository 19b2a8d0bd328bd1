//! A free flight: the straight segment between two vertices of a light path.

use glam::DVec3;

/// A straight piece of a photon's way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight {
    pub(crate) from: DVec3,
    pub(crate) direction: DVec3,
    /// Infinite where it leaves the scene.
    pub(crate) length_m: f64,
}
