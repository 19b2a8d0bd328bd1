//! Certified limits of averages, on the terminal.

use crate::number::brief;
use crate::{Report, SensorReport};
use quasilux_transport::IntervalKind;

/// The column of a sensor's average; `None` where they were not asked for.
pub(super) fn column(report: &Report) -> Option<impl Iterator<Item = String>> {
    let cell = |sensor: &SensorReport| match sensor.summary.certified_average_lx {
        None => "-".to_owned(),
        Some(limits) => {
            let lower = brief(limits.lower, 4);
            match limits.upper {
                None => format!("≥ {lower} lx"),
                Some(upper) => format!("{lower} to {} lx", brief(upper, 4)),
            }
        }
    };
    let is_asked = report.run.settings.interval == IntervalKind::Certified;
    is_asked.then(|| report.sensors.iter().map(cell))
}

#[cfg(test)]
mod tests {
    use super::super::{Style, table};
    use super::*;
    use crate::{CertifiedFigure, example};

    #[test]
    fn limits_stand_beside_averages() {
        let mut report = example::with_unseen();
        assert!(!table(&report, Style::Plain).contains("certified"));
        report.run.settings.interval = IntervalKind::Certified;
        let lines = |report: &Report| table(report, Style::Plain);
        assert!(lines(&report).contains("unseen     certified   minimum"), "{}", lines(&report));
        report.sensors[0].summary.certified_average_lx =
            Some(CertifiedFigure { lower: 190.0, upper: None });
        assert!(lines(&report).contains("≤ 0.4 lx   ≥ 190 lx"), "{}", lines(&report));
        report.sensors[0].summary.certified_average_lx =
            Some(CertifiedFigure { lower: 190.0, upper: Some(260.0) });
        assert!(lines(&report).contains("190 to 260 lx"), "{}", lines(&report));
    }
}
