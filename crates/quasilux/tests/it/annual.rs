//! `quasilux annual`: the hours of weather files.

use crate::support::{Folder, number, parsed};
use quasilux::embedded::{self, Project, Share, YearFile, YearOptions, YearOrder};
use quasilux_transport::Control;

/// A day and a bit more, hour by hour: illuminances of sun and sky at noon, and nothing known but
/// darkness else.
fn weather() -> String {
    let mut text = "place Here\nlatitude 37.72\nlongitude 122.22\ntime_zone 120\n\
        site_elevation 2\nweather_data_file_units 3\n"
        .to_owned();
    for day in 20..22 {
        for hour in 0..24 {
            let light = match (day, hour) {
                (20, 11) => "0 9000",
                (20, 12) => "60000 12000",
                (21, 12) => "0 250",
                _ => "0 0",
            };
            text += &format!("3 {day} {hour}.5 {light}\n");
        }
    }
    text
}

const FLOOR: &str = "o floor\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

fn folder(name: &str, rest: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("floor.obj", FLOOR);
    folder.write("site.wea", weather());
    let project = format!(
        "[scene]\ngeometry = [\"floor.obj\"]\n{rest}\n[[sensors]]\nname = \"roof\"\n\
         kind = \"grid\"\norigin = [0.25, 0.25, 1]\nu = [0.5, 0, 0]\nv = [0, 0.5, 0]\n\
         counts = [2, 1]\nnormal = [0, 0, 1]\n"
    );
    folder.write("a.toml", project);
    folder
}

const WEATHER: &str = "[weather]\nfile = \"site.wea\"\n[sky]\nmodel = \"weather\"\n";

/// Under an open sky illuminances are those of the file, and so are all measures.
#[test]
fn hours_under_the_open_sky_are_those_of_the_file() {
    let folder = folder("annual_open", WEATHER);
    let done = folder.quasilux(&["annual", "a.toml", "--out", "out", "--rel-tol", "1%"]);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    assert!(done.stdout.contains("sDA (300 lx, 50 %)"), "{}", done.stdout);
    let hours = folder.read("out/hours.csv");
    let rows: Vec<Vec<&str>> = hours.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!(rows.len(), 48);
    let figure = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    for (row, lx) in [(10, 0.0), (11, 9000.0), (36, 250.0)] {
        assert!((figure(row, 9) - lx).abs() <= 0.01 * lx, "{row}: {}", figure(row, 9));
    }
    let sine = libm::sin(figure(12, 4).to_radians());
    let noon = 12_000.0 + 60_000.0 * sine;
    assert!((figure(12, 9) / noon - 1.0).abs() < 0.005, "{} not {noon}", figure(12, 9));
    let document = parsed(&folder.read("out/annual.json"));
    let point = |key: &str| number(&document, &format!("/sensors/0/points/1/{key}"));
    // Of 20 occupied hours two have more than 300 lx, and one has a part of it.
    assert!((point("daylight_autonomy") - 0.1).abs() < 1e-12);
    assert!((point("continuous_daylight_autonomy") - (2.0 + 250.0 / 300.0) / 20.0).abs() < 1e-3);
    assert!((point("udi_supplementary") - 0.05).abs() < 1e-12);
    assert!((point("udi_too_much") - 0.1).abs() < 1e-12);
    assert_eq!((point("sunlit_hours"), point("hours/undecided")), (1.0, 0.0));
    let exposure = noon + 9000.0 + 250.0;
    assert!((point("exposure_lx_h") / exposure - 1.0).abs() < 0.005);
    assert_eq!(number(&document, "/sensors/0/summary/sda/value"), 0.0);
    for name in ["roof.annual.csv", "roof.hours.png", "roof.daylight_autonomy.png"] {
        assert!(folder.path(&format!("out/{name}")).exists(), "{name}");
    }
    let bytes = std::fs::read(folder.path("out/hours.npy")).unwrap();
    assert_eq!(bytes.len(), 128 + 4 * 2 * 2 * 48);
    let value = |index: usize| {
        let at = 128 + 4 * index;
        f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap())
    };
    assert!((value(12) - value(2 * 48 + 12)).abs() < 0.005 * value(12), "two points, one sky");
    assert!((f64::from(value(12)) / noon - 1.0).abs() < 0.005 && value(48 + 12) < value(12) * 0.01);
}

