//! What a survey finds, against what must be.

use super::*;
use crate::scenes::{diffuse, level_grid, point_light, room};
use crate::sensors::targets;
use crate::settings::Settings;
use glam::DVec3;

/// In a long closed room all light that leaves a cell goes somewhere, whichever cells connections
/// are chosen by, and however often. The mean over all cells is known to about 0.2 %; a part of the
/// far light that is lost or counted twice would be found.
#[test]
fn rays_and_connections_share_all_light() {
    let mut scene = room(DVec3::new(12.0, 1.0, 1.0), diffuse(0.5));
    scene.lights.push(point_light(DVec3::new(0.5, 0.4, 0.6), 100.0));
    scene.sensors.push(level_grid(DVec3::ZERO, [12.0, 1.0], [12, 1]));
    let settings = Settings::default();
    let context = Context::<f64>::new(&scene, &settings);
    let mut survey =
        Survey::new(&context, &targets(&scene), |sampler| pilot_photon(&context, sampler))
            .expect("a room");
    let areas_m2 = areas_m2(&context, &survey);
    let all = |survey: &Survey| {
        let cells = survey.known.iter();
        let weights_of_paths = cells.flat_map(|cell| cell.steps().map(|step| step.share));
        weights_of_paths.sum::<f64>() / survey.known.len() as f64
    };
    for look in 0..4 {
        let importance = |(number, cell): (usize, &survey::SurveyCell)| {
            let is_at_the_end = cell.places[0].position.x > 11.0;
            match look {
                0 => f64::from(u8::from(number == 0)),
                1 => f64::from(u8::from(is_at_the_end)),
                2 if !is_at_the_end => 1e-3,
                _ => 1.0,
            }
        };
        let importances: Vec<f64> = survey.known.iter().enumerate().map(importance).collect();
        survey.connect(&context, &areas_m2, &importances);
        let connected = all(&survey);
        assert!((connected - 1.0).abs() < 0.01, "{look}: {connected}");
        survey.refine(&context);
        let refined = all(&survey);
        assert!((refined - 1.0).abs() < 0.01, "{look}: {refined}");
    }
}
