//! Files of types A and B: where their directions lie, what they integrate to, how they sample.
//!
//! The reference is written out here from the definitions of LM-63-2002, clause 3.0, and shares
//! nothing with the table: intensities bilinear in (H, V), solid angle `cos(latitude) dH dV`.

mod directions;
mod fluxes;
mod ranges;
mod sampling;

use glam::DVec3;
use quasilux_photometry::{PhotometricType, Photometry, WarningKind, read_ies};
use std::f64::consts::PI;

pub(super) const A_AND_B: [PhotometricType; 2] = [PhotometricType::A, PhotometricType::B];

/// A file by its angles in degrees and its intensity at (H, V).
pub(super) struct File<'a> {
    pub(super) photometric_type: PhotometricType,
    pub(super) horizontal_deg: &'a [f64],
    pub(super) vertical_deg: &'a [f64],
    pub(super) candela: &'a dyn Fn(f64, f64) -> f64,
}

impl File<'_> {
    pub(super) fn text(&self) -> String {
        let number = match self.photometric_type {
            PhotometricType::C => 1,
            PhotometricType::B => 2,
            PhotometricType::A => 3,
        };
        let line = |numbers: &mut dyn Iterator<Item = f64>| {
            let words: Vec<String> = numbers.map(|number| number.to_string()).collect();
            words.join(" ") + "\n"
        };
        let (h, v) = (self.horizontal_deg, self.vertical_deg);
        let mut text = format!(
            "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} {number} 2 0 0 0\n1 1 10\n",
            v.len(),
            h.len()
        );
        text += &line(&mut v.iter().copied());
        text += &line(&mut h.iter().copied());
        for &h in h {
            text += &line(&mut v.iter().map(|&v| (self.candela)(h, v)));
        }
        text
    }

    pub(super) fn read(&self) -> (Photometry, Vec<WarningKind>) {
        let read = read_ies(self.text().as_bytes()).unwrap();
        (read.photometry, read.warnings.iter().map(|warning| warning.kind()).collect())
    }

    pub(super) fn photometry(&self) -> Photometry {
        self.read().0
    }
}

/// The direction at (H, V) in degrees: photometric zero is -z, photometric horizontal +x, H
/// clockwise.
pub(super) fn direction(photometric_type: PhotometricType, h_deg: f64, v_deg: f64) -> DVec3 {
    let (sin_h, cos_h) = libm::sincos(h_deg / 180.0 * PI);
    let (sin_v, cos_v) = libm::sincos(v_deg / 180.0 * PI);
    match photometric_type {
        PhotometricType::A => DVec3::new(cos_v * cos_h, -cos_v * sin_h, sin_v),
        PhotometricType::B => DVec3::new(cos_h * sin_v, -sin_h, -cos_h * cos_v),
        PhotometricType::C => DVec3::new(sin_v * cos_h, sin_v * sin_h, -cos_v),
    }
}

/// The angle whose cosine the solid angle of a cell has.
fn latitude(photometric_type: PhotometricType, h_deg: f64, v_deg: f64) -> f64 {
    if photometric_type == PhotometricType::A { v_deg } else { h_deg }
}

/// The flux of each cell of the file, by midpoints: many along the latitude and, for the value is
/// linear along it, one along the longitude.
pub(super) fn cell_fluxes_lm(file: &File<'_>) -> Vec<f64> {
    const STEPS: usize = 4096;
    let mut fluxes_lm = Vec::new();
    for h in file.horizontal_deg.windows(2) {
        for v in file.vertical_deg.windows(2) {
            let corners = [(h[0], v[0]), (h[1], v[0]), (h[0], v[1]), (h[1], v[1])]
                .map(|(h, v)| (file.candela)(h, v));
            let value = |s: f64, t: f64| {
                (1.0 - t) * ((1.0 - s) * corners[0] + s * corners[1])
                    + t * ((1.0 - s) * corners[2] + s * corners[3])
            };
            let sum: f64 = (0..STEPS)
                .map(|i| {
                    let at = (i as f64 + 0.5) / STEPS as f64;
                    let (s, t) = match file.photometric_type {
                        PhotometricType::A => (0.5, at),
                        _ => (at, 0.5),
                    };
                    let (h, v) = (h[0] + s * (h[1] - h[0]), v[0] + t * (v[1] - v[0]));
                    let lat = latitude(file.photometric_type, h, v);
                    value(s, t) * libm::cos(lat / 180.0 * PI)
                })
                .sum();
            let area = (h[1] - h[0]) * (v[1] - v[0]) * (PI / 180.0) * (PI / 180.0);
            fluxes_lm.push(sum / STEPS as f64 * area);
        }
    }
    fluxes_lm
}

pub(super) fn uneven(first: f64) -> Vec<f64> {
    let all = [-90.0, -70.0, -45.0, -20.0, -5.0, 0.0, 3.0, 10.0, 30.0, 60.0, 90.0];
    all.into_iter().filter(|&angle| angle >= first).collect()
}

/// Points of a lattice in the unit square (golden ratio and its square).
pub(super) fn spread(index: u32) -> [f64; 2] {
    [0.754_877_666_246_693, 0.569_840_290_998_053].map(|step| (f64::from(index) * step).fract())
}
