//! The lobes that mix at an incident direction.

use super::stretch::Preimage;
use super::{Lobe, LobeTransform};
use crate::color::luminance;
use crate::hemisphere::INSIDE;
use crate::hemisphere::upwards;
use glam::DVec3;
use quasilux_sampling::warp::{invert_disk, sample_disk};
use std::f64::consts::PI;

/// Lobes with their weights, which add up to 1, in the frame in which light comes from azimuth 0.
///
/// In the unit square Lambert's part of all comes first, then what each lobe has above it.
pub(super) struct Mixture<'t> {
    pub(super) parts: [Part<'t>; 4],
}

/// A lobe of a mixture; some have no weight.
#[derive(Clone, Copy)]
pub(super) struct Part<'t> {
    pub(super) lobe: &'t Lobe,
    pub(super) weight: f64,
    /// To where it belongs, from where it is stored.
    pub(super) transform: Option<LobeTransform>,
}

impl Part<'_> {
    fn preimage(&self, direction: DVec3) -> Preimage {
        Preimage::under(self.transform, direction)
    }

    /// The luminance of g towards a direction, without Lambert's part.
    fn above(&self, direction: DVec3) -> f64 {
        let Preimage { direction, ratio } = self.preimage(direction);
        ratio * self.lobe.above().value(direction)
    }
}

impl Mixture<'_> {
    /// A sum over lobes by their weights; of those without nothing is looked up.
    fn sum(&self, of_part: impl Fn(&Part<'_>) -> f64) -> f64 {
        let lit = self.parts.iter().filter(|part| part.weight > 0.0);
        lit.map(|part| part.weight * of_part(part)).sum()
    }

    fn sum_rgb(&self, of_part: impl Fn(&Part<'_>) -> [f64; 3]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for part in self.parts.iter().filter(|part| part.weight > 0.0) {
            let of_part = of_part(part);
            sum = [0, 1, 2].map(|channel| sum[channel] + part.weight * of_part[channel]);
        }
        sum
    }

    pub(super) fn f(&self, direction: DVec3) -> [f64; 3] {
        let above = self.sum_rgb(|part| {
            let Preimage { direction, ratio } = part.preimage(direction);
            part.lobe.g(direction).map(|g| ratio * g)
        });
        let least = self.sum_rgb(|part| part.lobe.least());
        let above = above.map(|g| if g > 0.0 { g / direction.z } else { 0.0 });
        [0, 1, 2].map(|channel| least[channel] + above[channel])
    }

    pub(super) fn albedo(&self) -> [f64; 3] {
        self.sum_rgb(|part| part.lobe.albedo())
    }

    /// The luminance of f cos(theta).
    pub(super) fn luminance(&self, direction: DVec3) -> f64 {
        self.least() * direction.z + self.sum(|part| part.above(direction))
    }

    /// The luminance of the least f.
    fn least(&self) -> f64 {
        self.sum(|part| luminance(part.lobe.least()))
    }

    /// The shares of Lambert's part and of each lobe in the luminance of the albedo.
    fn shares(&self) -> [f64; 5] {
        let of_lobe = |i: usize| self.parts[i].weight * self.parts[i].lobe.above().integral();
        [PI * self.least(), of_lobe(0), of_lobe(1), of_lobe(2), of_lobe(3)]
    }

    /// The luminance of the albedo.
    pub(super) fn total(&self) -> f64 {
        self.shares().iter().sum()
    }

    pub(super) fn sample(&self, u: [f64; 2]) -> Option<DVec3> {
        let shares = self.shares();
        let mut target = u[0] * shares.iter().sum::<f64>();
        let last = shares.iter().rposition(|&share| share > 0.0)?;
        let mut index = 0;
        while index < last && target >= shares[index] {
            target -= shares[index];
            index += 1;
        }
        // At the edges of a lobe, the horizon among them, its density may be zero.
        let inside = [target / shares[index], u[1]].map(|u| u.clamp(INSIDE, 1.0 - INSIDE));
        if index == 0 {
            return Some(upwards(sample_disk(inside)));
        }
        let part = self.parts[index - 1];
        let direction = part.lobe.above().sample_direction(inside)?;
        Some(part.transform.map_or(direction, |transform| transform.onwards(direction)))
    }

    pub(super) fn pdf_sr(&self, direction: DVec3) -> f64 {
        let total = self.total();
        if total > 0.0 { self.luminance(direction) / total } else { 0.0 }
    }

    pub(super) fn invert(&self, direction: DVec3) -> Option<[f64; 2]> {
        let brightness = |index: usize| match index {
            0 => self.least() * direction.z,
            _ => self.parts[index - 1].weight * self.parts[index - 1].above(direction),
        };
        let at = [0, 1, 2, 3, 4].map(brightness);
        let brightest = (0..5).max_by(|&a, &b| at[a].total_cmp(&at[b]))?;
        let [within, u1] = match brightest {
            0 => invert_disk([direction.x, direction.y]),
            _ => {
                let part = self.parts[brightest - 1];
                part.lobe.above().invert(part.preimage(direction).direction)
            }
        };
        let shares = self.shares();
        let before: f64 = shares[..brightest].iter().sum();
        let u0 = (before + within * shares[brightest]) / shares.iter().sum::<f64>();
        Some([u0.clamp(0.0, 1.0), u1])
    }

    /// A bound of [`Self::luminance`].
    pub(super) fn max_value(&self) -> f64 {
        let of_part = |part: &Part<'_>| {
            let ratio = part.transform.map_or(1.0, LobeTransform::most_dense);
            ratio * part.lobe.above().maximum().value
        };
        self.least() + self.sum(of_part)
    }
}
