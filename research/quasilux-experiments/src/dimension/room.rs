//! A closed box whose walls reflect diffusely, and its lights.

use crate::batwing::Luminaire;
use crate::closed_box::HALF_M;
use glam::DVec3;
use quasilux_sampling::Discrete;

/// Of all walls.
pub(super) const REFLECTANCE: f64 = 2.0 / 3.0;

/// The box and what lights it.
pub(super) struct Room {
    pub(super) sources: Vec<DVec3>,
    /// Which source a photon comes from.
    pub(super) by_flux: Discrete,
    /// What all sources are; `None` for isotropic ones.
    pub(super) luminaire: Option<Luminaire>,
}

impl Room {
    /// With four measured luminaires below the ceiling.
    pub(super) fn furnished() -> Self {
        let places = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let sources: Vec<DVec3> = places
            .iter()
            .map(|(x, y)| DVec3::new(0.5 * HALF_M * x, 0.5 * HALF_M * y, 0.8 * HALF_M))
            .collect();
        let by_flux = Discrete::new(&[1.0; 4]).expect("weights above 0");
        Self { sources, by_flux, luminaire: Some(Luminaire::batwing()) }
    }

    /// The paper's: one isotropic source in the middle.
    pub(super) fn cube() -> Self {
        let by_flux = Discrete::new(&[1.0]).expect("a weight above 0");
        Self { sources: vec![DVec3::ZERO], by_flux, luminaire: None }
    }
}
