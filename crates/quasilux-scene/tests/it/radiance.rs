//! Radiance scenes of our own: what geometry and materials come of them, and what is refused where.

use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::bsdf::{Dielectric, Pane};
use quasilux_scene::{Bsdf, Loaded};
use std::f64::consts::PI;

/// A grey material, and a floor of 1 m x 1 m.
pub(crate) const FLOOR: &str = "void plastic grey 0 0 5 .5 .5 .5 0 0\n\
    grey polygon floor 0 0 12 0 0 0 1 0 0 1 1 0 0 1 0\n";

pub(crate) fn try_load(scene: &str, others: &[(&str, &str)]) -> Result<Loaded, String> {
    let files = MapFiles::default().with("room.rad", scene);
    let files = others.iter().fold(files, |files, (name, text)| files.with(name, text));
    let project = PROJECT.replace("room.obj", "room.rad").replace("[0, 0, 0.8]", "[0, 0, 1e6]");
    load_text(&project, &files).map_err(|error| error.to_string())
}

pub(crate) fn loaded(scene: &str) -> Loaded {
    try_load(scene, &[]).unwrap()
}

pub(crate) fn refusal(scene: &str) -> String {
    try_load(scene, &[]).err().unwrap_or_else(|| panic!("{scene} is read"))
}

/// Area and mean normal, of length 1 where it is flat, of the objects of a name.
pub(crate) fn measured(loaded: &Loaded, name: &str) -> (f64, DVec3) {
    let mesh = &loaded.scene.mesh;
    let mut sum = DVec3::ZERO;
    let mut area = 0.0;
    for triangle in 0..mesh.triangles.len() {
        if &*mesh.objects[mesh.object_of[triangle] as usize] == name {
            area += mesh.area_m2(triangle as u32);
            sum += mesh.front_normal(triangle as u32).normalize() * mesh.area_m2(triangle as u32);
        }
    }
    (area, sum / area)
}

pub(crate) fn bsdf<'l>(loaded: &'l Loaded, name: &str) -> &'l Bsdf {
    &loaded.scene.materials.iter().find(|it| it.name == name).expect(name).bsdf
}

pub(crate) fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} is not {expected}");
}

#[test]
fn primitives_have_their_areas_and_normals() {
    let scene = loaded(
        "void plastic grey 0 0 5 .5 .4 .3 0 0 # comment\n\
        grey polygon seamed 0 0 30 0 0 0 4 0 0 4 3 0 0 3 0 0 0 0 \
        1 1 0 1 2 0 2 2 0 2 1 0 1 1 0\n\
        grey sphere ball 0 0 4 9 0 0 1\n grey bubble hollow 0 0 4 12 0 0 1\n\
        grey ring disc 0 0 8 0 9 0 0 0 -2 0.5 1\n\
        grey cylinder pillar 0 0 7 0 20 0 0 20 2 .5\n\
        grey tube pipe 0 0 7 0 30 0 0 30 2 .5\n\
        grey cone 'a cone' 0 0 8 0 40 0 0 40 1 1 0\n grey cup cup 0 0 8 0 50 0 0 50 1 1 0\n",
    );
    let (area, normal) = measured(&scene, "seamed");
    near(area, 11.0);
    assert!((normal - DVec3::Z).length() < 1e-12);
    let (area, normal) = measured(&scene, "disc");
    assert!((area / (0.75 * PI) - 1.0).abs() < 3e-3 && (normal + DVec3::Z).length() < 1e-12);
    let curved = [("ball", 4.0 * PI), ("pillar", 2.0 * PI), ("a cone", PI * 2.0_f64.sqrt())];
    for (name, exact) in curved {
        assert!((measured(&scene, name).0 / exact - 1.0).abs() < 7e-3, "{name}");
    }
    // By the volume that outward normals enclose.
    let mesh = &scene.scene.mesh;
    let flux = |name: &str, centre: DVec3| -> f64 {
        let of = |&t: &usize| &*mesh.objects[mesh.object_of[t] as usize] == name;
        let all = (0..mesh.triangles.len()).filter(of).map(|t| t as u32);
        all.map(|t| {
            let outward = mesh.corners(t)[0] - centre;
            outward.dot(mesh.front_normal(t).normalize()) * mesh.area_m2(t)
        })
        .sum()
    };
    assert!(flux("ball", DVec3::X * 9.0) > 0.0 && flux("hollow", DVec3::X * 12.0) < 0.0);
    let axis = |y: f64| DVec3::new(0.0, y, 0.2);
    assert!(flux("pillar", axis(20.0)) > 0.0 && flux("pipe", axis(30.0)) < 0.0);
    assert!(flux("a cone", axis(40.0)) > 0.0 && flux("cup", axis(50.0)) < 0.0);
    let Bsdf::Diffuse(diffuse) = bsdf(&scene, "grey") else { panic!("diffuse") };
    assert_eq!(diffuse.reflectance.0, [0.5, 0.4, 0.3]);
}

