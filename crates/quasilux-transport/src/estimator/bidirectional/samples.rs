//! K: how many samples a subpath has in a set of paths at most, on average, given that it has one.
//!
//! A subpath that is at a surface goes on with probability s at most, so n vertices follow,
//! counting it, with `n <= 1 + s n'` of the next. Where the surfaces with the largest s lie in one
//! plane, and nothing mirrors, the next is another: with r the largest s of all others, `n <= 1 + s
//! (1 + r n)`. Where eye paths favour a surface more of them go on, and each adds as much less.
//!
//! Of copies of a light subpath each carries as much less. Given one with a sample, its siblings
//! bring at most what it would have brought alone, where it came through more and more copies: what
//! `c` copies bring beside it is `1 - 1 / c` of that. Where copies become few and many again on the
//! same path they may bring as much once more, so where there are any, K is twice as large.

use crate::bsdf::Bsdf;
use crate::spectrum::Spectrum;
use crate::world::{Facet, World};

/// Share that glass turns back of the light that meets it, both faces of dense glass together, but
/// at grazing incidence.
const TURNED_BY_GLASS: f64 = 0.15;

/// Of all techniques with a sample at each vertex: of surfaces that scatter.
pub(super) fn samples_of_subpaths<S: Spectrum>(world: &World<S>) -> f64 {
    let scattering = || world.facets.iter().filter(|facet| !world.bsdf_of(facet).is_specular());
    let kept = |facet: &Facet| world.most_survives_at(facet).min(1.0);
    let Some(first) = scattering().max_by(|a, b| kept(a).total_cmp(&kept(b))) else { return 1.0 };
    let others = || scattering().filter(|facet| is_off_plane(world, first, facet));
    let most = kept(first);
    let after = match world.has_specular_facets() {
        true => most,
        false => others().map(kept).fold(0.0, f64::max),
    };
    (1.0 + most) / (1.0 - most * after)
}

/// Of photons on a disc, between two surfaces that scatter: a photon that has crossed it from its
/// front comes there again by two specular surfaces, not of one plane, at least.
pub(super) fn crossings_of_discs<S: Spectrum>(world: &World<S>) -> f64 {
    let specular = || world.facets.iter().filter(|facet| world.bsdf_of(facet).is_specular());
    let turned = |facet: &Facet| match world.bsdf_of(facet) {
        Bsdf::Dielectric(_) | Bsdf::Pane(_) => TURNED_BY_GLASS,
        _ => world.most_survives_at(facet).min(1.0),
    };
    let Some(first) = specular().max_by(|a, b| turned(a).total_cmp(&turned(b))) else { return 1.0 };
    let others = specular().filter(|facet| is_off_plane(world, first, facet));
    (1.0 - turned(first) * others.map(turned).fold(0.0, f64::max)).recip()
}

/// Whether a facet reaches out of the plane of another.
fn is_off_plane<S: Spectrum>(world: &World<S>, plane: &Facet, facet: &Facet) -> bool {
    let [corner, ..] = plane.corners();
    let heights_m = facet.corners().map(|place| plane.front_normal.dot(place - corner).abs());
    heights_m.into_iter().fold(0.0, f64::max) > world.hair_m()
}

/// Of eye paths that run into emitting facets: the first of them may send it on, and then it has as
/// many as all `subpaths`.
pub(super) fn samples_at_emitters<S: Spectrum>(world: &World<S>, subpaths: f64) -> f64 {
    let emitting = world.facets.iter().filter(|facet| facet.emitted_cd_m2 > 0.0);
    let most = emitting.map(|facet| world.most_survives_at(facet).min(1.0)).fold(0.0, f64::max);
    1.0 + if most > 0.0 { most * subpaths } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{diffuse, mirror, room};
    use glam::DVec3;
    use quasilux_bvh::SimdLevel;
    use quasilux_scene::bsdf::Dielectric;
    use quasilux_scene::{Bsdf as SceneBsdf, Material};

    /// Walls of this kind in two planes.
    fn crossings(bsdf: &SceneBsdf) -> f64 {
        let mut scene = room(DVec3::ONE, diffuse(0.5));
        for first in [4, 6] {
            scene.mesh.material_of[first..first + 2].fill(scene.materials.len() as u32);
            scene.materials.push(Material { name: format!("wall {first}"), bsdf: bsdf.clone() });
        }
        crossings_of_discs(&World::<f64>::new(&scene, SimdLevel::fastest()))
    }

    /// By the geometric series of what is turned back at both.
    #[test]
    fn a_photon_is_turned_back_by_mirrors_and_hardly_by_glass() {
        assert!((crossings(&diffuse(0.9)) - 1.0).abs() < 1e-12);
        assert!((crossings(&mirror(0.5)) - 1.0 / 0.75).abs() < 1e-12);
        let glass = SceneBsdf::Dielectric(Dielectric { eta: 1.5 });
        assert!((crossings(&glass) - 1.0 / (1.0 - 0.15 * 0.15)).abs() < 1e-12);
    }
}
