//! Triangles cut out of a facet by halving its edges again and again.

/// A triangle of the facet's shape, in barycentric weights of the facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cell {
    /// Second and third weight of its first corner.
    origin: [f64; 2],
    /// How far its other corners lie from there, each along one of the weights; negative where it
    /// is turned by half a turn.
    step: f64,
}

impl Cell {
    /// All of a facet.
    pub(super) const WHOLE: Self = Self { origin: [0.0; 2], step: 1.0 };

    /// The facet's weights at the place with these weights in the cell.
    pub(super) fn place(self, [_, b, c]: [f64; 3]) -> [f64; 3] {
        let [b, c] = [self.origin[0] + self.step * b, self.origin[1] + self.step * c];
        [(1.0 - b - c).max(0.0), b, c]
    }

    /// The four cells between its corners and the middles of its edges, neighbours in a row but for
    /// the last: each leaves out of the corners and middles of [`Self::split`] what is not its own.
    pub(super) fn parts(self) -> [Self; 4] {
        let ([b, c], step) = (self.origin, 0.5 * self.step);
        let standing = |b: f64, c: f64| Self { origin: [b, c], step };
        let turned = Self { origin: [b + step, c + step], step: -step };
        [standing(b, c), turned, standing(b + step, c), standing(b, c + step)]
    }

    /// What belongs to the corners of the four [`Self::parts`]: `corners` to those of the cell,
    /// `middles` to those of the edges opposite to them.
    pub(super) fn split<T: Copy>(corners: [T; 3], middles: [T; 3]) -> [[T; 3]; 4] {
        let ([a, b, c], [bc, ca, ab]) = (corners, middles);
        [[a, ab, ca], [bc, ca, ab], [ab, b, bc], [ca, bc, c]]
    }

    /// Its share of the facet's area.
    pub(super) fn area_share(self) -> f64 {
        self.step * self.step
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

    /// The corners of the parts are those that [`Cell::split`] hands on, exactly, four levels deep.
    #[test]
    fn parts_have_the_corners_they_are_given() {
        let mut cells = vec![(Cell::WHOLE, CORNERS)];
        for _ in 0..4 {
            cells = cells
                .into_iter()
                .flat_map(|(cell, corners)| {
                    let middle = |i: usize, j: usize| {
                        std::array::from_fn(|k| 0.5 * (corners[i][k] + corners[j][k]))
                    };
                    let middles = [middle(1, 2), middle(2, 0), middle(0, 1)];
                    cell.parts().into_iter().zip(Cell::split(corners, middles))
                })
                .collect();
        }
        assert!(cells.iter().all(|(cell, corners)| CORNERS.map(|c| cell.place(c)) == *corners));
        let area: f64 = cells.iter().map(|(cell, _)| cell.area_share()).sum();
        assert_eq!(area, 1.0);
    }
}
