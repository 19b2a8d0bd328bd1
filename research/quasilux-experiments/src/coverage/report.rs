//! The counts as CSV and as a table.

use super::SEQUENCES;
use super::count::{Count, Figure, Moment, Verdict};
use super::scenes;
use quasilux_report::number::exact;
use quasilux_sampling::Sequence;
use std::fmt::Write;

/// What stands in place of a scene where all are counted together.
pub(super) const ALL: &str = "all";
/// Intervals narrower by this factor are counted beside the others.
const NARROW: f64 = 0.7;

/// One line a count.
pub(super) fn csv(counts: &[Count], verdict: &Verdict) -> String {
    let mut text =
        "scene,sequence,moment,figure,runs,covered,coverage,covered_if_30_percent_narrower,\
         p_value,passed,intervals_by_samples\n"
            .to_owned();
    for (number, count) in counts.iter().enumerate() {
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{},{}",
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
            ends(count).join(" "),
        )
        .expect("strings grow");
    }
    text
}

/// The table, and what it says.
pub(super) fn markdown(counts: &[Count], verdict: &Verdict, seeds: u32) -> String {
    let mut text = format!(
        "# Coverage of the intervals\n\n\
         How often 95 % intervals from 16 replicates cover the truth, in % (and how many do), over \
         {seeds} seeds: at the\n\
         first checkpoint, after a fixed number of samples, and where the run stops by itself. Of \
         points, the lowest and\n\
         the highest coverage. Rows of all scenes have one point, the average and the minimum of \
         each together.\n\n"
    );
    text.push_str(&header());
    let scenes = scenes::all();
    for moment in Moment::ALL {
        for scene in scenes.iter().map(|known| known.name).chain([ALL]) {
            let cells =
                SEQUENCES.iter().flat_map(|(sequence, _)| row(counts, scene, moment, *sequence));
            let cells: Vec<String> = cells.collect();
            writeln!(text, "| {scene} | {} | {} |", moment.name(), cells.join(" | "))
                .expect("strings grow");
        }
    }
    text.push_str(&stops(counts));
    for known in &scenes {
        writeln!(text, "- {}: {} ({})", known.name, known.why, known.estimator.name())
            .expect("strings grow");
    }
    text.push_str(&judgement(counts, verdict));
    text
}

/// Numbers of samples with how many of the intervals are from them, as "128:40".
fn ends(count: &Count) -> Vec<String> {
    count.ends().iter().map(|(samples, intervals)| format!("{samples}:{intervals}")).collect()
}

/// Where runs stop.
fn stops(counts: &[Count]) -> String {
    let mut text =
        "\nSamples in each replicate where runs stop, and how many runs do:\n\n| scene |"
            .to_owned();
    for (sequence, _) in SEQUENCES {
        write!(text, " {} |", sequence.name()).expect("strings grow");
    }
    writeln!(text, "\n|---|{}", "---|".repeat(SEQUENCES.len())).expect("strings grow");
    for known in &scenes::all() {
        write!(text, "| {} |", known.name).expect("strings grow");
        for (sequence, _) in SEQUENCES {
            let is_own = |count: &&Count| {
                count.is_of_runs() && count.scene == known.name && count.sequence == sequence
            };
            let own = counts.iter().find(is_own).map_or_else(Vec::new, ends);
            write!(text, " {} |", own.join(", ")).expect("strings grow");
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

fn row(counts: &[Count], scene: &str, moment: Moment, sequence: Sequence) -> [String; 3] {
    let own = || {
        counts.iter().filter(move |count| {
            count.scene == scene && count.moment == moment && count.sequence == sequence
        })
    };
    let of = |figure: Figure| {
        let count = own().find(|count| count.figure == figure);
        count.map_or(String::new(), |count| {
            format!("{} ({})", percent(count.coverage(1.0)), count.covered(1.0))
        })
    };
    let points = own().filter(|count| matches!(count.figure, Figure::Point(_)));
    let covered: Vec<usize> = points.clone().map(|count| count.covered(1.0)).collect();
    let runs = points.map(|count| count.errors.len()).next().unwrap_or(0) as f64;
    let low = covered.iter().copied().min().unwrap_or(0);
    let high = covered.iter().copied().max().unwrap_or(0);
    let [low_share, high_share] = [low, high].map(|covered| percent(covered as f64 / runs));
    let points = if low < high {
        format!("{low_share} to {high_share} ({low} to {high})")
    } else {
        format!("{low_share} ({low})")
    };
    [points, of(Figure::Average), of(Figure::Minimum)]
}

fn percent(share: f64) -> String {
    format!("{:.1}", 100.0 * share)
}

fn judgement(counts: &[Count], verdict: &Verdict) -> String {
    let narrow = Verdict::new(counts, NARROW).failed();
    let mut text = format!(
        "\nOf {} counts {} fail the binomial test of a coverage from 93.5 to 96.5 %, of minima \
         from 93.5 % on (all\n\
         together at 1 %, Sidak).\n\
         Were the intervals 30 % narrower, {narrow} would.\n",
        counts.len(),
        verdict.failed(),
    );
    for count in verdict.failures(counts) {
        writeln!(text, "- fails: {}", count.label()).expect("strings grow");
    }
    let runs = counts.iter().filter(|count| count.is_of_runs());
    if let Some(worst) = runs.max_by(|a, b| a.commonest_end().total_cmp(&b.commonest_end())) {
        writeln!(
            text,
            "Runs stop at several looks: at most {} % of those of a scene at the same one ({}, \
             {}), which tests\n\
             stopping if it is 90 % or less: {}.",
            percent(worst.commonest_end()),
            worst.scene,
            worst.sequence.name(),
            if worst.has_looks() { "holds" } else { "**FAILS**" },
        )
        .expect("strings grow");
    }
    text
}
