//! Checks that need the whole scene: a sensor or camera inside a wall sees nothing, and hides a
//! mistake.
//!
//! "Wall" is any solid of opaque surfaces that holds it and no light: a closed room around its
//! lights is none.

use crate::light::AreaLight;
use crate::project::{CameraEntry, Project, SensorEntry};
use crate::solids::{Solid, solids_of};
use crate::{Camera, Light, LoadError, Mesh, Scene, SensorPoint, SensorShape, Warning};
use glam::DVec3;
use std::sync::Arc;

/// Triangles that may be tested in all before the search for sensors in walls is given up: some
/// seconds at most.
pub(crate) const MAX_TRIANGLE_TESTS: u64 = 200_000_000;

/// Cure for sensors and cameras, for messages.
const EXPECTED: &str = "move it where light can reach it";

/// A sensor point on a surface is judged by the place this share of the scene's size in front.
const HAIR: f64 = 1e-6;

/// A closed body that is as wide, and as high, in m, is a room: that no light is in it may be
/// meant, and the other rooms of a building are wanted all the same.
const ROOM_M: DVec3 = DVec3::new(1.5, 1.5, 1.8);

/// Refuses cameras and `points` sensors with a point inside a wall, and grids that are altogether
/// inside; warns of grids with some cells inside, and of all that is in rooms without light.
pub(crate) fn places_in_walls(
    scene: &Scene,
    project: &Project,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let Some([low, high]) = scene.mesh.bounds() else {
        return Ok(());
    };
    // Glass and panes let light in.
    let opaque = solids_of(&scene.mesh).into_iter().filter(|solid| !solid.transmits(scene));
    let mut walls = Walls {
        scene,
        hair_m: HAIR * (high - low).length(),
        bodies: opaque.map(|solid| Body { solid, is_lit: None, is_room: None }).collect(),
        tests_left: MAX_TRIANGLE_TESTS,
    };
    for entry in &project.sensors {
        check_sensor(entry, &mut walls, project, warnings)?;
    }
    let mut cameras = project.cameras.iter();
    cameras.try_for_each(|entry| check_camera(entry, &mut walls, project, warnings))
}

fn check_sensor(
    entry: &SensorEntry,
    walls: &mut Walls<'_>,
    project: &Project,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let name = &entry.sensor.name;
    let points = entry.sensor.points();
    let inside: Vec<Option<Wall>> = points.iter().map(|point| walls.around(point)).collect();
    let count = inside.iter().flatten().count();
    let in_walls = inside.iter().enumerate().filter_map(|(i, wall)| Some((i, wall.as_ref()?)));
    let Some((first, wall @ Wall { is_room, .. })) = in_walls.min_by_key(|(_, wall)| wall.is_room)
    else {
        return Ok(());
    };
    if let (SensorShape::Points(_), false) = (&entry.sensor.shape, is_room) {
        let place = entry.point_places.get(first).copied().unwrap_or(entry.place);
        let message = format!("point {} of sensor \"{name}\" lies {wall}; {EXPECTED}", first + 1);
        return Err(project.error(place, message));
    }
    if count == points.len() && !is_room {
        return Err(
            project.error(entry.place, format!("sensor \"{name}\" lies {wall}; {EXPECTED}"))
        );
    }
    let message = format!("{count} of {} points of sensor \"{name}\" lie {wall}", points.len());
    warnings.push(Warning::new(&project.file, Some(entry.place), message));
    Ok(())
}

fn check_camera(
    entry: &CameraEntry,
    walls: &mut Walls<'_>,
    project: &Project,
    warnings: &mut Vec<Warning>,
) -> Result<(), LoadError> {
    let Camera { name, position, target, .. } = &entry.camera;
    let eye = SensorPoint { position: *position, normal: (*target - *position).normalize() };
    let Some(wall) = walls.around(&eye) else { return Ok(()) };
    let message = format!("camera \"{name}\" lies {wall}");
    if wall.is_room {
        warnings.push(Warning::new(&project.file, Some(entry.place), message));
        return Ok(());
    }
    Err(project.error(entry.place, format!("{message}; {EXPECTED}")))
}

