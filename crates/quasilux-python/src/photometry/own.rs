//! Luminaires of a user's own numbers.

use super::analysis::radians;
use crate::error::input_error;
use pyo3::prelude::*;
use quasilux_photometry::{
    Axis, Grid, IesStandard, Keyword, LuminaireFacts, LuminousOpening, LuminousShape,
    PhotometricType, Photometry, Solid, SphericalTable, Standard, Symmetry, Tilt,
};

/// No luminaire means more: the bound of the readers.
const MAX_INTENSITY_CD: f64 = 1e18;

/// Angles may miss what they should be by this much, in degrees.
const ROUNDING_DEG: f64 = 1e-8;

/// Angles are at least so far apart, in degrees: of nearer ones on both sides of a multiple of 90
/// degrees, readers of files take both for it.
const NEAREST_DEG: f64 = 0.002;

/// Azimuths are at most this far from 0, in degrees.
const FURTHEST_DEG: f64 = 720.0;

/// What a luminaire has beside intensities.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(super) struct OwnFacts {
    /// Names and values in turn.
    keywords: Vec<[String; 2]>,
    lamp_count: f64,
    lumens_per_lamp: Option<f64>,
    input_watts: f64,
    luminous_shape: String,
    luminous_size_m: [f64; 3],
}

/// Intensities over the angles of photometric type C.
pub(super) struct OwnGrid<'a> {
    pub(super) c_deg: &'a [f64],
    pub(super) gamma_deg: &'a [f64],
    /// All angles gamma of the first plane, then of the next.
    pub(super) intensity_cd: &'a [f64],
}

/// A luminaire of these intensities and facts.
pub(super) fn luminaire(grid: &OwnGrid<'_>, facts: OwnFacts) -> PyResult<Photometry> {
    let table = SphericalTable::new(grid.checked()?).map_err(input_error)?;
    Ok(Photometry::new(table, facts.checked()?))
}

impl OwnGrid<'_> {
    fn checked(&self) -> PyResult<Grid> {
        let Self { c_deg, gamma_deg, intensity_cd } = *self;
        if gamma_deg.len() < 2 {
            let found = gamma_deg.len();
            return Err(input_error(format!("gamma_deg has {found} angles; expected 2 or more")));
        }
        if c_deg.is_empty() {
            return Err(input_error("c_deg has no angles; expected 1 or more"));
        }
        check_ascending("gamma_deg", gamma_deg, [0.0, 180.0])?;
        check_ascending("c_deg", c_deg, [-FURTHEST_DEG, FURTHEST_DEG])?;
        let symmetry = symmetry(c_deg)?;
        let angles = gamma_deg.len();
        if let Some(index) =
            intensity_cd.iter().position(|cd| !(0.0..=MAX_INTENSITY_CD).contains(cd))
        {
            let (plane, angle, cd) = (index / angles, index % angles, intensity_cd[index]);
            let message =
                format!("intensity_cd[{plane}, {angle}] is {cd}; expected 0 to 1e18 candela");
            return Err(input_error(message));
        }
        let at_angle = |angle: usize| intensity_cd.iter().skip(angle).step_by(angles).copied();
        Ok(Grid {
            theta_rad: gamma_deg.iter().copied().map(radians).collect(),
            phi_rad: c_deg.iter().copied().map(radians).collect(),
            symmetry,
            values: (0..angles).flat_map(at_angle).collect(),
        })
    }
}

fn check_ascending(name: &str, angles_deg: &[f64], [low, high]: [f64; 2]) -> PyResult<()> {
    for (index, &angle) in angles_deg.iter().enumerate() {
        if !(low..=high).contains(&angle) {
            let message = format!("{name}[{index}] is {angle}; expected {low} to {high} degrees");
            return Err(input_error(message));
        }
        if index > 0 && angle - angles_deg[index - 1] < NEAREST_DEG {
            let before = angles_deg[index - 1];
            let message = format!(
                "{name}[{index}] is {angle} after {before}; expected ascending angles, \
                 {NEAREST_DEG} degrees apart or more"
            );
            return Err(input_error(message));
        }
    }
    Ok(())
}

