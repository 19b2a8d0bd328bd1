//! A room of a quasilux project file by brute force, beside the values of another program.
//!
//! ```text
//! cargo run --release -p quasilux-brute --example room -- ROOM.toml WAYS.toml --seconds 60
//! ```
//!
//! `ROOM.toml` is a project file, of which a part is understood; `WAYS.toml` says where to look and
//! by which mode each light is found, `rooms/` of this crate has some. Two runs with two seeds take
//! half the time each. With `--beside FILE` the values after `"lux":` and `"se":` in that file
//! stand beside, in the order of the sensors.

mod obj;
mod photometry;
mod project;
mod ways;

use quasilux_brute::{Estimate, Limits, Scene, largest_disagreement, solve_parts};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};
use ways::Ways;

/// What the command line asks for.
struct Asked {
    room: PathBuf,
    ways: PathBuf,
    beside: Option<PathBuf>,
    seconds: f64,
    relative_error: f64,
    seed: u64,
}

fn main() -> ExitCode {
    match asked().and_then(|asked| run(&asked)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn asked() -> Result<Asked, String> {
    let (mut files, mut beside) = (Vec::new(), None);
    let (mut seconds, mut relative_error, mut seed) = (60.0, 0.001, 1);
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or_else(|| format!("{word} needs a value"));
        match word.as_str() {
            "--beside" => beside = Some(PathBuf::from(value()?)),
            "--seconds" => seconds = number(&value()?)?,
            "--error" => relative_error = number(&value()?)?,
            "--seed" => seed = number(&value()?)? as u64,
            _ => files.push(PathBuf::from(word)),
        }
    }
    let [room, ways] = <[PathBuf; 2]>::try_from(files).map_err(
        |_| "expected ROOM.toml WAYS.toml [--beside FILE] [--seconds S] [--error E] [--seed N]",
    )?;
    Ok(Asked { room, ways, beside, seconds, relative_error, seed })
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("{text} is no number"))
}

/// The text of a file, whatever its bytes.
fn text(path: &Path) -> Result<String, String> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

fn run(asked: &Asked) -> Result<(), String> {
    let mut scene = project::read(&asked.room)?;
    let ways = Ways::read(&text(&asked.ways)?, &mut scene)?;
    let [one, other] = [0, 1].map(|seed| half(asked, &scene, &ways, asked.seed + seed));
    let beside = match &asked.beside {
        Some(path) => values_of(&text(path)?),
        None => Vec::new(),
    };
    println!("sensor          lx      s.e.  largest  | beside lx      s.e.      z");
    let (mut most, mut worst) = (0.0_f64, 0.0_f64);
    for (number, (a, b)) in one.iter().zip(&other).enumerate() {
        let Estimate { lx, standard_error_lx: error, largest_share, .. } = a.joined(b);
        let percent = 100.0 * error / lx;
        worst = worst.max(percent);
        print!("{number:6} {lx:11.6} {percent:7.3} % {largest_share:8.5}");
        if let Some(&[known_lx, known_error]) = beside.get(number) {
            let z = (lx - known_lx) / error.hypot_with(known_error);
            most = most.max(z.abs());
            let known_percent = 100.0 * known_error / known_lx;
            print!("  | {known_lx:11.6} {known_percent:7.3} % {z:6.2}");
        }
        println!();
    }
    let seeds = largest_disagreement(&one, &other);
    println!("worst s.e. {worst:.3} %, seeds differ by {seeds:.2} s.e., from beside by {most:.2}");
    Ok(())
}

/// One run with half of the time.
#[expect(clippy::disallowed_methods, reason = "a command line, which reads the clock")]
fn half(asked: &Asked, scene: &Scene, ways: &Ways, seed: u64) -> Vec<Estimate> {
    let start = Instant::now();
    let time = Duration::from_secs_f64(0.5 * asked.seconds);
    let limits = Limits { relative_error: asked.relative_error, paths: u64::MAX };
    solve_parts(scene, &ways.parts, limits, seed, || start.elapsed() < time)
}

/// A pair of errors as one.
trait Quadrature {
    fn hypot_with(self, other: f64) -> f64;
}

impl Quadrature for f64 {
    fn hypot_with(self, other: f64) -> f64 {
        (self * self + other * other).sqrt()
    }
}

/// Numbers after `"lux":` and the `"se":` that follows.
fn values_of(text: &str) -> Vec<[f64; 2]> {
    let after = |part: &str, key: &str| {
        let rest = part.split_once(key)?.1.trim_start();
        let end = rest.find([',', '}', ' ', '\n']).unwrap_or(rest.len());
        rest[..end].parse().ok()
    };
    let values = text.split("\"lux\":").skip(1);
    values
        .filter_map(|part| {
            let lx = after(&format!("={part}"), "=")?;
            Some([lx, after(part, "\"se\":")?])
        })
        .collect()
}
