//! The figures as a table for programs and as two for people, with what is seen in them.

use super::Findings;
use super::curve::{Curve, Stop};
use super::limit::{LEVELS, Part};
use super::paper::{INDIRECT_LX, TABLE, TOTAL_LX};
use super::sphere::{
    INTENSITY_CD, LIGHT_M, REFLECTANCE, direct_in_the_middle_lx, direct_lx, indirect_lx,
};
use crate::claim::Claim;
use crate::contrast::Contrast;
use crate::course::mean_interval;
use glam::DVec3;
use quasilux_report::number::{count, exact};
use quasilux_transport::Interval;
use std::fmt::Write;

const COLUMNS: &str = "kind,method,part,place,facets_along_edge,samples,randomisations,seconds,\
    value_lx,half_width_lx,reference_lx,relative_error,relative_bias,left_lx,exponent,\
    gain_of_points,gain_of_points_t\n";

/// One line for each value on each mesh and on the sphere, the order, each point of each curve, and
/// what the paper prints.
pub(super) fn csv(findings: &Findings) -> String {
    let mut text = COLUMNS.to_owned();
    let ladder = &findings.ladder;
    for place in 0..ladder.octants[0].places.len() {
        for part in Part::ALL {
            for level in 0..LEVELS {
                value_line(&mut text, findings, &Value { part, place, level: Some(level) });
            }
            value_line(&mut text, findings, &Value { part, place, level: None });
        }
    }
    let order = ladder.order(Part::Indirect);
    writeln!(
        text,
        "order,bidirectional,indirect,all,,,,,,{},,,,,{},,",
        half_width(order),
        exact(order.value)
    )
    .expect("strings grow");
    for curve in &findings.curves {
        for stop in &curve.stops {
            error_line(&mut text, findings, curve, stop);
        }
    }
    for line in &TABLE {
        for (method, lx, error) in [
            ("pseudo", line.pseudo_lx, line.pseudo_error()),
            ("quasi", line.quasi_lx, line.quasi_error()),
        ] {
            let (seconds, lx, error) = (exact(line.seconds), exact(lx), exact(error));
            let reference = exact(TOTAL_LX);
            writeln!(
                text,
                "paper,{method},total,middle,,,1,{seconds},{lx},,{reference},{error},,,,,"
            )
            .expect("strings grow");
        }
    }
    text
}

/// A value on the mesh of a level, or on the sphere without one.
struct Value {
    part: Part,
    place: usize,
    level: Option<usize>,
}

fn value_line(text: &mut String, findings: &Findings, value: &Value) {
    let ladder = &findings.ladder;
    let Value { part, place, level: mesh } = *value;
    let (kind, values) = match mesh {
        Some(level) => ("mesh", ladder.on_mesh(level, part, place)),
        None => ("sphere", ladder.on_sphere(part, place)),
    };
    let level = mesh.unwrap_or(LEVELS - 1);
    let found = mean_interval(&values);
    let reference = reference_lx(part, ladder.octants[level].places[place], mesh.is_none());
    let error = reference.map(|lx| exact((found.value / lx - 1.0).abs())).unwrap_or_default();
    let left = if mesh.is_none() { exact(ladder.left_lx(part, place)) } else { String::new() };
    writeln!(
        text,
        "{kind},bidirectional,{},{},{},{},{},,{},{},{},{error},,{left},,,",
        part.name(),
        place_name(findings, place),
        mesh.map(|level| ladder.octants[level].n.to_string()).unwrap_or_default(),
        ladder.courses[level].last().samples,
        values.len(),
        exact(found.value),
        half_width(found),
        reference.map(exact).unwrap_or_default(),
    )
    .expect("strings grow");
}

/// The gain by its points stands with the curve of Halton's.
fn error_line(text: &mut String, findings: &Findings, curve: &Curve, stop: &Stop) {
    let is_halton = curve.name == findings.curves[1].name;
    let gain = gain_at(findings, stop.samples).filter(|_| is_halton);
    let gain = gain.map(|gain| format!("{},{}", exact(gain.ratio), exact(gain.t())));
    let gain = gain.unwrap_or_else(|| ",".to_owned());
    let found = mean_interval(&stop.lx);
    let slope = curve.slope.map(exact).unwrap_or_default();
    writeln!(
        text,
        "error,\"{}\",total,middle,,{},{},{},{},{},{},{},{},,{slope},{gain}",
        curve.name,
        stop.samples,
        stop.lx.len(),
        exact(stop.seconds),
        exact(found.value),
        half_width(found),
        exact(TOTAL_LX),
        exact(stop.error()),
        exact(stop.bias()),
    )
    .expect("strings grow");
}

