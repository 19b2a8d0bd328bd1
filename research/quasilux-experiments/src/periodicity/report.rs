//! Table 2, and the widths of groups.

use super::inverse::{Inverse, TABLE_2};
use super::{Claim, DIMENSIONS, Width};
use quasilux_report::number::exact;
use quasilux_sampling::radical_inverse;
use std::fmt::Write;

/// One line for each sequence and number of groups.
pub(super) fn csv(widths: &[Width]) -> String {
    let mut text =
        "sequence,randomization,groups,bound_0,bound_1,bound_2,mean_width,most_of_bound,\
         consecutive_width\n"
            .to_owned();
    for width in widths {
        let bounds: Vec<String> = width.bounds.iter().map(|bound| exact(*bound)).collect();
        writeln!(
            text,
            "{},{},{},{},{},{},{}",
            width.sequence,
            width.randomization.name(),
            width.groups,
            bounds.join(","),
            exact(width.mean),
            exact(width.of_bound),
            exact(width.consecutive),
        )
        .expect("strings grow");
    }
    text
}

/// Both tables, and what is claimed.
pub(super) fn markdown(
    inverse: &Inverse,
    widths: &[Width],
    count: u64,
    claims: &[Claim],
) -> String {
    let mut text = "# Periodicity and coherent groups\n\nThe radical inverse in base 10 (table 2 \
        of the paper):\n\n\
        | i | inverse |\n|---:|---:|\n"
        .to_owned();
    for index in TABLE_2 {
        writeln!(text, "| {index} | {} |", exact(radical_inverse(10, index)))
            .expect("strings grow");
    }
    write!(
        text,
        "\n{} pairs of indices that are multiples of a power of the base apart were compared.\n\n\
         {count} photons are divided among groups: how wide groups are in coordinates {} to {} \
         (mean over groups and coordinates), beside as many runs of consecutive indices:\n\n\
         | sequence | groups | largest of the three bounds | mean width | runs of consecutive \
         indices |\n|---|---:|---:|---:|---:|\n",
        inverse.pairs, DIMENSIONS[0], DIMENSIONS[2],
    )
    .expect("strings grow");
    for width in widths {
        let bound = width.bounds.iter().copied().fold(0.0, f64::max);
        writeln!(
            text,
            "| {}, {} | {} | {bound:.4} | {:.4} | {:.4} |",
            width.sequence,
            width.randomization.name(),
            width.groups,
            width.mean,
            width.consecutive
        )
        .expect("strings grow");
    }
    text + &Claim::markdown(claims)
}
