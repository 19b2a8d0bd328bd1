//! Intensities of a luminaire file towards given directions, one a line, in candela.
//!
//!     cargo run --example intensities -- FILE C,GAMMA C,GAMMA ...
//!
//! C and gamma are in degrees. For comparisons with other programs: see `validation/ies2rad`.

use quasilux_photometry::{DVec3, read_ies, read_ldt};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments.next().ok_or("no FILE")?;
    let bytes = std::fs::read(&file)?;
    let is_ldt = file.to_ascii_lowercase().ends_with(".ldt");
    let read = if is_ldt { read_ldt(&bytes)? } else { read_ies(&bytes)? };
    for argument in arguments {
        let (c_deg, gamma_deg) = argument.split_once(',').ok_or("no comma in C,GAMMA")?;
        let direction = direction(c_deg.parse()?, gamma_deg.parse()?);
        println!("{:.9e}", read.photometry.intensity_cd(direction));
    }
    Ok(())
}

/// In the luminaire frame: gamma = 0 along -z, C0 along +x, C90 along +y.
fn direction(c_deg: f64, gamma_deg: f64) -> DVec3 {
    let (sin_c, cos_c) = libm::sincos(c_deg.to_radians());
    let (sin_gamma, cos_gamma) = libm::sincos(gamma_deg.to_radians());
    DVec3::new(sin_gamma * cos_c, sin_gamma * sin_c, -cos_gamma)
}
