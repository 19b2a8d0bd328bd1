//! Records in any order to lobes on full grids.

use super::exits::Exits;
use super::records::{Beginning, Key, Records, angle, too_many};
use crate::gaps;
use crate::gridded::GriddedTable;
use crate::gridded::Lobe;
use crate::gridded::MAX_INCIDENCES;
use crate::side::ScatteringMode;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::{ParseError, Position};
use std::f64::consts::FRAC_PI_2;

/// Exit directions of all lobes together, or as many as values where those are more.
const MIN_DIRECTIONS: usize = 1 << 18;

/// The incident directions of one scattering mode, each azimuth with the same polar angles.
struct Incidences {
    /// Of the first one.
    at: Position,
    planes: Vec<Key>,
    thetas: Vec<Key>,
}

/// The table of one scattering mode, `None` where the file has no such line. Each incidence must
/// have a full grid of exits, and each azimuth the same polar angles.
pub(super) fn table<const N: usize>(
    records: &Records<N>,
    mode: ScatteringMode,
    warnings: &mut Warnings,
) -> Result<Option<GriddedTable>, ParseError> {
    let Some(incidences) = Incidences::new(records, mode)? else {
        return Ok(None);
    };
    let Incidences { at, ref planes, ref thetas } = incidences;
    let all = || {
        let of_plane = |plane: Key| thetas.iter().map(move |&theta| (plane, theta));
        planes.iter().flat_map(move |&plane| of_plane(plane))
    };
    // First whether all of it can be used: that takes a moment, and lobes many.
    let is_isotropic = planes.len() == 1;
    for (plane, theta) in all() {
        let exits = incidences.exits(records, mode, plane, theta)?;
        // Along the normal an isotropic surface has the same in all azimuths.
        if !(is_isotropic && theta == 0) {
            exits.check_gaps(warnings)?;
        }
    }
    incidences.warn(warnings);
    let values: usize = all()
        .filter_map(|(plane, theta)| Some(records.count(records.beginning(mode, plane, theta)?)))
        .sum();
    let most = values.max(MIN_DIRECTIONS) / (planes.len() * thetas.len());
    let lobe = |(plane, theta)| {
        let exits = incidences.exits(records, mode, plane, theta)?;
        exits.lobe(most, N).ok_or_else(|| {
            ParseError::new(at, "exit directions that make no grid", "ascending angles")
        })
    };
    let lobes: Vec<Lobe> = all().map(lobe).collect::<Result<_, ParseError>>()?;
    let theta_rad: Vec<f64> = thetas.iter().map(|&theta| angle(theta).min(FRAC_PI_2)).collect();
    let phi_rad =
        if is_isotropic { vec![0.0] } else { planes.iter().copied().map(angle).collect() };
    let table = GriddedTable::new(theta_rad.clone(), phi_rad, theta_rad, lobes);
    table.map(Some).ok_or_else(|| {
        ParseError::new(at, "incident directions that make no grid", "ascending angles")
    })
}

impl Incidences {
    fn new<const N: usize>(
        records: &Records<N>,
        mode: ScatteringMode,
    ) -> Result<Option<Self>, ParseError> {
        let all = || records.incidences(mode);
        let Some(first) = all().map(|entry| entry.beginning.line).min() else {
            return Ok(None);
        };
        let at = Position { line: first, column: 1 };
        let sorted = |mut keys: Vec<Key>| {
            keys.sort_unstable();
            keys.dedup();
            keys
        };
        let tilted = || all().filter(|entry| entry.incidence.theta != 0);
        let mut planes = sorted(tilted().map(|entry| entry.incidence.plane).collect());
        let normal = records.beginning(mode, 0, 0);
        if let Some(normal) = normal.filter(|_| planes.is_empty()) {
            planes.push(normal.phi);
        }
        // Along the normal light belongs to all planes of incidence.
        let exits: usize = all().map(|entry| records.count(entry.beginning)).sum();
        let along_normal = normal.map_or(0, |normal| records.count(normal));
        if planes.len().saturating_mul(along_normal) > 4 * exits {
            let found = format!("{} incident azimuths with few lines each", planes.len());
            let expected = "a full grid of exits for each incident direction";
            return Err(ParseError::new(at, found, expected));
        }
        let thetas = sorted(all().map(|entry| entry.incidence.theta).collect());
        let rows = thetas.len() - usize::from(normal.is_some());
        if tilted().count() < rows * planes.len() {
            let found = format!("{} incident directions", all().count());
            let azimuths = planes.len();
            let expected = format!("{} polar angles for each of {azimuths} azimuths", thetas.len());
            return Err(ParseError::new(at, found, expected));
        }
        if thetas.len() * planes.len() > MAX_INCIDENCES {
            return Err(too_many(at));
        }
        Ok(Some(Self { at, planes, thetas }))
    }

    fn exits<const N: usize>(
        &self,
        records: &Records<N>,
        mode: ScatteringMode,
        plane: Key,
        theta: Key,
    ) -> Result<Exits<N>, ParseError> {
        let none = || ParseError::new(self.at, "a missing incidence", "all polar angles");
        let beginning: &Beginning = records.beginning(mode, plane, theta).ok_or_else(none)?;
        let turn = (theta == 0).then_some(plane);
        Exits::new(records.exits(beginning, turn), beginning.line)
    }

    /// Tells where incident directions are far apart.
    fn warn(&self, warnings: &mut Warnings) {
        let azimuths: Vec<f64> = self.planes.iter().map(|&plane| angle(plane)).collect();
        let widest_rad = gaps::around(&azimuths);
        if self.planes.len() > 1 {
            gaps::warn_of_incidence(widest_rad, self.at, warnings);
        }
        if let [only] = self.thetas[..] {
            let found =
                format!("one incident polar angle, {:.1} degrees", angle(only).to_degrees());
            let expected = "several (light from elsewhere is scattered as from there)";
            warnings.push(WarningKind::OneIncidence, self.at, found, expected);
        }
    }
}
