//! Errors against N and time, sequences, and floors against the size of elements.

use super::Findings;
use super::claims::{Luminance, luminances, solved_cd_m2};
use super::compare::Column;
use super::curve::Currency;
use super::floor::{End, Floor};
use super::paper;
use super::setup::{Form, Points};
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Colour, Dash, PALETTE, Stroke};

const FLOOR: Stroke = Stroke { colour: [0x76; 3], width_px: 1.0, dash: Dash::Dashed };

/// Luminances of table 4: the paper's, and those by radiosity and the spectral method.
const PAPER: Stroke = Stroke { colour: PALETTE[6], width_px: 2.0, dash: Dash::Dotted };
const SOLVED: Stroke = Stroke { colour: PALETTE[6], width_px: 1.2, dash: Dash::Dashed };

/// The plot as an SVG file.
pub(super) fn svg(findings: &Findings) -> String {
    let panels = vec![
        by_n(findings),
        by_time(findings),
        by_points(findings),
        by_elements(findings),
        by_place(findings),
    ];
    figure(&Figure { title: "The diffuse cube".to_owned(), panels, columns: 2, legend: legend() })
        .to_svg()
}

fn by_n(findings: &Findings) -> Panel {
    let lines = Column::ALL.iter().zip(&findings.columns);
    let lines = lines.map(|(column, curve)| line(percent(curve.by_n()), stroke(*column)));
    let deep = Stroke { dash: Dash::Dotted, ..stroke(Column::Own) };
    let lines = lines.chain([line(percent(findings.deep.by_n()), deep)]).collect();
    panel("error by N", "photons, or paths a place (own)", Scale::Log(2), lines)
}

/// With the paper's seconds.
fn by_time(findings: &Findings) -> Panel {
    let own = Column::ALL
        .iter()
        .zip(&findings.columns)
        .map(|(column, curve)| line(percent(curve.by_cost(Currency::Seconds)), stroke(*column)));
    let of_paper = Column::OF_PAPER.iter().map(|column| {
        let point = |row: &paper::Row| [row.seconds, row.errors_percent[*column as usize]];
        let points = paper::rows().iter().map(point).collect();
        line(points, of_paper(*column))
    });
    let lines = own.chain(of_paper).collect();
    panel("error by time, and the paper\u{2019}s of 2003", "s a replicate", Scale::Log(10), lines)
}

fn by_points(findings: &Findings) -> Panel {
    let curves = findings.columns.iter().chain(&findings.others);
    let curves = curves.filter(|curve| curve.setup.form != Form::Own);
    let lines = curves.map(|curve| {
        let dash =
            if matches!(curve.setup.form, Form::Map { .. }) { Dash::Solid } else { Dash::Dashed };
        let stroke = Stroke { colour: colour(curve.setup.points), width_px: 1.5, dash };
        line(percent(curve.by_n()), stroke)
    });
    panel("sequences (photons dashed, with paths solid)", "photons", Scale::Log(2), lines.collect())
}

/// With the paper's last errors as levels.
fn by_elements(findings: &Findings) -> Panel {
    let floors = &findings.floors;
    let own = |of: fn(&Floor) -> &End, column: Column| {
        let point = |floor: &Floor| [floor.element_m, 100.0 * of(floor).bias.norm()];
        line(floors.iter().map(point).collect(), stroke(column))
    };
    let ends = [floors.first(), floors.last()].map(|floor| floor.map_or(1.0, |f| f.element_m));
    let level = |column: Column| {
        let last = paper::rows().last().map_or(f64::NAN, |row| row.errors_percent[column as usize]);
        line(
            ends.map(|element_m| [element_m, last]).to_vec(),
            Stroke { colour: stroke(column).colour, ..FLOOR },
        )
    };
    let lines = vec![
        own(|floor| &floor.photons, Column::Quasi),
        own(|floor| &floor.map, Column::Quasi2),
        level(Column::Quasi),
        level(Column::Quasi2),
    ];
    panel(
        "floors (paper\u{2019}s last errors dashed)",
        "legs of the elements in m",
        Scale::Log(10),
        lines,
    )
}

