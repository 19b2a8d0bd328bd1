//! Coordinates and errors, as tables.

use super::cube::Cube;
use super::{Claim, Setup, cost};
use quasilux_report::number::exact;
use quasilux_sampling::Sequence;
use std::fmt::Write;

/// One line for each setup and number of photons; the cube's coordinates behind them, without
/// errors.
pub(super) fn csv(setups: &[Setup], cube: &Cube) -> String {
    let mut text = "scene,setup,sequence,mean_coordinates,n,rms_error\n".to_owned();
    for setup in setups {
        for error in &setup.flights.errors {
            writeln!(
                text,
                "room,{},{},{},{},{}",
                setup.name,
                setup.flights.sequence.name(),
                exact(setup.flights.dimensions.mean()),
                error.photons,
                exact(error.rms()),
            )
            .expect("strings grow");
        }
    }
    for NamedCount { name, coordinates } in named_counts(cube) {
        writeln!(text, "cube,{name},sobol,{},{},", exact(coordinates), cube.count)
            .expect("strings grow");
    }
    text
}

/// Both tables, and what is claimed.
pub(super) fn markdown(setups: &[Setup], cube: &Cube, replicates: u32, claims: &[Claim]) -> String {
    let mut text = "# What superposition and inverse transform save\n\n\
        Coordinates a photon or path in the diffuse cube (the paper has 6 and 2), counted by the \
        sampler that hands them\n\
        out: in the program, or in the walk of this experiment where features can be turned \
        off.\n\n\
        | what | coordinates |\n|---|---:|\n"
        .to_owned();
    for NamedCount { name, coordinates } in named_counts(cube) {
        writeln!(text, "| {name} | {coordinates:.3} |").expect("strings grow");
    }
    write!(
        text,
        "\nA cube of the same reflectance with four batwing luminaires below its ceiling: \
         coordinates a photon, and the error of the\n\
         illuminance of a cell (16 on each wall), root mean square over cells and {replicates} \
         randomisations, over the mean. Sharing is superposition: a choice leaves its\n\
         coordinate to what hangs on it.\n\n| setup | coordinates |"
    )
    .expect("strings grow");
    let counts = || setups[0].flights.errors.iter().map(|error| error.photons);
    for n in counts() {
        write!(text, " N = {n} |").expect("strings grow");
    }
    writeln!(text, "\n|---|---:|{}", "---:|".repeat(counts().count())).expect("strings grow");
    for setup in setups {
        let points = match setup.flights.sequence {
            Sequence::Independent => "random",
            _ => "Sobol'",
        };
        write!(text, "| {points}, {} | {:.2} |", setup.name, setup.flights.dimensions.mean())
            .expect("strings grow");
        for error in &setup.flights.errors {
            write!(text, " {:.3} % |", 100.0 * error.rms()).expect("strings grow");
        }
        text.push('\n');
    }
    text.push_str(&savings(setups));
    text + &Claim::markdown(claims)
}

/// What turning features off costs with the most photons.
fn savings(setups: &[Setup]) -> String {
    let photons = setups[0].flights.last().photons;
    let mut text = format!(
        "\nWhat each setup costs beside all features, its coordinates and how many times the error \
         it has at N = {photons}, with\n\
         95 % intervals:\n\n| setup | coordinates more | Sobol', error times | random, error times \
         |\n|---|---:|---:|---:|\n"
    );
    let half = setups.len() / 2;
    let (sobol, random) = setups.split_at(half);
    for (own, other) in sobol.iter().zip(random).skip(1) {
        let more = own.flights.dimensions.mean() - sobol[0].flights.dimensions.mean();
        let [own_cost, other_cost] = [own, other].map(|setup| cost(setups, setup).text());
        writeln!(text, "| {} | {more:.1} | {own_cost} | {other_cost} |", own.name)
            .expect("strings grow");
    }
    text
}

/// Mean coordinates of a photon or a path.
struct NamedCount {
    name: &'static str,
    coordinates: f64,
}

fn named_counts(cube: &Cube) -> [NamedCount; 4] {
    let named = |name, coordinates| NamedCount { name, coordinates };
    [
        named("photons but for the absorbing event (walk)", cube.uncounted),
        named("photons (program)", cube.photons),
        named("photons without superposition (walk)", cube.separate),
        named("backward paths of the paper's form (program)", cube.paths),
    ]
}
