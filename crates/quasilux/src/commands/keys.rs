//! `quasilux keys`: the keys of the project file, as its reader has them.

use crate::arguments::KeysArguments;
use crate::exit::{CliError, Exit};
use crate::print::print;
use quasilux_scene::project::{Key, KeyTable, reference};
use std::fmt::Write;

/// Prints the keys of one section or of all.
pub(crate) fn keys(arguments: &KeysArguments) -> Result<Exit, CliError> {
    let is_wanted = |table: &KeyTable| match &arguments.section {
        Some(section) => table.name() == section,
        None => true,
    };
    let tables: Vec<KeyTable> = reference().into_iter().filter(is_wanted).collect();
    print(&if arguments.markdown { markdown(&tables) } else { plain(&tables) })?;
    Ok(Exit::Done)
}

/// For the terminal: two lines a key.
fn plain(tables: &[KeyTable]) -> String {
    let mut text = String::new();
    for KeyTable { section, kind, about, keys } in tables {
        let gap = if text.is_empty() { "" } else { "\n" };
        let kind = if kind.is_empty() { String::new() } else { format!("  {kind}") };
        writeln!(text, "{gap}{section}{kind}\n  {about}").expect("strings grow");
        let width = keys.iter().map(|key| key.name.len()).max().unwrap_or_default();
        for key in *keys {
            let Key { name, takes, default, meaning } = key;
            let default = match default {
                Some(default) => format!("[default: {default}]"),
                None => "[required]".to_owned(),
            };
            writeln!(text, "  {name:width$}  {takes} {default}").expect("strings grow");
            writeln!(text, "  {:width$}  {meaning}", "").expect("strings grow");
        }
    }
    text.replace('`', "")
}

/// For a page: a heading a section, one below it a kind, and a row a key.
fn markdown(tables: &[KeyTable]) -> String {
    let mut text = String::new();
    let mut last = "";
    for KeyTable { section, kind, about, keys } in tables {
        if *section != last {
            writeln!(text, "\n## `{section}`").expect("strings grow");
        }
        if !kind.is_empty() {
            writeln!(text, "\n### `{kind}`").expect("strings grow");
        }
        last = section;
        writeln!(text, "\n{about}.\n").expect("strings grow");
        text.push_str("| key | takes | left out | meaning |\n|---|---|---|---|\n");
        for key in *keys {
            let Key { name, takes, default, meaning } = key;
            let default = default.unwrap_or("required");
            writeln!(text, "| `{name}` | {takes} | {default} | {meaning} |").expect("strings grow");
        }
    }
    text
}
