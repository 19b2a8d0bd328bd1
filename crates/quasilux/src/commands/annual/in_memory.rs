//! A year whose results stay in memory, for programs that carry this one in them.

use super::sink::{HOURS_FILE, Sink, YearFile, files};
use super::year::Year;
use crate::arguments::YearArguments;
use crate::commands::count;
use crate::exit::CliError;
use crate::project::{self, Project};
use quasilux_report::annual::{BlindsOfYear, Calendar, annual_table};
use quasilux_transport::Control;
use std::io;
use std::path::PathBuf;
use std::time::Instant;

/// Told many times a second, on several threads, what share of a year is over; may stop it.
pub type YearListener<'l> = &'l (dyn Fn(f64) -> Control + Sync);

/// A year that is over, or was stopped.
#[derive(Clone, Debug)]
pub struct FinishedYear {
    /// All files that `quasilux annual` writes.
    pub files: Vec<YearFile>,
    /// The table of the terminal.
    pub table: String,
    /// The hours.
    pub calendar: Calendar,
    /// Where blinds are, if there are any.
    pub blinds: Option<BlindsOfYear>,
    /// Whether all points are over.
    pub is_complete: bool,
}

/// Simulates a year of a project as [`super::annual`] does.
#[expect(clippy::disallowed_methods, reason = "the command line reports how long a year took")]
pub(crate) fn year_in_memory(
    project: &Project,
    arguments: &YearArguments,
    listener: Option<YearListener<'_>>,
) -> Result<FinishedYear, CliError> {
    let settings = project::annual_settings(project, arguments)?;
    let threads = count(arguments.threads);
    let year = Year::new(project, settings, arguments.occupied.as_ref(), threads)?;
    let begin = Instant::now();
    let mut report = year.report()?;
    let mut hours = Vec::new();
    let cannot_keep = |error: io::Error| CliError::new(format!("cannot keep the hours: {error}"));
    let place = PathBuf::from(HOURS_FILE);
    let sink = Sink::begin(&mut report, &mut hours, place, year.points());
    let mut sink = sink.map_err(cannot_keep)?;
    let goes_on = |share: f64| listener.is_none_or(|listener| listener(share) == Control::Continue);
    let is_complete = year.trace(0..year.points(), &mut |block| sink.take(&block), &goes_on)?;
    sink.end(is_complete).map_err(cannot_keep)?;
    report.run.seconds += begin.elapsed().as_secs_f64();
    let mut files = files(&report, project.title());
    files.push(YearFile { name: HOURS_FILE.to_owned(), content: hours });
    Ok(FinishedYear {
        files,
        table: annual_table(&report),
        calendar: report.calendar.clone(),
        blinds: report.blinds.clone(),
        is_complete,
    })
}
