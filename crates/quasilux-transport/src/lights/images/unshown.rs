//! Ways over specular surfaces alone, from lights that no path runs into: neither images show their
//! light nor do paths find it.

use super::SpecularImages;
use crate::bsdf::Bsdf;
use crate::lights::Lights;
use crate::lights::outside::OutsideLight;
use crate::spectrum::Spectrum;
use crate::world::{Facet, World};
use serde::{Deserialize, Serialize};
use std::fmt;

/// How light of points and luminaires comes that no image shows and no path finds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum UnshownWay {
    /// From luminous shapes by specular surfaces.
    FromShapes,
    /// Through refracting bodies.
    ThroughBodies,
    /// By mirrors of many small planes.
    ByCurvedMirrors {
        /// Their facets.
        facets: usize,
    },
    /// Over more mirrors, one after the other, than there are images of.
    OverManyMirrors {
        /// Mirrors that images are followed over.
        depth: u32,
    },
}

impl fmt::Display for UnshownWay {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FromShapes => f.write_str("from luminous shapes by mirrors"),
            Self::ThroughBodies => f.write_str("through refracting bodies"),
            Self::ByCurvedMirrors { facets } => write!(f, "by curved mirrors of {facets} facets"),
            Self::OverManyMirrors { depth: 0 } => f.write_str("over mirrors"),
            Self::OverManyMirrors { depth } => {
                write!(f, "over {} mirrors or more in a row", depth + 1)
            }
        }
    }
}

impl SpecularImages {
    /// Ways over specular surfaces, of light of points and luminaires, that no image shows and no
    /// path finds.
    pub(crate) fn unshown_ways<S: Spectrum>(
        &self,
        world: &World<S>,
        lights: &Lights<'_>,
    ) -> Vec<UnshownWay> {
        let no_light = lights.pointlikes.is_empty() && lights.area_luminaires.is_empty();
        if no_light || !world.has_specular_facets() {
            return Vec::new();
        }
        let mut ways = Vec::new();
        if !lights.area_luminaires.is_empty() {
            ways.push(UnshownWay::FromShapes);
        }
        if has_refracting_bodies(world) {
            ways.push(UnshownWay::ThroughBodies);
        }
        if self.mirrors.curved_facets > 0 {
            ways.push(UnshownWay::ByCurvedMirrors { facets: self.mirrors.curved_facets });
        }
        if self.images.goes_on {
            let depth = self.images.nodes.last().map_or(0, |image| image.depth);
            ways.push(UnshownWay::OverManyMirrors { depth });
        }
        ways
    }

    /// The beginnings of classes of light paths that no path from a sensor makes, but by meeting
    /// the disk of the sun by chance: a light and what stands behind it, such as "lamp, glass
    /// body".
    pub(crate) fn unshown_classes<S: Spectrum>(
        &self,
        world: &World<S>,
        lights: &Lights<'_>,
    ) -> Vec<String> {
        let ways = self.unshown_ways(world, lights);
        let bodies = has_refracting_bodies(world).then_some("glass body");
        let mut specular: Vec<&str> = self.mirrors_in_words(world).collect();
        specular.extend(bodies);
        let mut classes = Vec::new();
        let mut add = |light: &str, what: &str| classes.push(format!("{light}, {what}"));
        for way in ways.iter().filter(|_| !lights.pointlikes.is_empty()) {
            match way {
                UnshownWay::FromShapes => {}
                UnshownWay::ThroughBodies => add("lamp", "glass body"),
                UnshownWay::ByCurvedMirrors { .. } => add("lamp", "curved mirror"),
                UnshownWay::OverManyMirrors { depth: 0 } => add("lamp", "mirror"),
                UnshownWay::OverManyMirrors { depth: 1 } => add("lamp", "2 mirrors or more"),
                UnshownWay::OverManyMirrors { depth } => {
                    add("lamp", &format!("{} mirrors or more", depth + 1));
                }
            }
        }
        if ways.contains(&UnshownWay::FromShapes) {
            specular.iter().for_each(|what| add("luminous shape", what));
        }
        if lights.outside.as_ref().is_some_and(OutsideLight::has_sun) {
            specular.iter().for_each(|what| add("sun", what));
        }
        classes
    }

    /// The kinds of facets that reflect in single directions.
    fn mirrors_in_words<S: Spectrum>(
        &self,
        world: &World<S>,
    ) -> impl Iterator<Item = &'static str> {
        let has =
            |is: fn(&Bsdf<S>) -> bool| world.facets.iter().any(|facet| is(world.bsdf_of(facet)));
        let mirrors = has(|bsdf| matches!(bsdf, Bsdf::Mirror(_))).then_some("mirror");
        let panes = has(|bsdf| matches!(bsdf, Bsdf::Pane(_))).then_some("reflecting pane");
        [mirrors, panes].into_iter().flatten()
    }
}

/// Whether specular facets are there that no image can be followed through.
fn has_refracting_bodies<S: Spectrum>(world: &World<S>) -> bool {
    let refracts = |facet: &Facet| {
        let bsdf = world.bsdf_of(facet);
        bsdf.is_specular() && bsdf.image_reflectance(1.0, true).is_none()
    };
    world.facets.iter().any(refracts)
}
