//! Which crate may use which: the table of `ARCHITECTURE.md`.

use crate::Violation;
use toml::Table;

/// The crates from the ground up, and what each may use of the others.
const MAY_USE: [(&str, &[&str]); 17] = [
    ("quasilux-sampling", &[]),
    ("quasilux-bvh", &[]),
    ("quasilux-stats", &[]),
    ("quasilux-corpus", &[]),
    ("quasilux-text", &[]),
    ("quasilux-sky", &["quasilux-text"]),
    ("quasilux-photometry", &["quasilux-sampling", "quasilux-text"]),
    ("quasilux-bsdf", &["quasilux-photometry", "quasilux-sampling", "quasilux-text"]),
    ("quasilux-scene", &["quasilux-bsdf", "quasilux-photometry", "quasilux-sky", "quasilux-text"]),
    (
        "quasilux-transport",
        &[
            "quasilux-scene",
            "quasilux-sampling",
            "quasilux-bvh",
            "quasilux-bsdf",
            "quasilux-photometry",
            "quasilux-sky",
        ],
    ),
    (
        "quasilux-inspection",
        &["quasilux-scene", "quasilux-sampling", "quasilux-bvh", "quasilux-photometry"],
    ),
    ("quasilux-drawing", &[]),
    (
        "quasilux-report",
        &[
            "quasilux-transport",
            "quasilux-inspection",
            "quasilux-scene",
            "quasilux-sky",
            "quasilux-text",
            "quasilux-drawing",
        ],
    ),
    (
        "quasilux-experiments",
        &[
            "quasilux-report",
            "quasilux-drawing",
            "quasilux-transport",
            "quasilux-inspection",
            "quasilux-scene",
            "quasilux-sampling",
            "quasilux-bvh",
            "quasilux-bsdf",
            "quasilux-photometry",
            "quasilux-sky",
        ],
    ),
    (
        "quasilux",
        &[
            "quasilux-experiments",
            "quasilux-sampling",
            "quasilux-bvh",
            "quasilux-text",
            "quasilux-photometry",
            "quasilux-bsdf",
            "quasilux-scene",
            "quasilux-sky",
            "quasilux-inspection",
            "quasilux-transport",
            "quasilux-drawing",
            "quasilux-report",
        ],
    ),
    (
        "quasilux-python",
        &[
            "quasilux",
            "quasilux-experiments",
            "quasilux-sampling",
            "quasilux-bvh",
            "quasilux-text",
            "quasilux-photometry",
            "quasilux-bsdf",
            "quasilux-scene",
            "quasilux-sky",
            "quasilux-inspection",
            "quasilux-transport",
            "quasilux-drawing",
            "quasilux-report",
        ],
    ),
    (
        "quasilux-gauntlet",
        &[
            "quasilux-transport",
            "quasilux-scene",
            "quasilux-brute",
            "quasilux-inspection",
            "quasilux-bvh",
        ],
    ),
];

/// Those above all others, whose rows in the page say so.
const ABOVE_ALL: [&str; 2] = ["quasilux", "quasilux-python"];

/// What every crate may use in its tests.
const TEST_TOOLS: [&str; 3] = ["quasilux-stats", "quasilux-corpus", "quasilux-brute"];

/// Crates that the table does not know, and arrows that it does not allow.
pub(crate) fn violations(manifests: &[(String, Table)]) -> Vec<Violation> {
    let mut violations = Vec::new();
    for (folder, manifest) in manifests {
        let name = manifest["package"]["name"].as_str().unwrap_or_default();
        if name != folder {
            violations.push(format!("the crate in the folder {folder} is named {name:?}"));
        }
        let Some((_, allowed)) = MAY_USE.iter().find(|(known, _)| known == folder) else {
            violations.push(format!("{folder} is not in the table of crates"));
            continue;
        };
        for (section, used) in arrows(manifest) {
            let fits = allowed.contains(&used.as_str());
            let in_tests = section == "dev-dependencies" && TEST_TOOLS.contains(&used.as_str());
            if !(fits || in_tests) {
                violations.push(format!("{folder} must not use {used} ({section})"));
            }
        }
    }
    violations
}

/// What a crate asks for of ours that is to share nothing with the others.
pub(crate) fn arrows_of_the_independent(manifest: &Table) -> Vec<Violation> {
    let told = |(section, used)| format!("the reference must not use {used} ({section})");
    arrows(manifest).into_iter().map(told).collect()
}

