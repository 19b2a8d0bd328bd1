//! Runs until each point is known to 1 %, and prints the points with both of their numbers.
//!
//!     cargo run --release -p quasilux-transport --example illuminance

mod room;

use quasilux_transport::{Settings, check, simulate};

fn main() {
    let scene = room::room();
    let settings = Settings { rel_tol: 0.01, ..Settings::default() };
    check(&scene, &settings).expect("settings that make sense for the room");
    let estimates = simulate(&scene, &settings, &mut ());
    let unseen = estimates.sensors[0].unseen.as_ref().expect("the default bounds it");
    for (point, interval) in estimates.point_intervals(0).iter().enumerate() {
        let half_width = interval.half_width.expect("an interval");
        let unseen_lx = unseen.point_lx[point];
        println!("{point}: {:.1} ± {half_width:.1} lx, unseen {unseen_lx:.2} lx", interval.value);
    }
    assert!(estimates.tolerance_reached, "no limit was set");
}

#[test]
fn it_runs() {
    main();
}
