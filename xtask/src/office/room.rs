//! The shell of the room: floor, ceiling and walls with a door and two windows.
//!
//! Each face of the room is cut along the same lines, so that neighbours share their vertices: the
//! shell is closed, and every edge has exactly two faces.

use super::solids::Wavefront;
use std::collections::BTreeMap;

/// Inner size of the room.
pub(crate) const SIZE_MM: [i32; 3] = [6000, 5000, 2800];

/// Where the faces of the room are cut: at the edges of the windows and of the door.
const LINES_MM: [&[i32]; 3] =
    [&[0, 600, 2700, 3300, 5400, 6000], &[0, 400, 1300, 5000], &[0, 900, 2100, 2300, 2800]];

/// A part of a wall that has its own material.
struct Opening {
    material: &'static str,
    low_mm: [i32; 3],
    high_mm: [i32; 3],
}

const OPENINGS: [Opening; 3] = [
    Opening { material: "glass", low_mm: [600, 5000, 900], high_mm: [2700, 5000, 2300] },
    Opening { material: "glass", low_mm: [3300, 5000, 900], high_mm: [5400, 5000, 2300] },
    Opening { material: "door", low_mm: [6000, 400, 0], high_mm: [6000, 1300, 2100] },
];

/// A rectangle of the shell, counter-clockwise seen from inside.
type Quad = [[i32; 3]; 4];

/// Adds the shell to the file.
pub(crate) fn write(file: &mut Wavefront) {
    let mut by_material: BTreeMap<&str, Vec<Quad>> = BTreeMap::new();
    for quad in quads() {
        by_material.entry(material_of(&quad)).or_default().push(quad);
    }
    let mut positions: Vec<[i32; 3]> = by_material.values().flatten().flatten().copied().collect();
    positions.sort_unstable();
    positions.dedup();
    file.begin("room");
    let first = file.vertices(positions.iter().copied());
    for (material, quads) in by_material {
        file.material(material);
        for quad in quads {
            // Each corner is in the sorted list it was collected into.
            file.face(quad.map(|corner| first + positions.partition_point(|p| *p < corner)));
        }
    }
}

/// All rectangles of the shell.
fn quads() -> Vec<Quad> {
    let mut quads = Vec::new();
    for axis in 0..3 {
        let (along_u, along_v) = ((axis + 1) % 3, (axis + 2) % 3);
        for (end_mm, at_high_end) in [(0, false), (SIZE_MM[axis], true)] {
            for u in LINES_MM[along_u].windows(2) {
                for v in LINES_MM[along_v].windows(2) {
                    let mut quad = [(u[0], v[0]), (u[1], v[0]), (u[1], v[1]), (u[0], v[1])].map(
                        |(u_mm, v_mm)| {
                            let mut corner = [0; 3];
                            (corner[axis], corner[along_u], corner[along_v]) = (end_mm, u_mm, v_mm);
                            corner
                        },
                    );
                    // The cycle u, v turns about +axis, which is inward at the low end only.
                    if at_high_end {
                        quad.reverse();
                    }
                    quads.push(quad);
                }
            }
        }
    }
    quads
}

fn material_of(quad: &Quad) -> &'static str {
    let inside = |opening: &&Opening| {
        quad.iter().flatten().zip(opening.low_mm.iter().cycle()).all(|(x, low)| x >= low)
            && quad.iter().flatten().zip(opening.high_mm.iter().cycle()).all(|(x, high)| x <= high)
    };
    if let Some(opening) = OPENINGS.iter().find(inside) {
        return opening.material;
    }
    match quad.map(|[_, _, z]| z) {
        [0, 0, 0, 0] => "floor",
        z if z.iter().all(|z| *z == SIZE_MM[2]) => "ceiling",
        _ => "wall",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shell_is_closed_and_faces_inward() {
        let mut edges: BTreeMap<([i32; 3], [i32; 3]), i32> = BTreeMap::new();
        let mut six_volumes = 0_i64;
        for quad in quads() {
            for i in 0..4 {
                *edges.entry((quad[i], quad[(i + 1) % 4])).or_default() += 1;
            }
            for t in [[0, 1, 2], [0, 2, 3]] {
                let [a, b, c] = t.map(|i| quad[i].map(i64::from));
                six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
            }
        }
        for ((a, b), count) in &edges {
            assert_eq!((*count, edges.get(&(*b, *a))), (1, Some(&1)), "edge {a:?} {b:?}");
        }
        assert_eq!(six_volumes, -6 * SIZE_MM.map(i64::from).iter().product::<i64>());
    }

    #[test]
    fn door_and_windows_have_their_areas() {
        let area_mm2 = |material: &str| -> i64 {
            let parts = quads().into_iter().filter(|quad| material_of(quad) == material);
            parts
                .map(|quad| {
                    (0..3)
                        .map(|axis| {
                            let edge = i64::from(quad[2][axis] - quad[0][axis]).abs();
                            if edge == 0 { 1 } else { edge }
                        })
                        .product::<i64>()
                })
                .sum()
        };
        assert_eq!(area_mm2("door"), 900 * 2100);
        assert_eq!(area_mm2("glass"), 2 * 2100 * 1400);
        assert_eq!(area_mm2("floor"), 6000 * 5000);
        assert_eq!(area_mm2("ceiling"), 6000 * 5000);
    }
}
