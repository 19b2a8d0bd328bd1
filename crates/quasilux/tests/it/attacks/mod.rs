//! Inputs that ask for more than a machine has: the program refuses them or ends, within a bound of
//! memory and of time, and says why.

mod counts;
mod files;
mod generated;
mod outputs;
mod seeds;

use crate::scenes::{Look, write_room};
use crate::support::{Folder, Run};
use std::process::{Command, Stdio};

/// Address space of the program in KiB: the memory that it may take, and what its threads reserve.
const MAX_KIB: u64 = 1_500_000;
/// Seconds before the program is killed: no test waits for one that has no end.
const MAX_SECONDS: &str = "60";
/// What `timeout` ends with then.
const TIME_IS_UP: i32 = 124;

/// The program on two threads, within these bounds.
fn limited(folder: &Folder, arguments: &[&str]) -> Run {
    Run::new(command(folder, arguments, "").output().expect("the shell starts"))
}

/// The same with its standard streams elsewhere, like `>/dev/full`.
fn redirected(folder: &Folder, arguments: &[&str], streams: &str) -> Run {
    Run::new(command(folder, arguments, streams).output().expect("the shell starts"))
}

fn command(folder: &Folder, arguments: &[&str], streams: &str) -> Command {
    let script =
        format!("ulimit -v {MAX_KIB}; exec timeout -s KILL -k 1 {MAX_SECONDS} \"$@\" {streams}");
    let mut command = Command::new("sh");
    command.args(["-c", &script, "sh", env!("CARGO_BIN_EXE_quasilux")]).args(arguments);
    command.current_dir(folder.path("")).stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Whether the program ended by itself and as documented: with one of its exit codes, and one
/// message where that is 2.
fn fault_of(run: &Run) -> Option<String> {
    let fault = match run.code {
        Some(0 | 1 | 3) => (!run.stderr.is_empty() && run.stderr.contains("panicked"))
            .then(|| "a panic".to_owned()),
        Some(2) => {
            let messages = run.stderr.lines().filter(|line| line.starts_with("error: ")).count();
            (messages == 0 || run.stderr.contains("panicked"))
                .then(|| format!("{messages} messages"))
        }
        Some(TIME_IS_UP | 137) | None => Some("killed".to_owned()),
        Some(code) => Some(format!("exit code {code}")),
    };
    let start: String = run.stderr.chars().take(600).collect();
    fault.map(|fault| format!("{fault}: {start}"))
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
