//! Intensities of a group of shining surfaces: what they send in each direction from afar.
//!
//! A surface of radiance L(w) with the area A(w) seen along w has the intensity L(w) A(w). With the
//! corrections that `ies2rad` writes the product is linear between the data again, so that a table
//! on their angles holds all of it; where it is not, the table is finer.

use super::pattern::{Angle, Distribution};
use super::shapes::Shape;
use super::tessellation::tessellate;
use glam::{DMat3, DVec3};
use quasilux_photometry::{Grid, Symmetry};
use std::f64::consts::PI;

/// Most intensities of a table.
const MAX_VALUES: usize = 2_000_000;
/// Beside an angle where light ends, in degrees.
const EDGE_DEG: f64 = 0.005;
/// Largest share of the greatest intensity that lines between angles may be off.
const MAX_ERROR: f64 = 2e-3;

/// Room for the tables of a scene.
#[derive(Debug)]
pub(super) struct Budget {
    values_left: usize,
    pub(super) is_spent: bool,
}

/// Most intensities of all luminaires, times the surfaces of each.
const MAX_ALL_VALUES: usize = 200_000_000;

impl Default for Budget {
    fn default() -> Self {
        Self { values_left: MAX_ALL_VALUES, is_spent: false }
    }
}

impl Budget {
    pub(super) fn spend(&mut self, values: usize) -> Result<(), String> {
        match self.values_left.checked_sub(values) {
            Some(left) => {
                self.values_left = left;
                Ok(())
            }
            None => {
                self.is_spent = true;
                Err(format!(
                    "up to here the luminaires of the scene have more than {MAX_ALL_VALUES} \
                     intensities; expected fewer"
                ))
            }
        }
    }
}

/// Surfaces that shine together.
pub(super) struct Emitter {
    parts: Vec<Part>,
    pub(super) luminance_cd_m2: f64,
    pub(super) distribution: Option<Distribution>,
    pub(super) cone: Option<Cone>,
    /// From the frame of the luminaire; never a mirror image.
    pub(super) world_from_luminaire: DMat3,
}

/// Directions of a spotlight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) axis: DVec3,
    /// Half of the full angle.
    pub(super) half_deg: f64,
}

enum Part {
    Flat {
        normal: DVec3,
        area: f64,
    },
    Sphere {
        radius: f64,
    },
    Side {
        axis: DVec3,
        radius: f64,
        length: f64,
    },
    /// Flat pieces by their normals times their areas.
    Pieces(Vec<DVec3>),
}

impl Part {
    /// `None` for surfaces that do not shine outward.
    fn from_shape(shape: &Shape) -> Option<Self> {
        Some(match shape {
            Shape::Polygon(corners) => {
                let origin = corners[0];
                let across = |pair: &[DVec3]| (pair[0] - origin).cross(pair[1] - origin);
                let area = 0.5 * corners.windows(2).map(across).sum::<DVec3>();
                Self::Flat { normal: area.normalize_or_zero(), area: area.length() }
            }
            Shape::Ring { normal, inner_radius, outer_radius, .. } => {
                let area = PI * (outer_radius * outer_radius - inner_radius * inner_radius);
                Self::Flat { normal: *normal, area }
            }
            Shape::Sphere { radius, is_inward: false, .. } => Self::Sphere { radius: *radius },
            Shape::Cone { from, to, from_radius, to_radius, is_inward: false } => {
                let axis = *to - *from;
                if from_radius == to_radius {
                    let (radius, length) = (*from_radius, axis.length());
                    Self::Side { axis: axis.normalize_or_zero(), radius, length }
                } else {
                    let area = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a);
                    Self::Pieces(tessellate(shape, true).into_iter().map(area).collect())
                }
            }
            _ => return None,
        })
    }

    /// The area that is seen along a direction.
    fn shown(&self, along: DVec3) -> f64 {
        match self {
            Self::Flat { normal, area } => area * normal.dot(along).max(0.0),
            Self::Sphere { radius } => PI * radius * radius,
            Self::Side { axis, radius, length } => {
                2.0 * radius * length * axis.cross(along).length()
            }
            Self::Pieces(pieces) => pieces.iter().map(|area| area.dot(along).max(0.0)).sum(),
        }
    }

    /// The area that faces a direction.
    fn facing(&self, along: DVec3) -> f64 {
        match self {
            Self::Flat { normal, area } if normal.dot(along) > 0.0 => *area,
            Self::Flat { .. } => 0.0,
            Self::Sphere { radius } => 2.0 * PI * radius * radius,
            Self::Side { radius, length, .. } => PI * radius * length,
            Self::Pieces(pieces) => {
                let facing = pieces.iter().filter(|area| area.dot(along) > 0.0);
                facing.map(|area| area.length()).sum()
            }
        }
    }
}

