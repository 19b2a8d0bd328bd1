//! Damaged Radiance scenes: readers answer, whatever they are given. Deep runs try twenty times as
//! many.

use crate::mutations::mutated;
use crate::radiance_import::{import, load_imported};
use crate::support::{MapFiles, Stream};

fn scenes() -> usize {
    if quasilux_stats::deep() { 60_000 } else { 3_000 }
}

const SCENE: &str = "void plastic grey 0 0 5 .5 .5 .5 0.05 0.1\nvoid alias \"b c\" grey\n\
    'b c' polygon p 0 0 30 0 0 0 4 0 0 4 3 0 0 3 0 0 0 0 1 1 0 1 2 0 2 2 0 2 1 0 1 1 0\n\
    void brightdata d 7 flatcorr lamp.dat source.cal src_phi4 src_theta -rz 30 0 1 12.5\n\
    d light l 0 0 3 2 2 2 # shines\nl polygon q 0 0 12 -.2 -.1 2 -.2 .1 2 .2 .1 2 .2 -.1 2\n\
    void spotlight s 0 0 7 9 9 9 60 0 0 -1\ns ring r 0 0 8 0 0 2 0 0 -1 0 .01\n\
    !xform -n x -a 3 -t 1 0 0 -a 2 -rz 30 -i 2 -mx part.rad\n\
    !genbox grey b 1 2 3 -i | xform -I -s 2\n!genblinds grey s .1 1 1 3 30 +r .2\n\
    !gensky 6 21 12 +s\nskyfunc glow g 0 0 4 1 1 1 0\ng source sky 0 0 4 0 0 1 180\n\
    void glass w 0 0 3 .9 .8 .9\nvoid trans t 0 0 7 .8 .8 .8 0 0 .5 0\n\
    t cone k 0 0 8 0 0 1 0 0 2 1 .5\nw cylinder c 0 0 7 3 0 0 3 0 1 .5\n";

fn files(scene: &[u8], data: &[u8], points: &[u8], views: &[u8]) -> MapFiles {
    MapFiles::default()
        .with("room.rad", scene)
        .with("part.rad", "grey sphere s 0 0 4 0 0 0 1\ngrey bubble b 0 0 4 3 0 0 1\n")
        .with("lamp.dat", data)
        .with("grid.pts", points)
        .with("a.vf", views)
}

/// Whether a scene becomes a project that loads.
fn survive(files: &MapFiles) -> bool {
    let is_one_line = |text: &str| assert!(!text.is_empty() && !text.contains('\n'), "{text:?}");
    match import(files) {
        Err(error) => {
            is_one_line(&error);
            false
        }
        Ok(imported) => match load_imported(&imported, files) {
            Ok(_) => true,
            Err(error) => {
                assert!(!error.contains("not valid TOML"), "{error}");
                is_one_line(error.split_once('\n').map_or("", |(first, _)| first));
                false
            }
        },
    }
}

#[test]
fn damaged_scenes_data_points_and_views() {
    let parts: [&[u8]; 4] = [
        SCENE.as_bytes(),
        b"2\n0 90 2\n0 0 4 0 30 60 90\n4 3 2 0\n4 1 1 0\n",
        b"0.5 0.5 0.8 0 0 1\n",
        b"rvu -vtv -vp .1 .2 1 -vd 0 1 0 -vu 0 0 1 -vh 60 -vv 40\n",
    ];
    assert!(survive(&files(parts[0], parts[1], parts[2], parts[3])));
    let mut stream = Stream(59);
    let mut loaded = 0;
    for number in 0..scenes() {
        let which = if number % 4 == 0 { 1 + stream.below(3) } else { 0 };
        let damaged = mutated(parts[which], &mut stream);
        let mut parts = parts;
        parts[which] = &damaged;
        loaded += usize::from(survive(&files(parts[0], parts[1], parts[2], parts[3])));
    }
    assert!((scenes() / 40..scenes()).contains(&loaded), "{loaded} loaded");
}
