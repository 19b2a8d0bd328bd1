//! The result document, format "quasilux-result/1": the form that other programs rely on.
//!
//! The order of keys is fixed and numbers are the shortest that read back exactly, so two runs of
//! one project write the same bytes but for what is called `seconds`, `threads` or `bytes`. Unknown
//! figures are `null`. Beyond the agreed keys the document says, at the top, whether values may be
//! `biased`; in a grid sensor its `counts` along u and v; where terms of the Neumann series are
//! listed, `terms_lx` in each point and `average_terms_lx` in each summary, the last of them with
//! `"bounces": "rest"`; in `cameras` the files of each camera, the paths of each pixel in each
//! replicate (`samples`) and the figures of its picture; and in `run` the rest of what makes a run
//! repeatable: `build`, `scene_sha256`, and all [`Settings`] by the names of their fields, but for
//! limits: a run that was stopped at some number of samples writes what one that was asked for this
//! number writes. `replicates` counts those that differ. `seconds` are those of the whole run,
//! `earlier` says how many of them it took before it was resumed, and `maintenance_factor` what all
//! lights were dimmed by. Beside each value stands what its samples leave open, `null` of
//! estimators without a bound and where nothing is known: `unseen_lx`, the light at most that no
//! sample met, with `unseen_confidence`, `merged_lx`, the part of the value that is known as a mean
//! over a disc of `disc_radius_m` around the point; `unseen_tol` is a share or "off", and
//! `cannot_see` has the classes of light paths that the estimator cannot make. Where they were
//! asked for, points and averages have `certified_lx`, limits that hold for any number of samples.
//! Then `decisions`, what pilots made of the settings (photons connected for each path
//! (`connected_photons`), whether photons follow `importance` and leave lit places, sides of
//! elements of the map that paths end on, photons for each path that look for light which paths
//! cannot find; `null` where there are none), `prediction` (see `prediction.rs`), `flux_cut_lm`,
//! the flux that `max_bounces` cut, and `dimension_counts`: how many photons and paths used 0, 1,
//! 2, .. coordinates, in one list each, all of more than 1023 together at its end, `photons`, how
//! many began in all, `null` where none did, and `mean_events`, surfaces that a `photon` came to on
//! average. A point that reached its tolerance before others has its own number of `samples`. Where
//! there is a tolerance, `status` says whether a point is "done", or what is missing: its
//! "half_width", the bound on "unseen" light, the "average" of its sensor, any light at all
//! ("dark"), more of light that is rare and bright ("rare_light"), or more samples ("few_samples").
//! Where the sky shines, `outside` has its horizontal illuminance, and where nothing else does each
//! point its `daylight_factor`, a share; beside openings in its parts, `sky_component`,
//! `externally_reflected_component` and `internally_reflected_component`, the first two with what
//! no path met of each at most (`components_unseen`). Where it was asked for, `explain` says which
//! coordinates carry the variance. `findings` are what is probably wrong with the scene, each with
//! the `check` that found it, place and `cure`; `caveats` what to know of the values, each with its
//! `kind` and figures; `warnings` have both as text, too.

mod camera;
mod caveat;
mod explanation;
mod finding;
mod layout;
mod prediction;
mod terms;
mod unseen;

use crate::outside::DaylightColumn;
use crate::{CertifiedFigure, DaylightFactor, Figure, Outside, Report, Run, SensorReport};
pub use finding::FindingEntry;

use camera::CameraEntry;
use caveat::CaveatEntry;
use explanation::ExplanationEntry;
use layout::Layout;
use prediction::PredictionEntry;
use quasilux_transport::unseen::UNSEEN_CONFIDENCE;
use quasilux_transport::{Decisions, DimensionHistogram, Dimensions, PointStatus, Settings};
use serde::Serialize;
use serde_json::{Map, Value, json};
use terms::TermEntry;
use unseen::{BoundedEntry, UnseenEntry};

/// Name and version of the document's format.
pub const FORMAT: &str = "quasilux-result/1";

/// The result document, one line a sensor point, ending in a line feed.
#[must_use]
pub fn json(report: &Report) -> String {
    text(&Document::new(report))
}

/// Any document in the same layout: outer levels indented, inner ones on one line. What is not
/// finite is written as `null`.
///
/// # Panics
/// When the document has a map whose keys are not strings.
#[must_use]
pub fn text(document: &impl Serialize) -> String {
    let mut bytes = Vec::new();
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, Layout::default());
    document.serialize(&mut serializer).expect("a document has strings as keys");
    bytes.push(b'\n');
    String::from_utf8(bytes).expect("JSON is UTF-8")
}

