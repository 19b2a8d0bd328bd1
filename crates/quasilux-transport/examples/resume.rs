//! Keeps the state of a run that is stopped, and goes on from it to the bits of a run that nothing
//! stopped.
//!
//!     cargo run --release -p quasilux-transport --example resume

mod room;

use quasilux_transport::{Control, Estimates, Observer, Settings, resume, simulate};

/// Keeps the last state, and stops at the second checkpoint.
#[derive(Default)]
struct Keeper {
    state: Vec<u8>,
    checkpoints: u32,
}

impl Observer for Keeper {
    fn piece(&self) -> Option<u64> {
        Some(1 << 12)
    }

    fn wants_state(&mut self) -> bool {
        true
    }

    fn state(&mut self, state: &[u8]) {
        self.state = state.to_vec();
    }

    fn checkpoint(&mut self, _estimates: &Estimates) -> Control {
        self.checkpoints += 1;
        if self.checkpoints < 2 { Control::Continue } else { Control::Stop }
    }
}

fn main() {
    let scene = room::room();
    let settings = Settings { rel_tol: 0.01, ..Settings::default() };
    let mut keeper = Keeper::default();
    let stopped = simulate(&scene, &settings, &mut keeper);
    let whole = resume(&scene, &settings, &keeper.state, &mut ()).expect("a state of this run");
    println!("stopped with {} samples, ended with {}", stopped.samples, whole.samples);
    let same = whole.sensors == simulate(&scene, &settings, &mut ()).sensors;
    println!("the bits of a run in one piece: {same}");
    assert!(same);
}

#[test]
fn it_runs() {
    main();
}
