//! The luminaire: two wings that light a floor almost evenly, made from a formula.

use quasilux_photometry::{Photometry, read_ies};
use std::f64::consts::TAU;
use std::fmt::Write;

/// Below this angle the intensity makes up for distance and slope of the floor.
const EVEN_TO_DEG: f64 = 55.0;
/// From here on there is no light.
const DARK_FROM_DEG: f64 = 80.0;
/// How much more the wings get in C0 than in C90.
const WING: f64 = 0.4;

/// The luminaire, with what rejection must know of it.
pub(super) struct Luminaire {
    pub(super) photometry: Photometry,
    pub(super) maximum_cd: f64,
}

impl Luminaire {
    /// As a file gives it: gamma from 0 to 90 in steps of 5 degrees, C from 0 to 90 in steps of 15.
    pub(super) fn batwing() -> Self {
        let photometry =
            read_ies(file().as_bytes()).expect("the file is written by the rules").photometry;
        // Between the angles of the file the intensity is interpolated, so the maximum is there.
        let maximum_cd = gammas_deg()
            .flat_map(|gamma_deg| cs_deg().map(move |c_deg| candela(gamma_deg, c_deg)))
            .fold(0.0, f64::max);
        Self { photometry, maximum_cd }
    }

    /// The part of uniform directions below the horizon that rejection accepts.
    pub(super) fn acceptance(&self) -> f64 {
        self.photometry.flux_lm() / (TAU * self.maximum_cd)
    }
}

fn gammas_deg() -> impl ExactSizeIterator<Item = f64> {
    (0..19).map(|step| 5.0 * f64::from(step))
}

fn cs_deg() -> impl ExactSizeIterator<Item = f64> {
    (0..7).map(|step| 15.0 * f64::from(step))
}

fn file() -> String {
    let mut text = format!(
        "IESNA:LM-63-2002\n[TEST] Batwing of quasilux experiment rejection\nTILT=NONE\n\
         1 -1 1 {} {} 1 2 0 0 0\n1 1 0\n{}\n{}\n",
        gammas_deg().len(),
        cs_deg().len(),
        joined(gammas_deg()),
        joined(cs_deg()),
    );
    for c_deg in cs_deg() {
        let plane = gammas_deg().map(|gamma_deg| candela(gamma_deg, c_deg));
        writeln!(text, "{}", joined(plane)).expect("strings grow");
    }
    text
}

fn joined(values: impl Iterator<Item = f64>) -> String {
    values.map(|value| value.to_string()).collect::<Vec<_>>().join(" ")
}

/// `cos^-3 gamma` lights a floor evenly; the wings end smoothly, and are higher in C0 than in C90.
fn candela(gamma_deg: f64, c_deg: f64) -> f64 {
    let cos = libm::cos(gamma_deg.min(EVEN_TO_DEG).to_radians());
    let end = ((gamma_deg - EVEN_TO_DEG) / (DARK_FROM_DEG - EVEN_TO_DEG)).clamp(0.0, 1.0);
    let fading = 1.0 - end * end * (3.0 - 2.0 * end);
    let sin = libm::sin(gamma_deg.to_radians());
    let wing = 1.0 + WING * sin * sin * libm::cos(2.0 * c_deg.to_radians());
    (1000.0 * wing * fading / (cos * cos * cos)).round()
}
