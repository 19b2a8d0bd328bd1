//! Small made-up results that the tests of this crate share.

use crate::{Figure, Report, RunFacts, TermReport};
use glam::DVec3;
use quasilux_scene::{Camera, Grid, Quantity, Scene, Sensor, SensorPoint, SensorShape};
use quasilux_transport::{
    CameraEstimates, Convergence, Decisions, DimensionHistogram, Dimensions, Estimates,
    EstimatorKind, Evidence, FluxBalance, Pixel, SensorEstimates, Settings, UnseenLight,
};

/// A grid in the xy plane.
pub(crate) fn grid(edges_m: [f64; 2], counts: [u32; 2]) -> Grid {
    Grid {
        origin: DVec3::new(0.5, 0.5, 0.8),
        u: DVec3::X * edges_m[0],
        v: DVec3::Y * edges_m[1],
        counts,
        normal: DVec3::Z,
        quantity: Quantity::Centre,
        target_lx: None,
    }
}

/// A report of one grid whose values are `lx` of the position in the unit square; replicates
/// scatter by the relative `noise`.
pub(crate) fn report_of(
    name: &str,
    grid: Grid,
    noise: f64,
    lx: impl Fn(f64, f64) -> f64,
) -> Report {
    let columns = grid.counts[0] as usize;
    let mean: Vec<f64> = (0..grid.cells())
        .map(|cell| {
            let x = ((cell % columns) as f64 + 0.5) / f64::from(grid.counts[0]);
            let y = ((cell / columns) as f64 + 0.5) / f64::from(grid.counts[1]);
            lx(x, y)
        })
        .collect();
    let sensor = Sensor { name: name.into(), shape: SensorShape::Grid(grid) };
    report(vec![(sensor, replicates(&mean, noise))], &Settings::default())
}

/// A 24 x 20 workplane under six luminaires, and one probe.
pub(crate) fn office() -> Report {
    let grid = grid([5.0, 4.0], [24, 20]);
    let desk = report_of("workplane", grid, 0.01, batwing);
    let values: Vec<f64> =
        desk.sensors[0].points.iter().filter_map(|p| p.illuminance_lx.value).collect();
    let plane = Sensor { name: "workplane".into(), shape: SensorShape::Grid(grid) };
    let probe = Sensor {
        name: "probe at the door, 1.2 m".into(),
        shape: SensorShape::Points(vec![SensorPoint { position: DVec3::ONE, normal: DVec3::X }]),
    };
    report(
        vec![(plane, replicates(&values, 0.01)), (probe, replicates(&[93.7], 0.04))],
        &Settings::default(),
    )
}

/// Six soft spots with a dip below each, brighter in the middle of the room.
pub(crate) fn batwing(x: f64, y: f64) -> f64 {
    let mut lx = 140.0;
    for lamp in 0..6 {
        let dx = (x - (0.5 + f64::from(lamp % 3)) / 3.0) * 5.0;
        let dy = (y - (0.5 + f64::from(lamp / 3)) / 2.0) * 4.0;
        let squared = dx * dx + dy * dy;
        lx += 420.0 * (1.0 + 0.9 * squared) / ((1.0 + squared) * (1.0 + squared))
            - 60.0 * libm::exp(-6.0 * squared);
    }
    lx
}

/// A sensor "desk" of single points, all replicates equal.
pub(crate) fn noiseless(values: &[f64]) -> Report {
    let point = SensorPoint { position: DVec3::ZERO, normal: DVec3::Z };
    let shape = SensorShape::Points(vec![point; values.len()]);
    let mut report = report(
        vec![(Sensor { name: "desk".into(), shape }, vec![values.to_vec(); 4])],
        &Settings::default(),
    );
    report.warnings.retain(|w| w != WARNING);
    report
}

