//! Radiance scenes in which light or surfaces were lost, or came out wrong, without a word.

use crate::radiance::{FLOOR, bsdf, loaded, refusal, try_load};
use crate::radiance_import::{import, load_imported};
use crate::support::{MapFiles, PROJECT, load_text, warnings_of};
use glam::DVec3;
use quasilux_scene::{Light, Loaded};
use quasilux_sky::{Irradiance, Perez, SkyPoint};

fn imported(scene: &str, others: &[(&str, &str)]) -> Loaded {
    let files = MapFiles::default().with("room.rad", scene).with("grid.pts", ".5 .5 .8 0 0 1\n");
    let files = others.iter().fold(files, |files, (name, text)| files.with(name, text));
    load_imported(&import(&files).unwrap(), &files).unwrap()
}

fn told(loaded: &Loaded, expected: &str) {
    let told = warnings_of(loaded);
    assert!(told.iter().any(|it| it.contains(expected)), "{expected}: {told:?}");
}

/// As `ies2rad` writes a file whose planes go from 90 to 270 degrees; values by hand.
#[test]
fn planes_from_90_to_270_degrees() {
    let scene = format!(
        "{FLOOR}void brightdata d 7 flatcorr lamp.dat source.cal src_phi2+90 src_theta -rz -90\n\
         0 1 12.5\nd light l 0 0 3 2 2 2\n\
         l polygon p 0 0 12 -.2 -.1 0 -.2 .1 0 .2 .1 0 .2 -.1 0\n"
    );
    let loaded = imported(&scene, &[("lamp.dat", "2\n90 270 3\n0 90 2\n4 1\n4 2\n4 3\n")]);
    let [Light::Luminaire(lamp)] = loaded.scene.lights.as_slice() else { panic!("one lamp") };
    let unit = 179.0 * 2.0 * 12.5 * 0.08;
    let sixty = 3.0_f64.sqrt();
    for (x, y, at_horizon) in [(0.0, -1.0, 1.0), (1.0, 0.0, 2.0), (-1.0, 0.0, 2.0), (0.0, 1.0, 3.0)]
    {
        let found = lamp.intensity_cd(DVec3::new(x * sixty, y * sixty, -1.0).normalize());
        let expected = unit * (4.0 + (at_horizon - 4.0) * 60.0 / 90.0);
        assert!((found / expected - 1.0).abs() < 1e-5, "{x} {y}: {found} is not {expected}");
    }
}

/// Four strips around a cove are four luminaires.
#[test]
fn strips_that_touch_shine_for_themselves() {
    let strip = |name: &str, [x0, y0, x1, y1]: [f64; 4]| {
        format!("l polygon {name} 0 0 12 {x0} {y0} 3 {x0} {y1} 3 {x1} {y1} 3 {x1} {y0} 3\n")
    };
    let scene = format!(
        "{FLOOR}void brightdata d 4 flatcorr lamp.dat source.cal src_theta 0 1 1\n\
         d light l 0 0 3 2 2 2\n{}{}{}{}",
        strip("a", [0.0, 0.0, 8.0, 0.1]),
        strip("b", [7.9, 0.0, 8.0, 6.0]),
        strip("c", [0.0, 5.9, 8.0, 6.0]),
        strip("d", [0.0, 0.0, 0.1, 6.0]),
    );
    let loaded = imported(&scene, &[("lamp.dat", "1\n0 90 2\n1 0\n")]);
    let positions: Vec<DVec3> = loaded
        .scene
        .lights
        .iter()
        .map(|light| match light {
            Light::Luminaire(lamp) => lamp.position,
            other => panic!("{other:?}"),
        })
        .collect();
    let expected = [[4.0, 0.05], [7.95, 3.0], [4.0, 5.95], [0.05, 3.0]];
    assert_eq!(positions.len(), 4);
    for (found, [x, y]) in positions.iter().zip(expected) {
        assert!((*found - DVec3::new(x, y, 3.0)).length() < 1e-9, "{found}");
    }
}

