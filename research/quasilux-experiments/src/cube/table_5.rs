//! Table 5: the columns where pseudo errs as much as in the paper, at equal time, and as single
//! runs.

use super::Findings;
use super::claims::CLAIMED;
use super::compare::{Column, Duel, Row, Table};
use super::curve::Curve;
use super::paper;
use super::setup::Points;
use super::tables::digits;
use std::fmt::Write;

/// Those that are claimed, and the best of the paper's against our own form.
pub(super) fn duels(table: &Table) -> Vec<Duel> {
    let pairs = CLAIMED.into_iter().chain([[Column::Quasi2, Column::Own]]);
    pairs.map(|[worse, better]| table.duel(worse, better)).collect()
}

/// A row of the paper, and ours at the same error of pseudo-random points, where there is one.
pub(super) struct Aligned {
    pub(super) printed: paper::Row,
    pub(super) own: Option<Row>,
}

/// The paper's rows, each with ours where pseudo errs as much, if it does.
pub(super) fn rows(findings: &Findings) -> impl Iterator<Item = Aligned> {
    paper::rows().into_iter().map(|printed| {
        let error = printed.errors_percent[Column::Pseudo as usize] / 100.0;
        let own = Table::at_error_of_pseudo(&findings.columns, error);
        Aligned { printed, own }
    })
}

/// All of it.
pub(super) fn markdown(findings: &Findings) -> String {
    let mut text = beside_the_paper(findings);
    text.push_str(&at_equal_time(findings));
    text.push_str(&single_runs(findings));
    text
}

fn beside_the_paper(findings: &Findings) -> String {
    let mut text = "\n## Errors (table 5)\n\n\
        All ten rows of the paper, one run each on a machine of 2003, in brackets; before them \
        ours, of all columns at the time at\n\
        which our pseudo errs as much as the paper's in this row. Where it never does, or a column \
        has not begun at that time,\n\
        there are the paper's figures alone. Errors in %, and ratios of them as in the paper; what \
        it heads quasi2 over pseudo2\n\
        are the figures of pseudo over quasi2. The paper's pseudo is a single run, so that rows \
        may be aligned a little too early or late;\n\
        the first stands out, and of its ratios all that have pseudo in them.\n\n\
        | s | pseudo | pseudo2 | quasi | quasi2 | own | pseudo/quasi | pseudo2/quasi2 | \
        pseudo/quasi2 |\n\
        |---:|---:|---:|---:|---:|---:|---:|---:|---:|\n"
        .to_owned();
    for Aligned { printed, own } in rows(findings) {
        let beside = |value: Option<String>, printed: String| match value {
            Some(value) => format!("{value} ({printed})"),
            None => format!("({printed})"),
        };
        let rms = |column: Column| own.as_ref().and_then(|row| row.rms(column));
        let error = |column: Column| {
            let value = rms(column).map(|rms| digits(100.0 * rms));
            beside(value, digits(printed.errors_percent[column as usize]))
        };
        let ratio = |worse: Column, better: Column, printed: f64| {
            let value = rms(worse).zip(rms(better)).map(|(a, b)| format!("{:.2}", a / b));
            beside(value, format!("{printed:.2}"))
        };
        let [pseudo_quasi, pseudo_quasi2] = printed.ratios;
        let [.., pseudo2, quasi2] = printed.errors_percent;
        let cells = [
            beside(own.as_ref().map(|row| digits(row.cost)), format!("{}", printed.seconds)),
            error(Column::Pseudo),
            error(Column::Pseudo2),
            error(Column::Quasi),
            error(Column::Quasi2),
            rms(Column::Own).map_or(String::new(), |rms| digits(100.0 * rms)),
            ratio(Column::Pseudo, Column::Quasi, pseudo_quasi),
            ratio(Column::Pseudo2, Column::Quasi2, pseudo2 / quasi2),
            ratio(Column::Pseudo, Column::Quasi2, pseudo_quasi2),
        ];
        writeln!(text, "| {} |", cells.join(" | ")).expect("strings grow");
    }
    text
}

