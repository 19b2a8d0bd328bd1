//! Geometry term and shadow ray between a sensor and a light vertex.

use super::receiver_element::{ConnectionPoint, ReceiverElement};
use crate::spectrum::Spectrum;
use crate::world::{Interaction, RayOrigin, World};
use glam::DVec3;
use quasilux_bvh::RayQuery;
use std::f64::consts::FRAC_1_PI;

/// The straight way from a sensor to a landing, if nothing stands in it.
pub(in crate::estimator) struct View {
    from: RayOrigin,
    facet: u32,
    way: DVec3,
    square_m2: f64,
    /// Density in m^-2 of the first hits of paths from the sensor.
    pub(in crate::estimator) pdf_m2: f64,
    /// Whether the sensor looks at the side that the photon did not come from.
    pub(in crate::estimator) behind: bool,
    /// What the place in the sensor's cell counts.
    pub(in crate::estimator) weight: f64,
}

impl View {
    /// How a target sees a landing; `None` where one of them turns its back on the other. `in_cell`
    /// chooses the place in a target that is a cell.
    pub(in crate::estimator) fn new<S: Spectrum>(
        world: &World<S>,
        element: &ReceiverElement,
        at: &Interaction,
        in_cell: [f64; 2],
    ) -> Option<Self> {
        let ConnectionPoint { position, normal, weight } = element.place(at.position, in_cell)?;
        let from = world.ray_origin_of_sensor(position, normal);
        let way = at.position - from.position();
        let (cos_d, cos_d_there) = (normal.dot(way), -at.n.dot(way));
        if cos_d <= 0.0 {
            return None;
        }
        let square_m2 = way.length_squared();
        let pdf_m2 = cos_d * cos_d_there.abs() * FRAC_1_PI / (square_m2 * square_m2);
        let behind = cos_d_there < 0.0;
        let view = Self { from, facet: at.facet, way, square_m2, pdf_m2, behind, weight };
        (pdf_m2 != 0.0).then_some(view)
    }

    /// The ray that asks whether anything stands in the way.
    pub(in crate::estimator) fn shadow_ray(&self) -> RayQuery {
        let distance_m = self.square_m2.sqrt();
        self.from.shadow_ray(self.way / distance_m, distance_m, self.facet)
    }
}