/// The closed form at a place of a mesh; on the sphere only that in the middle has a direct part,
/// for others move from mesh to mesh.
fn reference_lx(part: Part, place: DVec3, is_sphere: bool) -> Option<f64> {
    let is_fixed = !is_sphere || (place - super::sphere::diagonal()).length() < 1e-9;
    match part {
        Part::Indirect => Some(indirect_lx()),
        Part::Direct => is_fixed.then(|| direct_lx(place)),
        Part::Total => is_fixed.then(|| direct_lx(place) + indirect_lx()),
    }
}

fn place_name(findings: &Findings, place: usize) -> String {
    if place == findings.ladder.octants[0].middle { "middle".to_owned() } else { place.to_string() }
}

fn half_width(interval: Interval) -> String {
    interval.half_width.map(exact).unwrap_or_default()
}

/// The tables, and what they say.
pub(super) fn markdown(findings: &Findings, claims: &[Claim]) -> String {
    let samples = findings.ladder.courses.each_ref().map(|course| course.last().samples);
    let samples = samples.into_iter().min().unwrap_or(0);
    let randomisations = findings.curves[0].last().lx.len();
    let mut text = format!(
        "# The mirror octant (table 3)\n\n\
         One eighth of a diffuse unit sphere between three mirrors. The paper does not give its \
         light. Ours is a reconstruction: reflectance {REFLECTANCE}, one isotropic point of \
         {INTENSITY_CD} cd at {LIGHT_M} m along each axis. Its eight images give {:.3} lx at the \
         place in the middle of the sphere, and {:.3} lx are reflected there and everywhere else; \
         the paper prints {TOTAL_LX} lx and {INDIRECT_LX} lx.\n\n\
         ## The values\n\n\
         Bidirectional, {} paths for each place and as many photons in each of {randomisations} \
         randomisations, on meshes of n facets along an edge, and the limit on the sphere; 95 % \
         intervals.\n\n",
        direct_in_the_middle_lx(),
        indirect_lx(),
        count(samples),
    );
    text.push_str(&values(findings));
    text.push_str(&errors(findings, randomisations));
    text.push_str(&Claim::markdown(claims));
    text
}

fn values(findings: &Findings) -> String {
    let ladder = &findings.ladder;
    let middle = ladder.octants[0].middle;
    let places = ladder.octants[0].places.len();
    let mut text =
        "| mesh | direct, lx | indirect, lx | total, lx | indirect, lowest and highest of all \
                    places, lx |\n\
                    |---|---:|---:|---:|---:|\n"
            .to_owned();
    let mut row = |name: &str, of: &dyn Fn(Part, usize) -> Vec<f64>| {
        let found = |part| {
            let Interval { value, half_width } = mean_interval(&of(part, middle));
            match half_width.filter(|half_width| *half_width > 1e-9) {
                Some(half_width) => format!("{value:.3} ± {half_width:.3}"),
                None => format!("{value:.3}"),
            }
        };
        let all = (0..places).map(|place| mean_interval(&of(Part::Indirect, place)).value);
        let (low, high) = (all.clone().fold(f64::INFINITY, f64::min), all.fold(0.0, f64::max));
        let [direct, indirect, total] = Part::ALL.map(found);
        writeln!(text, "| {name} | {direct} | {indirect} | {total} | {low:.3} to {high:.3} |")
            .expect("strings grow");
    };
    for level in 0..LEVELS {
        let name = format!("n = {}", ladder.octants[level].n);
        row(&name, &|part, place| ladder.on_mesh(level, part, place));
    }
    row("sphere", &|part, place| ladder.on_sphere(part, place));
    writeln!(
        text,
        "| the paper | {:.3} | {INDIRECT_LX} | {TOTAL_LX} | {INDIRECT_LX} |",
        TOTAL_LX - INDIRECT_LX
    )
    .expect("strings grow");
    text
}

