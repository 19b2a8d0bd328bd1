//! Inputs that ask for more than a machine has: the program refuses them or ends, within a bound of
//! memory and of time, and says why.

mod changes;
mod counts;
mod files;
mod generated;
mod outputs;
mod seeds;
mod years;

use crate::scenes::{Look, write_room};
use crate::support::{Folder, Run};
use std::process::{Command, Stdio};

/// Address space of the program in KiB: the memory that it may take, and what its threads reserve.
const MAX_KIB: u64 = 1_500_000;
/// Before the program is killed: no test waits for one that has no end.
#[derive(Clone, Copy)]
struct Seconds(u32);
const MAX_SECONDS: Seconds = Seconds(60);
/// What `timeout` ends with then.
const TIME_IS_UP: i32 = 124;

/// The program on two threads, within these bounds.
fn limited(folder: &Folder, arguments: &[&str]) -> Run {
    limited_for(MAX_SECONDS, folder, arguments)
}

/// The same with another bound of time.
fn limited_for(time: Seconds, folder: &Folder, arguments: &[&str]) -> Run {
    Run::new(command(time, folder, arguments, "").output().expect("the shell starts"))
}

/// The same with its standard streams elsewhere, like `>/dev/full`.
fn redirected(folder: &Folder, arguments: &[&str], streams: &str) -> Run {
    Run::new(command(MAX_SECONDS, folder, arguments, streams).output().expect("the shell starts"))
}

fn command(time: Seconds, folder: &Folder, arguments: &[&str], streams: &str) -> Command {
    let Seconds(time) = time;
    let script = format!("ulimit -v {MAX_KIB}; exec timeout -s KILL -k 1 {time} \"$@\" {streams}");
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_quasilux")]).args(arguments);
    command.current_dir(folder.path("")).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Whether the program ended by itself and as documented: with one of its exit codes, one message
/// where that is 2, and nothing that a terminal obeys.
fn fault_of(run: &Run) -> Option<String> {
    let has_panicked = run.stderr.contains("panicked");
    let is_plain = |text: &str| text.chars().all(|c| c == '\n' || !is_command(c));
    let messages = run.stderr.lines().filter(|line| line.starts_with("error: ")).count();
    let fault = match run.code {
        Some(TIME_IS_UP | 137) | None => "killed".to_owned(),
        _ if has_panicked => "a panic".to_owned(),
        Some(2) if messages == 0 => "no message".to_owned(),
        Some(0..=3) if is_plain(&run.stderr) && is_plain(&run.stdout) => return None,
        Some(0..=3) => "control characters".to_owned(),
        Some(code) => format!("exit code {code}"),
    };
    let start: String = run.stderr.chars().take(600).collect();
    Some(format!("{fault}: {start:?}"))
}

/// Whether a terminal obeys it instead of showing it.
fn is_command(c: char) -> bool {
    c.is_control() || ('\u{202a}'..='\u{202e}').contains(&c)
}

/// Asserts exit code 2 and a message with all of these words.
fn assert_refused(what: &str, run: &Run, words: &[&str]) {
    assert_eq!(fault_of(run), None, "{what}");
    assert_eq!(run.code, Some(2), "{what}: {}", run.stderr);
    for word in words {
        assert!(run.stderr.contains(word), "{what}: no {word:?} in {}", run.stderr);
    }
}

fn room(name: &str) -> Folder {
    let folder = Folder::new(&format!("attacks_{name}"));
    write_room(&folder, "room", &Look::GREY);
    folder
}
