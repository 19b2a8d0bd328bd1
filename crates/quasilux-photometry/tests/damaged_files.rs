//! Any bytes give a luminaire or an error with its place, in memory bounded by their number.
//!
//! A binary of its own, with one test: it counts what the whole process allocates.

mod damage;
#[path = "damage/large.rs"]
mod large;

use damage::{Format, Outcome, Seeds, examine, examine_damaged};
use large::surface;

/// Damaged files of each format. `examples/mutate.rs` runs any number of them.
const FILES: u64 = 100_000;

/// Damaged surfaces: those that load are looked at from all sides, which takes longer.
const SURFACES: u64 = 20_000;

#[test]
fn damaged_files_never_panic_and_never_take_more_memory_than_stated() {
    for format in Format::ALL {
        let seeds = Seeds::with_published(format);
        for file in seeds.files() {
            examine(format, file);
        }
        let (mut read, mut max_bytes) = (0, 0);
        let files = if matches!(format, Format::Bsdf) { SURFACES } else { FILES };
        for index in 0..files {
            let Outcome { is_read, peak_bytes } = examine_damaged(format, &seeds, index);
            read += u64::from(is_read);
            max_bytes = max_bytes.max(peak_bytes);
        }
        println!(
            "{format:?}: {read} of {files} damaged files load, the others are refused; at most \
             {max_bytes} bytes allocated at one time"
        );
        assert!(read > files / 20 && read < files - files / 20, "{format:?}: {read} load");
    }
    assert_tables_are_small();
    for (name, bytes) in greedy_files() {
        for format in Format::ALL {
            let Outcome { is_read, peak_bytes } = examine(format, &bytes);
            let ratio = peak_bytes as f64 / bytes.len() as f64;
            println!("{name} as {format:?}: {ratio:.1} bytes a byte, loads: {is_read}");
        }
    }
}

/// Bytes a byte that tables as programs write them may take beside the file: 200 MB of them less than 1.8 GiB with it.
const MAX_OF_TABLES: f64 = 8.0;

/// Bytes of a file whose table is larger than the least grids that values are resampled to.
const TABLE_BYTES: usize = 12_000_000;

fn assert_tables_are_small() {
    for (name, make) in large::KINDS {
        let bytes = make(TABLE_BYTES);
        assert!(bytes.len() > TABLE_BYTES * 4 / 5, "{name} has {} bytes", bytes.len());
        let Outcome { is_read, peak_bytes } = examine(Format::Bsdf, &bytes);
        let ratio = peak_bytes as f64 / bytes.len() as f64;
        println!("{name} of {} bytes: {ratio:.1} bytes a byte", bytes.len());
        assert!(is_read && ratio < MAX_OF_TABLES, "{name}: {ratio} bytes a byte, {is_read}");
    }
}

