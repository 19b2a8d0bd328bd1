//! Cuts a run into two parts, as for two machines, and puts them together.
//!
//!     cargo run --release -p quasilux-transport --example parts

mod room;

use quasilux_transport::{Settings, merge, trace_part};

/// Samples of each point in each replicate: no part knows when the others have enough.
const SAMPLES: u64 = 256;

fn main() {
    let scene = room::room();
    let settings = Settings { max_samples: Some(SAMPLES), ..Settings::default() };
    let part = |indices| trace_part(&scene, &settings, SAMPLES, indices, &mut ()).expect("whole");
    let parts = [part(0..100), part(100..SAMPLES)];
    println!("parts of {} and {} bytes", parts[0].len(), parts[1].len());
    let parts: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
    let estimates = merge(&scene, &settings, SAMPLES, &parts, &mut ()).expect("all indices");
    let whole = part(0..SAMPLES);
    let in_one = merge(&scene, &settings, SAMPLES, &[&whole], &mut ()).expect("all indices");
    assert!(estimates.sensors == in_one.sensors, "the same bits however it is cut");
    for interval in estimates.point_intervals(0) {
        println!("{:.1} ± {:.1} lx", interval.value, interval.half_width.expect("an interval"));
    }
}

#[test]
fn it_runs() {
    main();
}
