//! Ctrl-C and SIGTERM: the first one ends the run in order, the second one at once.
//!
//! A run looks many times a second whether it is to end. What comes before its first look, such as
//! a scene that is made ready, looks never: there the program ends when nobody has looked for a
//! while, and nothing is lost, for nothing was known.

use crate::exit::{CliError, Exit};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
/// Whether the run ends in order: somebody has seen that, or there are results, which are put out
/// whatever happens.
static ENDS_IN_ORDER: AtomicBool = AtomicBool::new(false);

/// Nobody looks for so long where nobody looks at all.
const PATIENCE: Duration = Duration::from_millis(1500);

/// Listens from now on.
pub(crate) fn listen() -> Result<(), CliError> {
    ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            std::process::exit(Exit::Interrupted as i32);
        }
        std::thread::spawn(|| {
            std::thread::sleep(PATIENCE);
            if !ENDS_IN_ORDER.load(Ordering::Relaxed) {
                std::process::exit(Exit::Interrupted as i32);
            }
        });
    })
    .map_err(|error| CliError::new(format!("cannot listen for interrupts: {error}")))
}

/// From now on a file that grows beyond what this process may write is an error of that file, as a
/// full disk is, and not the end of the process.
pub(crate) fn survive_file_limits() {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    {
        const SIGXFSZ: i32 = 25;
        let nobody_asks = std::sync::Arc::default();
        // Without it the process ends as it did.
        _ = signal_hook::flag::register(SIGXFSZ, nobody_asks);
    }
}

/// Whether the user has asked to stop.
pub(crate) fn requested() -> bool {
    let is_requested = INTERRUPTED.load(Ordering::Relaxed);
    if is_requested {
        ENDS_IN_ORDER.store(true, Ordering::Relaxed);
    }
    is_requested
}

/// From here on there are results, which an interrupt does not lose.
pub(crate) fn keep_results() {
    ENDS_IN_ORDER.store(true, Ordering::Relaxed);
}
