//! Small scenes made on the fly: a closed room and an open floor.

use crate::support::{Folder, box_obj, panel_obj};

/// How much light a scene gives and how its surfaces reflect it.
pub(crate) struct Look {
    /// As TOML: a number or a triple.
    pub(crate) reflectance: &'static str,
    /// Factor of all lights.
    pub(crate) dimming: f64,
}

impl Look {
    pub(crate) const GREY: Self = Self { reflectance: "0.5", dimming: 1.0 };
}

pub(crate) const LAMP_IES: &str = "IESNA:LM-63-2002\n[TEST] none\n[TESTLAB] none\n\
    [ISSUEDATE] 1-JAN-2026\n[MANUFAC] none\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n\
    0 45 90\n0\n100 80 20\n";

/// A closed room of 2 m x 2 m x 2 m with all kinds of lights, a grid and two free points.
pub(crate) fn write_room(folder: &Folder, project: &str, look: &Look) {
    let walls = box_obj("wall", [0.0; 3], [2.0; 3], 1);
    write(folder, project, look, &format!("{walls}{}", panel_obj(1.9, 9)));
}

/// A floor of 2 m x 2 m under a panel and the other lights, from which light gets lost.
pub(crate) fn write_floor(folder: &Folder, project: &str, look: &Look) {
    let floor = "o floor\nusemtl wall\nv 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";
    write(folder, project, look, &format!("{floor}{}", panel_obj(1.9, 5)));
}

/// Leaves the grid, and no free points.
pub(crate) fn remove_probes(folder: &Folder, project: &str) {
    let file = format!("{project}.toml");
    let text = folder.read(&file);
    let start = text.find("[[sensors]]\nname = \"probes\"").expect("probes");
    let end = text.find("[simulation]").expect("settings");
    folder.write(&file, [&text[..start], &text[end..]].concat());
}

fn write(folder: &Folder, project: &str, look: &Look, obj: &str) {
    let Look { reflectance, dimming } = look;
    let (intensity_cd, luminance_cd_m2) = (30.0 * dimming, 500.0 * dimming);
    folder.write("lamp.ies", LAMP_IES);
    folder.write(&format!("{project}.obj"), obj);
    folder.write(
        &format!("{project}.toml"),
        format!(
            r#"
[scene]
geometry = ["{project}.obj"]
[materials.wall]
reflectance = {reflectance}
[materials.panel]
reflectance = 0
[[luminaires]]
photometry = "lamp.ies"
position = [0.4, 1.2, 1.5]
dimming = {dimming:e}
[[lights]]
kind = "point"
position = [1.5, 0.3, 1.2]
intensity_cd = {intensity_cd:e}
[[lights]]
kind = "area"
material = "panel"
luminance_cd_m2 = {luminance_cd_m2:e}
[[sensors]]
name = "plane"
kind = "grid"
origin = [0.1, 0.1, 0.4]
u = [1.8, 0, 0]
v = [0, 1.8, 0]
counts = [3, 2]
[[sensors]]
name = "probes"
kind = "points"
points = [[1, 1, 0.5], [0.5, 0.5, 0.9]]
normals = [[0, 0.6, 0.8], [0.8, 0, 0.6]]
[simulation]
rel_tol = 0.1
replicates = 8
"#
        ),
    );
}