/// What the planes stand for, by their span, as in files.
fn symmetry(c_deg: &[f64]) -> PyResult<Symmetry> {
    let (first, last) = (c_deg[0], c_deg[c_deg.len() - 1]);
    let span = last - first;
    let spans = |wanted: f64| (span - wanted).abs() < ROUNDING_DEG;
    let quarters = (first / 90.0).round();
    let begins_on_axis = (first - 90.0 * quarters).abs() < ROUNDING_DEG;
    let widest = c_deg.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
    if c_deg.len() == 1 {
        Ok(Symmetry::Rotational)
    } else if spans(90.0) && begins_on_axis {
        Ok(Symmetry::Quadrant)
    } else if spans(180.0) && begins_on_axis {
        Ok(Symmetry::Bilateral)
    } else if spans(360.0) {
        Ok(Symmetry::None)
    } else if span > 180.0 && span < 360.0 && 360.0 - span <= 1.5 * widest {
        Ok(Symmetry::Open)
    } else {
        Err(input_error(format!(
            "c_deg spans {first} to {last} degrees; expected one plane (rotational symmetry), a \
             quarter or half a turn from a multiple of 90 degrees (mirrored in its ends), or a \
             whole turn"
        )))
    }
}

impl OwnFacts {
    fn checked(self) -> PyResult<LuminaireFacts> {
        let opening = self.opening()?;
        let positive = |x: f64| x > 0.0 && x <= MAX_INTENSITY_CD;
        check("lamp_count", self.lamp_count, positive(self.lamp_count), "a number above 0")?;
        if let Some(lumens) = self.lumens_per_lamp {
            let expected = "lumens above 0, or None for absolute photometry";
            check("lumens_per_lamp", lumens, positive(lumens), expected)?;
        }
        let is_power = (0.0..=MAX_INTENSITY_CD).contains(&self.input_watts);
        check("input_watts", self.input_watts, is_power, "watts, or 0 where they are not known")?;
        let keyword = |[name, value]: [String; 2]| Keyword { name, value, line: 0 };
        Ok(LuminaireFacts {
            standard: Standard::Lm63(IesStandard::Lm63Of2002),
            photometric_type: PhotometricType::C,
            keywords: self.keywords.into_iter().map(keyword).collect(),
            tilt: Tilt::None,
            lamp_count: self.lamp_count,
            lumens_per_lamp: self.lumens_per_lamp,
            ballast_factor: 1.0,
            ballast_lamp_field: 1.0,
            input_watts: self.input_watts,
            candela_factor: 1.0,
            opening,
            light_output_ratio: None,
            measurement_tilt_rad: 0.0,
            eulumdat: None,
        })
    }

    /// The dimensions with the signs by which LM-63-2002 has the shape.
    fn opening(&self) -> PyResult<LuminousOpening> {
        let [x, y, z] = self.luminous_size_m;
        if ![x, y, z].iter().all(|size| (0.0..=1e6).contains(size)) {
            let message = format!("luminous_size_m is {x}, {y}, {z}; expected 0 to 1e6 metres");
            return Err(input_error(message));
        }
        let (solid, [width, length, height]) = match self.luminous_shape.as_str() {
            "box" => (Solid::Cuboid, [1.0, 1.0, 1.0]),
            "cylinder" => (Solid::Cylinder(Axis::Z), [-1.0, -1.0, 1.0]),
            "cylinder along x" => (Solid::Cylinder(Axis::X), [-1.0, 1.0, -1.0]),
            "cylinder along y" => (Solid::Cylinder(Axis::Y), [1.0, -1.0, -1.0]),
            "ellipsoid" => (Solid::Ellipsoid, [-1.0, -1.0, -1.0]),
            other => {
                return Err(input_error(format!(
                    "luminous_shape is {other:?}; expected \"box\", \"cylinder\", \"cylinder along \
                     x\", \"cylinder along y\" or \"ellipsoid\""
                )));
            }
        };
        let opening =
            LuminousOpening { width_m: width * y, length_m: length * x, height_m: height * z };
        let wanted = LuminousShape::new(solid, glam::DVec3::new(x, y, z));
        let standard = Standard::Lm63(IesStandard::Lm63Of2002);
        if LuminousShape::from_opening(standard, &opening) == wanted {
            return Ok(opening);
        }
        let shape = &self.luminous_shape;
        Err(input_error(format!(
            "luminous_size_m is {x}, {y}, {z}; expected sizes that a luminous shape {shape:?} has"
        )))
    }
}

fn check(name: &str, value: f64, is_right: bool, expected: &str) -> PyResult<()> {
    if is_right {
        Ok(())
    } else {
        Err(input_error(format!("{name} is {value}; expected {expected}")))
    }
}
