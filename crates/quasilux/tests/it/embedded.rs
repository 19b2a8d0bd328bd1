//! The program inside another one: the results of the command line, and runs that a listener stops.

use crate::scenes::{Look, write_room};
use crate::support::{Folder, without_seconds_and_threads};
use quasilux::embedded::{
    Event, Order, Project, ResumableRun, ResumeOptions, RunOptions, Share, Source, Stopped,
    simulate, write,
};
use quasilux_transport::Control;
use std::path::Path;

const OPTIONS: [&str; 2] = ["--rel-tol=1e-9", "--samples=64"];

fn room(name: &str) -> Folder {
    let folder = Folder::new(name);
    write_room(&folder, "room", &Look::GREY);
    folder
}

/// Values of the words in [`OPTIONS`].
fn options() -> RunOptions {
    let rel_tol = Some(Share::Number(1e-9));
    RunOptions { rel_tol, samples: Some(64), ..RunOptions::default() }
}

fn order(options: &RunOptions) -> Order {
    Order::new(options).expect("options of a run")
}

/// The room as a program would have it in memory.
fn in_memory(folder: &Folder) -> Source {
    ["lamp.ies", "room.obj"]
        .into_iter()
        .fold(Source::in_memory("room.toml", folder.read("room.toml")), |source, name| {
            source.with_file(name, folder.read(name).into_bytes())
        })
}

#[test]
fn results_are_those_of_the_command_line() {
    let folder = room("embedded_results");
    let expected = folder.document("room.toml", "theirs", &OPTIONS, 3);
    let sources = [
        Project::open(&folder.path("room.toml")).unwrap(),
        Project::load(in_memory(&folder)).unwrap(),
        Project::load(
            Source::in_memory("x", folder.read("room.toml")).with_folder(&folder.path("")),
        )
        .unwrap(),
    ];
    for project in sources {
        let finished = simulate(&project, &order(&options()), None).unwrap();
        assert_eq!((finished.stopped, finished.exit.code()), (None, 3));
        write(&folder.path("ours"), &project, &finished).unwrap();
        let own = folder.read("ours/result.json");
        assert_eq!(without_seconds_and_threads(&own), without_seconds_and_threads(&expected));
        assert_eq!(folder.read("ours/plane.csv"), folder.read("theirs/plane.csv"));
    }
}

/// A run of a project in memory is kept with its scene, so that the command line can go on with it.
#[test]
fn a_listener_stops_a_run_at_a_checkpoint_and_it_goes_on() {
    let folder = room("embedded_stopped");
    let project = Project::load(in_memory(&folder)).unwrap();
    let mut samples = Vec::new();
    let listen = |event: Event<'_>| match event {
        Event::Progress(_) => Control::Continue,
        Event::Checkpoint(estimates) => {
            samples.push(estimates.samples);
            if estimates.samples < 32 { Control::Continue } else { Control::Stop }
        }
    };
    let options = order(&RunOptions { checkpoint: Some(folder.path("run.ck")), ..options() });
    let stopped = simulate(&project, &options, Some(Box::new(listen))).unwrap();
    assert_eq!((stopped.stopped, stopped.report.run.samples), (Some(Stopped::Listener), 32));
    assert_eq!(samples, [1, 2, 4, 8, 16, 32]);
    let expected = folder.document("room.toml", "whole", &OPTIONS, 3);
    std::fs::copy(folder.path("run.ck"), folder.path("other.ck")).unwrap();
    let one_thread = ResumeOptions { threads: Some(1), ..ResumeOptions::default() };
    let on = ResumableRun::read(&folder.path("run.ck"), &one_thread).unwrap();
    assert_eq!(on.project_file(), folder.path("run.ck.scene"));
    let finished = on.go_on(&project, None).unwrap();
    let sensors = |text: &str| text[..text.find("\"run\"").expect("a run")].to_owned();
    write(&folder.path("ours"), &project, &finished).unwrap();
    assert_eq!(sensors(&folder.read("ours/result.json")), sensors(&expected));
    let run = folder.quasilux(&["resume", "other.ck", "--out", "theirs", "--quiet"]);
    assert_eq!(run.code, Some(3), "{}", run.stderr);
    assert_eq!(sensors(&folder.read("theirs/result.json")), sensors(&expected));
}

#[test]
fn bundles_are_projects_for_the_command_line() {
    let folder = room("embedded_bundle");
    let expected = folder.document("room.toml", "theirs", &OPTIONS, 3);
    let project = Project::open(&folder.path("room.toml")).unwrap();
    folder.write("packed/room.scene", project.to_bundle().unwrap());
    let own = folder.document("packed/room.scene", "ours", &OPTIONS, 3);
    assert_eq!(without_seconds_and_threads(&own), without_seconds_and_threads(&expected));
    folder.write("cut.scene", &project.to_bundle().unwrap()[..100]);
    let run = folder.quasilux(&["run", "cut.scene"]);
    assert_eq!(run.code, Some(2));
    assert_eq!(run.stderr, "error: cut.scene: is damaged: it was cut short or changed\n");
    folder.write("lamp.ies", "other");
    let error = project.to_bundle().unwrap_err();
    assert_eq!(error.to_string(), "lamp.ies: has changed since the scene was loaded");
}

#[test]
fn what_makes_no_sense_is_told() {
    let folder = room("embedded_refused");
    let doubtful = RunOptions { rel_tol: Some(Share::Number(2.0)), ..RunOptions::default() };
    let error = Order::new(&doubtful).expect_err("a refusal").to_string();
    assert!(error.starts_with("rel_tol: ") && error.contains("was 2 % meant?"), "{error}");
    let project = Project::open(&folder.path("room.toml")).unwrap();
    let hammersley =
        RunOptions { sequence: Some("hammersley".to_owned()), ..RunOptions::default() };
    let error = simulate(&project, &order(&hammersley), None).err();
    let error = error.expect("a refusal");
    assert!(error.message().contains("give --samples") && error.file().is_none(), "{error}");
    let missing = Project::open(Path::new("none.toml")).err().expect("a refusal");
    assert_eq!((missing.file(), missing.place()), (Some("none.toml"), None));
    folder.write("room.toml", "\n\n[scene]\ngeometry = 3\n");
    let error = Project::open(&folder.path("room.toml")).err().expect("a refusal");
    assert_eq!(error.place().map(|place| (place.line, place.column)), Some((4, 12)));
    assert!(error.file().is_some_and(|file| file.ends_with("room.toml")));
}