/// A program that carries this one gets the files of the command line in memory.
#[test]
fn a_year_in_memory_has_the_files_of_the_command_line() {
    let folder = folder("annual_in_memory", WEATHER);
    let words = ["--rel-tol=5%", "--occupied=8-18"];
    let command = ["annual", "a.toml", "--out", "out", "--quiet"];
    let done = folder.quasilux(&[&command[..], &words].concat());
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    let project = Project::open(&folder.path("a.toml")).unwrap();
    let options = YearOptions {
        rel_tol: Some(Share::Text("5%".to_owned())),
        occupied_h: Some(8.0..18.0),
        ..YearOptions::default()
    };
    let order = YearOrder::new(&options).unwrap();
    let year = embedded::annual(&project, &order, None).unwrap();
    assert!(year.is_complete && year.table.contains("sDA (300 lx, 50 %)"), "{}", year.table);
    let theirs = std::fs::read_dir(folder.path("out")).unwrap();
    assert_eq!(theirs.count(), year.files.len());
    for YearFile { name, content } in &year.files {
        let theirs = std::fs::read(folder.path(&format!("out/{name}"))).unwrap();
        if name == "annual.json" {
            let [own, theirs] = [content, &theirs].map(|it| parsed(&String::from_utf8_lossy(it)));
            for key in ["sensors", "hours", "warnings", "tolerance_reached"] {
                assert_eq!(own[key], theirs[key], "{key}");
            }
        } else {
            assert!(*content == theirs, "{name}");
        }
    }
    let stopped = embedded::annual(&project, &order, Some(&|_| Control::Stop)).unwrap();
    assert!(!stopped.is_complete && stopped.calendar.intervals.len() == 48);
}

#[test]
fn what_has_no_year_is_refused() {
    let uniform = "[sky]\nmodel = \"uniform\"\nhorizontal_illuminance_lx = 100\n";
    for (name, rest, more, needle) in [
        ("annual_no_weather", uniform, &[][..], "no weather; add [weather] with file"),
        ("annual_hours", WEATHER, &["--occupied", "18-8"], "expected hours of a day, like 8-18"),
        ("annual_tolerance", WEATHER, &["--rel-tol", "0"], "expected a share"),
    ] {
        let refused = folder(name, rest).quasilux(&[&["annual", "a.toml"], more].concat());
        assert_eq!(refused.code, Some(2), "{name}: {}", refused.stdout);
        assert!(refused.stderr.contains(needle), "{name}: {}", refused.stderr);
    }
}

/// A limit ends a year before its tolerance, and threads change no bit of it.
#[test]
fn limits_and_threads() {
    let folder = folder("annual_limits", WEATHER);
    let run = |threads: &str, out: &str| {
        let tolerance = ["--rel-tol", "0.0001", "--samples", "64", "--quiet"];
        let named = ["annual", "a.toml", "--threads", threads, "--out", out];
        let done = folder.quasilux(&[&named[..], &tolerance].concat());
        assert_eq!((done.code, done.stdout.as_str()), (Some(3), ""), "{}", done.stderr);
        std::fs::read(folder.path(&format!("{out}/hours.npy"))).unwrap()
    };
    assert_eq!(run("1", "one"), run("3", "three"));
}

