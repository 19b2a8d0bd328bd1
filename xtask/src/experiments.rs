//! `research/experiments.md` from the files of the experiments, so that text and figures cannot
//! drift apart.
//!
//! `research/experiments/page.md` is the text. In it `{{table NAME}}` stands for the tables and
//! claims that the experiment wrote, and `{{NAME: COLUMN where KEY=VALUE, KEY=VALUE as DIGITS}}`
//! for one figure of its CSV file, in the one row where all keys have these values; `as DIGITS %`
//! makes a share per cent. What an experiment writes for people names the CSV file written with it,
//! and itself, by their SHA-256: with other files nothing is generated.

use crate::wrap::wrap;
use sha2::{Digest, Sha256};
use std::path::Path;
use xtask::workspace::Failure;

/// Writes the page.
pub(crate) fn write(root: &Path) -> Result<(), Failure> {
    let path = root.join("research/experiments.md");
    std::fs::write(&path, page(root)?).map_err(|error| format!("{}: {error}", path.display()))?;
    println!("xtask: wrote {}", path.display());
    Ok(())
}

fn page(root: &Path) -> Result<String, Failure> {
    let folder = root.join("research/experiments");
    let read = |name: &str| {
        let path = folder.join(name);
        std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))
    };
    let text = read("page.md")?;
    let mut page = String::new();
    let mut rest = text.as_str();
    while let Some((before, after)) = rest.split_once("{{") {
        let (what, after) =
            after.split_once("}}").ok_or_else(|| format!("page.md: no }}}} after {before}"))?;
        page.push_str(before);
        let replaced = match what.strip_prefix("table ") {
            Some(name) => tables(&read(&format!("{name}.md"))?, &read(&format!("{name}.csv"))?),
            None => CsvCell::parse(what)
                .and_then(|place| figure(&place, &read(&format!("{}.csv", place.experiment))?)),
        };
        page.push_str(&replaced.map_err(|failure| format!("page.md: {{{{{what}}}}}: {failure}"))?);
        rest = after;
    }
    Ok(wrap(&(page + rest)))
}

/// All of what the experiment wrote but its title, headings a level lower.
fn tables(markdown: &str, csv: &str) -> Result<String, Failure> {
    let (text, digests) = markdown.split_once("\n<!-- ").ok_or("no digests end the tables")?;
    if !digests.contains(&digest(csv)) {
        return Err("the tables were not written together with the CSV file".into());
    }
    if !digests.contains(&digest(text)) {
        return Err("the tables are not as they were written".into());
    }
    let lines = text.lines().filter(|line| !line.starts_with("# "));
    let lowered = lines.map(|line| match line.starts_with("## ") {
        true => format!("#{line}\n"),
        false => format!("{line}\n"),
    });
    Ok(lowered.collect::<String>().trim().to_owned())
}

/// SHA-256 in hexadecimal.
fn digest(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Where a figure is, and how it is written.
struct CsvCell<'a> {
    experiment: &'a str,
    column: &'a str,
    keys: Vec<(&'a str, &'a str)>,
    digits: usize,
    is_share: bool,
}

impl<'a> CsvCell<'a> {
    fn parse(what: &'a str) -> Result<Self, Failure> {
        let wrong = || "expected NAME: COLUMN where KEY=VALUE, .. as DIGITS".to_owned();
        let (experiment, what) = what.split_once(": ").ok_or_else(wrong)?;
        let (what, form) = what.split_once(" as ").ok_or_else(wrong)?;
        let (column, keys) = what.split_once(" where ").ok_or_else(wrong)?;
        let pair = |pair: &'a str| pair.trim().split_once('=').ok_or_else(wrong);
        let (digits, is_share) = match form.strip_suffix(" %") {
            Some(digits) => (digits, true),
            None => (form, false),
        };
        Ok(Self {
            experiment,
            column,
            keys: keys.split(", ").map(pair).collect::<Result<_, _>>()?,
            digits: digits.parse().map_err(|_| wrong())?,
            is_share,
        })
    }
}

fn figure(place: &CsvCell<'_>, csv: &str) -> Result<String, Failure> {
    let mut lines = csv.lines();
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let column = |name: &str| {
        let found = header.iter().position(|own| *own == name);
        found.ok_or_else(|| format!("no column {name:?} in {header:?}"))
    };
    let keys = place.keys.iter().map(|(key, value)| Ok((column(key)?, *value)));
    let keys = keys.collect::<Result<Vec<(usize, &str)>, Failure>>()?;
    let rows = lines.map(|line| line.split(',').collect::<Vec<&str>>());
    let is_meant = |row: &Vec<&str>| keys.iter().all(|(key, value)| row.get(*key) == Some(value));
    let rows: Vec<Vec<&str>> = rows.filter(is_meant).collect();
    let [row] = rows.as_slice() else {
        return Err(format!("{} rows instead of one", rows.len()));
    };
    let cell = row.get(column(place.column)?).copied().unwrap_or_default();
    let number: f64 = cell.parse().map_err(|_| format!("{cell:?} is no number"))?;
    let digits = place.digits;
    Ok(if place.is_share {
        format!("{:.digits$} %", 100.0 * number)
    } else {
        format!("{number:.digits$}")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    const CSV: &str = "method,n,error\na,64,0.25\na,128,0.125\nb,64,0.5\n";

    #[test]
    fn the_committed_page_is_what_the_generator_writes() {
        let committed = std::fs::read_to_string(workspace_root().join("research/experiments.md"));
        assert!(
            committed.is_ok_and(|committed| committed == page(&workspace_root()).unwrap()),
            "research/experiments.md differs from its sources: run `cargo xtask experiments`"
        );
    }

    #[test]
    fn figures_are_taken_from_the_one_row_that_is_meant() {
        let got = |what: &str| figure(&CsvCell::parse(what)?, CSV);
        assert_eq!(got("x: error where method=a, n=128 as 3"), Ok("0.125".into()));
        assert_eq!(got("x: error where method=b, n=64 as 0 %"), Ok("50 %".into()));
        for wrong in [
            "x: error where method=a as 3",
            "x: error where method=c, n=64 as 3",
            "x: errors where method=b, n=64 as 3",
            "x: method where method=b, n=64 as 3",
            "x: error where method=b, n=64",
        ] {
            assert!(got(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn tables_belong_to_their_figures() {
        let text = "# Title\n\nText.\n\n## Claims\n\n- one\n";
        let markdown = format!("{text}\n<!-- {}, {} -->\n", digest(CSV), digest(text));
        assert_eq!(tables(&markdown, CSV), Ok("Text.\n\n### Claims\n\n- one".into()));
        assert!(tables(&markdown, "method\n").is_err());
        assert!(tables(&markdown.replace("one", "two"), CSV).is_err());
    }
}
