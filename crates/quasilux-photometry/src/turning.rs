//! Luminaires turned about the vertical axis, gamma = 0.
//!
//! All azimuths of a table are shifted by one angle. A plane at C0, which files begin with, is
//! added where the shift leaves none: on a finer grid a bilinear function stays what it is.

use crate::{
    Angles, Grid, LuminaireFacts, LuminousShape, PhotometricType, Photometry, SphericalTable,
    Symmetry, Tilt,
};
use glam::DMat3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Axes and angles that differ by less are the same; in radians.
const SAME_RAD: f64 = 1e-9;

impl Photometry {
    /// Turns the luminaire about the vertical axis, into the frame of a container: what left
    /// along C0 leaves along the image of that direction.
    ///
    /// `None` where a file cannot hold it: for turns that move gamma = 0, for types A and B, for
    /// luminous openings and housings with sides along C0 that would lie aslant, for lamps whose
    /// light depends on the tilt, and for tables that jump at their closing plane.
    #[must_use]
    pub fn turned(&self, luminaire_from_photometry: DMat3) -> Option<Self> {
        let DMat3 { x_axis, z_axis, .. } = luminaire_from_photometry;
        if (z_axis.z - 1.0).abs() > SAME_RAD || z_axis.x.abs().max(z_axis.y.abs()) > SAME_RAD {
            return None;
        }
        let angle_rad = libm::atan2(x_axis.y, x_axis.x);
        if angle_rad.abs() < SAME_RAD {
            return Some(self.clone());
        }
        let facts = turned_facts(self.facts(), angle_rad)?;
        let table = match self.table().symmetry() {
            Symmetry::Rotational => self.table().clone(),
            _ => turned_table(self.table(), angle_rad)?,
        };
        Some(Self::new(table, facts).with_name(self.name()))
    }
}

fn turned_facts(facts: &LuminaireFacts, angle_rad: f64) -> Option<LuminaireFacts> {
    if facts.photometric_type != PhotometricType::C || facts.tilt != Tilt::None {
        return None;
    }
    let mut facts = facts.clone();
    let size_m = facts.shape().size_m();
    let is_circle = facts.shape().is_point() || facts.shape().is_round() && size_m.x == size_m.y;
    let quarters = (angle_rad / FRAC_PI_2).round();
    if (angle_rad - quarters * FRAC_PI_2).abs() > SAME_RAD {
        let is_round = |housing_m: &[f64; 3]| housing_m[1] == 0.0;
        let is_housed = facts.eulumdat.as_ref().is_some_and(|own| !is_round(&own.housing_m));
        return (is_circle && !is_housed).then_some(facts);
    }
    let quarters = quarters.rem_euclid(4.0) as usize;
    if let Some(eulumdat) = &mut facts.eulumdat {
        eulumdat.opening_heights_m.rotate_right(quarters);
        let [length_m, width_m, height_m] = eulumdat.housing_m;
        if quarters % 2 == 1 && width_m > 0.0 {
            eulumdat.housing_m = [width_m, length_m, height_m];
        }
    }
    if quarters % 2 == 1 && !is_circle {
        std::mem::swap(&mut facts.opening.width_m, &mut facts.opening.length_m);
        let turned = LuminousShape::from_opening(facts.standard, &facts.opening).size_m();
        let is_same = (turned.x, turned.y, turned.z) == (size_m.y, size_m.x, size_m.z);
        return is_same.then_some(facts);
    }
    Some(facts)
}

/// A column of the turned table.
struct Column {
    phi_rad: f64,
    /// The column that was there; between two of them without it.
    measured: Option<usize>,
}

