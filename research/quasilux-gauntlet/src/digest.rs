//! What decides over the illuminances of a room, as a hash.

use crate::room::{Room, Shine, SkyKind, Surface};
use glam::DVec3;

/// FNV-1a.
pub(crate) struct Fnv(u64);

impl Room {
    /// A hash of all that decides over the illuminances: FNV-1a over the bits of all numbers. Hints
    /// and openings are no part of it.
    #[must_use]
    pub fn digest(&self) -> String {
        let mut hash = Fnv::new();
        for face in &self.faces {
            face.corners.iter().for_each(|&corner| hash.vector(corner));
            hash.surface(face.surface);
            hash.numbers(&[face.luminance_cd_m2]);
        }
        for lamp in &self.lamps {
            hash.vector(lamp.position);
            match &lamp.shine {
                Shine::Everywhere(intensity_cd) => hash.numbers(&[10.0, *intensity_cd]),
                Shine::Table { aim, rows } => {
                    hash.vector(*aim);
                    rows.iter().for_each(|row| hash.numbers(row));
                }
            }
        }
        for place in &self.places {
            hash.vector(place.position);
            hash.vector(place.normal);
            place.cell.into_iter().flatten().for_each(|edge| hash.vector(edge));
            if place.disc_radius_m > 0.0 {
                hash.numbers(&[place.disc_radius_m]);
            }
        }
        self.digest_outside(&mut hash);
        hash.text()
    }

    fn digest_outside(&self, hash: &mut Fnv) {
        let Some(outside) = &self.outside else { return };
        let kind = match outside.sky {
            SkyKind::Uniform => 20.0,
            SkyKind::Overcast => 21.0,
        };
        hash.numbers(&[kind, outside.zenith_cd_m2, outside.ground_reflectance]);
        if let Some(sun) = &outside.sun {
            hash.numbers(&[sun.altitude_deg, sun.azimuth_deg, sun.normal_illuminance_lx]);
        }
    }
}

impl Fnv {
    pub(crate) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    pub(crate) fn text(&self) -> String {
        format!("{:016x}", self.0)
    }

    fn numbers(&mut self, numbers: &[f64]) {
        numbers.iter().for_each(|number| self.bytes(&number.to_bits().to_le_bytes()));
    }

    fn vector(&mut self, vector: DVec3) {
        self.numbers(&vector.to_array());
    }

    fn surface(&mut self, surface: Surface) {
        match surface {
            Surface::Grey(reflectance) => self.numbers(&[0.0, reflectance]),
            Surface::Mirror(reflectance) => self.numbers(&[1.0, reflectance]),
            Surface::Glass(eta) => self.numbers(&[2.0, eta]),
            Surface::Pane(eta) => self.numbers(&[3.0, eta]),
            Surface::Translucent { reflectance, transmittance } => {
                self.numbers(&[4.0, reflectance, transmittance]);
            }
            Surface::Metal { reflectance, roughness } => {
                self.numbers(&[5.0, reflectance, roughness]);
            }
        }
    }
}
