//! Sensors in the dark, each with the reason.

use crate::room::{Case, body, plate};
use glam::DVec3;
use quasilux_inspection::Check;

fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

const CEILING: &str = "[materials.ceiling]\nreflectance = 0.8\n";

/// A sensor of one point.
fn probe(position: &str, normal: &str) -> String {
    format!(
        "[[sensors]]\nname = \"probe\"\nkind = \"points\"\npoints = [{position}]\n\
         normals = [{normal}]\n"
    )
}

/// What is said if no light was found at the last sensor.
fn reason(case: &Case) -> String {
    let findings = case.darkness(&[1]);
    let [finding] = findings.as_slice() else { panic!("not one: {findings:?}") };
    assert_eq!(finding.check, Check::SensorDark);
    assert!(finding.position_m.is_some());
    let line = case.project.lines().nth(finding.place.unwrap().line - 1).unwrap();
    assert_eq!(line, "[[sensors]]");
    finding.message.clone() + "; " + &finding.cure
}

#[test]
fn a_box_keeps_light_out() {
    // Four walls and a lid on the floor: no closed body, yet no way in.
    let sides = body("hood", v(4.0, 3.0, -0.1), v(5.0, 3.8, 2.0));
    let case =
        Case::new().with(sides.into_iter().skip(1)).add(&probe("[4.5, 3.4, 1]", "[0, 0, 1]"));
    let told = reason(&case);
    assert!(told.contains("\"hood\" stands in front of the nearest lamp"), "{told}");
    assert!(
        told.contains("at 1 point of 1 of sensor \"probe\", for example at [4.5, 3.4, 1]"),
        "{told}"
    );
}

#[test]
fn nothing_is_before_a_sensor_that_looks_at_the_sky() {
    let mut case = Case::new().say(CEILING, "");
    case.faces.retain(|face| ["floor", "west"].contains(&face.object));
    let case = case.add(&probe("[3, 2, 2.9]", "[0, 0, 1]"));
    let told = reason(&case);
    assert!(told.contains("no surface and no lamp is in front of it"), "{told}");
}

#[test]
fn lamps_that_shine_elsewhere_are_told() {
    // Black all round: what shines down is not sent up again.
    let black = |case: Case, material: &str, old: &str| {
        case.say(
            &format!("[materials.{material}]\nreflectance = {old}"),
            &format!("[materials.{material}]\nreflectance = 0"),
        )
    };
    let case = black(black(black(Case::new(), "floor", "0.3"), "ceiling", "0.8"), "wall", "0.6");
    let case = case.without("ceiling").with([plate(
        "roof",
        "ceiling",
        [v(0.0, 0.0, 9.0), v(6.0, 4.0, 9.0)],
        false,
    )]);
    let case = case.add(&probe("[3, 2, 5]", "[0, 0, 1]"));
    let told = reason(&case);
    assert!(told.contains("no lamp shines toward it"), "{told}");
}

#[test]
fn light_that_was_missed_is_no_fault_of_the_scene() {
    let told = reason(&Case::new().add(&probe("[3, 2, 1]", "[0, 0, 1]")));
    assert!(told.contains("light gets there, but rarely; give it more time"), "{told}");
}

#[test]
fn sensors_that_were_named_before_are_passed_over() {
    let case = Case::new().add(&probe("[3, 2, 7]", "[0, 0, 1]"));
    assert!(case.findings().iter().any(|it| it.check == Check::SensorOutside));
    assert_eq!(case.darkness(&[1]), []);
    assert_eq!(Case::new().darkness(&[]), []);
}

/// Which loaders tell: a point of a grid in a table leg is no second fault.
#[test]
fn points_in_closed_bodies_are_told_by_loaders_alone() {
    let table = body("table", v(2.0, 1.5, 0.1), v(3.0, 2.5, 1.2));
    let grid = "[[sensors]]\nname = \"grid\"\nkind = \"grid\"\norigin = [2.4, 1.9, 0.8]\n\
                u = [3, 0, 0]\nv = [0, 0.2, 0]\ncounts = [6, 1]\n";
    assert_eq!(Case::new().with(table).add(grid).darkness(&[1]), []);
    assert_eq!(Case::new().add(grid).darkness(&[1]).len(), 1);
}
