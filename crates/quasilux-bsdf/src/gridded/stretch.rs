//! How a lobe follows the mirror direction between the incidences that are stored.
//!
//! A lobe that is moved from one mirror direction to another is stretched linearly in the plane of
//! incidence: in the frame of the surface (x, y, z) becomes (p x + q z, y, z), and is normalised
//! (Heitz, Dupuy, Hill and Neubelt 2016, "Real-time polygonal-light shading with linearly
//! transformed cosines"). The horizon stays where it is, no light is lost, and the Jacobian is that
//! of a linear map: p over the cube of the length. q leads one mirror direction to the other. p is
//! a power of the ratio of their cosines: with 2 lobes keep their width in the plane of incidence
//! and become narrower across with the cosine, as those of microfacets do; less, down to 1,
//! disturbs less what is far from the mirror direction.
//!
//! Which power serves a pair of neighbours, or whether lobes had better stay, is what the
//! neighbours say: that under which one of them, moved onto the other, has the most in common with
//! it.

use super::Lobe;
use crate::hemisphere::lattice;
use glam::DVec3;

/// Directions in which two lobes are compared.
const COMPARED: usize = 233;

/// Nearer to the horizon than half a degree no mirror direction is: the least cosine.
const MIN_COSINE: f64 = 0.008_726_535;

/// How far lobes between two stored incidences are stretched as they move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stretch {
    /// Not at all.
    None,
    /// With p the ratio of cosines.
    Linear,
    /// With p its power 3/2.
    ThreeHalves,
    /// With p its square.
    Square,
}

/// A mirror direction: cosine and sine of its polar angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Mirror {
    cos: f64,
    sin: f64,
}

/// A linear map of directions that keeps the horizon.
#[derive(Clone, Copy, Debug)]
pub(super) struct LobeTransform {
    p: f64,
    q: f64,
}

impl Mirror {
    pub(super) fn new(theta_rad: f64) -> Self {
        let (sin, cos) = libm::sincos(theta_rad);
        if cos >= MIN_COSINE {
            return Self { cos, sin };
        }
        Self { cos: MIN_COSINE, sin: (1.0 - MIN_COSINE * MIN_COSINE).sqrt() }
    }

    /// The same, but no nearer to the horizon than half the cosine of another.
    pub(super) fn near(self, other: Self) -> Self {
        let cos = self.cos.max(0.5 * other.cos);
        Self { cos, sin: (1.0 - cos * cos).sqrt() }
    }
}

/// Where a direction comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Preimage {
    pub(super) direction: DVec3,
    /// The solid angle there over that at the image.
    pub(super) ratio: f64,
}

impl Preimage {
    /// Under a transform, or the identity.
    pub(super) fn under(transform: Option<LobeTransform>, direction: DVec3) -> Self {
        let identity = Self { direction, ratio: 1.0 };
        transform.map_or(identity, |transform| transform.preimage(direction))
    }
}

impl LobeTransform {
    /// From one mirror direction to another; `None` where nothing moves.
    pub(super) fn new(from: Mirror, to: Mirror, stretch: Stretch) -> Option<Self> {
        let ratio = from.cos / to.cos;
        let p = match stretch {
            Stretch::None => return None,
            Stretch::Linear => ratio,
            Stretch::ThreeHalves => ratio * ratio.sqrt(),
            Stretch::Square => ratio * ratio,
        };
        // The mirror direction is at (-sin, 0, cos).
        (from != to).then(|| Self { p, q: p * (from.sin / from.cos) - to.sin / to.cos })
    }

    /// Where a direction of the lobe goes.
    pub(super) fn onwards(self, direction: DVec3) -> DVec3 {
        let DVec3 { x, y, z } = direction;
        DVec3::new(self.p * x + self.q * z, y, z).normalize()
    }

    /// The direction that is moved to `direction`.
    pub(super) fn preimage(self, direction: DVec3) -> Preimage {
        let DVec3 { x, y, z } = direction;
        let from = DVec3::new((x - self.q * z) / self.p, y, z);
        let length = from.length();
        Preimage { direction: from / length, ratio: 1.0 / (self.p * length * length * length) }
    }

