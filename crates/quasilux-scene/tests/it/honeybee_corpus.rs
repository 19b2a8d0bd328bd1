//! Models of Honeybee, as it and others write them, where they are at hand: counts and areas are
//! those that the JSON gives without the reader.

use crate::support::{MapFiles, PROJECT, load_text};
use glam::DVec3;
use quasilux_scene::Scene;
use serde_json::Value;
use std::collections::HashSet;
use std::path::PathBuf;

/// A project of nothing but the model's surfaces.
fn project(name: &str) -> String {
    let project = PROJECT.replace("room.obj", name);
    project.replace("origin = [0, 0, 0.8]", "origin = [0, 0, 1e6]")
}

fn list<'v>(of: &'v Value, key: &str) -> &'v [Value] {
    of[key].as_array().map_or(&[], Vec::as_slice)
}

fn point(value: &Value) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|i| value[i].as_f64().expect("a number")))
}

/// By the sum of cross products round the outline.
fn area(outline: &Value) -> f64 {
    let corners: Vec<DVec3> = outline.as_array().expect("corners").iter().map(point).collect();
    let next = corners.iter().cycle().skip(1);
    0.5 * corners.iter().zip(next).map(|(a, b)| a.cross(*b)).sum::<DVec3>().length()
}

/// Number of surfaces, and their area together.
#[derive(Debug, Default)]
struct Count {
    surfaces: usize,
    area: f64,
    pairs: HashSet<String>,
}

impl Count {
    fn polygon(&mut self, thing: &Value) {
        self.surfaces += 1;
        let holes = list(&thing["geometry"], "holes").iter().map(area).sum::<f64>();
        self.area += area(&thing["geometry"]["boundary"]) - holes;
    }

    fn shades(&mut self, of: &Value) {
        for shade in list(of, "indoor_shades").iter().chain(list(of, "outdoor_shades")) {
            self.polygon(shade);
        }
    }

    /// Whether it is the second side of a pair.
    fn is_second(&mut self, thing: &Value) -> bool {
        let condition = &thing["boundary_condition"];
        if condition["type"] != "Surface" {
            return false;
        }
        let own = thing["identifier"].as_str().expect("a name").to_owned();
        let other = condition["boundary_condition_objects"][0].as_str().expect("a name");
        self.pairs.insert(own);
        self.pairs.contains(other)
    }

    fn face(&mut self, face: &Value) {
        let subs = || list(face, "apertures").iter().chain(list(face, "doors"));
        if !self.is_second(face) {
            assert_ne!(face["face_type"], "AirBoundary");
            self.polygon(face);
            self.area -= subs().map(|sub| area(&sub["geometry"]["boundary"])).sum::<f64>();
        }
        for sub in subs() {
            if !self.is_second(sub) {
                self.polygon(sub);
                let first = &sub["properties"]["radiance"]["states"][0];
                list(first, "shades").iter().for_each(|shade| self.polygon(shade));
            }
            self.shades(sub);
        }
        self.shades(face);
    }

    fn new(model: &Value) -> Self {
        let mut count = Self::default();
        for room in list(model, "rooms") {
            list(room, "faces").iter().for_each(|face| count.face(face));
            count.shades(room);
        }
        list(model, "orphaned_shades").iter().for_each(|shade| count.polygon(shade));
        for mesh in list(model, "shade_meshes") {
            count.surfaces += 1;
            let vertices = list(&mesh["geometry"], "vertices");
            for facet in list(&mesh["geometry"], "faces") {
                let corners = facet.as_array().expect("a facet").iter();
                let corners = corners.map(|i| vertices[i.as_u64().unwrap() as usize].clone());
                count.area += area(&Value::Array(corners.collect()));
            }
        }
        count
    }
}

fn models() -> Vec<PathBuf> {
    let Some(folder) = quasilux_corpus::find("hbjson") else { return Vec::new() };
    let files = std::fs::read_dir(folder).expect("a folder").flatten().map(|file| file.path());
    let mut models: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|it| it == "hbjson")).collect();
    models.sort();
    assert_eq!(models.len(), 18);
    models
}

fn total_area(scene: &Scene) -> f64 {
    (0..scene.mesh.triangles.len() as u32).map(|t| scene.mesh.area_m2(t)).sum()
}

#[test]
fn all_models_load_with_the_surfaces_that_they_have() {
    for path in models() {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let model: Value = serde_json::from_slice(&bytes).unwrap();
        let expected = Count::new(&model);
        let loaded = load_text(&project(name), &MapFiles::default().with(name, &bytes));
        let loaded = loaded.unwrap_or_else(|error| panic!("{name}: {error}"));
        let (surfaces, area) = (loaded.scene.mesh.objects.len(), total_area(&loaded.scene));
        println!("{name}: {surfaces} surfaces, {area:.3} m2");
        loaded.warnings.iter().for_each(|warning| println!("    {warning}"));
        assert_eq!(surfaces, expected.surfaces, "{name}");
        let difference = (area - expected.area).abs() / expected.area;
        assert!(difference < 1e-6, "{name}: {area} m2 is not {}", expected.area);
    }
}
