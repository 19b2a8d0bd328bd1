//! What comes straight from the sun, hour by hour: every hour has rays to its own disk.
//!
//! Where a few rays to the rim of the disk and its centre all end alike, most likely the sun is
//! seen whole or not at all, and one ray of each replicate is enough; where they do not, each
//! replicate gets many. The rays that decide are not among those that count, so that no choice of
//! theirs makes a bias.

use crate::context::{Context, Stream};
use crate::path::daylight_paths::TargetReplicate;
use crate::purpose::Purpose;
use crate::sensors::Target;
use crate::spectrum::Spectrum;
use crate::stats::tally::checked_quanta;
use crate::world::frame::Frame;
use crate::world::vertex::Vertex;
use crate::world::visibility::{Answer, LightSample, ShadowQueue};
use glam::DVec3;
use libm::{cos, sin};
use quasilux_sampling::Sampler;
use quasilux_scene::Environment;
use quasilux_sky::{SUN_RADIUS_DEG, WeatherSky};
use std::f64::consts::TAU;

/// Rays to the rim that decide.
const RIM: usize = 6;
/// Paths of a replicate for each of its rays to a disk that is seen whole or not at all, and to
/// another.
const PATHS_OF_WHOLE: u64 = 512;
const PATHS_OF_PART: u64 = 32;
/// Quanta of a share of the sun's light.
const PER_SHARE: f64 = (1_u64 << 32) as f64;

/// A sun that shines.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShiningSun {
    /// The number of its hour among all.
    pub(super) hour: usize,
    pub(super) frame: Frame,
    pub(super) direction: DVec3,
    pub(super) normal_illuminance_lx: f64,
}

/// The suns that one target may see, and what it sees of them.
pub(super) struct SunDisks {
    seen: Vec<SeenDisk>,
    /// By replicate and disk, the sums of cosine times transmittance in quanta.
    sums: Vec<Vec<i64>>,
    rays: Vec<[u64; 2]>,
    /// Rays that decided.
    pub(super) deciding_rays: u64,
}

/// Illuminance in lx straight from an hour's sun.
pub(super) struct SunLight {
    pub(super) hour: usize,
    pub(super) lx: f32,
}

struct SeenDisk {
    /// The number of the sun.
    sun: usize,
    /// Whether a part of it may be seen.
    is_part: bool,
    /// Its illuminance in lx by the rays that decide alone.
    glanced_lx: f64,
}

impl SunDisks {
    /// Looks which suns may be seen, and how.
    pub(super) fn new<S: Spectrum>(
        context: &Context<'_, S>,
        target: &Target,
        suns: &[ShiningSun],
        replicates: u32,
    ) -> Self {
        let (position, n) = match target {
            Target::Point { position, normal } => (*position, *normal),
            Target::Cell { grid, cell } => (grid.point_in_cell(*cell, [0.5; 2]), grid.normal),
        };
        let vertex = Vertex::<S>::sensor(context.world.ray_origin_of_sensor(position, n), n);
        let mut queue = ShadowQueue::default();
        let mut seen = Vec::new();
        for (sun, it) in suns.iter().enumerate() {
            // The rim may be up where the centre is not.
            if n.dot(it.direction) + sin(SUN_RADIUS_DEG.to_radians()) <= 0.0 {
                continue;
            }
            let who = seen.len() as u32;
            seen.push(SeenDisk { sun, is_part: false, glanced_lx: 0.0 });
            let rim = (0..RIM).map(|k| [1.0, (k as f64 + 0.5) / RIM as f64]);
            for u in rim.chain([[0.0; 2]]) {
                let direction = it.direction_on_disk(u);
                ask(context, &mut queue, who, &vertex, direction, n.dot(direction));
            }
        }
        let asked = RIM + 1;
        let mut open = vec![0; seen.len()];
        queue.answer_all(&context.world, |Answer { who, bounces, light, .. }: Answer<S>| {
            if bounces.is_some() {
                let disk = &mut seen[who as usize];
                let normal_lx = suns[disk.sun].normal_illuminance_lx;
                disk.glanced_lx += light.luminance() * normal_lx / asked as f64;
                open[who as usize] += 1;
            }
        });
        // Over a cell they say little: each place in it may see the sun or not.
        let is_cell = matches!(target, Target::Cell { .. });
        for (disk, open) in seen.iter_mut().zip(open) {
            disk.is_part = is_cell || (open != 0 && open != asked);
        }
        let sums = vec![vec![0; seen.len()]; replicates as usize];
        let rays = vec![[0; 2]; replicates as usize];
        Self { seen, sums, rays, deciding_rays: queue.rays }
    }

