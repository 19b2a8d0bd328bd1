//! The tables for people, the paper's figures beside ours.

use super::claims::{luminances, solved_cd_m2};
use super::compare::Column;
use super::curve::Curve;
use super::floor::{End, Floor};
use super::paper;
use super::scene::{CLASSES, HALF_M, INSET};
use super::setup::Form;
use super::{ELEMENT_M, Findings, PHOTONS_PER_PATH};
use std::fmt::Write;

/// What is measured.
pub(super) fn heading(findings: &Findings) -> String {
    format!(
        "# The diffuse cube\n\n\
         A closed cube of 10 m, reflectance 2/3, an isotropic point light of 50 000 cd in the \
         middle. Errors are the L2 norm\n\
         over 5 x 5 places on each of the six walls, over that of the truth; of {replicates} \
         randomisations the root mean square.\n\
         Pseudo (random points) and quasi (Halton's): photons counted on a map of right triangles \
         with legs of {ELEMENT_M} m.\n\
         Pseudo2 and quasi2: paths that end on such a map, {PHOTONS_PER_PATH} photons for each \
         path from a place.\n\
         Own: the default, paths that are connected to light subpaths, scrambled Sobol' points.\n\n\
         Places on an edge or in a corner belong to two or three walls, and are read once for \
         each: a path starts {inset:.0}\n\
         micrometres inside its wall's edge, and a map is read in the own wall's element there. A \
         place where elements meet is\n\
         read in one of them.\n\n\
         Seconds are wall clock for all randomisations together over their number: what one takes \
         on this machine when they\n\
         share the start. Columns are timed in short runs, in turn; medians say what a ray of each \
         takes, and what they are\n\
         off by chance is in no interval. Paths that end on\n\
         a map that grows are traced anew at each power of two, which counts, too.\n",
        replicates = findings.replicates,
        inset = 1e6 * INSET * HALF_M,
    )
}

/// The six luminances.
pub(super) fn table_4(findings: &Findings) -> String {
    let mut text = format!(
        "\n## Luminances (table 4)\n\n\
         In cd/m2 at places in units of half a side: as the paper prints them; by two solves made \
         before, radiosity and spectral;\n\
         by collocation here, at the very edge; and by our own form with {} paths, its intervals \
         for all six together at 99 %.\n\
         The paper's values agree to its last digit, but for the third, where it prints 686.6 and \
         all solves have 686.7.\n\n\
         | place | paper | radiosity, spectral | collocation | own |\n|---|---:|---:|---:|---:|\n",
        findings.deep.end().paths,
    );
    let measured = luminances(&findings.deep, &findings.truth);
    let solved = solved_cd_m2(&findings.truth);
    for (class, own) in measured.iter().enumerate() {
        let [x, y] = CLASSES[class];
        writeln!(
            text,
            "| ({x}, {y}) | {:.1} | {:.2} | {:.3} | {:.2} \u{b1} {:.2} |",
            paper::LUMINANCES_CD_M2[class],
            paper::SOLVED_CD_M2[class],
            solved[class],
            own.value_cd_m2,
            own.half_width_cd_m2,
        )
        .expect("strings grow");
    }
    text
}

/// The last look that all sequences have, of a way's form.
fn common_look(findings: &Findings, curve: &Curve) -> u64 {
    let same = |other: &&Curve| other.setup.form.name() == curve.setup.form.name();
    let curves = findings.columns.iter().chain(&findings.others);
    curves.filter(same).map(|curve| curve.end().n).min().unwrap_or(0)
}

