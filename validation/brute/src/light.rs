//! Point lights, and how they shine.

use glam::DVec3;

/// A point that shines the same all round its aim.
#[derive(Clone, Debug, PartialEq)]
pub struct PointLight {
    /// Where it is, in m.
    pub position: DVec3,
    /// Unit direction that angles are measured from.
    pub aim: DVec3,
    /// The intensity by angle.
    pub candela: Candela,
}

/// Luminous intensity in cd by the angle gamma from the aim.
#[derive(Clone, Debug, PartialEq)]
pub enum Candela {
    /// The same in all directions.
    Constant(f64),
    /// This times the cosine, nothing behind.
    Cosine(f64),
    /// The same up to an angle, nothing beyond.
    Cone {
        /// The intensity within.
        intensity_cd: f64,
        /// The angle in rad.
        half_angle_rad: f64,
    },
    /// Linear between the angles of a table, nothing beyond the last.
    Table(Vec<CandelaRow>),
}

/// One angle of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CandelaRow {
    /// The angle in rad, larger than in the row before.
    pub gamma_rad: f64,
    /// The intensity there.
    pub intensity_cd: f64,
}

impl PointLight {
    /// The intensity in a unit direction, in cd.
    #[must_use]
    pub fn intensity_cd(&self, direction: DVec3) -> f64 {
        let sine = self.aim.cross(direction).length();
        self.candela.at_angle(libm::atan2(sine, self.aim.dot(direction)))
    }
}

impl Candela {
    /// The intensity at an angle from the aim, in cd.
    pub(crate) fn at_angle(&self, gamma_rad: f64) -> f64 {
        match self {
            Self::Constant(intensity_cd) => *intensity_cd,
            Self::Cosine(intensity_cd) => intensity_cd * libm::cos(gamma_rad).max(0.0),
            Self::Cone { intensity_cd, half_angle_rad } => {
                if gamma_rad <= *half_angle_rad {
                    *intensity_cd
                } else {
                    0.0
                }
            }
            Self::Table(rows) => interpolated(rows, gamma_rad),
        }
    }
}

fn interpolated(rows: &[CandelaRow], gamma_rad: f64) -> f64 {
    let after = rows.partition_point(|row| row.gamma_rad <= gamma_rad);
    let Some(low) = after.checked_sub(1).map(|number| rows[number]) else {
        return 0.0;
    };
    let Some(high) = rows.get(after) else {
        return if gamma_rad == low.gamma_rad { low.intensity_cd } else { 0.0 };
    };
    let share = (gamma_rad - low.gamma_rad) / (high.gamma_rad - low.gamma_rad);
    low.intensity_cd + share * (high.intensity_cd - low.intensity_cd)
}
