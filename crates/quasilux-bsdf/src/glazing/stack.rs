//! Several sheets with air between them.
//!
//! Light goes to and fro between the sheets for ever: the sums of the series in closed form, sheet
//! after sheet (the net radiation method of Siegel 1973; ISO 9050:2003), for each wavelength and
//! each polarisation, and the visible mean of the result. Gaps absorb nothing, and sheets are
//! thicker than light is coherent.

use super::photopic::{WAVELENGTHS, visible};
use super::product::GlazingProduct;
use super::sheet::{Polarization, SheetShares};
use std::sync::Arc;

/// One sheet of a glazing.
#[derive(Clone, Debug)]
pub struct GlazingLayer {
    /// What the sheet is.
    pub product: Arc<GlazingProduct>,
    /// Whether the back of the product is turned to the front of the glazing.
    pub is_flipped: bool,
}

/// A window's glass: sheets in their order from the front on.
#[derive(Clone, Debug)]
pub struct Glazing {
    layers: Vec<GlazingLayer>,
}

impl Glazing {
    /// The glazing of these sheets, the one at the front first; without any, light just passes.
    #[must_use]
    pub fn new(layers: Vec<GlazingLayer>) -> Self {
        Self { layers }
    }

    /// The sheets, from the front on.
    #[must_use]
    pub fn layers(&self) -> &[GlazingLayer] {
        &self.layers
    }

    /// What becomes of daylight (D65, as the eye sees it) that meets the glazing at an angle whose
    /// cosine with the normal is `cos`; unpolarised.
    #[must_use]
    pub fn visible(&self, cos: f64) -> SheetShares {
        let spectrum: Vec<SheetShares> =
            (0..WAVELENGTHS).map(|number| self.at(number, cos)).collect();
        let transmittance = visible(|number| spectrum[number].transmittance);
        // The means round.
        let held = |share: f64| share.min(1.0 - transmittance);
        SheetShares {
            transmittance,
            front_reflectance: held(visible(|number| spectrum[number].front_reflectance)),
            back_reflectance: held(visible(|number| spectrum[number].back_reflectance)),
        }
    }

    fn at(&self, number: usize, cos: f64) -> SheetShares {
        let [a, b] = [Polarization::Across, Polarization::Within].map(|polarization| {
            let sheets = self.layers.iter().map(|GlazingLayer { product, is_flipped }| {
                let shares = product.sheet.at(number, cos, polarization);
                if *is_flipped { shares.flipped() } else { shares }
            });
            sheets.reduce(behind_one_another).unwrap_or(OPEN)
        });
        SheetShares {
            transmittance: 0.5 * (a.transmittance + b.transmittance),
            front_reflectance: 0.5 * (a.front_reflectance + b.front_reflectance),
            back_reflectance: 0.5 * (a.back_reflectance + b.back_reflectance),
        }
    }
}

/// No sheet at all.
const OPEN: SheetShares =
    SheetShares { transmittance: 1.0, front_reflectance: 0.0, back_reflectance: 0.0 };

/// Two sheets, all reflections between them included.
fn behind_one_another(front: SheetShares, back: SheetShares) -> SheetShares {
    let lost = 1.0 - front.back_reflectance * back.front_reflectance;
    if lost <= 0.0 {
        // Two mirrors face each other: nothing passes.
        return SheetShares {
            transmittance: 0.0,
            front_reflectance: front.front_reflectance,
            back_reflectance: back.back_reflectance,
        };
    }
    let (t, u) = (front.transmittance, back.transmittance);
    SheetShares {
        transmittance: t * u / lost,
        front_reflectance: front.front_reflectance + t * t * back.front_reflectance / lost,
        back_reflectance: back.back_reflectance + u * u * front.back_reflectance / lost,
    }
}
