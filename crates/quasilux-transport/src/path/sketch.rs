//! A sketch of a block of pixels: what rays through the corners of pixels find, once for all
//! replicates.
//!
//! It decides how much is asked where, and what is expected; estimates of pixels stay right
//! whatever it says. A pixel whose corners lie on one surface and see the same lights needs one
//! path where others need several, and a path there need not ask for all lights. Some of the
//! corners are probes: they ask for all virtual lights.

use crate::context::Context;
use crate::photon::virtual_lights::{MAX_PROBES, ShadowSegment, Site, VirtualLights};
use crate::spectrum::Spectrum;
use crate::world::vertex::{Surface, Vertex};
use crate::world::{Interaction, RayOrigin, World};
use quasilux_bvh::{Hit, RayQuery};
use quasilux_scene::View;

/// Lights that a sketch asks for, one bit each.
pub(crate) const MAX_LIGHTS: usize = u16::BITS as usize;
/// So many places across a block are probes, and as many say which virtual lights it takes.
const ACROSS: usize = 2;
const _: () = assert!(ACROSS * ACROSS <= MAX_PROBES, "a bit for each probe");

/// Some pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// The top left pixel.
    pub(crate) first: [u32; 2],
    /// Pixels to the right and down.
    pub(crate) size: [u32; 2],
}

/// What was found of a block.
pub(crate) struct Sketch {
    pixels: Vec<PixelSketch>,
    probes: Vec<Probe>,
    sites: Vec<Site>,
    pub(crate) rays: u64,
}

/// What is known of a pixel.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PixelSketch {
    /// Where its corners lie on one diffuse surface: a place on that.
    surface: Option<Site>,
    expected: ExpectedLights,
    /// Whether its corners agree on everything.
    pub(crate) is_plain: bool,
}

/// Point-like lights, one bit each.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ExpectedLights {
    /// Those that all corners see.
    seen: u16,
    /// Those that all corners see or none.
    agreed: u16,
}

/// A place on a diffuse surface where virtual lights are asked.
struct Probe {
    site: Site,
    from: RayOrigin,
}

/// Virtual lights, and what the probes of a block say of them.
pub(crate) struct ProbedLights<'s, S> {
    pub(crate) lights: VirtualLights<S>,
    /// Of each light the probes that see it, one bit each.
    pub(crate) seen_by: Vec<u8>,
    probes: &'s [Probe],
}

/// What the ray through a corner of pixels meets.
struct Corner {
    at: Interaction,
    material: u32,
    is_diffuse: bool,
    /// The point-like lights that it sees.
    seen: u16,
}

/// Working space.
#[derive(Default)]
pub(crate) struct SketchWork {
    queries: Vec<RayQuery>,
    hits: Vec<Option<Hit>>,
    found: Vec<Option<Interaction>>,
    /// What each query is about.
    asked: Vec<Asked>,
    visible: Vec<bool>,
}

/// Whether a place sees a light.
struct Asked {
    place: usize,
    light: usize,
}

impl Sketch {
    pub(crate) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        view: &View,
        block: Block,
        work: &mut SketchWork,
    ) -> Self {
        let mut corners = find_corners(context, view, block, work);
        let rays = corners.len() as u64 + see_lights(context, view, &mut corners, work);
        let [width, height] = block.size.map(|size| size as usize);
        let corner = |x: usize, y: usize| corners[y * (width + 1) + x].as_ref();
        let pixel = |x: usize, y: usize| {
            PixelSketch::new(
                [[x, y], [x + 1, y], [x, y + 1], [x + 1, y + 1]].map(|[x, y]| corner(x, y)),
            )
        };
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| pixel(x, y))).collect();
        let middle = |size: usize, k: usize| size * (2 * k + 1) / (2 * ACROSS);
        let places = (0..ACROSS * ACROSS)
            .filter_map(|k| corner(middle(width, k % ACROSS), middle(height, k / ACROSS)))
            .filter(|corner| corner.is_diffuse);
        let probe = |corner: &Corner| Probe {
            site: Site::new(&corner.at),
            from: context.world.ray_origin(&corner.at),
        };
        let probes: Vec<Probe> = places.map(probe).collect();
        let sites = probes.iter().map(|probe| probe.site).collect();
        Self { pixels, probes, sites, rays }
    }

    pub(crate) fn pixel(&self, number: usize) -> &PixelSketch {
        &self.pixels[number]
    }

    /// Chooses some of these lights by a coordinate in [0, 1) and asks for them at all probes.
    pub(crate) fn probe<S: Spectrum>(
        &self,
        world: &World<S>,
        all: &VirtualLights<S>,
        u: f64,
        work: &mut SketchWork,
    ) -> ProbedLights<'_, S> {
        let lights = all.choose(&self.sites, u);
        work.clear();
        for (place, Probe { site, from }) in self.probes.iter().enumerate() {
            for light in 0..lights.len() {
                if let Some(ShadowSegment { direction, distance_m, facet }) =
                    lights.way(light, site)
                {
                    let query = from.shadow_ray(direction, distance_m, facet);
                    work.ask(Asked { place, light }, query);
                }
            }
        }
        let mut seen_by = vec![0_u8; lights.len()];
        work.answer(world, |&Asked { place, light }| seen_by[light] |= 1 << place);
        ProbedLights { lights, seen_by, probes: &self.probes }
    }
}

