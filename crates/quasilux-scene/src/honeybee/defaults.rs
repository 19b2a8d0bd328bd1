//! Honeybee's own modifiers and set, "Generic", for what a model leaves out (honeybee-radiance and
//! its standards, 2026).
//!
//! Windows have a transmittance of 0.64 and 0.88 at normal incidence; models hold the share that
//! passes the body of the glass once, which makes them of it (refractive index 1.52).

use super::radiance::Modifier;
use super::slots::Slot;
use std::sync::LazyLock;

/// Reflectance or transmissivity of each by its identifier.
const PLASTICS: [(&str, f64); 7] = [
    ("generic_wall_0.50", 0.5),
    ("generic_floor_0.20", 0.2),
    ("generic_ceiling_0.80", 0.8),
    ("generic_interior_shade_0.50", 0.5),
    ("generic_exterior_shade_0.35", 0.35),
    ("generic_context_0.20", 0.2),
    ("generic_opaque_door_0.50", 0.5),
];
const GLASSES: [(&str, f64); 2] = [
    ("generic_exterior_window_vis_0.64", 0.697_576_181_538_433_1),
    ("generic_interior_window_vis_0.88", 0.958_415_432_861_059_6),
];

/// All of them.
pub(super) fn modifiers() -> &'static [Modifier] {
    static ALL: LazyLock<Vec<Modifier>> = LazyLock::new(all);
    &ALL
}

fn all() -> Vec<Modifier> {
    let grey = |(name, share): (&str, f64)| Modifier {
        kind: Some("Plastic".to_owned()),
        identifier: Some(name.to_owned()),
        r_reflectance: Some(share),
        g_reflectance: Some(share),
        b_reflectance: Some(share),
        ..Modifier::default()
    };
    let glass = |(name, share): (&str, f64)| Modifier {
        kind: Some("Glass".to_owned()),
        identifier: Some(name.to_owned()),
        r_transmissivity: Some(share),
        g_transmissivity: Some(share),
        b_transmissivity: Some(share),
        ..Modifier::default()
    };
    let air = Modifier {
        kind: Some("Trans".to_owned()),
        transmitted_diff: Some(1.0),
        transmitted_spec: Some(1.0),
        ..grey(("air_boundary", 1.0))
    };
    let void = Modifier {
        kind: Some("Void".to_owned()),
        identifier: Some("void".to_owned()),
        ..Modifier::default()
    };
    let others = [air, void];
    PLASTICS.into_iter().map(grey).chain(GLASSES.into_iter().map(glass)).chain(others).collect()
}

/// The identifier of the one for a use.
pub(super) const fn of_slot(slot: Slot) -> &'static str {
    match slot {
        Slot::Wall { .. } => "generic_wall_0.50",
        Slot::Floor { .. } => "generic_floor_0.20",
        Slot::RoofCeiling { .. } => "generic_ceiling_0.80",
        Slot::AirBoundary => "air_boundary",
        Slot::Window
        | Slot::Skylight
        | Slot::Operable
        | Slot::Door { is_inside: false, is_glass: true } => "generic_exterior_window_vis_0.64",
        Slot::InteriorWindow | Slot::Door { is_inside: true, is_glass: true } => {
            "generic_interior_window_vis_0.88"
        }
        Slot::Door { is_glass: false, .. } | Slot::OverheadDoor => "generic_opaque_door_0.50",
        Slot::Shade { is_inside: true } => "generic_interior_shade_0.50",
        Slot::Shade { is_inside: false } => "generic_exterior_shade_0.35",
        Slot::Context => "generic_context_0.20",
    }
}
