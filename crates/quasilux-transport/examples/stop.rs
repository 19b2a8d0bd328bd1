//! Watches a run, and stops it when its first point is known to 5 lx.
//!
//!     cargo run --release -p quasilux-transport --example stop

mod room;

use quasilux_transport::{Control, Estimates, Observer, Settings, simulate};

struct UntilFirstPoint;

impl Observer for UntilFirstPoint {
    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        let first = estimates.point_intervals(0)[0];
        println!("{} samples: {:.1} lx", estimates.samples, first.value);
        match first.half_width {
            Some(half_width) if half_width < 5.0 => Control::Stop,
            _ => Control::Continue,
        }
    }
}

fn main() {
    let settings = Settings { rel_tol: 1e-4, ..Settings::default() };
    let estimates = simulate(&room::room(), &settings, &mut UntilFirstPoint);
    // What a run has at its last checkpoint is its result.
    println!("stopped with {} samples", estimates.samples);
    assert!(estimates.point_intervals(0)[0].half_width.is_some_and(|it| it < 5.0));
}

#[test]
fn it_runs() {
    main();
}
