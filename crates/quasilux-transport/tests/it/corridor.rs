//! Light that is hard to find: a corridor lit from a niche at one end, with photons guided and
//! not.

use crate::images::add_panel;
use crate::measured_odd::grid_below;
use crate::scenes::{diffuse, diffuse_cube, point_light, room, wall_grid};
use glam::DVec3;
use quasilux_scene::{FileKind, Files, Quantity, Scene, SensorShape, load};
use quasilux_stats::deep;
use quasilux_transport::trial::{PhotonOrder, Traced, try_photons};
use quasilux_transport::{Estimates, EstimatorKind, Interval, Settings, Switch, simulate};
use std::path::{Path, PathBuf};

/// Sensor points along the floor, one a metre.
const POINTS: usize = 30;

/// What another program says of a cell.
#[derive(Debug)]
struct SurveyCell {
    value_lx: f64,
    standard_error_lx: f64,
}

/// All cells, by a photon tracer that shares no code with this project.
fn reference() -> Vec<SurveyCell> {
    let table = include_str!("../../../../examples/corridor/reference.csv");
    let known = |line: &str| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let [_, value_lx, percent] = numbers[..] else { panic!("{line}") };
        SurveyCell { value_lx, standard_error_lx: 0.01 * percent * value_lx }
    };
    table.lines().skip(1).map(known).collect()
}

struct Folder(PathBuf);

impl Files for Folder {
    fn read(&self, path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        std::fs::read(self.0.join(path))
    }
}

fn corridor(quantity: Quantity) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/corridor");
    let project = std::fs::read(folder.join("corridor.toml")).unwrap();
    let mut scene = load("corridor.toml", &project, &Folder(folder)).unwrap().scene;
    let SensorShape::Grid(grid) = &mut scene.sensors[0].shape else { panic!("not a grid") };
    grid.quantity = quantity;
    scene
}

fn settings(importance: Switch) -> Settings {
    Settings { estimator: EstimatorKind::Photon, importance, rel_tol: 0.0, ..Settings::default() }
}

fn counted(seed: u64, importance: Switch, samples: u64) -> (Vec<Interval>, Estimates) {
    let settings = Settings { seed, max_samples: Some(samples), ..settings(importance) };
    let estimates = simulate(&corridor(Quantity::Mean), &settings, &mut ());
    (estimates.point_intervals(0), estimates)
}

fn relative(interval: &Interval) -> f64 {
    interval.relative_half_width().unwrap_or(f64::INFINITY)
}

