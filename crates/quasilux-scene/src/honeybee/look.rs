//! Modifiers of Radiance to surfaces that quasilux has.
//!
//! Radiance's materials are described in its reference manual ("The RADIANCE 5.1 Synthetic Imaging
//! System", 2016); docs/from-radiance.md compares them with those of a project file.

use super::findings::Findings;
use super::glass;
use super::radiance::{Kind, Modifier, Named};
use crate::bsdf::{AngularTable, Conductor, Diffuse, Mirror, Pane, Plastic, Translucent};
use crate::{Bsdf, LoadError, Rgb};
use glam::DVec3;
use std::sync::Arc;

/// Lumens a watt of Radiance's white.
const EFFICACY_LM_W: f64 = 179.0;
/// Radiance's weights of red, green and blue in a luminance.
const RADIANCE_WEIGHTS: [f64; 3] = [0.265, 0.670, 0.065];
/// The width that a smooth highlight gets.
const MIN_ALPHA: f64 = 0.0004;
/// Largest index of a surface with a highlight.
const MAX_ETA: f64 = 5.0;
/// Where tables of Honeybee's sheets point upward if nothing is said.
const USUAL_UP: DVec3 = DVec3::new(0.01, 0.01, 1.0);

/// Surface that a modifier makes.
#[derive(Clone, Debug)]
pub(crate) enum Look {
    /// A surface.
    Surface(Arc<Bsdf>),
    /// A measured sheet: its modifier, the text of its XML file, and where its tables point upward.
    Sheet { name: Arc<str>, xml: Arc<str>, up: DVec3 },
    /// A black surface that shines with this luminance in cd/m2 to its front.
    Light(f64),
    /// Nothing at all.
    Open,
    /// Something that quasilux has nothing for, in the words of a refusal.
    Unknown(String),
}

impl From<Bsdf> for Look {
    fn from(bsdf: Bsdf) -> Self {
        Self::Surface(Arc::new(bsdf))
    }
}

/// The refusal of a number.
fn refuse(file: &str, name: &str, key: &str, value: f64, expected: &str) -> LoadError {
    let message = format!("modifier \"{name}\": {key} is {value}; expected {expected}");
    LoadError::new(file, None, message)
}

/// Reads the numbers of one modifier.
struct Reader<'m> {
    file: &'m str,
    name: &'m str,
}

impl Reader<'_> {
    fn share(&self, key: &str, value: Option<f64>) -> Result<f64, LoadError> {
        let value = value.unwrap_or(0.0);
        if (0.0..=1.0).contains(&value) {
            return Ok(value);
        }
        Err(refuse(self.file, self.name, key, value, "a share from 0 to 1"))
    }

    fn colour(&self, of: &str, [r, g, b]: [Option<f64>; 3]) -> Result<Rgb, LoadError> {
        let share = |channel: &str, value| self.share(&format!("{channel}_{of}"), value);
        Ok(Rgb([share("r", r)?, share("g", g)?, share("b", b)?]))
    }
}

/// The look of a modifier; findings are of its name.
pub(super) fn look(
    file: &str,
    modifier: &Modifier,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let name = modifier.identifier.as_deref().unwrap_or("without a name");
    let place = format!("modifier \"{name}\"");
    let is_void = |kind: Option<&str>| kind.is_none_or(|kind| kind.eq_ignore_ascii_case("void"));
    let own = match &modifier.modifier {
        None => None,
        Some(Named::Name(name)) => Some(name.as_str()),
        Some(Named::Whole(whole)) => {
            let Kind { kind } = &**whole;
            kind.as_deref()
        }
    };
    if !is_void(own) {
        findings.note(&place, "the pattern or texture that it is modified by is left out");
    }
    let read = Reader { file, name };
    let Modifier { r_reflectance: r, g_reflectance: g, b_reflectance: b, .. } = *modifier;
    let colour = || read.colour("reflectance", [r, g, b]);
    Ok(match modifier.kind.as_deref() {
        Some("Plastic") => plastic(&read, modifier, colour()?, &place, findings)?,
        Some("Metal") => metal(&read, modifier, colour()?, &place, findings)?,
        Some("Trans") => trans(&read, modifier, colour()?, &place, findings)?,
        Some("Glass") => glass_look(&read, modifier, &place, findings)?,
        Some("Mirror") => Look::from(Bsdf::Mirror(Mirror { reflectance: colour()? })),
        Some("BSDF" | "aBSDF" | "ABSDF") => sheet(&read, modifier, &place, findings)?,
        Some("Light" | "Glow") => light(&read, modifier, &place, findings)?,
        Some("Void") => Look::Open,
        other => Look::Unknown(format!(
            "modifier \"{name}\" is of the type {:?}, for which there is nothing here; expected \
             Plastic, Metal, Trans, Glass, Mirror, BSDF, Light, Glow or Void",
            other.unwrap_or("none")
        )),
    })
}

