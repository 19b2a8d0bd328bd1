//! The project's own commands: `cargo xtask help` lists them.
//!
//! [`steps`] is the test command, [`python`], [`examples`], [`cluster`] and [`documents`] its last
//! steps, [`office`] and [`weather`] the generators behind `examples/office/` and
//! `examples/daylight-office/`, [`cie171`] and [`octant`] those of cases in `validation/`,
//! [`experiments`] that of `research/experiments.md`, [`reference`] that of
//! `docs/project-reference.md`, [`gauntlet`] builds and runs `quasilux-gauntlet`.
//! The rules that no compiler checks are in
//! `tests/architecture/`.

mod arrows;
mod cie171;
mod cluster;
mod documents;
mod examples;
mod expectation;
mod experiments;
mod figures;
mod gauntlet;
mod generated;
mod octant;
mod office;
mod package;
mod prediction;
mod python;
mod reference;
mod release;
mod same_bits;
mod steps;
mod weather;
#[cfg(test)]
mod workflows;
mod wrap;

use std::path::Path;
use std::process::ExitCode;
use xtask::workspace::root as workspace_root;

const HELP: &str = "\
The project's own commands.

cargo xtask test           everything that CI checks, in this order
cargo xtask test fmt       formatting
cargo xtask test clippy    lints, warnings denied
cargo xtask test fuzz      the fuzz targets compile, lints included
cargo xtask test tests     all tests of the workspace
cargo xtask test docs      documentation, warnings denied
cargo xtask test package   the crates to publish compile from their packages
cargo xtask test deny      licences, doubles and sources of dependencies
cargo xtask test release   what a release is made of: archive, notes, order of crates
cargo xtask test python    the Python package: wheel, tests, types, documentation
cargo xtask test examples  every example runs and gives the numbers it promises
cargo xtask test gauntlet  a short part of the gauntlet, whose references are shipped
cargo xtask test documents every command of the documentation runs and prints what it shows
cargo xtask test deep      all tests, in variants that take long and find smaller errors
cargo xtask deep           the same
cargo xtask arrows CRATE   imports between the modules of a crate that no order allows
cargo xtask order CRATE    an order of a crate's rooms with few imports against it
cargo xtask order CRATE write   put that order into xtask/order.toml
cargo xtask ratchet        write the lists of known violations anew, which may only shrink
cargo xtask ratchet new    the same after a rule was added, when they may grow
cargo xtask messages       write the list of all texts that a user can see anew
cargo xtask figures [PATH] sizes of all crates and of their module graphs, here or elsewhere
cargo xtask octant         write the mirror octant in validation/ from its generator
cargo xtask office         write examples/office/ from its generator
cargo xtask weather        write the weather of examples/daylight-office/ from its generator
cargo xtask cie171         write the cases of CIE 171:2006 in validation/ from their generator
cargo xtask gauntlet ..    hard rooms at random against a reference; --help lists its options
cargo xtask experiments    write research/experiments.md from what the experiments wrote
cargo xtask reference      write the tables of docs/project-reference.md from `quasilux keys`
cargo xtask pictures       write the pictures of the documentation from the commands beside them
cargo xtask crates         print the crates to publish, in the order in which a registry takes them
cargo xtask notes VERSION  print what the changelog says of a version
cargo xtask dist TARGET    build the program for a target, and pack it with manual and completions
cargo xtask help           this text
";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["help" | "--help" | "-h"] => {
            print!("{HELP}");
            Ok(())
        }
        ["test"] => steps::run_all(),
        ["test", name] => steps::run_one(name),
        ["deep"] => steps::run_one("deep"),
        ["arrows", name] => arrows::print_forbidden(&workspace_root(), name),
        ["order", name] => arrows::print_order(&workspace_root(), name),
        ["order", name, "write"] => arrows::write_order(&workspace_root(), name),
        ["ratchet"] => xtask::ratchet::write(&workspace_root(), false),
        ["ratchet", "new"] => xtask::ratchet::write(&workspace_root(), true),
        ["messages"] => xtask::messages::write(&workspace_root()),
        ["figures"] => figures::print(&workspace_root()),
        ["figures", path] => figures::print(Path::new(path)),
        ["gauntlet", ref options @ ..] => gauntlet::run(&workspace_root(), options),
        ["cie171"] => cie171::write(&workspace_root()),
        ["experiments"] => experiments::write(&workspace_root()),
        ["crates"] => release::print_crates(&workspace_root()),
        ["notes", version] => release::print_notes(&workspace_root(), version),
        ["dist", target] => release::pack_target(&workspace_root(), target),
        ["reference"] => reference::write(&workspace_root()),
        ["pictures"] => documents::draw(&workspace_root()),
        ["octant"] => octant::write(&workspace_root()),
        ["weather"] => weather::write(&workspace_root()),
        ["office"] => office::write(&workspace_root()),
        _ => Err(format!("no such command: {:?}\n\n{HELP}", words.join(" "))),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("xtask: {failure}");
            ExitCode::FAILURE
        }
    }
}
