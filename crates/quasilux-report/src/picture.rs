//! The results as pictures: what [`quasilux_drawing`] is told of a grid and of a camera.

use crate::number::{among_others, brief, count, figure_text, shared_place};
use crate::plan::Lights;
use crate::{CameraReport, Figure, Report, SensorReport};
use quasilux_drawing::exr::{Channel, Layer, exr_bytes};
use quasilux_drawing::picture::{
    self, Caption, Cell, GridPicture, Image, LabelledImage, LuminancePicture,
};
use quasilux_scene::Scene;
use quasilux_transport::Pixel;
use std::ops::RangeInclusive;

/// What a picture is told beside the results.
#[derive(Clone, Copy, Debug)]
pub struct PictureOf<'a> {
    /// The scene of the results.
    pub scene: &'a Scene,
    /// What the project is called.
    pub title: &'a str,
}

/// The picture of a grid in false colours as a PNG file; `None` for a sensor that is not a grid.
///
/// The first edge of the rectangle runs to the right, the second one upward. What stands around the
/// grid, and the luminaires before it, are drawn over it. All grids of a report share one scale.
#[must_use]
pub fn false_colour_png(
    sensor: &SensorReport,
    report: &Report,
    of: PictureOf<'_>,
) -> Option<Vec<u8>> {
    let grid = sensor.grid?;
    let grids = report.sensors.iter().filter(|sensor| sensor.grid.is_some());
    let shared: Vec<Cell> = grids.clone().flat_map(cells).collect();
    let lights = Lights::new(of.scene);
    let mut method = method(report, &samples(sensor));
    if grids.count() > 1 {
        method.push_str(", one scale for all grids");
    }
    let drawing = picture::grid(&GridPicture {
        caption: Caption {
            title: &sensor.name,
            project: of.title,
            facts: &sensor_facts(sensor),
            method: &method,
            caution: caution(report, report.run.sensors_reached),
        },
        unit: "lx",
        origin_m: grid.origin.to_array(),
        u_m: grid.u.to_array(),
        v_m: grid.v.to_array(),
        counts: grid.counts,
        cells: &cells(sensor).collect::<Vec<_>>(),
        scale_cells: &shared,
        target: grid.target_lx,
        surroundings: lights.surroundings(of.scene),
    });
    Some(drawing.to_png(1.0))
}

fn cells(sensor: &SensorReport) -> impl Iterator<Item = Cell> + '_ {
    let cell = |figure: Figure| Cell { value: figure.value, half_width: figure.half_width };
    sensor.points.iter().map(move |point| cell(point.illuminance_lx))
}

/// The luminances of a camera in false colours as a PNG file.
#[must_use]
pub fn camera_false_colour_png(camera: &CameraReport, report: &Report) -> Vec<u8> {
    picture::luminance(&LuminancePicture {
        caption: Caption {
            title: &camera.name,
            project: "",
            facts: &camera_facts(camera),
            method: &method(report, &(camera.samples..=camera.samples)),
            caution: caution(report, camera.is_done),
        },
        resolution: camera.resolution,
        luminances_cd_m2: &luminances_cd_m2(&camera.pixels),
    })
    .to_png(1.0)
}

/// The picture of a camera as it would look on a screen, a PNG file. Luminances are relative to the
/// picture's own: two pictures cannot be compared by it.
#[must_use]
pub fn tone_mapped_png(camera: &CameraReport) -> Vec<u8> {
    picture::tone_mapped_png(&Image {
        resolution: camera.resolution,
        rgb: &rgb_cd_m2(&camera.pixels),
        luminance: &luminances_cd_m2(&camera.pixels),
    })
}

/// The picture of a camera as an OpenEXR file with the layers `rgb` (R, G, B; the first, so that
/// viewers show it), `luminance` (Y, which is 0.2126 R + 0.7152 G + 0.0722 B), `half_width` (Y:
/// half the width of the interval of the luminance, not a number where it is unknown) and `unseen`
/// (Y: luminance at most that no sample met, infinite where nothing is known, not a number of plain
/// paths), all in cd/m2.
#[must_use]
pub fn exr(camera: &CameraReport) -> Vec<u8> {
    let channel = |name: &'static str, value: fn(&Pixel) -> f32| Channel {
        name,
        values: camera.pixels.iter().map(value).collect(),
    };
    let layer = |name: &'static str, channels| Layer { name, unit: "cd/m2", channels };
    let rgb = vec![
        channel("R", |pixel| pixel.rgb_cd_m2[0]),
        channel("G", |pixel| pixel.rgb_cd_m2[1]),
        channel("B", |pixel| pixel.rgb_cd_m2[2]),
    ];
    let half_width = channel("Y", |pixel| pixel.half_width_cd_m2.unwrap_or(f32::NAN));
    let unseen = channel("Y", |pixel| pixel.unseen_cd_m2.unwrap_or(f32::NAN));
    let layers = vec![
        layer("rgb", rgb),
        layer("luminance", vec![channel("Y", |pixel| pixel.luminance_cd_m2)]),
        layer("half_width", vec![half_width]),
        layer("unseen", vec![unseen]),
    ];
    exr_bytes(camera.resolution, layers)
}

