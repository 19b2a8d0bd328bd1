//! What the run says of its own convergence: one line, with what is left to do where a limit came
//! first.

use super::plural;
use crate::Report;
use crate::number::{brief, memory};

/// Above this slope, the points do little more than random ones do.
const LIKE_RANDOM: f64 = -0.6;

/// One line; nothing where no slope was measured.
pub(super) fn convergence(report: &Report) -> Option<String> {
    let run = &report.run;
    let slope = run.convergence.slope?;
    let mut text = format!("error ~ N^{slope:.2}");
    if slope > LIKE_RANDOM && run.settings.sequence.name() != "random" {
        let hint = if report.explanation.is_none() { "; see --explain" } else { "" };
        text += &format!(" (no better than random points{hint})");
    }
    let left = run.convergence.samples.zip(run.convergence.rays);
    if let (false, true, Some((samples, rays))) =
        (run.sensors_reached, run.settings.has_tolerance(), left)
        && samples > run.samples
    {
        let all = [plural(samples, "sample"), plural(rays, "ray")];
        text += &format!("; reaching the tolerance would take {}", all.join(", "));
        if let Some(seconds) = run.expected_seconds() {
            text += &format!(", about {} s in all", brief(seconds, 2));
        }
        if let Some(bytes) = run.expected_bytes {
            text += &format!(" and {}", memory(bytes));
        }
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn the_slope_is_told_and_what_is_left_where_a_limit_came_first() {
        let mut report = example::office();
        assert_eq!(convergence(&report).unwrap(), "error ~ N^-0.72");
        report.run.sensors_reached = false;
        report.run.convergence.slope = Some(-0.5);
        report.run.convergence.samples = Some(1 << 18);
        report.run.convergence.rays = Some(750_617_284);
        report.run.seconds = 10.0;
        let wanted = "error ~ N^-0.50 (no better than random points; see --explain); reaching the \
            tolerance would take 262 144 samples, 750 617 284 rays, about 40 s in all and 96 \
            MiB";
        assert_eq!(convergence(&report).unwrap(), wanted);
        report.run.earlier_rays = report.run.rays / 2;
        assert!(convergence(&report).unwrap().ends_with(" rays, about 80 s in all and 96 MiB"));
        report.run.earlier_rays = report.run.rays;
        report.run.expected_bytes = None;
        assert!(convergence(&report).unwrap().ends_with(" rays"));
        report.run.convergence.slope = None;
        assert_eq!(convergence(&report), None);
    }
}
