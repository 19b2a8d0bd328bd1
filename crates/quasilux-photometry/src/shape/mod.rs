//! The luminous shape of a luminaire: what of it shines, for light nearer than the far field.
//!
//! # The model
//! A file gives the intensity I(w) that a luminaire has from afar, and the shape of what shines,
//! but not how the light is spread over it. We take the luminance in each direction w to be uniform
//! over the *silhouette* of the shape along w: L(w) = I(w) / A(w), with A(w) its projected area. An
//! element dA of the surface with outward normal n then has the intensity
//!
//! ```text
//! dI = I(w) max(0, n.w) / A(w) dA     solids (all of them are convex)
//! dI = I(w) / A dA                    flat shapes, to both sides, each as the file says
//! dI = I(w) / l dl                    lines
//! ```
//!
//! and the whole, as the factors integrate to one, exactly the file's intensity in every direction,
//! hence the file's flux. A Lambertian disk or a sphere of equal intensity come out with uniform
//! luminance. Sampling the surface by this density ([`LuminousShape::sample_silhouette`]) therefore
//! gives photons their origins; the same density seen from a point takes all that is visible from
//! there, because on a convex surface n.(x - p) > 0 implies n.(x - c) > 0 with c inside.
//!
//! The shape is centred on the photometric centre, the place from which the distance law holds best
//! (CIE S 017:2020, 17-25-103); for solids that is the middle of the luminous volume. Axes are
//! those of the luminaire frame: length along x (C0-C180), width along y (C90-C270), height along
//! z.

mod cuboid;
mod cylinder;
mod edition_table;
mod ellipsoid;

pub(crate) use edition_table::{check_signs, opening_in};

use crate::{LuminaireFacts, LuminousOpening, Standard};
use glam::DVec3;

/// Two lengths that differ by less than this part count as equal where a name or a table asks.
const EQUAL: f64 = 1e-3;

/// A convex luminous surface around the origin of the luminaire frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuminousShape {
    solid: Solid,
    half_m: DVec3,
}

/// The kind of a luminous shape; where an extent is zero it is flat, a line or a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    /// A box with sides along the axes; with zero extents a rectangle, a line or a point.
    Cuboid,
    /// A cylinder of elliptical section with both ends; with no extent along its axis an ellipse.
    Cylinder(Axis),
    /// An ellipsoid.
    Ellipsoid,
}

/// An axis of the luminaire frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// C0-C180, the photometric horizontal.
    X,
    /// C90-C270.
    Y,
    /// Nadir to zenith.
    Z,
}

/// A point of a luminous surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// In the luminaire frame, in m.
    pub position_m: DVec3,
    /// Outward unit normal in the luminaire frame; toward the observer on flat shapes, zero on
    /// lines and points.
    pub normal: DVec3,
}

impl LuminaireFacts {
    /// The shape of the luminous opening, by the signs of its dimensions.
    pub fn shape(&self) -> LuminousShape {
        LuminousShape::from_opening(self.standard, &self.opening)
    }
}

impl LuminousShape {
    /// No extent.
    pub const POINT: Self = Self { solid: Solid::Cuboid, half_m: DVec3::ZERO };

    /// A shape of that kind and extent along x, y and z, in m. Extents count by magnitude; those of
    /// less than a micrometre or that are not finite are zero. What cannot be (an ellipsoid or a
    /// section with a zero extent) is a point.
    pub fn new(solid: Solid, size_m: DVec3) -> Self {
        const MIN_M: f64 = 1e-6;
        let counts = |size: f64| if size.is_finite() && size >= MIN_M { size } else { 0.0 };
        let [x, y, z] = size_m.abs().to_array().map(counts);
        let is_possible = match solid {
            Solid::Cuboid => true,
            Solid::Cylinder(Axis::X) => y > 0.0 && z > 0.0,
            Solid::Cylinder(Axis::Y) => x > 0.0 && z > 0.0,
            Solid::Cylinder(Axis::Z) => x > 0.0 && y > 0.0,
            Solid::Ellipsoid => x > 0.0 && y > 0.0 && z > 0.0,
        };
        if is_possible { Self { solid, half_m: 0.5 * DVec3::new(x, y, z) } } else { Self::POINT }
    }

