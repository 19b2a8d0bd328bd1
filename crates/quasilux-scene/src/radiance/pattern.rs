//! Distributions of `source.cal`, as `ies2rad` writes them: `brightdata` over the angles of light.
//!
//! `theta` is measured from -z, `phi` from +x towards +y, of the direction in which light leaves
//! (Radiance's `source.cal`). The radiance of the surface is that of its material times the value
//! of the data, and a correction for how the surface looks from there.

use super::data::Data;
use super::document::shown;
use super::frame::Frame;
use super::xform::{Parsed, Transforms};
use crate::radiance::definitions::Definition;
use glam::DVec3;
use std::f64::consts::PI;
use std::rc::Rc;

/// A distribution around a frame of its own.
#[derive(Clone, Debug)]
pub(super) struct Distribution {
    correction: Scaling,
    coordinates: Vec<Coordinate>,
    data: Rc<Data>,
    pub(super) frame: Frame,
}

/// Factor on the values of the data.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scaling {
    /// As it is.
    Plain(f64),
    /// Over the cosine at the surface.
    Flat(f64),
    /// Over the area that a box shows, by those of its sides across x, y and z in m2.
    Box(f64, DVec3),
    /// Over the area that a cylinder along z shows, by those from the side and from an end in m2.
    Cylinder(f64, [f64; 2]),
}

/// Surfaces of one material that shine as one luminaire.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Grouping {
    /// The sides of a body.
    Body,
    /// Both sides of a sheet.
    Sheet,
    /// None.
    Apart,
}

/// Coordinate of data: an angle and what is added to it, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Coordinate {
    angle: Angle,
    shift_deg: f64,
}

/// An angle of a direction, in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Angle {
    Theta,
    /// All around.
    Phi,
    /// Mirrored at the plane of x and z.
    Phi2,
    /// Mirrored at both planes.
    Phi4,
    /// Of photometric type B; mirrored where true.
    Vertical(bool),
    Horizontal(bool),
}

impl Coordinate {
    /// By a name, or by one with a number behind a sign: `src_phi2+90`.
    fn named(name: &str) -> Option<Self> {
        let sign = name.rfind(['+', '-']).filter(|&at| at > 0).unwrap_or(name.len());
        let (name, shift) = name.split_at(sign);
        let shift_deg = if shift.is_empty() { 0.0 } else { shift.parse().ok()? };
        let angle = Angle::named(name).filter(|_| f64::abs(shift_deg) <= 360.0)?;
        Some(Self { angle, shift_deg })
    }

    /// Of a direction in which light leaves.
    fn angle_deg(self, direction: DVec3) -> f64 {
        self.angle.angle_deg(direction) + self.shift_deg
    }
}

impl Angle {
    fn named(name: &str) -> Option<Self> {
        Some(match name {
            "src_theta" | "q_gamma" => Self::Theta,
            "src_phi" | "q_c" => Self::Phi,
            "src_phi2" => Self::Phi2,
            "src_phi4" => Self::Phi4,
            "srcB_vert" => Self::Vertical(false),
            "srcB_vert2" => Self::Vertical(true),
            "srcB_horiz" => Self::Horizontal(false),
            "srcB_horiz2" => Self::Horizontal(true),
            _ => return None,
        })
    }

    /// Of a direction in which light leaves.
    fn angle_deg(self, direction: DVec3) -> f64 {
        let DVec3 { x, y, z } = direction;
        let phi = || libm::atan2(y, x).to_degrees().rem_euclid(360.0);
        let folded = |angle: f64, most: f64| {
            let rest = angle.rem_euclid(2.0 * most);
            if rest > most { 2.0 * most - rest } else { rest }
        };
        let mirrored =
            |angle: f64, is_mirrored: bool| if is_mirrored { angle.abs() } else { angle };
        match self {
            Self::Theta => libm::atan2((x * x + y * y).sqrt(), -z).to_degrees(),
            Self::Phi => phi(),
            Self::Phi2 => folded(phi(), 180.0),
            Self::Phi4 => folded(phi(), 90.0),
            Self::Vertical(is_mirrored) => mirrored(libm::atan2(x, -z).to_degrees(), is_mirrored),
            Self::Horizontal(is_mirrored) => {
                mirrored(libm::atan2(-y, -z).to_degrees(), is_mirrored)
            }
        }
    }
}

/// Arguments of a `brightdata`.
pub(super) struct Arguments<'d> {
    pub(super) function: &'d str,
    pub(super) data_file: &'d str,
    functions: &'d str,
    coordinates: Vec<&'d str>,
    pub(super) frame: Frame,
}

impl<'d> Arguments<'d> {
    /// Arguments of a definition; `None` where it is something else.
    pub(super) fn from_definition(definition: &'d Definition) -> Option<Self> {
        let primitive = &definition.primitive;
        let [function, data_file, functions, rest @ ..] = primitive.strings.as_slice() else {
            return None;
        };
        if &*primitive.kind != "brightdata" {
            return None;
        }
        let options = rest.iter().position(|word| word.starts_with('-')).unwrap_or(rest.len());
        let (coordinates, options) = rest.split_at(options);
        let words: Vec<String> = options.iter().map(|word| word.to_string()).collect();
        let Parsed { transforms, used } = Transforms::parse(&words).ok()?;
        if used != words.len() {
            return None;
        }
        let own = transforms.copy(0).filter(|_| transforms.copies() == 1)?.frame;
        let frame = own.then(&definition.frame);
        let functions = functions.rsplit(['/', '\\']).next().unwrap_or(functions);
        let coordinates = coordinates.iter().map(|word| &**word).collect();
        frame.is_finite().then_some(Self { function, data_file, functions, coordinates, frame })
    }

