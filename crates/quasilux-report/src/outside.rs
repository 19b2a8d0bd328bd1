//! What shines on the building from outside, and what share of it comes in.

use crate::figure::Figure;
use quasilux_scene::Scene;
use quasilux_transport::DaylightComponents;

/// Light outside, where nothing shades it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// Of the sky, and of the sun where its disk shines, on a horizontal plane, in lx.
    pub horizontal_illuminance_lx: f64,
    /// Whether all light inside comes from the sky: neither lamps nor the sun shine.
    pub is_sky_alone: bool,
}

/// The daylight factor at a point, a share: illuminance over the horizontal illuminance of the sky
/// outside (CIE 16:1970).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DaylightFactor {
    /// The whole.
    pub total: Figure,
    /// Its parts; `None` where no openings make an inside.
    pub components: Option<DaylightFactorComponents>,
}

/// The parts of a daylight factor, by where the light was reflected last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DaylightFactorComponents {
    /// Straight from the sky, through openings.
    pub sky: Figure,
    /// From surfaces and the ground beyond the openings.
    pub externally_reflected: Figure,
    /// What remains: from surfaces within.
    pub internally_reflected: Figure,
    /// What of the first two each may come by ways on which no path lay, at most, with 95 %.
    pub unseen: f64,
}

/// A part of a daylight factor, as results name it.
pub(crate) struct DaylightColumn {
    pub(crate) name: &'static str,
    pub(crate) figure: Figure,
}

impl Outside {
    /// `None` where nothing is outside.
    #[must_use]
    pub fn new(scene: &Scene) -> Option<Self> {
        scene.environment.as_ref().map(|environment| Self {
            horizontal_illuminance_lx: environment.horizontal_illuminance_lx(),
            is_sky_alone: scene.lights.is_empty() && environment.sun.is_none(),
        })
    }

    /// The daylight factor. `None` under lamps and in sunlight, which it does not count.
    #[must_use]
    pub fn daylight_factor(
        &self,
        illuminance_lx: Figure,
        components: Option<&DaylightComponents>,
    ) -> Option<DaylightFactor> {
        let outside_lx = self.horizontal_illuminance_lx;
        (self.is_sky_alone && outside_lx > 0.0).then(|| DaylightFactor {
            total: share(illuminance_lx, outside_lx),
            components: components.map(|components| {
                let sky = components.sky_lx.into();
                let externally = components.externally_reflected_lx.into();
                let within = rest(illuminance_lx, [sky, externally]);
                let [sky, externally_reflected, internally_reflected] =
                    [sky, externally, within].map(|lx| share(lx, outside_lx));
                let unseen = components.unseen_lx / outside_lx;
                DaylightFactorComponents { sky, externally_reflected, internally_reflected, unseen }
            }),
        })
    }
}

impl DaylightFactor {
    /// The whole and its parts.
    pub(crate) fn columns(&self) -> Vec<DaylightColumn> {
        let column = |name, figure| DaylightColumn { name, figure };
        let mut columns = vec![column("daylight_factor", self.total)];
        if let Some(components) = self.components {
            columns.extend([
                column("sky_component", components.sky),
                column("externally_reflected_component", components.externally_reflected),
                column("internally_reflected_component", components.internally_reflected),
            ]);
        }
        columns
    }
}

fn share(lx: Figure, outside_lx: f64) -> Figure {
    let share = |lx: Option<f64>| lx.map(|lx| lx / outside_lx);
    Figure { value: share(lx.value), half_width: share(lx.half_width) }
}

/// What remains of a figure beside others that are independent of it.
fn rest(all: Figure, others: [Figure; 2]) -> Figure {
    let value = |sum: f64, figure: &Figure| figure.value.map(|x| sum - x);
    let square = |sum: f64, figure: &Figure| figure.half_width.map(|x| sum + x * x);
    Figure {
        value: all.value.and_then(|all| others.iter().try_fold(all, value)),
        half_width: [&all, &others[0], &others[1]]
            .into_iter()
            .try_fold(0.0, square)
            .map(|sum: f64| sum.sqrt()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_transport::Interval;

    #[test]
    fn daylight_factors_are_shares_of_the_sky_alone() {
        let inside = Figure { value: Some(200.0), half_width: Some(2.0) };
        let sky = Outside { horizontal_illuminance_lx: 10_000.0, is_sky_alone: true };
        let expected = Figure { value: Some(0.02), half_width: Some(0.0002) };
        let found = sky.daylight_factor(inside, None);
        assert_eq!(found, Some(DaylightFactor { total: expected, components: None }));
        let with_lamps = Outside { is_sky_alone: false, ..sky };
        assert_eq!(with_lamps.daylight_factor(inside, None), None);
        let night = Outside { horizontal_illuminance_lx: 0.0, ..sky };
        assert_eq!(night.daylight_factor(inside, None), None);
    }

    #[test]
    fn the_internally_reflected_component_is_what_remains() {
        let inside = Figure { value: Some(200.0), half_width: Some(2.0) };
        let sky = Outside { horizontal_illuminance_lx: 10_000.0, is_sky_alone: true };
        let lx = |value, half_width| Interval { value, half_width: Some(half_width) };
        let known = DaylightComponents {
            sky_lx: lx(100.0, 1.0),
            externally_reflected_lx: lx(30.0, 2.0),
            unseen_lx: 5.0,
        };
        let found = sky.daylight_factor(inside, Some(&known)).unwrap().components.unwrap();
        let within = Figure { value: Some(0.007), half_width: Some(0.0003) };
        assert_eq!(found.sky, Figure { value: Some(0.01), half_width: Some(0.0001) });
        assert_eq!((found.internally_reflected, found.unseen), (within, 0.0005));
        let unknown = Figure { value: Some(200.0), half_width: None };
        let found = sky.daylight_factor(unknown, Some(&known)).unwrap().components.unwrap();
        assert_eq!(found.internally_reflected, Figure { half_width: None, ..within });
    }
}