fn turned_table(table: &SphericalTable, angle_rad: f64) -> Option<SphericalTable> {
    let grid = table.unfolded_grid();
    let count = grid.phi_rad.len();
    let mut rows = grid.values.chunks_exact(count);
    if rows.any(|row| row[0] != row[count - 1]) {
        return None;
    }
    let shifted = grid.phi_rad[..count - 1].iter().enumerate().map(|(measured, phi_rad)| {
        let phi_rad = (phi_rad + angle_rad).rem_euclid(TAU);
        let is_closing = phi_rad < SAME_RAD || TAU - phi_rad < SAME_RAD;
        Column { phi_rad: if is_closing { 0.0 } else { phi_rad }, measured: Some(measured) }
    });
    let mut columns: Vec<Column> = shifted.collect();
    columns.sort_by(|a, b| a.phi_rad.total_cmp(&b.phi_rad));
    if columns[0].phi_rad > 0.0 {
        columns.insert(0, Column { phi_rad: 0.0, measured: None });
    }
    columns.push(Column { phi_rad: TAU, measured: columns[0].measured });
    let mut values = Vec::with_capacity(grid.theta_rad.len() * columns.len());
    for (row, &theta_rad) in grid.values.chunks_exact(count).zip(&grid.theta_rad) {
        values.extend(columns.iter().map(|column| match column.measured {
            Some(measured) => row[measured],
            None => table.value_at(Angles { theta_rad, phi_rad: -angle_rad }),
        }));
    }
    let phi_rad = columns.iter().map(|column| column.phi_rad).collect();
    let grid = Grid { theta_rad: grid.theta_rad, phi_rad, symmetry: Symmetry::None, values };
    SphericalTable::new(grid).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{read_ies, write_ies};
    use glam::DVec3;

    /// Bilateral about C0, with an opening of 1.2 m along C0 by 0.1 m, or without one.
    fn file(opening: &str) -> Photometry {
        let text = format!(
            "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 4 1 2 {opening}\n1 1 20\n0 45 90\n\
             0 45 100 180\n300 200 10\n300 150 20\n300 80 30\n300 40 0\n"
        );
        read_ies(text.as_bytes()).unwrap().photometry
    }

    fn turn(angle_deg: f64) -> DMat3 {
        DMat3::from_rotation_z(angle_deg.to_radians())
    }

    #[test]
    fn a_turned_luminaire_shines_along_the_images_of_its_directions() {
        for (opening, angle_deg) in
            [("0.1 1.2 0", 90.0), ("0.1 1.2 0", -180.0), ("0 0 0", 37.0), ("-0.3 -0.3 0", -80.0)]
        {
            let file = file(opening);
            let turned = file.turned(turn(angle_deg)).unwrap();
            assert!((turned.flux_lm() / file.flux_lm() - 1.0).abs() < 1e-12, "{angle_deg}");
            let mut spread: f64 = 0.0;
            for i in 0..200 {
                let gamma = f64::from(i) * 0.0078;
                let c = f64::from(i) * 0.7;
                let direction = DVec3::new(
                    libm::sin(gamma) * libm::cos(c),
                    libm::sin(gamma) * libm::sin(c),
                    -libm::cos(gamma),
                );
                let found_cd = turned.intensity_cd(turn(angle_deg) * direction);
                let expected_cd = file.intensity_cd(direction);
                assert!((found_cd - expected_cd).abs() < 1e-9, "{angle_deg}: {found_cd}");
                spread = spread.max((turned.intensity_cd(direction) - expected_cd).abs());
            }
            assert!(spread > 1.0, "{spread}");
            // What is written reads back as the same.
            let written = write_ies(&turned, crate::IesStandard::Lm63Of2002);
            let back = read_ies(written.text.as_bytes()).unwrap().photometry;
            assert!((back.flux_lm() / file.flux_lm() - 1.0).abs() < 1e-6);
            let size_m = [&turned, &back].map(|it| it.facts().shape().size_m());
            assert!((size_m[0] - size_m[1]).length() < 1e-9, "{size_m:?}");
        }
        let turned = file("0.1 1.2 0").turned(turn(-90.0)).unwrap();
        let size_m = turned.facts().shape().size_m();
        assert!((size_m - DVec3::new(0.1, 1.2, 0.0)).length() < 1e-12, "{size_m}");
    }

    #[test]
    fn turns_that_no_file_can_hold_are_none() {
        assert!(file("0.1 1.2 0").turned(turn(30.0)).is_none());
        assert!(file("0 0 0").turned(DMat3::from_rotation_x(0.2)).is_none());
        assert!(file("0 0 0").turned(DMat3::from_rotation_x(3.0)).is_none());
        assert!(file("0.1 1.2 0").turned(DMat3::IDENTITY).is_some());
    }
}
