//! Opens what is no file for writing. A pipe that nobody reads is an error: it would wait for ever.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

/// `O_NONBLOCK` of Linux on its common processors, and of systems that stem from BSD.
const NOT_WAITING: Option<i32> = if cfg!(all(
    target_os = "linux",
    any(target_arch = "x86_64", target_arch = "x86", target_arch = "aarch64", target_arch = "arm")
)) {
    Some(0o4000)
} else if cfg!(any(target_os = "macos", target_os = "freebsd", target_os = "openbsd")) {
    Some(0x0004)
} else {
    None
};

/// Opens a device, a pipe or a socket.
pub(super) fn open(place: &Path) -> io::Result<File> {
    // The first one, which does not wait, shows that there is a reader; the second one writes as
    // slowly as that reads.
    let trial = trial(place)?;
    let file = OpenOptions::new().write(true).open(place);
    drop(trial);
    file
}

#[cfg(unix)]
fn trial(place: &Path) -> io::Result<Option<File>> {
    use std::os::unix::fs::OpenOptionsExt;
    let open = |flag| OpenOptions::new().write(true).custom_flags(flag).open(place);
    NOT_WAITING.map(open).transpose()
}

#[cfg(not(unix))]
fn trial(_place: &Path) -> io::Result<Option<File>> {
    Ok(None)
}
