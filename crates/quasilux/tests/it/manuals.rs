//! `quasilux --help`, `completions` and `man`: every command is in each of them.

use crate::support::Folder;

const COMMANDS: [&str; 18] = [
    "run",
    "annual",
    "check",
    "sky",
    "validate",
    "experiment",
    "points",
    "photometry",
    "bsdf",
    "plan",
    "shard",
    "merge",
    "resume",
    "import",
    "export",
    "keys",
    "completions",
    "man",
];

fn printed(folder: &Folder, arguments: &[&str]) -> String {
    let run = folder.quasilux(arguments);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{arguments:?}");
    run.stdout
}

#[test]
fn the_help_lists_all_commands_and_nothing_else() {
    let folder = Folder::new("manuals_help");
    let help = printed(&folder, &["--help"]);
    let (_, list) = help.split_once("Commands:\n").expect("a list of commands");
    let (list, _) = list.split_once("\n\n").expect("options after it");
    let names: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    assert_eq!(names, [&COMMANDS[..], &["help"]].concat());
}

#[test]
fn completions_know_all_commands_options_and_names() {
    let folder = Folder::new("manuals_completions");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = printed(&folder, &["completions", shell]);
        for word in COMMANDS.into_iter().chain(["rel-tol", "seconds-per-point"]) {
            assert!(script.contains(word), "{shell} does not know {word}");
        }
        // The others complete not all values.
        let knows_values = ["bash", "zsh"].contains(&shell);
        for name in ["bidirectional-map", "octant", "hammersley"].iter().filter(|_| knows_values) {
            assert!(script.contains(name), "{shell} does not know {name}");
        }
    }
    assert_eq!(folder.quasilux(&["completions", "tcsh"]).code, Some(2));
}

#[test]
fn the_manual_has_a_page_for_every_command() {
    let folder = Folder::new("manuals_man");
    let program = printed(&folder, &["man"]);
    assert!(program.contains(".TH quasilux 1"), "{program}");
    printed(&folder, &["man", "--out", "man1"]);
    assert_eq!(folder.read("man1/quasilux.1"), program);
    for command in COMMANDS {
        let page = folder.read(&format!("man1/quasilux-{command}.1"));
        assert!(page.contains(&format!(".TH quasilux-{command} 1")), "{page}");
        assert!(program.contains(&format!("quasilux\\-{command}(1)")), "{command}: {program}");
        assert_eq!(printed(&folder, &["man", command]), page);
    }
    let pages = std::fs::read_dir(folder.path("man1")).expect("a folder").count();
    assert_eq!(pages, COMMANDS.len() + 1);
    let run = folder.quasilux(&["man", "rum"]);
    assert!(run.code == Some(2) && run.stderr.contains("did you mean \"run\"?"), "{}", run.stderr);
}

/// With a line for each, so that nobody has to guess.
#[test]
fn the_help_of_experiments_lists_their_names() {
    let folder = Folder::new("manuals_experiments");
    let help = printed(&folder, &["experiment", "--help"]);
    for experiment in &quasilux_experiments::EXPERIMENTS {
        let line = help
            .lines()
            .find(|line| line.trim_start().starts_with(&format!("- {}:", experiment.name)));
        assert!(line.is_some_and(|line| line.ends_with(experiment.shows)), "{help}");
    }
}