    /// Illuminances straight from the suns of hours by the rays that decide, in lx.
    pub(super) fn glances<'a>(&'a self, suns: &'a [ShiningSun]) -> impl Iterator<Item = SunLight> {
        let glance =
            |disk: &SeenDisk| SunLight { hour: suns[disk.sun].hour, lx: disk.glanced_lx as f32 };
        self.seen.iter().map(glance)
    }

    /// Has a replicate look at them as often as this many paths want; returns the rays.
    pub(super) fn trace<S: Spectrum>(
        &mut self,
        context: &Context<'_, S>,
        place: TargetReplicate<'_>,
        suns: &[ShiningSun],
        paths: u64,
    ) -> u64 {
        let TargetReplicate { number, target, replicate } = place;
        let points = context.points(replicate, Stream::SunDisks(number as u64));
        let wanted = [PATHS_OF_WHOLE, PATHS_OF_PART].map(|of_one| (paths / of_one).max(1));
        let done = std::mem::replace(&mut self.rays[replicate as usize], wanted);
        let mut queue = ShadowQueue::default();
        for (who, disk) in (0..).zip(&self.seen) {
            let sun = &suns[disk.sun];
            for ray in done[usize::from(disk.is_part)]..wanted[usize::from(disk.is_part)] {
                // Neighbouring hours look at different parts of their disks.
                let mut sampler = Sampler::new(&points, ray * suns.len() as u64 + disk.sun as u64);
                let u = sampler.next_2d();
                let (position, n) = match target {
                    Target::Point { position, normal } => (*position, *normal),
                    Target::Cell { grid, cell } => {
                        let u = context.draw(&mut sampler, Purpose::Cell, Sampler::next_2d);
                        (grid.point_in_cell(*cell, u), grid.normal)
                    }
                };
                let direction = sun.direction_on_disk(u);
                let vertex = Vertex::sensor(context.world.ray_origin_of_sensor(position, n), n);
                ask(context, &mut queue, who, &vertex, direction, n.dot(direction));
            }
        }
        let sums = &mut self.sums[replicate as usize];
        queue.answer(&context.world, |who, light: S, _| {
            sums[who as usize] += checked_quanta(light.luminance(), PER_SHARE).unwrap_or(0);
        });
        queue.rays
    }

    /// Illuminances straight from the sun in a replicate, hour by hour of those in which it may be
    /// seen, in lx.
    pub(super) fn illuminances_lx<'a>(
        &'a self,
        suns: &'a [ShiningSun],
        replicate: usize,
    ) -> impl Iterator<Item = SunLight> {
        let rays = self.rays[replicate];
        self.seen.iter().zip(&self.sums[replicate]).map(move |(disk, sum)| {
            let sun = &suns[disk.sun];
            let rays = rays[usize::from(disk.is_part)].max(1);
            let share = *sum as f64 / (PER_SHARE * rays as f64);
            SunLight { hour: sun.hour, lx: (share * sun.normal_illuminance_lx) as f32 }
        })
    }
}

impl ShiningSun {
    /// The sun of an hour, if it shines.
    pub(super) fn new(hour: usize, of: &WeatherSky, environment: &Environment) -> Option<Self> {
        (of.sun_normal_illuminance_lx > 0.0).then(|| {
            let direction = environment.towards(of.sun);
            Self {
                hour,
                frame: Frame::around(direction),
                direction,
                normal_illuminance_lx: of.sun_normal_illuminance_lx,
            }
        })
    }

    /// A direction to the disk, evenly over it by two coordinates; the rim for 1.
    fn direction_on_disk(&self, [u, v]: [f64; 2]) -> DVec3 {
        let aside = sin(SUN_RADIUS_DEG.to_radians()) * u.sqrt();
        let local =
            DVec3::new(aside * cos(TAU * v), aside * sin(TAU * v), (1.0 - aside * aside).sqrt());
        self.frame.to_world(local)
    }
}

/// Asks for a share of the light along a direction.
pub(super) fn ask<S: Spectrum>(
    context: &Context<'_, S>,
    queue: &mut ShadowQueue<S>,
    who: u32,
    vertex: &Vertex<'_, S>,
    direction: DVec3,
    share: f64,
) {
    queue.max_bounces = context.max_bounces.unwrap_or(u32::MAX);
    let beyond_m = context.lights.outside.as_ref().map_or(f64::MAX, |outside| outside.beyond_m());
    let sample = LightSample::unless_dark(direction, beyond_m, S::white() * share.max(0.0), share);
    sample.into_iter().for_each(|sample| queue.ask(who, vertex, &sample));
}
