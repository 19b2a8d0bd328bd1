//! The nearest valid name to a misspelt one.
//!
//! Distance is the restricted Damerau-Levenshtein distance (Damerau 1964, Levenshtein 1966), also
//! called optimal string alignment: insertions, deletions, substitutions and swaps of neighbours
//! each cost 1. Case costs nothing.

/// Names longer than this are not compared: the distance costs the product of the lengths.
const MAX_CHARS: usize = 128;

/// The candidate at the smallest distance from `name`, the first of equals; `None` where all
/// differ in more than a third of their characters (and by more than 2).
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let Some(distance) = distance(name, candidate) else {
            continue;
        };
        let allowed = 2.max(name.chars().count().max(candidate.chars().count()) / 3);
        let near = distance <= allowed && distance < candidate.chars().count();
        if near && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Distance without regard to case; `None` where a name is too long.
fn distance(a: &str, b: &str) -> Option<usize> {
    let lower = |name: &str| -> String {
        name.chars().flat_map(char::to_lowercase).take(MAX_CHARS + 1).collect()
    };
    let (a, b) = (lower(a), lower(b));
    let is_short = |name: &str| name.chars().count() <= MAX_CHARS;
    (is_short(&a) && is_short(&b)).then(|| strsim::osa_distance(&a, &b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_by_hand() {
        let cases = [("", "", 0), ("abc", "", 3), ("kitten", "sitting", 3), ("ab", "ba", 1)];
        for (a, b, expected) in cases {
            assert_eq!(distance(a, b), Some(expected), "{a} {b}");
            assert_eq!(distance(b, a), Some(expected), "{b} {a}");
        }
    }

    #[test]
    fn near_names_are_offered_and_far_ones_are_not() {
        let keys = ["position", "intensity_cd", "kind"];
        assert_eq!(nearest("postion", keys), Some("position"));
        assert_eq!(nearest("Kind", keys), Some("kind"));
        assert_eq!(nearest("intensity", keys), Some("intensity_cd"));
        assert_eq!(nearest("reflectance", keys), None);
        assert_eq!(nearest("x", ["u", "v"]), None);
        assert_eq!(nearest(&"k".repeat(1_000_000), keys), None);
    }
}
