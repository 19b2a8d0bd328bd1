//! Validation cases: projects with known answers, as data (validation/README.md has the format).

use crate::exit::CliError;
use crate::input;
use quasilux_report::{Figure, Report, SensorReport};
use quasilux_scene::Position;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::Spanned;

/// One case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) source: String,
    /// Relative to the case's file.
    pub(crate) project: PathBuf,
    /// The project's own where empty.
    #[serde(default)]
    estimators: Vec<String>,
    /// The tolerance of the project, in place of its own, by the estimator.
    #[serde(default)]
    pub(crate) rel_tol: BTreeMap<String, f64>,
    pub(crate) expect: Vec<Spanned<Expectation>>,
    /// Where each of them stands.
    #[serde(skip)]
    places: Vec<Position>,
}

/// One expected figure.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expectation {
    /// All but a flux.
    #[serde(default)]
    sensor: Option<String>,
    /// Grids that a flux lands on.
    #[serde(default)]
    sensors: Vec<String>,
    figure: FigureName,
    /// Of an indirect flux: what comes straight from the lights and is taken off.
    direct_lm: Option<f64>,
    /// Every point where not given.
    point: Option<usize>,
    value: Option<f64>,
    /// In place of `value` and `point`: one value a point.
    #[serde(default)]
    values: Vec<f64>,
    /// Allowed beyond the interval, as a share of `value`.
    tolerance_rel: f64,
    pub(crate) why: String,
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
enum FigureName {
    IlluminanceLx,
    DirectLx,
    IndirectLx,
    AverageLx,
    MinimumLx,
    MaximumLx,
    Uniformity,
    FluxLm,
    IndirectFluxLm,
}

/// What came of one expectation.
pub(crate) struct Verdict {
    /// What was looked at, like `floor[3] illuminance_lx`.
    pub(crate) what: String,
    pub(crate) expected: f64,
    pub(crate) got: Figure,
    pub(crate) holds: bool,
    pub(crate) why: String,
}

/// An expectation and its place in the file of its case.
pub(crate) struct PlacedExpectation<'a> {
    pub(crate) expectation: &'a Expectation,
    pub(crate) place: Position,
}

/// Where a byte of a text stands.
fn place(text: &str, offset: usize) -> Position {
    let before = text.get(..offset).unwrap_or(text);
    let line = before.rsplit('\n').next().unwrap_or_default();
    Position { line: before.matches('\n').count() + 1, column: line.chars().count() + 1 }
}

impl Case {
    /// Reads a case.
    pub(crate) fn read(path: &Path) -> Result<Self, CliError> {
        let refuse =
            |error: &dyn std::fmt::Display| CliError::new(format!("{}: {error}", path.display()));
        let bytes = input::read(path, input::MAX_PROJECT_BYTES).map_err(|error| refuse(&error))?;
        let text = std::str::from_utf8(&bytes).map_err(|error| {
            let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
            let place = place(&valid, valid.len());
            CliError::in_file(path.display(), Some(place), "not UTF-8 text")
        })?;
        let mut case: Self = toml::from_str(text).map_err(|error| {
            let place = error.span().map(|span| place(text, span.start));
            CliError::in_file(path.display(), place, error.message().replace('\n', "; "))
        })?;
        case.places = case.expect.iter().map(|it| place(text, it.span().start)).collect();
        if case.expect.is_empty() {
            return Err(refuse(&"a case expects at least one value"));
        }
        if let Some(name) = case.rel_tol.keys().find(|name| !case.estimators.contains(name)) {
            return Err(refuse(&format!("rel_tol of {name:?}, which is none of the estimators")));
        }
        case.project = path.parent().unwrap_or(Path::new("")).join(case.project);
        Ok(case)
    }

    /// What it expects, and where that stands in its file.
    pub(crate) fn expectations(&self) -> impl Iterator<Item = PlacedExpectation<'_>> {
        let pairs = self.expect.iter().zip(&self.places);
        pairs.map(|(it, place)| PlacedExpectation { expectation: it.get_ref(), place: *place })
    }

    /// The estimators to try; `None` is the project's own.
    pub(crate) fn estimators(&self) -> Vec<Option<String>> {
        match self.estimators.as_slice() {
            [] => vec![None],
            names => names.iter().cloned().map(Some).collect(),
        }
    }
}

impl Expectation {
    /// Judges a report; one verdict a point.
    pub(crate) fn judge(&self, report: &Report) -> Result<Vec<Verdict>, CliError> {
        let direct_lm = match (self.figure, self.direct_lm) {
            (FigureName::FluxLm, None) => Some(0.0),
            (FigureName::IndirectFluxLm, Some(direct_lm)) => Some(direct_lm),
            (FigureName::IndirectFluxLm, None) | (_, Some(_)) => {
                return Err(CliError::new(
                    "an `indirect_flux_lm`, and nothing else, has `direct_lm`",
                ));
            }
            _ => None,
        };
        match (&self.sensor, self.sensors.as_slice(), direct_lm) {
            (None, [_, ..], Some(direct_lm)) => {
                let expected_lm = self.one_value()?;
                let grids = self.sensors.iter().map(|name| sensor(report, name));
                let Figure { value, half_width } = flux_lm(&grids.collect::<Result<Vec<_>, _>>()?)?;
                let flux_lm = Figure { value: value.map(|all_lm| all_lm - direct_lm), half_width };
                Ok(vec![self.verdict(self.sensors.join(" + "), expected_lm, flux_lm)])
            }
            (Some(name), [], None) => self.judge_sensor(sensor(report, name)?),
            _ => Err(CliError::new(
                "an expectation has one `sensor`; one of `flux_lm` or `indirect_flux_lm` has \
                 `sensors`, a list of grids",
            )),
        }
    }