    /// A bound of that ratio: the cube of the greatest stretching over p.
    pub(super) fn most_dense(self) -> f64 {
        let Self { p, q } = self;
        let sum = p * p + q * q + 1.0;
        // Of the two singular values in the plane of incidence the greater one; across it is 1.
        let stretch2 = (0.5 * (sum + (sum * sum - 4.0 * p * p).max(0.0).sqrt())).max(1.0);
        stretch2 * stretch2.sqrt() / p
    }
}

impl Stretch {
    /// The stretch under which `pairs` of lobes at two mirror directions have the most in common.
    pub(super) fn between<'t>(
        pairs: impl Iterator<Item = [&'t Lobe; 2]> + Clone,
        mirrors: [Mirror; 2],
    ) -> Self {
        let common = |stretch: Self| -> f64 {
            let transform = LobeTransform::new(mirrors[0], mirrors[1], stretch);
            pairs.clone().map(|pair| overlap(pair, transform)).sum()
        };
        let mut best = (common(Self::None), Self::None);
        for stretch in [Self::Linear, Self::ThreeHalves, Self::Square] {
            let common = common(stretch);
            if common > best.0 {
                best = (common, stretch);
            }
        }
        best.1
    }
}

/// The integral of the lesser of the first lobe, moved, and the second, both without what is least
/// and with integral 1: the mean of min(1, a / b) over directions drawn from b.
fn overlap([a, b]: [&Lobe; 2], transform: Option<LobeTransform>) -> f64 {
    let (a, b) = (a.above(), b.above());
    if a.integral() <= 0.0 || b.integral() <= 0.0 {
        return 0.0;
    }
    let common = |index: usize| {
        let direction = b.sample_direction(lattice(index, COMPARED, 0.0));
        direction.map_or(0.0, |direction| {
            let from = Preimage::under(transform, direction);
            let of_b = b.pdf(direction);
            if of_b > 0.0 { (from.ratio * a.pdf(from.direction) / of_b).min(1.0) } else { 0.0 }
        })
    };
    (0..COMPARED).map(common).sum::<f64>() / COMPARED as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mirror_directions_are_moved_onto_each_other() {
        for (from, to) in [(0.0_f64, 0.4_f64), (0.7, 0.3), (1.2, 1.5), (1.6, 0.1)] {
            let mirrors = [from, to].map(Mirror::new);
            for stretch in [Stretch::Linear, Stretch::ThreeHalves, Stretch::Square] {
                let transform = LobeTransform::new(mirrors[0], mirrors[1], stretch).expect("apart");
                let [start, end] = mirrors.map(|m| DVec3::new(-m.sin, 0.0, m.cos));
                assert!(transform.onwards(start).distance(end) < 1e-9);
                let back = transform.preimage(end).direction;
                assert!(back.distance(start) < 1e-9);
            }
        }
        assert!(LobeTransform::new(Mirror::new(0.3), Mirror::new(0.3), Stretch::Square).is_none());
    }

    /// By small triangles.
    #[test]
    fn the_ratio_of_solid_angles_is_that_of_small_ones() {
        let transform =
            LobeTransform::new(Mirror::new(0.5), Mirror::new(1.0), Stretch::ThreeHalves)
                .expect("apart");
        for direction in [DVec3::Z, DVec3::new(-0.6, 0.3, 0.5), DVec3::new(0.8, -0.5, 0.1)] {
            let at = direction.normalize();
            let (u, v) = at.any_orthonormal_pair();
            let size = 1e-5;
            let corner =
                |offset: DVec3| transform.preimage((at + size * offset).normalize()).direction;
            let [a, b, c] = [DVec3::ZERO, u, v].map(corner);
            let area = (b - a).cross(c - a).length() / (size * size);
            let ratio = transform.preimage(at).ratio;
            assert!((area / ratio - 1.0).abs() < 1e-3, "{area} {ratio}");
            assert!(ratio <= transform.most_dense() * (1.0 + 1e-12));
        }
    }
}