/// Angles of a table in degrees.
struct Angles {
    theta: Vec<f64>,
    phi: Vec<f64>,
}

impl Emitter {
    /// `None` where a surface does not shine outward.
    pub(super) fn new(
        shapes: &[&Shape],
        luminance_cd_m2: f64,
        distribution: Option<Distribution>,
        cone: Option<Cone>,
    ) -> Option<Self> {
        let parts =
            shapes.iter().map(|shape| Part::from_shape(shape)).collect::<Option<Vec<_>>>()?;
        let turn = match (&distribution, cone) {
            (Some(distribution), _) => distribution.frame.turn,
            (None, Some(cone)) => {
                let up = -cone.axis;
                let x = up.any_orthonormal_vector();
                DMat3::from_cols(x, up.cross(x), up)
            }
            (None, None) => DMat3::IDENTITY,
        };
        let mirror = if turn.determinant() < 0.0 { -1.0 } else { 1.0 };
        let world_from_luminaire = turn * DMat3::from_diagonal(DVec3::new(1.0, mirror, 1.0));
        Some(Self { parts, luminance_cd_m2, distribution, cone, world_from_luminaire })
    }

    /// In cd, toward angles in degrees; surfaces count by whether they face angles beside them.
    fn intensity_cd(&self, theta: f64, phi: f64, beside: f64) -> f64 {
        let world = |theta: f64| self.world_from_luminaire * direction(theta, phi);
        let (along, faced) = (world(theta), world(theta + beside));
        if let Some(Cone { axis, half_deg }) = self.cone {
            let off = libm::atan2(axis.cross(faced).length(), axis.dot(faced)).to_degrees();
            if off > half_deg {
                return 0.0;
            }
        }
        let (factor, is_flat) = match &self.distribution {
            None => (1.0, false),
            Some(it) => (it.factor(it.frame.turn.transpose() * along), it.is_flat()),
        };
        if factor == 0.0 {
            return 0.0;
        }
        let area = |part: &Part| if is_flat { part.facing(faced) } else { part.shown(faced) };
        self.luminance_cd_m2 * factor * self.parts.iter().map(area).sum::<f64>()
    }

    /// The table of intensities; `Err` where it is too large.
    pub(super) fn grid(&self, budget: &mut Budget) -> Result<Grid, String> {
        let mut angles = self.angles();
        self.charge(&angles, budget)?;
        if !self.is_linear(&angles) {
            angles.theta.extend((0..=180).map(f64::from));
            angles.phi.extend((0..=72).map(|step| 5.0 * f64::from(step)));
            sort(&mut angles.theta);
            sort(&mut angles.phi);
            self.charge(&angles, budget)?;
        }
        Ok(self.table(&angles))
    }

    /// Takes a table off what those of a scene may have, too large or not.
    fn charge(&self, angles: &Angles, budget: &mut Budget) -> Result<(), String> {
        let values = angles.theta.len().saturating_mul(angles.phi.len());
        budget.spend(values.saturating_mul(self.parts.len()))?;
        if values > MAX_VALUES {
            return Err(format!("its table would have more than {MAX_VALUES} intensities"));
        }
        Ok(())
    }

    fn angles(&self) -> Angles {
        let mut theta = vec![0.0, 90.0, 180.0];
        let mut phi = Vec::new();
        let data = self.distribution.as_ref();
        let is_mirrored = data.is_some_and(|it| it.frame.is_mirrored());
        match data.and_then(|it| it.axis(|it| it == Angle::Theta)) {
            Some(axis) => {
                theta.extend(&axis);
                // Beyond the data there is no light.
                let last = axis[axis.len() - 1] + 2.0 * EDGE_DEG;
                theta.extend([axis[0] - 2.0 * EDGE_DEG, last]);
            }
            None => theta.extend((0..=72).map(|step| 2.5 * f64::from(step))),
        }
        theta.extend(self.cone.map(|cone| cone.half_deg));
        theta.retain(|theta| (0.0..=180.0).contains(theta));
        let around = |it| matches!(it, Angle::Phi | Angle::Phi2 | Angle::Phi4);
        if let Some(axis) = data.and_then(|it| it.axis(around)) {
            let turned = |&at: &f64| if is_mirrored { 360.0 - at } else { at };
            phi.extend(axis.iter().map(|at| at.rem_euclid(360.0)).map(|at| turned(&at)));
            for mirrored in [180.0, 360.0] {
                let has = |it: &Distribution| match mirrored {
                    180.0 => it.has(Angle::Phi4),
                    _ => !it.has(Angle::Phi),
                };
                if data.is_some_and(has) {
                    phi.extend(phi.clone().into_iter().map(|at| mirrored - at));
                }
            }
            phi.extend([0.0, 360.0]);
        } else {
            phi.push(0.0);
        }
        phi.retain(|phi| (0.0..=360.0).contains(phi));
        sort(&mut theta);
        sort(&mut phi);
        Angles { theta, phi }
    }

