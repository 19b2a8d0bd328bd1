//! Light that no sample met, on the terminal.

use crate::number::brief;
use crate::{Report, SensorReport};
use quasilux_text::printable;

/// What a figure may lack.
enum Lack {
    /// Nothing is known.
    Unknown,
    /// At most this share of its value.
    Share(f64),
    /// At most this, beside a value of nothing.
    Lux(f64),
}

impl Lack {
    fn new(bound_lx: Option<f64>, value_lx: Option<f64>) -> Self {
        match (bound_lx, value_lx) {
            (Some(bound_lx), Some(value_lx)) if value_lx > 0.0 => Self::Share(bound_lx / value_lx),
            (Some(bound_lx), _) => Self::Lux(bound_lx),
            (None, _) => Self::Unknown,
        }
    }

    /// The largest of each kind, in words.
    fn all_in_words(lacks: impl Iterator<Item = Self>) -> String {
        let (mut share, mut lux, mut is_unknown) = (None::<f64>, None::<f64>, false);
        for lack in lacks {
            let (most, own) = match lack {
                Self::Share(own) => (&mut share, own),
                Self::Lux(own) => (&mut lux, own),
                Self::Unknown => {
                    is_unknown = true;
                    continue;
                }
            };
            *most = Some(most.map_or(own, |most| most.max(own)));
        }
        let share = share.map(|share| format!("at most {} %", brief(100.0 * share, 2)));
        let lux = lux.map(|lux| format!("at most {} lx where none was found", brief(lux, 2)));
        let unknown = is_unknown.then(|| "unknown".to_owned());
        [share, lux, unknown].into_iter().flatten().collect::<Vec<String>>().join(" or ")
    }
}

/// The column of a sensor's average; `None` where no sensor has a bound.
pub(super) fn column(report: &Report) -> Option<impl Iterator<Item = String>> {
    let cell = |sensor: &SensorReport| match &sensor.summary.unseen {
        None => "-".to_owned(),
        Some(unseen) => match unseen.average_lx {
            None => "unknown".to_owned(),
            Some(bound_lx) => format!("≤ {} lx", brief(bound_lx, 2)),
        },
    };
    is_bounded(report).then(|| report.sensors.iter().map(cell))
}

/// What all averages and points may lack, in one line.
pub(super) fn line(report: &Report) -> Option<String> {
    let bounded = || report.sensors.iter().filter(|sensor| sensor.summary.unseen.is_some());
    bounded().next()?;
    let averages = bounded().map(|sensor| {
        let bound_lx = sensor.summary.unseen.and_then(|unseen| unseen.average_lx);
        Lack::new(bound_lx, sensor.summary.average_lx.value)
    });
    let points = bounded().flat_map(|sensor| &sensor.points);
    let points = points.map(|point| Lack::new(point.unseen.bound_lx, point.illuminance_lx.value));
    let confidence = brief(100.0 * quasilux_transport::unseen::UNSEEN_CONFIDENCE, 4);
    Some(format!(
        "light that no sample met ({confidence} %): in averages {}; at points {}",
        Lack::all_in_words(averages),
        Lack::all_in_words(points)
    ))
}

/// The classes of light paths that the estimator cannot make, in one line.
pub(super) fn cannot_see(report: &Report) -> Option<String> {
    let classes: Vec<String> = report.run.cannot_see.iter().map(|it| printable(it)).collect();
    (!classes.is_empty()).then(|| format!("cannot see: {}", classes.join("; ")))
}

/// Whether any sensor has bounds.
pub(super) fn is_bounded(report: &Report) -> bool {
    report.sensors.iter().any(|sensor| sensor.summary.unseen.is_some())
}

#[cfg(test)]
mod tests {
    use super::super::{Style, table};
    use super::*;
    use crate::example;

    #[test]
    fn bounds_stand_beside_averages_and_in_words() {
        let report = example::with_unseen();
        let text = table(&report, Style::Plain);
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].contains("average        unseen     minimum"), "{text}");
        assert!(lines[1].contains("200.0 ± 0 lx   ≤ 0.4 lx   0 ± 0 lx"), "{text}");
        assert!(text.contains(
            "\nlight that no sample met (95 %): in averages at most 0.2 %; at points at most 4 % \
             or \
             at most 0.02 lx where none was found\n"
        ));
        assert!(text.contains("tolerance of 1 % and 5 % unseen reached at every point"), "{text}");
        assert!(text.contains("\ncannot see: lamp, glass body, point; sun, mirror, point\n"));
    }

    #[test]
    fn without_bounds_nothing_is_said() {
        let report = example::office();
        assert_eq!(line(&report), None);
        assert_eq!(cannot_see(&report), None);
        assert!(!table(&report, Style::Plain).contains("unseen"));
    }

    #[test]
    fn unknown_bounds_are_told() {
        let mut report = example::with_unseen();
        report.sensors[0].summary.unseen = Some(crate::SummaryUnseen::default());
        let text = line(&report).unwrap();
        assert!(text.contains(": in averages unknown; "), "{text}");
        assert_eq!(column(&report).unwrap().next().unwrap(), "unknown");
    }
}
