//! What a plan is drawn from: extents, cuts and edges of the geometry, found once for all views.

use super::bounds::Bounds;
use super::cut::Plane;
use super::edges::{Edge, edges};
use super::layout::Layout;
use super::model::PlanPicture;
use super::scope::Scope;
use super::symbols::corners_of;
use super::windows::WindowSet;
use glam::DVec3;
use std::collections::BTreeMap;

/// Things further from the geometry than this many times its longest edge do not enlarge the view.
const NEAR: f64 = 1.0;
/// Edges shorter than this are not looked at.
const MIN_PX: f64 = 0.5;
/// Sensors lie between these shares of the height where walls are cut at their height.
const CUT_SHARES: [f64; 2] = [0.03, 0.97];
/// Where there are no such sensors: above the floor by this, or by a share of a low room.
const CUT_M: f64 = 1.0;
const CUT_SHARE: f64 = 0.4;

pub(crate) struct Contents<'a> {
    pub(crate) picture: &'a PlanPicture<'a>,
    /// The box around the geometry; around everything else where there is none.
    pub(crate) geometry: Bounds,
    pub(crate) layout: Layout,
    /// Height at which the plan is cut.
    pub(crate) cut_m: f64,
    pub(crate) edges: Vec<Edge>,
    pub(crate) windows: WindowSet,
    /// The numbers of the remarks at places, which have them bit by bit.
    remarks: BTreeMap<[u64; 3], u32>,
}

impl<'a> Contents<'a> {
    pub(crate) fn new(picture: &'a PlanPicture<'a>, top_px: f64) -> Self {
        let things = || things(picture);
        let geometry = Bounds::of_surfaces(picture.surfaces)
            .or_else(|| Bounds::around(things()))
            .unwrap_or(Bounds { low: DVec3::ZERO, high: DVec3::ONE });
        let layout = Layout::new(&geometry.with_near(things(), NEAR), top_px);
        let toward = layout.views.map(|view| view.projection.toward());
        let least_m = MIN_PX / layout.views[0].projection.px_per_m;
        let edges = edges(picture.surfaces, &toward, least_m);
        let places = picture.marks.iter().filter_map(|m| Some((bits(m.position_m?), m.number)));
        let remarks = places.rev().collect();
        let windows = WindowSet::new(picture.surfaces, picture.openings_m, &edges);
        let cut_m = cut_height_m(picture, &geometry);
        Self { picture, geometry, layout, cut_m, edges, windows, remarks }
    }

    /// The number of the first remark on what stands at a place.
    pub(crate) fn remark_at(&self, place_m: DVec3) -> Option<u32> {
        self.remarks.get(&bits(place_m)).copied()
    }

    /// Whether what stands at a place is outside of the geometry or remarked on.
    pub(crate) fn is_fault(&self, place_m: DVec3) -> bool {
        self.geometry.outside(place_m).is_some() || self.remark_at(place_m).is_some()
    }

    /// The plane in which a view is cut: the plan at the height of the sensors, elevations in the
    /// middle.
    pub(crate) fn plane(&self, view: usize) -> Plane {
        let normal = self.layout.views[view].projection.toward();
        let at = if view == 0 { DVec3::Z * self.cut_m } else { self.geometry.centre_m() };
        Plane { normal, offset_m: normal.dot(at) }
    }
}

impl Contents<'_> {
    /// What of things in space a view shows.
    pub(crate) fn scope(&self, view: usize) -> Scope {
        let hair_m = 1e-6 * self.geometry.size_m().max_element();
        Scope { cut: (view > 0).then(|| self.plane(view)), hair_m }
    }
}

fn bits(place_m: DVec3) -> [u64; 3] {
    (place_m + DVec3::ZERO).to_array().map(f64::to_bits)
}

/// The places of everything that is not geometry.
fn things<'a>(picture: &'a PlanPicture<'a>) -> impl Iterator<Item = DVec3> + 'a {
    let luminaires = picture.luminaires.iter().flat_map(|luminaire| {
        let along = luminaire.c0 * (0.5 * luminaire.opening_m.x);
        let across = luminaire.c0.cross(luminaire.aim) * (0.5 * luminaire.opening_m.y);
        [DVec3::ZERO, along, -along, across, -across].map(|side| luminaire.position_m + side)
    });
    let grids = picture.grids.iter().flat_map(corners_of);
    let points = picture.points.iter().flat_map(|named| named.points);
    luminaires
        .chain(picture.point_lights_m.iter().copied())
        .chain(grids)
        .chain(points.map(|point| point.position_m))
        .chain(picture.cameras.iter().map(|camera| camera.position_m))
}

/// The height of the first level grid, or else of the first sensor point, that lies well inside.
fn cut_height_m(picture: &PlanPicture<'_>, geometry: &Bounds) -> f64 {
    let (low, height_m) = (geometry.low.z, geometry.size_m().z);
    let [least, most] = CUT_SHARES.map(|share| low + share * height_m);
    let is_level = |normal: DVec3| normal.z.abs() > 0.9;
    let grids = picture.grids.iter().filter(|grid| is_level(grid.normal));
    let points = picture.points.iter().flat_map(|named| named.points);
    let points = points.filter(|point| is_level(point.normal)).map(|point| point.position_m.z);
    grids
        .map(|grid| grid.origin_m.z)
        .chain(points)
        .find(|height| (least..=most).contains(height))
        .unwrap_or(low + CUT_M.min(CUT_SHARE * height_m))
}