    /// Whether intensities are straight lines between the angles, as far as middles show it.
    fn is_linear(&self, Angles { theta, phi }: &Angles) -> bool {
        let (mut most, mut error) = (0.0_f64, 0.0_f64);
        let rows = theta.windows(2).filter(|pair| pair[1] - pair[0] > 4.0 * EDGE_DEG);
        for pair in rows {
            let inside = 1e-4;
            let at = |theta: f64, phi: f64| {
                self.intensity_cd(theta, phi, if theta == pair[0] { inside } else { -inside })
            };
            let middle = 0.5 * (pair[0] + pair[1]);
            let columns = if phi.len() > 1 { phi.windows(2).collect() } else { vec![] };
            for columns in &columns {
                let corners = [
                    at(pair[0], columns[0]),
                    at(pair[0], columns[1]),
                    at(pair[1], columns[0]),
                    at(pair[1], columns[1]),
                ];
                let found = at(middle, 0.5 * (columns[0] + columns[1]));
                most = corners.into_iter().fold(most, f64::max);
                error = error.max((found - 0.25 * corners.iter().sum::<f64>()).abs());
            }
            if columns.is_empty() {
                let [a, b] = [at(pair[0], 0.0), at(pair[1], 0.0)];
                most = most.max(a).max(b);
                for phi in [0.0, 37.0, 90.0, 143.0, 261.0] {
                    error = error.max((at(middle, phi) - 0.5 * (a + b)).abs());
                }
            }
        }
        error <= MAX_ERROR * most
    }

    fn table(&self, Angles { theta, phi }: &Angles) -> Grid {
        let inside = 1e-4;
        let row = |theta: f64, beside: f64| -> Vec<f64> {
            phi.iter().map(|&phi| self.intensity_cd(theta, phi, beside)).collect()
        };
        let mut rows: Vec<Row> = Vec::new();
        for &theta in theta {
            let before = if theta > 0.0 { row(theta, -inside) } else { row(theta, inside) };
            let behind = if theta < 180.0 { row(theta, inside) } else { before.clone() };
            let most = before.iter().chain(&behind).copied().fold(0.0, f64::max);
            let differ = before.iter().zip(&behind).any(|(a, b)| (a - b).abs() > 1e-5 * most);
            if differ {
                rows.push(Row { theta: theta - EDGE_DEG, values: before });
                rows.push(Row { theta: theta + EDGE_DEG, values: behind });
            } else {
                rows.push(Row { theta, values: before });
            }
        }
        cut_dark_half(&mut rows);
        let symmetry = if phi.len() == 1 { Symmetry::Rotational } else { Symmetry::None };
        Grid {
            theta_rad: rows.iter().map(|row| row.theta.to_radians()).collect(),
            phi_rad: phi.iter().map(|phi| phi.to_radians()).collect(),
            symmetry,
            values: rows.iter().flat_map(|row| row.values.iter().map(|&it| rounded(it))).collect(),
        }
    }
}

/// Intensities at one polar angle in degrees.
struct Row {
    theta: f64,
    values: Vec<f64>,
}

/// Leaves the upper half out where there is no light.
fn cut_dark_half(rows: &mut Vec<Row>) {
    let is_dark = |row: &Row| row.values.iter().all(|&value| value == 0.0);
    if !rows.iter().filter(|row| row.theta > 90.0).all(is_dark) {
        return;
    }
    rows.retain(|row| row.theta <= 90.0);
    match rows.last_mut() {
        Some(last) if last.theta >= 90.0 - 1.5 * EDGE_DEG => last.theta = 90.0,
        _ => {}
    }
}

/// Ten digits: more come from the rounding of coordinates.
fn rounded(value: f64) -> f64 {
    format!("{value:.9e}").parse().unwrap_or(value)
}

fn sort(angles: &mut Vec<f64>) {
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
}

/// Toward the angles of the luminaire, in degrees: theta from -z, phi from +x towards +y.
fn direction(theta: f64, phi: f64) -> DVec3 {
    let (sin, cos) = libm::sincos(theta.to_radians());
    let (y, x) = libm::sincos(phi.to_radians());
    DVec3::new(x * sin, y * sin, -cos)
}