/// Crates whose row in the table of the page `ARCHITECTURE.md` is missing or says something else.
pub(crate) fn page_violations(page: &str) -> Vec<Violation> {
    let says = |name: &str, used: &[&str]| {
        let row = page.lines().find(|line| line.starts_with(&format!("| `{name}` |")))?;
        let last = row.trim_end_matches([' ', '|']).rsplit('|').next()?.trim();
        let mut said: Vec<&str> = match last {
            "-" => Vec::new(),
            "all of the above" => return Some(ABOVE_ALL.contains(&name)),
            list => list.split(", ").collect(),
        };
        let mut used: Vec<&str> =
            used.iter().filter_map(|name| name.strip_prefix("quasilux-")).collect();
        said.sort_unstable();
        used.sort_unstable();
        Some(said == used)
    };
    let wrong = MAY_USE.iter().filter(|(name, used)| says(name, used) != Some(true));
    wrong
        .map(|(name, _)| format!("ARCHITECTURE.md has no row for {name}, or another one"))
        .collect()
}

/// The section and the name of each crate of ours that a manifest asks for.
fn arrows(manifest: &Table) -> Vec<(&'static str, String)> {
    let targets = manifest.get("target").and_then(|target| target.as_table());
    let for_targets = targets.into_iter().flat_map(Table::values).filter_map(|t| t.as_table());
    let mut arrows = Vec::new();
    for table in std::iter::once(manifest).chain(for_targets) {
        for section in ["dependencies", "build-dependencies", "dev-dependencies"] {
            let dependencies = table.get(section).and_then(|section| section.as_table());
            for (key, value) in dependencies.into_iter().flatten() {
                // A renamed dependency keeps its name in `package`.
                let name = value.get("package").and_then(|name| name.as_str()).unwrap_or(key);
                if name.starts_with("quasilux") {
                    arrows.push((section, name.to_owned()));
                }
            }
        }
    }
    arrows
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(folder: &str, sections: &str) -> Vec<Violation> {
        let manifest = format!("[package]\nname = \"{folder}\"\n{sections}");
        violations(&[(folder.to_owned(), manifest.parse().unwrap())])
    }

    #[test]
    fn arrows_of_the_table_are_allowed() {
        let sections = "[dependencies]\nquasilux-photometry.workspace = true\nserde = '1'";
        assert_eq!(checked("quasilux-scene", sections), [""; 0]);
        let dev = "[dev-dependencies]\nquasilux-stats.workspace = true";
        assert_eq!(checked("quasilux-sampling", dev), [""; 0]);
    }

    #[test]
    fn an_arrow_up_is_rejected_in_every_section_and_under_every_name() {
        for sections in [
            "[dependencies]\nquasilux-transport.workspace = true",
            "[dependencies]\nlight = { package = 'quasilux-transport', version = '1' }",
            "[build-dependencies]\nquasilux-transport = '1'",
            "[dev-dependencies]\nquasilux-transport = '1'",
            "[target.'cfg(unix)'.dependencies]\nquasilux-transport = '1'",
        ] {
            let found = checked("quasilux-scene", sections);
            assert_eq!(found.len(), 1, "{sections}");
            assert!(found[0].contains("must not use quasilux-transport"), "{found:?}");
        }
    }

    #[test]
    fn a_page_that_differs_is_rejected() {
        let row = |(name, used): &(&str, &[&str])| match *name {
            above if ABOVE_ALL.contains(&above) => format!("| `{name}` | x | all of the above |\n"),
            _ if used.is_empty() => format!("| `{name}` | x | - |\n"),
            _ => format!("| `{name}` | x | {} |\n", used.join(", ").replace("quasilux-", "")),
        };
        let page: String = MAY_USE.iter().map(row).collect();
        assert_eq!(page_violations(&page), [""; 0]);
        assert_eq!(page_violations(&page.replace("| sampling, text |", "| sampling |")).len(), 1);
        assert_eq!(page_violations("").len(), MAY_USE.len());
    }

    #[test]
    fn the_test_tool_is_rejected_outside_tests() {
        assert_eq!(checked("quasilux-scene", "[dependencies]\nquasilux-stats = '1'").len(), 1);
    }

    #[test]
    fn a_reference_that_shares_code_is_rejected() {
        let sections = "[dependencies]\nquasilux-bvh.workspace = true\nglam = '1'";
        assert_eq!(arrows_of_the_independent(&sections.parse().unwrap()).len(), 1);
    }

    #[test]
    fn unknown_and_misnamed_crates_are_rejected() {
        assert!(checked("quasilux-extra", "")[0].contains("table of crates"));
        let manifest = "[package]\nname = 'light'".parse().unwrap();
        let found = violations(&[("quasilux-scene".to_owned(), manifest)]);
        assert!(found[0].contains("is named"), "{found:?}");
    }
}
