//! What is told of a container: warnings with their places, and facts.

use super::error::{ContainerWarning, PRODUCT, cut};
use crate::WarningKind;
use crate::warning::Warnings;
use quasilux_text::Position;
use std::fmt;

/// Characters of a fact: a dozen short ones in a list.
const MAX_FACT: usize = 400;

/// Warnings of a container.
const MAX_WARNINGS: usize = 200;

/// A fact of a container that photometric files do not have, for people.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ContainerFact {
    /// A noun: `variant`, `mounting`.
    pub name: &'static str,
    /// Its value as the container says it.
    pub value: String,
}

/// Facts and deviations of a container, as they are found.
#[derive(Default)]
pub(super) struct Told {
    pub(super) warnings: Vec<ContainerWarning>,
    pub(super) facts: Vec<ContainerFact>,
}

impl Told {
    /// Warns of something in `product.xml`; each case is told, of very many the first ones.
    pub(super) fn warn(
        &mut self,
        kind: WarningKind,
        at: Position,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) {
        let mut warnings = Warnings::default();
        match self.warnings.len() {
            0..MAX_WARNINGS => warnings.push(kind, at, found, expected),
            MAX_WARNINGS => {
                let expected = format!("no more than {MAX_WARNINGS} (they are not listed)");
                warnings.push(kind, at, "more deviations", expected);
            }
            _ => return,
        }
        self.pass_on(PRODUCT, warnings.into_vec());
    }

    /// Takes over the warnings of a file in the container.
    pub(super) fn pass_on(&mut self, part: &str, warnings: Vec<crate::Warning>) {
        let of_part = |warning| ContainerWarning { part: part.to_owned(), warning };
        self.warnings.extend(warnings.into_iter().map(of_part));
    }

    /// Tells a fact, cut after some hundred characters, without those that command a terminal.
    pub(super) fn fact(&mut self, name: &'static str, value: impl AsRef<str>) {
        let words: Vec<&str> = value.as_ref().split_whitespace().collect();
        self.facts.push(ContainerFact { name, value: cut(&words.join(" "), MAX_FACT) });
    }
}
