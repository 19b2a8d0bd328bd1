//! The table on the terminal: one line a sensor or camera, each figure with its interval.

mod certified;
mod convergence;
mod explanation;
mod flux;
mod statuses;
mod terms;
mod unseen;

pub use explanation::explanation;

use crate::number::{FigureText, brief, count, exact, figure_text, plural};
use crate::{CameraReport, Figure, Report, SensorReport, Summary};
use quasilux_text::printable;
use quasilux_transport::{Settings, ToleranceOn, UnseenTolerance};
use std::fmt::Write;
use unicode_width::UnicodeWidthStr;

/// Whether the table may use colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Style {
    /// Text alone, for files and terminals without colours.
    #[default]
    Plain,
    /// ANSI escape sequences for emphasis (ECMA-48, clause 8.3.117).
    Colour,
}

#[derive(Clone, Copy)]
enum Emphasis {
    Strong,
    Faint,
    Good,
    Caution,
}

/// Columns between two figures.
const GAP: &str = "   ";

/// Average, minimum, maximum and uniformity of each sensor, the luminances of each picture, how
/// they were made, and the warnings.
#[must_use]
pub fn table(report: &Report, style: Style) -> String {
    let mut text = sensors(report, style);
    text += &terms::terms(report, style);
    if !report.cameras.is_empty() {
        let gap = if text.is_empty() { "" } else { "\n" };
        text = format!("{text}{gap}{}", cameras(report, style));
    }
    let faint = style.paint(Emphasis::Faint, &format!("{}; ", run_facts(report)));
    let verdict = Verdict::new(report);
    let verdict = style.paint(verdict.emphasis, &verdict.text);
    writeln!(text, "\n{faint}{verdict}").expect("strings grow");
    if let Some(line) = unseen::line(report) {
        writeln!(text, "{}", style.paint(Emphasis::Faint, &line)).expect("strings grow");
    }
    if let Some(line) = unseen::cannot_see(report) {
        writeln!(text, "{}", style.paint(Emphasis::Caution, &line)).expect("strings grow");
    }
    if let Some(line) = convergence::convergence(report) {
        writeln!(text, "{}", style.paint(Emphasis::Faint, &line)).expect("strings grow");
    }
    if let Some(line) = flux::flux(&report.run) {
        writeln!(text, "{}", style.paint(Emphasis::Faint, &line)).expect("strings grow");
    }
    if let Some(outside) = &report.outside {
        let lx = brief(outside.horizontal_illuminance_lx, 4);
        let line = format!("outside: {lx} lx on a horizontal plane");
        writeln!(text, "{}", style.paint(Emphasis::Faint, &line)).expect("strings grow");
    }
    for warning in &report.warnings {
        let mark = style.paint(Emphasis::Caution, "warning:");
        writeln!(text, "{mark} {}", printable(warning)).expect("strings grow");
    }
    text
}

/// One line a sensor; nothing without sensors.
fn sensors(report: &Report, style: Style) -> String {
    let cells = |cell: fn(&SensorReport) -> String| report.sensors.iter().map(cell);
    let figures = |figure: fn(&Summary) -> Figure| {
        report.sensors.iter().map(move |sensor| figure(&sensor.summary))
    };
    // One point is as bright as itself, which says nothing.
    let uniformity = |sensor: &SensorReport| match sensor.points.len() {
        1 => Figure::default(),
        _ => sensor.summary.uniformity,
    };
    let factor = |sensor: &SensorReport| {
        let outside = report.outside?;
        let share = outside.daylight_factor(sensor.summary.average_lx, None)?.total;
        let percent = |share: Option<f64>| share.map(|share| 100.0 * share);
        Some(Figure { value: percent(share.value), half_width: percent(share.half_width) })
    };
    let factors: Vec<Figure> = report.sensors.iter().filter_map(factor).collect();
    let mut columns = vec![
        Column::left("sensor", cells(|s| printable(&s.name))),
        Column::left("points", cells(points)),
        Column::figures("average", " lx", figures(|s| s.average_lx)),
        Column::figures("minimum", " lx", figures(|s| s.minimum_lx)),
        Column::figures("maximum", " lx", figures(|s| s.maximum_lx)),
        Column::figures("uniformity", "", report.sensors.iter().map(uniformity)),
    ];
    if let Some(cells) = unseen::column(report) {
        columns.insert(3, Column::left("unseen", cells));
    }
    if let Some(cells) = certified::column(report) {
        columns.insert(columns.len().min(4), Column::left("certified", cells));
    }
    if !factors.is_empty() {
        columns.push(Column::figures("daylight factor", " %", factors.into_iter()));
    }
    lines(columns, style)
}

