//! Projects of Radiance scenes of our own: lights, luminaires, skies, points and views.

use crate::radiance::FLOOR;
use crate::support::MapFiles;
use glam::DVec3;
use quasilux_scene::{
    FileKind, Files, Imported, Light, Loaded, RadianceTerms, import_radiance, load,
};
use quasilux_sky::SkyPoint;
use std::f64::consts::PI;

pub(crate) fn import(files: &MapFiles) -> Result<Imported, String> {
    let has = |name: &str| files.read(name, FileKind::Radiance).is_ok();
    let given = |name: &str| if has(name) { vec![name.to_owned()] } else { Vec::new() };
    let terms = RadianceTerms {
        model: "room.rad",
        scene: &["room.rad".to_owned()],
        points: &given("grid.pts"),
        views: &given("a.vf"),
        weather: None,
        stem: "room",
    };
    import_radiance(files, &terms).map_err(|error| error.to_string())
}

fn files(scene: &str) -> MapFiles {
    MapFiles::default().with("room.rad", scene).with("grid.pts", "0.5 0.5 0.8 0 0 1\n")
}

pub(crate) fn load_imported(imported: &Imported, files: &MapFiles) -> Result<Loaded, String> {
    let with = |files: MapFiles, (name, bytes): (&String, &Vec<u8>)| files.with(name, bytes);
    let named = imported.files.iter().map(|file| (&file.name, &file.bytes));
    let files = named.fold(files.clone(), with);
    load("room.toml", imported.text.as_bytes(), &files)
        .map_err(|error| format!("{error}\n{}", imported.text))
}

fn loaded(files: &MapFiles) -> Loaded {
    load_imported(&import(files).unwrap(), files).unwrap()
}

/// As `ies2rad` writes it: a plane of data over quarter turns, and a rectangle of 0.4 m x 0.2 m.
const LAMP: &str = "void brightdata d 5 flatcorr lamp.dat source.cal src_phi4 src_theta 0 1 12.5\n\
    d light l 0 0 3 2 2 2\n\
    l polygon p 0 0 12 -.2 -.1 0 -.2 .1 0 .2 .1 0 .2 -.1 0\n";
const LAMP_DAT: &str = "2\n0 90 2\n0 90 4\n4 3 2 0\n4 1 1 0\n";

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-6 * expected.abs(), "{found} is not {expected}");
}

