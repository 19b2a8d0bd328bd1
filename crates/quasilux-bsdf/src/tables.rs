//! The scattering distributions of both sides of a sheet.

use crate::distribution::Distribution;
use crate::side::ScatteringMode;
use crate::side::Side;

/// By [`Side`] that light arrives on, then by [`ScatteringMode`].
#[derive(Clone, Debug, Default)]
pub(crate) struct ScatteringTables([[Option<Distribution>; 2]; 2]);

impl ScatteringTables {
    /// How light that arrives on `side` is scattered; `None` where nothing is.
    pub(crate) fn get(&self, side: Side, mode: ScatteringMode) -> Option<&Distribution> {
        self.0[side as usize][mode as usize].as_ref()
    }

    pub(crate) fn set(&mut self, side: Side, mode: ScatteringMode, distribution: Distribution) {
        self.0[side as usize][mode as usize] = Some(distribution);
    }
}
