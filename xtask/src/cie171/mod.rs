//! The closed-form cases of CIE 171:2006, Test cases to assess the accuracy of lighting computer
//! programs, as data in `validation/`: scenes after the standard's description, values by formula.
//!
//! All rooms begin at the origin. Places are named as in the standard: A to F on the wall y = 0
//! above the middle of its foot, G to N along the floor's centre line.

mod cases;
mod daylight;
mod factors;
mod geometry;
mod luminaire;
mod project;
mod sky;

use crate::generated::{self, File};
use std::path::Path;
use xtask::workspace::Failure;

/// Name below `validation/` and content of each generated file.
fn files() -> Vec<File> {
    let mut files = vec![
        ("scenes/cie171_room.obj".to_owned(), geometry::room_file(geometry::ROOM_M)),
        ("scenes/cie171_cube.obj".to_owned(), geometry::room_file(geometry::CUBE_M)),
        ("scenes/cie171_panel.obj".to_owned(), geometry::panel_file()),
        ("scenes/cie171_box.obj".to_owned(), geometry::box_file()),
        ("scenes/cie171_cosine.ies".to_owned(), luminaire::cosine_file()),
        ("scenes/cie171_floor.ies".to_owned(), cases::floor_luminaire()),
        ("scenes/cie171_wall.ies".to_owned(), cases::wall_luminaire()),
    ];
    for cases::NamedProject { name, project } in cases::projects() {
        files.push((format!("scenes/{name}.toml"), project.text()));
    }
    for case in cases::cases() {
        files.push((format!("cases/{}.toml", case.file), case.text()));
    }
    files.extend(daylight::files());
    files
}

/// Writes the generated files.
pub(crate) fn write(root: &Path) -> Result<(), Failure> {
    generated::write(&root.join("validation"), &files())
}

#[cfg(test)]
mod tests {
    use super::*;
    use xtask::workspace::root as workspace_root;

    #[test]
    fn the_committed_files_are_what_the_generator_writes() {
        let folder = workspace_root().join("validation");
        generated::assert_committed(&folder, &files(), "cie171");
    }
}
