//! The photometry of the office's luminaire: a linear batwing by formula, as an LM-63-2002 file.
//!
//! Along the luminaire (C0) the intensity falls a little faster than a cosine; across it (C90) it
//! rises to a maximum near gamma = 37 degrees and is screened above 60 degrees, as office optics
//! are. Between the two planes it is mixed with cos^2 C and sin^2 C. There is no light upward.

use std::fmt::Write;
use xtask::workspace::Failure;

/// Flux of one luminaire.
const FLUX_LM: f64 = 3000.0;
const GAMMA_STEP_DEG: f64 = 2.5;
const GAMMAS: usize = 37;
const C_STEP_DEG: f64 = 15.0;
/// Planes from C0 to C90: the distribution has the symmetry of a rectangle.
const PLANES: usize = 7;

const KEYWORDS: &str = "\
IESNA:LM-63-2002
[TEST] computed from a formula, not measured
[TESTLAB] none
[ISSUEDATE] 21-NOV-2026
[MANUFAC] quasilux examples
[LUMCAT] BATWING-1200
[LUMINAIRE] Linear suspended luminaire, 1.2 m, direct, batwing
[LAMP] LED; the lumens below leave the luminaire
TILT=NONE
";

/// The text of the file, with the line ends that the standard asks for.
pub(crate) fn file() -> Result<String, Failure> {
    let unscaled = table(1.0);
    let candelas = table(FLUX_LM / flux_lm(&unscaled));
    let mut text = KEYWORDS.to_owned();
    let header = format!(
        "1 {FLUX_LM} 1 {GAMMAS} {PLANES} 1 2 0.2 1.2 0\n1 1 24\n{}{}",
        wrapped((0..GAMMAS).map(|i| (GAMMA_STEP_DEG * i as f64).to_string())),
        wrapped((0..PLANES).map(|i| (C_STEP_DEG * i as f64).to_string())),
    );
    text.push_str(&header);
    for plane in candelas {
        text.push_str(&wrapped(plane.iter().map(|intensity_cd| format!("{intensity_cd:.1}"))));
    }
    if !text.is_ascii() {
        return Err("an LM-63 file is ASCII text".into());
    }
    Ok(text.replace('\n', "\r\n"))
}

/// Intensities by plane and gamma, times a factor.
fn table(factor: f64) -> Vec<Vec<f64>> {
    let plane = |c: usize| {
        let c_rad = (C_STEP_DEG * c as f64).to_radians();
        (0..GAMMAS)
            .map(|g| factor * shape(c_rad, (GAMMA_STEP_DEG * g as f64).to_radians()))
            .collect()
    };
    (0..PLANES).map(plane).collect()
}

/// Intensity relative to the one straight down.
fn shape(c_rad: f64, gamma_rad: f64) -> f64 {
    let gamma_deg = gamma_rad.to_degrees();
    let (sin, cos) = libm::sincos(gamma_rad);
    // At 90 degrees the cosine leaves a rounding error that must not become negative.
    let cos = cos.max(0.0);
    let along = cos / (1.0 + libm::pow(gamma_deg / 60.0, 6.0));
    let across = cos * (1.0 + 3.0 * sin * sin) / (1.0 + libm::pow(gamma_deg / 55.0, 8.0));
    let (sin_c, cos_c) = libm::sincos(c_rad);
    along * cos_c * cos_c + across * sin_c * sin_c
}

/// Flux of a table of one quadrant, interpolated linearly in both angles.
///
/// Over C that is the trapezoidal rule. Over gamma, with intensity a at g and b at g + h, the
/// integral of I sin is a cos g - b cos(g + h) + (b - a)(sin(g + h) - sin g) / h.
fn flux_lm(table: &[Vec<f64>]) -> f64 {
    let step_rad = GAMMA_STEP_DEG.to_radians();
    let band = |plane: &Vec<f64>, g: usize| {
        let (sin0, cos0) = libm::sincos(step_rad * g as f64);
        let (sin1, cos1) = libm::sincos(step_rad * (g + 1) as f64);
        let (a, b) = (plane[g], plane[g + 1]);
        a * cos0 - b * cos1 + (b - a) * (sin1 - sin0) / step_rad
    };
    let plane_flux = |plane: &Vec<f64>| (0..GAMMAS - 1).map(|g| band(plane, g)).sum::<f64>();
    let fluxes: Vec<f64> = table.iter().map(plane_flux).collect();
    let trapezoids = fluxes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).sum::<f64>();
    4.0 * trapezoids * C_STEP_DEG.to_radians()
}

/// Numbers separated by spaces, ten a line.
fn wrapped(numbers: impl Iterator<Item = String>) -> String {
    let numbers: Vec<String> = numbers.collect();
    numbers.chunks(10).fold(String::new(), |mut text, line| {
        let _ = writeln!(text, "{}", line.join(" "));
        text
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers after the keywords, as any reader finds them.
    fn numbers() -> Vec<f64> {
        let text = file().unwrap();
        let (_, body) = text.split_once("TILT=NONE\r\n").unwrap();
        body.split_whitespace().map(|word| word.parse().unwrap()).collect()
    }

    /// The flux of the written table by the midpoint rule, 1/8 degree in gamma and 1 degree in C.
    #[test]
    fn the_flux_of_the_file_is_the_one_it_states() {
        let numbers = numbers();
        let candelas = &numbers[13 + GAMMAS + PLANES..];
        assert_eq!(candelas.len(), GAMMAS * PLANES);
        let intensity_cd = |c_deg: f64, gamma_deg: f64| {
            let (c, g) = (c_deg / C_STEP_DEG, gamma_deg / GAMMA_STEP_DEG);
            let (i, j) = (c.floor(), g.floor());
            let at = |i: f64, j: f64| candelas[i as usize * GAMMAS + j as usize];
            let low = at(i, j) + (g - j) * (at(i, j + 1.0) - at(i, j));
            let high = at(i + 1.0, j) + (g - j) * (at(i + 1.0, j + 1.0) - at(i + 1.0, j));
            low + (c - i) * (high - low)
        };
        let mut flux_lm = 0.0;
        for c in 0..90 {
            for g in 0..720 {
                let gamma_deg = (f64::from(g) + 0.5) / 8.0;
                flux_lm +=
                    intensity_cd(f64::from(c) + 0.5, gamma_deg) * libm::sin(gamma_deg.to_radians());
            }
        }
        flux_lm *= 4.0 * 1.0_f64.to_radians() * 0.125_f64.to_radians();
        assert!((flux_lm / numbers[1] - 1.0).abs() < 1e-4, "{flux_lm} lm");
        assert_eq!(numbers[1], FLUX_LM);
    }

    #[test]
    fn the_distribution_is_a_batwing_across_and_a_lobe_along() {
        let table = table(1.0);
        let peak =
            |plane: &[f64]| (0..GAMMAS).max_by(|&a, &b| plane[a].total_cmp(&plane[b])).unwrap();
        assert_eq!(peak(&table[0]), 0);
        let peak_deg = GAMMA_STEP_DEG * peak(&table[PLANES - 1]) as f64;
        assert!((35.0..40.0).contains(&peak_deg), "peak at {peak_deg} degrees");
        assert!(table.iter().flatten().all(|intensity| *intensity >= 0.0));
    }
}