/// A comment that ends with a backslash is over with its line, and files may begin with a mark.
#[test]
fn texts_of_other_systems() {
    let scene = format!(
        "\u{feff}# made in C:\\\n{FLOOR}# to D:\\\ngrey polygon p 0 0 9 0 0 1 1 0 1 0 1 1\n\
         !xform 12:30.rad # the north\n"
    );
    let part = ("12:30.rad", "grey polygon n\u{a0}1 0 0 9 0 0 2 1 0 2 0 1 2\n");
    let loaded = try_load(&scene, &[part]).unwrap();
    let names: Vec<&str> = loaded.scene.mesh.objects.iter().map(|it| &**it).collect();
    assert_eq!(names, ["floor", "p", "n\u{a0}1"]);
    let error = refusal(&format!("{FLOOR}grey polygon p 0 1 7 9 0 0 1 1 0 1 0 1 1\n"));
    assert!(error.contains("integer arguments"), "{error}");
}

/// A name in two folders is two tables: the second one is read, which is none here.
#[test]
fn sheets_of_one_name_are_two() {
    let Some(folder) = quasilux_corpus::find("bsdf") else { return };
    let table = std::fs::read(folder.join("klems-frads-ec60.xml")).unwrap();
    let part = |z: u8| {
        format!("void BSDF s 6 0 t.xml 0 1 0 . 0 0\ns polygon p{z} 0 0 9 0 0 {z} 1 0 {z} 0 1 {z}\n")
    };
    let files = MapFiles::default()
        .with("room.rad", format!("{FLOOR}!xform a/a.rad\n!xform b/b.rad\n"))
        .with("a/a.rad", part(1))
        .with("b/b.rad", part(2))
        .with("a/t.xml", &table)
        .with("b/t.xml", "<WindowElement>");
    let project = PROJECT.replace("room.obj", "room.rad");
    let error = load_text(&project, &files).unwrap_err().to_string();
    assert!(error.contains("b/t.xml"), "{error}");
    let loaded = load_text(&project, &files.with("b/t.xml", &table)).unwrap();
    assert_eq!(loaded.scene.materials.len(), 3);
}

#[test]
fn an_illum_takes_the_alternate_before_it() {
    let scene = "void plastic a 0 0 5 .1 .1 .1 0 0\nvoid illum i 1 a 0 3 1 1 1\n\
        i polygon p 0 0 9 0 0 1 1 0 1 0 1 1\nvoid plastic a 0 0 5 .2 .2 .2 0 0\n\
        a polygon q 0 0 9 0 0 2 1 0 2 0 1 2\n";
    let loaded = loaded(scene);
    let reflectance = |name: &str| bsdf(&loaded, name).reflectance().unwrap().0[0];
    assert_eq!([reflectance("a"), reflectance("a 2")], [0.1, 0.2]);
    let bare = format!("{FLOOR}void illum i 0 0 3 1 1 1\ni polygon p 0 0 9 0 0 1 1 0 1 0 1 1\n");
    let error = refusal(&bare);
    assert!(error.contains("room.rad:3:1: illum \"i\" shines and lets all light"), "{error}");
}

/// Names of materials are their own, and the project reaches those that are defined again.
#[test]
fn materials_of_one_name_stay_apart() {
    let plastic = |name: &str, share: f64, z: u8| {
        format!(
            "void plastic '{name}' 0 0 5 {share} {share} {share} 0 0\n\
             '{name}' polygon p{z} 0 0 9 0 0 {z} 1 0 {z} 0 1 {z}\n"
        )
    };
    let scene = [plastic("a", 0.1, 1), plastic("a", 0.2, 2), plastic("a 2", 0.3, 3)].concat();
    let files = MapFiles::default().with("room.rad", &scene);
    let project = PROJECT.replace("room.obj", "room.rad");
    let found = |more: &str| -> Vec<(String, f64)> {
        let loaded = load_text(&format!("{project}{more}"), &files).unwrap();
        let materials = loaded.scene.materials.iter();
        materials.map(|it| (it.name.clone(), it.bsdf.reflectance().unwrap().0[0])).collect()
    };
    let of = |name: &str, share: f64| (name.to_owned(), share);
    assert_eq!(found(""), [of("a", 0.1), of("a 3", 0.2), of("a 2", 0.3)]);
    let both = found("[materials.a]\nreflectance = 0.7\n");
    assert_eq!(both, [of("a", 0.7), of("a 2", 0.3)]);
    let one = found("[materials.\"a 3\"]\nreflectance = 0.7\n");
    assert_eq!(one, [of("a", 0.1), of("a 3", 0.7), of("a 2", 0.3)]);
}

