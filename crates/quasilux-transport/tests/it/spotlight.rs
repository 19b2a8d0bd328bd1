//! A lamp with a narrow beam, for the tests of the crate and those of its modules.

use glam::{DMat3, DVec3};
use quasilux_photometry::{LuminousShape, read_ies};
use quasilux_scene::Light;
use quasilux_scene::light::Luminaire;
use std::sync::Arc;

/// A beam of 10 degrees straight down, and a faint glow from there to the horizon.
pub(crate) fn spotlight(position: DVec3) -> Light {
    let text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 6 1 1 2 0 0 0\n1 1 1\n0 4 6 30 90 180\n0\n\
                9000 8000 300 40 0 0\n";
    Light::Luminaire(Luminaire {
        photometry: Arc::new(read_ies(text.as_bytes()).unwrap().photometry),
        position,
        world_from_luminaire: DMat3::IDENTITY,
        dimming: 1.0,
        shape: LuminousShape::POINT,
    })
}