/// The half-width over value in the far half of the corridor.
fn far(intervals: &[Interval]) -> f64 {
    median(intervals[POINTS / 2..].iter().map(relative).collect())
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// With fewer rays than unguided photons take, guided ones know the far half of the corridor at
/// least twice as well by the median of three seeds, come to the same values within joint intervals
/// (30 points of each seed at twice the joint 95 % half-widths, about four standard errors: near
/// the niche an error of 3 % would be found, at the dark end one of 60 %), and spend as much flux
/// as they get.
#[test]
fn guided_photons_know_the_dark_end_better() {
    let gain = |seed| {
        let (plain, plain_estimates) = counted(seed, Switch::Off, 1 << 16);
        let (guided, estimates) = counted(seed, Switch::Auto, 1 << 13);
        assert!(estimates.rays < plain_estimates.rays, "{} rays", estimates.rays);
        for point in 0..POINTS {
            let (a, b) = (&plain[point], &guided[point]);
            let [h, k] = [a, b].map(|interval| interval.half_width.unwrap_or(f64::INFINITY));
            let joint = 2.0 * (h * h + k * k).sqrt();
            assert!((a.value - b.value).abs() <= joint, "{seed}, {point}: {a:?}, {b:?}");
        }
        let flux = estimates.flux;
        let sum = flux.absorbed_lm + flux.lost_lm + flux.cut_lm;
        assert!((sum / flux.emitted_lm - 1.0).abs() < 1e-12 && flux.absorbed_lm > 0.0, "{flux:?}");
        far(&plain) / far(&guided)
    };
    let gains: Vec<f64> = (1..=3).map(gain).collect();
    assert!(median(gains.clone()) > 2.0, "{gains:?}");
}

/// Paths connected to light subpaths know every cell. Each is compared with the independent
/// tracer: 30 differences at twice the joint 95 % half-widths, about four standard errors; an error
/// of 50 % would be found in any cell, in the deep variant one of 30 %. What is found spans four
/// orders of magnitude, and so does the reference, by three of its standard errors at either end.
#[test]
fn connected_paths_know_all_of_four_orders_of_magnitude() {
    let (samples, widest) = if deep() { (1 << 13, 0.15) } else { (1 << 11, 0.25) };
    let settings = Settings {
        estimator: EstimatorKind::Bidirectional,
        max_samples: Some(samples),
        ..settings(Switch::Auto)
    };
    let estimates = simulate(&corridor(Quantity::Mean), &settings, &mut ());
    let found = estimates.point_intervals(0);
    let reference = reference();
    assert_eq!(reference.len(), POINTS);
    for (cell, (found, wanted)) in found.iter().zip(&reference).enumerate() {
        let half_width = found.half_width.unwrap_or(f64::INFINITY);
        let joint = libm::hypot(half_width, 2.0 * wanted.standard_error_lx);
        assert!(joint < widest * wanted.value_lx, "{cell}: {found:?}");
        let off = (found.value - wanted.value_lx).abs();
        assert!(off <= 2.0 * joint, "{cell}: {found:?}, wanted {wanted:?}");
    }
    let values = || found.iter().map(|interval| interval.value);
    let (largest, smallest) = (values().fold(0.0, f64::max), values().fold(f64::MAX, f64::min));
    assert!(largest / smallest > 1e4, "{largest} to {smallest}");
    let by_value = |a: &&SurveyCell, b: &&SurveyCell| a.value_lx.total_cmp(&b.value_lx);
    let (most, least) = (reference.iter().max_by(by_value), reference.iter().min_by(by_value));
    let [most, least] = [most, least].map(|cell| cell.expect("thirty cells"));
    let surely_most = most.value_lx - 3.0 * most.standard_error_lx;
    assert!(surely_most / (least.value_lx + 3.0 * least.standard_error_lx) > 1e4);
}

/// Split photons in waves count what they count one family after the other, whatever the order.
#[test]
fn waves_of_split_photons_count_what_single_families_count() {
    let scene = corridor(Quantity::Mean);
    let settings = Settings { replicates: 2, ..settings(Switch::On) };
    let outcome = |order, parts: &[u64]| {
        let mut outcome = None;
        try_photons(&scene, &settings, None, |trial| {
            let mut traced = Traced::default();
            for part in parts.windows(2) {
                let of_part = trial.trace(order, part[0]..part[1]);
                traced.photons += of_part.photons;
                traced.rays += of_part.rays;
            }
            outcome = Some((trial.counters(), traced));
        });
        outcome.unwrap()
    };
    let alone = outcome(PhotonOrder::OneByOne, &[0, 3000]);
    assert_eq!(alone, outcome(PhotonOrder::Waves, &[0, 3000]));
    assert_eq!(alone, outcome(PhotonOrder::CoherentWaves, &[0, 1000, 1111, 3000]));
    assert!(alone.1.rays > 2 * alone.1.photons, "{:?}", alone.1);
}

/// So is a diffuse sheet in a black room under a cell that looks at it: the survey says that
/// photons are worth nothing where they land, but it is on their order there that they are counted.
#[test]
fn a_sheet_in_the_dark_is_left_alone() {
    let mut scene = room(DVec3::ONE, diffuse(0.0));
    let corner = DVec3::new(0.2, 0.2, 0.01);
    add_panel(&mut scene, corner, DVec3::X * 0.6, DVec3::Y * 0.6, diffuse(0.6));
    scene.lights.push(point_light(DVec3::new(0.5, 0.5, 0.9), 10.0));
    scene.sensors = vec![grid_below(DVec3::new(0.1, 0.2, 0.6))];
    assert_is_left_alone(&scene);
}

/// A plain room is left alone: the same rays but for the survey, the same values.
#[test]
fn a_plain_room_is_left_alone() {
    let mut scene = diffuse_cube(&[]);
    scene.sensors = vec![wall_grid([5, 5])];
    assert_is_left_alone(&scene);
}

fn assert_is_left_alone(scene: &Scene) {
    let run = |importance| {
        let settings = Settings { max_samples: Some(1 << 10), ..settings(importance) };
        simulate(scene, &settings, &mut ())
    };
    let (plain, asked) = (run(Switch::Off), run(Switch::Auto));
    assert_eq!(plain.sensors, asked.sensors);
    assert_eq!(plain.flux, asked.flux);
    assert!(asked.rays > plain.rays);
}
