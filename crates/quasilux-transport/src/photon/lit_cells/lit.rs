//! Piecewise linear approximation of the direct light of one point-like light, by adaptive
//! subdivision of facets.
//!
//! A facet that faces the light is cut into cells until its illuminance is linear enough in each:
//! as far as probes at the corners and the middles of the edges tell, and where the light is so
//! near, or its beam so narrow, that probes may miss what lies between them. It is a picture to
//! draw places by, not an estimate: what it has wrong costs variance.

use crate::bsdf::TransportMode;
use crate::context::Context;
use crate::lights::{Incidence, LightCentre, PointLikes};
use crate::spectrum::Spectrum;
use crate::world::subdivision::SubTriangle;
use glam::DVec3;
use quasilux_scene::Light;

/// Cells are cut where the picture is wrong by more than this share of the flux of all lights.
const TOLERANCE: f64 = 1.0 / (1 << 10) as f64;
/// Cells that may get more than this share are cut while they probe large from the light.
const NOTABLE: f64 = 1.0 / (1 << 10) as f64;
/// How large is too large: edge over distance, for lights that shine evenly and for those with
/// beams.
const LARGEST: [f64; 2] = [0.5, 0.2];
/// Lights with a beam are those whose largest intensity is this many times the mean.
const BEAM: f64 = 6.0;
/// No cell has edges shorter than this power of 1/2 of the facet's.
const DEEPEST: u32 = 24;
/// An order of the [`SubTriangle::quarters`] in which successive ones share an edge, but for the
/// last.
const NEIGHBOURS: [usize; 4] = [0, 3, 1, 2];
/// Looks at corners are this share of the way to the centroid: other surfaces touch there.
const INWARD: f64 = 1.0 / 1024.0;
/// The share of its mean intensity that a light is taken to have where its table has less, and that
/// of what a surface keeps of all light where it keeps less: probes may miss a narrow beam, or
/// where a surface shines.
const EVERYWHERE: f64 = 0.1;

/// A light that probes at a facet.
pub(super) struct Beam<'s, 'a, S> {
    context: &'s Context<'a, S>,
    /// Number among the point-like lights.
    number: u32,
    light: &'a Light,
    position: DVec3,
    mean_cd: f64,
    largest_cd: f64,
    largest_angle: f64,
    /// Flux of all point-like lights.
    all_lm: f64,
}

/// A cell, and the light that goes on at its corners.
pub(super) struct LitCell {
    pub(super) cell: SubTriangle,
    pub(super) facet: u32,
    pub(super) light: u32,
    pub(super) front: bool,
    /// Illuminance times albedo there, in lm/m^2.
    pub(super) seen: [f64; 3],
    /// Illuminance times albedo there, in lm/m^2, if nothing stood in the way, and if no beam were
    /// narrow.
    pub(super) open: [f64; 3],
    pub(super) area_m2: f64,
}

/// The cells of one facet, and the rays that they took.
#[derive(Default)]
pub(super) struct LitFacet {
    pub(super) cells: Vec<LitCell>,
    pub(super) rays: u64,
}

/// Light that goes on at a probed place, in lm/m^2; see [`LitCell`].
#[derive(Clone, Copy, Default)]
struct Probe {
    seen: f64,
    open: f64,
}

/// One facet as a light sees it.
struct View<'v, 's, 'a, S> {
    beam: &'v Beam<'s, 'a, S>,
    facet: u32,
    front: bool,
    n: DVec3,
    area_m2: f64,
    edge_m: f64,
    /// The share of what lands that goes on, over all directions.
    most_kept: f64,
    rays: u64,
    found: Vec<LitCell>,
}

impl<'s, 'a, S: Spectrum> Beam<'s, 'a, S> {
    pub(super) fn all(context: &'s Context<'a, S>) -> Vec<Self> {
        let lights: &PointLikes<'a> = &context.lights.pointlikes;
        let all_lm = lights.iter().map(|light| light.flux_lm).sum();
        let beam = |(number, LightCentre { position, flux_lm })| {
            let light = lights.get(number).expect("as many as there are");
            let mean_cd = flux_lm / (4.0 * std::f64::consts::PI);
            let largest_cd = match light {
                Light::Luminaire(luminaire) => {
                    luminaire.dimming * luminaire.photometry.table().maximum().value
                }
                Light::Point(_) | Light::Area(_) => mean_cd,
            };
            let has_beam = largest_cd > BEAM * mean_cd;
            Self {
                context,
                number: number as u32,
                light,
                position,
                mean_cd,
                largest_cd,
                largest_angle: LARGEST[usize::from(has_beam)],
                all_lm,
            }
        };
        lights.iter().enumerate().map(beam).collect()
    }

