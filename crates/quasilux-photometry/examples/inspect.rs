//! cargo run --example inspect -- FILE
//!
//! Reads a luminaire file of any known format and prints its flux, its maximum, the angles of its
//! beam, and each deviation from the standard with line and column. Without a file: a Lambertian
//! luminaire of 100 cd.

use quasilux_photometry::Format;
use std::error::Error;

/// LM-63: values at gamma = 0, 30, 60 and 90 degrees, between which the table is linear.
const LAMBERTIAN: &[u8] = b"IESNA:LM-63-2002\n[TEST] example\n[MANUFAC] none\nTILT=NONE\n\
    1 -1 1 4 1 1 2 0.3 0.3 0\n1 1 10\n0 30 60 90\n0\n100 86.6 50 0\n";

fn main() -> Result<(), Box<dyn Error>> {
    let name = std::env::args().nth(1).unwrap_or_default();
    let bytes = if name.is_empty() { LAMBERTIAN.to_vec() } else { std::fs::read(&name)? };
    let format = Format::from_file(&name, &bytes).ok_or("no format that this crate reads")?;
    // An error shows itself as `line:column: found ...; expected ...`.
    let file = format.read(&bytes).map_err(|error| format!("{name}:{error}"))?;

    let luminaire = &file.photometry;
    println!(
        "standard      {}, type {}",
        luminaire.facts().standard,
        luminaire.facts().photometric_type
    );
    println!("flux          {:.1} lm", luminaire.flux_lm());
    let maximum = luminaire.table().maximum();
    println!("maximum       {:.1} cd", maximum.value);
    for warning in &file.warnings {
        println!("{name}:{warning} ({:?})", warning.kind());
    }
    Ok(())
}
