//! Commands in a scene (`!`): what is understood of them. No shell and no program is ever started.

use super::generators::Generator;
use super::refusal::not_run;
use super::xform::Xform;

/// Most programs of a pipeline.
const MAX_STAGES: usize = 64;
/// Longest word of a command in bytes.
const MAX_WORD: usize = 1000;

/// A command that stands for entries.
#[derive(Clone, Debug)]
pub(super) struct Command {
    pub(super) source: Source,
    /// Each `xform` behind a `|`, in order.
    pub(super) stages: Vec<Xform>,
}

/// Where the entries come from.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// Files of the first `xform`.
    Files(Vec<String>),
    Generated(Generator),
}

impl Command {
    /// Reads the text behind the `!`.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let stages = split(text)?;
        if stages.len() > MAX_STAGES {
            return Err(format!("a pipeline of more than {MAX_STAGES} programs; expected fewer"));
        }
        if stages.iter().flatten().any(|word| word.len() > MAX_WORD) {
            return Err(format!("a word of more than {MAX_WORD} bytes; expected a shorter one"));
        }
        let mut stages = stages.into_iter();
        let first = stages.next().filter(|words| !words.is_empty());
        let first = first.ok_or_else(|| "a command without a name".to_owned())?;
        let name = program(&first[0]);
        let arguments = &first[1..];
        let (source, first) = if name == "xform" {
            let xform = Xform::parse(arguments)?;
            if xform.files.is_empty() {
                return Err("xform names no file; expected one behind its options".to_owned());
            }
            (Source::Files(xform.files.clone()), Some(xform))
        } else {
            (Source::Generated(Generator::parse(name, arguments)?), None)
        };
        let mut command = Self { source, stages: first.into_iter().collect() };
        for words in stages {
            match words.split_first() {
                Some((name, arguments)) if program(name) == "xform" => {
                    let xform = Xform::parse(arguments)?;
                    if !xform.files.is_empty() {
                        return Err("an xform behind | reads what comes before, and no \
                                    file"
                            .to_owned());
                    }
                    command.stages.push(xform);
                }
                Some((name, _)) => return Err(not_run(name)),
                None => return Err("nothing stands behind |; expected xform".to_owned()),
            }
        }
        Ok(command)
    }
}

/// The name of a program without folder and ending.
fn program(name: &str) -> &str {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    name.strip_suffix(".exe").unwrap_or(name)
}

/// Words of each stage of a pipeline.
fn split(text: &str) -> Result<Vec<Vec<String>>, String> {
    let mut stages = vec![Vec::new()];
    let mut word: Option<String> = None;
    let mut characters = text.chars();
    while let Some(c) = characters.next() {
        match c {
            '"' | '\'' => {
                let rest = characters.as_str();
                let Some((within, rest)) = rest.split_once(c) else {
                    return Err(format!("a quote ({c}) that does not end; expected another one"));
                };
                word.get_or_insert_default().push_str(within);
                characters = rest.chars();
            }
            // A comment of the shell.
            '#' if word.is_none() => break,
            '\\' => word.get_or_insert_default().extend(characters.next()),
            '|' | ' ' | '\t' | '\r' | '\n' => {
                let last = stages.last_mut().expect("a stage is there from the start");
                last.extend(word.take());
                if c == '|' {
                    stages.push(Vec::new());
                }
            }
            ';' | '&' | '<' | '>' | '`' | '$' | '(' | ')' => {
                let first = stages[0].first().cloned().or(word).unwrap_or_default();
                return Err(format!(
                    "{c} in a command asks for a shell, and none is started; {}",
                    not_run(&first)
                ));
            }
            _ => word.get_or_insert_default().push(c),
        }
    }
    let last = stages.last_mut().expect("a stage is there from the start");
    last.extend(word);
    Ok(stages)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(text: &str) -> String {
        Command::parse(text).err().unwrap_or_else(|| panic!("{text} is read"))
    }

    #[test]
    fn pipelines_of_what_is_known_are_read() {
        let command = Command::parse("genbox m b 1 2 3 | xform -t 1 0 0|xform -rz 9").unwrap();
        assert!(matches!(command.source, Source::Generated(_)) && command.stages.len() == 2);
        let command = Command::parse("/usr/bin/xform -t 0 0 1 \"a b.rad\" c.rad").unwrap();
        let Source::Files(files) = command.source else { panic!("files") };
        assert_eq!(files, ["a b.rad", "c.rad"]);
    }

    #[test]
    fn comments_end_a_command() {
        let Source::Files(files) = Command::parse("xform a#1.rad # north").unwrap().source else {
            panic!("files")
        };
        assert_eq!(files, ["a#1.rad"]);
    }

    #[test]
    fn everything_else_is_refused_by_name() {
        assert!(refusal("rm -rf x").contains("\"rm\" is not run"));
        assert!(refusal("cat a.rad").contains("\"cat\" is not run"));
        assert!(refusal("xform a.rad | tee b").contains("\"tee\" is not run"));
        assert!(refusal("xform a.rad; rm b").contains("asks for a shell"));
        assert!(refusal("xform $(rm b)").contains("asks for a shell"));
        assert!(refusal("xform a.rad > b").contains("asks for a shell"));
        assert!(refusal("xform -t 1 2 3").contains("names no file"));
        assert!(refusal("xform \"a.rad").contains("does not end"));
        let pipeline = format!("genbox m b 1 1 1{}", "|xform".repeat(100_000));
        assert!(refusal(&pipeline).contains("more than 64 programs"));
        let name = "n".repeat(2000);
        assert!(refusal(&format!("genblinds m {name} 1 1 1 9 0")).contains("more than 1000 bytes"));
        assert!(refusal("").contains("without a name"));
        assert!(refusal("xform a.rad |").contains("behind |"));
        assert!(refusal("xform a.rad | xform b.rad").contains("no file"));
        assert!(refusal("gensurf m n x y z 9 9").contains("\"gensurf\" is not run"));
    }
}