/// Two points with direct light and the rest apart, known to 0.5 lx.
pub(crate) fn with_terms() -> Report {
    let mut report = noiseless(&[100.0, 300.0]);
    let known = |lx: f64| Figure { value: Some(lx), half_width: Some(0.5) };
    let term = |(bounces, lx): (Option<u32>, [f64; 2])| TermReport {
        bounces,
        average_lx: known(0.5 * (lx[0] + lx[1])),
        points_lx: lx.map(known).to_vec(),
    };
    report.sensors[0].terms = [(Some(0), [80.0, 200.0]), (None, [20.0, 100.0])].map(term).to_vec();
    report
}

/// Points of 100, 500 and 0 lx of an estimator that bounds what it did not see: 2 lx, 20 lx and
/// 0.02 lx, and 0.4 lx of the average. Half a lux of the first is blurred.
pub(crate) fn with_unseen() -> Report {
    let settings = Settings { estimator: EstimatorKind::Bidirectional, ..Settings::default() };
    let (scene, estimates) = bounded();
    Report::new(&scene, &settings, &estimates, RunFacts::default())
}

/// What [`with_unseen`] is made of.
pub(crate) fn bounded() -> (Scene, Estimates) {
    let point = SensorPoint { position: DVec3::ZERO, normal: DVec3::Z };
    let shape = SensorShape::Points(vec![point; 3]);
    let sensor = Sensor { name: "desk".into(), shape };
    let (scene, mut estimates) =
        scene_and_estimates(vec![(sensor, vec![vec![100.0, 500.0, 0.0]; 4])]);
    estimates.sensors[0].unseen = Some(UnseenLight {
        point_lx: vec![2.0, 20.0, 0.02],
        average_lx: 0.4,
        merged_lx: vec![0.5, 0.0, 0.0],
        disc_radius_m: vec![Some(0.1), None, Some(0.1)],
        ..UnseenLight::unknown(3)
    });
    estimates.cannot_see = ["lamp, glass body, point", "sun, mirror, point"].map(Into::into).into();
    (scene, estimates)
}

/// A camera "view" alone, with the luminance of each pixel; half-widths are 0.5 cd/m2, and unknown
/// without light.
pub(crate) fn picture(resolution: [u32; 2], luminance_cd_m2: impl Fn(u32, u32) -> f64) -> Report {
    let [width, height] = resolution;
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels: Vec<Pixel> = places
        .map(|(x, y)| {
            let luminance_cd_m2 = luminance_cd_m2(x, y) as f32;
            Pixel {
                rgb_cd_m2: [1.1, 0.98, 0.9].map(|share| share * luminance_cd_m2),
                luminance_cd_m2,
                half_width_cd_m2: (luminance_cd_m2 > 0.0).then_some(0.5),
                unseen_cd_m2: Some(0.25),
            }
        })
        .collect();
    let sum: f64 = pixels.iter().map(|pixel| f64::from(pixel.luminance_cd_m2)).sum();
    let (mut scene, mut estimates) = scene_and_estimates(Vec::new());
    scene.cameras.push(Camera {
        name: "view".into(),
        position: DVec3::ZERO,
        target: DVec3::X,
        up: DVec3::Z,
        vertical_fov_rad: 1.0,
        resolution,
        samples: None,
        rel_tol: None,
    });
    estimates.samples = 16;
    estimates.cameras.push(CameraEstimates {
        unseen_mean_cd_m2: Some(0.125),
        merged_mean_cd_m2: 0.5,
        disc_radius_m: Some(0.1),
        replicate_mean_cd_m2: vec![sum / pixels.len() as f64; 16],
        pixels: pixels.into(),
        samples: 16,
        rel_tol: None,
        is_done: true,
    });
    Report::new(&scene, &Settings::default(), &estimates, RunFacts::default())
}