/// Corners as `xform` of Radiance 6.1 prints them.
#[test]
fn xform_moves_mirrors_and_turns_inside_out() {
    let part =
        ("part.rad", "grey polygon p 0 0 9 0 0 0 1 0 0 0 1 0\ngrey sphere s 0 0 4 0 0 0 1\n");
    let scene = format!(
        "{FLOOR}!xform -n a -mx -s 2 -t 1 2 3 part.rad\n!xform -n b -I -t 1 2 3 -rz 90 part.rad\n\
        !xform -n c -a 2 -t 5 0 0 -a 2 -t 0 5 0 part.rad\n"
    );
    let scene = try_load(&scene, &[part]).unwrap();
    let (area, normal) = measured(&scene, "a.p");
    near(area, 2.0);
    assert!((normal - DVec3::Z).length() < 1e-12);
    let (area, normal) = measured(&scene, "b.p");
    near(area, 0.5);
    assert!((normal + DVec3::Z).length() < 1e-12);
    let mesh = &scene.scene.mesh;
    let has = |x: f64, y: f64, z: f64| {
        mesh.positions.iter().any(|it| (*it - DVec3::new(x, y, z)).length() < 1e-12)
    };
    assert!(has(1.0, 4.0, 3.0) && has(-1.0, 2.0, 3.0) && has(-3.0, 1.0, 3.0));
    for name in ["c.0.0.p", "c.0.1.p", "c.1.0.p", "c.1.1.p"] {
        near(measured(&scene, name).0, 0.5);
    }
    assert!(has(6.0, 5.0, 0.0) && has(5.0, 6.0, 0.0));
    assert!((measured(&scene, "a.s").0 / (16.0 * PI) - 1.0).abs() < 7e-3);
}

#[test]
fn generators_make_boxes_and_blinds() {
    let scene = format!(
        "{FLOOR}!genbox grey box 1 2 3 | xform -t 5 0 0\n!genbox grey room 1 2 3 -i\n\
        !genblinds grey slats .1 2 1 4 30\n"
    );
    let scene = loaded(&scene);
    for (name, normal) in
        [("1540", -DVec3::Y), ("2310", -DVec3::Z), ("5137", DVec3::X), ("6457", DVec3::Z)]
    {
        assert!((measured(&scene, &format!("box.{name}")).1 - normal).length() < 1e-12);
        assert!((measured(&scene, &format!("room.{name}")).1 + normal).length() < 1e-12);
    }
    near(measured(&scene, "box.5137").0, 6.0);
    near(measured(&scene, "slats.4.0").0, 0.2);
}

