//! Angular bases of Klems (1994): bands of the polar angle, each cut into equal patches of the
//! azimuth.
//!
//! J. H. Klems, "A new method for predicting the solar heat gain of complex fenestration systems"
//! (ASHRAE Transactions 100, 1994). Patch 0 of each band is centred at azimuth 0, and patches go on
//! counterclockwise; the azimuth is that of light going *onwards*: of the exit direction, or of the
//! incident direction turned by half a turn. Directions of light that goes straight through have
//! the same patch on both sides.

use std::f64::consts::{PI, TAU};

/// The definition of a band of an [`AngleBasis`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandDefinition {
    /// Polar angle where the band ends, in degrees.
    pub upper_deg: f64,
    /// Number of patches, of equal width in azimuth.
    pub patches: usize,
}

impl BandDefinition {
    /// A band that ends at a polar angle in degrees and has that number of patches.
    #[must_use]
    pub const fn new(upper_deg: f64, patches: usize) -> Self {
        Self { upper_deg, patches }
    }
}

/// A basis that files use without defining it.
struct StandardBasis {
    name: &'static str,
    bands: &'static [BandDefinition],
}

const fn band(upper_deg: f64, patches: usize) -> BandDefinition {
    BandDefinition::new(upper_deg, patches)
}

/// The bases of LBNL WINDOW.
const STANDARD: [StandardBasis; 3] = [
    StandardBasis {
        name: "LBNL/Klems Full",
        bands: &[
            band(5.0, 1),
            band(15.0, 8),
            band(25.0, 16),
            band(35.0, 20),
            band(45.0, 24),
            band(55.0, 24),
            band(65.0, 24),
            band(75.0, 16),
            band(90.0, 12),
        ],
    },
    StandardBasis {
        name: "LBNL/Klems Half",
        bands: &[
            band(6.5, 1),
            band(19.5, 8),
            band(32.5, 12),
            band(46.5, 16),
            band(61.5, 20),
            band(76.5, 12),
            band(90.0, 4),
        ],
    },
    StandardBasis {
        name: "LBNL/Klems Quarter",
        bands: &[band(9.0, 1), band(27.0, 8), band(46.0, 12), band(66.0, 12), band(90.0, 8)],
    },
];

/// A hemisphere cut into patches.
#[derive(Clone, Debug, PartialEq)]
pub struct AngleBasis {
    name: String,
    bands: Vec<ThetaBand>,
    patches: usize,
}

/// A band of the polar angle.
#[derive(Clone, Debug, PartialEq)]
pub struct ThetaBand {
    /// Polar angle where the band begins.
    pub lower_rad: f64,
    /// Polar angle where the band ends.
    pub upper_rad: f64,
    /// Number of patches, of equal width in azimuth.
    pub patches: usize,
    /// Index of the first patch.
    pub(super) first: usize,
    /// Squared sines of the ends: projected solid angle over pi is uniform in them.
    pub(super) sin2: [f64; 2],
}

impl ThetaBand {
    /// The projected solid angle of one patch, in sr.
    pub(super) fn patch_projected_sr(&self) -> f64 {
        PI * (self.sin2[1] - self.sin2[0]) / self.patches as f64
    }
}

/// Where a direction falls.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cell {
    pub(super) band: usize,
    /// Within the band.
    pub(super) patch: usize,
    /// Within the patch, in [0, 1]: along the squared sine, and along the azimuth.
    pub(super) fraction: [f64; 2],
}

impl AngleBasis {
    /// One of the bases that need no definition, by its name in letters of any case.
    #[must_use]
    pub fn known(name: &str) -> Option<Self> {
        let basis = STANDARD.iter().find(|basis| basis.name.eq_ignore_ascii_case(name))?;
        Self::new(basis.name, basis.bands)
    }

