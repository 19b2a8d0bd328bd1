//! What an experiment asserts: a sentence with the figures behind it, and whether it holds.

use std::fmt::Write;

/// A statement that the figures of this run bear out or refute.
pub(super) struct Claim {
    /// With the figures, and the significance where chance plays a part.
    pub(super) text: String,
    pub(super) holds: bool,
}

impl Claim {
    /// A list under a heading, those that fail in bold.
    pub(super) fn markdown(claims: &[Self]) -> String {
        let mut text = "\n## What is claimed\n\n".to_owned();
        for Self { text: claim, holds } in claims {
            let verdict = if *holds { "holds" } else { "**FAILS**" };
            writeln!(text, "- {claim}: {verdict}.").expect("strings grow");
        }
        text
    }

    /// Whether all of them hold.
    pub(super) fn all_hold(claims: &[Self]) -> bool {
        claims.iter().all(|claim| claim.holds)
    }
}
