//! Openings as surveyed places see them: whether light comes from outside through them, and whether
//! surfaces stand behind them.
//!
//! Which way a place asks for light from outside, and whether paths are led from it to openings,
//! may depend on the place alone, so it may stand in the densities of paths. A survey says it for
//! each cell: a courtyard asks the open sky, a room its windows.

use super::cells::Regions;
use super::survey::{Survey, SurveyCell};
use crate::codec::Writer;
use crate::context::{Context, Stream};
use crate::lights::{Asking, OutsideLight};
use crate::spectrum::Spectrum;
use crate::world::RayOrigin;
use crate::world::frame::Frame;
use crate::world::panes::{Passage, transmittances};
use glam::DVec3;
use quasilux_bvh::RayQuery;
use quasilux_sampling::Sampler;
use quasilux_sampling::warp::sample_cosine_hemisphere;
use rayon::prelude::*;

/// Lines through openings from a cell.
const LOOKS: u32 = 16;
/// Lines around a place for each of those.
const AROUND: u32 = 3;

/// How a place sees outside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OpeningView {
    /// The part of what it asks for sky and ground that it asks through openings: about that of
    /// what it sees of them, 1 where it sees them through openings alone.
    pub(crate) through: f64,
    /// The part of its lines through openings that meet a surface behind them, less where the place
    /// sees sky beside the openings.
    pub(crate) surfaces_behind: f64,
}

/// A view with the rays that it took.
pub(crate) struct Looked {
    pub(crate) view: OpeningView,
    pub(crate) rays: u64,
}

/// Views of all surveyed cells.
#[derive(Default)]
pub(crate) struct OpeningViews {
    /// `None` where there are no openings, or nothing was surveyed.
    regions: Option<Regions>,
    by_cell: Vec<OpeningView>,
    /// Rays of the survey.
    pub(crate) rays: u64,
}

/// A place that looks out.
pub(crate) struct LookingPlace {
    pub(crate) from: RayOrigin,
    /// The side of it.
    pub(crate) n: DVec3,
}

impl OpeningView {
    /// Of places about which nothing is known: they ask through openings, and lead nowhere.
    pub(crate) const UNKNOWN: Self = Self { through: 1.0, surfaces_behind: 0.0 };

    /// Looks out of a place, or of some that are taken in turn, this many times along each kind of
    /// line; `number` is that of the place among all that look with the same samples.
    pub(crate) fn look<S: Spectrum>(
        context: &Context<'_, S>,
        stream: Stream,
        number: u64,
        place_of: impl Fn(u32) -> LookingPlace,
        looks: u32,
    ) -> Looked {
        let Some(outside) = context.lights.outside.as_ref() else {
            return Looked { view: Self::UNKNOWN, rays: 0 };
        };
        let points = context.points(0, stream);
        let mut lines = Lines::default();
        for look in 0..looks {
            let index = number * u64::from(looks) + u64::from(look);
            let mut sampler = Sampler::new(&points, index);
            lines.add(outside, &place_of(look), &mut sampler);
        }
        Looked { view: lines.seen(context, outside, looks), rays: lines.rays() }
    }

    fn put(&self, out: &mut Writer) {
        out.value(&[self.through, self.surfaces_behind]);
    }
}

impl OpeningViews {
    /// Of the cells of a survey.
    pub(crate) fn new<S: Spectrum>(context: &Context<'_, S>, survey: &Survey) -> Self {
        if !context.lights.outside.as_ref().is_some_and(OutsideLight::has_portals) {
            return Self::default();
        }
        let look = |(number, cell): (usize, &SurveyCell)| {
            let place_of = |look: u32| {
                let at = &cell.places[look as usize % cell.places.len()];
                LookingPlace { from: context.world.ray_origin(at), n: at.n }
            };
            OpeningView::look(context, Stream::Survey(4), number as u64, place_of, LOOKS)
        };
        let looks: Vec<Looked> = survey.known.par_iter().enumerate().map(look).collect();
        let rays = looks.iter().map(|it| it.rays).sum();
        let by_cell = looks.into_iter().map(|it| it.view).collect();
        Self { regions: Some(survey.regions()), by_cell, rays }
    }

    /// The view of a place on the side `n` of a surface.
    pub(crate) fn at(&self, position: DVec3, n: DVec3) -> OpeningView {
        let number = self.regions.as_ref().and_then(|it| it.number(position, n));
        number.map_or(OpeningView::UNKNOWN, |number| self.by_cell[number])
    }

    /// Whether there are any.
    pub(crate) fn are_known(&self) -> bool {
        self.regions.is_some()
    }

    /// Puts them among the decisions.
    pub(crate) fn put(&self, out: &mut Writer) {
        self.regions.iter().for_each(|regions| regions.put(out));
        self.by_cell.iter().for_each(|view| view.put(out));
    }
}

/// Lines along which a place looks out.
#[derive(Default)]
struct Lines {
    /// Cosine-distributed around its normal.
    around: Vec<RayQuery>,
    /// Through openings, to their ends.
    through: Vec<RayQuery>,
    /// Parts of these lines as far as the openings.
    to_openings: Vec<RayQuery>,
}

impl Lines {
    fn add(&mut self, outside: &OutsideLight<'_>, from: &LookingPlace, sampler: &mut Sampler<'_>) {
        let &LookingPlace { from, n } = from;
        let place = Asking { position: from.position(), side: Some(n), own: from.facet() };
        // The first two coordinates are spread best.
        let asked = outside.sample_through(place, sampler.next_2d());
        for _ in 0..AROUND {
            let local = DVec3::from_array(sample_cosine_hemisphere(sampler.next_2d()));
            self.around.push(from.query(Frame::around(n).to_world(local)));
        }
        let Some(direction) = asked.map(|it| it.direction).filter(|it| n.dot(*it) > 0.0) else {
            return;
        };
        if let Some(distance_m) = outside.opening_distance_m(from.position(), direction) {
            self.through.push(from.query(direction));
            self.to_openings.push(from.shadow_ray(direction, distance_m, u32::MAX));
        }
    }

    fn rays(&self) -> u64 {
        (self.around.len() + self.through.len() + self.to_openings.len()) as u64
    }

    /// View by them, of this many lines of each kind that were tried.
    fn seen<S: Spectrum>(
        &self,
        context: &Context<'_, S>,
        outside: &OutsideLight<'_>,
        looks: u32,
    ) -> OpeningView {
        let mut passages: Vec<Option<Passage<S>>> = Vec::new();
        let mut is_free = |lines: &[RayQuery]| {
            transmittances(&context.world, lines, &mut passages);
            passages.iter().map(Option::is_some).collect::<Vec<bool>>()
        };
        let (mut through, mut all) = (0.0, 0.0);
        for (_, line) in is_free(&self.around).iter().zip(&self.around).filter(|(free, _)| **free) {
            let opening_m = outside.opening_distance_m(line.ray.origin, line.ray.direction);
            through += f64::from(u8::from(opening_m.is_some()));
            all += 1.0;
        }
        let (reach, leave) = (is_free(&self.to_openings), is_free(&self.through));
        let blocked = reach.iter().zip(&leave).filter(|(reach, leave)| **reach && !**leave).count();
        // The rule of succession (Laplace), but where openings show all that is seen.
        let shows_all = through == all && (all > 0.0 || leave.contains(&true));
        let asked = if shows_all { 1.0 } else { (through + 1.0) / (all + 2.0) };
        let inside = if all > 0.0 { through / all } else { 1.0 };
        OpeningView { through: asked, surfaces_behind: inside * blocked as f64 / f64::from(looks) }
    }
}
