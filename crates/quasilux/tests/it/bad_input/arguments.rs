//! Arguments that make no sense.

use super::{Case, check};

#[test]
fn options() {
    let value = |what, arguments: &[&'static str], needle| {
        Case::new(what).with(arguments).says(&[arguments[0], needle])
    };
    check(
        "options",
        &[
            value("a word for a share", &["--rel-tol", "fine"], "1%"),
            value("a share of zero", &["--rel-tol", "0"], "1%"),
            value("a share over all", &["--rel-tol", "101%"], "1%"),
            value("a share that is no number", &["--rel-tol", "nan"], "1%"),
            value("a negative time", &["--time=-3s"], "60s"),
            value("a time in days", &["--time", "1d"], "60s"),
            value("a share that means percent", &["--rel-tol", "1"], "was 1 % meant?"),
            value("no samples", &["--samples", "0"], "expected a whole number from 1 to "),
            value("a word for samples", &["--samples", "many"], "many"),
            value("no threads", &["--threads", "0"], "expected a whole number from 1 to 1024"),
            value("a million threads", &["--threads", "1000000"], "\"1000000\"; expected"),
            value("a negative seed", &["--seed=-1"], "-1"),
            value("unknown estimator", &["--estimator", "radiosity"], "one of auto, photon"),
            value("unknown sequence", &["--sequence", "sobel"], "did you mean \"sobol\"?"),
            value("unknown option", &["--sampels", "3"], "did you mean \"--samples\"?"),
            value("an option without its value", &["--out"], "value"),
            value("an option twice", &["--seed", "1", "--seed", "2"], "is given twice"),
        ]
        .map(|mut case| {
            // The option stands for itself where its value is part of the argument.
            let option = case.needles[0];
            case.needles[0] = option.split('=').next().unwrap_or(option);
            case
        }),
    );
}

#[test]
fn commands_and_paths() {
    check(
        "commands",
        &[
            Case::new("unknown command")
                .instead(&["rum", "project.toml"])
                .says(&["rum", "did you mean \"run\"?"]),
            Case::new("no project").instead(&["run"]).says(&["<PROJECT>"]),
            Case::new("two projects").with(&["project.toml"]).says(&["unexpected"]),
            Case::new("a project that is not there")
                .instead(&["run", "nowhere/office.toml"])
                .says(&["nowhere/office.toml: "]),
            Case::new("a folder for a project")
                .file("folder/note.txt", "")
                .instead(&["run", "folder"])
                .says(&["folder: "]),
            Case::new("a file where the results go")
                .file("results", "")
                .with(&["--out", "results"])
                .says(&["results: ", "cannot write"]),
            Case::new("a file above where the results go")
                .file("results", "")
                .with(&["--out", "results/of/today"])
                .says(&["results/of/today: ", "cannot write"]),
            Case::new("a surface that is not there").instead(&["bsdf", "x.xml"]).says(&["x.xml: "]),
            Case::new("unknown experiment").instead(&["experiment", "octave"]).says(&[
                "octave",
                "expected one of cube",
                "did you mean \"octant\"?",
            ]),
            Case::new("no cases").instead(&["validate", "nowhere"]).says(&["cases: "]),
        ],
    );
}

#[test]
fn combinations() {
    check(
        "combinations",
        &[
            Case::new("no interval and no limit")
                .replace("randomization = \"owen\"", "randomization = \"none\"")
                .says(&["--samples", "interval"]),
            Case::new("one replicate and no limit")
                .replace("rel_tol = 0.5", "replicates = 1")
                .says(&["--samples", "interval"]),
            Case::new("photons through a tilted grid")
                .replace("counts = [2, 2]", "counts = [2, 2]\nnormal = [0, 1, 1]")
                .with(&["--estimator", "photon"])
                .says(&["\"plane\"", "normal"]),
        ],
    );
}