#[derive(Serialize)]
struct Document<'a> {
    format: &'static str,
    biased: bool,
    sensors: Vec<SensorEntry<'a>>,
    cameras: Vec<CameraEntry<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    outside: Option<OutsideEntry>,
    run: RunEntry<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    explain: Option<ExplanationEntry<'a>>,
    findings: Vec<FindingEntry<'a>>,
    caveats: Vec<CaveatEntry>,
    warnings: &'a [String],
}

#[derive(Serialize)]
struct SensorEntry<'a> {
    name: &'a str,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<[u32; 2]>,
    points: Vec<PointEntry>,
    summary: SummaryEntry,
}

#[derive(Serialize)]
struct PointEntry {
    position: [f64; 3],
    normal: [f64; 3],
    illuminance_lx: Option<f64>,
    half_width_lx: Option<f64>,
    direct_lx: Option<f64>,
    #[serde(flatten)]
    unseen: UnseenEntry,
    #[serde(skip_serializing_if = "Option::is_none")]
    certified_lx: Option<CertifiedFigure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    status: Option<PointStatus>,
    #[serde(flatten)]
    daylight: Map<String, Value>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<u64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    terms_lx: Vec<TermEntry>,
}

#[derive(Serialize)]
struct SummaryEntry {
    average_lx: BoundedEntry,
    minimum_lx: BoundedEntry,
    maximum_lx: BoundedEntry,
    uniformity: FigureEntry,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    average_terms_lx: Vec<TermEntry>,
}

#[derive(Serialize)]
struct FigureEntry {
    value: Option<f64>,
    half_width: Option<f64>,
}

#[derive(Serialize)]
struct RunEntry<'a> {
    version: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    build: &'a str,
    #[serde(skip_serializing_if = "str::is_empty")]
    scene_sha256: &'a str,
    #[serde(flatten)]
    settings: Settings,
    samples: u64,
    rays: u64,
    seconds: f64,
    earlier: EarlierEntry,
    threads: usize,
    maintenance_factor: f64,
    tolerance_reached: bool,
    unseen_confidence: f64,
    cannot_see: &'a [String],
    prediction: PredictionEntry,
    decisions: DecisionsEntry,
    mean_dimension: MeanDimensionEntry,
    dimension_counts: DimensionCountsEntry<'a>,
    photons: Option<u64>,
    mean_events: MeanEventsEntry,
    flux_emitted_lm: f64,
    flux_absorbed_lm: f64,
    flux_lost_lm: f64,
    flux_cut_lm: f64,
    invalid_contributions: u64,
}

/// What shines from outside.
#[derive(Serialize)]
struct OutsideEntry {
    horizontal_illuminance_lx: f64,
}

/// What of the run was done before it was gone on with.
#[derive(Serialize)]
struct EarlierEntry {
    seconds: f64,
}

/// What `auto` came to, as in a plan.
#[derive(Serialize)]
struct DecisionsEntry {
    connected_photons: Option<u64>,
    importance: bool,
    first_shot: bool,
    map_elements: Option<u64>,
    caustic_photons: Option<u64>,
}

#[derive(Serialize)]
struct MeanDimensionEntry {
    photon: Option<f64>,
    path: Option<f64>,
}

/// Surfaces on the way of a photon, on average.
#[derive(Serialize)]
struct MeanEventsEntry {
    photon: Option<f64>,
}

/// How many photons and paths used 0, 1, 2, .. coordinates.
#[derive(Serialize)]
struct DimensionCountsEntry<'a> {
    photon: &'a [u64],
    path: &'a [u64],
}

impl<'a> Document<'a> {
    fn new(report: &'a Report) -> Self {
        Self {
            format: FORMAT,
            biased: report.biased,
            sensors: report.sensors.iter().map(|s| SensorEntry::new(s, report)).collect(),
            cameras: report.cameras.iter().map(CameraEntry::new).collect(),
            outside: report.outside.map(OutsideEntry::new),
            run: RunEntry::new(&report.run),
            explain: report.explanation.as_ref().map(ExplanationEntry::new),
            findings: report.findings.iter().map(FindingEntry::new).collect(),
            caveats: report.caveats.iter().map(CaveatEntry::new).collect(),
            warnings: &report.warnings,
        }
    }
}

impl<'a> SensorEntry<'a> {
    fn new(sensor: &'a SensorReport, report: &Report) -> Self {
        let points = (0..sensor.points.len()).map(|p| PointEntry::new(sensor, p, report));
        Self {
            name: &sensor.name,
            kind: if sensor.grid.is_some() { "grid" } else { "points" },
            counts: sensor.grid.map(|grid| grid.counts),
            points: points.collect(),
            summary: SummaryEntry::new(sensor),
        }
    }
}

impl DecisionsEntry {
    fn new(decisions: &Decisions) -> Self {
        let Decisions {
            connected_photons,
            uses_importance: importance,
            first_shot,
            map_elements,
            caustic_photons,
            digest: _,
        } = *decisions;
        Self { connected_photons, importance, first_shot, map_elements, caustic_photons }
    }
}

