//! How many tables of lights a scene will ask for, before the first is made.

use super::selection::{Cubes, LightChoice};
use glam::DVec3;
use quasilux_scene::{Mesh, Scene, SensorPoint, SensorShape};

/// Places along each edge of a grid that are taken for all of its points.
const ALONG_GRIDS: u32 = 64;

/// Bytes of the tables of this many lights that places of a scene ask for: of cubes that a triangle
/// passes, on the side that it faces, and of those of sensors.
pub(crate) fn tables_bytes(lights: usize, scene: &Scene) -> u64 {
    let Some(cubes) = LightChoice::new(lights, scene.mesh.bounds()).cubes else { return 0 };
    let mut is_asked = vec![false; cubes.tables.len()];
    let triangles = (0..scene.mesh.triangles.len() as u32).flat_map(|triangle| {
        let cubes = &cubes;
        passed(cubes, &scene.mesh, triangle)
    });
    triangles.for_each(|table| is_asked[table] = true);
    for sensor in &scene.sensors {
        let mut ask = |position: DVec3, normal: DVec3| {
            is_asked[cubes.number(cubes.cube_of(position), Some(normal))] = true;
        };
        match &sensor.shape {
            SensorShape::Points(points) => {
                points.iter().for_each(|SensorPoint { position, normal }| ask(*position, *normal));
            }
            SensorShape::Grid(grid) => {
                let along = |k: u32| (f64::from(k) + 0.5) / f64::from(ALONG_GRIDS);
                for (i, j) in (0..ALONG_GRIDS).flat_map(|i| (0..ALONG_GRIDS).map(move |j| (i, j))) {
                    ask(grid.origin + grid.u * along(i) + grid.v * along(j), grid.normal);
                }
            }
        }
    }
    let tables = is_asked.into_iter().filter(|is_asked| *is_asked).count();
    // A probability, and an entry of the guide table.
    (tables * lights * (size_of::<f64>() + size_of::<u32>())) as u64
}

/// The tables of the cubes that the plane of a triangle passes in the box around it.
fn passed<'c>(cubes: &'c Cubes, mesh: &Mesh, triangle: u32) -> impl Iterator<Item = usize> + 'c {
    let [a, b, c] = mesh.corners(triangle);
    let normal = mesh.front_normal(triangle);
    let [low, high] = [a.min(b).min(c), a.max(b).max(c)].map(|at| cubes.cube_of(at));
    let layer = move |z| {
        let row = move |y| (low[0]..=high[0]).map(move |x| [x, y, z]);
        (low[1]..=high[1]).flat_map(row)
    };
    let is_passed = move |cube: &[usize; 3]| {
        let away_m = (cubes.centre(*cube) - a).dot(normal).abs();
        away_m * cubes.cubes_per_m <= 0.5 * normal.abs().element_sum()
    };
    let all = (low[2]..=high[2]).flat_map(layer);
    all.filter(is_passed).map(move |cube| cubes.number(cube, Some(normal)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A floor asks for one layer of cubes, on one side.
    #[test]
    fn tables_are_those_of_surfaces() {
        let high = DVec3::new(20.0, 10.0, 4.0);
        let corner = |x: f64, y: f64| DVec3::new(x * high.x, y * high.y, 0.0);
        let mesh = Mesh {
            positions: vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), high],
            triangles: vec![[0, 1, 2]],
            material_of: vec![0],
            object_of: vec![0],
            objects: vec!["floor".into()],
        };
        let scene = Scene { mesh, ..Scene::default() };
        assert_eq!(tables_bytes(15, &scene), 0);
        // 24 x 12 x 5 cubes fill the box.
        assert_eq!(tables_bytes(100, &scene), 24 * 12 * 100 * 12);
        assert!(tables_bytes(100_000, &scene) < 100 << 20);
    }
}
