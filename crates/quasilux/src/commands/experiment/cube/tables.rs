//! The tables for people, the paper's figures beside ours.

use super::claims::{luminances, solved_cd_m2};
use super::compare::{Column, Duel, Table};
use super::floor::{End, Floor};
use super::paper;
use super::scene::{CLASSES, HALF_M, INSET};
use super::{ELEMENT_M, Findings, PHOTONS_PER_PATH};
use std::fmt::Write;

/// The comparisons of table 5; the last one against our own form.
pub(super) fn duels(table: &Table) -> [Duel; 4] {
    [
        table.duel(Column::Pseudo, Column::Quasi),
        table.duel(Column::Pseudo2, Column::Quasi2),
        table.duel(Column::Pseudo, Column::Quasi2),
        table.duel(Column::Quasi2, Column::Own),
    ]
}

/// What is measured.
pub(super) fn heading(findings: &Findings) -> String {
    format!(
        "# The diffuse cube\n\n\
         A closed cube of 10 m, reflectance 2/3, an isotropic point light of 50 000 cd in the middle. Errors are the L2 norm\n\
         over 5 x 5 places on each of the six walls, over that of the truth; of {replicates} randomisations the root mean square.\n\
         Pseudo (random points) and quasi (Halton's): photons counted on a map of right triangles with legs of {ELEMENT_M} m.\n\
         Pseudo2 and quasi2: paths that end on such a map, {PHOTONS_PER_PATH} photons for each path from a place.\n\
         Own: paths that correct the map they end on, scrambled Sobol' points.\n\n\
         Places on an edge or in a corner belong to two or three walls, and are read once for each: a path starts {inset:.0}\n\
         micrometres inside its wall's edge, and a map is read in the own wall's element there. A place where elements meet is\n\
         read in one of them.\n\n\
         Seconds are wall clock for all randomisations together over their number: what one takes on this machine when they\n\
         share the start. Columns are timed in short runs, in turn; medians say what a ray of each takes. Paths that end on\n\
         a map that grows are traced anew at each power of two, which counts, too.\n",
        replicates = findings.replicates,
        inset = 1e6 * INSET * HALF_M,
    )
}

/// The six luminances.
pub(super) fn table_4(findings: &Findings) -> String {
    let mut text = format!(
        "\n## Luminances (table 4)\n\n\
         In cd/m2 at places in units of half a side: as the paper prints them; by two solves made before, radiosity and spectral;\n\
         by collocation here, at the very edge; and by our own form with {} paths, its intervals for all six together at 99 %.\n\n\
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

/// Errors at equal time.
pub(super) fn table_5(findings: &Findings) -> String {
    let mut text = "\n## Errors at equal time (table 5)\n\n\
         In %; the paper's figures in brackets, of one run each, from where pseudo errs as much as ours. Ratios of errors as in\n\
         the paper; what it heads quasi2 over pseudo2 are the figures of pseudo over quasi2.\n\n\
         | s | pseudo | pseudo2 | quasi | quasi2 | own | pseudo/quasi | pseudo2/quasi2 | pseudo/quasi2 |\n\
         |---:|---:|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    let paper = paper::rows();
    for (k, row) in findings.table.rows.iter().enumerate() {
        let printed = paper.get(k);
        let beside = |value: String, printed: Option<String>| match printed {
            Some(printed) => format!("{value} ({printed})"),
            None => value,
        };
        let error = |column: Column| {
            let value = row.rms(column).map_or("-".to_owned(), |rms| digits(100.0 * rms));
            let printed = printed.and_then(|row| row.errors_percent.get(column as usize));
            beside(value, printed.map(|value| digits(*value)))
        };
        let ratio = |worse: Column, better: Column, printed: Option<f64>| {
            let value = row.rms(worse).zip(row.rms(better)).map(|(a, b)| format!("{:.2}", a / b));
            beside(value.unwrap_or_default(), printed.map(|ratio| format!("{ratio:.2}")))
        };
        let printed_pair = printed.map(|row| row.errors_percent[2] / row.errors_percent[3]);
        let cells = [
            beside(digits(row.cost), printed.map(|row| format!("{}", row.seconds))),
            error(Column::Pseudo),
            error(Column::Pseudo2),
            error(Column::Quasi),
            error(Column::Quasi2),
            error(Column::Own),
            ratio(Column::Pseudo, Column::Quasi, printed.map(|row| row.ratios[0])),
            ratio(Column::Pseudo2, Column::Quasi2, printed_pair),
            ratio(Column::Pseudo, Column::Quasi2, printed.map(|row| row.ratios[1])),
        ];
        writeln!(text, "| {} |", cells.join(" | ")).expect("strings grow");
    }
    text
}

/// Errors by N at the end, and slopes, for all sequences.
pub(super) fn convergence(findings: &Findings) -> String {
    let mut text = "\n## Sequences\n\n\
         At the last N: photons of a replicate, for our own form paths from a place; for the columns the last that the time\n\
         allows, too. Slopes of the error against N, its floor included.\n\n\
         | form | points | randomisation | N | paths a place | s | error in % | slope |\n|---|---|---|---:|---:|---:|---:|---:|\n"
        .to_owned();
    let curves = findings.columns.iter().chain(&findings.others);
    for curve in curves {
        let (setup, end) = (curve.setup, curve.end());
        let slope = curve.slope().map_or("-".to_owned(), |slope| format!("{slope:.2}"));
        writeln!(
            text,
            "| {} | {} | {} | {} | {} | {} | {} | {slope} |",
            setup.form.name(),
            setup.points.name(),
            setup.points.randomization().name(),
            end.n,
            end.paths,
            digits(end.cost.seconds),
            digits(100.0 * end.rms()),
        )
        .expect("strings grow");
    }
    text
}

/// Floors by the size of elements, and what they say about the paper's.
pub(super) fn floors(findings: &Findings) -> String {
    let mut text = "\n## The floor\n\n\
         With Halton points: the error of one replicate at the last N, and what would be left of it after very many, with its\n\
         standard error.\n\n\
         | legs in m | quasi: N | error in % | floor in % | quasi2: N | error in % | floor in % | ratio of floors |\n\
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
    format!(
        "\nThe floors grow with the legs' power {:.2} for quasi and {:.2} for quasi2. The paper's last errors, {quasi:.2} % and \
         {quasi2:.2} %,\nare floors for legs of {:.2} m and {:.2} m, and their ratio is {:.2}. At an edge half of the directions lead right onto\n\
         the next wall, in a corner three quarters: with the reflectance 2/3 quasi2 keeps a third and a half of the map's error there.\n",
        photons[0],
        map[0],
        photons[1],
        map[1],
        quasi2 / quasi,
    )
}

/// Three digits.
fn digits(value: f64) -> String {
    let places = 2.0 - libm::log10(value.max(1e-9)).floor();
    format!("{value:.*}", places.clamp(0.0, 6.0) as usize)
}