impl SketchWork {
    fn clear(&mut self) {
        self.queries.clear();
        self.asked.clear();
    }

    fn ask(&mut self, asked: Asked, query: RayQuery) {
        self.queries.push(query);
        self.asked.push(asked);
    }

    /// Tells what is seen.
    fn answer<S: Spectrum>(&mut self, world: &World<S>, see: impl FnMut(&Asked)) {
        world.are_visible(&self.queries, &mut self.visible);
        let seen = self.asked.iter().zip(&self.visible).filter(|(_, visible)| **visible);
        seen.map(|(asked, _)| asked).for_each(see);
    }

    /// How many rays the last questions took.
    pub(crate) fn rays(&self) -> u64 {
        self.queries.len() as u64
    }
}

impl<S> ProbedLights<'_, S> {
    /// The probes that speak for a place, one bit each.
    pub(crate) fn probes_near(&self, site: &Site) -> u8 {
        let speaks = |probe: &Probe| u8::from(probe.site.goes_with(site));
        let bits = self.probes.iter().enumerate().map(|(bit, probe)| speaks(probe) << bit);
        bits.fold(0, |all, bit| all | bit)
    }
}

impl PixelSketch {
    fn new(corners: [Option<&Corner>; 4]) -> Self {
        let [Some(first), others @ ..] = corners else {
            let is_plain = corners.iter().all(Option::is_none);
            return Self { is_plain, ..Self::default() };
        };
        let site = Site::new(&first.at);
        let is_one = others.iter().all(|other| {
            other.is_some_and(|other| {
                other.material == first.material && site.goes_with(&Site::new(&other.at))
            })
        });
        let seen = || corners.iter().flatten().map(|corner| corner.seen);
        let all = seen().fold(u16::MAX, |all, seen| all & seen);
        let any = seen().fold(0, |any, seen| any | seen);
        let expected = ExpectedLights { seen: all, agreed: all | !any };
        Self {
            surface: (is_one && first.is_diffuse).then_some(site),
            expected,
            is_plain: is_one && expected.agreed == u16::MAX,
        }
    }

    /// The lights of which something is expected at a place in it.
    pub(crate) fn expected(&self, site: &Site) -> ExpectedLights {
        let is_known = self.surface.is_some_and(|surface| surface.goes_with(site));
        if is_known { self.expected } else { ExpectedLights::default() }
    }
}

impl ExpectedLights {
    /// Whether a light is expected to be seen; `None` where nothing is expected.
    pub(crate) fn is_seen(self, light: usize) -> Option<bool> {
        let has = |bits: u16| bits >> light & 1 == 1;
        has(self.agreed).then(|| has(self.seen))
    }
}

fn find_corners<S: Spectrum>(
    context: &Context<'_, S>,
    view: &View,
    block: Block,
    work: &mut SketchWork,
) -> Vec<Option<Corner>> {
    let world = &context.world;
    let Block { first: [x0, y0], size: [width, height] } = block;
    let SketchWork { queries, hits, found, .. } = work;
    let places = (0..=height).flat_map(|y| (0..=width).map(move |x| [x0 + x, y0 + y]));
    queries.clear();
    queries.extend(places.map(|place| {
        let direction = view.direction(place.map(f64::from));
        world.ray_origin_of_sensor(view.position, direction).query(direction)
    }));
    world.trace_all(queries, hits, found);
    let corner = |at: &Interaction| Corner {
        at: *at,
        material: world.facet(at).material,
        is_diffuse: world.bsdf(at).keeps_illuminance(),
        seen: 0,
    };
    found.iter().map(|at| at.as_ref().map(corner)).collect()
}

/// Asks for the point-like lights at all corners, if they are few and no pane dims them; how many
/// rays that took.
fn see_lights<S: Spectrum>(
    context: &Context<'_, S>,
    view: &View,
    corners: &mut [Option<Corner>],
    work: &mut SketchWork,
) -> u64 {
    let Context { world, lights, .. } = context;
    let lights = &lights.pointlikes;
    if lights.len() > MAX_LIGHTS || world.has_panes() {
        return 0;
    }
    work.clear();
    for (place, corner) in corners.iter().enumerate() {
        let Some(Corner { at, is_diffuse: true, .. }) = corner else { continue };
        let direction = (at.position - view.position).normalize();
        let surface = Surface::new(world, at, direction);
        let vertex = Vertex::on(world, at, &surface, S::white());
        for light in 0..lights.len() {
            if let Some(sample) = lights.light_sample_of(light, &vertex) {
                let from = vertex.ray_origin(sample.direction);
                let query = from.shadow_ray(sample.direction, sample.distance_m, sample.facet);
                work.ask(Asked { place, light }, query);
            }
        }
    }
    work.answer(world, |&Asked { place, light }| {
        if let Some(corner) = &mut corners[place] {
            corner.seen |= 1 << light;
        }
    });
    work.rays()
}
