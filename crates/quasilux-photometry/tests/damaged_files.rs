//! Any bytes give a luminaire or an error with its position, in memory bounded by their number.

mod damage;

use damage::{Format, examine};
use quasilux_stats::damage::{Outcome, Outcomes, examine_damaged};
use quasilux_stats::deep;

/// Number of damaged files of each format: what one in 8300 does is found in 19 of 20 choices of
/// them, in the deep variant one in 33 000. `examples/mutate.rs` runs any number of them.
fn files() -> u64 {
    if deep() { 100_000 } else { 25_000 }
}

#[test]
fn damaged_files_never_panic_and_never_take_more_memory_than_stated() {
    let files = files();
    for format in Format::ALL {
        let seeds = format.seeds();
        for file in seeds.files() {
            examine(format, file);
        }
        let Outcomes { read, max_bytes } =
            examine_damaged(&seeds, 0..files, |bytes| examine(format, bytes));
        println!(
            "{format:?}: {read} of {files} damaged files load, the others are refused; at most \
             {max_bytes} bytes allocated at one time"
        );
        assert!(read > files / 20 && read < files - files / 20, "{format:?}: {read} load");
    }
    for (name, bytes) in greedy_files() {
        for format in Format::ALL {
            let Outcome { is_read, peak_bytes } = examine(format, &bytes);
            let ratio = peak_bytes as f64 / bytes.len() as f64;
            println!("{name} as {format:?}: {ratio:.1} bytes a byte, loads: {is_read}");
        }
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
    let texts = vec![
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
