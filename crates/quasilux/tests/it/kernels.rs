//! The ray kernel of choice: named by the environment, told by `--version`, and of no consequence.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, Run, without_seconds_and_threads};
use quasilux_bvh::SimdLevel;

const VARIABLE: &str = "QUASILUX_KERNEL";

fn with_kernel(folder: &Folder, kernel: &str, arguments: &[&str]) -> Run {
    let mut command = folder.command(arguments);
    Run::new(command.env(VARIABLE, kernel).output().expect("the program starts"))
}

#[test]
fn version_says_which_kernel_runs_and_all_give_the_same_bits() {
    let folder = Folder::new("kernels");
    write_room(&folder, "room", &Look::GREY);
    let run = ["run", "room.toml", "--quiet", "--json", "--samples", "64"];
    let mut documents = SimdLevel::all().into_iter().map(|level| {
        let version = with_kernel(&folder, level.name(), &["--version"]).stdout;
        let lines: Vec<&str> = version.lines().collect();
        assert_eq!(lines[0], format!("quasilux {}", env!("CARGO_PKG_VERSION")));
        let commit = lines[1].strip_prefix("commit: ").expect("a commit");
        let is_digits =
            |text: &str| text.len() == 12 && text.bytes().all(|b| b.is_ascii_hexdigit());
        assert!(commit == "unknown" || is_digits(commit), "{version}");
        let kernel = format!("ray kernel: {}, of ", level.name());
        assert!(lines[2].starts_with(&kernel), "{version}");
        without_seconds_and_threads(&with_kernel(&folder, level.name(), &run).stdout)
    });
    let first = documents.next().expect("a portable kernel");
    assert!(documents.all(|other| other == first));
}

#[test]
fn a_kernel_that_is_not_here_is_refused() {
    let folder = Folder::new("kernels_refused");
    let refused = with_kernel(&folder, "sse9", &["validate", "cube"]);
    assert_eq!(refused.code, Some(2));
    assert!(refused.stderr.contains("QUASILUX_KERNEL is \"sse9\"; expected one of portable"));
    assert_eq!(with_kernel(&folder, "", &["--version"]).code, Some(0));
}
