//! Smooth boundaries: mirrors, panes and bodies of glass send light into single directions.
//!
//! Fresnel's equations by sines and tangents of the angles would lose digits at normal incidence;
//! the amplitudes of Born and Wolf (1999, section 1.5) are written with cosines. A pane has two
//! boundaries: light that is reflected r at each comes back as `r + r (1-r)^2 (1 + r^2 + ...)`
//! `= 2 r / (1 + r)`, for each polarisation by itself.

use crate::random::Xoshiro;
use crate::surface::Surface;
use glam::DVec3;

/// Which quantity is followed: it decides what refraction does to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Followed {
    /// Luminance, from where it is asked for: it is smaller outside a body by `1 / eta^2`.
    Luminance,
    /// Luminous flux, from the lights.
    Flux,
}

/// What is followed on a way, and what decides where there are two.
pub(crate) struct Course<'r> {
    pub(crate) followed: Followed,
    pub(crate) random: &'r mut Xoshiro,
}

/// How light goes on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Onward {
    pub(crate) direction: DVec3,
    /// What is kept, over the probability of going this way.
    pub(crate) weight: f64,
    /// Whether it goes on as if nothing were there.
    pub(crate) is_straight: bool,
}

/// What a boundary reflects of each polarisation, and the cosine behind it.
struct Boundary {
    across: f64,
    within: f64,
    cos_behind: f64,
}

/// Light that meets a boundary at a cosine above 0; `eta` is the index behind over that before.
fn boundary(cos: f64, eta: f64) -> Boundary {
    let sine_squared = ((1.0 - cos) * (1.0 + cos)).max(0.0) / (eta * eta);
    if sine_squared >= 1.0 {
        return Boundary { across: 1.0, within: 1.0, cos_behind: 0.0 };
    }
    let cos_behind = (1.0 - sine_squared).sqrt();
    let across = (cos - eta * cos_behind) / (cos + eta * cos_behind);
    let within = (eta * cos - cos_behind) / (eta * cos + cos_behind);
    Boundary { across: across * across, within: within * within, cos_behind }
}

/// What a clear pane mirrors at this cosine.
fn mirrored_by_pane(cos: f64, eta: f64) -> f64 {
    let Boundary { across, within, .. } = boundary(cos, eta);
    across / (1.0 + across) + within / (1.0 + within)
}

/// What a pane lets straight through.
pub(crate) fn through_pane(cos: f64, eta: f64, tint: f64) -> f64 {
    tint * (1.0 - mirrored_by_pane(cos.abs().min(1.0), eta))
}

/// Sends light that moves along a unit direction on, by chance where there are two ways; nothing
/// where the surface scatters. `front` is the unit normal of the front.
pub(crate) fn send_on(
    surface: Surface,
    direction: DVec3,
    front: DVec3,
    way: &mut Course,
) -> Option<Onward> {
    let slope = direction.dot(front);
    let cos = slope.abs().min(1.0);
    let mirrored = direction - front * (2.0 * slope);
    match surface {
        Surface::Grey { .. } | Surface::Sheet { .. } | Surface::Metal { .. } => None,
        Surface::Mirror { reflectance } => {
            Some(Onward { direction: mirrored, weight: reflectance, is_straight: false })
        }
        Surface::Pane { eta, tint } => {
            let back = mirrored_by_pane(cos, eta);
            let weight = back + tint * (1.0 - back);
            if way.random.uniform() * weight < back {
                return Some(Onward { direction: mirrored, weight, is_straight: false });
            }
            Some(Onward { direction, weight, is_straight: true })
        }
        Surface::Glass { eta } => {
            let eta = if slope < 0.0 { eta } else { 1.0 / eta };
            let it = boundary(cos, eta);
            if way.random.uniform() < 0.5 * (it.across + it.within) {
                return Some(Onward { direction: mirrored, weight: 1.0, is_straight: false });
            }
            let along = direction - front * slope;
            let refracted = along / eta + front * (it.cos_behind * slope.signum());
            let weight = if way.followed == Followed::Luminance { 1.0 / (eta * eta) } else { 1.0 };
            Some(Onward { direction: refracted.normalize(), weight, is_straight: false })
        }
    }
}