/// One line a camera.
fn cameras(report: &Report, style: Style) -> String {
    let cells = |cell: fn(&CameraReport) -> String| report.cameras.iter().map(cell);
    let cd_m2 = |value: Option<f64>, before: &str, digits| {
        value.map_or_else(|| "-".into(), |x| format!("{before}{} cd/m²", brief(x, digits)))
    };
    let maxima = report.cameras.iter().map(|c| cd_m2(c.maximum_cd_m2, "", 4));
    let half_widths = report.cameras.iter().map(|c| {
        let share = c.relative_half_width.map(|share| format!(" ({} %)", brief(100.0 * share, 2)));
        cd_m2(c.mean_half_width_cd_m2, "± ", 2) + &share.unwrap_or_default()
    });
    lines(
        vec![
            Column::left("camera", cells(|c| printable(&c.name))),
            Column::left("pixels", cells(|c| format!("{} x {}", c.resolution[0], c.resolution[1]))),
            Column::left("samples", cells(|c| count(c.samples))),
            Column::figures("mean", " cd/m²", report.cameras.iter().map(|c| c.mean_cd_m2)),
            Column::left("maximum", maxima),
            Column::left("one pixel", half_widths),
        ],
        style,
    )
}

/// Columns as lines of text, the first one emphasised; nothing where there is only that one.
fn lines(mut columns: Vec<Column>, style: Style) -> String {
    columns.iter_mut().for_each(Column::align);
    let rows = columns[0].cells.len();
    let mut text = String::new();
    for row in (0..rows).take_while(|_| rows > 1) {
        let cells: Vec<&str> = columns.iter().map(|c| c.cells[row].as_str()).collect();
        let line = cells.join(GAP).trim_end().to_owned();
        text += &if row == 0 { style.paint(Emphasis::Strong, &line) } else { line };
        text.push('\n');
    }
    text
}

impl Style {
    fn paint(self, emphasis: Emphasis, text: &str) -> String {
        let code = match emphasis {
            Emphasis::Strong => "1",
            Emphasis::Faint => "2",
            Emphasis::Good => "32",
            Emphasis::Caution => "33",
        };
        match self {
            Self::Plain => text.to_owned(),
            Self::Colour => format!("\x1b[{code}m{text}\x1b[0m"),
        }
    }
}

/// The cells of one column, its header first.
struct Column {
    cells: Vec<String>,
}

impl Column {
    fn left(header: &str, cells: impl Iterator<Item = String>) -> Self {
        Self { cells: std::iter::once(header.to_owned()).chain(cells).collect() }
    }

    /// A column of figures, their plus-minus signs one below the other.
    fn figures(header: &str, unit: &str, figures: impl Iterator<Item = Figure>) -> Self {
        let texts: Vec<FigureText> = figures.map(figure_text).collect();
        let value_width = texts.iter().map(|t| t.value.width()).max().unwrap_or(0);
        let half_width_width =
            texts.iter().flat_map(|t| &t.half_width).map(|h| h.width()).max().unwrap_or(0);
        let cells = texts.iter().map(|t| {
            let half_width = t.half_width.as_ref().map_or_else(
                || " ".repeat(if half_width_width > 0 { 3 + half_width_width } else { 0 }),
                |h| format!(" ± {h:<half_width_width$}"),
            );
            format!("{:>value_width$}{half_width}{unit}", t.value)
        });
        Self { cells: std::iter::once(header.to_owned()).chain(cells).collect() }
    }

    /// Pads all cells on the right to the width of the widest.
    fn align(&mut self) {
        let widest = self.cells.iter().map(|c| c.width()).max().unwrap_or(0);
        for cell in &mut self.cells {
            let padding = widest - cell.width();
            cell.extend(std::iter::repeat_n(' ', padding));
        }
    }
}

fn points(sensor: &SensorReport) -> String {
    match &sensor.grid {
        Some(grid) => format!("{} x {}", grid.counts[0], grid.counts[1]),
        None => sensor.points.len().to_string(),
    }
}