    fn judge_sensor(&self, sensor: &SensorReport) -> Result<Vec<Verdict>, CliError> {
        let points = match (self.figure.is_of_points(), self.point) {
            (false, None) => {
                let (name, got) = (sensor.name.clone(), self.summary_figure(sensor));
                return Ok(vec![self.verdict(name, self.one_value()?, got)]);
            }
            (false, Some(_)) => {
                return Err(CliError::new("a summary figure has no point"));
            }
            (true, None) => 0..sensor.points.len(),
            (true, Some(point)) if point < sensor.points.len() => point..point + 1,
            (true, Some(point)) => {
                let message = format!("sensor \"{}\" has no point {point}", sensor.name);
                return Err(CliError::new(message));
            }
        };
        let verdict = |point: usize| {
            let value = match self.values.get(point) {
                Some(value) => *value,
                None => self.one_value()?,
            };
            let place = format!("{}[{point}]", sensor.name);
            Ok(self.verdict(place, value, self.point_figure(sensor, point)))
        };
        if !self.values.is_empty() && (points.len(), points.start) != (self.values.len(), 0) {
            return Err(CliError::new(format!(
                "`values` has {} of the {} points of sensor \"{}\", and no `point` beside it",
                self.values.len(),
                sensor.points.len(),
                sensor.name
            )));
        }
        points.map(verdict).collect()
    }

    /// The value that holds for all that is looked at.
    fn one_value(&self) -> Result<f64, CliError> {
        self.value.filter(|_| self.values.is_empty()).ok_or_else(|| {
            CliError::new("an expectation has a `value`, or `values` of the points of a sensor")
        })
    }

    /// Of a figure at `place`.
    fn verdict(&self, place: String, expected: f64, got: Figure) -> Verdict {
        let is_exact = self.figure == FigureName::DirectLx;
        let holds = match (got.value, if is_exact { Some(0.0) } else { got.half_width }) {
            (Some(value), Some(half_width)) => {
                (value - expected).abs() <= half_width + self.tolerance_rel * expected.abs()
            }
            // Where no light was found there is no interval, and none was expected.
            (Some(value), None) => value == 0.0 && expected == 0.0,
            (None, _) => false,
        };
        Verdict {
            what: format!("{place} {}", self.figure.name()),
            expected,
            got,
            holds,
            why: self.why.clone(),
        }
    }

    fn point_figure(&self, sensor: &SensorReport, point: usize) -> Figure {
        let point = &sensor.points[point];
        match self.figure {
            FigureName::DirectLx => Figure { value: point.direct_lx, half_width: None },
            FigureName::IndirectLx => {
                let Figure { value, half_width } = point.illuminance_lx;
                let indirect_lx =
                    value.zip(point.direct_lx).map(|(all_lx, direct_lx)| all_lx - direct_lx);
                Figure { value: indirect_lx, half_width }
            }
            _ => point.illuminance_lx,
        }
    }

    fn summary_figure(&self, sensor: &SensorReport) -> Figure {
        match self.figure {
            FigureName::MinimumLx => sensor.summary.minimum_lx,
            FigureName::MaximumLx => sensor.summary.maximum_lx,
            FigureName::Uniformity => sensor.summary.uniformity,
            _ => sensor.summary.average_lx,
        }
    }
}

impl FigureName {
    fn is_of_points(self) -> bool {
        matches!(self, Self::IlluminanceLx | Self::DirectLx | Self::IndirectLx)
    }

    fn name(self) -> &'static str {
        match self {
            Self::IlluminanceLx => "illuminance_lx",
            Self::DirectLx => "direct_lx",
            Self::IndirectLx => "indirect_lx",
            Self::AverageLx => "average_lx",
            Self::MinimumLx => "minimum_lx",
            Self::MaximumLx => "maximum_lx",
            Self::Uniformity => "uniformity",
            Self::FluxLm => "flux_lm",
            Self::IndirectFluxLm => "indirect_flux_lm",
        }
    }
}

fn sensor<'a>(report: &'a Report, name: &str) -> Result<&'a SensorReport, CliError> {
    let sensor = report.sensors.iter().find(|sensor| sensor.name == name);
    sensor.ok_or_else(|| CliError::new(format!("no sensor \"{name}\" in the project")))
}

/// The flux that lands on grids: average times area. Half-widths are added, as if all errors came
/// together.
fn flux_lm(sensors: &[&SensorReport]) -> Result<Figure, CliError> {
    let mut flux_lm = Figure { value: Some(0.0), half_width: Some(0.0) };
    for sensor in sensors {
        let grid = sensor.grid.ok_or_else(|| {
            CliError::new(format!("a flux lands on grids, and sensor \"{}\" is none", sensor.name))
        })?;
        let area_m2 = grid.u.cross(grid.v).length();
        let add = |sum: Option<f64>, lx: Option<f64>| Some(sum? + lx? * area_m2);
        let average_lx = sensor.summary.average_lx;
        flux_lm = Figure {
            value: add(flux_lm.value, average_lx.value),
            half_width: add(flux_lm.half_width, average_lx.half_width),
        };
    }
    Ok(flux_lm)
}
