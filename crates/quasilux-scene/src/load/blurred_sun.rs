//! What tables of measured glass blur of the sun.

use crate::project::Project;
use crate::{Bsdf, Scene, Warning};
use quasilux_bsdf::{Side, StraightPeak};

/// A peak of less light is not told: of the sun's 100 klx it gives less than the 1000 lx from which
/// sunlight glares or heats (IES LM-83).
const MIN_SHARE: f64 = 0.01;

/// Tells of tables that send light straight on within a cell of many times the sun's disk.
pub(super) fn tell(scene: &Scene, project: &Project, warnings: &mut Vec<Warning>) {
    let has_sun = scene.environment.as_ref().is_some_and(|outside| outside.sun.is_some());
    if !has_sun && scene.weather.is_none() {
        return;
    }
    for material in &scene.materials {
        let Bsdf::Measured(measured) = &material.bsdf else { continue };
        let peaks = Side::ALL.into_iter().filter_map(|side| measured.table().straight_peak(side));
        let peak = peaks.max_by(|a, b| a.share.total_cmp(&b.share));
        let Some(peak) = peak.filter(|peak| peak.share >= MIN_SHARE) else { continue };
        let StraightPeak { share, half_width_rad } = peak;
        let entry = project.materials.iter().find(|entry| entry.name.value == material.name);
        let message = format!(
            "\"{}\" sends {:.0} % of the sunlight that meets it square straight on, in a cell of \
             its table that reaches {:.1}\u{b0} to each side: patches of sun behind it are blurred \
             by as much; kind = \"pane\" or \"glazing\" keeps them sharp where the glass is clear",
            material.name,
            100.0 * share,
            half_width_rad.to_degrees()
        );
        warnings.push(Warning::new(&project.file, entry.map(|it| it.name.place), message));
    }
}
