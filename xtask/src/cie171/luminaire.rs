//! The luminaires of the cases, by formula, as LM-63-2002 files.

use std::fmt::Write;

/// Intensities over gamma, the same in all planes.
struct Beam {
    title: &'static str,
    /// (gamma in degrees, intensity in cd); ascending, the last at 90.
    table: Vec<(f64, f64)>,
}

/// 1000 cd after the cosine law, in steps of half a degree: interpolation is 1e-5 too low at most.
pub(crate) fn cosine_file() -> String {
    let value = |k: u32| {
        let gamma_deg = 0.5 * f64::from(k);
        // At 90 degrees the cosine leaves a rounding error that must not become negative.
        (gamma_deg, (1000.0 * libm::cos(gamma_deg.to_radians())).max(0.0))
    };
    Beam { title: "1000 cd after the cosine law", table: (0..=180).map(value).collect() }.file()
}

/// Lights a plane evenly: I = E h^2 / cos^3 gamma until past `last_deg`, in steps of a tenth of a
/// degree, where interpolation is 5e-5 too high at most; nothing beyond.
pub(crate) fn even_file(illuminance_lx: f64, height_m: f64, last_deg: u32) -> String {
    let value = |k: u32| {
        let gamma_deg = 0.1 * f64::from(k);
        let cos = libm::cos(gamma_deg.to_radians());
        (gamma_deg, illuminance_lx * height_m * height_m / (cos * cos * cos))
    };
    let lit = (0..=10 * last_deg).map(value);
    let end_deg = f64::from(last_deg) + 0.01;
    Beam {
        title: "lights a plane evenly, within a cone",
        table: lit.chain([(end_deg, 0.0), (90.0, 0.0)]).collect(),
    }
    .file()
}

impl Beam {
    fn file(&self) -> String {
        let mut text = format!(
            "IESNA:LM-63-2002\n[TEST] computed from a formula, not measured: {}\n[TESTLAB] none\n\
             [ISSUEDATE] 22-NOV-2026\n[MANUFAC] none\nTILT=NONE\n1 -1 1 {} 1 1 2 0 0 0\n1 1 1\n",
            self.title,
            self.table.len(),
        );
        let mut lines = |values: &[String]| {
            for line in values.chunks(15) {
                writeln!(text, "{}", line.join(" ")).expect("strings grow");
            }
        };
        let angles: Vec<String> =
            self.table.iter().map(|(deg, _)| trimmed(format!("{deg:.2}"))).collect();
        let candelas: Vec<String> =
            self.table.iter().map(|(_, cd)| trimmed(format!("{cd:.4}"))).collect();
        lines(&angles);
        lines(&["0".to_owned()]);
        lines(&candelas);
        text.replace('\n', "\r\n")
    }
}

/// Without zeros behind the point.
fn trimmed(number: String) -> String {
    number.trim_end_matches('0').trim_end_matches('.').to_owned()
}
