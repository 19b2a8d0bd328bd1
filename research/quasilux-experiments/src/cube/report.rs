//! All figures for programs, and what they say for people.

use super::Findings;
use super::claims::{Luminance, luminances, solved_cd_m2};
use super::compare::{Column, Duel, Round, Row};
use super::curve::{Curve, Look, root_mean_square};
use super::floor::{End, Floor};
use super::paper;
use super::scene::CLASSES;
use super::setup::Setup;
use super::{table_5, tables};
use crate::claim::Claim;
use quasilux_report::number::exact;
use std::fmt::Write;

const COLUMNS: &str = "quantity,unit,column,form,points,randomization,element_m,place,replicates,\
    n,paths_per_place,rays_per_replicate,seconds_per_replicate,value,half_width,truth,paper";

/// A measured thing; what does not belong to it stays empty.
#[derive(Default)]
struct Line {
    quantity: &'static str,
    unit: &'static str,
    column: String,
    setup: [String; 4],
    place: String,
    n: Option<u64>,
    paths: Option<u64>,
    rays: Option<f64>,
    seconds: Option<f64>,
    value: f64,
    half_width: Option<f64>,
    truth: Option<f64>,
    paper: Option<f64>,
    /// Of one run.
    is_single: bool,
}

/// One line a measured thing.
pub(super) fn csv(findings: &Findings) -> String {
    let mut lines = Vec::new();
    for (column, curve) in Column::ALL.iter().zip(&findings.columns) {
        lines.extend(of_curve(column.name(), curve));
    }
    lines.extend(findings.others.iter().flat_map(|curve| of_curve("", curve)));
    for (column, curve) in ["quasi once", "quasi2 once"].into_iter().zip(&findings.plain) {
        lines.extend(of_single_run(column, curve));
    }
    lines.extend(of_curve("own at one place of each class", &findings.deep));
    lines.extend(at_equal_time(findings));
    for duel in table_5::duels(&findings.table) {
        lines.extend(of_duel(&duel));
    }
    lines.extend(findings.floors.iter().flat_map(of_floor));
    lines.extend(of_places(findings));
    let mut text = format!("{COLUMNS}\n");
    for line in &lines {
        writeln!(text, "{}", line.text(findings.replicates)).expect("strings grow");
    }
    text
}

impl Line {
    fn text(&self, replicates: u32) -> String {
        let number = |value: Option<f64>| value.map(exact).unwrap_or_default();
        let count = |value: Option<u64>| value.map(|n| n.to_string()).unwrap_or_default();
        let texts = [
            self.quantity.to_owned(),
            self.unit.to_owned(),
            self.column.clone(),
            self.setup.join(","),
            self.place.clone(),
            if self.is_single { 1 } else { replicates }.to_string(),
            count(self.n),
            count(self.paths),
            number(self.rays),
            number(self.seconds),
            exact(self.value),
            number(self.half_width),
            number(self.truth),
            number(self.paper),
        ];
        texts.join(",")
    }
}

/// Form, points, randomization and size of elements.
fn fields(setup: Setup) -> [String; 4] {
    let element_m = setup.form.element_m().map(exact).unwrap_or_default();
    let points = setup.points;
    let names = [setup.form.name(), points.name(), points.randomization().name()];
    let [form, points, randomization] = names.map(str::to_owned);
    [form, points, randomization, element_m]
}

fn of_curve(column: &str, curve: &Curve) -> Vec<Line> {
    let own = |quantity, unit, value| Line {
        quantity,
        unit,
        column: column.to_owned(),
        setup: fields(curve.setup),
        value,
        ..Line::default()
    };
    let look = |look: &Look| Line {
        n: Some(look.n),
        paths: Some(look.paths),
        rays: Some(look.cost.rays),
        seconds: Some(look.cost.seconds),
        ..own("relative error", "%", 100.0 * look.rms())
    };
    let spread = |look: &Look| Line {
        n: Some(look.n),
        paths: Some(look.paths),
        ..own("relative spread", "%", 100.0 * root_mean_square(&look.spreads))
    };
    let slope =
        |quantity, of_look| curve.slope(u64::MAX, of_look).map(|slope| own(quantity, "1", slope));
    let slopes =
        [slope("slope", |look| &look.errors), slope("slope of spread", |look| &look.spreads)];
    let spreads = curve.looks.iter().map(spread);
    curve.looks.iter().map(look).chain(spreads).chain(slopes.into_iter().flatten()).collect()
}

