//! K: how many samples a subpath has in a set of paths at most, on average, given that it has one.
//!
//! A subpath that is at a surface goes on with probability s at most, so n vertices follow,
//! counting it, with `n <= 1 + s n'` of the next. Where the surfaces with the largest s lie in one
//! plane, and nothing mirrors, the next is another: with r the largest s of all others, `n <= 1 + s
//! (1 + r n)`. Where eye paths favour a surface more of them go on, and each adds as much less.

use crate::spectrum::Spectrum;
use crate::world::{Facet, World};

/// Of all techniques with a sample at each vertex: of surfaces that scatter.
pub(super) fn samples_of_subpaths<S: Spectrum>(world: &World<S>) -> f64 {
    let scattering = || world.facets.iter().filter(|facet| !world.bsdf_of(facet).is_specular());
    let kept = |facet: &Facet| world.most_kept_by(facet).min(1.0);
    let Some(first) = scattering().max_by(|a, b| kept(a).total_cmp(&kept(b))) else { return 1.0 };
    let [corner, ..] = first.corners();
    let height_m = |facet: &Facet| {
        let heights = facet.corners().map(|place| first.front_normal.dot(place - corner).abs());
        heights.into_iter().fold(0.0, f64::max)
    };
    let others = || scattering().filter(|facet| height_m(facet) > world.hair_m());
    let most = kept(first);
    let after = match world.has_specular_facets() {
        true => most,
        false => others().map(kept).fold(0.0, f64::max),
    };
    (1.0 + most) / (1.0 - most * after)
}

/// Of eye paths that run into emitting facets: the first of them may send it on, and then it has as
/// many as all `subpaths`.
pub(super) fn samples_at_emitters<S: Spectrum>(world: &World<S>, subpaths: f64) -> f64 {
    let emitting = world.facets.iter().filter(|facet| facet.emitted_cd_m2 > 0.0);
    let most = emitting.map(|facet| world.most_kept_by(facet).min(1.0)).fold(0.0, f64::max);
    1.0 + if most > 0.0 { most * subpaths } else { 0.0 }
}
