//! Years on disk: parts of them, going on, putting together.

use super::year::Year;
use crate::arguments::{MergeArguments, ResumeArguments};
use crate::commands::count;
use crate::exit::{CliError, Exit};
use crate::print::tell;
use crate::year_file::{YearBlock, YearHeading, YearReader, YearWriter};
use crate::{interrupt, project, results};
use std::io;
use std::ops::Range;
use std::path::Path;

/// What was read of a year on disk.
struct Replayed {
    /// The number of the first point behind it.
    next: usize,
    /// What is wrong with what follows.
    damage: Option<CliError>,
}

/// Keeps a year while it goes, if it is to be kept and as long as that can be.
pub(super) struct Keeper<'a> {
    path: &'a Path,
    writer: Option<YearWriter>,
}

impl<'a> Keeper<'a> {
    pub(super) fn new(path: &'a Path, writer: YearWriter) -> Self {
        Self { path, writer: Some(writer) }
    }

    /// Adds points; where that cannot be, the year goes on without.
    pub(super) fn add(&mut self, block: &YearBlock) {
        let Some(writer) = &mut self.writer else { return };
        if let Err(error) = writer.add(block) {
            tell(format_args!("warning: {}", cannot_keep(self.path, &error)));
            self.writer = None;
        }
    }
}

/// Refuses where a year that begins would take the place of one that is not over, or of something
/// that nobody can tell; `project` is read.
pub(super) fn expect_nothing_to_lose(path: &Path, project: &Path) -> Result<(), CliError> {
    results::prepare_file(path, &[project])?;
    results::expect_text(project)?;
    if !path.exists() {
        return Ok(());
    }
    let remove = |error: CliError| error.with_advice("; remove it to begin a year there");
    let mut reader = YearReader::open(path).map_err(remove)?;
    let mut next = reader.heading.points.start;
    while let Ok(Some(block)) = reader.next() {
        next += block.points.len();
    }
    let YearHeading { run, points, .. } = &reader.heading;
    if next == points.end {
        return Ok(());
    }
    let (name, of) = (path.display(), run.project.display());
    let message = format!(
        "keeps a year of {of} that is not over: go on with `quasilux resume {name}`, or remove it \
         to begin anew"
    );
    Err(CliError::in_file(name, None, message))
}

pub(super) fn cannot_keep(path: &Path, error: &io::Error) -> CliError {
    CliError::in_file(path.display(), None, format!("cannot keep the year: {error}"))
}

/// Simulates a part of a year from a point on, and keeps it.
pub(super) fn simulate_part(
    year: &Year<'_>,
    part: &Range<usize>,
    next: usize,
    writer: &mut YearWriter,
    path: &Path,
    quiet: bool,
) -> Result<Exit, CliError> {
    let Range { start, end } = *part;
    let name = path.display();
    let is_complete = year.simulate(next..end, &mut |block| {
        writer.add(&block).map_err(|error| cannot_keep(path, &error))
    })?;
    if !is_complete {
        tell(format_args!("interrupted: go on with `quasilux resume {name}`"));
        return Ok(Exit::Interrupted);
    }
    if !quiet {
        tell(format_args!("points {start} to {} of {} in {name}", end - 1, year.points()));
    }
    Ok(Exit::Done)
}

/// Goes on with a year, and ends with the bits that it would have had.
pub(in crate::commands) fn resume_year(arguments: &ResumeArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let path = &arguments.checkpoint;
    let mut reader = YearReader::open(path)?;
    if arguments.time.is_some() {
        let message = "keeps a year, which --time cannot end";
        return Err(CliError::in_file(path.display(), None, message));
    }
    let heading = reader.heading.clone();
    let project = project::open(&heading.run.project_file(arguments)?)?;
    let year = year(&project, &reader, count(arguments.work.threads))?;
    let quiet = arguments.output.quiet;
    let go_on = |reader: YearReader, Replayed { next, damage }: Replayed| {
        if let (Some(damage), false) = (damage, quiet) {
            tell(format_args!("warning: {damage}; continuing at point {next}"));
        }
        let writer = reader.go_on().map_err(|error| cannot_keep(path, &error))?;
        Ok::<_, CliError>((next, writer))
    };
    if heading.points != (0..heading.of) {
        let replayed = replay(&year, &mut reader, &mut |_| Ok(()))?;
        let (next, mut writer) = go_on(reader, replayed)?;
        return simulate_part(&year, &heading.points, next, &mut writer, path, quiet);
    }
    let folder = arguments.output.out.as_deref().unwrap_or_else(|| heading.run.folder());
    year.deliver(folder, &arguments.output, |sink| {
        let replayed = replay(&year, &mut reader, &mut |block| sink.take_kept(&block))?;
        let (next, writer) = go_on(reader, replayed)?;
        let mut keeper = Keeper::new(path, writer);
        year.simulate(next..heading.of, &mut |block| {
            keeper.add(&block);
            sink.take(&block)
        })
    })
}