    /// A basis from the definitions of its bands, from the normal on; `None` unless the angles
    /// ascend within (0, 90] and each band has patches.
    #[must_use]
    pub fn new(name: &str, bands: &[BandDefinition]) -> Option<Self> {
        let mut basis = Self { name: name.to_owned(), bands: Vec::new(), patches: 0 };
        let (mut lower_rad, mut lower_sin2) = (0.0, 0.0);
        for &BandDefinition { upper_deg, patches } in bands {
            let upper_rad = upper_deg.to_radians();
            let sin = libm::sin(upper_rad);
            let sin2 = if upper_deg == 90.0 { 1.0 } else { sin * sin };
            if !(upper_deg <= 90.0 && sin2 > lower_sin2) || patches == 0 {
                return None;
            }
            let first = basis.patches;
            basis.patches = first.checked_add(patches)?;
            let sin2_ends = [lower_sin2, sin2];
            basis.bands.push(ThetaBand { lower_rad, upper_rad, patches, first, sin2: sin2_ends });
            (lower_rad, lower_sin2) = (upper_rad, sin2);
        }
        (!basis.bands.is_empty()).then_some(basis)
    }

    /// The name that files use.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The bands, from the normal on.
    #[must_use]
    pub fn bands(&self) -> &[ThetaBand] {
        &self.bands
    }

    /// The number of patches of all bands.
    #[must_use]
    pub fn patches(&self) -> usize {
        self.patches
    }

    /// The cell of a direction whose projection into the surface, in the sense in which light goes,
    /// is `(x, y)`. `None` beyond the last band.
    pub(super) fn cell(&self, [x, y]: [f64; 2]) -> Option<Cell> {
        let sin2 = (x * x + y * y).min(1.0);
        let band = self.bands.partition_point(|band| band.sin2[1] <= sin2);
        // The horizon belongs to the last band.
        let band = if band == self.bands.len() && sin2 >= 1.0 { band - 1 } else { band };
        let ThetaBand { patches, sin2: [low, high], .. } = *self.bands.get(band)?;
        if sin2 > high {
            return None;
        }
        let turns = libm::atan2(y, x) / TAU * patches as f64 + 0.5;
        let count = patches as f64;
        let turns = if turns < 0.0 { turns + count } else { turns };
        let patch = (turns as usize).min(patches - 1);
        let along = [(sin2 - low) / (high - low), turns - patch as f64];
        Some(Cell { band, patch, fraction: along.map(|part| part.clamp(0.0, 1.0)) })
    }

    /// The projection of a direction at a place of a cell, and its `z`.
    pub(super) fn place(&self, cell: Cell) -> [f64; 3] {
        let ThetaBand { patches, sin2: [low, high], .. } = self.bands[cell.band];
        let sin2 = (1.0 - cell.fraction[0]) * low + cell.fraction[0] * high;
        let phi_rad = TAU * (cell.patch as f64 + cell.fraction[1] - 0.5) / patches as f64;
        let (sin_phi, cos_phi) = libm::sincos(phi_rad);
        let sin = sin2.sqrt();
        [sin * cos_phi, sin * sin_phi, (1.0 - sin2).max(0.0).sqrt()]
    }

    /// The same at another place of the cell.
    pub(crate) fn place_in(&self, cell: Cell, fraction: [f64; 2]) -> [f64; 3] {
        self.place(Cell { fraction, ..cell })
    }

    /// The index of a cell in the order of files.
    pub(super) fn index(&self, cell: Cell) -> usize {
        self.bands[cell.band].first + cell.patch
    }

    /// The patches in the order of files: band and patch within it.
    pub(crate) fn cells(&self) -> impl Iterator<Item = Cell> {
        let of_band = |(band, found): (usize, &ThetaBand)| {
            (0..found.patches).map(move |patch| Cell { band, patch, fraction: [0.5, 0.5] })
        };
        self.bands.iter().enumerate().flat_map(of_band)
    }