impl PointEntry {
    fn new(sensor: &SensorReport, number: usize, report: &Report) -> Self {
        let point = &sensor.points[number];
        Self {
            position: point.position_m.to_array(),
            normal: point.normal.to_array(),
            illuminance_lx: point.illuminance_lx.value,
            half_width_lx: point.illuminance_lx.half_width,
            direct_lx: point.direct_lx,
            unseen: UnseenEntry::new(point.unseen),
            certified_lx: point.certified_lx,
            status: point.status,
            daylight: point.daylight_factor.map(daylight).unwrap_or_default(),
            samples: Some(point.samples).filter(|samples| *samples != report.run.samples),
            terms_lx: TermEntry::all(&sensor.terms, |term| term.points_lx[number]),
        }
    }
}

/// A daylight factor and its parts, each with the half-width.
fn daylight(factor: DaylightFactor) -> Map<String, Value> {
    let mut entries = Map::new();
    for DaylightColumn { name, figure: Figure { value, half_width } } in factor.columns() {
        entries.insert(name.to_owned(), json!(value));
        entries.insert(format!("{name}_half_width"), json!(half_width));
    }
    if let Some(components) = factor.components {
        entries.insert("components_unseen".to_owned(), json!(components.unseen));
    }
    entries
}

impl OutsideEntry {
    fn new(outside: Outside) -> Self {
        let Outside { horizontal_illuminance_lx, is_sky_alone: _ } = outside;
        Self { horizontal_illuminance_lx }
    }
}

impl FigureEntry {
    fn new(figure: Figure) -> Self {
        Self { value: figure.value, half_width: figure.half_width }
    }
}

impl SummaryEntry {
    fn new(sensor: &SensorReport) -> Self {
        let summary = &sensor.summary;
        let unseen = summary.unseen.unwrap_or_default();
        let entry = BoundedEntry::new;
        Self {
            average_lx: entry(summary.average_lx, unseen.average_lx)
                .with_certified(summary.certified_average_lx),
            minimum_lx: entry(summary.minimum_lx, unseen.minimum_lx),
            maximum_lx: entry(summary.maximum_lx, unseen.maximum_lx),
            uniformity: FigureEntry::new(summary.uniformity),
            average_terms_lx: TermEntry::all(&sensor.terms, |term| term.average_lx),
        }
    }
}

impl<'a> RunEntry<'a> {
    fn new(run: &'a Run) -> Self {
        Self {
            version: &run.version,
            build: &run.build,
            scene_sha256: &run.scene_sha256,
            settings: Settings {
                replicates: run.replicates,
                max_samples: None,
                max_rays: None,
                ..run.settings.clone()
            },
            samples: run.samples,
            rays: run.rays,
            seconds: run.seconds,
            earlier: EarlierEntry { seconds: run.earlier_seconds },
            threads: run.threads,
            maintenance_factor: run.maintenance_factor,
            tolerance_reached: run.tolerance_reached,
            unseen_confidence: UNSEEN_CONFIDENCE,
            cannot_see: &run.cannot_see,
            prediction: PredictionEntry::new(run),
            decisions: DecisionsEntry::new(&run.decisions),
            mean_dimension: MeanDimensionEntry {
                photon: mean(&run.dimensions.photon),
                path: mean(&run.dimensions.path),
            },
            dimension_counts: DimensionCountsEntry {
                photon: run.dimensions.photon.counts(),
                path: run.dimensions.path.counts(),
            },
            photons: Some(run.dimensions.photons).filter(|photons| *photons > 0),
            mean_events: MeanEventsEntry { photon: mean_events(&run.dimensions) },
            flux_emitted_lm: run.flux.emitted_lm,
            flux_absorbed_lm: run.flux.absorbed_lm,
            flux_lost_lm: run.flux.lost_lm,
            flux_cut_lm: run.flux.cut_lm,
            invalid_contributions: run.invalid_contributions,
        }
    }
}

/// The mean number of coordinates; `None` where nothing was traced.
fn mean(dimensions: &DimensionHistogram) -> Option<f64> {
    (dimensions.samples() > 0).then(|| dimensions.mean())
}

