//! What a scene is whose illuminances are known, and the contour integral that says many of them.

use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_sky::WeatherSky;
use quasilux_transport::EstimatorKind;

/// A scene with one sensor, and what its points get.
pub(super) struct KnownScene {
    pub(super) name: &'static str,
    /// Why the values are known.
    pub(super) why: &'static str,
    pub(super) scene: Scene,
    /// Hours that are simulated as of a year; none for a run of its own.
    pub(super) hours: Vec<WeatherSky>,
    /// Point by point, of each its hours.
    pub(super) truth_lx: Vec<f64>,
    pub(super) estimator: EstimatorKind,
    /// Reached after a few checkpoints, with points of each kind in the order of
    /// [`super::SEQUENCES`]: so that runs of both stop at two looks or more.
    pub(super) rel_tol: [f64; 2],
}

/// What a polygon of one luminance gives to a place that sees all of it from above its horizon (J.
/// H. Lambert, Photometria, 1760): half the luminance times the sum over edges of the angle that an
/// edge subtends times the cosine of its plane's normal. Corners run counter-clockwise as the place
/// sees them.
pub(super) fn polygon_lx(at: DVec3, n: DVec3, corners: &[DVec3], luminance_cd_m2: f64) -> f64 {
    let edges = corners.iter().zip(corners.iter().cycle().skip(1));
    let edge = |(a, b): (&DVec3, &DVec3)| {
        let (a, b) = ((*a - at).normalize(), (*b - at).normalize());
        let normal = a.cross(b);
        libm::acos(a.dot(b).clamp(-1.0, 1.0)) * n.dot(normal) / normal.length()
    };
    (0.5 * luminance_cd_m2 * edges.map(edge).sum::<f64>()).abs()
}
