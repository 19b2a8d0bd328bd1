//! Intensities of an LM-63 file whose luminaire is alike all round.

use quasilux_brute::{Candela, CandelaRow};

/// The table of a file, times a factor.
pub(super) fn read(text: &str, factor: f64) -> Result<Candela, String> {
    let start = text.find("TILT=NONE").ok_or("expected TILT=NONE")? + "TILT=NONE".len();
    let words = text[start..].split(|c: char| c.is_whitespace() || c == ',');
    let numbers: Vec<f64> =
        words.filter(|word| !word.is_empty()).map_while(|word| word.parse().ok()).collect();
    // Lamps, lumens, multiplier, angles, planes, type, units, width, length, height, two factors
    // of ballasts, watts; then the angles, the planes, the intensities.
    let angles = *numbers.get(3).ok_or("too few numbers")? as usize;
    let rest = numbers.get(13..).ok_or("too few numbers")?;
    if numbers[4] != 1.0 || numbers[5] != 1.0 || rest.len() < 2 * angles + 1 {
        return Err("expected one plane of type C".to_owned());
    }
    let scale = factor * numbers[2] * numbers[10] * numbers[11];
    let row = |number: usize| CandelaRow {
        gamma_rad: rest[number].to_radians(),
        intensity_cd: scale * rest[angles + 1 + number],
    };
    Ok(Candela::Table((0..angles).map(row).collect()))
}
