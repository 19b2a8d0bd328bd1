//! The rooms of the cases as OBJ text.

use super::factors::Point;
use std::fmt::Write;

/// The room of the standard: 4 m x 4 m x 3 m, every face of its own material.
pub(super) const ROOM_M: Point = [4.0, 4.0, 3.0];
/// The cube of case 5.8.
pub(super) const CUBE_M: Point = [4.0; 3];
/// The panel of case 5.3 in the middle of the ceiling.
pub(super) const PANEL: [Point; 4] =
    [[1.5, 1.5, 3.0], [1.5, 2.5, 3.0], [2.5, 2.5, 3.0], [2.5, 1.5, 3.0]];
/// The obstruction of case 5.7, from wall to wall.
pub(super) const BOX: [Point; 2] = [[0.0, 2.5, 0.0], [4.0, 2.7, 1.0]];

/// Faces of a box by name: the walls x = 0, x = X, y = 0, y = Y, then floor and ceiling.
pub(super) const FACES: [&str; 6] = ["left", "right", "front", "back", "floor", "ceiling"];

/// A box from the origin on, seen from within, its faces named as [`FACES`].
pub(super) fn room_file(size_m: Point) -> String {
    let faces = box_faces([[0.0; 3], size_m]);
    file(FACES.into_iter().zip(faces).map(|(material, mut corners)| {
        corners.reverse();
        Quad { material, corners }
    }))
}

/// The panel, shining down.
pub(super) fn panel_file() -> String {
    file([Quad { material: "panel", corners: PANEL }])
}

/// The obstruction, seen from outside.
pub(super) fn box_file() -> String {
    file(box_faces(BOX).map(|corners| Quad { material: "box", corners }))
}

/// Corners of the six faces, counter-clockwise from outside.
fn box_faces([low, high]: [Point; 2]) -> [[Point; 4]; 6] {
    let face = |axis: usize, is_high: bool| {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |s: bool, t: bool| {
            let mut at = low;
            for (axis, is_high) in [(axis, is_high), (u, s), (v, t)] {
                at[axis] = if is_high { high[axis] } else { low[axis] };
            }
            at
        };
        let [a, b, c, d] =
            [corner(false, false), corner(true, false), corner(true, true), corner(false, true)];
        if is_high { [a, b, c, d] } else { [a, d, c, b] }
    };
    [face(0, false), face(0, true), face(1, false), face(1, true), face(2, false), face(2, true)]
}

/// Four corners of a face, named as its material.
pub(super) struct Quad {
    pub(super) material: &'static str,
    pub(super) corners: [Point; 4],
}

pub(super) fn file(quads: impl IntoIterator<Item = Quad>) -> String {
    let mut text = "# Written by `cargo xtask cie171`; metres, z up\n".to_owned();
    for Quad { material, corners } in quads {
        writeln!(text, "o {material}\nusemtl {material}").expect("strings grow");
        for [x, y, z] in corners {
            writeln!(text, "v {x} {y} {z}").expect("strings grow");
        }
        text.push_str("f -4 -3 -2 -1\n");
    }
    text
}
