//! Openings to the outside: right ones of any room are quiet, and wrong ones told.

use crate::room::{Case, Face};
use glam::DVec3;
use quasilux_inspection::Check;
use quasilux_sampling::radical_inverse;

const ROOMS: u32 = 40;
const SKY: &str = "[sky]\nmodel = \"cie\"\ntype = 1\nhorizontal_illuminance_lx = 10000\n";
const GLASS: &str = "[materials.glass]\nkind = \"pane\"\n";

/// A room with a window in its south wall.
struct Windowed {
    size: DVec3,
    /// Left, right, bottom and top of the window.
    window: [f64; 4],
    is_glazed: bool,
}

impl Windowed {
    fn random(number: u32) -> Self {
        let u = |dimension: u32| {
            radical_inverse([2, 3, 5, 7, 11, 13, 17, 19][dimension as usize], u64::from(number) + 1)
        };
        let size = DVec3::new(3.0 + 5.0 * u(0), 3.0 + 5.0 * u(1), 2.4 + 1.6 * u(2));
        let width = (0.3 + 0.5 * u(3)) * size.x;
        let left = 0.1 + u(4) * (size.x - width - 0.2);
        let bottom = 0.2 + 0.8 * u(5);
        let top = bottom + (0.4 + 0.5 * u(6)) * (size.z - bottom - 0.1);
        Self { size, window: [left, left + width, bottom, top], is_glazed: u(7) < 0.7 }
    }

    /// Its window, a wall of four pieces around it, and an opening.
    fn case(&self, opening: &str) -> Case {
        let DVec3 { x, z, .. } = self.size;
        let [left, right, bottom, top] = self.window;
        let piece = |[x0, x1, z0, z1]: [f64; 4], material| Face {
            object: "south",
            material,
            corners: [[x0, z0], [x0, z1], [x1, z1], [x1, z0]]
                .map(|[x, z]| DVec3::new(x, 0.0, z))
                .to_vec(),
        };
        let wall = [
            [0.0, x, 0.0, bottom],
            [0.0, x, top, z],
            [0.0, left, bottom, top],
            [right, x, bottom, top],
        ];
        let scale = self.size / DVec3::new(6.0, 4.0, 3.0);
        let case = Case::new().without("south").moved(|corner| corner * scale);
        let case = case.with(wall.map(|place| piece(place, "wall")));
        let case = if self.is_glazed { case.with([piece(self.window, "glass")]) } else { case };
        let glass = if self.is_glazed { GLASS } else { "" };
        let project = format!("{SKY}{glass}[[openings]]\n{opening}\n");
        case.say("u = [5, 0, 0]\nv = [0, 3, 0]", "u = [2, 0, 0]\nv = [0, 2, 0]")
            .say("position = [1.5, 2, 2.7]", "position = [1.5, 1, 2.3]")
            .say("position = [4.5, 2, 2.7]", "position = [2.5, 2, 2.3]")
            .add(&project)
    }

    fn opening(&self, moved: DVec3) -> String {
        let [left, right, bottom, top] = self.window;
        let origin = DVec3::new(left, 0.0, bottom) + moved;
        format!(
            "origin = {:?}\nu = [{}, 0, 0]\nv = [0, 0, {}]",
            origin.to_array(),
            right - left,
            top - bottom
        )
    }
}

/// In the plane of the window, a little before or behind it, and larger by its frame.
#[test]
fn openings_of_windows_are_right() {
    for number in 0..ROOMS {
        let room = Windowed::random(number);
        for behind_m in [0.0, 0.02, -0.02, -0.15] {
            let findings = room.case(&room.opening(DVec3::Y * behind_m)).findings();
            let told: Vec<String> = findings.iter().map(ToString::to_string).collect();
            assert!(told.is_empty(), "room {number}, {behind_m} m behind:\n{}", told.join("\n"));
        }
    }
}

#[test]
fn openings_elsewhere_are_told() {
    for number in 0..ROOMS {
        let room = Windowed::random(number);
        let DVec3 { x, y, z } = room.size;
        let [left, right, bottom, top] = room.window;
        let wrong = [
            ("in the wall across", room.opening(DVec3::new(0.0, y, 0.0))),
            ("before the wall across", room.opening(DVec3::new(0.0, y + 0.03, 0.0))),
            ("far outside", room.opening(DVec3::new(0.0, -40.0, 0.0))),
            ("beside the room", room.opening(DVec3::new(x + 1.0, 0.0, 0.0))),
            (
                "in millimetres",
                format!(
                    "origin = [{}, 0, {}]\nu = [{}, 0, 0]\nv = [0, 0, {}]",
                    1e3 * left,
                    1e3 * bottom,
                    1e3 * (right - left),
                    1e3 * (top - bottom)
                ),
            ),
            (
                "through the wall",
                format!(
                    "origin = [{}, {}, {bottom}]\nu = [0, {}, 0]\nv = [0, 0, {}]",
                    0.5 * x,
                    0.6 * y,
                    0.8 * y,
                    0.9 * (z - bottom)
                ),
            ),
        ];
        for (name, opening) in wrong {
            let findings = room.case(&opening).findings();
            let is_told = findings.iter().any(|finding| finding.check == Check::OpeningClosed);
            assert!(is_told, "room {number}, {name}: {findings:?}");
        }
    }
}