/// I = 179 lm/W x 2 x value x 12.5 / m2 x 0.08 m2, turned and moved as `xform` says.
#[test]
fn distributions_become_luminaires() {
    let scene = format!(
        "{FLOOR}!xform -rz 90 -t 1 2 3 lamp.rad\n!xform -rx 90 -t 0 0 2 lamp.rad\n\
        !xform -mx -rz 30 lamp.rad\n"
    );
    let files = files(&scene).with("lamp.rad", LAMP).with("lamp.dat", LAMP_DAT);
    let loaded = loaded(&files);
    let lamps: Vec<_> = loaded
        .scene
        .lights
        .iter()
        .map(|light| match light {
            Light::Luminaire(lamp) => lamp,
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(lamps.len(), 3);
    let unit = 179.0 * 2.0 * 12.5 * 0.08;
    let toward = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).normalize();
    let sixty = 3.0_f64.sqrt();
    // C 0 points to +y, C 90 to -x.
    near(lamps[0].intensity_cd(DVec3::NEG_Z), 4.0 * unit);
    near(lamps[0].intensity_cd(toward(0.0, sixty, -1.0)), 2.0 * unit);
    near(lamps[0].intensity_cd(toward(0.0, -sixty, -1.0)), 2.0 * unit);
    near(lamps[0].intensity_cd(toward(-sixty, 0.0, -1.0)), unit);
    assert_eq!(lamps[0].intensity_cd(toward(1.0, 0.0, 1.0)), 0.0);
    assert!((lamps[0].position - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-9);
    assert!(lamps[0].is_area());
    // About +x by 90 degrees down becomes +y.
    near(lamps[1].intensity_cd(DVec3::Y), 4.0 * unit);
    near(lamps[1].intensity_cd(toward(sixty, 1.0, 0.0)), 2.0 * unit);
    let (sin, cos) = libm::sincos(PI / 6.0);
    near(lamps[2].intensity_cd(toward(-sixty * cos, -sixty * sin, -1.0)), 2.0 * unit);
    // The surfaces that shine are no surfaces.
    assert_eq!(loaded.scene.mesh.objects.len(), 1);
}

/// Closed forms: a box and a cylinder with their corrections have the intensities of their data.
#[test]
fn boxes_cylinders_and_balls_shine_as_their_data_say() {
    let data = "1\n0 180 3\n5 5 5\n";
    let shapes = [
        "void brightdata d 4 boxcorr lamp.dat source.cal src_theta 0 4 3 .4 .2 .1\n\
            d light l 0 0 3 1 1 1\n!genbox l b .4 .2 .1\n",
        "void brightdata d 4 cylcorr lamp.dat source.cal src_theta 0 3 3 .4 .2\n\
            d light l 0 0 3 1 1 1\nl cylinder c 0 0 7 0 0 0 0 0 .2 .2\n\
            l ring r 0 0 8 0 0 0 0 0 -1 0 .2\nl ring s 0 0 8 0 0 .2 0 0 1 0 .2\n",
        "void brightdata d 4 corr lamp.dat source.cal src_theta 0 1 3\n\
            d light l 0 0 3 1 1 1\nl sphere b 0 0 4 0 0 1 0.5641895835477563\n",
    ];
    for shape in shapes {
        let loaded = loaded(&files(&format!("{FLOOR}{shape}")).with("lamp.dat", data));
        let [Light::Luminaire(lamp)] = loaded.scene.lights.as_slice() else { panic!("one lamp") };
        for direction in [DVec3::X, DVec3::NEG_Z, DVec3::new(1.0, 2.0, -3.0).normalize()] {
            let found = lamp.intensity_cd(direction);
            assert!((found / (179.0 * 15.0) - 1.0).abs() < 1e-5, "{shape}: {found}");
        }
    }
}

#[test]
fn lights_have_their_flux() {
    let scene = format!(
        "{FLOOR}void light a 0 0 3 10 10 10\na sphere s 0 0 4 0 0 2 .1\n\
        void glow b 0 0 4 1 2 3 0\nb polygon q 0 0 9 0 0 3 1 0 3 0 1 3\n\
        void spotlight c 0 0 7 100 100 100 60 0 0 -1\nc ring r 0 0 8 0 0 2 0 0 -1 0 .01\n\
        void illum d 1 glazing 0 3 5 5 5\nvoid glass glazing 0 0 3 .9 .9 .9\n\
        d polygon w 0 0 9 0 0 1 1 0 1 0 1 1\n"
    );
    let imported = import(&files(&scene)).unwrap();
    let loaded = load_imported(&imported, &files(&scene)).unwrap();
    let flux: Vec<f64> = loaded.scene.lights.iter().map(Light::flux_lm).collect();
    assert_eq!(flux.len(), 3);
    // In the cone pi L A sin2 of its half angle, up to 0.1 % of the table.
    let spot = 179.0 * 100.0 * PI * 1e-4 * PI * 0.25;
    assert!((flux[0] / spot - 1.0).abs() < 2e-3, "{} is not {spot}", flux[0]);
    near(flux[1], 1790.0 * 0.04 * PI * PI);
    near(flux[2], 179.0 * (0.265 + 2.0 * 0.67 + 3.0 * 0.065) * PI * 0.5);
    assert!(loaded.scene.materials.iter().any(|it| it.name == "glazing"));
    let told: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(
        told.iter().any(|it| it.contains("illum \"d\": an illum is its alternate")),
        "{told:?}"
    );
}

const HEMISPHERES: &str = "skyfunc glow s 0 0 4 1 1 1 0\ns source sky 0 0 4 0 0 1 180\n\
    skyfunc glow g 0 0 4 1 1 1 0\ng source ground 0 0 4 0 0 -1 180\n";

#[test]
fn skies_of_commands_and_files_are_the_same() {
    let literal = "void light solar 0 0 3 1e6 1e6 1e6\nsolar source sun 0 0 4 -.353553 -.612372 \
        .707107 .5\nvoid brightfunc skyfunc 2 skybr skybright.cal 0 7 1 10 5.787 .5707 -.353553 \
        -.612372 .707107\n";
    let command = "!gensky -ang 45 30 +s -r 1e6 -b 10\n";
    for sky in [literal, command] {
        let loaded = loaded(&files(&format!("{FLOOR}{sky}{HEMISPHERES}")));
        let environment = loaded.scene.environment.as_ref().unwrap();
        let sun = environment.sun.as_ref().unwrap();
        // The disk of half a degree has 5.98e-5 sr.
        near((sun.normal_illuminance_lx / (179e6 * 5.981_161e-5)).round(), 1.0);
        assert!((sun.normal_illuminance_lx - 179e6 * 5.981_161e-5).abs() < 1.0);
        let SkyPoint { altitude_deg, azimuth_deg } = sun.centre;
        assert!((altitude_deg - 45.0).abs() < 1e-3 && (azimuth_deg - 210.0).abs() < 1e-3);
        near(environment.sky.zenith_luminance_cd_m2(), 1790.0);
    }
    let turned = format!("{FLOOR}!gensky -ang 45 30 +s | xform -rz 90\n{HEMISPHERES}");
    let turned = loaded(&files(&turned)).scene.environment.unwrap().sun.unwrap();
    assert!((turned.centre.azimuth_deg - 120.0).abs() < 1e-9);
    let overcast = loaded(&files(&format!("{FLOOR}!gensky -ang 45 30 -c -B 100\n{HEMISPHERES}")));
    let environment = overcast.scene.environment.unwrap();
    near(environment.sky.horizontal_illuminance_lx(), 17900.0);
    let uniform = "void glow s 0 0 4 1 1 1 0\ns source sky 0 0 4 0 0 1 360\n";
    let uniform = loaded(&files(&format!("{FLOOR}{uniform}"))).scene.environment.unwrap();
    near(uniform.sky.horizontal_illuminance_lx(), 179.0 * PI);
    let perez = format!("{FLOOR}!gendaylit -ang 45 30 -W 500 100\n{HEMISPHERES}");
    assert!(loaded(&files(&perez)).scene.environment.unwrap().sun.is_some());
    let known =
        format!("{FLOOR}void brightfunc skyfunc 2 skybright perezlum.cal 0 0\n{HEMISPHERES}");
    let told = loaded(&files(&known)).warnings;
    assert!(told.iter().any(|it| it.message.contains("by its irradiances alone")), "{told:?}");
}

#[test]
fn points_and_views_are_sensors_and_cameras() {
    let view = "rvu -vtv -vp .1 .2 1 -vd 0 1 0 -vu 0 0 1 -vh 60 -vv 40\n-vtl -vp 0 0 1\n";
    let files = files(FLOOR).with("a.vf", view);
    let imported = import(&files).unwrap();
    assert!(imported.measures);
    let loaded = load_imported(&imported, &files).unwrap();
    assert_eq!(loaded.scene.sensors[0].name, "grid");
    assert_eq!(loaded.scene.cameras.len(), 1);
    assert!(imported.findings.iter().any(|it| it.message.contains("a.vf:2: only perspective")));
    let bare = import(&MapFiles::default().with("room.rad", FLOOR)).unwrap();
    assert!(!bare.measures && bare.findings[0].message.contains("no points and no view"));
    assert!(import(&files.with("grid.pts", "1 2 3\n")).unwrap_err().contains("grid.pts:1:1"));
}

/// Light that is not known is refused, and not left out.
#[test]
fn unknown_light_is_refused() {
    for (pattern, expected) in [
        ("brightfunc d 2 x y.cal 0 0", "shines by the pattern brightfunc \"d\""),
        ("brightdata d 4 warp lamp.dat source.cal src_theta 0 0", "the function warp"),
        ("brightdata d 4 corr none.dat source.cal src_theta 0 0", "cannot read \"none.dat\""),
        ("brightdata d 5 corr lamp.dat source.cal src_phi src_theta 0 0", "its coordinates"),
        ("brightdata d 4 corr bad.dat source.cal src_theta 0 0", "is no data"),
    ] {
        let lamp = "d light l 0 0 3 1 1 1\nl sphere s 0 0 4 0 0 2 .1\n";
        let files = files(&format!("{FLOOR}void {pattern}\n{lamp}"))
            .with("lamp.dat", "1\n0 180 2\n1 1\n")
            .with("bad.dat", "1\n0 180 2\n1 x\n");
        let error = load_imported(&import(&files).unwrap(), &files).unwrap_err();
        assert!(error.contains(expected), "{pattern}: {error}");
    }
}