/// One picture of [`series_png`].
#[derive(Clone, Copy, Debug)]
pub struct SeriesPicture<'a> {
    /// Its heading.
    pub label: &'a str,
    /// Row by row from the top left corner.
    pub pixels: &'a [Pixel],
}

/// Pictures of one resolution in a row, each below its label, as a PNG file. All have the exposure
/// of the tone-mapped picture `exposure`; brighter pixels are white.
#[must_use]
pub fn series_png(
    resolution: [u32; 2],
    pictures: &[SeriesPicture<'_>],
    exposure: &[Pixel],
) -> Vec<u8> {
    let rgb: Vec<_> = pictures.iter().map(|picture| rgb_cd_m2(picture.pixels)).collect();
    let luminances: Vec<_> =
        pictures.iter().map(|picture| luminances_cd_m2(picture.pixels)).collect();
    let planes = rgb.iter().zip(&luminances);
    let labelled = pictures.iter().zip(planes).map(|(picture, (rgb, luminance))| LabelledImage {
        label: picture.label,
        image: Image { resolution, rgb, luminance },
    });
    let labelled: Vec<LabelledImage<'_>> = labelled.collect();
    picture::series(resolution, &labelled, &luminances_cd_m2(exposure)).to_png(1.0)
}

fn rgb_cd_m2(pixels: &[Pixel]) -> Vec<[f32; 3]> {
    pixels.iter().map(|pixel| pixel.rgb_cd_m2).collect()
}

fn luminances_cd_m2(pixels: &[Pixel]) -> Vec<f32> {
    pixels.iter().map(|pixel| pixel.luminance_cd_m2).collect()
}

/// The fewest and the most samples of a replicate at a point: converged points get no more.
fn samples(sensor: &SensorReport) -> RangeInclusive<u64> {
    let samples = || sensor.points.iter().map(|point| point.samples);
    samples().min().unwrap_or(0)..=samples().max().unwrap_or(0)
}

/// The summary of a sensor, each figure as one piece of text.
///
/// The smallest and the largest value are those of the cells that are marked, with the digits that
/// cells have, and then the interval of the true one, which is not symmetric about it.
fn sensor_facts(sensor: &SensorReport) -> Vec<String> {
    let values = || sensor.points.iter().filter_map(|point| point.illuminance_lx.value);
    let place = shared_place(values());
    let number = |x: f64| among_others(x, place);
    let extreme = |name: &str, of_cell: Option<f64>, figure: Figure| {
        let cell = of_cell.map_or_else(|| "-".to_owned(), number);
        let interval = match (figure.value, figure.half_width) {
            (Some(value), Some(half_width)) if half_width > 0.0 => {
                format!(" ({} to {})", number(value - half_width), number(value + half_width))
            }
            _ => String::new(),
        };
        format!("{name} {cell} lx{interval}")
    };
    let piece = |name: &str, figure: Figure, unit: &str| {
        format!("{name} {}{unit}", figure_text(figure).joined())
    };
    let summary = &sensor.summary;
    vec![
        piece("average", summary.average_lx, " lx"),
        extreme("minimum", values().reduce(f64::min), summary.minimum_lx),
        extreme("maximum", values().reduce(f64::max), summary.maximum_lx),
        piece("uniformity", summary.uniformity, ""),
    ]
}

/// The figures of a camera, each as one piece of text.
fn camera_facts(camera: &CameraReport) -> Vec<String> {
    let mut pieces = vec![format!("mean {} cd/m²", figure_text(camera.mean_cd_m2).joined())];
    if let Some(maximum) = camera.maximum_cd_m2 {
        pieces.push(format!("maximum {} cd/m²", brief(maximum, 4)));
    }
    if let Some(half_width) = camera.mean_half_width_cd_m2 {
        pieces.push(format!("one pixel ± {} cd/m² on average", brief(half_width, 2)));
    }
    pieces
}

/// How the values of a picture were made.
fn method(report: &Report, samples: &RangeInclusive<u64>) -> String {
    let run = &report.run;
    format!(
        "quasilux {}: {}, {}, {}, {} \u{d7} {} samples, {} % intervals",
        run.version,
        run.settings.estimator.name(),
        run.settings.sequence.name(),
        run.settings.randomization.name(),
        run.replicates,
        span(samples),
        brief(100.0 * run.settings.confidence, 4),
    )
}

/// What is to be said of values in a picture that `is_done` or not.
fn caution(report: &Report, is_done: bool) -> &'static str {
    if report.biased {
        "values may be biased beyond their intervals"
    } else if report.run.settings.rel_tol > 0.0 && !is_done {
        "stopped before the wanted tolerance was reached"
    } else {
        ""
    }
}

