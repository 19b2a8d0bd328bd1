//! Files for tests that the repository does not hold: photometric files, measured surfaces and
//! scenes of others, in `../shared/data` beside the workspace.
//!
//! A test whose files are missing fails, unless `QUASILUX_CORPUS=none` says that they are missing
//! on purpose. The test is then left out, says so on the standard error stream, and is counted by
//! `cargo xtask test`:
//!
//! ```no_run
//! let Some(folder) = quasilux_corpus::find("bsdf") else { return };
//! let bytes = std::fs::read(folder.join("klems-2011-SA1.xml")).unwrap();
//! ```
//!
//! Only tests and benchmarks use this crate.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The variable that tells, with the value `none`, that the files are missing on purpose.
pub const CORPUS: &str = "QUASILUX_CORPUS";

/// The variable with the name of a file that gets a line for each test left out.
pub const LEFT_OUT: &str = "QUASILUX_LEFT_OUT";

/// Where a file or a folder of the corpus is: `find("bsdf")`. `None` with `QUASILUX_CORPUS=none`,
/// after counting the calling test as left out.
///
/// # Panics
/// When it is not there and nobody said so.
#[must_use]
pub fn find(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data").join(name);
    let told = std::env::var_os(CORPUS).is_some_and(|value| value == "none");
    match decide(path.exists(), told) {
        Decision::UseFiles => Some(path),
        Decision::LeaveOut => {
            count(name);
            None
        }
        Decision::Fail => {
            panic!("{} is missing; {CORPUS}=none leaves out the tests that read it", path.display())
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Decision {
    UseFiles,
    LeaveOut,
    Fail,
}

fn decide(is_there: bool, is_missing_on_purpose: bool) -> Decision {
    match (is_missing_on_purpose, is_there) {
        (true, _) => Decision::LeaveOut,
        (false, true) => Decision::UseFiles,
        (false, false) => Decision::Fail,
    }
}

/// Tells of a test left out, past the test harness, which keeps what passing tests print.
fn count(name: &str) {
    let thread = std::thread::current();
    let line = format!("{}: left out without {name}\n", thread.name().unwrap_or("a test"));
    std::io::stderr().write_all(line.as_bytes()).expect("a place for messages");
    if let Some(list) = std::env::var_os(LEFT_OUT) {
        let file = OpenOptions::new().create(true).append(true).open(list);
        let written = file.and_then(|mut file| file.write_all(line.as_bytes()));
        written.expect("the list of tests left out can be written");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_fails_unless_it_is_missing_on_purpose() {
        assert_eq!(decide(true, false), Decision::UseFiles);
        assert_eq!(decide(false, false), Decision::Fail);
        assert_eq!(decide(false, true), Decision::LeaveOut);
        assert_eq!(decide(true, true), Decision::LeaveOut);
    }
}
