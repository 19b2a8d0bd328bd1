//! `quasilux points NAME`: points of a sequence as numbers or as a drawing; `--compare`: all
//! sequences side by side.

mod compare;
mod comparison_plot;
mod comparison_table;
mod curve;
mod setup;

use crate::arguments::PointsArguments;
use crate::exit::{CliError, Exit};
use crate::print::{print, to_stdout};
use crate::{names, results};
use quasilux_drawing::diagram::{Scatter, scatter};
use quasilux_report::number::exact;
use quasilux_sampling::quality::{CellCounts, PointsView, cell_counts, star_discrepancy};
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use std::io::{self, Write};

/// More points than this are a blue surface.
const MAX_DRAWN: u64 = 1 << 16;
/// Up to this many points the drawing tells the star discrepancy: it takes N^2 steps.
const MAX_MEASURED: usize = 1 << 12;

/// Lists, draws or compares points.
pub(crate) fn points(arguments: &PointsArguments) -> Result<Exit, CliError> {
    for path in [&arguments.svg, &arguments.csv].into_iter().flatten() {
        results::prepare_file(path, &[])?;
    }
    match &arguments.name {
        Some(name) if !arguments.compare => list_or_draw(name, arguments)?,
        _ => compare::compare(arguments)?,
    }
    Ok(Exit::Done)
}

fn list_or_draw(name: &str, arguments: &PointsArguments) -> Result<(), CliError> {
    let all = Sequence::all_for(arguments.n);
    let sequence = names::on_command_line("sequence", name, &all, Sequence::name)?;
    let (name, all) = (&arguments.randomization, Randomization::ALL);
    let randomization = names::on_command_line("--randomization", name, &all, Randomization::name)?;
    let points = PointSet::new(sequence, randomization, stream_key(arguments.seed, 0, 0));
    if let Some(path) = &arguments.svg {
        let (drawing, facts) = drawing(&points, arguments)?;
        results::write_atomic(path, drawing.as_bytes())?;
        print(&format!("{}: {facts}\n", path.display()))?;
    }
    match &arguments.csv {
        Some(path) => results::stream_atomic(path, |file| write_csv(&points, arguments, file)),
        None if arguments.svg.is_none() => to_stdout(|out| write_csv(&points, arguments, out)),
        None => Ok(()),
    }
}

fn write_csv(
    points: &PointSet,
    arguments: &PointsArguments,
    out: &mut dyn Write,
) -> io::Result<()> {
    let columns: Vec<String> = arguments.dims.iter().map(|j| format!("u{j}")).collect();
    writeln!(out, "index,{}", columns.join(","))?;
    for index in 0..arguments.n {
        write!(out, "{index}")?;
        for dimension in &arguments.dims {
            write!(out, ",{}", exact(points.coordinate(index, *dimension)))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// The drawing of two dimensions, and what it shows in words.
fn drawing(points: &PointSet, arguments: &PointsArguments) -> Result<(String, String), CliError> {
    let &[first, second] = arguments.dims.as_slice() else {
        let given = arguments.dims.len();
        return Err(CliError::new(format!("--svg draws two dimensions, and --dims names {given}")));
    };
    if arguments.n > MAX_DRAWN {
        return Err(CliError::new(format!(
            "--svg draws at most {MAX_DRAWN} points, and -n asks for {}",
            arguments.n
        )));
    }
    let coordinates: Vec<[f64; 2]> = (0..arguments.n)
        .map(|index| [first, second].map(|dimension| points.coordinate(index, dimension)))
        .collect();
    let view = PointsView::new(coordinates.as_flattened(), 2).expect("points of the unit square");
    let facts = facts(view, arguments.cells as usize);
    let randomised = match points.randomization() {
        Randomization::None if points.sequence() != Sequence::Independent => String::new(),
        Randomization::None => format!(", seed {}", arguments.seed),
        kind => format!(", {}, seed {}", kind.name(), arguments.seed),
    };
    let labels = [first, second].map(|dimension| format!("dimension {dimension}"));
    let drawing = scatter(&Scatter {
        title: &format!("{}{randomised}: {}", points.sequence().name(), many(arguments.n, "point")),
        subtitle: &facts,
        labels: [&labels[0], &labels[1]],
        points: &coordinates,
        cells: arguments.cells,
    })
    .to_svg();
    Ok((drawing, facts))
}

fn facts(points: PointsView<'_>, cells: usize) -> String {
    let star = (points.count() <= MAX_MEASURED)
        .then(|| star_discrepancy(points))
        .flatten()
        .map(|star| format!("star discrepancy {star:.4}"));
    let counts = (cells > 1).then(|| in_words(&cell_counts(points, [0, 1], cells)));
    counts.into_iter().chain(star).collect::<Vec<_>>().join("; ")
}

fn in_words(cells: &CellCounts) -> String {
    let side = cells.per_side;
    match (cells.empty(), cells.least(), cells.most()) {
        (_, least, most) if least == most => {
            format!("{} in each of {side} x {side} cells", many(least, "point"))
        }
        (0, least, most) => format!("{least} to {most} points in each of {side} x {side} cells"),
        (empty, _, most) => {
            format!(
                "{empty} of the {side} x {side} cells empty, up to {} in one",
                many(most, "point")
            )
        }
    }
}

fn many(count: u64, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