    /// Whether it is a distribution of light.
    pub(super) fn is_of_source(&self) -> bool {
        matches!(self.functions, "source.cal" | "quasilux.cal")
    }

    /// Position of the data of a lamp's tilt that this pattern asks for; `None` for other patterns.
    pub(super) fn tilt_deg(&self) -> Option<f64> {
        let tilt = libm::acos((self.frame.turn * DVec3::Z).z.clamp(-1.0, 1.0)).to_degrees();
        let is_tilt = self.functions == "tilt.cal" && self.function == "noop";
        match self.coordinates.as_slice() {
            ["tilt_ang"] if is_tilt => Some(tilt),
            ["tilt_ang2"] if is_tilt => Some(if tilt > 90.0 { 180.0 - tilt } else { tilt }),
            _ => None,
        }
    }

    /// The distribution with its data and the numbers of its definition.
    pub(super) fn distribution(
        &self,
        data: &Rc<Data>,
        reals: &[f64],
    ) -> Result<Distribution, String> {
        let first = |usual: Option<f64>| {
            let factor = reals.first().copied().or(usual);
            let factor = factor.filter(|factor| *factor >= 0.0 && *factor <= 1e12);
            factor.ok_or_else(|| "its first real argument is no factor".to_owned())
        };
        let side = |at: usize| {
            let side = reals.get(at).copied().filter(|side| *side >= 0.0 && *side <= 1e6);
            side.ok_or_else(|| "its real arguments are no lengths".to_owned())
        };
        let correction = match self.function {
            // Those of quasilux's own exports: over areas.
            "q_point" => Scaling::Plain(over(side(0)?)?),
            "q_flat" => Scaling::Flat(over(side(0)?)?),
            "q_box" => Scaling::Box(1.0, DVec3::new(side(0)?, side(1)?, side(2)?)),
            "corr" | "noop" => Scaling::Plain(first(Some(1.0))?),
            "flatcorr" => Scaling::Flat(first(Some(1.0))?),
            "boxcorr" | "lboxcorr" => {
                let [x, y, z] = [side(1)?, side(2)?, side(3)?];
                Scaling::Box(first(None)?, DVec3::new(y * z, x * z, x * y))
            }
            "cylcorr" => {
                let [diameter, height] = [side(1)?, side(2)?];
                let areas = [diameter * height, 0.25 * PI * diameter * diameter];
                Scaling::Cylinder(first(None)?, areas)
            }
            other => {
                return Err(format!(
                    "the function {} is not known; expected flatcorr, boxcorr, cylcorr or corr",
                    shown(other)
                ));
            }
        };
        let coordinates = self.coordinates.iter().map(|name| Coordinate::named(name));
        let coordinates: Option<Vec<Coordinate>> = coordinates.collect();
        let coordinates = coordinates.filter(|all| all.len() == data.axes.len());
        let coordinates = coordinates.ok_or_else(|| {
            "its coordinates are not known, or not as many as those of the data; expected \
             src_theta, behind one of src_phi, src_phi2 and src_phi4, with numbers added to them"
                .to_owned()
        })?;
        if !data.is_of_light() {
            return Err("its data have values below 0".to_owned());
        }
        let (data, frame) = (Rc::clone(data), self.frame);
        Ok(Distribution { correction, coordinates, data, frame })
    }
}

/// The factor of an area.
fn over(area: f64) -> Result<f64, String> {
    let is_some = area > 0.0;
    is_some.then(|| 1.0 / area).ok_or_else(|| "its area is 0".to_owned())
}

impl Distribution {
    /// Whether the radiance grows as a surface is seen from the side.
    pub(super) fn is_flat(&self) -> bool {
        matches!(self.correction, Scaling::Flat(_))
    }

    /// Surfaces that share the distribution.
    pub(super) fn grouping(&self) -> Grouping {
        match self.correction {
            Scaling::Plain(_) => Grouping::Apart,
            Scaling::Flat(_) => Grouping::Sheet,
            Scaling::Box(..) | Scaling::Cylinder(..) => Grouping::Body,
        }
    }

    /// Whether an angle is one of its coordinates.
    pub(super) fn has(&self, angle: Angle) -> bool {
        self.coordinates.iter().any(|it| it.angle == angle)
    }

    /// Factor on the radiance of the material toward a direction of the distribution's own frame;
    /// for flat surfaces times the cosine.
    pub(super) fn factor(&self, direction: DVec3) -> f64 {
        let at: Vec<f64> = self.coordinates.iter().map(|it| it.angle_deg(direction)).collect();
        let value = self.data.value(&at);
        let DVec3 { x, y, z } = direction.abs();
        match self.correction {
            Scaling::Plain(factor) | Scaling::Flat(factor) => factor * value,
            Scaling::Box(factor, areas) => {
                let shown = areas.dot(DVec3::new(x, y, z));
                if shown > 0.0 { factor * value / shown } else { 0.0 }
            }
            Scaling::Cylinder(factor, [side, end]) => {
                let shown = side * (1.0 - z * z).max(0.0).sqrt() + end * z;
                if shown > 0.0 { factor * value / shown } else { 0.0 }
            }
        }
    }

    /// Angles of the data, where it is by one of these.
    pub(super) fn axis(&self, of: impl Fn(Angle) -> bool) -> Option<Vec<f64>> {
        let at = self.coordinates.iter().position(|it| of(it.angle))?;
        let shift_deg = self.coordinates[at].shift_deg;
        Some(self.data.axes[at].iter().map(|position| position - shift_deg).collect())
    }
}
