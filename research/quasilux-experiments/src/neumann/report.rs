//! The figures as a table for programs and as two for people, with what is seen in them.

use super::pictures::Picture;
use super::terms::{Distance, Terms};
use super::{CUTS, room};
use crate::claim::{Claim, largest, smallest};
use crate::course::mean_interval;
use quasilux_report::number::{count, exact};
use quasilux_transport::Interval;
use quasilux_transport::interval::t_quantile_for;
use std::fmt::Write;

const COLUMNS: &str = "kind,estimator,bounces,values,mean,half_width,unit\n";
/// From this many bounces on the light has forgotten where it came from: ratios of terms differ by
/// so much, and no more.
const SETTLED: usize = 3;
const GEOMETRIC: f64 = 0.01;

/// One line for each term of each kind, each sum, each ratio and each picture.
pub(super) fn csv(terms: &Terms, pictures: &[Picture]) -> String {
    let mut text = COLUMNS.to_owned();
    let mut line = |kind: &str, bounces: &str, values: usize, found: Interval, unit: &str| {
        let half_width = found.half_width.map(exact).unwrap_or_default();
        let mean = exact(found.value);
        writeln!(text, "{kind},{bounces},{values},{mean},{half_width},{unit}")
            .expect("strings grow");
    };
    for (k, values) in terms.landing_lm.iter().enumerate() {
        line("landing,photon", &k.to_string(), values.len(), mean_interval(values), "lm");
    }
    for (k, ratio) in terms.ratios().into_iter().enumerate() {
        let values = terms.landing_lm[0].len();
        line("ratio to the term before,photon", &(k + 1).to_string(), values, ratio, "1");
    }
    for (estimator, all) in [("path", &terms.by_paths_lx), ("photon", &terms.by_photons_lx)] {
        for (k, values) in all.iter().enumerate() {
            let rest = if k + 1 == all.len() { " and more" } else { "" };
            let kind = format!("term,{estimator}");
            line(&kind, &format!("{k}{rest}"), values.len(), mean_interval(values), "lx");
        }
    }
    for (cut, values) in &terms.cut_lx {
        line("cut run,path", &up_to(*cut), values.len(), mean_interval(values), "lx");
        let sum = terms.sum_lx(*cut);
        line("sum of terms,path", &up_to(*cut), sum.len(), mean_interval(&sum), "lx");
    }
    for picture in pictures {
        let replicates = picture.taken.replicate_mean_cd_m2.len();
        line("picture mean,path", &up_to(picture.cut), replicates, picture.mean_cd_m2, "cd/m2");
    }
    text
}

fn up_to(cut: Option<u32>) -> String {
    cut.map_or("all".to_owned(), |cut| format!("up to {cut}"))
}

/// The tables, and what they say.
pub(super) fn markdown(terms: &Terms, pictures: &[Picture], claims: &[Claim]) -> String {
    let [width, height] = pictures[0].resolution;
    let mut text = format!(
        "# Terms of the Neumann series (table 1)\n\n\
         The room is {}: the paper's is not published. `neumann-terms.png` shows it with the light \
         of up to n = 0, 1, 2 and 4 bounces, as in the paper's table, and all of it, {width} x \
         {height} pixels each under one exposure. The light of no bounce is that of the lamp \
         itself.\n\n\
         ## What each term adds\n\n\
         On all surfaces the flux of the photons that land, {} in each of {} runs; on {}, of {:.2} \
         m2, the mean illuminance by paths, {} for each cell in each of {} replicates, and by {} \
         photons in each; 95 % intervals.\n\n",
        room::description(),
        count(terms.photons),
        terms.landing_lm[0].len(),
        room::plane(),
        room::plane_m2(),
        count(terms.paths),
        terms.by_paths_lx[0].len(),
        count(terms.photons),
    );
    text.push_str(&by_term(terms));
    text.push_str(&by_cut(terms, pictures));
    text.push_str(&Claim::markdown(claims));
    text
}

fn by_term(terms: &Terms) -> String {
    let mut text =
        "| bounces | lands, lm | of the term before | plane by paths, lx | by photons, lx | flux \
                    through it, lm |\n\
                    |---:|---:|---:|---:|---:|---:|\n"
            .to_owned();
    let ratios = terms.ratios();
    let last = terms.by_paths_lx.len() - 1;
    for k in 0..=last {
        let paths = mean_interval(&terms.by_paths_lx[k]);
        let ratio = if k == 0 || k == last { "-".to_owned() } else { shown(ratios[k - 1], 4) };
        let (name, lands) = match k == last {
            true => (format!("{k} and more"), "-".to_owned()),
            false => (k.to_string(), shown(mean_interval(&terms.landing_lm[k]), 2)),
        };
        writeln!(
            text,
            "| {name} | {lands} | {ratio} | {} | {} | {:.2} |",
            shown(paths, 3),
            shown(mean_interval(&terms.by_photons_lx[k]), 3),
            paths.value * room::plane_m2(),
        )
        .expect("strings grow");
    }
    text
}

fn by_cut(terms: &Terms, pictures: &[Picture]) -> String {
    let mut text = "\n## What the terms sum to\n\n\
        | light | plane, lx | sum of the terms, lx | mean luminance of the picture, cd/m2 \
        |\n|---|---:|---:|---:|\n"
        .to_owned();
    for ((cut, values), picture) in terms.cut_lx.iter().zip(pictures) {
        writeln!(
            text,
            "| {} | {} | {} | {} |",
            picture.label(),
            shown(mean_interval(values), 3),
            shown(mean_interval(&terms.sum_lx(*cut)), 3),
            shown(picture.mean_cd_m2, 3),
        )
        .expect("strings grow");
    }
    text
}

