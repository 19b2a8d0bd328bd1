//! The adjoint of a distribution: its incident and scattered directions swapped (Veach, "Robust
//! Monte Carlo methods for light transport simulation", 1997, section 3.7.5).

use crate::distribution::Distribution;
use crate::tree::AdjointTree;

impl Distribution {
    /// The adjoint f'(wi, wo) = f(wo, wi), for light that travels in reverse, exactly. `None` for
    /// grids, for patches without a counterpart at the opposite azimuth, and for trees of rank 4
    /// that become too large.
    #[must_use]
    pub fn adjoint(&self) -> Option<Self> {
        Some(match self {
            Self::Klems(table) => Self::Klems(table.adjoint()?),
            Self::TensorTree(tree) if tree.is_isotropic() => {
                Self::AdjointTree(AdjointTree::new(tree)?)
            }
            Self::TensorTree(tree) => Self::TensorTree(tree.adjoint()?),
            Self::AdjointTree(tree) => Self::TensorTree(tree.original().clone()),
            Self::Gridded(_) => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::klems::AngleBasis;
    use crate::klems::KlemsTable;
    use glam::DVec3;

    #[test]
    fn swapped_directions_have_the_same_value() {
        let basis = AngleBasis::known("LBNL/Klems Quarter").expect("a basis");
        let values: Vec<f64> = (0..41 * 41).map(f64::from).collect();
        let table = KlemsTable::new(basis.clone(), basis, values).expect("a value a pair");
        let forth = Distribution::Klems(table);
        let back = forth.adjoint().expect("patches have counterparts");
        let (a, b) = (DVec3::new(0.1, -0.5, 0.8), DVec3::new(-0.7, 0.2, 0.4));
        for (a, b) in [(a, b), (b, a), (a, a), (a, DVec3::Z)] {
            let (a, b) = (a.normalize(), b.normalize());
            assert_eq!(back.evaluate(a, b), forth.evaluate(b, a));
        }
        assert!(forth.evaluate(a.normalize(), b.normalize())[0] > 0.0);
    }
}