fn plastic(
    read: &Reader<'_>,
    modifier: &Modifier,
    reflectance: Rgb,
    place: &str,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let specularity = read.share("specularity", modifier.specularity)?;
    let roughness = read.share("roughness", modifier.roughness)?;
    if specularity == 0.0 {
        return Ok(Look::from(Bsdf::Diffuse(Diffuse { reflectance })));
    }
    let note = "its highlight follows Fresnel's equations, near Radiance's and not the same";
    findings.note(place, note);
    // The index whose reflectance at normal incidence is the specularity.
    let root = specularity.sqrt();
    let eta = (1.0 + root) / (1.0 - root);
    if eta > MAX_ETA {
        findings.note(place, "its specularity is above 0.44, and taken as 0.44");
    }
    let eta = eta.clamp(1.0 + 1e-9, MAX_ETA);
    let alpha = roughness.max(MIN_ALPHA);
    Ok(Look::from(Bsdf::Plastic(Plastic { reflectance, eta, alpha })))
}

fn metal(
    read: &Reader<'_>,
    modifier: &Modifier,
    reflectance: Rgb,
    place: &str,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let specularity = read.share("specularity", modifier.specularity)?;
    let roughness = read.share("roughness", modifier.roughness)?;
    Ok(Look::from(if specularity == 0.0 {
        Bsdf::Diffuse(Diffuse { reflectance })
    } else if roughness == 0.0 && specularity == 1.0 {
        Bsdf::Mirror(Mirror { reflectance })
    } else {
        let note = "all of the metal's light is in its highlight, near Radiance's and not the same";
        findings.note(place, note);
        Bsdf::Conductor(Conductor { reflectance, alpha: roughness.max(MIN_ALPHA) })
    }))
}

fn trans(
    read: &Reader<'_>,
    modifier: &Modifier,
    colour: Rgb,
    place: &str,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let specularity = read.share("specularity", modifier.specularity)?;
    let transmitted = read.share("transmitted_diff", modifier.transmitted_diff)?;
    let straight = read.share("transmitted_spec", modifier.transmitted_spec)?;
    let rest = colour * (1.0 - specularity);
    let is_straight = specularity > 0.0 || transmitted * straight > 0.0;
    if is_straight && read.share("roughness", modifier.roughness)? > 0.0 {
        findings.note(place, "its roughness is left out");
    }
    if transmitted == 1.0 && straight == 1.0 && colour.is_grey() {
        let passed = rest.luminance();
        if passed == 1.0 {
            return Ok(Look::Open);
        }
        let [through, back] = [passed, specularity].map(AngularTable::constant);
        return Ok(Look::from(Bsdf::Pane(Pane::measured(through, back))));
    }
    if is_straight {
        let note = "light that Radiance mirrors or lets straight through it is scattered in all \
                    directions here, as much of it";
        findings.note(place, note);
    }
    let reflectance = rest * (1.0 - transmitted) + Rgb::grey(specularity);
    let transmittance = rest * transmitted;
    Ok(Look::from(Bsdf::Translucent(Translucent { reflectance, transmittance })))
}

