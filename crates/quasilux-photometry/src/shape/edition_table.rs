//! From the signs of a file's dimensions to a shape, by format and edition.

use super::{Axis, EQUAL, LuminousShape, Solid};
use crate::warning::{WarningKind, Warnings};
use crate::{IesStandard, LuminousOpening, Standard};
use glam::DVec3;
use quasilux_text::Position;
use std::cmp::Ordering::{Equal as Zero, Greater as Plus, Less as Minus};

/// Dimensions below this are zero.
const MIN_M: f64 = 1e-6;

/// A shape, and which table gave it.
pub(super) struct ShapeByEdition {
    pub(super) shape: LuminousShape,
    table: Option<Table>,
}

/// The tables of shapes; editions that are not named share the one before them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Table {
    Of1986,
    Of1995,
    Of2002,
}

/// The shape by the file's own table, else by the latest other one that has it, else a point.
pub(super) fn shape(standard: Standard, opening: &LuminousOpening) -> ShapeByEdition {
    let own = Table::from_standard(standard);
    let by = |table: Table| {
        table.shape(opening).map(|shape| ShapeByEdition { shape, table: Some(table) })
    };
    by(own)
        .or_else(|| [Table::Of2002, Table::Of1995, Table::Of1986].into_iter().find_map(by))
        .unwrap_or(ShapeByEdition { shape: LuminousShape::POINT, table: None })
}

/// The dimensions by which a file of the format `to` gives the shape of `opening`: by its own
/// table, else by that of another edition; these themselves where they do.
pub(crate) fn opening_in(
    to: Standard,
    from: Standard,
    opening: &LuminousOpening,
) -> LuminousOpening {
    let wanted = LuminousShape::from_opening(from, opening);
    let size_m = wanted.size_m();
    let signed = |index: i32, axis: u32, size_m: f64| {
        // Plus, minus and zero, in turn.
        [size_m, -size_m, 0.0][(index / 3_i32.pow(axis) % 3) as usize]
    };
    let patterns = (0..27).map(|index| LuminousOpening {
        width_m: signed(index, 0, size_m.y),
        length_m: signed(index, 1, size_m.x),
        height_m: signed(index, 2, size_m.z),
    });
    let candidates = || std::iter::once(*opening).chain(patterns.clone());
    let gives = |candidate: &LuminousOpening| shape(to, candidate).shape == wanted;
    let is_own =
        |candidate: &LuminousOpening| shape(to, candidate).table == Some(Table::from_standard(to));
    if wanted.is_point() {
        return *opening;
    }
    let by_own_table = candidates().find(|candidate| gives(candidate) && is_own(candidate));
    by_own_table.or_else(|| candidates().find(gives)).unwrap_or(*opening)
}

/// Warns of dimensions whose signs are not in the table of the file's edition.
pub(crate) fn check_signs(
    standard: Standard,
    opening: &LuminousOpening,
    at: Position,
    warnings: &mut Warnings,
) {
    let ShapeByEdition { shape, table } = shape(standard, opening);
    let LuminousOpening { width_m, length_m, height_m } = opening;
    let found =
        format_args!("a luminous width, length and height of {width_m}, {length_m}, {height_m} m")
            .to_string();
    let own = "signs that stand for a shape in the file's edition";
    match table {
        None => {
            let expected = format_args!("{own} (read as a point)").to_string();
            warnings.push(WarningKind::UnknownOpening, at, found, expected);
        }
        Some(table) if table != Table::from_standard(standard) => {
            let expected = format_args!("{own} (read as a {}, as in LM-63-{table})", shape.name());
            warnings.push(WarningKind::OpeningOfOtherEdition, at, found, expected.to_string());
        }
        Some(_) => {}
    }
}

impl Table {
    fn from_standard(standard: Standard) -> Self {
        match standard {
            Standard::Lm63(IesStandard::Lm63Of1986 | IesStandard::Lm63Of1991) => Self::Of1986,
            Standard::Lm63(IesStandard::Lm63Of1995) => Self::Of1995,
            _ => Self::Of2002,
        }
    }

    fn shape(self, opening: &LuminousOpening) -> Option<LuminousShape> {
        let LuminousOpening { width_m, length_m, height_m } = *opening;
        let [w, l, h] = [width_m, length_m, height_m].map(f64::abs);
        let sign = |size_m: f64| {
            if size_m.abs() < MIN_M { Zero } else { size_m.partial_cmp(&0.0).unwrap_or(Zero) }
        };
        let pattern = [width_m, length_m, height_m].map(sign);
        let of = |solid, size: [f64; 3]| Some(LuminousShape::new(solid, DVec3::from_array(size)));
        let vertical = Solid::Cylinder(Axis::Z);
        if pattern.iter().all(|sign| *sign != Minus) {
            return of(Solid::Cuboid, [l, w, h]);
        }
        match (self, pattern) {
            (Self::Of1986, [Minus, Plus, Plus]) => of(Solid::Ellipsoid, [l, w, h]),
            (Self::Of1986, [Minus, Plus, Zero]) => of(vertical, [l, w, 0.0]),
            (Self::Of1986 | Self::Of1995, [Minus, Zero, Zero | Plus]) => of(vertical, [w, w, h]),
            (Self::Of1995, [Minus, Zero, Minus]) if (w - h).abs() <= EQUAL * w.max(h) => {
                of(Solid::Ellipsoid, [w, w, w])
            }
            (Self::Of1995, [Minus, Plus, Zero | Plus] | [Plus, Minus, Zero | Plus]) => {
                of(vertical, [l, w, h])
            }
            (Self::Of1995, [Zero, Plus, Minus]) => of(Solid::Cylinder(Axis::X), [l, h, h]),
            (Self::Of1995, [Plus, Zero, Minus]) => of(Solid::Cylinder(Axis::Y), [h, w, h]),
            (Self::Of1995, [Minus, Plus, Minus] | [Plus, Minus, Minus]) => {
                of(Solid::Ellipsoid, [l, w, h])
            }
            (Self::Of2002, [Minus, Minus, Zero | Plus]) => of(vertical, [l, w, h]),
            (Self::Of2002, [Minus, Minus, Minus]) => of(Solid::Ellipsoid, [l, w, h]),
            (Self::Of2002, [Minus, Zero | Plus, Minus]) => of(Solid::Cylinder(Axis::X), [l, w, h]),
            (Self::Of2002, [Plus, Minus, Minus]) => of(Solid::Cylinder(Axis::Y), [l, w, h]),
            _ => None,
        }
    }
}

impl std::fmt::Display for Table {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Of1986 => "1986",
            Self::Of1995 => "1995",
            Self::Of2002 => "2002",
        })
    }
}
