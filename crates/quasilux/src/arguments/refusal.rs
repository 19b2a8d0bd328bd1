//! Arguments that make no sense: told in one line like everything else that is wrong, what it is
//! and what was expected, and the nearest name.

use super::Arguments;
use super::values::none_of;
use clap::Error;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::error::Error as _;

/// What is wrong with the arguments; `None` where nothing is, and the parser only has something to
/// show: help, or the version.
pub(crate) fn refusal(error: &Error) -> Option<String> {
    let text = match error.kind() {
        ErrorKind::DisplayHelp
        | ErrorKind::DisplayVersion
        | ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => return None,
        ErrorKind::ValueValidation => unreadable(error),
        ErrorKind::InvalidValue => outside(error),
        ErrorKind::UnknownArgument => unknown_argument(error),
        ErrorKind::InvalidSubcommand => {
            unknown_command(&word(error, ContextKind::InvalidSubcommand))
        }
        ErrorKind::MissingRequiredArgument => {
            let list = words(error, ContextKind::InvalidArg).join(", ");
            format!("{} lacks {list}{}", command(error), see(error))
        }
        ErrorKind::ArgumentConflict => conflict(error),
        _ => foreign(error),
    };
    Some(text)
}

/// A value that says nothing.
fn unreadable(error: &Error) -> String {
    let (name, value) = (argument(error), word(error, ContextKind::InvalidValue));
    let why = error.source().map(ToString::to_string).unwrap_or_default();
    refused(&name, &value, &why)
}

/// Message about the value of an option, with what was expected.
pub(crate) fn refused(name: &str, value: &str, why: &str) -> String {
    match why.starts_with("expected ") {
        true => format!("{name} is \"{value}\"; {why}"),
        false => format!("{name}: {why}"),
    }
}

/// A value that is none of a few, or is missing.
fn outside(error: &Error) -> String {
    let (name, value) = (argument(error), word(error, ContextKind::InvalidValue));
    let known = words(error, ContextKind::ValidValue).join(", ");
    if value.is_empty() {
        let whole = word(error, ContextKind::InvalidArg);
        let wanted = whole.split_once(' ').map_or(known.as_str(), |(_, wanted)| wanted);
        return format!("{name} lacks its value; expected {wanted}");
    }
    let nearest = words(error, ContextKind::SuggestedValue).into_iter().next();
    refused(&name, &value, &none_of(&known, nearest.as_deref()))
}

fn unknown_argument(error: &Error) -> String {
    let (name, command) = (word(error, ContextKind::InvalidArg), command(error));
    let nearest = nearest(error, ContextKind::SuggestedArg);
    let hint = if nearest.is_empty() { see(error) } else { nearest };
    match name.starts_with('-') {
        true => format!("unknown option \"{name}\" of {command}{hint}"),
        false => format!("unexpected \"{name}\" in the arguments of {command}{hint}"),
    }
}

/// A name that no command has.
pub(crate) fn unknown_command(name: &str) -> String {
    let known = Arguments::commands();
    let near = quasilux_scene::nearest(name, known.iter().map(String::as_str));
    let nearest = near.map_or_else(String::new, |near| format!("; did you mean \"{near}\"?"));
    format!("unknown command \"{name}\"; expected one of {}{nearest}", known.join(", "))
}

fn conflict(error: &Error) -> String {
    let name = argument(error);
    let others: Vec<String> =
        words(error, ContextKind::PriorArg).iter().map(|whole| option_of(whole)).collect();
    match others.join(", ") {
        others if others == name => format!("{name} is given twice; give it once"),
        others if others.is_empty() => format!("{name} excludes other arguments{}", see(error)),
        others => format!("{name} and {others} exclude each other; give one of them"),
    }
}

/// What the parser says of rarer faults, without its hints.
fn foreign(error: &Error) -> String {
    let text = error.to_string();
    let first = text.lines().next().unwrap_or_default();
    format!("{}{}", first.strip_prefix("error: ").unwrap_or(first), see(error))
}

/// The option or argument that is wrong, without its value.
fn argument(error: &Error) -> String {
    option_of(&word(error, ContextKind::InvalidArg))
}

/// `--seed` of `--seed <N>`.
fn option_of(whole: &str) -> String {
    whole.split(' ').next().unwrap_or(whole).to_owned()
}

/// The command that was given, from the line that shows its use.
fn command(error: &Error) -> String {
    let usage = word(error, ContextKind::Usage);
    let is_name = |word: &&str| word.starts_with(|c: char| c.is_ascii_lowercase());
    let names: Vec<&str> = usage.split_whitespace().skip(1).take_while(is_name).collect();
    let names = if names.is_empty() { "quasilux".to_owned() } else { names.join(" ") };
    format!("`{names}`")
}

/// Where more is to be read.
fn see(error: &Error) -> String {
    format!("; see `{} --help`", command(error).trim_matches('`'))
}

fn nearest(error: &Error, kind: ContextKind) -> String {
    let first = words(error, kind).into_iter().next();
    first.map_or_else(String::new, |name| format!("; did you mean \"{name}\"?"))
}

fn word(error: &Error, kind: ContextKind) -> String {
    words(error, kind).into_iter().next().unwrap_or_default()
}

fn words(error: &Error, kind: ContextKind) -> Vec<String> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => vec![text.clone()],
        Some(ContextValue::Strings(list)) => list.clone(),
        Some(ContextValue::StyledStr(text)) => vec![text.to_string()],
        Some(ContextValue::StyledStrs(list)) => list.iter().map(ToString::to_string).collect(),
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    fn said(arguments: &str) -> Option<String> {
        let words = std::iter::once("quasilux").chain(arguments.split_whitespace());
        refusal(&Arguments::try_parse_from(words).expect_err("a refusal"))
    }

    #[test]
    fn one_line_with_what_was_expected() {
        for (arguments, wanted) in [
            ("run x --rel-tol fine", "--rel-tol is \"fine\"; expected a share above 0"),
            ("run x --rel-tol 1", "--rel-tol: 1 stands for 100 %: was 1 % meant?"),
            ("run x --threads 0", "--threads is \"0\"; expected a whole number from 1 to 1024"),
            ("run x --out", "--out lacks its value; expected <DIR>"),
            ("run x --estimator pat", "--estimator is \"pat\"; expected one of auto, "),
            ("run x --estimator pat", "; did you mean \"path\"?"),
            ("run x --sampels 3", "unknown option \"--sampels\" of `quasilux run`; did you mean"),
            ("run x --qqqqqqqqq", "of `quasilux run`; see `quasilux run --help`"),
            ("run x y", "unexpected \"y\" in the arguments of `quasilux run`; see"),
            ("run", "`quasilux run` lacks <PROJECT>; see `quasilux run --help`"),
            ("rum", "unknown command \"rum\"; expected one of run, annual, check, sky"),
            ("rum", "; did you mean \"run\"?"),
            ("run x --seed 1 --seed 2", "--seed is given twice; give it once"),
            ("run x --plan p --seed 1", "--plan and --seed exclude each other; give one"),
            ("run x --json=3", "--json"),
            ("shard x", "`quasilux shard` lacks --plan <FILE>, "),
            ("experiment octave", "expected one of cube, dimension"),
            ("experiment octave", "; did you mean \"octant\"?"),
            ("completions csh", "expected one of bash"),
        ] {
            let said = said(arguments).expect("a message");
            assert!(said.contains(wanted) && !said.contains('\n'), "{arguments}: {said}");
        }
        for shown in ["--help", "run --help", "--version", ""] {
            assert_eq!(said(shown), None, "{shown}");
        }
    }
}