#[test]
fn the_last_definition_before_use_counts() {
    let scene = loaded(
        "void plastic a 0 0 5 .1 .1 .1 0 0\nvoid alias b a\n\
        a polygon p1 0 0 9 0 0 0 1 0 0 0 1 0\n\
        void plastic a 0 0 5 .2 .2 .2 0 0\n\
        a polygon p2 0 0 9 0 0 1 1 0 1 0 1 1\nb polygon p3 0 0 9 0 0 2 1 0 2 0 1 2\n\
        void colorpict pat 7 red green blue a.hdr picture.cal pic_u pic_v 0 0\n\
        pat alias c a\npat alias d c\ninherit alias e d\nd polygon p4 0 0 9 0 0 3 1 0 3 0 1 3\n\
        c polygon p5 0 0 9 0 0 4 1 0 4 0 1 4\ne polygon p6 0 0 9 0 0 5 1 0 5 0 1 5\n\
        late polygon p7 0 0 9 0 0 6 1 0 6 0 1 6\nvoid plastic late 0 0 5 .7 .7 .7 0 0\n\
        void polygon nothing 0 0 9 0 0 7 1 0 7 0 1 7\n",
    );
    let reflectance = |name: &str| bsdf(&scene, name).reflectance().unwrap().0[0];
    assert_eq!(
        ["a", "a 2", "b", "c", "e", "late"].map(reflectance),
        [0.1, 0.2, 0.1, 0.2, 0.2, 0.7]
    );
    assert!(scene.scene.mesh.objects.iter().all(|name| &**name != "nothing"));
    let told = warnings_of(&scene).join("\n");
    assert!(told.contains("the pattern that it is modified by is left out (3 places"), "{told}");
    assert!(told.contains("modifier \"late\": it is used before it is defined"), "{told}");
    assert!(told.contains("surface \"nothing\": a surface without a material"), "{told}");
}

#[test]
fn materials_become_what_there_is() {
    let mut scene = FLOOR.to_owned();
    let materials = [
        "glass glazing 0 0 3 .96 .96 .96",
        "dielectric water 0 0 5 1 1 1 1.33 0",
        "interface edge 0 0 8 1 1 1 1.5 1 1 1 1.25",
        "mirror shiny 0 0 3 .9 .9 .9",
        "trans paper 0 0 7 .8 .8 .8 0 0 .5 0",
        "metal steel 0 0 5 .6 .6 .6 .9 .1",
        "plastic2 brushed 4 1 0 0 . 0 6 .5 .5 .5 .04 .1 .4",
        "mist fog 0 0 0",
    ];
    for (z, material) in materials.iter().enumerate() {
        let name = material.split(' ').nth(1).unwrap();
        scene +=
            &format!("void {material}\n{name} polygon p{z} 0 0 9 0 0 {z}.5 1 0 {z}.5 0 1 {z}.5\n");
    }
    let scene = loaded(&scene);
    let Bsdf::Pane(Pane::Measured { transmittance, .. }) = bsdf(&scene, "glazing") else {
        panic!("a pane")
    };
    assert!((transmittance.at_angle(0.0) - 0.8815).abs() < 1e-4);
    let eta = |name| match bsdf(&scene, name) {
        Bsdf::Dielectric(Dielectric { eta }) => *eta,
        other => panic!("{other:?}"),
    };
    assert_eq!((eta("water"), eta("edge")), (1.33, 1.2));
    assert!(matches!(bsdf(&scene, "shiny"), Bsdf::Mirror(_)));
    assert!(matches!(bsdf(&scene, "paper"), Bsdf::Translucent(_)));
    assert!(matches!(bsdf(&scene, "steel"), Bsdf::Conductor(_)));
    let Bsdf::Plastic(plastic) = bsdf(&scene, "brushed") else { panic!("plastic") };
    assert!((plastic.alpha - 0.2).abs() < 1e-12);
    assert!(warnings_of(&scene).iter().any(|it| it.contains("mist \"fog\": mist is left out")));
}