fn glass_look(
    read: &Reader<'_>,
    modifier: &Modifier,
    place: &str,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let Modifier { r_transmissivity: r, g_transmissivity: g, b_transmissivity: b, .. } = *modifier;
    let transmissivity = read.colour("transmissivity", [r, g, b])?;
    let eta = modifier.refraction_index.unwrap_or(glass::INDEX);
    if !(eta > 1.0 && eta <= 5.0) {
        let expected = "an index above 1, at most 5";
        return Err(refuse(read.file, read.name, "refraction_index", eta, expected));
    }
    let pane = if transmissivity.is_grey() {
        glass::grey(eta, transmissivity.luminance())
    } else {
        let note = "coloured glass takes as much of slant light as of straight light";
        findings.note(place, note);
        glass::coloured(eta, transmissivity)
    };
    Ok(Look::from(Bsdf::Pane(pane)))
}

fn sheet(
    read: &Reader<'_>,
    modifier: &Modifier,
    place: &str,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let Some(xml) = &modifier.bsdf_data else {
        let message = format!("{place}: no bsdf_data; expected the text of an XML file");
        return Err(LoadError::new(read.file, None, message));
    };
    if modifier.thickness.is_some_and(|thickness| thickness != 0.0) {
        findings.note(place, "its thickness is left out: light meets the sheet where it is drawn");
    }
    if modifier.transform.is_some() {
        findings.note(place, "its transform is left out");
    }
    let diffuse = [
        &modifier.front_diffuse_reflectance,
        &modifier.back_diffuse_reflectance,
        &modifier.diffuse_transmittance,
    ];
    if diffuse.into_iter().any(|shares| shares.iter().any(|&share| share != 0.0)) {
        findings.note(place, "diffuse light beside that of its tables is left out");
    }
    let has_function = modifier.function_file.as_deref().is_some_and(|file| file != ".");
    if has_function || !modifier.dependencies.is_empty() {
        findings.note(place, "its function_file and dependencies are left out");
    }
    let up = modifier.up_orientation.map_or(USUAL_UP, |up| up.0);
    if up.length() == 0.0 {
        let message = format!("{place}: up_orientation has no length; expected a direction");
        return Err(LoadError::new(read.file, None, message));
    }
    Ok(Look::Sheet { name: read.name.into(), xml: xml.as_str().into(), up })
}

fn light(
    read: &Reader<'_>,
    modifier: &Modifier,
    place: &str,
    findings: &mut Findings,
) -> Result<Look, LoadError> {
    let Modifier { r_emittance: r, g_emittance: g, b_emittance: b, .. } = *modifier;
    let radiance = [r, g, b].map(|value| value.unwrap_or(0.0));
    if let Some(wrong) = radiance.into_iter().find(|value| !(0.0..=1e9).contains(value)) {
        let expected = "a radiance from 0 to 1e9";
        return Err(refuse(read.file, read.name, "emittance", wrong, expected));
    }
    if radiance.iter().any(|&channel| channel != radiance[0]) {
        findings.note(place, "the colour of its light is left out");
    }
    let is_glow = modifier.kind.as_deref() == Some("Glow");
    let reach = modifier.max_radius.filter(|_| is_glow).unwrap_or(0.0);
    if reach < 0.0 {
        findings.note(place, "a glow that lights nothing is black here");
    } else if reach > 0.0 {
        findings.note(place, "its light reaches beyond max_radius here");
    }
    let luminance: f64 =
        radiance.iter().zip(RADIANCE_WEIGHTS).map(|(&it, weight)| it * weight).sum();
    if reach < 0.0 || luminance == 0.0 {
        return Ok(Look::from(Bsdf::Diffuse(Diffuse { reflectance: Rgb::BLACK })));
    }
    Ok(Look::Light(EFFICACY_LM_W * luminance))
}

/// A surface that is there, and that light passes as if it were not.
pub(super) fn invisible() -> Bsdf {
    let [through, back] = [1.0, 0.0].map(AngularTable::constant);
    Bsdf::Pane(Pane::measured(through, back))
}
