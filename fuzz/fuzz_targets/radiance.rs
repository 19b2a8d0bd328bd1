//! The reader of Radiance scenes, on any bytes: what becomes a project, and what of that loads
//! again.

#![no_main]

mod mutation;

use libfuzzer_sys::{fuzz_mutator, fuzz_target};
use quasilux_scene::{FileKind, Files, RadianceTerms, import_radiance, load};
use quasilux_stats::damage::Seeds;
use std::collections::HashMap;
use std::io::{Error, ErrorKind};

/// Most memory in bytes: arrays of few words have up to 2,000,000 primitives, and spheres 2200
/// triangles each, up to 50,000,000 of a scene.
const MAX_BYTES: u64 = 8 << 30;

struct Named(HashMap<String, Vec<u8>>);

impl Files for Named {
    fn read(&self, path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        self.0.get(path).cloned().ok_or_else(|| Error::from(ErrorKind::NotFound))
    }
}

const SCENE: &str = "void plastic grey 0 0 5 .5 .5 .5 0.05 0.1\nvoid alias \"b c\" grey\n\
    'b c' polygon p 0 0 30 0 0 0 4 0 0 4 3 0 0 3 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0\n\
    void brightdata d 7 flatcorr lamp.dat source.cal src_phi4 src_theta -rz 30 0 1 12.5\n\
    d light l 0 0 3 2 2 2 # shines\nl polygon q 0 0 12 -.2 -.1 2 -.2 .1 2 .2 .1 2 .2 -.1 2\n\
    !xform -n x -a 3 -t 1 0 0 -i 2 -mx part.rad\n!genbox grey b 1 2 3 -i | xform -I -s 2\n\
    !genblinds grey s .1 1 1 3 30 +r .2\n!gensky 6 21 12 +s\nskyfunc glow g 0 0 4 1 1 1 0\n\
    g source sky 0 0 4 0 0 1 180\nvoid glass w 0 0 3 .9 .8 .9\nw ring r 0 0 8 0 0 0 0 0 1 0 1\n";

fn samples() -> Seeds {
    Seeds::new(vec![SCENE.as_bytes().to_vec()])
}

fn examine(bytes: &[u8]) {
    let mut files: HashMap<String, Vec<u8>> = HashMap::new();
    files.insert("room.rad".to_owned(), bytes.to_vec());
    files.insert("part.rad".to_owned(), b"grey polygon t 0 0 9 0 0 0 1 0 0 0 1 0".to_vec());
    files.insert("lamp.dat".to_owned(), b"2\n0 90 2\n0 90 3\n4 3 2\n4 1 1\n".to_vec());
    files.insert("grid.pts".to_owned(), b"0.5 0.5 0.8 0 0 1\n".to_vec());
    let terms = RadianceTerms {
        model: "room.rad",
        scene: &["room.rad".to_owned()],
        points: &["grid.pts".to_owned()],
        views: &[],
        weather: None,
        stem: "room",
    };
    let named = Named(files);
    let imported = match import_radiance(&named, &terms) {
        Ok(imported) => imported,
        Err(error) => return assert!(!error.to_string().contains('\n'), "{error}"),
    };
    let Named(mut files) = named;
    files.extend(imported.files.into_iter().map(|file| (file.name, file.bytes)));
    if let Err(error) = load("room.toml", imported.text.as_bytes(), &Named(files)) {
        let text = error.to_string();
        assert!(!text.contains("not valid TOML") && !text.contains('\n'), "{text}");
    }
}

fuzz_target!(|bytes: &[u8]| {
    let peak_bytes = allocation_counter::measure(|| examine(bytes)).bytes_max;
    assert!(peak_bytes <= MAX_BYTES, "{peak_bytes} bytes for a scene of {}", bytes.len());
});

fuzz_mutator!(|bytes: &mut [u8], length: usize, room: usize, key: u32| {
    mutation::change(samples, bytes, length, room, key)
});