    /// The shape that the signs of a file's dimensions stand for in its format and edition; a point
    /// where they stand for none.
    ///
    /// | width | length | height | 1986, 1991 | 1995 | 2002, 2019 |
    /// |---|---|---|---|---|---|
    /// | 0 | 0 | 0 | point | point | point |
    /// | +, 0 | +, 0 | +, 0 | line, rectangle, box | line, rectangle, box | line, rectangle, box |
    /// | - | 0 | 0 | disk | disk | |
    /// | - | 0 | + | vertical cylinder | vertical cylinder | |
    /// | - | 0 | - | | sphere | upright ellipse across x |
    /// | - | + | 0 | ellipse | ellipse | |
    /// | - | + | + | ellipsoid | vertical cylinder | |
    /// | + | - | +, 0 | | vertical cylinder, ellipse | |
    /// | 0 | + | - | | cylinder along x | |
    /// | + | 0 | - | | cylinder along y | |
    /// | - | + | - | | ellipsoid | cylinder along x |
    /// | + | - | - | | ellipsoid | cylinder along y |
    /// | - | - | +, 0 | | | vertical cylinder, ellipse |
    /// | - | - | - | | | ellipsoid |
    ///
    /// Sections are elliptical where their two extents differ. Sources: for 1995 I. Ashdown (1998),
    /// "Parsing the IESNA LM-63 photometric data file"; for the others the table of shapes by
    /// edition in Radiance's `ies2rad` (R. Fritz, 2018), which agrees with him on 1995; for 2002
    /// and 2019 also LM-63-19, section 5.11, table 1, as its implementers give it. LM-63 has no
    /// lines and upright rectangles; they are what a box without the other extents is. Signs that
    /// only another edition gives a meaning are read by that edition, the latest first.
    ///
    /// EULUMDAT has rectangles and disks (width 0), with luminous heights by side, of which the
    /// largest counts; its reader gives them the signs of 2002.
    pub fn from_opening(standard: Standard, opening: &LuminousOpening) -> Self {
        edition_table::shape(standard, opening).shape
    }

    /// The kind of shape.
    pub fn solid(&self) -> Solid {
        self.solid
    }

    /// Extents along x, y and z in m.
    pub fn size_m(&self) -> DVec3 {
        2.0 * self.half_m
    }

    /// Whether it has no extent at all.
    pub fn is_point(&self) -> bool {
        self.half_m == DVec3::ZERO
    }

    /// Whether its outline seen from straight below is an ellipse.
    pub fn is_round(&self) -> bool {
        matches!(self.solid, Solid::Cylinder(Axis::Z) | Solid::Ellipsoid)
    }

    /// Whether it encloses a volume.
    pub fn is_solid(&self) -> bool {
        self.half_m.min_element() > 0.0
    }

    /// No point of it is further from the centre, in m.
    pub fn radius_m(&self) -> f64 {
        self.half_m.length()
    }

