//! The command: references, runs, and the report of all.

use crate::digest::Fnv;
use crate::effort::{Effort, HELP, Part, RoomName};
use crate::families;
use crate::families::room_of;
use crate::record::{self, RunKey, RunRecord};
use crate::references::{ReferenceStore, RoomReferences};
use crate::report::{Report, Subject};
use crate::room::Room;
use crate::trial::RunSettings;
use crate::truth::{self, DiscReferences, Truth};
use quasilux_transport::Settings;
use std::fs;
use std::io;
use std::path::Path;

/// Fewer references than this judge nothing, where they are the only ones: a share of the rooms.
const MIN_KNOWN: f64 = 0.5;

/// Does what the options ask for; whether all claims hold.
///
/// # Errors
/// When options make no sense, or files cannot be written.
pub fn run(arguments: &[String]) -> Result<bool, String> {
    let effort = Effort::parse(arguments)?;
    match effort.part {
        Part::Help => print!("{HELP}"),
        Part::List => list(),
        Part::Write => write_projects(&effort)?,
        Part::All | Part::References => return measured(&effort),
    }
    Ok(true)
}

fn list() {
    for family in &families::ALL {
        let ways = room_of(family.name, 0).map(|room| room.witness().join(", "));
        println!("{}: {}", family.name, ways.unwrap_or_default());
    }
}

fn rooms(effort: &Effort) -> Vec<Room> {
    let room = |name: RoomName| room_of(name.family, name.number);
    effort.names().into_iter().filter_map(room).collect()
}

/// The name of a room, for people.
fn told(room: &Room) -> String {
    let parameters: Vec<String> = room.parameters.iter().map(ToString::to_string).collect();
    format!("{} {} ({})", room.family, room.number, parameters.join(", "))
}

fn write_projects(effort: &Effort) -> Result<(), String> {
    for room in rooms(effort) {
        let name = format!("{}-{}", room.family.replace(' ', "-"), room.number);
        let folder = effort.out.join("rooms").join(name);
        let files = room.project();
        let written = fs::create_dir_all(&folder).and_then(|()| {
            fs::write(folder.join("room.toml"), &files.project)?;
            files.others.iter().try_for_each(|it| fs::write(folder.join(&it.name), &it.text))
        });
        written.map_err(|error| format!("{}: {error}", folder.display()))?;
        println!("{}: {}", folder.display(), told(&room));
    }
    Ok(())
}

fn measured(effort: &Effort) -> Result<bool, String> {
    let failed = |error: io::Error| format!("{}: {error}", effort.out.display());
    fs::create_dir_all(&effort.out).map_err(failed)?;
    let rooms = rooms(effort);
    let (mut references, mut rooms_left_out) = (Vec::new(), Vec::new());
    let store = ReferenceStore {
        folder: effort.out.join("references"),
        relative_error: 0.2 * effort.rel_tol,
        seconds: effort.reference_seconds,
    };
    for room in &rooms {
        let known = store.for_room(room).map_err(failed)?;
        let usable = |it: &RoomReferences| {
            it.points.iter().filter(|point| point.can_judge(effort.rel_tol)).count()
        };
        let count = known.as_ref().map_or(0, usable);
        println!("reference: {count} of {} places, {}", room.places.len(), told(room));
        match known.filter(|_| count > 0) {
            Some(known) => references.push(known),
            None => rooms_left_out.push(told(room)),
        }
    }
    if effort.part == Part::References {
        return Ok(true);
    }
    let is_known = |room: &&Room| references.iter().any(|it| it.digest == room.digest());
    let known: Vec<&Room> = rooms.iter().filter(is_known).collect();
    let runs = all_runs(effort, &known)?;
    let truths = truths(&store, &known, references, &runs).map_err(failed)?;
    let report = Report::new(&Subject {
        runs: &runs,
        truths: &truths,
        estimators: &effort.estimators,
        limits_s: &effort.limits_s,
        rooms_left_out: &rooms_left_out,
    });
    println!("\n{}", report.markdown);
    fs::write(effort.out.join("report.md"), &report.markdown).map_err(failed)?;
    let are_enough = known.len() as f64 >= MIN_KNOWN * rooms.len() as f64;
    if !are_enough {
        println!("only {} of {} rooms have references", known.len(), rooms.len());
    }
    Ok(report.holds && are_enough)
}

/// The references, and those of the discs over which runs blur.
fn truths(
    store: &ReferenceStore,
    rooms: &[&Room],
    references: Vec<RoomReferences>,
    runs: &[RunRecord],
) -> io::Result<Vec<Truth>> {
    let truth = |points: RoomReferences| {
        let room = rooms.iter().find(|room| room.digest() == points.digest);
        let radii_m = truth::blurred_places(runs, &points.digest, points.points.len());
        let is_blurred = radii_m.iter().any(Option::is_some);
        let Some(room) = room.filter(|_| is_blurred) else {
            return Ok(Truth { points, discs: None });
        };
        let references = store.for_room(&room.with_discs(&radii_m))?;
        let discs = references.map(|references| DiscReferences { radii_m, references });
        Ok(Truth { points, discs })
    };
    references.into_iter().map(truth).collect()
}

/// One run after the other: each has all threads to itself while its time counts.
fn all_runs(effort: &Effort, rooms: &[&Room]) -> Result<Vec<RunRecord>, String> {
    let path = effort.out.join("runs.jsonl");
    let failed = |error: io::Error| format!("{}: {error}", path.display());
    let kept = record::read(&path).map_err(failed)?;
    let program = program_digest()?;
    let mut runs = Vec::new();
    for room in rooms {
        let run_settings = RunSettings::new(room);
        for &estimator in &effort.estimators {
            for seed in effort.first_seed..effort.first_seed + effort.seeds {
                let key = RunKey {
                    program: program.clone(),
                    family: room.family.to_owned(),
                    number: room.number,
                    digest: room.digest(),
                    estimator,
                    rel_tol: effort.rel_tol,
                    limits_s: effort.limits_s.clone(),
                    seed,
                };
                if let Some(done) = kept.iter().find(|run| run.key == key) {
                    runs.push(done.clone());
                    continue;
                }
                let run = new_run(&run_settings, key);
                record::append(&path, &run).map_err(failed)?;
                runs.push(run);
            }
        }
        println!("ran: {} {}", room.family, room.number);
    }
    Ok(runs)
}

fn new_run(run_settings: &Result<RunSettings, String>, key: RunKey) -> RunRecord {
    let RunKey { estimator, rel_tol, seed, .. } = key;
    let settings = Settings { estimator, seed, rel_tol, ..Settings::default() };
    let outcome = match run_settings {
        Ok(run_settings) => run_settings.run(&settings, &key.limits_s),
        Err(error) => record::RunOutcome::Refused(error.clone()),
    };
    RunRecord { key, outcome }
}

/// What tells this program from others: a hash of its file.
fn program_digest() -> Result<String, String> {
    let path = std::env::current_exe().map_err(|error| error.to_string())?;
    let bytes =
        fs::read(Path::new(&path)).map_err(|error| format!("{}: {error}", path.display()))?;
    let mut hash = Fnv::new();
    hash.bytes(&bytes);
    Ok(hash.text())
}