/// What the claims are about.
fn at_equal_time(findings: &Findings) -> String {
    let duels = duels(&findings.table);
    let name = |duel: &Duel| format!("{}/{}", duel.worse.name(), duel.better.name());
    let header: String = duels
        .iter()
        .map(|duel| match duel.has_same_floor {
            true => format!(" {0} | spreads of {0} |", name(duel)),
            false => format!(" {} |", name(duel)),
        })
        .collect();
    let mut text = format!(
        "\n### Ratios at equal time\n\n\
         From where all columns have begun to where the first of them ends. Two columns that read \
         maps in the same way have the same\n\
         floor, and are told apart by how far they spread about their means. What is tested has \
         its 95 % interval, by the jackknife\n\
         over {} randomisations.\n\n| s |{header}\n|---:|{}\n",
        findings.replicates,
        "---:|".repeat(header.matches(" |").count()),
    );
    for row in &findings.table.rows {
        let cell = |duel: &Duel| {
            let Some(round) = duel.rounds.iter().find(|round| round.cost == row.cost) else {
                return if duel.has_same_floor { " - | - |" } else { " - |" }.to_owned();
            };
            match duel.has_same_floor {
                true => format!(" {:.2} | {} |", round.ratio, round.compared.text()),
                false => format!(" {} |", round.compared.text()),
            }
        };
        let cells: String = duels.iter().map(cell).collect();
        writeln!(text, "| {} |{cells}", digits(row.cost)).expect("strings grow");
    }
    text
}

/// One run that is not randomised beside the root mean squares, at equal N.
fn single_runs(findings: &Findings) -> String {
    let [pseudo, quasi, pseudo2, quasi2, _] = &findings.columns;
    let [plain, plain2] = &findings.plain;
    let scatters = [(pseudo, quasi), (pseudo2, quasi2)]
        .map(|(a, b)| 100.0 * libm::hypot(a.end().scatter(), b.end().scatter()));
    let mut text = format!(
        "\n### Halton's points as they are\n\n\
         The paper's points are not randomised: here is one run of them, its error in % over the \
         150 places, beside the root mean\n\
         squares of pseudo and of rotated Halton points with as many photons (and paths). The \
         plain points' photons are cut after {} reflections, for\n\
         those of the lowest indices are near 0 in all high coordinates, and would never be \
         absorbed. In brackets, how many of the {} pseudo runs\n\
         err less. The ratio of two single runs at the last N scatters by {:.1} % (photons) and \
         {:.1} % (with paths), one standard deviation.\n\n\
         | N | pseudo | quasi | plain Halton | pseudo/plain | pseudo2 | quasi2 | plain Halton | \
         pseudo2/plain |\n\
         |---:|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        Points::PlainHalton.max_bounces().unwrap_or(0),
        findings.replicates,
        scatters[0],
        scatters[1],
    );
    for n in pseudo.looks.iter().map(|look| look.n).filter(|n| n.ilog2() % 2 == 0 && *n >= 1024) {
        let cells = [[pseudo, quasi, plain], [pseudo2, quasi2, plain2]].map(|of| single_run(of, n));
        let [Some(photons), Some(paths)] = cells else { continue };
        writeln!(text, "| {n} | {photons} | {paths} |").expect("strings grow");
    }
    text
}

/// Errors of pseudo, quasi and the single run, and by how much it errs less.
fn single_run(curves: [&Curve; 3], n: u64) -> Option<String> {
    let [pseudo, quasi, plain] = curves.map(|curve| curve.look(n));
    let (pseudo, quasi, plain) = (pseudo?, quasi?, plain?.rms());
    let fewer = pseudo.errors.iter().filter(|error| **error < plain).count();
    let [a, b] = [pseudo.rms(), quasi.rms()];
    let errors = [a, b, plain].map(|error| digits(100.0 * error)).join(" | ");
    Some(format!("{errors} | {:.2} ({fewer})", a / plain))
}
