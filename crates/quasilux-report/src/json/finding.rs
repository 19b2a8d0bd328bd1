//! What is probably wrong with a scene.

use quasilux_inspection::Finding;
use serde::Serialize;

/// One finding: the `check` that found it, the `file` to mend with `line` and `column`, the
/// `message`, the `cure`, and its `position` in the scene in m. What there is not is `null`.
#[derive(Debug, Serialize)]
pub struct FindingEntry<'a> {
    check: &'static str,
    file: &'a str,
    line: Option<usize>,
    column: Option<usize>,
    message: &'a str,
    cure: &'a str,
    position: Option<[f64; 3]>,
}

impl<'a> FindingEntry<'a> {
    /// The entry of a finding.
    #[must_use]
    pub fn new(finding: &'a Finding) -> Self {
        Self {
            check: finding.check.name(),
            file: &finding.file,
            line: finding.place.map(|place| place.line),
            column: finding.place.map(|place| place.column),
            message: &finding.message,
            cure: &finding.cure,
            position: finding.position_m.map(|position| position.to_array()),
        }
    }
}
