//! cargo run --example inspect -- FILE
//!
//! Reads a measured surface of any known format and prints, for each side and scattering mode, the
//! albedo at normal incidence and at 60 degrees, then the warnings with line and column. Without a
//! file: a diffuse sample in the format of ASTM E1392.

use glam::DVec3;
use quasilux_bsdf::{ScatteringMode, Side, luminance, read_bsdf_named};
use std::error::Error;

const DIFFUSE: &[u8] = b"VARS theta_i,phi_i,theta_s,phi_s,BRDF\n0,0,0,0,0.2\n";

fn main() -> Result<(), Box<dyn Error>> {
    let name = std::env::args().nth(1).unwrap_or_default();
    let bytes = if name.is_empty() { DIFFUSE.to_vec() } else { std::fs::read(&name)? };
    // The name matters for DDR and DDT alone, whose content does not tell them apart.
    let file = read_bsdf_named(&name, &bytes).map_err(|error| format!("{name}:{error}"))?;

    println!("format  {}", file.bsdf.facts().format);
    let oblique = DVec3::new(0.75_f64.sqrt(), 0.0, 0.5);
    for side in Side::ALL {
        for mode in ScatteringMode::ALL {
            // A sheet may be dark on one side, or let nothing through.
            let Some(distribution) = file.bsdf.scattering(side, mode) else { continue };
            let [normal, oblique] =
                [DVec3::Z, oblique].map(|wi| luminance(distribution.albedo(wi)));
            println!("{side}, {mode}: albedo {normal:.3} at 0, {oblique:.3} at 60 degrees");
        }
    }
    for warning in &file.warnings {
        println!("{name}:{warning} ({:?})", warning.kind());
    }
    Ok(())
}
