//! What is probably wrong with a scene, and its plan.

use crate::commands::{check_document, check_text, count, marks, pool};
use crate::door::{Admitted, prepare};
use crate::exit::CliError;
use crate::project::Project;
use quasilux_drawing::Drawing;
use quasilux_inspection::Finding;

/// What `quasilux check` says.
#[derive(Clone, Debug)]
pub struct Checked {
    /// What is probably wrong.
    pub findings: Vec<Finding>,
    /// The document, format "quasilux-check/1".
    pub document: String,
    /// The same for people, with what was understood.
    pub text: String,
}

/// Looks at a project as `quasilux check` does.
///
/// # Errors
/// When there are no threads for it.
pub fn check(project: &Project) -> Result<Checked, CliError> {
    let Admitted { findings, .. } = pool(count(None))?.install(|| prepare(project));
    let document = check_document(project, &findings);
    let text = check_text(project, &findings);
    Ok(Checked { findings, document, text })
}

/// The plan of a scene, findings marked in it.
#[must_use]
pub fn plan(project: &Project, findings: &[Finding]) -> Drawing {
    quasilux_report::plan(&project.loaded.scene, project.title(), &marks(findings))
}
