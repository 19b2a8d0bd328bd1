//! The processor time of a thread, or of all: what others do on the machine meanwhile counts less.

use std::ffi::{c_int, c_long};

#[repr(C)]
struct Timespec {
    seconds: i64,
    nanoseconds: c_long,
}

unsafe extern "C" {
    fn clock_gettime(clock: c_int, time: *mut Timespec) -> c_int;
}

const CLOCK_PROCESS_CPUTIME_ID: c_int = if cfg!(target_os = "macos") { 12 } else { 2 };
const CLOCK_THREAD_CPUTIME_ID: c_int = if cfg!(target_os = "macos") { 16 } else { 3 };

/// Seconds that this thread has spent on a processor.
#[must_use]
pub fn processor_seconds() -> f64 {
    seconds(CLOCK_THREAD_CPUTIME_ID)
}

/// Seconds that all threads of this program have spent on processors, together.
#[must_use]
pub fn all_processors_seconds() -> f64 {
    seconds(CLOCK_PROCESS_CPUTIME_ID)
}

fn seconds(clock: c_int) -> f64 {
    let mut time = Timespec { seconds: 0, nanoseconds: 0 };
    // SAFETY: the structure has the layout that POSIX gives it on 64-bit machines.
    unsafe { clock_gettime(clock, &raw mut time) };
    time.seconds as f64 + 1e-9 * time.nanoseconds as f64
}
