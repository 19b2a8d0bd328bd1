//! The counts as CSV and as a table.

use super::SEQUENCES;
use super::count::{Count, Figure, Moment, Verdict};
use super::scenes;
use quasilux_measure::number::exact;
use quasilux_sampling::Sequence;
use std::fmt::Write;

/// What stands in place of a scene where all are counted together.
pub(super) const ALL: &str = "all";
/// Intervals narrower by this factor are counted beside the others.
const NARROW: f64 = 0.7;

/// One line a count.
pub(super) fn csv(counts: &[Count], verdict: &Verdict) -> String {
    let mut text =
        "scene,sequence,moment,figure,runs,covered,coverage,covered_if_30_percent_narrower,p_value,passed,\
         fewest_samples,most_samples,share_at_fewest\n"
            .to_owned();
    for (number, count) in counts.iter().enumerate() {
        let ([fewest, most], share) = count.ends();
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{},{fewest},{most},{}",
            count.scene,
            count.sequence.name(),
            count.moment.name(),
            count.figure.name(),
            count.errors.len(),
            count.covered(1.0),
            exact(count.coverage(1.0)),
            count.covered(NARROW),
            exact(verdict.p_values[number]),
            !verdict.fails(number),
            exact(share),
        )
        .expect("strings grow");
    }
    text
}

/// The table, and what it says.
pub(super) fn markdown(counts: &[Count], verdict: &Verdict, seeds: u32) -> String {
    let mut text = format!(
        "# Coverage of the intervals\n\n\
         How often 95 % intervals from 16 replicates cover the truth, in %, over {seeds} seeds: after a fixed\n\
         number of samples, and where the run stops by itself. Of points, the lowest and the highest coverage.\n\n"
    );
    text.push_str(&header());
    let scenes = scenes::all();
    for moment in Moment::ALL {
        for scene in scenes.iter().map(|known| known.name).chain([ALL]) {
            let cells =
                SEQUENCES.iter().flat_map(|(sequence, _)| row(counts, (scene, moment, *sequence)));
            let cells: Vec<String> = cells.collect();
            writeln!(text, "| {scene} | {} | {} |", moment.name(), cells.join(" | "))
                .expect("strings grow");
        }
    }
    text.push_str(&ends(counts));
    for known in &scenes {
        writeln!(text, "- {}: {} ({})", known.name, known.why, known.estimator.name())
            .expect("strings grow");
    }
    text.push_str(&judgement(counts, verdict));
    text
}

/// Where runs stop.
fn ends(counts: &[Count]) -> String {
    let mut text = "\nSamples in each replicate where runs stop, and the share that stops at the fewest:\n\n| scene |"
        .to_owned();
    for (sequence, _) in SEQUENCES {
        write!(text, " {0}: samples | {0}: at the fewest |", sequence.name())
            .expect("strings grow");
    }
    writeln!(text, "\n|---|{}", "---:|".repeat(2 * SEQUENCES.len())).expect("strings grow");
    for known in &scenes::all() {
        write!(text, "| {} |", known.name).expect("strings grow");
        for (sequence, _) in SEQUENCES {
            let own = counts.iter().find(|count| {
                let is_stop = count.moment == Moment::Stop && count.figure == Figure::Average;
                is_stop && count.scene == known.name && count.sequence == sequence
            });
            let ([fewest, most], share) = own.map_or(([0; 2], f64::NAN), Count::ends);
            write!(text, " {fewest} to {most} | {} % |", percent(share)).expect("strings grow");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

fn header() -> String {
    let columns = SEQUENCES.iter().map(|(sequence, _)| {
        let name = sequence.name();
        format!(" {name}: points | average | minimum |")
    });
    let columns: String = columns.collect();
    format!("| scene | moment |{columns}\n|---|---|{}\n", "---:|".repeat(3 * SEQUENCES.len()))
}

fn row(counts: &[Count], (scene, moment, sequence): (&str, Moment, Sequence)) -> [String; 3] {
    let own = || {
        counts.iter().filter(move |count| {
            count.scene == scene && count.moment == moment && count.sequence == sequence
        })
    };
    let of = |figure: Figure| {
        let count = own().find(|count| count.figure == figure);
        count.map_or(String::new(), |count| percent(count.coverage(1.0)))
    };
    let points = own().filter(|count| matches!(count.figure, Figure::Point(_)));
    let coverages: Vec<f64> = points.map(|count| count.coverage(1.0)).collect();
    let low = coverages.iter().copied().fold(f64::INFINITY, f64::min);
    let high = coverages.iter().copied().fold(0.0, f64::max);
    let points =
        if low < high { format!("{} to {}", percent(low), percent(high)) } else { percent(low) };
    [points, of(Figure::Average), of(Figure::Minimum)]
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

fn judgement(counts: &[Count], verdict: &Verdict) -> String {
    let narrow = Verdict::of(counts, NARROW).failed();
    let mut text = format!(
        "\nOf {} counts {} fail the binomial test of a coverage from 93.5 to 96.5 % (all together at 1 %, Sidak).\n\
         Were the intervals 30 % narrower, {narrow} would.\n",
        counts.len(),
        verdict.failed(),
    );
    for count in verdict.failures(counts) {
        writeln!(text, "- fails: {}", count.label()).expect("strings grow");
    }
    text
}