/// The luminances of table 4 less those by collocation: the paper's, two solves made before, and
/// the interval of our own.
fn by_place(findings: &Findings) -> Panel {
    let solved = solved_cd_m2(&findings.truth);
    let own = luminances(&findings.deep, &findings.truth);
    let less = |of: &dyn Fn(usize) -> f64, stroke| {
        let point = |place: usize| [place as f64 + 1.0, of(place) - solved[place]];
        line((0..solved.len()).map(point).collect(), stroke)
    };
    // The sensor stands a little off the edge: what it finds is taken to be off by as much as its
    // own truth is.
    let end = |place: usize, sign: f64| {
        let Luminance { value_cd_m2, half_width_cd_m2, truth_cd_m2 } = own[place];
        value_cd_m2 - truth_cd_m2 + solved[place] + sign * half_width_cd_m2
    };
    let lines = vec![
        less(&|place| end(place, -1.0), stroke(Column::Own)),
        less(&|place| end(place, 1.0), stroke(Column::Own)),
        less(&|place| paper::SOLVED_CD_M2[place], SOLVED),
        less(&|place| paper::LUMINANCES_CD_M2[place], PAPER),
    ];
    let values = lines.iter().flat_map(|line| line.points.iter().map(|[_, y]| *y));
    Panel {
        title: "table 4 less collocation (own: both ends)".to_owned(),
        x: Axis::new("place A to F of table 4 as 1 to 6", Scale::Linear, [0.8, 6.2]).with_step(1.0),
        y: Axis::around("cd/m2", Scale::Linear, values),
        lines,
    }
}

fn panel(title: &str, x: &str, scale: Scale, lines: Vec<Line>) -> Panel {
    let values =
        |axis: usize| lines.iter().flat_map(move |line| line.points.iter().map(move |p| p[axis]));
    Panel {
        title: title.to_owned(),
        x: Axis::around(x, scale, values(0)),
        y: Axis::around("relative L2 error in %", Scale::Log(10), values(1)),
        lines,
    }
}

fn line(points: Vec<[f64; 2]>, stroke: Stroke) -> Line {
    Line { points, stroke }
}

fn percent(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.into_iter().map(|[x, share]| [x, 100.0 * share]).collect()
}

/// Lighter colours, other dashes.
fn of_paper(column: Column) -> Stroke {
    let colour = match column {
        Column::Pseudo | Column::Quasi => PALETTE[5],
        _ => PALETTE[4],
    };
    let dash = match column {
        Column::Pseudo | Column::Pseudo2 => Dash::Dotted,
        _ => Dash::DashDot,
    };
    Stroke { colour, width_px: 2.2, dash }
}

/// Colours are columns; random points are dashed.
fn stroke(column: Column) -> Stroke {
    let colour = PALETTE[match column {
        Column::Pseudo | Column::Quasi => 0,
        Column::Pseudo2 | Column::Quasi2 => 1,
        Column::Own => 2,
    }];
    let dash = match column {
        Column::Pseudo | Column::Pseudo2 => Dash::Dashed,
        Column::Quasi | Column::Quasi2 | Column::Own => Dash::Solid,
    };
    Stroke { colour, width_px: 2.0, dash }
}

fn colour(points: Points) -> Colour {
    let all = [Points::Independent].into_iter().chain(Points::SEQUENCES);
    let number = all.into_iter().position(|other| other == points).unwrap_or(0);
    [[0x76; 3], PALETTE[0], PALETTE[4], PALETTE[3], PALETTE[2], PALETTE[6]][number]
}

fn legend() -> Vec<Vec<LegendEntry>> {
    let entry =
        |text: &str, stroke: Stroke| LegendEntry { text: text.to_owned(), stroke: Some(stroke) };
    let columns = Column::ALL.map(|column| entry(column.name(), stroke(column)));
    let all = [Points::Independent].into_iter().chain(Points::SEQUENCES);
    let points = all.map(|points| entry(points.name(), Stroke::solid(colour(points), 1.5)));
    let points: Vec<LegendEntry> = points.collect();
    let deep =
        entry("own, one place of each class", Stroke { dash: Dash::Dotted, ..stroke(Column::Own) });
    let printed = Column::OF_PAPER
        .map(|column| entry(&format!("paper\u{2019}s {}", column.name()), of_paper(column)));
    let fourth = vec![deep, entry("table 4: paper", PAPER), entry("table 4: two solves", SOLVED)];
    let mut rows = vec![columns.into(), printed.into(), fourth];
    rows.extend(points.chunks(3).map(<[LegendEntry]>::to_vec));
    rows
}