/// Errors at one N, and slopes up to it, for all sequences.
pub(super) fn convergence(findings: &Findings) -> String {
    let mut text = "\n## Sequences\n\n\
        All of a form at one N: photons of a replicate, for our own form paths from a place. \
        Seconds are of short runs of all\n\
        rows in turn. Slopes against N are of the error, its floor included, and of the spread \
        about the mean, which has none; of\n\
        all N up to this one, and of our own form up to its last.\n\n\
        | form | points | randomisation | N | paths a place | s | error in % | slope | of the \
        spread |\n|---|---|---|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for curve in by_form(findings) {
        let n = common_look(findings, curve);
        let Some(look) = curve.look(n) else { continue };
        let setup = curve.setup;
        let most = if setup.form == Form::Own { u64::MAX } else { n };
        let slope = |of_look| match curve.slope(most, of_look) {
            Some(slope) => format!("{slope:.2}"),
            None => "-".to_owned(),
        };
        writeln!(
            text,
            "| {} | {} | {} | {n} | {} | {} | {} | {} | {} |",
            setup.form.name(),
            setup.points.name(),
            setup.points.randomization().name(),
            look.paths,
            digits(look.cost.seconds),
            digits(100.0 * look.rms()),
            slope(|look| &look.errors),
            slope(|look| &look.spreads),
        )
        .expect("strings grow");
    }
    text
}

/// Photons, then paths with them, then our own form.
fn by_form(findings: &Findings) -> Vec<&Curve> {
    let mut curves: Vec<&Curve> = findings.columns.iter().chain(&findings.others).collect();
    curves.sort_by_key(|curve| match curve.setup.form {
        Form::Photons { .. } => 0,
        Form::Map { .. } => 1,
        Form::Own => 2,
    });
    curves
}

/// Floors by the size of elements, and what they say about the paper's.
pub(super) fn floors(findings: &Findings) -> String {
    let mut text = "\n## The floor\n\n\
        With Halton points: the error of one replicate at the last N, and what would be left of it \
        after very many, with its\n\
        standard error.\n\n\
        | legs in m | quasi: N | error in % | floor in % | quasi2: N | error in % | floor in % | \
        ratio of floors |\n\
        |---:|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for floor in &findings.floors {
        let cells = |end: &End| {
            let (norm, error) = (100.0 * end.bias.norm(), 100.0 * end.bias.error_of_norm());
            format!("{} | {} | {norm:.2} \u{b1} {error:.2}", end.n, digits(100.0 * end.rms))
        };
        let ratio = floor.map.bias.norm() / floor.photons.bias.norm();
        let (photons, map) = (cells(&floor.photons), cells(&floor.map));
        writeln!(text, "| {} | {photons} | {map} | {ratio:.2} |", floor.element_m)
            .expect("strings grow");
    }
    text.push_str(&of_paper(findings));
    text
}

/// Which elements the paper's last errors speak of.
fn of_paper(findings: &Findings) -> String {
    let rows = paper::rows();
    let last = rows.last().map_or([f64::NAN; 4], |row| row.errors_percent);
    let law = |of: fn(&Floor) -> &End, percent: f64| {
        let law = Floor::law(&findings.floors, of);
        let element_m = |law: quasilux_sampling::quality::PowerLaw| {
            libm::pow(percent / 100.0 / law.factor, 1.0 / law.exponent)
        };
        law.map_or([f64::NAN; 2], |law| [law.exponent, element_m(law)])
    };
    let [quasi, quasi2] = [last[Column::Quasi as usize], last[Column::Quasi2 as usize]];
    let photons = law(|floor| &floor.photons, quasi);
    let map = law(|floor| &floor.map, quasi2);
    let finest = findings.floors.last().map_or(f64::NAN, |floor| floor.element_m);
    format!(
        "\nThe floors grow with the legs' power {:.2} for quasi and {:.2} for quasi2. Carried on \
         below our finest legs of {finest} m, these\nlaws reach the paper's last errors, \
         {quasi:.2} % and {quasi2:.2} %, at {:.2} m and {:.2} m. One map has one size: the two do \
         not quite\n\
         agree, as laws that are carried on and single runs may not. The paper's floor is \
         consistent with the bias of a map of such elements,\nwhich is not proven. Its ratio of \
         the two is {:.2}. At an edge half of the directions lead right onto the next wall, in a \
         corner\nthree quarters: with the reflectance 2/3 quasi2 keeps a third and a half of the \
         map's error there.\n",
        photons[0],
        map[0],
        photons[1],
        map[1],
        quasi2 / quasi,
    )
}

/// Three digits.
pub(super) fn digits(value: f64) -> String {
    let places = 2.0 - libm::log10(value.max(1e-9)).floor();
    format!("{value:.*}", places.clamp(0.0, 6.0) as usize)
}