    /// What it is called.
    pub fn name(&self) -> &'static str {
        let DVec3 { x, y, z } = self.half_m;
        let is_equal = |a: f64, b: f64| (a - b).abs() <= EQUAL * a.max(b);
        let of_cylinder = |along: f64, a: f64, b: f64, names: [&'static str; 4]| {
            names[usize::from(along > 0.0) * 2 + usize::from(!is_equal(a, b))]
        };
        let upright = [
            "upright disk",
            "upright ellipse",
            "horizontal cylinder",
            "horizontal elliptical cylinder",
        ];
        let vertical = ["disk", "ellipse", "vertical cylinder", "vertical elliptical cylinder"];
        match self.solid {
            Solid::Cuboid => ["point", "line", "rectangle", "box"][cuboid::extents(self.half_m)],
            Solid::Cylinder(Axis::X) => of_cylinder(x, y, z, upright),
            Solid::Cylinder(Axis::Y) => of_cylinder(y, x, z, upright),
            Solid::Cylinder(Axis::Z) => of_cylinder(z, x, y, vertical),
            Solid::Ellipsoid if is_equal(x, y) && is_equal(y, z) && is_equal(x, z) => "sphere",
            Solid::Ellipsoid => "ellipsoid",
        }
    }

    /// Area of the silhouette along a unit direction, in m^2: closed forms; 0 for lines and points.
    pub fn projected_area_m2(&self, direction: DVec3) -> f64 {
        match self.solid {
            Solid::Cuboid => cuboid::projected_area_m2(self.half_m, direction),
            Solid::Cylinder(axis) => {
                cylinder::projected_area_m2(axis.turned(self.half_m), axis.turned(direction))
            }
            Solid::Ellipsoid => ellipsoid::projected_area_m2(self.half_m, direction),
        }
    }

    /// Area, m^-2 (length on lines): a point of the side that is turned to the unit direction
    /// `toward`, uniform over the silhouette along it; on flat shapes, lines and points uniform
    /// over them.
    pub fn sample_silhouette(&self, toward: DVec3, u: [f64; 2]) -> SurfacePoint {
        match self.solid {
            Solid::Cuboid => cuboid::sample(self.half_m, toward, u),
            Solid::Cylinder(axis) => {
                let (half_m, toward) = (axis.turned(self.half_m), axis.turned(toward));
                let SurfacePoint { position_m, normal } = cylinder::sample(half_m, toward, u);
                SurfacePoint {
                    position_m: axis.turned_back(position_m),
                    normal: axis.turned_back(normal),
                }
            }
            Solid::Ellipsoid => ellipsoid::sample(self.half_m, toward, u),
        }
    }

    /// Area, m^-2 (length on lines; 1 on points): the density of [`Self::sample_silhouette`], and
    /// so the part of the intensity in the unit direction `toward` that leaves around the point.
    pub fn pdf_silhouette(&self, toward: DVec3, point: &SurfacePoint) -> f64 {
        match self.solid {
            Solid::Cuboid => cuboid::pdf(self.half_m, toward, point.normal),
            Solid::Cylinder(axis) => cylinder::pdf(
                axis.turned(self.half_m),
                axis.turned(toward),
                axis.turned(point.normal),
            ),
            Solid::Ellipsoid => ellipsoid::pdf(self.half_m, toward, point.normal),
        }
    }

    /// The coordinates that [`Self::sample_silhouette`] turns into `point`.
    pub fn invert_silhouette(&self, toward: DVec3, point: &SurfacePoint) -> [f64; 2] {
        match self.solid {
            Solid::Cuboid => cuboid::invert(self.half_m, toward, point),
            Solid::Cylinder(axis) => {
                let position_m = axis.turned(point.position_m);
                let point = SurfacePoint { position_m, normal: axis.turned(point.normal) };
                cylinder::invert(axis.turned(self.half_m), axis.turned(toward), &point)
            }
            Solid::Ellipsoid => ellipsoid::invert(self.half_m, toward, point),
        }
    }
}

impl Axis {
    /// Turns the axes in a circle until this one is the third.
    fn turned(self, DVec3 { x, y, z }: DVec3) -> DVec3 {
        match self {
            Self::X => DVec3::new(y, z, x),
            Self::Y => DVec3::new(z, x, y),
            Self::Z => DVec3::new(x, y, z),
        }
    }

    /// Undoes [`Self::turned`].
    fn turned_back(self, DVec3 { x, y, z }: DVec3) -> DVec3 {
        match self {
            Self::X => DVec3::new(z, x, y),
            Self::Y => DVec3::new(y, z, x),
            Self::Z => DVec3::new(x, y, z),
        }
    }
}