fn mean_events(dimensions: &Dimensions) -> Option<f64> {
    let Dimensions { photons, photon_events, .. } = *dimensions;
    (photons > 0).then(|| photon_events as f64 / photons as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;
    use serde_json::Value;

    /// The keys of the first occurrence of each object, in the order in which they are written.
    fn assert_order(text: &str, keys: &[&str]) {
        let mut from = 0;
        for key in keys {
            let key = format!("\"{key}\":");
            let at = text[from..].find(&key).unwrap_or_else(|| panic!("{key} after {from}"));
            from += at + key.len();
        }
    }

    #[test]
    fn keys_and_their_order() {
        let text = json(&example::office());
        assert_order(&text, &["format", "biased", "sensors", "cameras", "run", "warnings"]);
        assert_order(&text, &["name", "kind", "counts", "points", "summary"]);
        let point = ["position", "normal", "illuminance_lx", "half_width_lx", "direct_lx"];
        assert_order(&text, &point);
        assert_order(&text, &["average_lx", "minimum_lx", "maximum_lx", "uniformity"]);
        let run = &text[text.find("\"run\"").expect("a run")..];
        assert_order(run, &["version", "estimator", "sequence", "confidence", "replicates"]);
        assert_order(run, &["replicates", "samples", "rays", "seconds", "earlier", "seconds"]);
        assert_order(run, &["earlier", "threads", "maintenance_factor", "tolerance_reached"]);
        assert_order(run, &["threads", "tolerance_reached", "prediction", "decisions"]);
        assert_order(run, &["tolerance_reached", "mean_dimension", "photon", "path"]);
        assert_order(run, &["path", "flux_emitted_lm", "flux_absorbed_lm", "flux_lost_lm"]);
        assert_order(run, &["flux_lost_lm", "flux_cut_lm", "invalid_contributions"]);
    }

    #[test]
    fn every_number_reads_back_exactly() {
        let report = example::office();
        let document: Value = serde_json::from_str(&json(&report)).expect("valid JSON");
        assert_eq!(document["format"], FORMAT);
        let sensor = &document["sensors"][0];
        assert_eq!(sensor["kind"], "grid");
        for (entry, point) in
            sensor["points"].as_array().expect("points").iter().zip(&report.sensors[0].points)
        {
            assert_eq!(entry["illuminance_lx"].as_f64(), point.illuminance_lx.value);
            assert_eq!(entry["half_width_lx"].as_f64(), point.illuminance_lx.half_width);
            assert_eq!(entry["position"][1].as_f64(), Some(point.position_m.y));
        }
        let average = &sensor["summary"]["average_lx"];
        assert_eq!(average["value"].as_f64(), report.sensors[0].summary.average_lx.value);
        assert_eq!(document["run"]["replicates"], 16);
        assert_eq!(document["run"]["scene_sha256"], "c0ffee");
        assert_eq!(document["run"]["mean_dimension"]["photon"], 3.0);
        assert_eq!(document["run"]["mean_dimension"]["path"], Value::Null);
        assert_eq!(document["run"]["mean_events"]["photon"], 2.0);
        assert_eq!(document["run"]["photons"], 3);
        let counts = serde_json::json!({"photon": [0, 0, 2, 0, 0, 1], "path": []});
        assert_eq!(document["run"]["dimension_counts"], counts);
        assert_eq!(document["run"]["max_bounces"], Value::Null);
        assert_eq!(document["warnings"], serde_json::json!(["a \"quoted\" warning"]));
    }

    #[test]
    fn one_line_a_point() {
        let report = example::office();
        let text = json(&report);
        let lines = text.lines().filter(|l| l.trim_start().starts_with("{\"position\": [")).count();
        assert_eq!(lines, report.sensors[0].points.len() + report.sensors[1].points.len());
        assert!(text.ends_with("}\n"));
    }

    #[test]
    fn nothing_infinite_is_written() {
        let mut report = example::noiseless(&[f64::NAN, f64::INFINITY, 1.0]);
        report.run.seconds = f64::NAN;
        let document: Value = serde_json::from_str(&json(&report)).expect("valid JSON");
        let sensor = &document["sensors"][0];
        assert_eq!(sensor["points"][0]["illuminance_lx"], Value::Null);
        assert_eq!(sensor["points"][1]["illuminance_lx"], Value::Null);
        assert_eq!(sensor["points"][2]["illuminance_lx"], 1.0);
        assert_eq!(sensor["summary"]["average_lx"]["value"], Value::Null);
        assert_eq!(document["run"]["seconds"], Value::Null);
        let caveat = &document["caveats"][0];
        assert_eq!(
            (&caveat["kind"], &caveat["sensor"]),
            (&"no_finite_value".into(), &"desk".into())
        );
        assert_eq!(document["warnings"][0], caveat["message"]);
    }

    #[test]
    fn without_replicates_half_widths_are_null() {
        let document: Value =
            serde_json::from_str(&json(&example::without_intervals())).expect("valid JSON");
        let sensor = &document["sensors"][0];
        assert_eq!(sensor["kind"], "points");
        assert_eq!(sensor["points"][0]["half_width_lx"], Value::Null);
        assert_eq!(sensor["summary"]["average_lx"]["half_width"], Value::Null);
        assert!(sensor.get("counts").is_none());
    }
}