/// Both ends of the range, or the one number that both are.
fn span(samples: &RangeInclusive<u64>) -> String {
    let [fewest, most] = [samples.start(), samples.end()].map(|n| count(*n));
    if fewest == most { most } else { format!("{fewest} to {most}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::{office, picture};
    use quasilux_scene::Light;
    use quasilux_scene::light::PointLight;

    #[test]
    fn grids_have_pictures_and_points_have_none() {
        let report = office();
        let of = PictureOf { scene: &Scene::default(), title: "office" };
        assert!(false_colour_png(&report.sensors[0], &report, of).is_some());
        assert!(false_colour_png(&report.sensors[1], &report, of).is_none());
    }

    /// The picture of a grid changes with its target, with the values of other grids, whose scale
    /// it shares, and with what stands around.
    #[test]
    fn pictures_are_told_of_target_scale_and_surroundings() {
        let report = office();
        let scene = Scene::default();
        let png = |report: &Report, scene: &Scene| {
            false_colour_png(&report.sensors[0], report, PictureOf { scene, title: "office" })
        };
        let plain = png(&report, &scene);
        assert_eq!(png(&report, &scene), plain);
        let mut aimed = report.clone();
        aimed.sensors[0].grid.as_mut().expect("a grid").target_lx = Some(400.0);
        assert_ne!(png(&aimed, &scene), plain);
        let mut bright = report.clone();
        let mut other = report.sensors[0].clone();
        for point in &mut other.points {
            point.illuminance_lx.value = Some(2000.0);
        }
        bright.sensors.push(other);
        assert_ne!(png(&bright, &scene), plain);
        let mut lit = scene.clone();
        let position = report.sensors[0].points[0].position_m + glam::DVec3::Z;
        lit.lights.push(Light::Point(PointLight { position, intensity_cd: 100.0 }));
        assert_ne!(png(&report, &lit), plain);
    }

    /// The cell of the smallest value says 412, the middle of the interval of the true minimum is
    /// 411.4: the heading begins with the number of the cell.
    #[test]
    fn the_heading_has_the_numbers_of_the_cells() {
        let mut sensor = office().sensors[0].clone();
        for (k, point) in sensor.points.iter_mut().enumerate() {
            point.illuminance_lx.value = Some(411.51 + 100.0 * k as f64);
        }
        sensor.summary.minimum_lx = Figure { value: Some(411.4), half_width: Some(3.2) };
        let facts = sensor_facts(&sensor);
        assert_eq!(facts[1], "minimum 412 lx (408 to 415)");
        let most = 411.51 + 100.0 * (sensor.points.len() - 1) as f64;
        assert!(facts[2].starts_with(&format!("maximum {most:.0} lx")), "{}", facts[2]);
        sensor.summary.minimum_lx.half_width = None;
        assert_eq!(sensor_facts(&sensor)[1], "minimum 412 lx");
    }

    #[test]
    fn captions_say_how_the_values_were_made() {
        let mut report = office();
        let made = method(&report, &samples(&report.sensors[0]));
        assert!(made.ends_with("16 \u{d7} 65 536 samples, 95 % intervals"), "{made}");
        assert_eq!(span(&(128..=2048)), "128 to 2 048");
        assert_eq!(caution(&report, true), "");
        assert!(caution(&report, false).contains("tolerance"));
        report.biased = true;
        assert!(caution(&report, false).contains("biased"));
    }

    #[test]
    fn cameras_have_three_pictures() {
        let report = picture([4, 2], |x, _| if x == 0 { 20.0 } else { 4.0 });
        let camera = &report.cameras[0];
        let facts =
            ["mean 8.000 ± 0 cd/m²", "maximum 20 cd/m²", "one pixel ± 0.5 cd/m² on average"];
        assert_eq!(camera_facts(camera), facts);
        let png = [tone_mapped_png(camera), camera_false_colour_png(camera, &report)];
        assert!(png.iter().all(|file| file.starts_with(b"\x89PNG")));
        assert_eq!(exr(camera)[..4], 20_000_630_u32.to_le_bytes());
    }
}
