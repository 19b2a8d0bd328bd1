//! The terms of the Neumann series on the terminal: averages by bounces, one line a sensor.

use super::{Column, Style, lines};
use crate::{Figure, Report};
use quasilux_text::printable;

/// The averages of all listed terms, after an empty line; nothing where none are.
pub(super) fn terms(report: &Report, style: Style) -> String {
    let Some(first) = report.sensors.iter().find(|sensor| !sensor.terms.is_empty()) else {
        return String::new();
    };
    let header = |bounces: Option<u32>| match bounces {
        Some(0) => "direct".to_owned(),
        Some(1) => "1 bounce".to_owned(),
        Some(bounces) => format!("{bounces} bounces"),
        None => "rest".to_owned(),
    };
    let figures = |term: usize| {
        let figure = move |terms: &[crate::TermReport]| {
            terms.get(term).map_or_else(Figure::default, |term| term.average_lx)
        };
        report.sensors.iter().map(move |sensor| figure(&sensor.terms))
    };
    let names = report.sensors.iter().map(|sensor| printable(&sensor.name));
    let columns = first
        .terms
        .iter()
        .enumerate()
        .map(|(number, term)| Column::figures(&header(term.bounces), " lx", figures(number)));
    let columns = std::iter::once(Column::left("averages", names)).chain(columns).collect();
    format!("\n{}", lines(columns, style))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn averages_stand_by_bounces() {
        let text = terms(&example::with_terms(), Style::Plain);
        let lines: Vec<&str> = text.trim().lines().collect();
        assert_eq!(lines[0], "averages   direct           rest", "{text}");
        assert_eq!(lines[1], "desk       140.0 ± 0.5 lx   60.0 ± 0.5 lx", "{text}");
        assert_eq!(terms(&example::office(), Style::Plain), "");
    }
}