fn errors(findings: &Findings, randomisations: usize) -> String {
    let photons = &findings.curves[0].stops;
    let finest = &findings.ladder.octants[LEVELS - 1];
    let mut text = format!(
        "\n## The errors\n\n\
         Of the total at the place in the middle, over {TOTAL_LX} lx: the root mean square over \
         {randomisations} randomisations (Halton's points Owen-scrambled, where the cube's are \
         rotated), and one run of Halton's points as they are. Photons are counted by an element \
         of a map, a triangle of {:.3} m2 around the place on the mesh of {} facets along an edge. \
         N is photons, and for our estimator paths and photons on each of the two finest meshes, \
         whose limit is taken; seconds are those of one randomisation on this machine, ours for {} \
         places; randomisations share their start, which plain Halton points, a single run, bear \
         alone. Slopes are those of the spread, which no element bends; in the last line, what \
         element and mesh leave when N is largest, with the noise of the mean. The last column has \
         how many times smaller the error of scrambled Halton points is than that of pseudo-random \
         ones, with 95 % intervals.\n\n",
        finest.element().iter().map(|facet| facet.area_m2).sum::<f64>(),
        finest.n,
        finest.places.len(),
    );
    let header = findings.curves.iter().map(|curve| format!(" {} | s |", curve.name));
    let header: String = header.collect();
    writeln!(
        text,
        "| N |{header} pseudo over scrambled Halton |\n|---:|{}",
        "---:|".repeat(2 * findings.curves.len() + 1)
    )
    .expect("strings grow");
    let paths = findings.curves.iter().flat_map(|curve| curve.stops.iter());
    let mut counts: Vec<u64> = paths.map(|stop| stop.samples).collect();
    counts.sort_unstable();
    counts.dedup();
    let last = photons.last().map_or(0, |stop| stop.samples);
    for n in counts.into_iter().filter(|n| n.ilog2() % 2 == last.max(1).ilog2() % 2) {
        let cell = |curve: &Curve| match curve.stops.iter().find(|stop| stop.samples == n) {
            Some(stop) => format!(" {:.4} % | {:.2e} |", 100.0 * stop.error(), stop.seconds),
            None => " | |".to_owned(),
        };
        let cells: String = findings.curves.iter().map(cell).collect();
        let gain = gain_at(findings, n).map_or(String::new(), Contrast::text);
        writeln!(text, "| {} |{cells} {gain} |", count(n)).expect("strings grow");
    }
    let slope = |curve: &Curve| match curve.slope {
        Some(slope) => format!(" {slope:.2} | |"),
        None => " - | |".to_owned(),
    };
    let slopes: String = findings.curves.iter().map(slope).collect();
    writeln!(text, "| slope |{slopes} |").expect("strings grow");
    let bias = |curve: &Curve| format!(" {:+.4} % | |", 100.0 * curve.last().bias());
    let biases: String = findings.curves.iter().map(bias).collect();
    writeln!(text, "| mean |{biases} |\n").expect("strings grow");
    text.push_str(&printed());
    text
}

/// Of the paper's two ways, where both have this many photons.
pub(super) fn gain_at(findings: &Findings, n: u64) -> Option<Contrast> {
    let [pseudo, quasi, ..] = findings.curves.as_slice() else { return None };
    let squares =
        |curve: &Curve| curve.stops.iter().find(|stop| stop.samples == n).map(Stop::squares);
    squares(pseudo).zip(squares(quasi)).map(|(worse, better)| Contrast::gain(&worse, &better))
}

fn printed() -> String {
    let mut text = "The paper's single runs, on a machine of 2003, and the ratio of their errors \
        as it prints it:\n\n\
        | s | pseudo, lx | quasi, lx | pseudo | quasi | pseudo over quasi |\n\
        |---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for line in &TABLE {
        writeln!(
            text,
            "| {} | {} | {} | {:.3} % | {:.5} % | {:.3} |",
            line.seconds,
            line.pseudo_lx,
            line.quasi_lx,
            100.0 * line.pseudo_error(),
            100.0 * line.quasi_error(),
            line.ratio,
        )
        .expect("strings grow");
    }
    text
}
