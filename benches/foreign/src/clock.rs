//! The processor time of a thread: what others do on the machine meanwhile counts less.

use std::ffi::{c_int, c_long};

#[repr(C)]
struct Timespec {
    seconds: i64,
    nanoseconds: c_long,
}

unsafe extern "C" {
    fn clock_gettime(clock: c_int, time: *mut Timespec) -> c_int;
}

const CLOCK_THREAD_CPUTIME_ID: c_int = if cfg!(target_os = "macos") { 16 } else { 3 };

/// Seconds that this thread has spent on a processor.
#[must_use]
pub fn processor_seconds() -> f64 {
    let mut time = Timespec { seconds: 0, nanoseconds: 0 };
    // SAFETY: the structure has the layout that POSIX gives it on 64-bit machines.
    unsafe { clock_gettime(CLOCK_THREAD_CPUTIME_ID, &raw mut time) };
    time.seconds as f64 + 1e-9 * time.nanoseconds as f64
}