/// A sheet over the sensor that lets half of the light through: in the hour in which the sun shines
/// on the points, or in those of a schedule, hours have half of it. Lamps are dimmed by what is
/// left.
#[test]
fn blinds_close_and_lamps_are_dimmed() {
    let blinds = "[blinds]\ngeometry = [\"sheet.obj\"]\n\
        materials.sheet = { reflectance = 0, transmittance = 0.5 }\n";
    let light = "[electric_light]\nsensor = \"roof\"\ntarget_lx = 500\npower_w = 100\n";
    let scheduled = "control = \"schedule\"\nschedule = \"blinds.csv\"\ncolumn = \"roof\"\n";
    let sheet = "usemtl sheet\nv -99 -99 1.1\nv 99 -99 1.1\nv 99 99 1.1\nv -99 99 1.1\nf 1 2 3 4\n";
    for (name, control, closed_at) in [
        ("annual_blinds_sun", "", [false, true, false]),
        ("annual_blinds_schedule", scheduled, [true, false, true]),
    ] {
        let folder = folder(name, &format!("{WEATHER}{blinds}{control}{light}"));
        folder.write("sheet.obj", sheet);
        let rows = (0..48).map(|hour| format!("{hour},{}\n", i32::from(hour != 12)));
        folder.write("blinds.csv", "hour,roof\n".to_owned() + &rows.collect::<String>());
        let done = folder.quasilux(&["annual", "a.toml", "--out", "out", "--rel-tol", "1%"]);
        assert_eq!(done.code, Some(0), "{}", done.stderr);
        let hours = folder.read("out/hours.csv");
        let rows: Vec<Vec<&str>> =
            hours.lines().skip(1).map(|row| row.split(',').collect()).collect();
        let figure = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
        let noon = 12_000.0 + 60_000.0 * libm::sin(figure(12, 4).to_radians());
        let expected = [9000.0, noon, 250.0];
        let mut power_w = 1700.0;
        for ((row, lx), is_closed) in [11, 12, 36].into_iter().zip(expected).zip(closed_at) {
            let lx = if is_closed { 0.5 * lx } else { lx };
            let (found, blinds) = (figure(row, 9), figure(row, 8));
            assert!((found / lx - 1.0).abs() < 0.01, "{name} {row}: {found}, not {lx}");
            assert_eq!(blinds, f64::from(u8::from(is_closed)), "{name} {row}");
            power_w += 100.0 * (1.0 - lx / 500.0).max(0.0);
        }
        let document = parsed(&folder.read("out/annual.json"));
        let of = |key: &str| number(&document, key);
        let closed = closed_at.iter().filter(|closed| **closed).count() as f64;
        assert_eq!(of("/blinds/closed_occupied"), closed);
        // Of 20 occupied hours 17 are dark. The sun on open blinds counts all the same.
        let kwh = of("/electric_light/energy_kwh");
        assert!((kwh - 1e-3 * power_w).abs() < 2e-3, "{kwh}, not {power_w} Wh");
        assert_eq!(of("/electric_light/full_power_kwh"), 2.0);
        assert_eq!(of("/sensors/0/points/0/sunlit_hours"), 1.0);
        assert!(done.stdout.contains("blinds closed in"), "{}", done.stdout);
        assert!(done.stdout.contains("kWh a year"), "{}", done.stdout);
    }
}

