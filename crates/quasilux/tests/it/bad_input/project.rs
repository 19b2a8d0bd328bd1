//! Project files that make no sense.

use super::{Case, check};

#[test]
fn text() {
    check(
        "text",
        &[
            Case::new("empty").file("project.toml", "").says(&["project.toml:1:1", "[scene]"]),
            Case::new("not UTF-8")
                .file("project.toml", b"[scene]\nup = \"\xff\"\n")
                .says(&["project.toml:2:7", "UTF-8"]),
            Case::new("binary")
                .file("project.toml", [0, 159, 146, 150, 0])
                .says(&["project.toml:1:2", "UTF-8"]),
            Case::new("not TOML")
                .replace("[[sensors]]", "[[sensors]")
                .says(&["project.toml:14:", "TOML"]),
            Case::new("a key twice")
                .replace("dimming = 1.0", "dimming = 1.0\ndimming = 0.5")
                .says(&["project.toml:13:", "TOML"]),
        ],
    );
}

#[test]
fn keys_and_types() {
    check(
        "keys",
        &[
            Case::new("unknown key").replace("rel_tol", "rel_tool").says(&[
                "project.toml:32:1:",
                "rel_tool",
                "did you mean \"rel_tol\"?",
            ]),
            Case::new("unknown section")
                .replace("[[luminaires]]", "[[luminares]]")
                .says(&["project.toml:7:3:", "did you mean \"luminaires\"?"]),
            Case::new("missing key")
                .replace("position = [1, 1, 2]\n", "")
                .says(&["project.toml:7:", "position"]),
            Case::new("a word for a number")
                .replace("dimming = 1.0", "dimming = \"full\"")
                .says(&["project.toml:12:11:", "dimming", "factor"]),
            Case::new("a number for a list")
                .replace("u = [2, 0, 0]", "u = 2")
                .says(&["project.toml:18:5:", "expected"]),
            Case::new("two coordinates")
                .replace("position = [1, 1, 2]", "position = [1, 1]")
                .says(&["project.toml:9:12:", "[x, y, z]"]),
            Case::new("a table for an array of tables")
                .replace("[[luminaires]]", "[luminaires]")
                .says(&["project.toml:7:", "[[luminaires]]"]),
            Case::new("an infinite number")
                .replace("dimming = 1.0", "dimming = inf")
                .says(&["project.toml:12:11:", "inf"]),
        ],
    );
}

#[test]
fn lights_and_materials() {
    const LUMINAIRE: &str = "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = [1, 1, 2]\naim \
         = [0, 0, -1]\nc0 = [1, 0, 0]\ndimming = 1.0\n";
    check(
        "lights",
        &[
            Case::new("no lights").replace(LUMINAIRE, "").says(&["project.toml:1:1", "no lights"]),
            Case::new("no flux")
                .replace("dimming = 1.0", "dimming = 0")
                .says(&["project.toml:7:", "flux"]),
            Case::new("negative dimming")
                .replace("dimming = 1.0", "dimming = -0.5")
                .says(&["project.toml:12:11:", "-0.5"]),
            Case::new("c0 along aim")
                .replace("c0 = [1, 0, 0]", "c0 = [0, 0, 2]")
                .says(&["project.toml:11:6:", "parallel to \"aim\""]),
            Case::new("aim along the default of c0")
                .replace("aim = [0, 0, -1]\nc0 = [1, 0, 0]", "aim = [3, 0, 0]")
                .says(&["project.toml:10:7:", "c0"]),
            Case::new("aim without length")
                .replace("aim = [0, 0, -1]", "aim = [0, 0, 0]")
                .says(&["project.toml:10:7:", "no length"]),
            Case::new("a light of unknown kind")
                .replace("[simulation]", "[[lights]]\nkind = \"pint\"\n[simulation]")
                .says(&["project.toml:29:8:", "did you mean \"point\"?"]),
            Case::new("a kind of light to come")
                .replace("[simulation]", "[[lights]]\nkind = \"sky\"\n[simulation]")
                .says(&["project.toml:29:8:", "not built yet"]),
            Case::new("an area light of unknown material")
                .replace(
                    "[simulation]",
                    "[[lights]]\nkind = \"area\"\nmaterial = \"wod\"\nflux_lm = 1\n[simulation]",
                )
                .says(&["project.toml:30:12:", "did you mean \"wood\"?"]),
            Case::new("luminance and flux")
                .replace(
                    "[simulation]",
                    "[[lights]]\nkind = \"area\"\nmaterial = \"wood\"\nflux_lm = 1\n\
                     luminance_cd_m2 = 1\n[simulation]",
                )
                .says(&["project.toml:3", "exclude each other"]),
            Case::new("unknown material").replace("[materials.wood]", "[materials.woood]").says(&[
                "project.toml:4:12:",
                "woood",
                "did you mean \"wood\"?",
            ]),
            Case::new("reflectance over 1")
                .replace("reflectance = 0.3", "reflectance = 1.5")
                .says(&["project.toml:5:15:", "1.5", "0 to 1"]),
            Case::new("a channel over 1")
                .replace("reflectance = 0.3", "reflectance = [0.3, 0.3, 2]")
                .says(&["project.toml:5:", "0 to 1"]),
            Case::new("a kind of material to come")
                .replace("reflectance = 0.3", "reflectance = 0.3\nkind = \"glossy\"")
                .says(&["project.toml:6:8:", "not built yet"]),
        ],
    );
}

