//! What is missing at the points that are not done, on the terminal.

use crate::number::count;
use crate::report::Report;
use quasilux_transport::PointStatus;

/// What is missing at how many points, in words; nothing where all points are done.
pub(super) fn missing(report: &Report) -> String {
    let points = || report.sensors.iter().flat_map(|sensor| &sensor.points);
    let all = points().count() as u64;
    let of_status = |status: PointStatus| {
        let own = points().filter(|point| point.status == Some(status)).count() as u64;
        let text = in_words(status).filter(|_| own > 0)?;
        Some(format!("{text} at {} of {} points", count(own), count(all)))
    };
    PointStatus::ALL.into_iter().filter_map(of_status).collect::<Vec<_>>().join(", ")
}

fn in_words(status: PointStatus) -> Option<&'static str> {
    Some(match status {
        PointStatus::HalfWidth => "half-width too large",
        PointStatus::Unseen => "bound on unseen light too large",
        PointStatus::Average => "average not known well enough",
        PointStatus::Dark => "no light found",
        PointStatus::RareLight => "too few paths met rare, bright light",
        PointStatus::FewSamples => "too few samples",
        PointStatus::Done => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn points_that_are_not_done_are_counted_by_what_is_missing() {
        let mut report = example::office();
        let number = report.sensors[0].points.len();
        let points = || number.to_string();
        let status = |number: usize| match number {
            0 => PointStatus::Unseen,
            1 | 2 => PointStatus::HalfWidth,
            _ => PointStatus::Done,
        };
        report.sensors.truncate(1);
        report.sensors[0].points.iter_mut().for_each(|point| point.status = None);
        assert_eq!(missing(&report), "");
        let own = report.sensors[0].points.iter_mut().enumerate();
        own.for_each(|(number, point)| point.status = Some(status(number)));
        let wanted = format!(
            "half-width too large at 2 of {0} points, bound on unseen light too large at 1 of {0} \
             points",
            points()
        );
        assert_eq!(missing(&report), wanted);
    }
}
