//! All keys of the project file, for its reference: `docs/project-reference.md`.

use super::keys::KeyTable;
use super::{
    SCENE_KEYS, annual, blinds, cameras, electric_light, lights, luminaires, materials, outside,
    sensors, simulation,
};

/// The keys of all sections, in the order in which a project file is mostly written.
#[must_use]
pub fn reference() -> Vec<KeyTable> {
    let table = |section, about, keys| KeyTable { section, kind: "", about, keys };
    let mut tables = vec![table(
        "[scene]",
        "The geometry, its units, and what holds for all lights",
        &SCENE_KEYS,
    )];
    tables.extend(materials::KINDS.iter().map(|kind| KeyTable {
        section: "[materials.NAME]",
        kind: kind.line,
        about: kind.about,
        keys: kind.keys,
    }));
    tables.push(table("[[luminaires]]", "A luminaire with measured light", &luminaires::KEYS));
    tables.extend(LIGHTS);
    tables.extend(SENSORS);
    tables.push(table("[[cameras]]", "Where a picture is taken from", &cameras::KEYS));
    tables.push(table("[simulation]", "What is asked of the engine", &simulation::KEYS));
    tables.push(table("[site]", "A place on the earth, and where north is", &outside::SITE_KEYS));
    tables.extend(SKIES);
    tables.push(table("[weather]", "The weather of the sky of that name", &outside::WEATHER_KEYS));
    tables.extend(SUNS);
    tables.push(table(
        "[ground]",
        "The ground around, which all skies light",
        &outside::GROUND_KEYS,
    ));
    let openings = "Where daylight comes in; panes are found without it";
    tables.push(table("[[openings]]", openings, &outside::OPENING_KEYS));
    tables.push(table("[annual]", "What a year is judged by, with a weather file", &annual::KEYS));
    let groups =
        "What is before windows while closed, over a year; `[[blinds]]` are several groups";
    tables.push(table("[blinds]", groups, &blinds::KEYS));
    let states = "A position of a group of blinds beside open";
    tables.push(table("[[blinds.states]]", states, &blinds::STATE_KEYS));
    let zones = "Lamps that daylight dims over a year; `[[electric_light]]` are several zones";
    tables.push(table("[electric_light]", zones, &electric_light::KEYS));
    tables
}

const LIGHTS: [KeyTable; 2] = [
    KeyTable {
        section: "[[lights]]",
        kind: "kind = \"point\"",
        about: "A point that shines the same in all directions",
        keys: &lights::POINT_KEYS,
    },
    KeyTable {
        section: "[[lights]]",
        kind: "kind = \"area\"",
        about: "A material of the geometry that shines",
        keys: &lights::AREA_KEYS,
    },
];

const SENSORS: [KeyTable; 2] = [
    KeyTable {
        section: "[[sensors]]",
        kind: "kind = \"grid\"",
        about: "A rectangle of points; it never blocks light",
        keys: &sensors::GRID_KEYS,
    },
    KeyTable {
        section: "[[sensors]]",
        kind: "kind = \"points\"",
        about: "Single points",
        keys: &sensors::POINTS_KEYS,
    },
];

const SKIES: [KeyTable; 5] = [
    KeyTable {
        section: "[sky]",
        kind: "model = \"cie\"",
        about: "A CIE standard general sky",
        keys: &outside::CIE_KEYS,
    },
    KeyTable {
        section: "[sky]",
        kind: "model = \"perez\"",
        about: "The all-weather sky of Perez et al. of one measured hour; it needs `[sun]`",
        keys: &outside::PEREZ_KEYS,
    },
    KeyTable {
        section: "[sky]",
        kind: "model = \"uniform\"",
        about: "A sky of the same luminance everywhere",
        keys: &outside::UNIFORM_KEYS,
    },
    KeyTable {
        section: "[sky]",
        kind: "model = \"weather\"",
        about: "The skies of a weather file: one hour of it, or a year",
        keys: &outside::WEATHER_SKY_KEYS,
    },
    KeyTable {
        section: "[sky]",
        kind: "model = \"panorama\"",
        about: "A picture of a sky",
        keys: &outside::PANORAMA_KEYS,
    },
];

const SUNS: [KeyTable; 2] = [
    KeyTable {
        section: "[sun]",
        kind: "",
        about: "Where the sun is, and whether its disk shines",
        keys: &outside::SUN_KEYS,
    },
    KeyTable {
        section: "[sun]",
        kind: "",
        about: "The sun beside `[sky] model = \"weather\"`, whose file says where it is",
        keys: &outside::WEATHER_SUN_KEYS,
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::{Project, SECTIONS};

    const ROOM: &str = "[scene]\ngeometry = [\"room.obj\"]\n";
    const LIGHT: &str = "[[lights]]\nkind = \"point\"\nposition = [0, 0, 2]\nintensity_cd = 1\n";
    const SENSOR: &str = "[[sensors]]\nname = \"own\"\nkind = \"points\"\n\
                          points = [[0, 0, 1]]\nnormals = [[0, 0, 1]]\n";

    /// A project in which a section of this kind has a key that there is not.
    fn project(table: &KeyTable) -> String {
        let KeyTable { section, kind, about, .. } = *table;
        let wrong = format!("{}\n{kind}\nno_such_key = 1\n", section.replace("NAME", "wood"));
        let year = ["[weather]", "[annual]", "[blinds]", "[[blinds.states]]"];
        let sky = if year.contains(&section) || about.contains("weather\"`, whose") {
            "[sky]\nmodel = \"weather\"\n[weather]\nfile = \"a.epw\"\n"
        } else if ["[site]", "[sun]", "[ground]", "[[openings]]"].contains(&section) {
            "[sky]\nmodel = \"uniform\"\nzenith_luminance_cd_m2 = 1\n"
        } else {
            ""
        };
        let before = match section {
            "[weather]" => sky.split("[weather]").next().unwrap_or_default().to_owned(),
            "[[blinds.states]]" => format!("{sky}[blinds]\n"),
            _ => sky.to_owned(),
        };
        let scene = if section == "[scene]" { "" } else { ROOM };
        format!("{scene}{LIGHT}{SENSOR}{before}{wrong}")
    }

    /// The keys are those that the reader itself says it takes.
    #[test]
    fn the_reference_has_the_keys_that_the_reader_takes() {
        for table in reference() {
            let text = project(&table);
            let error = Project::parse("room.toml", text.as_bytes()).unwrap_err().to_string();
            let names: Vec<&str> = table.keys.iter().map(|key| key.name).collect();
            let expected = format!("; expected {}", names.join(", "));
            let is_refused = error.contains("unknown key \"no_such_key\"");
            assert!(is_refused && error.contains(&expected), "{text}\n{error}\n{expected}");
        }
    }

    #[test]
    fn every_section_is_in_the_reference() {
        let tables = reference();
        for section in SECTIONS {
            let starts = [format!("[{section}]"), format!("[[{section}]]"), format!("[{section}.")];
            let is_of = |table: &KeyTable| starts.iter().any(|it| table.section.starts_with(it));
            assert!(tables.iter().any(is_of), "{section}");
        }
    }

    /// They stand in cells of tables.
    #[test]
    fn texts_are_of_one_line_without_bars() {
        for table in reference() {
            assert!(table.about.len() < 100 && !table.about.ends_with('.'), "{}", table.about);
            for key in table.keys {
                let default = key.default.unwrap_or("required");
                for text in [key.name, key.takes, default, key.meaning] {
                    assert!(!text.is_empty() && !text.contains(['|', '\n']), "{text}");
                    assert!(!text.ends_with('.'), "{text}");
                }
            }
        }
    }
}
