//! Measured sheets: all estimators see the same light, and a table of a known surface is that
//! surface.

use crate::images::add_panel;
use crate::scenes::{all_walls_emit, level_grid, points, room};
use glam::DVec3;
use quasilux_bsdf::{
    AngleBasis, BsdfFacts, BsdfFormat, Distribution, KlemsTable, MeasuredBsdf, ScatteringMode,
    SheetDistribution, Side, read_bsdf,
};
use quasilux_scene::bsdf::{Diffuse, Measured, Translucent};
use quasilux_scene::light::AreaLight;
use quasilux_scene::{Bsdf, Light, Rgb, Scene};
use quasilux_stats::{deep, sidak, student_t_quantile};
use quasilux_transport::{Estimates, EstimatorKind, Settings, check, simulate};
use std::f64::consts::{FRAC_1_PI, PI};
use std::sync::Arc;

pub(crate) const REPLICATES: u32 = 32;

/// A room with an emitting panel on one side of a wall of the sheet; looked at are two cells on
/// either side and a point behind it.
pub(crate) fn divided(sheet: Bsdf) -> Scene {
    let mut scene = room(DVec3::ONE, Bsdf::Diffuse(Diffuse { reflectance: Rgb::grey(0.5) }));
    add_panel(&mut scene, DVec3::new(0.5, 0.0, 0.0), DVec3::Y, DVec3::Z, sheet);
    // A panel rather than a point: sharp lobes of sheets meet it often enough for paths.
    let first = scene.mesh.triangles.len() as u32;
    let (corner, black) =
        (DVec3::new(0.05, 0.2, 0.9), Bsdf::Diffuse(Diffuse { reflectance: Rgb::BLACK }));
    add_panel(&mut scene, corner, DVec3::Y * 0.4, DVec3::X * 0.3, black);
    let area_m2 = 0.4 * 0.3;
    let (material, triangles) = (scene.mesh.material_of[first as usize], vec![first, first + 1]);
    let light = AreaLight { material, triangles, area_m2, luminance_cd_m2: 1000.0 };
    scene.lights = vec![Light::Area(light)];
    scene.sensors = vec![
        level_grid(DVec3::new(0.1, 0.1, 0.3), [0.3, 0.8], [1, 1]),
        level_grid(DVec3::new(0.6, 0.1, 0.3), [0.3, 0.8], [1, 1]),
        points("behind", &[(DVec3::new(0.7, 0.3, 0.6), DVec3::new(-0.8, 0.0, 0.6))]),
    ];
    scene
}

/// Values at the middles of the patches of a basis.
pub(crate) fn table(value: impl Fn(DVec3, DVec3) -> f64) -> Distribution {
    let basis = AngleBasis::known("LBNL/Klems Half").expect("a basis");
    let middles: Vec<DVec3> = {
        let even = KlemsTable::new(basis.clone(), basis.clone(), vec![1.0; 73 * 73]);
        Distribution::Klems(even.expect("a table")).incidences()
    };
    let pairs = middles.iter().flat_map(|&wi| middles.iter().map(move |&wo| (wi, wo)));
    let values = pairs.map(|(wi, wo)| value(wi, wo)).collect();
    Distribution::Klems(KlemsTable::new(basis.clone(), basis, values).expect("a table"))
}

pub(crate) fn measured(
    tables: impl IntoIterator<Item = (Side, ScatteringMode, Distribution)>,
) -> Bsdf {
    let facts = BsdfFacts {
        format: BsdfFormat::WindowKlems,
        name: String::new(),
        manufacturer: String::new(),
        thickness_m: None,
    };
    let tables = tables.into_iter().map(|(side, mode, distribution)| SheetDistribution {
        side,
        mode,
        distribution,
    });
    let table = MeasuredBsdf::from_tables(facts, tables);
    Bsdf::Measured(Measured::new(Arc::new(table), Some(DVec3::Z)))
}

