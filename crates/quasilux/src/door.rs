//! The door of a run: what is probably wrong with a scene is told before light is traced.

use crate::exit::CliError;
use crate::print::tell;
use crate::project::Project;
use crate::watcher::Watcher;
use quasilux_inspection::{Finding, inspect};
use quasilux_transport::PreparedScene;
use std::fmt::Write;

/// What is done about findings.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Door {
    /// Whether a scene with findings is refused.
    pub(crate) strict: bool,
    /// Whether they are printed.
    pub(crate) announces: bool,
}

/// A scene that may be simulated, and what is probably wrong with it.
pub(crate) struct Admitted<'a> {
    pub(crate) prepared: PreparedScene<'a>,
    pub(crate) findings: Vec<Finding>,
}

/// Builds the hierarchy over a scene, with the threads of the pool that the call is made in, and
/// inspects it.
pub(crate) fn prepare(project: &Project) -> Admitted<'_> {
    let prepared = PreparedScene::new(&project.loaded.scene);
    let findings = inspect(&project.loaded.scene, &project.loaded.places, prepared.hierarchy());
    Admitted { prepared, findings }
}

impl Door {
    /// Lets a scene in that was [prepared](prepare).
    ///
    /// # Errors
    /// When something is probably wrong with it, and the door is strict.
    pub(crate) fn admit<'a>(
        self,
        admitted: Admitted<'a>,
        watcher: &Watcher<'_>,
    ) -> Result<Admitted<'a>, CliError> {
        if self.strict && !admitted.findings.is_empty() {
            return Err(refusal(&admitted.findings));
        }
        if self.announces {
            watcher.say(|| admitted.findings.iter().for_each(|it| tell(format!("warning: {it}"))));
        }
        Ok(admitted)
    }
}

/// All findings in one error, the first one first.
fn refusal(findings: &[Finding]) -> CliError {
    let mut text = findings[0].to_string();
    for finding in &findings[1..] {
        write!(text, "\nerror: {finding}").expect("strings grow");
    }
    CliError::new(text)
}
