//! Area lights behind panes, all else black: the closed form for polygons, times what the panes let
//! through.

use crate::images::{add_panel, empty};
use crate::mirrored_area_lights::{Dice, Panel, add_light, assert_lx, polygon_lx};
use crate::scenes::points;
use glam::DVec3;
use quasilux_scene::Bsdf;
use quasilux_scene::bsdf::{AngularNode, AngularTable, Pane};
use std::f64::consts::FRAC_PI_2;

/// The same at all angles.
fn table(share: f64) -> AngularTable {
    let node = |theta_rad| AngularNode { theta_rad, share };
    AngularTable::new(vec![node(0.0), node(FRAC_PI_2)]).expect("angles ascend")
}

/// One to three panes that mirror nothing stand aslant between a light and sensor points, or some
/// of these: small lights, which directions do not meet, and large ones near the panes, which they
/// do.
#[test]
fn light_comes_through_panes_as_they_let_it() {
    for seed in 0..12 {
        let mut dice = Dice(40 + seed);
        let mut scene = empty();
        let edge_m = if seed % 2 == 0 { 0.03 } else { dice.between(0.5, 1.5) };
        let light = Panel { corner: DVec3::ZERO, u: DVec3::Y * edge_m, v: DVec3::X * edge_m };
        let Panel { corner, u, v } = light;
        add_light(&mut scene, light);
        let transmittances: Vec<f64> = (0..1 + seed % 3).map(|_| dice.between(0.3, 0.9)).collect();
        for (number, share) in (1..).zip(&transmittances) {
            let (transmittance, reflectance) = (table(*share), table(0.0));
            let pane = Bsdf::Pane(Pane::measured(transmittance, reflectance));
            let slope = DVec3::Z * dice.between(-0.02, 0.02);
            let corner = DVec3::new(-3.0, -9.0, -0.2 * f64::from(number));
            add_panel(&mut scene, corner, (DVec3::X + slope) * 9.0, DVec3::Y * 18.0, pane);
        }
        let all: f64 = transmittances.iter().product();
        let mut place = |x: f64| {
            let place = DVec3::new(x, dice.between(-1.0, 1.0), dice.between(-2.5, -1.5));
            let n = DVec3::new(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3), 1.0);
            (place, n.normalize())
        };
        // The last one sees the light past the panes.
        let past = (DVec3::new(-4.0, 0.3, -0.1), DVec3::new(1.0, 0.2, 0.3).normalize());
        let places = [place(-0.5), place(0.8), place(1.5), past];
        let corners = [corner, corner + u, corner + u + v, corner + v];
        let expected_lx = [all, all, all, 1.0]
            .into_iter()
            .zip(places)
            .map(|(share, (place, n))| share * polygon_lx(&corners, place, n));
        let expected_lx: Vec<f64> = expected_lx.collect();
        scene.sensors.push(points("probes", &places));
        assert_lx(&scene, seed, &expected_lx);
    }
}
