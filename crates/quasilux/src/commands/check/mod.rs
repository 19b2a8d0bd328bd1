//! `quasilux check PROJECT`: what was understood of a project, what is probably wrong with it, and
//! its plan.

mod document;
mod panes;
mod summary;

use super::run::{Folder, count, pool};
use crate::arguments::CheckArguments;
use crate::door::{Admitted, prepare};
use crate::exit::{CliError, Exit};
use crate::print::{print, print_document};
use crate::project::Project;
use crate::{project, results};
use quasilux_drawing::picture::PlanMark;
use quasilux_inspection::Finding;

/// Looks at a project, writes its plan, and reports; findings make the exit code 1 with `--strict`.
pub(crate) fn check(arguments: &CheckArguments) -> Result<Exit, CliError> {
    let project = project::open(&arguments.project)?;
    let folder = arguments.out.clone().unwrap_or_else(|| Folder::by_name(&arguments.project));
    let title = arguments.project.file_stem().unwrap_or_default().to_string_lossy();
    results::prepare(&folder)?;
    let Admitted { findings, .. } = pool(count(None))?.install(|| prepare(&project));
    let plan = quasilux_report::plan(&project.loaded.scene, &title, &marks(&findings));
    results::write_atomic(&folder.join("plan.png"), &plan.to_png(1.0))?;
    results::write_atomic(&folder.join("plan.svg"), plan.to_svg().as_bytes())?;
    if arguments.json {
        print_document(&document(&project, &findings))?;
    } else {
        if !arguments.quiet {
            print(&summary::summary(&project))?;
        }
        print(&summary::oddities(&project, &findings))?;
        if !arguments.quiet {
            print(&format!("plan in {0}/plan.png and {0}/plan.svg\n", folder.display()))?;
        }
    }
    Ok(if arguments.strict && !findings.is_empty() { Exit::CheckFailed } else { Exit::Done })
}

/// The document for programs.
pub(crate) fn document(project: &Project, findings: &[Finding]) -> String {
    document::document(project, findings)
}

/// What was understood, and what is odd, for people.
pub(crate) fn text(project: &Project, findings: &[Finding]) -> String {
    summary::summary(project) + &summary::oddities(project, findings)
}

/// A remark for each finding, numbered as in the list.
pub(crate) fn marks(findings: &[Finding]) -> Vec<PlanMark> {
    let mark = |(number, finding): (usize, &Finding)| {
        let text = format!("{}; {}", finding.message, finding.cure);
        PlanMark { position_m: finding.position_m, number: number as u32 + 1, text }
    };
    findings.iter().enumerate().map(mark).collect()
}
