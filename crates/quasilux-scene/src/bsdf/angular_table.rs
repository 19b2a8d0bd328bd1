//! A share of light by angle of incidence.

use std::f64::consts::FRAC_PI_2;

/// A share of light in [0, 1] by the angle to the normal, joined by straight lines in the angle.
#[derive(Clone, Debug, PartialEq)]
pub struct AngularTable {
    nodes: Vec<AngularNode>,
}

/// One line of an [`AngularTable`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularNode {
    /// Angle to the normal in rad.
    pub theta_rad: f64,
    /// The share there.
    pub share: f64,
}

impl AngularTable {
    /// A table with one share at all angles.
    #[must_use]
    pub fn constant(share: f64) -> Self {
        let node = |theta_rad| AngularNode { theta_rad, share };
        Self { nodes: vec![node(0.0), node(FRAC_PI_2)] }
    }

    /// The table with these nodes; `None` unless angles rise from 0 to a right angle and all shares
    /// lie in [0, 1].
    #[must_use]
    pub fn new(nodes: Vec<AngularNode>) -> Option<Self> {
        let spans = nodes.first()?.theta_rad == 0.0 && nodes.last()?.theta_rad == FRAC_PI_2;
        let rises = nodes.windows(2).all(|pair| pair[0].theta_rad < pair[1].theta_rad);
        let holds = nodes.iter().all(|node| (0.0..=1.0).contains(&node.share));
        (spans && rises && holds).then_some(Self { nodes })
    }

    /// The table with nodes that are known to be those of a table.
    pub(super) fn from_steps(nodes: Vec<AngularNode>) -> Self {
        debug_assert!(Self::new(nodes.clone()).is_some());
        Self { nodes }
    }

    /// The nodes, by rising angle.
    #[must_use]
    pub fn nodes(&self) -> &[AngularNode] {
        &self.nodes
    }

    /// The share at an angle whose cosine with the normal is `cos`.
    #[must_use]
    pub fn at(&self, cos: f64) -> f64 {
        self.at_angle(libm::acos(cos.clamp(0.0, 1.0)))
    }

    /// The share at an angle in rad.
    #[must_use]
    pub fn at_angle(&self, theta_rad: f64) -> f64 {
        let behind = self.nodes.partition_point(|node| node.theta_rad <= theta_rad);
        let [before, behind] = match behind {
            0 => return self.nodes[0].share,
            n if n == self.nodes.len() => return self.nodes[n - 1].share,
            n => [self.nodes[n - 1], self.nodes[n]],
        };
        let way = (theta_rad - before.theta_rad) / (behind.theta_rad - before.theta_rad);
        before.share + (behind.share - before.share) * way
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(nodes: &[(f64, f64)]) -> Option<AngularTable> {
        let node = |&(theta_rad, share): &(f64, f64)| AngularNode { theta_rad, share };
        AngularTable::new(nodes.iter().map(node).collect())
    }

    #[test]
    fn straight_lines_join_the_nodes() {
        let table = table(&[(0.0, 0.8), (0.5, 0.6), (FRAC_PI_2, 0.0)]).unwrap();
        assert_eq!(table.at(1.0), 0.8);
        assert!((table.at(libm::cos(0.25)) - 0.7).abs() < 1e-14);
        assert!((table.at(libm::cos(0.5)) - 0.6).abs() < 1e-14);
        assert!(table.at(0.0).abs() < 1e-14);
        assert_eq!(AngularTable::constant(0.3).at(0.4), 0.3);
    }

    #[test]
    fn only_whole_tables_are_taken() {
        assert!(table(&[]).is_none());
        assert!(table(&[(0.0, 0.5)]).is_none());
        assert!(table(&[(0.1, 0.5), (FRAC_PI_2, 0.0)]).is_none());
        assert!(table(&[(0.0, 0.5), (1.5, 0.0)]).is_none());
        assert!(table(&[(0.0, 0.5), (0.0, 0.4), (FRAC_PI_2, 0.0)]).is_none());
        assert!(table(&[(0.0, 1.5), (FRAC_PI_2, 0.0)]).is_none());
        assert!(table(&[(0.0, f64::NAN), (FRAC_PI_2, 0.0)]).is_none());
    }
}