/// One point, one replicate.
pub(crate) fn without_intervals() -> Report {
    let point = SensorPoint { position: DVec3::new(0.0, 0.0, 0.5), normal: DVec3::Z };
    let sensor = Sensor { name: "desk".into(), shape: SensorShape::Points(vec![point]) };
    let settings = Settings { replicates: 1, ..Settings::default() };
    report(vec![(sensor, vec![vec![100.0]])], &settings)
}

/// A result of the estimator whose map leaves a bias.
pub(crate) fn biased() -> Report {
    let settings = Settings { estimator: EstimatorKind::BidirectionalMap, ..Settings::default() };
    let (scene, mut estimates) = scene_and_estimates(Vec::new());
    estimates.biased = true;
    Report::new(&scene, &settings, &estimates, RunFacts::default())
}

const WARNING: &str = "a \"quoted\" warning";

fn report(sensors: Vec<(Sensor, Vec<Vec<f64>>)>, settings: &Settings) -> Report {
    let (scene, estimates) = scene_and_estimates(sensors);
    let facts = RunFacts {
        version: "0.1.0".into(),
        build: "0123456789abcdef".into(),
        scene_sha256: "c0ffee".into(),
        seconds: 9.8125,
        earlier_seconds: 0.0,
        earlier_rays: 0,
        threads: 2,
        expected_bytes: Some(96 << 20),
        maintenance_factor: None,
        daylight: None,
        warnings: vec![WARNING.into()],
        findings: Vec::new(),
    };
    Report::new(&scene, settings, &estimates, facts)
}

fn scene_and_estimates(sensors: Vec<(Sensor, Vec<Vec<f64>>)>) -> (Scene, Estimates) {
    let figures = sensors.iter().map(|(_, rows)| SensorEstimates {
        replicate_lx: rows.clone(),
        direct_lx: rows[0].iter().map(|lx| 0.8 * lx).collect(),
        evidence: vec![Evidence::Sound; rows[0].len()],
        samples: vec![65_536; rows[0].len()],
        average: None,
        terms: Vec::new(),
        unseen: None,
    });
    let estimates = Estimates {
        sensors: figures.collect(),
        cameras: Vec::new(),
        samples: 65_536,
        rays: 187_654_321,
        decisions: Decisions { connected_photons: Some(8), ..Decisions::default() },
        flux: FluxBalance {
            emitted_lm: 21_600.0,
            absorbed_lm: 21_600.0,
            lost_lm: 0.0,
            cut_lm: 0.0,
        },
        dimensions: Dimensions {
            photon: photon_dimensions(),
            photons: 3,
            photon_events: 6,
            path: DimensionHistogram::new(),
        },
        invalid_contributions: 0,
        confidence: 0.95,
        miss_probability: 0.025,
        tolerance_reached: true,
        sensors_reached: true,
        convergence: Convergence {
            slope: Some(-0.72),
            samples: Some(65_536),
            rays: Some(187_654_321),
            against_prediction: Some(1.1),
        },
        unresolved_points: 0,
        biased: false,
        cannot_see: Vec::new(),
        caveats: Vec::new(),
    };
    let scene = Scene {
        sensors: sensors.into_iter().map(|(sensor, _)| sensor).collect(),
        ..Scene::default()
    };
    (scene, estimates)
}

/// Three photons of 2, 5 and 2 coordinates.
fn photon_dimensions() -> DimensionHistogram {
    let mut dimensions = DimensionHistogram::new();
    [2, 5, 2].into_iter().for_each(|used| dimensions.record(used));
    dimensions
}

/// Sixteen replicates of given means: replicate r and point p are off by a fixed pattern whose sum
/// over r is zero.
fn replicates(mean: &[f64], noise: f64) -> Vec<Vec<f64>> {
    (0..16_usize)
        .map(|r| {
            let off = |p: usize| ((r * 7 + p * 5) % 16) as f64 / 7.5 - 1.0;
            mean.iter().enumerate().map(|(p, lx)| lx * (1.0 + noise * off(p))).collect()
        })
        .collect()
}