pub(crate) fn estimates(scene: &Scene, estimator: EstimatorKind, samples: u64) -> Vec<Mean> {
    let settings = Settings {
        estimator,
        replicates: REPLICATES,
        max_samples: Some(samples),
        rel_tol: 0.0,
        ..Settings::default()
    };
    let scene = match estimator {
        // Photons are counted by cells.
        EstimatorKind::Photon => Scene { sensors: scene.sensors[..2].to_vec(), ..scene.clone() },
        _ => scene.clone(),
    };
    assert_eq!(check(&scene, &settings), Ok(()));
    let found = simulate(&scene, &settings, &mut ());
    assert_eq!((found.invalid_contributions, found.biased), (0, false));
    (0..scene.sensors.len()).map(|sensor| Mean::new(&found, sensor, 0)).collect()
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Mean {
    pub(crate) value_lx: f64,
    pub(crate) standard_error_lx: f64,
}

impl Mean {
    /// Of all points of the first sensor.
    pub(crate) fn all(estimates: &Estimates) -> Vec<Self> {
        let points = estimates.sensors[0].replicate_lx[0].len();
        (0..points).map(|point| Self::new(estimates, 0, point)).collect()
    }

    /// Of light that is this many times as much.
    pub(crate) fn times(self, factor: f64) -> Self {
        let Self { value_lx, standard_error_lx } = self;
        Self { value_lx: value_lx * factor, standard_error_lx: standard_error_lx * factor }
    }

    fn new(estimates: &Estimates, sensor: usize, point: usize) -> Self {
        let values: Vec<f64> =
            estimates.sensors[sensor].replicate_lx.iter().map(|row| row[point]).collect();
        let n = values.len() as f64;
        let value_lx = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|x| (x - value_lx) * (x - value_lx)).sum();
        Self { value_lx, standard_error_lx: (squares / (n * (n - 1.0))).sqrt() }
    }
}

/// By Welch's t at a significance of 1 % for all pairs together (Sidak 1967); the joint half-width
/// is asserted to be at most `widest` of the value, where it is dark of the brightest of all.
pub(crate) fn assert_alike(what: &str, pairs: &[(Mean, Mean)], widest: f64) {
    let brightest_lx = pairs.iter().map(|(a, _)| a.value_lx).fold(0.0, f64::max);
    let mut detected = 0.0_f64;
    for (a, b) in pairs {
        let [x, y] = [a, b].map(|mean| mean.standard_error_lx * mean.standard_error_lx);
        if x + y == 0.0 {
            assert_eq!(a.value_lx, b.value_lx, "{what}");
            continue;
        }
        let degrees = f64::from(REPLICATES - 1) * (x + y) * (x + y) / (x * x + y * y);
        let t = student_t_quantile(1.0 - sidak(0.01, pairs.len()), degrees);
        let joint_lx = t * (x + y).sqrt();
        let allowed_lx = widest * if x == 0.0 { brightest_lx } else { a.value_lx };
        detected = detected.max(widest * joint_lx / allowed_lx);
        assert!(joint_lx <= allowed_lx, "{what}: known to {joint_lx} lx: {a:?}, {b:?}");
        assert!((a.value_lx - b.value_lx).abs() <= joint_lx, "{what}: {a:?}, {b:?}");
    }
    println!("{what}: errors above {detected:.4} are found, {widest} asserted");
}

/// Constant values are Lambert's without any error of the table: errors above 6 % are found, in the
/// deep variant above 3 %.
#[test]
fn a_table_of_lambert_is_a_translucent_sheet() {
    let (paths, widest) = if deep() { (1 << 12, 0.03) } else { (1 << 10, 0.06) };
    let [reflectance, transmittance] = [0.3, 0.4].map(Rgb::grey);
    let known = divided(Bsdf::Translucent(Translucent { reflectance, transmittance }));
    let even = |share: f64| table(move |_, _| share * FRAC_1_PI);
    let tables = Side::ALL.into_iter().flat_map(|side| {
        [
            (side, ScatteringMode::Reflection, even(0.3)),
            (side, ScatteringMode::Transmission, even(0.4)),
        ]
    });
    let scene = divided(measured(tables));
    let expected = estimates(&known, EstimatorKind::Path, paths);
    for (estimator, samples) in [
        (EstimatorKind::Path, paths),
        (EstimatorKind::Photon, 8 * paths),
        (EstimatorKind::Bidirectional, paths),
    ] {
        let found = estimates(&scene, estimator, samples);
        let pairs: Vec<(Mean, Mean)> = expected.iter().copied().zip(found).collect();
        assert_alike(estimator.name(), &pairs, widest);
    }
}

