//! Which classes of light paths in a scene an estimator cannot make: what its values are without,
//! or have blurred.

use crate::bsdf::Bsdf;
use crate::context::Context;
use crate::settings::{EstimatorKind, Settings};
use crate::spectrum::Spectrum;
use quasilux_scene::{Quantity, Scene, SensorShape};

/// The classes, a light first and what it meets in order, of an estimator that has no bound to say
/// it: see [`crate::Estimates::cannot_see`].
pub(crate) fn cannot_see<S: Spectrum>(
    context: &Context<'_, S>,
    scene: &Scene,
    settings: &Settings,
) -> Vec<String> {
    match settings.estimator {
        EstimatorKind::Photon => of_photons(scene),
        EstimatorKind::Auto | EstimatorKind::Bidirectional => Vec::new(),
        EstimatorKind::Path | EstimatorKind::BidirectionalMap => of_paths(context),
    }
}

/// Photons meet cells and elements, and no point.
fn of_photons(scene: &Scene) -> Vec<String> {
    let asks_for_points = scene.sensors.iter().any(|sensor| match &sensor.shape {
        SensorShape::Points(_) => true,
        SensorShape::Grid(grid) => grid.quantity == Quantity::Centre,
    });
    let class = "any light, point (but as a mean over its cell, element or square)";
    if asks_for_points { vec![class.to_owned()] } else { Vec::new() }
}

/// Paths end neither in a point-like light nor in a luminous shape, and hardly in the sun.
fn of_paths<S: Spectrum>(context: &Context<'_, S>) -> Vec<String> {
    let world = &context.world;
    let bsdfs = || world.facets.iter().map(|facet| world.bsdf_of(facet));
    let is_other = |bsdf: &Bsdf<S>| !bsdf.is_specular() && !bsdf.keeps_illuminance();
    let matt = bsdfs().any(Bsdf::keeps_illuminance).then_some("matt surface, point");
    let others = bsdfs().any(is_other).then_some("other surface, point");
    // A specular surface is one bounce, another surface a second.
    let ends = [(1, Some("point")), (2, matt), (2, others)].into_iter();
    let is_wanted = |bounces: u32| context.max_bounces.is_none_or(|most| bounces <= most);
    let ends = ends.filter(|(bounces, _)| is_wanted(*bounces)).filter_map(|(_, end)| end);
    let ends: Vec<&str> = ends.collect();
    let classes = context.images.unshown_classes(world, &context.lights);
    let with_ends = |class: &String| {
        let class = class.clone();
        ends.iter().map(move |end| format!("{class}, {end}"))
    };
    classes.iter().flat_map(with_ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{diffuse, level_grid, mirror, point_light, points, room};
    use glam::DVec3;
    use quasilux_scene::bsdf::{Conductor, Dielectric};
    use quasilux_scene::{Bsdf as SceneBsdf, Environment, Material, Rgb, Sun};
    use quasilux_sky::{Distribution, Sky, SkyLevel, SkyPoint};

    /// A room with a lamp, a mirror and a body of glass.
    fn glazed_room() -> Scene {
        let mut scene = room(DVec3::new(4.0, 3.0, 2.5), diffuse(0.5));
        scene.lights.push(point_light(DVec3::new(0.9, 1.0, 1.9), 300.0));
        scene.sensors.push(points("desk", &[(DVec3::new(1.0, 1.0, 0.8), DVec3::Z)]));
        make_wall(&mut scene, 4, mirror(0.9));
        make_wall(&mut scene, 6, SceneBsdf::Dielectric(Dielectric { eta: 1.5 }));
        scene
    }

    fn make_wall(scene: &mut Scene, first: usize, bsdf: SceneBsdf) {
        scene.mesh.material_of[first..first + 2].fill(scene.materials.len() as u32);
        scene.materials.push(Material { name: format!("wall {first}"), bsdf });
    }

    fn sunny() -> Environment {
        let level = SkyLevel::ZenithLuminance { cd_m2: 1.0 };
        let centre = SkyPoint { altitude_deg: 40.0, azimuth_deg: 180.0 };
        Environment {
            sky: Sky::new(Distribution::uniform(), level).unwrap(),
            sun: Some(Sun { centre, normal_illuminance_lx: 1e5 }),
            ground_reflectance: 0.2,
            north_deg: 0.0,
            openings: Vec::new(),
        }
    }

    fn classes(scene: &Scene, settings: &Settings) -> Vec<String> {
        cannot_see(&Context::<f64>::new(scene, settings), scene, settings)
    }

    #[test]
    fn paths_say_what_only_photons_bring() {
        let mut scene = glazed_room();
        let path = Settings { estimator: EstimatorKind::Path, ..Settings::default() };
        let of_lamp = ["lamp, glass body, point", "lamp, glass body, matt surface, point"];
        assert_eq!(classes(&scene, &path), of_lamp);
        let one_bounce = Settings { max_bounces: Some(1), ..path.clone() };
        assert_eq!(classes(&scene, &one_bounce), of_lamp[..1]);
        assert!(classes(&scene, &Settings { max_bounces: Some(0), ..path.clone() }).is_empty());
        let no_images = Settings { image_depth: Some(0), ..one_bounce.clone() };
        assert_eq!(classes(&scene, &no_images), [of_lamp[0], "lamp, mirror, point"]);
        scene.environment = Some(sunny());
        let of_sun = ["sun, mirror, point", "sun, glass body, point"];
        assert_eq!(classes(&scene, &one_bounce), [of_lamp[0], of_sun[0], of_sun[1]]);
        let metal = Conductor { reflectance: Rgb([0.8; 3]), alpha: 0.2 };
        make_wall(&mut scene, 8, SceneBsdf::Conductor(metal));
        let all = classes(&scene, &path);
        assert_eq!(all[2], "lamp, glass body, other surface, point");
        assert_eq!(all.len(), 9);
    }

    #[test]
    fn photons_see_all_but_points() {
        let mut scene = glazed_room();
        let photon = Settings { estimator: EstimatorKind::Photon, ..Settings::default() };
        assert_eq!(classes(&scene, &photon).len(), 1);
        scene.sensors = vec![level_grid(DVec3::new(1.0, 1.0, 0.8), [1.0, 1.0], [2, 2])];
        assert!(classes(&scene, &photon).is_empty());
    }
}