/// A closed object without light in it.
struct Wall {
    object: Arc<str>,
    is_room: bool,
}

impl std::fmt::Display for Wall {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "inside the closed object \"{}\", which holds no light", self.object)
    }
}

/// The solids of a scene, of which some are walls.
struct Walls<'a> {
    scene: &'a Scene,
    hair_m: f64,
    bodies: Vec<Body>,
    tests_left: u64,
}

/// A solid, with what has been asked of it.
struct Body {
    solid: Solid,
    /// Whether it holds a light.
    is_lit: Option<bool>,
    is_room: Option<bool>,
}

impl Walls<'_> {
    /// The name of a wall that the point is inside of.
    fn around(&mut self, point: &SensorPoint) -> Option<Wall> {
        let position = point.position + point.normal * self.hair_m;
        for Body { solid, is_lit, is_room } in &mut self.bodies {
            if *is_lit == Some(true) || !solid.may_contain(position) {
                continue;
            }
            let mesh = &self.scene.mesh;
            let mut contains = |position: DVec3| {
                self.tests_left = self.tests_left.checked_sub(solid.triangles.len() as u64)?;
                Some(solid.contains(mesh, position))
            };
            if !contains(position)? {
                continue;
            }
            if is_lit.is_none() {
                *is_lit = Some(holds_light(self.scene, solid, &mut contains)?);
            }
            if *is_lit == Some(false) {
                let object = mesh.object_of[solid.triangles[0] as usize];
                let object = Arc::clone(&mesh.objects[object as usize]);
                let is_room = *is_room.get_or_insert_with(|| is_room_like(mesh, solid));
                return Some(Wall { object, is_room });
            }
        }
        None
    }
}

/// By its width and not by the box around it: a wardrobe that stands askew has a wide one.
fn is_room_like(mesh: &Mesh, solid: &Solid) -> bool {
    solid.edges_m().cmpge(ROOM_M).all() && solid.width_m(mesh) >= ROOM_M.x
}

/// Whether a light is inside the solid, on its surface or part of it; `None` when the tests are
/// used up. A recessed luminaire lies on the surface: it is looked for a hair to each side.
pub(crate) fn holds_light(
    scene: &Scene,
    solid: &Solid,
    contains: &mut impl FnMut(DVec3) -> Option<bool>,
) -> Option<bool> {
    let hair_m = HAIR * solid.size_m();
    let mut contains = |position: DVec3| {
        if solid.may_contain(position) { contains(position) } else { Some(false) }
    };
    let mut touches = |position: DVec3| {
        // The eight diagonals reach inside from faces, edges and corners.
        for octant in 0..8 {
            let side = |bit: u32| if octant >> bit & 1 == 0 { hair_m } else { -hair_m };
            if contains(position + DVec3::new(side(0), side(1), side(2)))? {
                return Some(true);
            }
        }
        contains(position)
    };
    for light in &scene.lights {
        let lit = match light {
            Light::Point(light) => touches(light.position)?,
            Light::Luminaire(light) => touches(light.position)?,
            Light::Area(light) => {
                emits(light, solid) || {
                    let mut any = false;
                    for &triangle in &light.triangles {
                        any = any || touches(centroid(&scene.mesh, triangle))?;
                    }
                    any
                }
            }
        };
        if lit {
            return Some(true);
        }
    }
    Some(false)
}

/// Whether a triangle of the solid belongs to the light; both lists ascend.
fn emits(light: &AreaLight, solid: &Solid) -> bool {
    solid.triangles.iter().any(|triangle| light.triangles.binary_search(triangle).is_ok())
}

fn centroid(mesh: &Mesh, triangle: u32) -> DVec3 {
    mesh.corners(triangle).into_iter().sum::<DVec3>() / 3.0
}
