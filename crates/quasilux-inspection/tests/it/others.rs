//! Scenes of others, of which nothing is told: boxes that cameras look into, small things in the
//! middle of nothing.

use crate::room::inspected;
use quasilux_scene::{FileKind, Files};
use std::path::PathBuf;

const GREY: &str = "[materials.default]\nreflectance = 0.5\n";
/// Embree's box in a file that has an ending and no material library.
const NAMELESS: &str = "embree.obj";

/// Files of the corpus.
struct Corpus(PathBuf);

impl Files for Corpus {
    fn read(&self, path: &str, _: FileKind) -> std::io::Result<Vec<u8>> {
        if path == NAMELESS {
            let text = std::fs::read_to_string(self.0.join("cbox-embree/.obj"))?;
            return Ok(text.replace("mtllib", "#").into_bytes());
        }
        std::fs::read(self.0.join(path))
    }
}

fn point(position: &str, intensity_cd: f64) -> String {
    format!("[[lights]]\nkind = \"point\"\nposition = {position}\nintensity_cd = {intensity_cd}\n")
}

fn camera(view: &str) -> String {
    format!("[[cameras]]\nname = \"view\"\n{view}vertical_fov_deg = 40\nresolution = [64, 48]\n")
}

/// A project over these files.
fn project(folder: &str, files: &[&str], unit: &str, rest: &[String]) -> String {
    let geometry: Vec<String> =
        files.iter().map(|file| format!("{:?}", format!("{folder}{file}"))).collect();
    format!(
        "[scene]\ngeometry = [{}]\nup = \"y\"\nunits = \"{unit}\"\n{}",
        geometry.join(", "),
        rest.concat()
    )
}

/// Projects over scenes of the corpus.
fn projects() -> Vec<String> {
    let into_the_box = || {
        let view = camera("position = [0.278, 0.8, 0.273]\ntarget = [0.278, 0, 0.273]\n");
        [GREY.to_owned(), point("[0.278, -0.28, 0.5]", 20.0), view]
    };
    let parts = ["floor", "ceiling", "back", "greenwall", "redwall", "smallbox", "largebox"];
    let parts = parts.map(|part| format!("{part}.obj"));
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    let boxes = ["cbox-mitsuba/meshes/cbox_", "cbox-lajolla/meshes/cbox_"];
    let mut projects = boxes.map(|of| project(of, &parts, "mm", &into_the_box())).to_vec();
    projects.push(project("", &[NAMELESS], "mm", &into_the_box()));

    let lamp = "[[lights]]\nkind = \"area\"\nmaterial = \"light\"\nluminance_cd_m2 = 4000\n";
    let view = camera("position = [0, -3.5, 1]\ntarget = [0, 0, 1]\n");
    projects.push(project("cbox-kajiya-gltf/", &["scene.gltf"], "m", &[lamp.to_owned(), view]));

    let view = camera("position = [-2.78, -8, 2.73]\ntarget = [-2.78, 0, 2.73]\n");
    let rest = [point("[-2.78, 2.8, 5]", 300.0), view];
    projects.push(project("cbox-bevy-glb/", &["CornellBox.glb"], "cm", &rest));

    for small in ["teapot.obj", "wine_glass.obj"] {
        let view = camera("position = [0.3, -0.3, 0.2]\ntarget = [0, 0, 0.05]\n");
        let rest = [GREY.to_owned(), point("[0, 0, 0.5]", 100.0), view];
        projects.push(project("rpt-objs/", &[small], "in", &rest));
    }

    let view = camera("position = [0, -15, 2]\ntarget = [0, 0, -2]\n");
    let rest = [GREY.to_owned(), point("[0, -2, 4]", 300.0), view];
    let plates = ["floor.obj", "plate1.obj", "plate2.obj", "plate3.obj", "plate4.obj"];
    projects.push(project("veach-mi-lajolla/", &plates, "m", &rest));
    projects
}

#[test]
fn scenes_of_others_are_right() {
    let Some(folder) = quasilux_corpus::find("scenes") else { return };
    let projects = projects();
    let said = projects.iter().flat_map(|project| {
        let findings = inspected("scene.toml", project.as_bytes(), &Corpus(folder.clone()));
        findings.into_iter().map(move |finding| format!("{project}\n{finding}"))
    });
    let told: Vec<String> = said.collect();
    assert!(projects.len() == 8 && told.is_empty(), "{}", told.join("\n"));
}