    /// Which side of a facet the light is on; `None` in its plane, or where nothing goes on.
    pub(super) fn faces(&self, facet: u32) -> Option<bool> {
        let own = &self.context.world.facets[facet as usize];
        let height_m = own.front_normal.dot(self.position - own.point([1.0, 0.0, 0.0]));
        (height_m.abs() > self.context.world.hair_m()).then_some(height_m > 0.0)
    }

    /// Cuts a facet into cells, most of them neighbours in their order.
    pub(super) fn lit_cells_of(&self, facet: u32) -> LitFacet {
        let Some(front) = self.faces(facet) else { return LitFacet::default() };
        let world = &self.context.world;
        let own = &world.facets[facet as usize];
        let n = if front { own.front_normal } else { -own.front_normal };
        let most_kept = world.most_kept_by(own);
        if most_kept <= 0.0 {
            return LitFacet::default();
        }
        let mut view = View {
            beam: self,
            facet,
            front,
            n,
            area_m2: own.area_m2(),
            edge_m: own.longest_edge_m(),
            most_kept,
            rays: 0,
            found: Vec::new(),
        };
        let whole = SubTriangle::WHOLE;
        let corners = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let probes = corners.map(|corner| view.probe(whole, corner));
        view.cut(whole, probes, 0);
        LitFacet { cells: view.found, rays: view.rays }
    }
}

impl<S: Spectrum> View<'_, '_, '_, S> {
    /// Keeps a cell or cuts it.
    fn cut(&mut self, cell: SubTriangle, corners: [Probe; 3], depth: u32) {
        let middles = [[0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]];
        let middles = middles.map(|middle| self.probe(cell, middle));
        let area_m2 = self.area_m2 * cell.area_share();
        if depth < DEEPEST && self.wants_cut(cell, area_m2, &corners, &middles) {
            let (parts, probes) = (cell.quarters(), SubTriangle::quarter_corners(corners, middles));
            NEIGHBOURS.into_iter().for_each(|i| self.cut(parts[i], probes[i], depth + 1));
            return;
        }
        self.found.push(LitCell {
            cell,
            facet: self.facet,
            light: self.beam.number,
            front: self.front,
            seen: corners.map(|probe| probe.seen),
            open: corners.map(|probe| probe.open),
            area_m2,
        });
    }

    fn wants_cut(
        &self,
        cell: SubTriangle,
        area_m2: f64,
        corners: &[Probe; 3],
        middles: &[Probe; 3],
    ) -> bool {
        let misses = |i: usize| {
            let ends = 0.5 * (corners[(i + 1) % 3].seen + corners[(i + 2) % 3].seen);
            (middles[i].seen - ends).abs()
        };
        let missed_lm = area_m2 * (misses(0) + misses(1) + misses(2)) / 3.0;
        missed_lm > TOLERANCE * self.beam.all_lm || self.may_hide(cell, area_m2)
    }

    /// Whether much light may land between the probes.
    fn may_hide(&self, cell: SubTriangle, area_m2: f64) -> bool {
        let Beam { position, largest_cd, largest_angle, all_lm, .. } = *self.beam;
        let place = |weights| self.beam.context.world.facets[self.facet as usize].point(weights);
        let edge_m = self.edge_m * cell.area_share().sqrt();
        let to_light = position - place(cell.point([1.0 / 3.0; 3]));
        let height_m = self.n.dot(to_light);
        // No corner is farther from the centroid than two thirds of the longest edge.
        let nearest_m = (to_light.length() - edge_m * (2.0 / 3.0)).max(height_m);
        let max_lx = largest_cd * height_m / (nearest_m * nearest_m * nearest_m);
        edge_m > largest_angle * nearest_m && max_lx * area_m2 * self.most_kept > NOTABLE * all_lm
    }

    fn probe(&mut self, cell: SubTriangle, weights: [f64; 3]) -> Probe {
        let weights = cell.point(weights).map(|w| w + (1.0 / 3.0 - w) * INWARD);
        let world = &self.beam.context.world;
        let at = world.interaction_on(self.facet, self.front, weights);
        let from = world.ray_origin(&at);
        let Some(incidence) = Incidence::new(self.beam.light, from.position(), at.n) else {
            return Probe::default();
        };
        let Incidence { direction, distance_m, illuminance_lx, lx_per_cd } = incidence;
        let open_lx = illuminance_lx + EVERYWHERE * self.beam.mean_cd * lx_per_cd;
        let mut seen_lx = 0.0;
        if illuminance_lx > 0.0 {
            self.rays += 1;
            if world.is_visible(from, direction, distance_m, u32::MAX) {
                seen_lx = illuminance_lx;
            }
        }
        let wo = world.frame(&at).to_local(direction);
        let kept = world.bsdf(&at).albedo(wo, self.front, TransportMode::Importance).luminance();
        let may_keep = kept.max(EVERYWHERE * self.most_kept);
        Probe { seen: seen_lx * kept, open: open_lx * may_keep }
    }
}
