//! Cameras that see nothing, and pictures that nobody could store.

use super::{Case, check};

/// Begins on line 28 of the project.
const CAMERA: &str = "[[cameras]]\nname = \"eye\"\nposition = [0, 0, 1]\ntarget = [1, 1, 0.5]\n\
     up = [0, 0, 1]\nvertical_fov_deg = 60\nresolution = [8, 6]\n[simulation]";

/// A project whose camera is right but for one change.
fn camera(what: &'static str, from: &'static str, to: &'static str) -> Case {
    Case::new(what).replace("[simulation]", CAMERA).replace(from, to)
}

#[test]
fn cameras() {
    check(
        "cameras",
        &[
            camera("unknown key", "vertical_fov_deg", "vertical_fov")
                .says(&["project.toml:33:1:", "did you mean \"vertical_fov_deg\"?"]),
            camera("missing key", "resolution = [8, 6]\n", "")
                .says(&["project.toml:28:1:", "lacks \"resolution\""]),
            camera("the name of a sensor", "\"eye\"", "\"Probes\"")
                .says(&["project.toml:29:8:", "the sensor \"probes\" on line 22"]),
            camera("a name that leaves the folder", "\"eye\"", "\"../eye\"")
                .says(&["project.toml:29:8:", "file name"]),
            camera("nothing to look at", "target = [1, 1, 0.5]", "target = [0, 0, 1]")
                .says(&["project.toml:31:10:", "another point"]),
            camera("up along the line of sight", "up = [0, 0, 1]", "up = [2, 2, -1]")
                .says(&["project.toml:32:6:", "parallel"]),
            camera("half a sphere", "vertical_fov_deg = 60", "vertical_fov_deg = 180")
                .says(&["project.toml:33:20:", "between 0 and 180"]),
            camera("no pixels", "[8, 6]", "[0, 6]").says(&["project.toml:34:", "1 to 16384"]),
            camera("too many pixels", "[8, 6]", "[10000, 10000]")
                .says(&["project.toml:34:14:", "at most 16777216"]),
            camera("inside a wall", "position = [0, 0, 1]", "position = [1.8, 1.8, 0.5]").says(&[
                "project.toml:28:1:",
                "\"eye\"",
                "\"wood\"",
            ]),
            camera("photons", "estimator = \"path\"", "estimator = \"photon\"")
                .says(&["project.toml: camera \"eye\"", "use another estimator"]),
        ],
    );
}