fn run_facts(report: &Report) -> String {
    let run = &report.run;
    let replicates = u64::from(run.replicates);
    let least = report.sensors.iter().flat_map(|s| &s.points).map(|point| point.samples).min();
    let from = least.filter(|least| *least < run.samples);
    let earlier = Some(run.earlier_seconds).filter(|seconds| *seconds > 0.0);
    let maintained = Some(run.maintenance_factor).filter(|factor| *factor != 1.0);
    let seconds_of = |seconds: f64| format!(" ({} s before it was resumed)", brief(seconds, 3));
    let factor_of = |factor: f64| format!(", maintenance factor {}", exact(factor));
    format!(
        "{} % confidence, {} of {}{}, {}, {} s{} on {}{}",
        brief(100.0 * run.settings.confidence, 4),
        plural(replicates, "replicate"),
        from.map(|least| format!("{} to ", count(least))).unwrap_or_default(),
        match report.sensors.is_empty() && !report.cameras.is_empty() {
            true => format!("{} per pixel", plural(run.samples, "path")),
            false => plural(run.samples, "sample"),
        },
        plural(run.rays, "ray"),
        brief(run.seconds, 3),
        earlier.map(seconds_of).unwrap_or_default(),
        plural(run.threads as u64, "thread"),
        maintained.map(factor_of).unwrap_or_default(),
    )
}

/// The wanted tolerance in words, with that of bounds where there are any.
fn tolerance(settings: &Settings, is_bounded: bool) -> String {
    let relative = format!("{} %", brief(100.0 * settings.rel_tol, 4));
    let absolute = format!("{} lx", brief(settings.abs_tol_lx, 4));
    let half_width = match (settings.rel_tol > 0.0, settings.abs_tol_lx > 0.0) {
        (true, true) => format!("{relative} or {absolute}"),
        (false, true) => absolute,
        _ => relative,
    };
    match settings.unseen_tol {
        UnseenTolerance::Share(share) if is_bounded => {
            let share = share.max(settings.rel_tol);
            format!("{half_width} and {} % unseen", brief(100.0 * share, 4))
        }
        _ => half_width,
    }
}

/// Whether the run reached its tolerance, in words.
struct Verdict {
    emphasis: Emphasis,
    text: String,
}

impl Verdict {
    fn new(report: &Report) -> Self {
        let of_sensors = Self::of_sensors(report);
        match (report.sensors.is_empty(), report.cameras.is_empty()) {
            (_, true) => of_sensors,
            (true, false) => Self::of_pictures(report),
            (false, false) => {
                let of_pictures = Self::of_pictures(report);
                let emphasis = match of_pictures.emphasis {
                    Emphasis::Caution => Emphasis::Caution,
                    _ => of_sensors.emphasis,
                };
                Self { emphasis, text: format!("{}; {}", of_sensors.text, of_pictures.text) }
            }
        }
    }

    fn of_sensors(report: &Report) -> Self {
        let settings = &report.run.settings;
        let wanted = tolerance(settings, unseen::is_bounded(report));
        let at = match settings.tolerance_on {
            ToleranceOn::Points => "at every point",
            ToleranceOn::Summary => "for every sensor average",
        };
        if !settings.has_tolerance() {
            Self { emphasis: Emphasis::Faint, text: "no tolerance was asked for".into() }
        } else if report.run.sensors_reached {
            let text = format!("tolerance of {wanted} reached {at}");
            Self { emphasis: Emphasis::Good, text }
        } else {
            let missing = statuses::missing(report);
            let because = if missing.is_empty() { "" } else { ": " };
            let text = format!("tolerance of {wanted} not reached{because}{missing}");
            Self { emphasis: Emphasis::Caution, text }
        }
    }

