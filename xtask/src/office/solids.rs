//! Closed boxes in whole millimetres, and the OBJ text they become.

use std::fmt::Write;

/// A closed axis-aligned box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Block {
    /// The corner with the lowest coordinates.
    pub(crate) low_mm: [i32; 3],
    /// The corner with the highest coordinates.
    pub(crate) high_mm: [i32; 3],
    /// The name of its material.
    pub(crate) material: &'static str,
}

/// A named piece of furniture.
#[derive(Clone, Debug)]
pub(crate) struct Object {
    /// Its name in the OBJ file.
    pub(crate) name: String,
    /// Its parts; no two boxes of a room touch.
    pub(crate) blocks: Vec<Block>,
}

impl Block {
    /// The box that begins at `low_mm` and extends by `size_mm`.
    pub(crate) fn new(material: &'static str, low_mm: [i32; 3], size_mm: [i32; 3]) -> Self {
        let high_mm = std::array::from_fn(|axis| low_mm[axis] + size_mm[axis]);
        Self { low_mm, high_mm, material }
    }

    /// Whether two boxes share a point.
    #[cfg(test)]
    pub(crate) fn touches(&self, other: &Self) -> bool {
        (0..3).all(|axis| {
            self.low_mm[axis] <= other.high_mm[axis] && other.low_mm[axis] <= self.high_mm[axis]
        })
    }

    /// The corner whose bit `axis` says whether it is at the high end of that axis.
    fn corner_mm(&self, bits: usize) -> [i32; 3] {
        std::array::from_fn(|axis| {
            if bits >> axis & 1 == 1 { self.high_mm[axis] } else { self.low_mm[axis] }
        })
    }
}

/// The faces of a box as corner bits, counter-clockwise seen from outside.
const OUTWARD_FACES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// OBJ text under construction.
#[derive(Debug)]
pub(crate) struct Wavefront {
    text: String,
    vertices: usize,
}

impl Wavefront {
    /// A file that refers to a material file.
    pub(crate) fn new(material_file: &str) -> Self {
        let text = format!(
            "# An office, in metres, z up; written by `cargo xtask office`\nmtllib \
             {material_file}\n"
        );
        Self { text, vertices: 0 }
    }

    /// Begins a named object.
    pub(crate) fn begin(&mut self, name: &str) {
        self.line(&format!("o {name}"));
    }

    /// Adds vertices, and returns the number of the first.
    pub(crate) fn vertices(&mut self, positions_mm: impl IntoIterator<Item = [i32; 3]>) -> usize {
        let first = self.vertices + 1;
        for [x, y, z] in positions_mm {
            self.line(&format!("v {} {} {}", metres(x), metres(y), metres(z)));
            self.vertices += 1;
        }
        first
    }

    /// Chooses the material of the faces that follow.
    pub(crate) fn material(&mut self, name: &str) {
        self.line(&format!("usemtl {name}"));
    }

    /// Adds a face, counter-clockwise seen from its front.
    pub(crate) fn face(&mut self, [a, b, c, d]: [usize; 4]) {
        self.line(&format!("f {a} {b} {c} {d}"));
    }

    /// Adds a piece of furniture.
    pub(crate) fn object(&mut self, object: &Object) {
        self.begin(&object.name);
        let mut material = "";
        for block in &object.blocks {
            let first = self.vertices((0..8).map(|bits| block.corner_mm(bits)));
            if material != block.material {
                material = block.material;
                self.material(material);
            }
            for face in OUTWARD_FACES {
                self.face(face.map(|bits| first + bits));
            }
        }
    }

    /// The whole text.
    pub(crate) fn finish(self) -> String {
        self.text
    }

    fn line(&mut self, line: &str) {
        let _ = writeln!(self.text, "{line}");
    }
}

/// A length in metres, exact to the millimetre.
fn metres(mm: i32) -> String {
    let sign = if mm < 0 { "-" } else { "" };
    format!("{sign}{}.{:03}", mm.abs() / 1000, mm.abs() % 1000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn metres_are_exact() {
        assert_eq!(
            [0, 7, -7, 2800, -1250].map(metres),
            ["0.000", "0.007", "-0.007", "2.800", "-1.250"]
        );
    }

    #[test]
    fn faces_point_outward_and_close_the_box() {
        let block = Block::new("desk", [0, 0, 0], [2, 3, 5]);
        let mut edges = Vec::new();
        let mut six_volumes = 0;
        for face in OUTWARD_FACES {
            let corners = face.map(|bits| block.corner_mm(bits));
            for i in 0..4 {
                edges.push((face[i], face[(i + 1) % 4]));
            }
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| corners[i])) {
                six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1])
                    + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]);
            }
        }
        assert_eq!(six_volumes, 6 * 30);
        assert_eq!(edges.len(), 24);
        assert!(edges.iter().all(|&(a, b)| edges.iter().filter(|&&e| e == (b, a)).count() == 1));
    }

    #[test]
    fn boxes_that_share_a_face_touch() {
        let left = Block::new("desk", [0, 0, 0], [10, 10, 10]);
        assert!(left.touches(&Block::new("desk", [10, 0, 0], [5, 5, 5])));
        assert!(!left.touches(&Block::new("desk", [11, 0, 0], [5, 5, 5])));
    }
}