/// Refused by place and name, or given by the project.
#[test]
fn what_is_not_understood_is_refused() {
    let polygon = "m polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n";
    let with = |line: &str| refusal(&format!("{FLOOR}{line}\n"));
    let cases = [
        ("void plastic m 0 0 5 .5 .5", "the file ends; expected a real argument"),
        ("void plastic m 0 0 five", "room.rad:3:20: found five in a primitive of the type plastic"),
        ("void plastic m 0 0 99999999999 1", "the file ends"),
        ("grey polygon p 0 0 8 0 0 0 1 0 0 0 1", "has 8 real arguments"),
        ("grey polygon p 0 0 9 0 0 0 1 0 0 0 nan 0", "room.rad:3:36: found nan"),
        ("grey polygone p 0 0 0", "room.rad:3:1: polygone is no type of primitives"),
        ("gray polygon p 0 0 9 0 0 0 1 0 0 0 1 0", "did you mean \"grey\""),
        ("grey mesh m 1 a.rtm 0 0", "room.rad:3:1: mesh \"m\" has a compiled mesh"),
        ("grey instance i 1 a.oct 0 0", "has an octree, which is not read"),
        ("!rm -rf x", "room.rad:3:1: the command \"rm\" is not run"),
        ("!genbox grey b 1 1 1 -r .1", "the option -r of genbox is not read"),
        ("!xform -a 1000 -a 1000 -a 1000 a.rad", "more than 1000000 copies"),
        ("!xform -a 1000000 room.rad", "take more than 20000000 steps"),
        ("!xform a.rad", "room.rad:3:1: cannot read \"a.rad\": no such file"),
        ("!xform ../../etc/passwd", "is outside of the folders of the scene"),
        ("!xform /etc/passwd", "is outside of the folders of the scene"),
        ("void alias a nothing", "no modifier is called \"nothing\""),
    ];
    for (line, expected) in cases {
        let error = with(line);
        assert!(error.contains(expected), "{line}: {error}");
    }
    for kind in ["prism1", "BRTDfunc", "antimatter", "mixfunc", "plasdata"] {
        let scene = format!("{FLOOR}void {kind} m 0 0 0\n{polygon}");
        let error = refusal(&scene);
        assert!(error.contains(&format!("is of the type {kind}")), "{error}");
        let files = MapFiles::default().with("room.rad", &scene);
        let project =
            PROJECT.replace("room.obj", "room.rad") + "[materials.m]\nreflectance = 0.3\n";
        assert!(load_text(&project, &files).is_ok());
    }
    let error = refusal(&format!("void plastic m 0 0 5 1.5 0 0 0 0\n{polygon}"));
    assert!(error.contains("a reflectance of 1.5"), "{error}");
}

/// A file that names itself ends, and so do many copies of nothing.
#[test]
fn loops_end() {
    let error = refusal(&format!("{FLOOR}!xform room.rad\n"));
    assert!(error.contains("more than 32 files name each other"), "{error}");
    let nest = [
        ("a.rad", "!xform -a 1000 b.rad\n"),
        ("b.rad", "!xform -a 1000 c.rad\n"),
        ("c.rad", "!xform -a 1000 d.rad\n"),
        ("d.rad", "# nothing\n"),
    ];
    let error = try_load(&format!("{FLOOR}!xform a.rad\n"), &nest).err().unwrap();
    assert!(error.contains("more than 2000000 primitives"), "{error}");
}

/// A project describes a modifier that its file does not define, and files share theirs.
#[test]
fn projects_complete_a_scene() {
    let files = MapFiles::default().with("a.mat", "void plastic other 0 0 5 .3 .3 .3 0 0\n").with(
        "room.rad",
        "oak polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n\
            other polygon q 0 0 9 0 0 1 1 0 1 0 1 1\n",
    );
    let project = PROJECT.replace("[\"room.obj\"]", "[\"a.mat\", \"room.rad\"]\nunits = \"mm\"");
    let error = load_text(&project, &files).unwrap_err().to_string();
    assert!(error.contains("room.rad:1:1: no modifier is called \"oak\""), "{error}");
    let loaded = load_text(&(project + "[materials.oak]\nreflectance = 0.2\n"), &files).unwrap();
    near(measured(&loaded, "p").0, 0.5e-6);
    assert_eq!(bsdf(&loaded, "oak").reflectance().unwrap().0, [0.2; 3]);
    assert_eq!(bsdf(&loaded, "other").reflectance().unwrap().0, [0.3; 3]);
}