    fn of_pictures(report: &Report) -> Self {
        let undone = report.cameras.iter().filter(|camera| !camera.is_done).count();
        if undone > 0 {
            let all = plural(report.cameras.len() as u64, "picture");
            let text = format!("{undone} of {all} stopped early");
            return Self { emphasis: Emphasis::Caution, text };
        }
        let widest = report.cameras.iter().filter_map(|camera| camera.rel_tol).reduce(f64::max);
        let text = match widest {
            Some(share) => {
                format!("pictures known to {} %", brief(100.0 * share, 4))
            }
            None => "all passes complete".into(),
        };
        Self { emphasis: Emphasis::Good, text }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    /// Terminal columns at which `needle` begins in a line.
    fn positions(line: &str, needle: &str) -> Vec<usize> {
        line.match_indices(needle).map(|(at, _)| line[..at].width()).collect()
    }

    #[test]
    fn columns_align_for_any_name() {
        let mut report = example::office();
        for name in
            ["x", "a very long name of a sensor that goes on", "работа", "机の上", "u\u{308}"]
        {
            report.sensors[1].name = name.into();
            let text = table(&report, Style::Plain);
            let lines: Vec<&str> = text.lines().collect();
            let first = positions(lines[1], "±");
            assert_eq!(first.len(), 4, "{text}");
            // The uniformity of one point is none.
            assert_eq!(first[..3], positions(lines[2], "±"), "{text}");
            assert!(lines[2].ends_with(" -"), "{text}");
            assert_eq!(positions(lines[1], "lx"), positions(lines[2], "lx"), "{text}");
            assert!(lines.iter().all(|l| l.trim_end() == *l));
        }
    }

    #[test]
    fn colours_add_escape_sequences_and_nothing_else() {
        let report = example::office();
        let mut coloured = table(&report, Style::Colour);
        assert!(coloured.contains('\x1b'));
        for code in ["0", "1", "2", "32", "33"] {
            coloured = coloured.replace(&format!("\x1b[{code}m"), "");
        }
        assert_eq!(coloured, table(&report, Style::Plain));
    }

    #[test]
    fn names_cannot_steer_the_terminal() {
        let mut report = example::noiseless(&[1.0]);
        report.sensors[0].name = "\x1b[2J\n".into();
        assert!(!table(&report, Style::Plain).contains('\x1b'));
    }

    #[test]
    fn says_how_the_figures_were_made() {
        let mut report = example::office();
        let last = "95 % confidence, 16 replicates of 65 536 samples, 187 654 321 rays, \
                    9.81 s on 2 threads; tolerance of 1 % reached at every point";
        assert!(table(&report, Style::Plain).contains(last));
        assert!(table(&report, Style::Plain).ends_with("warning: a \"quoted\" warning\n"));
        assert!(table(&report, Style::Plain).contains("error ~ N^-0.72\n"));
        report.run.earlier_seconds = 7.5;
        report.run.maintenance_factor = 0.8;
        let told = "9.81 s (7.5 s before it was resumed) on 2 threads, maintenance factor 0.8; ";
        assert!(table(&report, Style::Plain).contains(told));
        report.sensors[0].points[7].samples = 1024;
        assert!(table(&report, Style::Plain).contains("of 1 024 to 65 536 samples"));
        report.run.settings.tolerance_on = ToleranceOn::Summary;
        assert!(table(&report, Style::Plain).contains("1 % reached for every sensor average"));
        report.run.sensors_reached = false;
        assert!(table(&report, Style::Plain).contains("1 % not reached"));
        report.run.settings.abs_tol_lx = 2.5;
        assert!(table(&report, Style::Plain).contains("1 % or 2.5 lx not reached"));
        (report.run.settings.rel_tol, report.run.settings.abs_tol_lx) = (0.0, 0.0);
        assert!(table(&report, Style::Plain).contains("no tolerance was asked for"));
    }

    #[test]
    fn cameras_have_lines_of_their_own() {
        let mut report = example::picture([40, 30], |_, _| 8.0);
        let text = table(&report, Style::Plain);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].starts_with("camera   pixels    samples   mean"), "{text}");
        let wanted = "view     40 x 30   16        8.000 ± 0 cd/m²   8 cd/m²   ± 0.5 cd/m² (6.2 %)";
        assert_eq!(lines[1], wanted, "{text}");
        assert!(text.contains("all passes complete"), "{text}");
        assert!(text.contains("16 replicates of 16 paths per pixel"), "{text}");
        for word in ["sensor", "point", "sample,"] {
            assert!(!text.contains(word), "{word} in {text}");
        }
        report.cameras[0].rel_tol = Some(0.0725);
        let text = table(&report, Style::Plain);
        assert!(text.contains("pictures known to 7.25 %"), "{text}");
        report.cameras[0].is_done = false;
        let text = table(&report, Style::Plain);
        assert!(text.contains("1 of 1 picture stopped early"), "{text}");
        report.sensors = example::office().sensors;
        let text = table(&report, Style::Plain);
        assert!(text.contains("\n\ncamera") && text.starts_with("sensor"), "{text}");
    }

    #[test]
    fn a_sensor_without_intervals_has_values_alone() {
        let text = table(&example::without_intervals(), Style::Plain);
        assert!(text.contains("100.0 lx") && !text.contains('±'), "{text}");
    }
}
