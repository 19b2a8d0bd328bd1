//! Modifiers of a model to surfaces that quasilux has.

use super::radiance::{Kind, Modifier, Named};
use crate::bsdf::Mirror;
use crate::radiance::{Coated, Findings, Look, Looks, Unusable, glass};
use crate::{Bsdf, LoadError, Rgb};
use glam::DVec3;

/// Where tables of Honeybee's sheets point upward if nothing is said.
const USUAL_UP: DVec3 = DVec3::new(0.01, 0.01, 1.0);

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
    let coated = || coated(&read, modifier, colour()?);
    let looks = &mut Looks { place: &place, findings };
    Ok(match modifier.kind.as_deref() {
        Some("Plastic") => looks.plastic(coated()?),
        Some("Metal") => looks.metal(coated()?),
        Some("Trans") => trans(&read, modifier, coated()?, looks)?,
        Some("Glass") => glass_look(&read, modifier, looks)?,
        Some("Mirror") => Look::from(Bsdf::Mirror(Mirror { reflectance: colour()? })),
        Some("BSDF" | "aBSDF" | "ABSDF") => sheet(&read, modifier, looks)?,
        Some("Light" | "Glow") => light(&read, modifier, looks)?,
        Some("Void") => Look::Open,
        other => Look::Unknown(Unusable::from(format!(
            "modifier \"{name}\" is of the type {:?}, for which there is nothing here; expected \
             Plastic, Metal, Trans, Glass, Mirror, BSDF, Light, Glow or Void",
            other.unwrap_or("none")
        ))),
    })
}

/// Colour and highlight of a modifier.
fn coated(read: &Reader<'_>, modifier: &Modifier, reflectance: Rgb) -> Result<Coated, LoadError> {
    let specularity = read.share("specularity", modifier.specularity)?;
    let roughness = read.share("roughness", modifier.roughness)?;
    Ok(Coated { reflectance, specularity, roughness })
}

fn trans(
    read: &Reader<'_>,
    modifier: &Modifier,
    coated: Coated,
    looks: &mut Looks<'_>,
) -> Result<Look, LoadError> {
    let transmitted = read.share("transmitted_diff", modifier.transmitted_diff)?;
    let straight = read.share("transmitted_spec", modifier.transmitted_spec)?;
    Ok(looks.trans(coated, transmitted, straight))
}

fn glass_look(
    read: &Reader<'_>,
    modifier: &Modifier,
    looks: &mut Looks<'_>,
) -> Result<Look, LoadError> {
    let Modifier { r_transmissivity: r, g_transmissivity: g, b_transmissivity: b, .. } = *modifier;
    let transmissivity = read.colour("transmissivity", [r, g, b])?;
    let eta = modifier.refraction_index.unwrap_or(glass::INDEX);
    if !(eta > 1.0 && eta <= 5.0) {
        let expected = "an index above 1, at most 5";
        return Err(refuse(read.file, read.name, "refraction_index", eta, expected));
    }
    Ok(looks.glass(eta, transmissivity))
}

fn sheet(read: &Reader<'_>, modifier: &Modifier, looks: &mut Looks<'_>) -> Result<Look, LoadError> {
    let place = looks.place;
    let Some(xml) = &modifier.bsdf_data else {
        let message = format!("{place}: no bsdf_data; expected the text of an XML file");
        return Err(LoadError::new(read.file, None, message));
    };
    if modifier.thickness.is_some_and(|thickness| thickness != 0.0) {
        looks.note("its thickness is left out: light meets the sheet where it is drawn");
    }
    if modifier.transform.is_some() {
        looks.note("its transform is left out");
    }
    let diffuse = [
        &modifier.front_diffuse_reflectance,
        &modifier.back_diffuse_reflectance,
        &modifier.diffuse_transmittance,
    ];
    if diffuse.into_iter().any(|shares| shares.iter().any(|&share| share != 0.0)) {
        looks.note("diffuse light beside that of its tables is left out");
    }
    let has_function = modifier.function_file.as_deref().is_some_and(|file| file != ".");
    if has_function || !modifier.dependencies.is_empty() {
        looks.note("its function_file and dependencies are left out");
    }
    let up = modifier.up_orientation.map_or(USUAL_UP, |up| up.0);
    if up.length() == 0.0 {
        let message = format!("{place}: up_orientation has no length; expected a direction");
        return Err(LoadError::new(read.file, None, message));
    }
    Ok(Look::Sheet { name: read.name.into(), xml: xml.as_str().into(), up })
}

fn light(read: &Reader<'_>, modifier: &Modifier, looks: &mut Looks<'_>) -> Result<Look, LoadError> {
    let Modifier { r_emittance: r, g_emittance: g, b_emittance: b, .. } = *modifier;
    let radiance = [r, g, b].map(|value| value.unwrap_or(0.0));
    if let Some(wrong) = radiance.into_iter().find(|value| !(0.0..=1e9).contains(value)) {
        let expected = "a radiance from 0 to 1e9";
        return Err(refuse(read.file, read.name, "emittance", wrong, expected));
    }
    let is_glow = modifier.kind.as_deref() == Some("Glow");
    let reach = modifier.max_radius.filter(|_| is_glow).unwrap_or(0.0);
    Ok(looks.light(radiance, reach))
}
