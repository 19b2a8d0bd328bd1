//! Materials of a scene as Radiance's.

use super::words::{Identifiers, Words};
use super::{Exported, Scene};
use crate::bsdf::{AngularTable, Pane, Plastic, Translucent};
use crate::{Bsdf, Material, Rgb};

/// Index of a pane of which another one is not known, that of Radiance's glass.
const GLASS_ETA: f64 = 1.52;

/// Writes all materials that triangles have; their identifiers.
pub(super) fn write(
    scene: &Scene,
    words: &mut Words,
    names: &mut Identifiers,
    exported: &mut Exported,
) -> Result<Vec<String>, String> {
    let mut is_used = vec![false; scene.materials.len()];
    scene.mesh.material_of.iter().for_each(|material| is_used[*material as usize] = true);
    let has_lamps = !scene.lights.is_empty();
    let mut identifiers = Vec::new();
    for (material, is_used) in scene.materials.iter().zip(is_used) {
        let identifier = names.near(&material.name);
        if is_used {
            add(material, &identifier, has_lamps, words, exported)?;
            if !material.bsdf.is_grey() {
                exported.note(
                    "colours: Radiance weighs channels by 0.265, 0.670 and 0.065, quasilux by \
                     0.2126, 0.7152 and 0.0722",
                );
            }
        }
        identifiers.push(identifier);
    }
    Ok(identifiers)
}

fn add(
    material: &Material,
    name: &str,
    has_lamps: bool,
    words: &mut Words,
    exported: &mut Exported,
) -> Result<(), String> {
    let mut near = |what: &str| exported.note(format!("material \"{}\": {what}", material.name));
    let mut of = |kind: &str, numbers: &[f64]| words.of_numbers("void", kind, name, numbers);
    match &material.bsdf {
        Bsdf::Diffuse(diffuse) => of("plastic", &with(diffuse.reflectance, &[0.0, 0.0])),
        Bsdf::Mirror(mirror) => of("mirror", &mirror.reflectance.0),
        Bsdf::Translucent(sheet) => {
            let Trans { colour, share, is_exact } = Trans::from_sheet(sheet);
            if !is_exact {
                near("one share of transmission stands for those of its channels");
            }
            of("trans", &with(colour, &[0.0, 0.0, share, 0.0]));
        }
        Bsdf::Dielectric(body) => {
            if has_lamps {
                near("light of lamps through clear bodies is not found there, but that of the sky");
            }
            of("dielectric", &[1.0, 1.0, 1.0, body.eta, 0.0]);
        }
        Bsdf::Pane(pane) => {
            if let Some(what) = nearness(pane) {
                near(what);
            }
            of("glass", &glass(pane));
        }
        Bsdf::Conductor(metal) => {
            near("roughness of GGX is taken for that of Ward");
            of("metal", &with(metal.reflectance, &[1.0, metal.alpha]));
        }
        Bsdf::Plastic(plastic) => {
            near("its coat has one reflectance for all angles, and roughness of Ward for GGX");
            of("plastic", &coated(plastic));
        }
        Bsdf::Measured(_) => {
            return Err(format!(
                "the material \"{}\" is measured (kind \"bsdf\"), which is not exported; give it \
                 another kind in a copy of the project, or name its XML file in a BSDF of Radiance",
                material.name
            ));
        }
    }
    Ok(())
}

/// Differences of Radiance's glass from a pane, in words.
fn nearness(pane: &Pane) -> Option<&'static str> {
    match pane {
        Pane::Clear { .. } => None,
        Pane::Tinted { .. } => Some("glass absorbs more of slant light there"),
        Pane::Measured { .. } => {
            Some("glass of its transmittance at normal incidence stands for measured angles")
        }
    }
}

/// Transmissivities and index of the glass of the same transmittance at normal incidence.
fn glass(pane: &Pane) -> Vec<f64> {
    let (transmittance, eta) = match pane {
        Pane::Clear { eta } => (Rgb::grey(Pane::clear_transmittance(*eta)), *eta),
        Pane::Tinted { eta, transmittance } => (*transmittance, *eta),
        Pane::Measured { transmittance, .. } => {
            (Rgb::grey(AngularTable::at_angle(transmittance, 0.0)), GLASS_ETA)
        }
    };
    with(Rgb(transmittance.0.map(|share| transmissivity(share, eta))), &[eta])
}

fn with(colour: Rgb, more: &[f64]) -> Vec<f64> {
    [&colour.0, more].concat()
}

/// Radiance's `trans` of a sheet that scatters to both sides.
struct Trans {
    colour: Rgb,
    /// The share of the colour that is let through.
    share: f64,
    /// Whether all channels have that share.
    is_exact: bool,
}

impl Trans {
    fn from_sheet(sheet: &Translucent) -> Self {
        let Translucent { reflectance, transmittance } = sheet;
        let colour = *reflectance + *transmittance;
        let total: f64 = colour.0.iter().sum();
        let share = if total > 0.0 { transmittance.0.iter().sum::<f64>() / total } else { 0.0 };
        let is_exact = (0..3).all(|c| (transmittance.0[c] - share * colour.0[c]).abs() < 1e-9);
        Self { colour, share, is_exact }
    }
}

/// The share that passes once through the body of a pane, of the transmittance at normal incidence
/// `T = (1 - r)^2 t / (1 - r^2 t^2)`, r the reflectance of a boundary.
fn transmissivity(transmittance: f64, eta: f64) -> f64 {
    let r = normal_reflectance(eta);
    let through = (1.0 - r) * (1.0 - r);
    let root = libm::hypot(through, 2.0 * r * transmittance);
    // The same root without a difference of near numbers.
    2.0 * transmittance / (through + root)
}

/// A plastic whose highlight is the coat's reflectance at normal incidence, with about the diffuse
/// reflectance of the base under the coat.
fn coated(plastic: &Plastic) -> Vec<f64> {
    with(plastic.reflectance, &[normal_reflectance(plastic.eta), plastic.alpha])
}

/// The reflectance of a boundary at normal incidence.
fn normal_reflectance(eta: f64) -> f64 {
    let amplitude = (eta - 1.0) / (eta + 1.0);
    amplitude * amplitude
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The transmittance of a pane at normal incidence is that of its body and both boundaries.
    #[test]
    fn panes_keep_their_transmittance() {
        for (transmittance, eta) in [(0.5, 1.52), (0.88, 1.52), (0.01, 1.3), (0.7, 2.0)] {
            let t = transmissivity(transmittance, eta);
            let r = normal_reflectance(eta);
            let again = (1.0 - r) * (1.0 - r) * t / (1.0 - r * r * t * t);
            assert!((again - transmittance).abs() < 1e-12, "{again} of {transmittance}");
        }
        let clear = Pane::clear_transmittance(1.52);
        assert!((transmissivity(clear, 1.52) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn sheets_keep_what_they_let_through() {
        let (reflectance, transmittance) = (Rgb::grey(0.3), Rgb::grey(0.2));
        let sheet = Translucent { reflectance, transmittance };
        let Trans { colour, share, is_exact } = Trans::from_sheet(&sheet);
        assert!(is_exact && (share - 0.4).abs() < 1e-12 && (colour.0[1] - 0.5).abs() < 1e-12);
    }
}