#[test]
fn sensors() {
    const PLANE: &str = "[[sensors]]\nname = \"plane\"\nkind = \"grid\"\norigin = [0, 0, 0.5]\nu = \
         [2, 0, 0]\nv = [0, 2, 0]\ncounts = [2, 2]\n";
    const PROBES: &str = "[[sensors]]\nname = \"probes\"\nkind = \"points\"\npoints = [[1, 0.5, \
         0.7]]\nnormals = [[0, 0, 1]]\n";
    check(
        "sensors",
        &[
            Case::new("no sensors")
                .replace(PLANE, "")
                .replace(PROBES, "")
                .says(&["project.toml:1:1", "no sensors and no cameras"]),
            Case::new("a sensor inside a wall")
                .replace("[[1, 0.5, 0.7]]", "[[1.8, 1.8, 0.5]]")
                .says(&["project.toml:25:", "\"probes\"", "\"wood\""]),
            Case::new("a grid inside a wall")
                .replace("origin = [0, 0, 0.5]", "origin = [1.75, 1.75, 0.5]")
                .replace("u = [2, 0, 0]", "u = [0.1, 0, 0]")
                .replace("v = [0, 2, 0]", "v = [0, 0.1, 0]")
                .says(&["project.toml:14:", "\"plane\""]),
            Case::new("a grid without area")
                .replace("v = [0, 2, 0]", "v = [3, 0, 0]")
                .says(&["project.toml:19:5:", "no area"]),
            Case::new("a grid that is no rectangle")
                .replace("v = [0, 2, 0]", "v = [1, 2, 0]")
                .says(&["project.toml:19:5:", "square"]),
            Case::new("too many cells")
                .replace("counts = [2, 2]", "spacing = 1e-9")
                .says(&["project.toml:20:", "cells"]),
            Case::new("no cells")
                .replace("counts = [2, 2]", "counts = [0, 2]")
                .says(&["project.toml:20:", "at least 1"]),
            Case::new("two sensors of one name")
                .replace("name = \"probes\"", "name = \"Plane\"")
                .says(&["project.toml:23:8:", "line 14"]),
            Case::new("a name that leaves the folder")
                .replace("name = \"probes\"", "name = \"../probes\"")
                .says(&["project.toml:23:8:", "file name"]),
            Case::new("a normal too few")
                .replace("points = [[1, 0.5, 0.7]]", "points = [[1, 0.5, 0.7], [1, 1, 1]]")
                .says(&["project.toml:26:", "2 points but 1 normals"]),
            Case::new("a normal without length")
                .replace("normals = [[0, 0, 1]]", "normals = [[0, 0, 0]]")
                .says(&["project.toml:26:", "length"]),
        ],
    );
}

#[test]
fn simulation() {
    check(
        "simulation",
        &[
            Case::new("unknown estimator")
                .replace("estimator = \"path\"", "estimator = \"paths\"")
                .says(&["project.toml:29:13:", "paths", "did you mean \"path\"?"]),
            Case::new("unknown sequence")
                .replace("sequence = \"sobol\"", "sequence = \"sobel\"")
                .says(&["project.toml:30:12:", "did you mean \"sobol\"?"]),
            Case::new("unknown randomization")
                .replace("randomization = \"owen\"", "randomization = \"oven\"")
                .says(&["project.toml:31:17:", "did you mean \"owen\"?"]),
            Case::new("a tolerance of zero")
                .replace("rel_tol = 0.5", "rel_tol = 0")
                .says(&["project.toml:32:11:", "above 0"]),
            Case::new("a confidence in percent")
                .replace("rel_tol = 0.5", "confidence = 95")
                .says(&["project.toml:32:14:", "between 0 and 1"]),
            Case::new("no replicates")
                .replace("rel_tol = 0.5", "replicates = 0")
                .says(&["project.toml:32:14:", "from 1"]),
            Case::new("a negative seed")
                .replace("rel_tol = 0.5", "seed = -1")
                .says(&["project.toml:32:8:", "from 0"]),
            Case::new("half a bounce")
                .replace("rel_tol = 0.5", "max_bounces = 0.5")
                .says(&["project.toml:32:15:", "unlimited"]),
            Case::new("an old name of importance")
                .replace("rel_tol = 0.5", "steering = \"on\"")
                .says(&["project.toml:32:1:", "\"steering\"", "\"importance\" now"]),
            Case::new("a key that is gone")
                .replace("rel_tol = 0.5", "connections = \"on\"")
                .says(&["project.toml:32:1:", "\"connections\" in", "is gone", "\"auto\""]),
            Case::new("its old name").replace("rel_tol = 0.5", "joining = \"on\"").says(&[
                "project.toml:32:1:",
                "\"joining\" in",
                "is gone",
                "\"auto\"",
            ]),
            Case::new("an estimator that is gone")
                .replace("estimator = \"path\"", "estimator = \"selected\"")
                .says(&["project.toml:29:13:", "\"selected\" is gone", "\"auto\""]),
        ],
    );
}