/// Of a curve of one run: its errors alone.
fn of_single_run(column: &'static str, curve: &Curve) -> Vec<Line> {
    let lines = of_curve(column, curve).into_iter();
    let errors = lines.filter(|line| line.quantity == "relative error");
    errors.map(|line| Line { is_single: true, ..line }).collect()
}

/// Of what curves have at costs that double, and where pseudo errs as in the paper.
fn at_equal_time(findings: &Findings) -> Vec<Line> {
    let line = |quantity: &'static str, column: Column, row: &Row| {
        Some(Line {
            quantity,
            unit: "%",
            column: column.name().to_owned(),
            seconds: Some(row.cost),
            value: 100.0 * row.rms(column)?,
            ..Line::default()
        })
    };
    let mut lines = Vec::new();
    for row in &findings.table.rows {
        let of = |column: &Column| line("relative error at equal time", *column, row);
        lines.extend(Column::ALL.iter().filter_map(of));
    }
    for table_5::Aligned { printed, own } in table_5::rows(findings) {
        for column in Column::OF_PAPER {
            let paper = printed.errors_percent[column as usize];
            lines.push(Line {
                quantity: "relative error in the paper",
                unit: "%",
                column: column.name().to_owned(),
                seconds: Some(printed.seconds),
                value: paper,
                is_single: true,
                ..Line::default()
            });
            let own = own.as_ref().and_then(|row| {
                line("relative error where pseudo errs as in the paper", column, row)
            });
            lines.extend(own.map(|own| Line { paper: Some(paper), ..own }));
        }
    }
    lines
}

fn of_duel(duel: &Duel) -> Vec<Line> {
    let column = format!("{} over {}", duel.worse.name(), duel.better.name());
    let line = |round: &Round| {
        let own = |quantity, value| Line {
            quantity,
            unit: "1",
            column: column.clone(),
            seconds: Some(round.cost),
            value,
            ..Line::default()
        };
        [
            own("ratio of errors at equal time", round.ratio),
            own("ratio of what is compared", round.compared.ratio),
            own("t of what is compared", round.compared.t()),
        ]
    };
    duel.rounds.iter().flat_map(line).collect()
}

fn of_floor(floor: &Floor) -> Vec<Line> {
    let lines = |(column, end): (Column, &End)| {
        let own = |quantity, value, half_width| Line {
            quantity,
            unit: "%",
            column: column.name().to_owned(),
            setup: [String::new(), String::new(), String::new(), exact(floor.element_m)],
            n: Some(end.n),
            value,
            half_width,
            ..Line::default()
        };
        let error = 100.0 * end.bias.error_of_norm();
        [
            own("error over a floor", 100.0 * end.rms, None),
            own("floor and its standard error", 100.0 * end.bias.norm(), Some(error)),
        ]
    };
    [(Column::Quasi, &floor.photons), (Column::Quasi2, &floor.map)]
        .into_iter()
        .flat_map(lines)
        .collect()
}

fn of_places(findings: &Findings) -> Vec<Line> {
    let solved = solved_cd_m2(&findings.truth);
    let measured = luminances(&findings.deep, &findings.truth);
    let line = |(class, own): (usize, Luminance)| {
        let [x, y] = CLASSES[class];
        let line = |quantity, value, half_width, truth| Line {
            quantity,
            unit: "cd/m2",
            place: format!("{x} {y}"),
            value,
            half_width,
            truth: Some(truth),
            paper: Some(paper::LUMINANCES_CD_M2[class]),
            ..Line::default()
        };
        [
            line("luminance", own.value_cd_m2, Some(own.half_width_cd_m2), own.truth_cd_m2),
            line("luminance by collocation", solved[class], None, paper::SOLVED_CD_M2[class]),
        ]
    };
    measured.into_iter().enumerate().flat_map(line).collect()
}

/// The tables, and what is claimed.
pub(super) fn markdown(findings: &Findings, claims: &[Claim]) -> String {
    let mut text = tables::heading(findings);
    text.push_str(&tables::table_4(findings));
    text.push_str(&table_5::markdown(findings));
    text.push_str(&tables::convergence(findings));
    text.push_str(&tables::floors(findings));
    text.push_str(&Claim::markdown(claims));
    text
}