/// Two sheets one above the other that move by themselves, the upper one to two positions: what
/// comes through is the product of what each lets through. Zones of lamps add up.
#[test]
fn groups_of_blinds_and_zones_of_lamps() {
    let sheet = |name: &str, z: f64| {
        format!(
            "usemtl {name}\nv -99 -99 {z}\nv 99 -99 {z}\nv 99 99 {z}\nv -99 99 {z}\nf 1 2 3 4\n"
        )
    };
    let material = |name: &str, transmittance: f64| {
        format!("materials.{name} = {{ reflectance = 0, transmittance = {transmittance} }}\n")
    };
    let state = |name: &str, transmittance| {
        let head = format!("[[blinds.states]]\nname = \"{name}\"\ngeometry = [\"upper.obj\"]\n");
        head + &material("upper", transmittance)
    };
    let scheduled = |column: &str| {
        format!("control = \"schedule\"\nschedule = \"blinds.csv\"\ncolumn = \"{column}\"\n")
    };
    let upper = "[[blinds]]\nname = \"upper\"\n".to_owned() + &scheduled("upper");
    let upper = upper + &state("half", 0.5) + &state("shut", 0.1);
    let lower = "[[blinds]]\nname = \"lower\"\ngeometry = [\"lower.obj\"]\n".to_owned();
    let zone = |name: &str, target: f64, power: f64| {
        format!(
            "[[electric_light]]\nname = \"{name}\"\nsensor = \"roof\"\ntarget_lx = {target}\n\
             power_w = {power}\n"
        )
    };
    let zones = zone("row 1", 500.0, 100.0) + &zone("row 2", 250.0, 50.0);
    let lower_scheduled = lower.clone() + &scheduled("lower") + &material("lower", 0.5);
    let by_sun = lower + &material("lower", 0.5);
    for (name, lower, factors) in [
        ("annual_groups", lower_scheduled, [0.25, 0.1, 0.5]),
        // The sun shines at noon through both, and the upper one has none of it by its schedule.
        ("annual_groups_sun", by_sun, [0.5, 0.05, 1.0]),
    ] {
        let folder = folder(name, &format!("{WEATHER}{upper}{lower}{zones}"));
        folder.write("upper.obj", sheet("upper", 1.2));
        folder.write("lower.obj", sheet("lower", 1.1));
        let row = |hour: usize| match hour {
            11 => "half,1\n".to_owned(),
            12 => "2,0\n".to_owned(),
            _ => "open,closed\n".to_owned(),
        };
        folder.write(
            "blinds.csv",
            "upper,lower\n".to_owned() + &(0..48).map(row).collect::<String>(),
        );
        let done = folder.quasilux(&["annual", "a.toml", "--out", "out", "--rel-tol", "1%"]);
        assert_eq!(done.code, Some(0), "{}", done.stderr);
        let hours = folder.read("out/hours.csv");
        assert!(hours.starts_with("month,") && hours.contains(",upper_position,lower_position,"));
        let rows: Vec<Vec<&str>> =
            hours.lines().skip(1).map(|row| row.split(',').collect()).collect();
        let figure = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
        let noon = 12_000.0 + 60_000.0 * libm::sin(figure(12, 4).to_radians());
        let mut dark_kwh = 17.0 * 0.15;
        for ((row, lx), factor) in [11, 12, 36].into_iter().zip([9000.0, noon, 250.0]).zip(factors)
        {
            let found = figure(row, 10);
            assert!((found / (factor * lx) - 1.0).abs() < 0.01, "{name} {row}: {found}");
            let missing = |target: f64| (1.0 - factor * lx / target).max(0.0);
            dark_kwh += 0.1 * missing(500.0) + 0.05 * missing(250.0);
        }
        let document = parsed(&folder.read("out/annual.json"));
        let kwh = number(&document, "/electric_light/energy_kwh");
        assert!((kwh - dark_kwh).abs() < 2e-3, "{kwh}, not {dark_kwh}");
        assert_eq!(number(&document, "/electric_light/full_power_kwh"), 3.0);
        assert_eq!(document["electric_light"]["zones"][1]["name"], "row 2");
        assert_eq!(number(&document, "/blinds/groups/0/positions/2/occupied"), 1.0);
        assert_eq!(document["blinds"]["groups"][0]["positions"][1]["name"], "half");
        assert!(
            done.stdout.contains("; upper half in 1 of the occupied, shut in 1 of the occupied")
        );
    }
}

#[test]
fn what_a_year_leaves_out_is_told() {
    let lamp = "[[lights]]\nkind = \"point\"\nposition = [0.5, 0.5, 2]\nintensity_cd = 9\n";
    let camera = "[[cameras]]\nname = \"view\"\nposition = [0.5, 0.5, 3]\ntarget = [0.5, 0.6, 0]\n\
        up = [0, 1, 0]\nvertical_fov_deg = 40\nresolution = [8, 8]\n";
    let time = "[sun]\ntime = 2026-03-20T12:30:00\n";
    let folder = folder("annual_left_out", &format!("{WEATHER}{time}{lamp}{camera}"));
    let done = folder.quasilux(&["annual", "a.toml", "--out", "out", "--rel-tol", "5%"]);
    assert_eq!(done.code, Some(0), "{}", done.stderr);
    let told = "leaves out 1 light, 1 camera, time of [sun] of the project";
    assert!(done.stdout.contains(told), "{}", done.stdout);
}