/// Files that ask for much memory in few bytes.
fn greedy_files() -> Vec<(&'static str, Vec<u8>)> {
    const LENGTH: usize = 1 << 20;
    let list = |count: usize, last: f64| -> String {
        (0..count).map(|i| format!("{:.4} ", last * i as f64 / (count.max(2) - 1) as f64)).collect()
    };
    let table = |verticals: usize, planes: usize, last: f64| {
        let (theta, phi) = (list(verticals, 90.0), list(planes, last));
        let candela = "1 ".repeat(verticals * planes);
        format!("TILT=NONE\n1 -1 1 {verticals} {planes} 1 2 0 0 0 1 1 1\n{theta}\n{phi}\n{candela}")
    };
    let claim = |count: &str| {
        let blanks = " ".repeat(LENGTH);
        format!("TILT=NONE\n1 -1 1 {count} {count} 1 2 0 0 0 1 1 1\n0 90\n0\n1 1{blanks}")
    };
    let labels = |label: &str| label.repeat(LENGTH / label.len()) + "TILT=NONE\n";
    let claim_ldt = |count: &str| {
        let before = format!("m\n2\n4\n{count}\n0\n{count}\n0\n");
        before + &"1\n".repeat(LENGTH / 2)
    };
    // One row at each of two angles: planes are stored for a quarter turn and unfolded.
    let planes = 50_000;
    let quadrant_ldt = {
        let angles = |quarter: usize| 90.0 * quarter as f64 / (planes / 4) as f64;
        let all: String = (0..planes).map(|i| format!("{:.3}\n", angles(i))).collect();
        let ones = "1\n".repeat(2 * (planes / 4 + 1));
        let header = "m\n2\n4\n".to_owned() + &format!("{planes}\n0\n2\n0\nr\nn\nn\nf\nd\n");
        let luminaire = "1\n".repeat(12) + "0\n1\n1\nT\n1000\n-\n-\n20\n" + &"1\n".repeat(10);
        format!("{header}{luminaire}{all}0\n90\n{ones}")
    };
    // Elements and attributes of little text, and two emitters whose grids have a large product.
    let attributes: String = (0..26).map(|i| format!(" {}=\"\"", (b'a' + i) as char)).collect();
    let xml = |inside: &str| {
        let count = LENGTH / inside.len();
        format!("<IESTM33-22>{}</IESTM33-22>", inside.repeat(count))
    };
    let emitter = |planes: usize, angles: usize| {
        let pairs = (0..planes).flat_map(|c| (0..angles).map(move |gamma| (c, gamma)));
        let share = |i: usize, count: usize| i as f64 / (count - 1) as f64;
        let data: String = pairs
            .map(|(c, gamma)| {
                let (h, v) = (360.0 * share(c, planes), 180.0 * share(gamma, angles));
                format!("<IntData h=\"{h:.3}\" v=\"{v:.3}\">1</IntData>")
            })
            .collect();
        format!(
            "<Emitter><Quantity>1</Quantity><LuminousData><LuminousIntensity>\
             {data}</LuminousIntensity></LuminousData></Emitter>"
        )
    };
    let unlike =
        |n: usize| format!("<IESTM33-22>{}{}</IESTM33-22>", emitter(2 * n, 8), emitter(9, 2 * n));
    // Surfaces: values of two letters, leaves of three, nodes as deep as they may be, and many incident directions.
    let tree = |data: &str| {
        let of_block = "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>";
        String::from_utf8(surface("TensorTree4", "", of_block, data)).unwrap()
    };
    let grid = format!("{{{}}}", "1 2 ".repeat(1 << 15));
    let mut chain = "{1}".to_owned();
    for _ in 0..11 {
        chain = format!("{{{chain}{}}}", "{2}".repeat(15));
    }
    let leaf = |leaves: usize| format!("{{{}}}", "{1}".repeat(leaves));
    let bushes = format!("{{{}}}", leaf(16).repeat(16));
    let full = format!("{{{}}}", bushes.repeat(16));
    let astm = |lines: String| format!("VARS theta_i,phi_i,theta_s,phi_s,R,G,B\n{lines}");
    let angles = |i: usize| 1.5 * i as f64 / 4000.0;
    let incident = astm((0..4000).map(|i| format!("{:.5},0,0.1,0,1,1,1\n", angles(i))).collect());
    let planes: String = (0..2000)
        .map(|i| format!("0,0,{:.5},0,1,1,1\n1,{:.5},0,0,1,1,1\n", angles(i), angles(i)))
        .collect();
    let sigmas = |count: usize| {
        let head = format!("TypeColorModel RGB sigma {count} {}", list(count, 90.0));
        let block = |name: &str| format!("{name} def {}enddef ", "1 ".repeat(count));
        head + " phi 1 0 theta 1 0 " + &block("red") + &block("gre") + &block("blu")
    };
    let lobe_of_ones = {
        let (columns, rows) = (360, LENGTH / 6 / 360);
        let block = |name: &str| format!("{name} def {}enddef ", "1 ".repeat(columns * rows));
        let angles = format!(
            "sigma 1 9 phi {columns} {} theta {rows} {}",
            list(columns, 359.0),
            list(rows, 90.0)
        );
        format!("TypeSym ASymmetrical {angles}") + &block("red") + &block("gre") + &block("blu")
    };
    let lines_of_ones = {
        let exits = (0..90).flat_map(|theta| (0..360).map(move |phi| (theta, phi)));
        astm(exits.map(|(theta, phi)| format!("0,0,{theta},{phi},1,1,1\n")).collect())
    };
    let texts = vec![
        ("a tree of one grid", tree(&grid)),
        ("a tree of single leaves", tree(&full)),
        ("a tree of one branch", tree(&chain)),
        ("nodes that never end", tree(&"{".repeat(LENGTH))),
        ("a lobe of ones", lobe_of_ones),
        ("lines of ones", lines_of_ones),
        ("an incident direction a line", incident),
        ("as many planes as lines", astm(planes)),
        ("a thousand lobes of one value", sigmas(1000)),
        ("too many lobes", sigmas(100_000)),
        ("elements", xml("<b/>")),
        ("elements of one letter", xml("<b>x</b>")),
        ("attributes", xml(&format!("<b{attributes}/>"))),
        ("references", xml("&lt;")),
        ("a deep tree", xml("<b>")),
        ("emitters on unlike grids", unlike(500)),
        ("line ends", "\n".repeat(LENGTH)),
        ("empty labels", labels("a\n")),
        ("keywords", labels("[]\n")),
        ("continued keywords", labels("[MORE]\n")),
        ("a long label", "a".repeat(LENGTH) + "\nTILT=NONE\n"),
        ("many angles in one plane", table(100_000, 1, 0.0)),
        ("two angles in many planes", table(2, 50_000, 90.0)),
        ("a large table", table(700, 700, 90.0)),
        (
            "tilt angles",
            format!("TILT=INCLUDE\n1 100000 {}{}", list(100_000, 180.0), "1 ".repeat(100_000)),
        ),
        ("a great count", claim("999999")),
        ("an impossible count", claim("999999999999999")),
        ("a great count of lines", claim_ldt("500000")),
        ("an impossible count of lines", claim_ldt("4294967295")),
        ("a quarter turn of planes", quadrant_ldt),
    ];
    let mut files: Vec<_> =
        texts.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    files.push(("Latin-1", b"\xE9\n".repeat(LENGTH / 2)));
    files.push(("Latin-1 in the last line", [&b"\n".repeat(LENGTH)[..], b"\xE9"].concat()));
    files.push(("UTF-16 line ends", [&b"\xFF\xFE"[..], &b"\n\0".repeat(LENGTH / 2)].concat()));
    files.push(("UTF-16", [&b"\xFF\xFE"[..], &b"\x11\x11".repeat(LENGTH / 2)].concat()));
    files
}
