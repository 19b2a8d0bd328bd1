//! Tree of the mirror images of lights: from each light to its images in chains of mirrors.
//!
//! An image in a mirror is a light behind the mirror's plane, and its image in the next mirror is
//! found in the same way (Allen and Berkley 1979, "Image method for efficiently simulating
//! small-room acoustics"; Borish 1984, "Extension of the image model to arbitrary polyhedra", whose
//! tests of validity and visibility are the ones here and in `chain`). Left out is what cannot be
//! seen from anywhere: images of a mirror that the beam of the one before misses. The tree is made
//! level by level and ends where the mirrors of a chain together reflect less than
//! [`MIN_REFLECTED`], at the depth that is asked for, or before the level that would make it too
//! large.

use super::cone::Cone;
use super::planes::{MirrorPlane, MirrorPlanes};
use crate::lights::Asking;
use glam::DVec3;
use std::ops::Range;

/// Chains of mirrors that reflect less than this, all together, are dropped.
const MIN_REFLECTED: f64 = 1e-4;
/// Images that are taken whatever depth is asked for.
const MAX_IMAGES: usize = 4096;
/// Where no depth is asked for, levels past [`SURE_DEPTH`] come only while all images stay this
/// few.
const FEW_IMAGES: usize = 1024;
const SURE_DEPTH: u32 = 4;

/// All images of all lights.
pub(crate) struct Images {
    /// The lights themselves come first, as images of depth zero; children follow each other.
    pub(crate) nodes: Vec<Image>,
    pub(crate) lights: usize,
    /// Whether mirrors show more that would count.
    pub(crate) goes_on: bool,
}

/// A light, or what a chain of mirrors shows of it.
#[derive(Clone, Debug)]
pub(crate) struct Image {
    pub(crate) light: u32,
    /// The image that the last mirror of the chain reflects; its own number for a light.
    pub(crate) parent: u32,
    /// The last mirror; meaningless for a light.
    pub(crate) plane: u32,
    /// How many mirrors.
    pub(crate) depth: u32,
    pub(crate) position: DVec3,
    /// All of it is this near.
    radius_m: f64,
    /// Holds all places from which it can be seen.
    pub(crate) beam: Cone,
    /// The most that the chain reflects of any of its light.
    pub(crate) reflected: f64,
    children: Range<u32>,
}

/// A light that mirrors show: a ball around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Imaged {
    pub(crate) position: DVec3,
    pub(crate) radius_m: f64,
}

/// Plane of a mirror of a chain, and where that mirror shows a point on the light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shown {
    pub(crate) plane: u32,
    pub(crate) position: DVec3,
}

impl Images {
    /// The images of lights, through up to `depth` mirrors; `slack_m` is a length that counts as
    /// nothing.
    pub(crate) fn new(
        mirrors: &MirrorPlanes,
        lights: impl Iterator<Item = Imaged>,
        depth: Option<u32>,
        slack_m: f64,
    ) -> Self {
        let light = |(light, Imaged { position, radius_m }): (u32, Imaged)| Image {
            light,
            parent: light,
            plane: 0,
            depth: 0,
            position,
            radius_m,
            beam: Cone::EVERYWHERE,
            reflected: 1.0,
            children: 0..0,
        };
        let nodes: Vec<Image> = (0..).zip(lights).map(light).collect();
        let mut images = Self { lights: nodes.len(), nodes, goes_on: false };
        let mut level = 0..images.lights;
        while !level.is_empty() {
            let next = images.nodes.len();
            let deeper = images.nodes[level.start].depth + 1;
            let (fits, most) = match depth {
                Some(depth) => (deeper <= depth, MAX_IMAGES),
                None if deeper <= SURE_DEPTH => (true, MAX_IMAGES),
                None => (true, FEW_IMAGES),
            };
            // One image past the end tells that there is more.
            let most = images.lights + if fits { most } else { next - images.lights };
            if !images.add_level(mirrors, level.clone(), most, slack_m) {
                images.nodes.truncate(next);
                images.nodes[level.clone()].iter_mut().for_each(|image| image.children = 0..0);
                images.goes_on = true;
                break;
            }
            level = next..images.nodes.len();
        }
        images
    }

    /// Adds the images of these images; `false` where there would be more than `most` nodes.
    fn add_level(
        &mut self,
        mirrors: &MirrorPlanes,
        level: Range<usize>,
        most: usize,
        slack_m: f64,
    ) -> bool {
        for parent in level {
            let first = self.nodes.len() as u32;
            for plane in 0..mirrors.planes.len() as u32 {
                let Some(image) = self.image_in(mirrors, parent, plane, slack_m) else { continue };
                if image.reflected < MIN_REFLECTED {
                    continue;
                }
                if self.nodes.len() >= most {
                    return false;
                }
                self.nodes.push(image);
            }
            self.nodes[parent].children = first..self.nodes.len() as u32;
        }
        true
    }