/// What a year is judged by: other thresholds, hours and days than usual, or a schedule of people.
/// The first of the two days is a Friday in a year that begins with a Thursday: 20 March is the
/// 79th day, so the days are a Friday and a Saturday.
#[test]
fn a_project_says_what_its_year_is_judged_by() {
    let annual = "[annual]\nenough_lx = 200\nuseful_lx = [150, 10000]\noccupied_h = [11, 13]\n";
    let weekdays = format!("{annual}weekends = false\nfirst_day = \"thursday\"\n");
    let scheduled = "[annual]\nschedule = \"people.csv\"\ncolumn = \"all\"\n";
    let command = ["annual", "a.toml", "--out", "out", "--rel-tol", "1%"];
    for (name, rest, more, occupied, text) in [
        ("annual_terms", annual, &[][..], 4.0, "(11 to 13 h)"),
        ("annual_weekdays", &weekdays, &[], 2.0, "(11 to 13 h, Monday to Friday)"),
        ("annual_weekdays_of", &weekdays, &["--occupied", "0-24"], 24.0, "(0 to 24 h, Monday to"),
        ("annual_schedule", scheduled, &[], 3.0, "(by schedule)"),
    ] {
        let folder = folder(name, &format!("{WEATHER}{rest}"));
        let row = |hour: usize| match hour {
            11 => "there\n",
            12 | 36 => "1\n",
            _ => "0\n",
        };
        folder.write("people.csv", "all\n".to_owned() + &(0..48).map(row).collect::<String>());
        let done = folder.quasilux(&[&command[..], more].concat());
        assert_eq!(done.code, Some(0), "{}", done.stderr);
        assert!(done.stdout.contains(text), "{}", done.stdout);
        let document = parsed(&folder.read("out/annual.json"));
        assert_eq!(number(&document, "/hours/occupied"), occupied, "{name}");
        let point = |key: &str| number(&document, &format!("/sensors/0/points/0/{key}"));
        let (enough, useful) = match name {
            // 9000 lx and 250 lx are enough, and as much as is of use.
            "annual_terms" => (0.75, 0.5),
            "annual_weekdays" => (1.0, 0.5),
            "annual_schedule" => (2.0 / 3.0, 0.0),
            _ => (2.0 / 24.0, 1.0 / 24.0),
        };
        assert!((point("daylight_autonomy") - enough).abs() < 1e-9, "{name}");
        assert!((point("udi_autonomous") - useful).abs() < 1e-9, "{name}");
        let enough_lx = if name == "annual_schedule" { 300.0 } else { 200.0 };
        assert_eq!(number(&document, "/thresholds/enough_lx"), enough_lx);
        assert!(done.stdout.contains(&format!("sDA ({enough_lx} lx, 50 %)")));
    }
}

#[test]
fn terms_of_a_year_that_make_no_sense_are_refused() {
    for (number, (annual, words)) in [
        ("weekends = false\n", "a.toml:8:12: the weather file does not say with which day"),
        ("occupied_h = [18, 8]\n", "hours of a day, like [8, 18]"),
        ("enough_lx = 50\n", "expected enough light to be of use"),
        ("schedule = \"people.csv\"\n", "column"),
        ("schedule = \"a\"\ncolumn = \"b\"\nweekends = true\n", "a schedule exclude each other"),
        ("weekend = false\n", "weekends"),
    ]
    .into_iter()
    .enumerate()
    {
        let folder =
            folder(&format!("annual_terms_{number}"), &format!("{WEATHER}[annual]\n{annual}"));
        let refused = folder.quasilux(&["annual", "a.toml"]);
        assert_eq!(refused.code, Some(2), "{annual}: {}", refused.stdout);
        assert!(refused.stderr.contains(words), "{annual}: {}", refused.stderr);
    }
}

/// Names in files command no terminal, and are the same in a document.
#[test]
fn the_place_of_a_weather_file_is_shown_and_not_obeyed() {
    let folder = folder("annual_place", WEATHER);
    let place = "He\u{1b}[31mre\u{202e}";
    folder.write("site.wea", weather().replace("Here", place));
    let year = ["annual", "a.toml", "--out", "out", "--rel-tol", "50%"];
    let shown = folder.quasilux(&year).stdout;
    assert!(shown.contains("He\\u{1b}[31mre\\u{202e}"), "{shown:?}");
    assert!(!shown.contains(['\u{1b}', '\u{202e}']), "{shown:?}");
    let document = folder.quasilux(&[&year[..], &["--json"]].concat()).stdout;
    assert!(!document.contains("\u{202e}"), "{document:?}");
    assert!(parsed(&document).to_string().contains("re\u{202e}"));
}