/// Walls that emit 100 cd/m2 and reflect half of all light as a table says that knows one side
/// alone: it is as bright everywhere, `pi L / (1 - rho)`, whichever side of them looks in.
#[test]
fn a_furnace_of_tables_is_as_bright_as_it_must_be() {
    let half = || table(|_, _| 0.5 * FRAC_1_PI);
    for side in Side::ALL {
        let mut scene = room(DVec3::ONE, measured([(side, ScatteringMode::Reflection, half())]));
        all_walls_emit(&mut scene, 100.0);
        let middle = DVec3::new(0.4, 0.5, 0.3);
        scene.sensors = vec![
            level_grid(middle, [0.2, 0.3], [1, 1]),
            level_grid(DVec3::new(0.1, 0.1, 0.7), [0.3, 0.2], [1, 1]),
            points("inside", &[(middle, DVec3::new(-0.8, 0.0, 0.6))]),
        ];
        let expected_lx = 100.0 * PI / 0.5;
        for (estimator, samples) in
            [(EstimatorKind::Path, 1 << 10), (EstimatorKind::Photon, 1 << 15)]
        {
            for found in estimates(&scene, estimator, samples) {
                let off_lx = (found.value_lx - expected_lx).abs();
                // Ten comparisons; 3.7 standard errors of 32 replicates are exceeded by one in a
                // thousand.
                assert!(
                    off_lx <= 3.7 * found.standard_error_lx.max(1e-9),
                    "{estimator:?}: {found:?}"
                );
                assert!(found.standard_error_lx < 0.01 * expected_lx, "{estimator:?}: {found:?}");
            }
        }
    }
}

/// A sheet whose sides differ, that turns light to one side and up, and whose table does not care
/// for reciprocity: photons take f as it is and paths the other way round.
#[test]
fn photons_and_paths_agree_on_sheets_that_break_reciprocity() {
    let toward =
        |axis: DVec3, wo: DVec3, power: f64| libm::pow(wo.dot(axis.normalize()).max(0.0), power);
    let front = table(move |wi, wo| 0.3 * wi.z * toward(DVec3::new(0.5, 0.5, 1.0), wo, 4.0));
    let back = table(move |_, wo| 0.2 + 0.1 * toward(DVec3::new(-0.3, 0.8, 0.6), wo, 8.0));
    let through = table(move |wi, wo| {
        0.9 * toward(DVec3::new(-wi.x, 0.7 - wi.y, wi.z + 0.2), wo, 12.0) + 0.02 * wi.x.max(0.0)
    });
    let scene = divided(measured([
        (Side::Front, ScatteringMode::Reflection, front),
        (Side::Back, ScatteringMode::Reflection, back.clone()),
        (Side::Front, ScatteringMode::Transmission, through.clone()),
        (Side::Back, ScatteringMode::Transmission, through),
    ]));
    assert_estimators_agree("made up", &scene, 1 << 11, 0.06);
}

/// Blinds and prisms as others measured or computed them.
#[test]
fn photons_and_paths_agree_on_published_sheets() {
    for name in ["klems-2011-SA1.xml", "klems-room-blinds.xml", "tt-room-blindsT3.xml"] {
        let Some(path) = quasilux_corpus::find(&format!("bsdf/{name}")) else { continue };
        let bytes = std::fs::read(path).expect("a file");
        let table = Arc::new(read_bsdf(&bytes).expect("a surface").bsdf);
        let sheet = Bsdf::Measured(Measured::new(table, Some(DVec3::Z)));
        assert_estimators_agree(name, &divided(sheet), 1 << 12, 0.2);
    }
}

/// Compares `paths` paths a replicate (2^12 in deep runs) with photons counted by cells, and with
/// paths that are connected to light subpaths. Joint half-widths are at most `widest` of the
/// values.
pub(crate) fn assert_estimators_agree(what: &str, scene: &Scene, paths: u64, widest: f64) {
    let paths = if deep() { paths.max(1 << 12) } else { paths };
    let alone = estimates(scene, EstimatorKind::Path, paths);
    let photons = estimates(scene, EstimatorKind::Photon, 8 * paths);
    let both = estimates(scene, EstimatorKind::Bidirectional, paths);
    let pairs: Vec<(Mean, Mean)> =
        alone.iter().copied().zip(photons).chain(alone.iter().copied().zip(both)).collect();
    assert_alike(what, &pairs, widest);
}
