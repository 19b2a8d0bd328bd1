//! Broken bytes: readers answer, whatever they are given, and never panic.
//!
//! Mutations are drawn from a fixed stream, so that a failure repeats. They change, insert, remove
//! and repeat bytes, and put in numbers at the edges of their types.

use crate::gltf::{SQUARE, square_bytes, square_glb};
use crate::support::{MapFiles, PROJECT, ROOM_MTL, ROOM_OBJ, Stream, load_geometry};
use quasilux_scene::load;

const MUTATIONS: usize = 20_000;

/// Words that readers find hard.
const WORDS: [&str; 24] = [
    "-1",
    "0",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551615",
    "1e308",
    "1e999",
    "nan",
    "inf",
    "\\\n",
    "#",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "\n",
    "=",
    "f 1 2 3 4 5\n",
    "\0",
    "\u{e9}",
    "//",
];

pub(crate) fn mutated(bytes: &[u8], stream: &mut Stream) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..1 + stream.below(4) {
        let at = stream.below(bytes.len());
        let end = (at + 1 + stream.below(12)).min(bytes.len());
        match stream.below(7) {
            0 if !bytes.is_empty() => bytes[at] = stream.next() as u8,
            1 if !bytes.is_empty() => bytes[at] ^= 1 << stream.below(8),
            2 => bytes.truncate(at),
            3 => drop(bytes.drain(at..end)),
            4 => {
                let piece = bytes[at..end].to_vec();
                let to = stream.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            _ => {
                let word = WORDS[stream.below(WORDS.len())].bytes();
                let end = if stream.below(2) == 0 { at } else { end };
                bytes.splice(at..end, word);
            }
        }
    }
    bytes
}

/// Loads all mutations; the text of each refusal must be one line. Returns how many loaded.
fn survive(original: &[u8], seed: u64, load: impl Fn(Vec<u8>) -> Result<(), String>) -> usize {
    let mut stream = Stream(seed);
    let outcomes = (0..MUTATIONS).map(|_| load(mutated(original, &mut stream)));
    let mut loaded = 0;
    for outcome in outcomes {
        match outcome {
            Ok(()) => loaded += 1,
            Err(text) => assert!(!text.is_empty() && !text.contains('\n'), "{text:?}"),
        }
    }
    loaded
}

/// Mutations must reach both ends: some still load, some are refused.
fn assert_mixed(loaded: usize) {
    assert!((MUTATIONS / 200..MUTATIONS * 99 / 100).contains(&loaded), "{loaded} loaded");
}

#[test]
fn project_files() {
    let project = PROJECT.to_owned()
        + "[materials.wood]\nreflectance = [0.5, 0.25, 0.125]\n[materials.default]\n\
           kind = \"pane\"\ntransmittance = [[0, 0.9], [90, 0]]\n[[sensors]]\nname = \"p\"\n\
           kind = \"points\"\npoints = [[0, 0, 1]]\nnormals = [[0, 0, 1]]\n[simulation]\n\
           estimator = \"path\"\nreplicates = 16\nmax_bounces = \"unlimited\"\n";
    let files = MapFiles::room();
    assert_mixed(survive(project.as_bytes(), 1, |bytes| {
        load("a.toml", &bytes, &files).map(drop).map_err(|error| error.to_string())
    }));
}

#[test]
fn obj_files() {
    let obj = ROOM_OBJ.to_owned() + "g wall\nv 0 0 1\nf -1 -2 -4\nf 1/2/3 2//4 3/1 4 5\n";
    assert_mixed(survive(obj.as_bytes(), 2, |bytes| {
        let files = MapFiles::room().with("room.obj", bytes);
        load_geometry("room.obj", &files).map(drop).map_err(|error| error.to_string())
    }));
}

#[test]
fn mtl_files() {
    let loaded = survive(ROOM_MTL.as_bytes(), 3, |bytes| {
        let files = MapFiles::room().with("room.mtl", bytes);
        load_geometry("room.obj", &files).map(drop).map_err(|error| error.to_string())
    });
    assert_eq!(loaded, MUTATIONS, "a broken MTL file is only warned of");
}

#[test]
fn gltf_files() {
    assert_mixed(survive(SQUARE.as_bytes(), 4, |bytes| {
        let files = MapFiles::room().with("a.gltf", bytes).with("square mesh.bin", square_bytes());
        load_geometry("a.gltf", &files).map(drop).map_err(|error| error.to_string())
    }));
}

#[test]
fn glb_files() {
    assert_mixed(survive(&square_glb(), 5, |bytes| {
        let files = MapFiles::room().with("a.glb", bytes);
        load_geometry("a.glb", &files).map(drop).map_err(|error| error.to_string())
    }));
}
