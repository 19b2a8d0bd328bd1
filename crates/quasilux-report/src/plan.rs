//! The scene as a plan: what [`quasilux_drawing`] is told of it.

use glam::DVec3;
use quasilux_drawing::Drawing;
use quasilux_drawing::picture::{
    self, PlanAreaLight, PlanCamera, PlanGrid, PlanLuminaire, PlanMark, PlanPicture, PlanPoint,
    PlanPoints, Surfaces, Surroundings,
};
use quasilux_scene::light::{AreaLight, Luminaire};
use quasilux_scene::{Camera, Light, Mesh, Opening, Scene, Sensor, SensorPoint, SensorShape};

/// The plan and two elevations of a scene with lights, sensors and cameras. `marks` are red
/// balloons with a number at their places; their texts are listed below.
#[must_use]
pub fn plan(scene: &Scene, title: &str, marks: &[PlanMark]) -> Drawing {
    let lights = Lights::new(scene);
    let Surroundings { surfaces, luminaires, point_lights_m, area_lights, openings_m, .. } =
        lights.surroundings(scene);
    let points: Vec<NamedPoints<'_>> = scene.sensors.iter().filter_map(named_points).collect();
    let named = points.iter().map(|NamedPoints { name, points }| PlanPoints { name, points });
    picture::plan(&PlanPicture {
        title,
        surfaces,
        openings_m,
        area_lights,
        luminaires,
        point_lights_m,
        grids: &scene.sensors.iter().filter_map(grid).collect::<Vec<_>>(),
        points: &named.collect::<Vec<_>>(),
        cameras: &scene.cameras.iter().map(camera).collect::<Vec<_>>(),
        marks,
        north_deg: scene.environment.as_ref().map_or(0.0, |outside| outside.north_deg),
    })
}

/// The lights of a scene, each kind in its order, and where daylight comes in.
pub(crate) struct Lights<'a> {
    luminaires: Vec<PlanLuminaire>,
    point_lights_m: Vec<DVec3>,
    area_lights: Vec<PlanAreaLight<'a>>,
    openings_m: Vec<[DVec3; 4]>,
    /// Of each material, whether light goes through it.
    lets_through: Vec<bool>,
}

impl<'a> Lights<'a> {
    pub(crate) fn new(scene: &'a Scene) -> Self {
        let openings = scene.environment.iter().flat_map(|outside| &outside.openings);
        let mut lights = Self {
            luminaires: Vec::new(),
            point_lights_m: Vec::new(),
            area_lights: Vec::new(),
            openings_m: openings.map(corners).collect(),
            lets_through: scene.materials.iter().map(|it| it.bsdf.transmits()).collect(),
        };
        for light in &scene.lights {
            match light {
                Light::Luminaire(light) => lights.luminaires.push(luminaire(light)),
                Light::Point(light) => lights.point_lights_m.push(light.position),
                Light::Area(light) => lights.area_lights.push(area_light(scene, light)),
            }
        }
        lights
    }

    /// The lights, and the surfaces of the scene.
    pub(crate) fn surroundings(&'a self, scene: &'a Scene) -> Surroundings<'a> {
        let Mesh { positions, triangles, material_of, .. } = &scene.mesh;
        Surroundings {
            surfaces: Surfaces {
                positions_m: positions,
                triangles,
                material_of,
                lets_through: &self.lets_through,
            },
            luminaires: &self.luminaires,
            point_lights_m: &self.point_lights_m,
            area_lights: &self.area_lights,
            openings_m: &self.openings_m,
            north_deg: scene.environment.as_ref().map(|outside| outside.north_deg),
        }
    }
}

/// The corners of an opening in turn.
fn corners(opening: &Opening) -> [DVec3; 4] {
    let &Opening { origin, u, v } = opening;
    [origin, origin + u, origin + u + v, origin + v]
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