fn shown(Interval { value, half_width }: Interval, digits: usize) -> String {
    match half_width.filter(|half_width| *half_width > 1e-12) {
        Some(half_width) => format!("{value:.digits$} ± {half_width:.digits$}"),
        None => format!("{value:.digits$}"),
    }
}

/// All claims; ratios of terms must be known to a share.
pub(super) fn claims(terms: &Terms, pictures: &[Picture], known: f64) -> Vec<Claim> {
    vec![rises(terms, pictures), sums(terms), falls(terms, known), agree(terms)]
}

/// Each step by more than chance, all together at 1 %.
fn rises(terms: &Terms, pictures: &[Picture]) -> Claim {
    let allowed = Distance::allowed(CUTS.len() - 1, terms.cut_lx[0].1.len());
    let step = |pair: &[(Option<u32>, Vec<f64>)]| {
        let rises = mean_interval(&pair[1].1).value > mean_interval(&pair[0].1).value;
        let distance = Distance::between(&pair[1].1, &pair[0].1).standard_errors;
        if rises { distance } else { -distance }
    };
    let least = smallest(terms.cut_lx.windows(2).map(step));
    let brighter =
        pictures.windows(2).all(|pair| pair[1].mean_cd_m2.value > pair[0].mean_cd_m2.value);
    let values: Vec<String> = terms
        .cut_lx
        .iter()
        .map(|(_, values)| format!("{:.2}", mean_interval(values).value))
        .collect();
    Claim::new(
        format!(
            "With n = 0, 1, 2, 4 and without end the plane gets {} lx: more each time \
             (significance 1 % for all together), and so does each pixel on average",
            values.join(", ")
        ),
        pictures.iter().map(|picture| picture.mean_cd_m2.value).chain([least, allowed]),
        least > allowed && brighter,
    )
}

/// Of runs that share nothing.
fn sums(terms: &Terms) -> Claim {
    let apart: Vec<Distance> = terms
        .cut_lx
        .iter()
        .map(|(cut, values)| Distance::between(&terms.sum_lx(*cut), values))
        .collect();
    let allowed = Distance::allowed(apart.len(), terms.cut_lx[0].1.len());
    let worst = largest(apart.iter().map(|distance| distance.standard_errors));
    let converged = apart.last().map_or(f64::NAN, |distance| distance.relative);
    Claim::new(
        format!(
            "The terms of one run sum to what others find that are cut there or not at all, \
             {worst:.2} standard errors apart at the worst where {allowed:.2} are allowed \
             (significance 1 % for all together); all of them to {:.3} % of the converged value",
            100.0 * converged,
        ),
        [worst, allowed, converged],
        worst <= allowed,
    )
}

/// No two of the settled ratios differ by more than is granted, beyond chance: all pairs together
/// at 1 %. The ratios must be known to a share, lest nothing known is taken for likeness.
fn falls(terms: &Terms, known: f64) -> Claim {
    let settled = &terms.ratios()[SETTLED..];
    let values = || settled.iter().map(|ratio| ratio.value);
    let (low, high) = (smallest(values()), largest(values()));
    let share = |ratio: &Interval| ratio.relative_half_width().unwrap_or(f64::NAN);
    let noise = largest(settled.iter().map(share));
    let runs = terms.landing_lm[0].len();
    let t = t_quantile_for(runs, 0.05).unwrap_or(f64::NAN);
    let beyond = |(a, b): (&Interval, &Interval)| {
        let apart = libm::log(a.value / b.value).abs() - libm::log1p(GEOMETRIC);
        apart * t / libm::hypot(share(a), share(b))
    };
    let pairs = settled.iter().enumerate();
    let pairs = pairs.flat_map(|(k, a)| settled[k + 1..].iter().map(move |b| (a, b)));
    let worst = largest(pairs.clone().map(beyond));
    let allowed = Distance::allowed(pairs.count(), runs);
    Claim::new(
        format!(
            "From {SETTLED} bounces on the flux that lands falls geometrically: each term is \
             {low:.4} to {high:.4} of the one before, all known to {:.2} % (95 %), which is within \
             {:.0} %, and what two of them differ by is {worst:.1} standard errors or less beyond \
             the {} % granted, where {allowed:.2} are allowed (significance 1 % for all pairs \
             together)",
            100.0 * noise,
            100.0 * known,
            100.0 * GEOMETRIC,
        ),
        [low, high, noise, worst, allowed],
        worst <= allowed && noise <= known && high < 1.0,
    )
}

fn agree(terms: &Terms) -> Claim {
    let pairs = terms.by_paths_lx.iter().zip(&terms.by_photons_lx);
    // The light of no bounce may be exact, up to rounding.
    let apart: Vec<Distance> = pairs.map(|(a, b)| Distance::between(a, b)).collect();
    let allowed = Distance::allowed(apart.len(), terms.by_paths_lx[0].len());
    let worst = largest(apart.iter().map(|distance| distance.standard_errors));
    let relative = largest(apart.iter().map(|distance| distance.relative));
    Claim::new(
        format!(
            "Paths and photons agree about the flux of each term, to {:.2} % of it, {worst:.2} \
             standard errors apart at the worst where {allowed:.2} are allowed (significance 1 % \
             for all together)",
            100.0 * relative,
        ),
        [worst, allowed, relative],
        worst <= allowed,
    )
}
