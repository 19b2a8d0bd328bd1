//! Work on a disk that is full for a while, a file system of its own in memory.

use super::works::{self, RESCUE, Work};
use super::{complete, finish};
use quasilux_stats::deep;
use std::process::{Command, Stdio};

/// KiB of the disk, and how many of them are left.
const DISK_KIB: usize = 2048;
const LEFT_KIB: [usize; 8] = [16, 0, 4, 8, 32, 64, 128, 512];

/// What the shell ends with where nobody may mount a disk.
const MAY_NOT: i32 = 99;

/// Begins on the full disk, goes on when there is room again, and takes the results out of it.
const SCRIPT: &str = "mount -t tmpfs -o size=${disk}k none small || exit 99
head -c ${filler}k /dev/zero >small/filler
\"$program\" \"$@\"; began=$?
rm small/filler
if test -e small/$kept || test -e small/$kept.previous
then \"$program\" resume small/$kept --quiet
else \"$program\" \"$@\"
fi; ended=$?
cp -r small/out . && echo began $began ended $ended";

/// The first step of `work` on a disk with so much room; `None` where nobody may mount one.
fn fill(work: &Work, left_kib: usize) -> Option<String> {
    let step = &work.steps[0];
    let kept = step.kept.expect("it keeps itself");
    let moved = |word: &&str| match *word {
        "out" => "small/out".to_owned(),
        word if word == kept => format!("small/{kept}"),
        word => word.to_owned(),
    };
    std::fs::create_dir(work.folder.path("small")).expect("folders can be made");
    let mut shell = Command::new("unshare");
    shell.args(["-rm", "sh", "-c", SCRIPT, "sh"]).args(step.begin.iter().map(moved));
    shell.env("program", env!("CARGO_BIN_EXE_quasilux")).env("kept", kept);
    shell.env("disk", DISK_KIB.to_string()).env("filler", (DISK_KIB - left_kib).to_string());
    shell.env("TMPDIR", work.folder.path(RESCUE)).current_dir(work.folder.path(""));
    shell.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let run = finish(shell.spawn().ok()?);
    let is_refused = run.code == Some(MAY_NOT) || run.stderr.contains("unshare");
    (!is_refused).then(|| run.stdout + &run.stderr)
}

/// With less room than the results need it fails, and says so; then it ends as if nothing had been.
#[test]
fn a_disk_that_was_full_changes_no_bit() {
    let works = works::all("filled");
    // A run; in the deep variant a year too, and more rooms.
    let [rooms, count] = if deep() { [LEFT_KIB.len(), 2] } else { [1, 1] };
    for work in &works[..count] {
        work.clear();
        complete(work, &work.steps[0]);
        let expected = work.products();
        for left_kib in &LEFT_KIB[..rooms] {
            work.clear();
            let Some(told) = fill(work, *left_kib) else {
                println!("left out: this user may not mount a disk");
                return;
            };
            let begin = &work.steps[0].begin;
            assert!(told.contains(" ended 3\n"), "{begin:?}, {left_kib} KiB: {told}");
            if *left_kib <= 16 {
                assert!(told.contains("began 2 "), "{begin:?}, {left_kib} KiB: {told}");
                assert!(told.contains("No space left on device"), "{begin:?}: {told}");
            }
            assert!(work.products() == expected, "{begin:?}, {left_kib} KiB: {told}");
        }
    }
}