/// Puts the parts of a year together.
pub(in crate::commands) fn merge_years(arguments: &MergeArguments) -> Result<Exit, CliError> {
    interrupt::listen()?;
    let readers: Result<Vec<YearReader>, CliError> =
        arguments.parts.iter().map(|path| YearReader::open(path)).collect();
    let readers = in_order(readers?)?;
    let Some(first) = readers.first() else { return Err(CliError::new("no parts")) };
    let heading = first.heading.clone();
    let file = arguments.project.as_ref().unwrap_or(&heading.run.project);
    let project = project::open(file)?;
    let year = year(&project, first, count(arguments.work.threads))?;
    let folder = arguments.output.out.as_deref().unwrap_or_else(|| heading.run.folder());
    year.deliver(folder, &arguments.output, |sink| {
        for mut reader in readers {
            let replayed = replay(&year, &mut reader, &mut |block| sink.take_kept(&block))?;
            let (Range { end, .. }, Replayed { next, damage }) = (reader.heading.points, replayed);
            if let Some(damage) = damage {
                return Err(damage);
            }
            if next < end {
                let name = &reader.name;
                let message = format!(
                    "is not over, it ends before point {next} of {end}: go on with `quasilux \
                     resume {name}`"
                );
                return Err(CliError::in_file(name, None, message));
            }
        }
        Ok(true)
    })
}

/// The year of a project that one on disk is of.
fn year<'p>(
    project: &'p project::Project,
    reader: &YearReader,
    threads: usize,
) -> Result<Year<'p>, CliError> {
    let YearReader { name, heading, .. } = reader;
    let refuse = |message: String| Err(CliError::in_file(name, None, message));
    if let Some(change) = project.identity.difference(&heading.run.scene) {
        return refuse(format!("{} is another scene now: {change}", project.name));
    }
    let settings = project::kept_settings(&heading.run.settings, name, project)?;
    let year = Year::new(project, settings, heading.occupied_h.as_ref(), threads)?;
    if year.points() != heading.of {
        return refuse(format!(
            "is of {} points, {} has {}",
            heading.of,
            project.name,
            year.points()
        ));
    }
    Ok(year)
}

/// Reads all points that a year on disk has.
fn replay(
    year: &Year<'_>,
    reader: &mut YearReader,
    keep: &mut dyn FnMut(YearBlock) -> Result<(), CliError>,
) -> Result<Replayed, CliError> {
    let Range { start: mut next, end } = reader.heading.points;
    let damage = loop {
        match reader.next() {
            Ok(Some(block)) => {
                let mut numbered = (next..end).zip(&block.points);
                let fits = numbered.len() == block.points.len()
                    && numbered.all(|(number, point)| year.has_hours_of(number, point));
                if !fits {
                    let message = "its points are not those of the year";
                    return Err(CliError::in_file(&reader.name, None, message));
                }
                next += block.points.len();
                keep(block)?;
            }
            Ok(None) => break None,
            Err(damage) => break Some(damage),
        }
    };
    Ok(Replayed { next, damage })
}

/// Sorts parts by their points, and refuses what does not make a year: parts of other years, gaps
/// and overlaps.
fn in_order(mut readers: Vec<YearReader>) -> Result<Vec<YearReader>, CliError> {
    readers.sort_by_key(|reader| reader.heading.points.start);
    let mut next = 0;
    for pair in readers.windows(2) {
        let [a, b] = pair else { continue };
        if let Some(what) = a.heading.difference(&b.heading) {
            return Err(CliError::new(format!(
                "{} and {} belong to different years: {what} differs",
                a.name, b.name
            )));
        }
    }
    for reader in &readers {
        let Range { start, end } = reader.heading.points;
        if start != next {
            let what = if start > next { "are missing" } else { "come twice" };
            return Err(CliError::in_file(
                &reader.name,
                None,
                format!("begins at point {start}, expected {next}: points {what}"),
            ));
        }
        next = end;
    }
    match readers.last() {
        Some(last) if last.heading.of > next => Err(CliError::in_file(
            &last.name,
            None,
            format!("ends before point {next} of {}: points are missing", last.heading.of),
        )),
        _ => Ok(readers),
    }
}