    /// Image of an image in one more mirror, where any of it may be seen.
    fn image_in(
        &self,
        mirrors: &MirrorPlanes,
        parent: usize,
        plane: u32,
        slack_m: f64,
    ) -> Option<Image> {
        let before = &self.nodes[parent];
        let mirror = &mirrors.planes[plane as usize];
        let window = (before.depth > 0).then(|| &mirrors.planes[before.plane as usize]);
        let is_same = before.depth > 0 && before.plane == plane;
        if is_same || mirror.height_m(before.position).abs() + before.radius_m <= slack_m {
            return None;
        }
        if window.is_some_and(|window| !is_before(window, mirror, before, slack_m)) {
            return None;
        }
        let seen = beam_on(before, window, mirror, slack_m)?;
        let beam = before.beam.narrower(seen);
        let reflected = before.reflected * mirror.max_reflected(beam.min_cos_with(mirror.normal));
        Some(Image {
            light: before.light,
            parent: parent as u32,
            plane,
            depth: before.depth + 1,
            position: mirror.mirrored(before.position),
            radius_m: before.radius_m,
            beam: beam.mirrored(mirror.normal),
            reflected,
            children: 0..0,
        })
    }

    /// The image that the mirror `plane` shows of `image`, if it is one of these.
    pub(crate) fn child(&self, image: u32, plane: u32) -> Option<u32> {
        let children = self.nodes[image as usize].children.clone();
        let own = &self.nodes[children.start as usize..children.end as usize];
        let place = own.binary_search_by_key(&plane, |child| child.plane).ok()?;
        Some(children.start + place as u32)
    }

    /// Planes of the mirrors of an image, with the positions where they show its light; the last
    /// mirror first.
    pub(crate) fn shown(&self, image: u32) -> impl Iterator<Item = Shown> {
        self.chain(image).map(|node| Shown { plane: node.plane, position: node.position })
    }

    /// Planes of the mirrors of an image, with the positions where they show a point on the light;
    /// the last mirror first.
    pub(crate) fn shown_of(&self, mirrors: &MirrorPlanes, image: u32, point: DVec3) -> Vec<Shown> {
        let mut shown: Vec<Shown> = self
            .chain(image)
            .map(|&Image { plane, .. }| Shown { plane, position: point })
            .collect();
        let mut at = point;
        for Shown { plane, position } in shown.iter_mut().rev() {
            at = mirrors.planes[*plane as usize].mirrored(at);
            *position = at;
        }
        shown
    }

    /// Where a place would have to be for the light itself to look as this image looks to it.
    pub(crate) fn place_before_light(
        &self,
        mirrors: &MirrorPlanes,
        image: u32,
        Asking { position, side, .. }: Asking,
    ) -> Asking {
        let mirrored = |point: DVec3| {
            let planes = self.chain(image).map(|node| &mirrors.planes[node.plane as usize]);
            planes.fold(point, |point, plane| plane.mirrored(point))
        };
        let origin = mirrored(DVec3::ZERO);
        // What lies there may see itself.
        let side = side.map(|n| mirrored(n) - origin);
        Asking { position: mirrored(position), side, own: None }
    }

    /// An image in a mirror, and those that led to it, but for the light itself.
    fn chain(&self, image: u32) -> impl Iterator<Item = &Image> {
        let parent = |node: &&Image| Some(&self.nodes[node.parent as usize]);
        let first = &self.nodes[image as usize];
        std::iter::successors(Some(first), parent).take(first.depth as usize)
    }

    /// Numbers of the images in mirrors, without the lights themselves, by depth: the first `sure`
    /// of them, and of the others every `stride`th, from the one that `phase` in [0, 1) picks.
    pub(crate) fn mirrored(
        &self,
        sure: usize,
        stride: usize,
        phase: f64,
    ) -> impl Iterator<Item = usize> {
        let thin = (self.lights + sure).min(self.nodes.len());
        let first = thin + (phase * stride as f64) as usize;
        (self.lights..thin).chain((first..self.nodes.len()).step_by(stride))
    }
}

/// Whether light of an image leaves any of `window` on the side of `mirror` that it comes from.
fn is_before(window: &MirrorPlane, mirror: &MirrorPlane, image: &Image, slack_m: f64) -> bool {
    let height_m = mirror.height_m(image.position);
    let is_on_both_sides = height_m.abs() < image.radius_m;
    let mut corners = window.facets.iter().flat_map(|facet| facet.corners);
    is_on_both_sides || corners.any(|corner| mirror.height_m(corner) * height_m.signum() > slack_m)
}

/// A cone around all of a mirror that the light of an image may reach, which comes through
/// `window`.
fn beam_on(
    image: &Image,
    window: Option<&MirrorPlane>,
    mirror: &MirrorPlane,
    slack_m: f64,
) -> Option<Cone> {
    let mut corners = Vec::new();
    let window = window.filter(|window| window.height_m(image.position).abs() >= image.radius_m);
    let cone = |corners: &[DVec3]| Cone::around_ball(image.position, image.radius_m, corners);
    for facet in &mirror.facets {
        let first = corners.len();
        match window {
            None => corners.extend(facet.corners),
            Some(window) => {
                let beyond = -window.height_m(image.position).signum();
                let height_m = |point| window.height_m(point) * beyond + slack_m;
                clip(&facet.corners, height_m, &mut corners);
            }
        }
        let part = &corners[first..];
        let is_seen = !part.is_empty() && image.beam.meets(&cone(part));
        if !is_seen {
            corners.truncate(first);
        }
    }
    (!corners.is_empty()).then(|| cone(&corners))
}

