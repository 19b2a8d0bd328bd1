//! Signs of life on a stderr that is no terminal, a file or a pipe, where no bar can be drawn: now
//! and then a line that says how far the work is.

#![allow(clippy::disallowed_methods, reason = "work is watched by the clock")]

use crate::print::tell;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Between two lines.
const EVERY: Duration = Duration::from_secs(8);

/// Tells the last that it was told, until it is dropped.
pub(crate) struct Heartbeat {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

#[derive(Default)]
struct Shared {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    news: String,
    is_over: bool,
}

impl Heartbeat {
    /// Begins to tell, `news` before there are others.
    pub(crate) fn new(news: &str) -> Self {
        let state = State { news: news.to_owned(), is_over: false };
        let shared = Arc::new(Shared { state: Mutex::new(state), changed: Condvar::new() });
        let own = Arc::clone(&shared);
        let start = Instant::now();
        let beat = move || {
            let mut state = own.lock();
            loop {
                let waited = own.changed.wait_timeout_while(state, EVERY, |state| !state.is_over);
                state = waited.unwrap_or_else(PoisonError::into_inner).0;
                if state.is_over {
                    break;
                }
                tell(format_args!("{:.0} s: {}", start.elapsed().as_secs_f64(), state.news));
            }
        };
        // Without a thread for it there are no signs.
        Self { shared, thread: std::thread::Builder::new().spawn(beat).ok() }
    }

    /// What is told next.
    pub(crate) fn set(&self, news: &str) {
        news.clone_into(&mut self.shared.lock().news);
    }
}

impl Drop for Heartbeat {
    fn drop(&mut self) {
        self.shared.lock().is_over = true;
        self.shared.changed.notify_all();
        if let Some(thread) = self.thread.take() {
            _ = thread.join();
        }
    }
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
