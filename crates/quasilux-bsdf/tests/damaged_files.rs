//! Any bytes give a surface or an error with its position, in memory bounded by their number.

mod damage;
#[path = "damage/large.rs"]
mod large;

use damage::{examine, seeds};
use large::surface;
use quasilux_stats::damage::{Outcome, Outcomes, examine_damaged};
use quasilux_stats::deep;

/// Number of damaged files, and of damaged glazing products: what one in 1700 does is found in 19
/// of 20 choices of them, in the deep variant one in 6700. Those that load are looked at from all
/// sides, which takes long. `examples/mutate.rs` runs any number of them.
fn files() -> u64 {
    if deep() { 20_000 } else { 5_000 }
}

#[test]
fn damaged_files_never_panic_and_never_take_more_memory_than_stated() {
    let seeds = seeds();
    for file in seeds.files() {
        examine(file);
    }
    let files = files();
    let Outcomes { read, max_bytes } = examine_damaged(&seeds, 0..files, examine);
    println!(
        "{read} of {files} damaged files load, the others are refused; at most {max_bytes} bytes \
         allocated at one time"
    );
    assert!(read > files / 20 && read < files - files / 20, "{read} load");
    assert_tables_are_small();
    for (name, bytes) in greedy_files() {
        let Outcome { is_read, peak_bytes } = examine(&bytes);
        let ratio = peak_bytes as f64 / bytes.len() as f64;
        println!("{name}: {ratio:.1} bytes a byte, loads: {is_read}");
    }
}

#[test]
fn damaged_glazings_never_panic_and_never_make_light() {
    let seeds = damage::glazing::seeds();
    let read = seeds.files().iter().filter(|file| damage::glazing::examine(file).is_read).count();
    assert!(read >= 2, "{read}");
    let files = files();
    let Outcomes { read, max_bytes } = examine_damaged(&seeds, 0..files, damage::glazing::examine);
    println!("{read} of {files} load; at most {max_bytes} bytes allocated at one time");
    assert!(read > files / 50 && read < files - files / 20, "{read} load");
    const LENGTH: usize = 1 << 20;
    let whole = |head: &str, inside: &str, tail: &str| {
        format!("{head}{}{tail}", vec![inside; LENGTH / inside.len()].join(","))
    };
    let blocks = "{\"physical_properties\": {\"optical_properties\": {\"optical_data\": \
                  {\"angle_blocks\": [";
    for text in [
        whole("{\"integrated_results_summary\": [", "{}", "]}"),
        whole(blocks, "{\"incidence_angle\":1,\"wavelength_data\":[]}", "]}}}}"),
        whole("{\"spectral_data\": [", "{\"T\":1,\"Rf\":0,\"Rb\":0,\"wavelength\":1}", "]}"),
        whole("{\"name\": [", "1", "]}"),
        format!("{{\"name\": \"{}\"}}", "\\u00e9".repeat(LENGTH / 6)),
        "[".repeat(LENGTH),
        "\n".repeat(LENGTH),
    ] {
        damage::glazing::examine(text.as_bytes());
    }
    damage::glazing::examine(&[&b"\xFF\xFE"[..], &b"\x11\x11".repeat(LENGTH / 2)].concat());
}

/// Bytes a byte that tables as programs write them may take beside the file: 200 MB of them less
/// than 1.8 GiB with it.
const MAX_OF_TABLES: f64 = 8.0;

/// Bytes of a file whose table is larger than the least grids that values are resampled to.
const TABLE_BYTES: usize = 12_000_000;

fn assert_tables_are_small() {
    for (name, make) in large::KINDS {
        let bytes = make(TABLE_BYTES);
        assert!(bytes.len() > TABLE_BYTES * 4 / 5, "{name} has {} bytes", bytes.len());
        let Outcome { is_read, peak_bytes } = examine(&bytes);
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
    // Elements and attributes of little text.
    let attributes: String = (0..26).map(|i| format!(" {}=\"\"", (b'a' + i) as char)).collect();
    let xml = |inside: &str| {
        let count = LENGTH / inside.len();
        format!("<WindowElement>{}</WindowElement>", inside.repeat(count))
    };
    // Surfaces: values of two letters, leaves of three, nodes as deep as they may be, and many
    // incident directions.
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
        ("line ends", "\n".repeat(LENGTH)),
    ];
    let mut files: Vec<_> =
        texts.into_iter().map(|(name, text)| (name, text.into_bytes())).collect();
    files.push(("Latin-1", b"\xE9\n".repeat(LENGTH / 2)));
    files.push(("Latin-1 in the last line", [&b"\n".repeat(LENGTH)[..], b"\xE9"].concat()));
    files.push(("UTF-16 line ends", [&b"\xFF\xFE"[..], &b"\n\0".repeat(LENGTH / 2)].concat()));
    files.push(("UTF-16", [&b"\xFF\xFE"[..], &b"\x11\x11".repeat(LENGTH / 2)].concat()));
    files
}
