//! Names that can be those of files, each once whatever its case.

use std::collections::{HashMap, HashSet};

/// Longest name in bytes; a number may come behind it.
const MAX_BYTES: usize = 80;

/// Names that are taken, in lower case.
#[derive(Debug, Default)]
pub(super) struct Names {
    taken: HashSet<String>,
    /// The last number behind a wanted name.
    numbers: HashMap<String, usize>,
}

impl Names {
    /// A name like the wanted one; with each of these endings nothing else has it.
    pub(super) fn new_name(&mut self, wanted: &str, endings: &[&str]) -> String {
        let wanted = cleaned(wanted);
        let number = self.numbers.entry(wanted.to_lowercase()).or_insert(0);
        loop {
            *number += 1;
            let name = if *number == 1 { wanted.clone() } else { format!("{wanted}-{number}") };
            let all = || endings.iter().map(|ending| format!("{name}{ending}").to_lowercase());
            if all().all(|name| !self.taken.contains(&name)) {
                self.taken.extend(all());
                return name;
            }
        }
    }
}

/// The text with nothing in it that some system takes for more than a letter.
fn cleaned(text: &str) -> String {
    let forbidden = |c: char| c.is_control() || "/\\:*?\"<>|".contains(c);
    let mut name: String = text.chars().map(|c| if forbidden(c) { '_' } else { c }).collect();
    while name.len() > MAX_BYTES {
        name.pop();
    }
    let name = name.trim_start_matches(['.', ' ', '-']).trim_end_matches(['.', ' ']);
    let is_reserved =
        ["con", "prn", "aux", "nul", ""].iter().any(|word| name.eq_ignore_ascii_case(word));
    if is_reserved { format!("{name}_") } else { name.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_clean_and_each_is_one() {
        let mut names = Names::default();
        let mut name = |wanted: &str| names.new_name(wanted, &["", "-x"]);
        assert_eq!(name("Room 1"), "Room 1");
        assert_eq!(name("ROOM 1"), "ROOM 1-2");
        assert_eq!(name("room 1-x"), "room 1-x-2");
        assert_eq!(name("a/b:c"), "a_b_c");
        assert_eq!(name("..."), "_");
        assert_eq!(name("con"), "con_");
        assert!(name(&"\u{e4}".repeat(200)).len() <= 80);
    }
}
