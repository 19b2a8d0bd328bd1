//! Names of materials.

use std::collections::{HashMap, HashSet};

/// Names that are taken.
#[derive(Default)]
pub(super) struct Names {
    taken: HashSet<String>,
    /// The last number behind a wanted name.
    numbers: HashMap<String, usize>,
}

impl Names {
    /// The wanted name, with a number behind it where something else has it.
    pub(super) fn new_name(&mut self, wanted: &str) -> String {
        let number = self.numbers.entry(wanted.to_owned()).or_insert(0);
        loop {
            *number += 1;
            let name = if *number == 1 { wanted.to_owned() } else { format!("{wanted} {number}") };
            if self.taken.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// A name that any format of geometry can have.
pub(super) fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_name_is_one() {
        let mut names = Names::default();
        let mut name = |wanted: &str| names.new_name(wanted);
        assert_eq!([name("a"), name("a"), name("a 2"), name("a")], ["a", "a 2", "a 2 2", "a 3"]);
        assert_eq!(plain("group \"1\" state 2"), "group__1__state_2");
    }
}
