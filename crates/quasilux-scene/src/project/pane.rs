//! `kind = "pane"`: a clear, a tinted or a measured pane.

use super::coefficients::{SHARES, eta, shares};
use super::document::{Section, Value};
use crate::LoadError;
use crate::bsdf::{AngularNode, AngularTable, Pane};
use std::f64::consts::FRAC_PI_2;

const TABLE: &str = "[[0, share], ..., [90, share]]: rising degrees, shares within 0 to 1";

pub(super) fn read(section: &Section<'_>) -> Result<Pane, LoadError> {
    let Some(value) = section.get("transmittance") else {
        if let Some(reflectance) = section.get("reflectance") {
            return Err(reflectance.error(
                "\"reflectance\" of a pane goes with a table of \"transmittance\"; expected eta, \
                 or both as tables",
            ));
        }
        return Ok(Pane::Clear { eta: eta(section)? });
    };
    if is_table(&value) { measured(section, value) } else { tinted(section, value) }
}

fn measured(section: &Section<'_>, value: Value<'_>) -> Result<Pane, LoadError> {
    if let Some(eta) = section.get("eta") {
        return Err(eta.error("\"eta\" and a table of \"transmittance\" exclude each other"));
    }
    let transmittance = table(value)?;
    let Some(value) = section.get("reflectance") else {
        return Ok(Pane::measured(transmittance, AngularTable::constant(0.0)));
    };
    let reflectance = table(value)?;
    // The sum is straight between the nodes of both tables.
    let nodes = transmittance.nodes().iter().chain(reflectance.nodes());
    let sum = |theta_rad| transmittance.at_angle(theta_rad) + reflectance.at_angle(theta_rad);
    let angles = nodes.map(|node| node.theta_rad).filter(|&theta_rad| sum(theta_rad) > 1.0 + 1e-9);
    match angles.reduce(f64::min) {
        Some(theta_rad) => Err(value.error(format!(
            "reflectance and transmittance add up to {:.4} at {:.1} degrees; expected at most 1",
            sum(theta_rad),
            theta_rad.to_degrees()
        ))),
        None => Ok(Pane::measured(transmittance, reflectance)),
    }
}

fn tinted(section: &Section<'_>, value: Value<'_>) -> Result<Pane, LoadError> {
    if let Some(reflectance) = section.get("reflectance") {
        return Err(reflectance.error(
            "\"reflectance\" of a pane goes with a table of \"transmittance\"; without, it follows \
             from eta",
        ));
    }
    let (eta, transmittance) = (eta(section)?, shares(value)?);
    let clear = Pane::clear_transmittance(eta);
    if transmittance.max_channel() > clear {
        return Err(value.unexpected(&format!(
            "{SHARES}, and at most {clear:.4}, which a clear pane of eta = {eta} lets through"
        )));
    }
    Ok(Pane::Tinted { eta, transmittance })
}

/// Whether it is a list of lists.
fn is_table(value: &Value<'_>) -> bool {
    let elements = value.array(TABLE).unwrap_or_default();
    elements.first().is_some_and(|element| element.array(TABLE).is_ok())
}

fn table(value: Value<'_>) -> Result<AngularTable, LoadError> {
    let mut nodes = Vec::new();
    for line in value.array(TABLE)? {
        let pair = line.array(TABLE)?;
        let [degrees, share] = pair.as_slice() else {
            return Err(line.unexpected(TABLE));
        };
        let degrees = degrees.number(TABLE, |x| (0.0..=90.0).contains(&x))?;
        let share = share.number(TABLE, |x| (0.0..=1.0).contains(&x))?;
        let theta_rad = if degrees == 90.0 { FRAC_PI_2 } else { degrees.to_radians() };
        nodes.push(AngularNode { theta_rad, share });
    }
    AngularTable::new(nodes).ok_or_else(|| value.unexpected(TABLE))
}