    /// The projection, and `z`, of a place in each piece that a patch has in common with one of
    /// another basis.
    pub(super) fn common_places(&self, other: &Self) -> Vec<[f64; 3]> {
        let between = |mut ends: Vec<f64>| -> Vec<f64> {
            ends.sort_by(f64::total_cmp);
            let pairs = ends.windows(2).filter(|pair| pair[1] - pair[0] > 1e-12);
            pairs.map(|pair| pair[0].midpoint(pair[1])).collect()
        };
        let bands = [self, other].map(|basis| &basis.bands);
        let ends = bands.into_iter().flatten().flat_map(|band| band.sin2).collect();
        let mut places = Vec::new();
        for sin2 in between(ends) {
            let at_sin2 = |band: &&ThetaBand| (band.sin2[0]..band.sin2[1]).contains(&sin2);
            let found = bands.map(|bands| bands.iter().find(at_sin2).map_or(1, |b| b.patches));
            // In parts of a turn, from an edge of each on.
            let edges =
                |patches: usize| (0..patches).map(move |i| (i as f64 + 0.5) / patches as f64);
            let all = found.into_iter().flat_map(edges);
            let around = |turns: Vec<f64>| {
                let closing = turns.iter().copied().fold(f64::INFINITY, f64::min) + 1.0;
                between(turns.into_iter().chain([closing]).collect())
            };
            for turns in around(all.collect()) {
                let (sin_phi, cos_phi) = libm::sincos(TAU * turns);
                let sin = sin2.sqrt();
                places.push([sin * cos_phi, sin * sin_phi, (1.0 - sin2).max(0.0).sqrt()]);
            }
        }
        places
    }

    /// The patch half a turn away from each, in the order of files; `None` where some band has an
    /// odd number of patches, more than one.
    pub(super) fn opposites(&self) -> Option<Vec<usize>> {
        let has_pairs = |band: &ThetaBand| band.patches == 1 || band.patches.is_multiple_of(2);
        let opposite = |cell: Cell| {
            let ThetaBand { first, patches, .. } = self.bands[cell.band];
            first + (cell.patch + patches / 2) % patches
        };
        self.bands.iter().all(has_pairs).then(|| self.cells().map(opposite).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers that the names stand for, and the whole hemisphere.
    #[test]
    fn known_bases_cover_the_hemisphere() {
        for (name, patches) in
            [("lbnl/klems full", 145), ("LBNL/Klems Half", 73), ("LBNL/Klems Quarter", 41)]
        {
            let basis = AngleBasis::known(name).unwrap();
            assert_eq!(basis.patches(), patches);
            let projected_sr: f64 =
                basis.bands().iter().map(|b| b.patches as f64 * b.patch_projected_sr()).sum();
            assert!((projected_sr - PI).abs() < 1e-14);
        }
        assert!(AngleBasis::known("LBNL/Klems Eighth").is_none());
    }

    #[test]
    fn places_lie_in_their_cells() {
        let basis = AngleBasis::known("LBNL/Klems Half").unwrap();
        for cell in basis.cells() {
            for fraction in [[0.01, 0.01], [0.5, 0.99], [0.99, 0.3]] {
                let [x, y, _] = basis.place(Cell { fraction, ..cell });
                let back = basis.cell([x, y]).unwrap();
                assert_eq!((back.band, back.patch), (cell.band, cell.patch));
                let off = [0, 1].map(|axis| (back.fraction[axis] - fraction[axis]).abs());
                assert!(off[0] < 1e-12 && off[1] < 1e-12, "{off:?}");
            }
        }
    }

    #[test]
    fn what_is_no_basis_is_refused() {
        for bands in [
            &[][..],
            &[band(0.0, 1)],
            &[band(30.0, 1), band(20.0, 4)],
            &[band(95.0, 1)],
            &[band(90.0, 0)],
        ] {
            assert!(AngleBasis::new("none", bands).is_none(), "{bands:?}");
        }
        let narrow = AngleBasis::new("narrow", &[band(10.0, 1), band(80.0, 3)]).unwrap();
        assert!(narrow.cell([0.99, 0.0]).is_none());
        assert!(narrow.opposites().is_none());
    }
}
