//! What is decided before the first sample, by surveys and pilots whose indices no estimate uses.

/// Decisions of surveys and pilots: a function of scene and settings.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Decisions {
    /// Light subpaths of an index, which all sensor points share; `None` of estimators without any.
    pub connected_photons: Option<u64>,
    /// Whether photons are split, ended and guided on their way.
    pub uses_importance: bool,
    /// Whether photons leave lit places instead of point-like lights.
    pub first_shot: bool,
    /// Sides of elements of the illumination map, where paths end on one.
    pub map_elements: Option<u64>,
    /// Photons for each path that look for what paths cannot find, where there is such light.
    pub caustic_photons: Option<u64>,
    /// SHA-256 of all that was decided, with every number that an estimate depends on.
    pub digest: [u8; 32],
}
