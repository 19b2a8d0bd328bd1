//! All points for programs, and what is seen of each set for people.

use super::{COUNT, Claim, LOG_CELLS, Seen, Set};
use quasilux_report::number::exact;
use std::fmt::Write;

/// One line a point.
pub(super) fn csv(sets: &[Set], seen: &[Seen]) -> String {
    let mut text = "set,index,x,y,empty_cells,star_discrepancy\n".to_owned();
    for (set, seen) in sets.iter().zip(seen) {
        for (index, [x, y]) in set.points.iter().enumerate() {
            let name = set.name.replace(", ", " ");
            let (x, y, star) = (exact(*x), exact(*y), exact(seen.star_discrepancy));
            writeln!(text, "{name},{index},{x},{y},{},{star}", seen.empty).expect("strings grow");
        }
    }
    text
}

/// The table, and what is claimed.
pub(super) fn markdown(seen: &[Seen], claims: &[Claim]) -> String {
    let mut text = format!(
        "# 64 points on 8 x 8 cells\n\n\
         The first {COUNT} points of each sequence in its first two dimensions. Even divisions: of \
         the {} ways to divide the\n\
         square into 64 rectangles whose sides are powers of two, those with one point in each. \
         The star discrepancy is exact.\n\n\
         | points | empty cells | most in a cell | even divisions | star discrepancy \
         |\n|---|---:|---:|---:|---:|\n",
        LOG_CELLS + 1
    );
    for Seen { name, empty, most, star_discrepancy, even_divisions } in seen {
        writeln!(text, "| {name} | {empty} | {most} | {even_divisions} | {star_discrepancy:.4} |")
            .expect("strings grow");
    }
    text + &Claim::markdown(claims)
}

/// Under the name of a set.
pub(super) fn subtitle(seen: &Seen) -> String {
    format!("{} of 64 cells empty, {} points in the fullest", seen.empty, seen.most)
}
