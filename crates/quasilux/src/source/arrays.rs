//! Triangles that a program has in memory, and the bytes that stand for them.
//!
//! ```text
//! numbers of positions, triangles, entries of material_of, names   u64 each, little-endian
//! positions      f64, three each
//! triangles      u32, three each
//! material_of    u32
//! names          UTF-8 behind its length (u64): the object, then materials
//! ```

use quasilux_scene::TriangleArrays;

/// Geometry in memory: see [`TriangleArrays`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Triangles {
    /// Vertex positions.
    pub positions: Vec<[f64; 3]>,
    /// Indices into `positions`, counter-clockwise seen from the front side.
    pub triangles: Vec<[u32; 3]>,
    /// Index into `materials` for each triangle; empty where all have the first one.
    pub material_of: Vec<u32>,
    /// Names of materials; none where triangles have none.
    pub materials: Vec<String>,
    /// Name of the object; empty where it is that of the arrays.
    pub object: String,
}

impl Triangles {
    pub(super) fn arrays(&self) -> TriangleArrays<'_> {
        let Self { positions, triangles, material_of, materials, object } = self;
        TriangleArrays { positions, triangles, material_of, materials, object }
    }

    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let Self { positions, triangles, material_of, materials, object } = self;
        let counts = [positions.len(), triangles.len(), material_of.len(), 1 + materials.len()];
        let numbers = 24 * positions.len() + 12 * triangles.len() + 4 * material_of.len();
        let mut bytes = Vec::with_capacity(numbers + 64);
        let put_count = |bytes: &mut Vec<u8>, count: usize| {
            bytes.extend_from_slice(&(count as u64).to_le_bytes());
        };
        counts.iter().for_each(|&count| put_count(&mut bytes, count));
        let mut put = |number: &[u8]| bytes.extend_from_slice(number);
        positions.as_flattened().iter().for_each(|x| put(&x.to_le_bytes()));
        triangles.as_flattened().iter().for_each(|index| put(&index.to_le_bytes()));
        material_of.iter().for_each(|index| put(&index.to_le_bytes()));
        for name in std::iter::once(object).chain(materials) {
            put_count(&mut bytes, name.len());
            bytes.extend_from_slice(name.as_bytes());
        }
        bytes
    }

    /// Total: any bytes give triangles or `None`, in no more memory than they take.
    pub(super) fn from_bytes(bytes: &[u8]) -> Option<Self> {
        let mut rest = Bytes(bytes);
        let counts = [rest.count()?, rest.count()?, rest.count()?, rest.count()?];
        let [positions, triangles, material_of, names] = counts;
        let positions = rest.numbers(positions.checked_mul(3)?)?.map(f64::from_le_bytes);
        let positions: Vec<f64> = positions.collect();
        let triangles = rest.numbers(triangles.checked_mul(3)?)?.map(u32::from_le_bytes);
        let triangles: Vec<u32> = triangles.collect();
        let material_of = rest.numbers(material_of)?.map(u32::from_le_bytes).collect();
        let object = rest.name()?;
        let materials = (1..names).map(|_| rest.name()).collect::<Option<Vec<_>>>()?;
        if names == 0 || !rest.0.is_empty() {
            return None;
        }
        Some(Self {
            positions: positions.as_chunks().0.to_vec(),
            triangles: triangles.as_chunks().0.to_vec(),
            material_of,
            materials,
            object,
        })
    }
}

/// Bytes from which pieces are taken off the front.
struct Bytes<'b>(&'b [u8]);

impl<'b> Bytes<'b> {
    fn take(&mut self, length: usize) -> Option<&'b [u8]> {
        let (front, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        Some(front)
    }

    fn count(&mut self) -> Option<usize> {
        let (number, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        usize::try_from(u64::from_le_bytes(*number)).ok()
    }

    fn numbers<const N: usize>(
        &mut self,
        count: usize,
    ) -> Option<impl Iterator<Item = [u8; N]> + use<'b, N>> {
        let bytes = self.take(count.checked_mul(N)?)?;
        Some(bytes.as_chunks().0.iter().copied())
    }

    fn name(&mut self) -> Option<String> {
        let length = self.count()?;
        String::from_utf8(self.take(length)?.to_vec()).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every cut of a small example, and every bit of it: refused, or other triangles.
    #[test]
    fn bytes_stand_for_triangles() {
        let triangles = Triangles {
            positions: vec![[0.0, -0.5, 1e300], [f64::MIN_POSITIVE, 2.0, 3.0]],
            triangles: vec![[0, 1, u32::MAX]],
            material_of: vec![7],
            materials: vec!["wood".to_owned(), "Stahl \u{e4}".to_owned()],
            object: "desk".to_owned(),
        };
        let bytes = triangles.to_bytes();
        assert_eq!(Triangles::from_bytes(&bytes).as_ref(), Some(&triangles));
        for length in 0..bytes.len() {
            assert_eq!(Triangles::from_bytes(&bytes[..length]), None, "{length}");
        }
        for bit in 0..8 * bytes.len() {
            let mut changed = bytes.clone();
            changed[bit / 8] ^= 1 << (bit % 8);
            let other = Triangles::from_bytes(&changed);
            assert_eq!(other.map_or(changed.clone(), |it| it.to_bytes()), changed, "{bit}");
        }
        assert_eq!(Triangles::from_bytes(&[&bytes[..], &[0]].concat()), None);
        assert_eq!(
            Triangles::from_bytes(&Triangles::default().to_bytes()),
            Some(Triangles::default())
        );
    }
}
