//! The scene as a plan: what [`quasilux_drawing`] is told of it.

use glam::DVec3;
use quasilux_drawing::Drawing;
use quasilux_drawing::picture::{
    self, PlanAreaLight, PlanCamera, PlanGrid, PlanLuminaire, PlanMark, PlanPicture, PlanPoint,
    PlanPoints, Surfaces,
};
use quasilux_scene::light::{AreaLight, Luminaire};
use quasilux_scene::{Camera, Light, Scene, Sensor, SensorPoint, SensorShape};

/// The plan and two elevations of a scene with lights, sensors and cameras. `marks` are red
/// balloons with a number at their places; their texts are listed below.
#[must_use]
pub fn plan(scene: &Scene, title: &str, marks: &[PlanMark]) -> Drawing {
    let areas = scene.lights.iter().filter_map(|light| match light {
        Light::Area(light) => Some(area_light(scene, light)),
        Light::Point(_) | Light::Luminaire(_) => None,
    });
    let luminaires = scene.lights.iter().filter_map(|light| match light {
        Light::Luminaire(light) => Some(luminaire(light)),
        Light::Point(_) | Light::Area(_) => None,
    });
    let point_lights = scene.lights.iter().filter_map(|light| match light {
        Light::Point(light) => Some(light.position),
        Light::Luminaire(_) | Light::Area(_) => None,
    });
    let points: Vec<NamedPoints<'_>> = scene.sensors.iter().filter_map(named_points).collect();
    let named = points.iter().map(|NamedPoints { name, points }| PlanPoints { name, points });
    picture::plan(&PlanPicture {
        title,
        surfaces: Surfaces { positions_m: &scene.mesh.positions, triangles: &scene.mesh.triangles },
        area_lights: &areas.collect::<Vec<_>>(),
        luminaires: &luminaires.collect::<Vec<_>>(),
        point_lights_m: &point_lights.collect::<Vec<DVec3>>(),
        grids: &scene.sensors.iter().filter_map(grid).collect::<Vec<_>>(),
        points: &named.collect::<Vec<_>>(),
        cameras: &scene.cameras.iter().map(camera).collect::<Vec<_>>(),
        marks,
    })
}

struct NamedPoints<'a> {
    name: &'a str,
    points: Vec<PlanPoint>,
}

fn named_points(sensor: &Sensor) -> Option<NamedPoints<'_>> {
    let SensorShape::Points(points) = &sensor.shape else {
        return None;
    };
    let point =
        |point: &SensorPoint| PlanPoint { position_m: point.position, normal: point.normal };
    Some(NamedPoints { name: &sensor.name, points: points.iter().map(point).collect() })
}

fn grid(sensor: &Sensor) -> Option<PlanGrid<'_>> {
    let SensorShape::Grid(grid) = &sensor.shape else {
        return None;
    };
    Some(PlanGrid {
        name: &sensor.name,
        origin_m: grid.origin,
        edges_m: [grid.u, grid.v],
        counts: grid.counts,
        normal: grid.normal,
    })
}

fn area_light<'a>(scene: &'a Scene, light: &'a AreaLight) -> PlanAreaLight<'a> {
    let name = scene.materials.get(light.material as usize).map_or("", |m| m.name.as_str());
    PlanAreaLight { name, triangles: &light.triangles }
}

fn luminaire(light: &Luminaire) -> PlanLuminaire {
    let shape = light.photometry.facts().shape();
    PlanLuminaire {
        name: light.photometry.name().to_owned(),
        position_m: light.position,
        aim: -light.world_from_luminaire.z_axis,
        c0: light.world_from_luminaire.x_axis,
        opening_m: shape.size_m(),
        is_round: shape.is_round(),
    }
}

fn camera(camera: &Camera) -> PlanCamera<'_> {
    let [width, height] = camera.resolution.map(f64::from);
    let view = camera.view();
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    PlanCamera {
        name: &camera.name,
        position_m: camera.position,
        corners: corners.map(|corner| view.direction(corner)),
    }
}
