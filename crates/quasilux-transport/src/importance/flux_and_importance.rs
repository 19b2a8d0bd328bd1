//! Forward flux and adjoint importance by survey cell, the two solutions of FW-CADIS.
//!
//! With s the first landings, T the steps between cells (mean over the rays from a cell, absorption
//! left out) and a the albedo, the flux that lands is `phi = s + T^t a phi`. A photon that lands
//! after a bounce is read by the sensors: its importance to sensor i is the share `a p / (A E)` of
//! that sensor's illuminance E, where p is the share of the sensor's view that the cell of area A
//! fills. The sum over the sensors, r, makes the *relative* errors of all sensors count alike, and
//! photons that leave a cell have importance `d = T (r + a d)`: forward-weighted importance (J. C.
//! Wagner, D. E. Peplow, S. W. Mosher, "FW-CADIS method for global and regional variance reduction
//! of Monte Carlo radiation transport calculations", Nuclear Science and Engineering 176(1), 2014;
//! M. A. Cooper, E. W. Larsen, "Automated weight windows for global Monte Carlo particle transport
//! calculations", Nuclear Science and Engineering 137(1), 2001). Deviation: both systems are solved
//! on one sampled matrix instead of by a deterministic code.

use crate::importance::survey::{FirstLandings, Survey, Surveyed, Transition};

/// Sweeps after which a solution is taken as it is: it only guides.
const MAX_SWEEPS: usize = 64;
/// Largest relative change of an entry in the last sweep.
const SETTLED: f64 = 0.05;

/// Flux and importance by surveyed cell.
pub(crate) struct FluxAndImportance {
    /// Flux that lands, as a share of what all lights emit.
    pub(crate) landing: Vec<f64>,
    /// Importance of a photon of weight one that has landed after a bounce, before its next.
    pub(crate) landed_importance: Vec<f64>,
    /// Importance of a photon of weight one that leaves.
    pub(crate) leaving_importance: Vec<f64>,
}

impl FluxAndImportance {
    /// Both systems solved; `None` where no sensor gets light that way.
    pub(crate) fn new(survey: &Survey, areas_m2: &[f64], flux_lm: f64) -> Option<Self> {
        let landing = landing(survey, |first| first.flux);
        let sensors_lx = sensors_lx(survey, areas_m2, &landing, flux_lm);
        let read = read_importance(survey, areas_m2, &sensors_lx, flux_lm)?;
        let leaving_importance = leaving_importance(survey, &read);
        let landed_importance = (0..read.len())
            .map(|cell| read[cell] + survey.known[cell].albedo * leaving_importance[cell])
            .collect();
        Some(Self { landing, landed_importance, leaving_importance })
    }
}

/// `phi = s + T^t a phi` by sweeps that push what is new in each cell on at once.
pub(super) fn landing(survey: &Survey, start: impl Fn(&FirstLandings) -> f64) -> Vec<f64> {
    let known = &survey.known;
    let mut landing = vec![0.0; known.len()];
    let mut fresh: Vec<f64> = survey.first_landings.iter().map(start).collect();
    for sweep in 0..MAX_SWEEPS {
        let mut largest_change = 0.0_f64;
        let mut push = |cell: usize| {
            let light = std::mem::take(&mut fresh[cell]);
            if light == 0.0 {
                return;
            }
            landing[cell] += light;
            largest_change = largest_change.max(light / landing[cell]);
            let leaving = light * known[cell].albedo;
            for step in known[cell].steps() {
                fresh[step.cell as usize] += leaving * step.share * step.weight;
            }
        };
        if sweep % 2 == 0 {
            (0..known.len()).for_each(&mut push);
        } else {
            (0..known.len()).rev().for_each(&mut push);
        }
        if largest_change < SETTLED {
            break;
        }
    }
    landing
}

/// A part of a sensor's view.
struct View {
    cell: usize,
    /// Its share in m^-2, absorption folded in: what a lumen that lands in the cell is read as, in
    /// lx.
    share_m2: f64,
}

/// The view of a sensor, by its rays.
fn views<'s>(
    survey: &'s Survey,
    areas_m2: &'s [f64],
    sensor: &'s Surveyed,
) -> impl Iterator<Item = View> + 's {
    sensor.landings.iter().map(|ray| {
        let cell = ray.cell as usize;
        let albedo = survey.known[cell].albedo;
        let share_m2 = ray.weight * albedo / (sensor.rays as f64 * areas_m2[cell]);
        View { cell, share_m2 }
    })
}

fn sensors_lx(survey: &Survey, areas_m2: &[f64], landing: &[f64], flux_lm: f64) -> Vec<f64> {
    let sensor_lx = |sensor: &Surveyed| {
        let views = views(survey, areas_m2, sensor);
        let seen = views.map(|view| view.share_m2 * landing[view.cell]).sum::<f64>();
        sensor.direct_lx + flux_lm * seen
    };
    survey.sensors.iter().map(sensor_lx).collect()
}

/// Importance of a landing by sensors that see it directly, summed over the sensors with such
/// light.
fn read_importance(
    survey: &Survey,
    areas_m2: &[f64],
    sensors_lx: &[f64],
    flux_lm: f64,
) -> Option<Vec<f64>> {
    let mut importance = vec![0.0; survey.known.len()];
    for (sensor, &lx) in survey.sensors.iter().zip(sensors_lx) {
        if lx > sensor.direct_lx {
            views(survey, areas_m2, sensor)
                .for_each(|view| importance[view.cell] += view.share_m2 * flux_lm / lx);
        }
    }
    importance.iter().any(|importance| *importance > 0.0).then_some(importance)
}

/// `d = T (r + a d)` by sweeps in place.
fn leaving_importance(survey: &Survey, read: &[f64]) -> Vec<f64> {
    let known = &survey.known;
    let mut importance = vec![0.0; known.len()];
    for sweep in 0..MAX_SWEEPS {
        let mut largest_change = 0.0_f64;
        let mut pull = |cell: usize| {
            let arrives = |step: Transition| {
                let next = step.cell as usize;
                step.share * step.weight * (read[next] + known[next].albedo * importance[next])
            };
            let new: f64 = known[cell].steps().map(arrives).sum();
            if new > 0.0 {
                largest_change = largest_change.max((new - importance[cell]).abs() / new);
            }
            importance[cell] = new;
        };
        if sweep % 2 == 0 {
            (0..known.len()).for_each(&mut pull);
        } else {
            (0..known.len()).rev().for_each(&mut pull);
        }
        if largest_change < SETTLED {
            break;
        }
    }
    importance
}