/// A project may describe what is a luminaire by the scene.
#[test]
fn luminaires_may_become_surfaces() {
    let scene = format!(
        "{FLOOR}void brightdata d 4 flatcorr lamp.dat source.cal src_theta 0 1 1\n\
         d light l 0 0 3 2 2 2\nl polygon p 0 0 9 0 0 2 1 0 2 0 1 2\n"
    );
    let files = MapFiles::default().with("room.rad", scene).with("lamp.dat", "1\n0 90 2\n1 0\n");
    let project = PROJECT.replace("room.obj", "room.rad") + "[materials.l]\nreflectance = 0.6\n";
    let loaded = load_text(&project, &files).unwrap();
    assert_eq!(bsdf(&loaded, "l").reflectance().unwrap().0[0], 0.6);
    assert_eq!(loaded.scene.mesh.objects.len(), 2);
}

#[test]
fn what_is_left_out_is_told() {
    let scene = format!(
        "{FLOOR}void brightfunc b 2 x y.cal 0 0\nb glow g 0 0 4 1 1 1 -1\n\
         g polygon p 0 0 9 0 0 1 1 0 1 0 1 1\nvoid trans t 0 0 7 1 1 1 0 0 1 1\n\
         t polygon q 0 0 9 0 0 2 1 0 2 0 1 2\n"
    );
    let loaded = loaded(&scene);
    assert_eq!(bsdf(&loaded, "g").reflectance().unwrap().0, [0.0; 3]);
    told(&loaded, "trans \"t\": all light goes straight through it");
    told(&loaded, "a glow that lights nothing is black here");
    let files =
        MapFiles::default().with("room.rad", format!("{FLOOR}far source s 0 0 4 0 0 1 .5\n"));
    let project = PROJECT.replace("room.obj", "room.rad");
    let error = load_text(&project, &files).unwrap_err().to_string();
    assert!(error.contains("no modifier is called \"far\""), "{error}");
    let files = files.with(
        "room.rad",
        format!("{FLOOR}far source s 0 0 4 0 0 1 .5\nfar polygon p 0 0 9 0 0 1 1 0 1 0 1 1\n"),
    );
    let loaded = load_text(&(project + "[materials.far]\nreflectance = 0\n"), &files).unwrap();
    told(&loaded, "source \"s\": a source whose material the scene does not define");
}

/// The sun of `gendaylit` shines without its sky, and other sources may have its light.
#[test]
fn the_sun_of_gendaylit_is_a_source() {
    let command = "!gendaylit -ang 45 30 -W 500 100\n";
    let sky = "skyfunc glow s 0 0 4 1 1 1 0\ns source sky 0 0 4 0 0 1 180\n";
    let irradiance = Irradiance { direct_normal_w_m2: 500.0, diffuse_horizontal_w_m2: 100.0 };
    let point = SkyPoint { altitude_deg: 45.0, azimuth_deg: 210.0 };
    let expected = Perez::new(irradiance, point, 94, Perez::DEW_POINT_C).unwrap();
    for sky in ["", sky] {
        let scene = imported(&format!("{FLOOR}{command}{sky}"), &[]).scene;
        let sun = scene.environment.unwrap().sun.unwrap();
        let ratio = sun.normal_illuminance_lx / expected.normal_illuminance_lx();
        assert!((ratio - 1.0).abs() < 1e-6, "{sky}: {ratio}");
        assert!((sun.centre.azimuth_deg - 210.0).abs() < 1e-6);
    }
    let lamp = "solar polygon p 0 0 9 0 0 3 0 1 3 1 0 3\n";
    let loaded = imported(&format!("{FLOOR}{command}{lamp}"), &[]);
    assert_eq!(loaded.scene.lights.len(), 1);
    let high = imported(&format!("{FLOOR}!gensky -ang 88 0 +s -y 2020\n{sky}"), &[]);
    told(&high, "the sun is above 87 degrees");
    told(&high, "the year (-y) is left out");
}
