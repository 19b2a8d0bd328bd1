//! Which coordinates carry the variance, on the terminal: a line for each block, and what it means.

use super::{Column, Emphasis, Style, lines};
use crate::number::{brief, count};
use quasilux_transport::Explanation;
use quasilux_transport::explain::{Block, Gain, SampleKind, Share};
use std::fmt::Write;

/// A smaller factor between errors makes no difference to speak of.
const NO_GAIN: f64 = 1.1;
/// Powers of the step below this are nearer to jumps than to slopes.
const JUMPS: f64 = 1.5;

/// A table of the blocks, and sentences on the gain of quasi-random points.
#[must_use]
pub fn explanation(explanation: &Explanation, style: Style) -> String {
    let blocks = || explanation.blocks.iter();
    let percent = |share: f64| format!("{} %", brief(100.0 * share, 3));
    let share = |share: Option<Share>| match share {
        Some(Share { value, standard_error }) => {
            format!("{:>5.1} ± {:.1} %", 100.0 * value, 100.0 * standard_error)
        }
        None => "-".to_owned(),
    };
    let values = |block: &Block| match block.smoothness {
        Some(power) if power < JUMPS => "jump",
        Some(_) => "vary smoothly",
        None => "-",
    };
    let table = lines(
        vec![
            Column::left("coordinates", blocks().map(coordinates)),
            Column::left("feed", blocks().map(uses)),
            Column::left("reached", blocks().map(|block| percent(block.reached))),
            Column::left("variance alone", blocks().map(|block| share(block.alone))),
            Column::left("with others", blocks().map(|block| share(block.total))),
            Column::left("values", blocks().map(|block| values(block).to_owned())),
        ],
        style,
    );
    let mut text = format!("{}\n\n{table}\n", sampled(explanation));
    for sentence in sentences(explanation) {
        writeln!(text, "{}", style.paint(Emphasis::Strong, &sentence)).expect("strings grow");
    }
    text
}

/// What was traced to know this.
fn sampled(explanation: &Explanation) -> String {
    let Explanation { walk, targets, samples, rays, dimensions, relative_deviation, .. } =
        explanation;
    let (samples, targets) = (count(*samples), count(*targets as u64));
    let (pilot, one) = match walk {
        SampleKind::Photons => (format!("{samples} photons for {targets} sensors"), "photon"),
        SampleKind::Paths => (format!("{samples} paths from each of {targets} points"), "path"),
        SampleKind::PathsOnMap => {
            (format!("{samples} paths to one map from each of {targets} points"), "path")
        }
    };
    format!(
        "Explained by {pilot} ({} rays beside the run): a {one} takes {} coordinates on average, \
         half of them {} or fewer, nine of ten {} and all {}; what it finds deviates by {} % of \
         the mean.",
        count(*rays),
        brief(dimensions.mean(), 3),
        dimensions.quantile(0.5),
        dimensions.quantile(0.9),
        dimensions.largest(),
        brief(100.0 * relative_deviation, 3),
    )
}

fn coordinates(block: &Block) -> String {
    let (first, last) = (block.dimensions.start, block.dimensions.end - 1);
    match block.dimensions.end {
        u32::MAX => format!("{first} and on"),
        _ if first == last => first.to_string(),
        _ => format!("{first} to {last}"),
    }
}

/// The decision that a block mostly feeds, and how much it feeds others.
fn uses(block: &Block) -> String {
    let Some(most) = block.uses.first() else { return "-".to_owned() };
    if most.share > 0.995 {
        most.purpose.to_string()
    } else {
        format!("{} ({:.0} %), and others", most.purpose, 100.0 * most.share)
    }
}

/// In plain words: how the blocks act, the gain of the sequence, and the obstacles to it.
fn sentences(explanation: &Explanation) -> Vec<String> {
    let Some(interacting) = explanation.interacting_blocks else {
        return vec!["Nothing varies: every sample finds the same.".to_owned()];
    };
    let most = match explanation.truncation_dimension {
        Some(dimension) => format!("the first {dimension} coordinates carry 99 % of the variance"),
        None => "no block of photons or paths can be left out".to_owned(),
    };
    let mut sentences =
        vec![format!("{} blocks act together on average; {most}.", brief(interacting, 3))];
    let total = |block: &Block| block.total.map_or(0.0, |share| share.value);
    let largest = explanation.blocks.iter().max_by(|a, b| total(a).total_cmp(&total(b)));
    sentences.extend(explanation.gain.as_ref().map(gain_text));
    sentences.extend(largest.map(|block| {
        let [start, end] = match block.smoothness {
            Some(power) if power < JUMPS => ["What stands in the way of more are jumps", ""],
            _ => ["Most of it varies smoothly", ", which even points integrate fast"],
        };
        let feeds = block.uses.first().map_or_else(String::new, |used| used.purpose.to_string());
        format!(
            "{start}: {:.0} % of the variance depends on \"{feeds}\"{end}.",
            100.0 * total(block)
        )
    }));
    sentences
}

fn gain_text(gain: &Gain) -> String {
    let Gain { samples, factor, standard_error, exponent, .. } = gain;
    let help = if *factor < NO_GAIN { "does not help" } else { "helps" };
    format!(
        "The sequence {help}: at {} samples the error of pseudo-random points is {factor:.1} ± \
         {standard_error:.1} times as large, so that they would need {} times the samples; the \
         error falls like N^-{exponent:.2}.",
        count(*samples),
        brief(factor * factor, 2),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_transport::DimensionHistogram;
    use quasilux_transport::explain::Use;
    use quasilux_transport::purpose::Purpose;

    fn example() -> Explanation {
        let share = |value| Some(Share { value, standard_error: 0.01 });
        let block = |dimensions, purpose, value, smoothness| Block {
            dimensions,
            uses: vec![Use { purpose, share: 1.0 }],
            reached: 1.0,
            alone: share(0.9 * value),
            total: share(value),
            smoothness,
        };
        let mut dimensions = DimensionHistogram::new();
        [4, 6].into_iter().for_each(|used| dimensions.record(used));
        Explanation {
            walk: SampleKind::Paths,
            targets: 8,
            samples: 1024,
            rays: 1_000_000,
            dimensions,
            relative_deviation: 0.8,
            blocks: vec![
                block(0..2, Purpose::FirstDirection, 0.7, Some(1.1)),
                block(2..u32::MAX, Purpose::AreaLight { surface: 1 }, 0.4, Some(1.9)),
            ],
            interacting_blocks: Some(1.1),
            truncation_dimension: None,
            gain: Some(Gain {
                samples: 1024,
                replicates: 16,
                factor: 3.0,
                standard_error: 0.3,
                exponent: 0.7,
            }),
        }
    }

    #[test]
    fn says_what_stands_in_the_way() {
        let text = explanation(&example(), Style::Plain);
        for words in [
            "1 024 paths from each of 8 points",
            "5 coordinates on average, half of them 4 or fewer, nine of ten 6 and all 6; what it \
             finds",
            "0 to 1        direction from the sensor",
            "2 and on      place on an area light, at surface 1",
            " 70.0 ± 1.0 %",
            "3.0 ± 0.3 times as large, so that they would need 9 times the samples",
            "jumps: 70 % of the variance depends on \"direction from the sensor\".",
        ] {
            assert!(text.contains(words), "no {words} in\n{text}");
        }
    }

    #[test]
    fn nothing_to_explain_is_said() {
        let none = Explanation {
            blocks: Vec::new(),
            interacting_blocks: None,
            gain: None,
            relative_deviation: 0.0,
            ..example()
        };
        assert!(explanation(&none, Style::Plain).contains("Nothing varies"));
    }
}