/// Adds the corners of the part of a polygon where `height` is positive.
fn clip(polygon: &[DVec3], height: impl Fn(DVec3) -> f64, corners: &mut Vec<DVec3>) {
    for (i, &from) in polygon.iter().enumerate() {
        let to = polygon[(i + 1) % polygon.len()];
        let (start, end) = (height(from), height(to));
        if start > 0.0 {
            corners.push(from);
        }
        if (start > 0.0) != (end > 0.0) {
            corners.push(from + (to - from) * (start / (start - end)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::Mirrors;
    use super::*;

    const SLACK_M: f64 = 1e-9;

    fn images(mirrors: &Mirrors, at: DVec3, depth: Option<u32>) -> Images {
        let planes = MirrorPlanes::new(&mirrors.world());
        let light = Imaged { position: at, radius_m: 0.0 };
        Images::new(&planes, [light].into_iter(), depth, SLACK_M)
    }

    /// Two facing mirrors at x = 0 and x = 1 show a light at x = 0.3 at -x + 2 m and x + 2 m.
    #[test]
    fn facing_mirrors_show_a_row() {
        let mut mirrors = Mirrors::new(0.5);
        for x in [0.0, 1.0] {
            mirrors.add_square(DVec3::X * x, DVec3::Y, DVec3::Z);
        }
        let images = images(&mirrors, DVec3::X * 0.3, None);
        let mut places: Vec<f64> = images.nodes.iter().map(|image| image.position.x).collect();
        places.sort_by(f64::total_cmp);
        // 0.5^13 = 1.2e-4 is the last product above 1e-4.
        let mut expected: Vec<f64> =
            (-13..=13).map(|m: i32| f64::from(m) + if m % 2 == 0 { 0.3 } else { 0.7 }).collect();
        expected.sort_by(f64::total_cmp);
        assert_eq!(places.len(), 27);
        assert!(places.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-12), "{places:?}");
        assert!(!images.goes_on);
    }

    /// Three mirrors in a corner: 3, 6 and 6 chains show seven places; a fourth bounce cannot be.
    #[test]
    fn a_corner_shows_seven_images() {
        let mut mirrors = Mirrors::new(1.0);
        mirrors.add_corner();
        let light = DVec3::new(0.2, 0.3, 0.4);
        let images = images(&mirrors, light, None);
        let depths = [0, 1, 2, 3, 4].map(|d| images.nodes.iter().filter(|i| i.depth == d).count());
        assert_eq!(depths, [1, 3, 6, 6, 0]);
        assert!(!images.goes_on);
        for image in &images.nodes {
            assert!((image.position.abs() - light).length() < 1e-12);
        }
        let all = |sure, stride, phase| images.mirrored(sure, stride, phase).collect::<Vec<_>>();
        assert_eq!(all(15, 1, 0.9), (1..16).collect::<Vec<_>>());
        assert_eq!(all(99, 4, 0.9), all(15, 1, 0.0));
        assert_eq!(all(3, 5, 0.5), [1, 2, 3, 6, 11]);
        let first = images.mirrored(1, 1, 0.0).next().unwrap() as u32;
        assert_eq!(images.child(0, images.nodes[first as usize].plane), Some(first));
        assert_eq!(images.child(first, images.nodes[first as usize].plane), None);
    }

    #[test]
    fn what_the_depth_cuts_is_known() {
        let mut mirrors = Mirrors::new(0.9);
        mirrors.add_corner();
        let light = DVec3::new(0.2, 0.3, 0.4);
        for (depth, count, goes_on) in [(0, 1, true), (2, 10, true), (3, 16, false), (9, 16, false)]
        {
            let images = images(&mirrors, light, Some(depth));
            assert_eq!((images.nodes.len(), images.goes_on), (count, goes_on), "{depth}");
        }
    }

    /// A mirror wide of the beam of the one before shows nothing of it.
    #[test]
    fn beams_miss_mirrors() {
        let mut mirrors = Mirrors::new(0.9);
        // On the floor around the origin, on the ceiling far away.
        mirrors
            .add([(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)].map(|(x, y)| DVec3::new(x, y, 0.)));
        mirrors
            .add([(9., -1.), (10., -1.), (10., 1.), (9., 1.)].map(|(x, y)| DVec3::new(x, y, 3.)));
        let images = images(&mirrors, DVec3::new(0.0, 0.0, 1.0), None);
        assert_eq!(images.nodes.len(), 3);
        assert!(!images.goes_on);
    }
}
