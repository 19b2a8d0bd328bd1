//! Triangles that are listed over and over at one place: every ray that meets one meets them all.
//!
//! Copies have the same corners in the same sense of rotation and the same material, so that the
//! first of them hides the others. Some are left: a few do no harm, and checks of the scene tell
//! the user of them.

use crate::Mesh;

/// Most copies of a triangle that are kept.
pub(super) const MAX_COPIES: usize = 8;

/// Drops all but the first copies of each triangle; returns how many.
pub(super) fn drop_copies(mesh: &mut Mesh) -> usize {
    let surplus = surplus(mesh);
    let mut kept = Flags { is_surplus: &surplus, next: 0 };
    mesh.triangles.retain(|_| kept.is_kept());
    kept.next = 0;
    mesh.material_of.retain(|_| kept.is_kept());
    kept.next = 0;
    mesh.object_of.retain(|_| kept.is_kept());
    surplus.iter().filter(|is_surplus| **is_surplus).count()
}

/// Goes through the triangles in order.
struct Flags<'a> {
    is_surplus: &'a [bool],
    next: usize,
}

impl Flags<'_> {
    fn is_kept(&mut self) -> bool {
        self.next += 1;
        !self.is_surplus[self.next - 1]
    }
}

/// Which triangles are copies of too many before them. Triangles with the same lowest vertex are
/// put together by counting; only where these are many are they compared.
fn surplus(mesh: &Mesh) -> Vec<bool> {
    let lowest = |triangle: &[u32; 3]| triangle.iter().fold(u32::MAX, |low, &v| low.min(v));
    let mut ends = vec![0_u32; mesh.positions.len()];
    mesh.triangles.iter().for_each(|triangle| ends[lowest(triangle) as usize] += 1);
    let mut sum = 0;
    for end in &mut ends {
        sum += *end;
        *end = sum;
    }
    let mut together = vec![0_u32; mesh.triangles.len()];
    let mut next = ends.clone();
    for (number, triangle) in mesh.triangles.iter().enumerate().rev() {
        let place = &mut next[lowest(triangle) as usize];
        *place -= 1;
        together[*place as usize] = number as u32;
    }
    let mut surplus = vec![false; mesh.triangles.len()];
    for (start, end) in next.into_iter().zip(ends) {
        let around = &mut together[start as usize..end as usize];
        if around.len() <= MAX_COPIES {
            continue;
        }
        around.sort_by_key(|&number| (key(mesh, number), number));
        for copies in around.chunk_by(|&a, &b| key(mesh, a) == key(mesh, b)) {
            copies.iter().skip(MAX_COPIES).for_each(|&number| surplus[number as usize] = true);
        }
    }
    surplus
}

/// Key that copies have in common: material, and corners from the lowest on.
fn key(mesh: &Mesh, number: u32) -> [u32; 4] {
    let [a, b, c] = mesh.triangles[number as usize];
    let [first, second, third] = if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    };
    [mesh.material_of[number as usize], first, second, third]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn the_first_copies_are_kept() {
        let mut mesh = Mesh { positions: vec![DVec3::ZERO; 4], ..Mesh::default() };
        let mut add = |triangle: [u32; 3], material: u32| {
            mesh.triangles.push(triangle);
            mesh.material_of.push(material);
            mesh.object_of.push(mesh.object_of.len() as u32);
        };
        for turn in 0..20 {
            let mut triangle = [0, 1, 2];
            triangle.rotate_left(turn % 3);
            add(triangle, 0);
            // Other sides, corners and materials are no copies.
            match turn {
                3 => add([0, 2, 1], 0),
                4 => add([0, 1, 3], 0),
                5 => add([0, 1, 2], 1),
                _ => {}
            }
        }
        assert_eq!(drop_copies(&mut mesh), 12);
        assert_eq!(mesh.object_of, [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
        assert_eq!(mesh.material_of, [0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0]);
        assert_eq!(mesh.triangles.len(), 11);
        assert_eq!(drop_copies(&mut mesh), 0);
    }
}
