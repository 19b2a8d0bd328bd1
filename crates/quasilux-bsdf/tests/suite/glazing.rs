//! Glazings: the visible values of products, sheets at any angle, several behind one another.

use quasilux_bsdf::{
    Glazing, GlazingLayer, GlazingProduct, SheetShares, WarningKind, read_bsdf, read_glazing,
};
use std::fmt::Write;
use std::sync::Arc;

/// Numbers in [0, 1).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// A product file with lines of nanometres, transmittance, front and back reflectance.
fn file(words: &str, lines: &[[f64; 4]]) -> String {
    let mut text = format!("{{\"type\": \"glazing\", {words}, \"spectral_data\": {{\n");
    text += "\"spectral_data\": [";
    for (number, [nm, t, front, back]) in lines.iter().enumerate() {
        let comma = if number == 0 { "" } else { "," };
        let um = nm / 1000.0;
        write!(
            text,
            "{comma}\n{{\"T\": {t}, \"Rf\": {front}, \"Rb\": {back}, \"wavelength\": {um}}}"
        )
        .unwrap();
    }
    text + "]}}\n"
}

const UNCOATED: &str = "\"subtype\": \"monolithic\", \"coated_side\": \"Neither\"";
const COATED: &str = "\"subtype\": \"coated\", \"coated_side\": \"Back\"";

/// The same at all wavelengths.
fn grey(words: &str, [t, front, back]: [f64; 3]) -> GlazingProduct {
    product(&file(words, &[[300.0, t, front, back], [900.0, t, front, back]]))
}

fn product(text: &str) -> GlazingProduct {
    let read = read_glazing(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    read.product
}

fn glazing(products: &[(&GlazingProduct, bool)]) -> Glazing {
    let layer = |&(product, is_flipped): &(&GlazingProduct, bool)| GlazingLayer {
        product: Arc::new(product.clone()),
        is_flipped,
    };
    Glazing::new(products.iter().map(layer).collect())
}

fn published(name: &str) -> Option<Vec<u8>> {
    quasilux_corpus::find("daylight").map(|folder| std::fs::read(folder.join(name)).unwrap())
}

fn array(shares: SheetShares) -> [f64; 3] {
    [shares.transmittance, shares.front_reflectance, shares.back_reflectance]
}

/// The largest difference of two sheets.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn published_products_give_the_visible_values_that_they_state() {
    // Electrochromic laminate: coated; float glass: uncoated.
    for (name, eta) in
        [("frads-igsdb_product_7406.json", None), ("frads-igsdb_product_7968.json", Some(1.522))]
    {
        let Some(bytes) = published(name) else { return };
        let read = read_glazing(&bytes).unwrap();
        assert!(read.warnings.is_empty(), "{name}: {:?}", read.warnings);
        let product = read.product;
        let stated = array(product.stated().unwrap());
        assert!(apart(array(product.normal()), stated) < 1e-4, "{name}: {:?}", product.normal());
        let computed = array(glazing(&[(&product, false)]).visible(1.0));
        assert!(apart(computed, stated) < 2e-4, "{name}: {computed:?}, stated {stated:?}");
        let [t, front, back] = array(glazing(&[(&product, true)]).visible(1.0));
        assert!(apart([t, back, front], stated) < 2e-4, "{name}");
        match (product.eta(), eta) {
            (Some(found), Some(eta)) => assert!((found - eta).abs() < 5e-4, "{name}: {found}"),
            (found, expected) => assert_eq!(found, expected, "{name}"),
        }
        assert!(product.name().is_some());
    }
}

#[test]
fn files_of_the_second_interface_are_read_and_blinds_are_refused() {
    let Some(bytes) = published("igsdb-valid_monolithic_1.json") else { return };
    let read = read_glazing(&bytes).unwrap();
    assert!(read.warnings.is_empty(), "{:?}", read.warnings);
    assert_eq!(read.product.name(), Some("Test Monolithic 1"));
    assert!((read.product.normal().transmittance - 0.9037).abs() < 1e-3);
    assert!(read.product.eta().is_some_and(|eta| (eta - 1.6).abs() < 0.05));
    let bytes = published("frads-igsdb_product_19732.json").unwrap();
    let error = read_glazing(&bytes).unwrap_err().to_string();
    assert!(error.contains("a product of the type \"shading\""), "{error}");
    // The reader of surfaces says which kind of material such a file makes.
    let error = read_bsdf(&bytes).unwrap_err().to_string();
    assert!(error.contains("glazing"), "{error}");
}

/// A slab by the series of rays, Fresnel's sines and tangents, for both polarisations.
fn slab(theta_rad: f64, eta: f64, internal: f64) -> [[f64; 3]; 2] {
    let inside = libm::asin(libm::sin(theta_rad) / eta);
    let (less, more) = (theta_rad - inside, theta_rad + inside);
    let across = libm::sin(less) / libm::sin(more);
    let within = libm::tan(less) / libm::tan(more);
    let a = libm::exp(libm::log(internal) / libm::cos(inside));
    [across * across, within * within].map(|r| {
        let (mut through, mut back) = (0.0, r);
        // What is inside, on its way down.
        let mut light = 1.0 - r;
        for _ in 0..2000 {
            light *= a;
            through += light * (1.0 - r);
            light *= r * a;
            back += light * (1.0 - r);
            light *= r;
        }
        [through, back, back]
    })
}

fn mean([a, b]: [[f64; 3]; 2]) -> [f64; 3] {
    std::array::from_fn(|i| 0.5 * (a[i] + b[i]))
}

/// Sheets behind one another by following light to and fro until none is left.
fn ray_sum(sheets: &[[f64; 3]]) -> [f64; 3] {
    let from = |is_front: bool| {
        let count = sheets.len();
        // What goes backward and what goes forward in each gap, those outside at the ends.
        let (mut down, mut up) = (vec![0.0; count + 1], vec![0.0; count + 1]);
        let (mut out_front, mut out_back) = (0.0, 0.0);
        if is_front {
            down[0] = 1.0
        } else {
            up[count] = 1.0
        }
        for _ in 0..20_000 {
            let (mut next_down, mut next_up) = (vec![0.0; count + 1], vec![0.0; count + 1]);
            for (i, [t, front, back]) in sheets.iter().enumerate() {
                next_up[i] += down[i] * front + up[i + 1] * t;
                next_down[i + 1] += down[i] * t + up[i + 1] * back;
            }
            out_front += next_up[0];
            out_back += next_down[count];
            (next_up[0], next_down[count]) = (0.0, 0.0);
            (down, up) = (next_down, next_up);
        }
        [out_front, out_back]
    };
    let [front, through] = from(true);
    let [through_back, back] = from(false);
    assert!((through - through_back).abs() < 1e-12);
    [through, front, back]
}

#[test]
fn one_uncoated_sheet_is_the_series_of_its_rays() {
    let mut numbers = Numbers(1);
    for _ in 0..200 {
        let (eta, internal) = (numbers.within(1.4, 1.9), numbers.within(0.05, 1.0));
        let [normal, _] = slab(1e-6, eta, internal);
        let product = grey(UNCOATED, normal);
        assert!((product.eta().unwrap() - eta).abs() < 1e-6, "{:?} not {eta}", product.eta());
        let sheet = glazing(&[(&product, false)]);
        for theta_rad in [0.01, numbers.within(0.1, 1.5), 1.56] {
            let found = array(sheet.visible(libm::cos(theta_rad)));
            let expected = mean(slab(theta_rad, eta, internal));
            assert!(apart(found, expected) < 1e-7, "{theta_rad}: {found:?} not {expected:?}");
        }
        let [t, front, back] = array(sheet.visible(0.0));
        assert!(t < 1e-12 && front > 1.0 - 1e-12 && back > 1.0 - 1e-12);
    }
}

#[test]
fn several_sheets_are_the_sum_over_their_rays() {
    let mut numbers = Numbers(2);
    let mut largest = 0.0_f64;
    for count in [2, 2, 2, 2, 3, 3, 4] {
        // Uncoated ones: for each polarisation.
        let slabs: Vec<[f64; 2]> =
            (0..count).map(|_| [numbers.within(1.45, 1.7), numbers.within(0.5, 1.0)]).collect();
        let products: Vec<GlazingProduct> =
            slabs.iter().map(|[eta, a]| grey(UNCOATED, slab(1e-6, *eta, *a)[0])).collect();
        let all = glazing(&products.iter().map(|it| (it, false)).collect::<Vec<_>>());
        for _ in 0..5 {
            let theta_rad = numbers.within(0.01, 1.5);
            let sheets: Vec<_> = slabs.iter().map(|[eta, a]| slab(theta_rad, *eta, *a)).collect();
            let polarised =
                [0, 1].map(|p| ray_sum(&sheets.iter().map(|it| it[p]).collect::<Vec<_>>()));
            let found = array(all.visible(libm::cos(theta_rad)));
            assert!(apart(found, mean(polarised)) < 1e-6, "{found:?} not {polarised:?}");
            let unpolarised = ray_sum(&sheets.iter().map(|it| mean(*it)).collect::<Vec<_>>());
            largest = largest.max((found[0] - unpolarised[0]).abs());
        }
        // Coated ones, some turned round: each sheet is as it is alone.
        let products: Vec<(GlazingProduct, bool)> =
            (0..count).map(|_| (random_product(&mut numbers), numbers.next() < 0.5)).collect();
        let layers: Vec<_> = products.iter().map(|(it, flipped)| (it, *flipped)).collect();
        let cos = numbers.within(0.02, 1.0);
        let alone: Vec<[f64; 3]> =
            layers.iter().map(|layer| array(glazing(&[*layer]).visible(cos))).collect();
        let found = array(glazing(&layers).visible(cos));
        assert!(apart(found, ray_sum(&alone)) < 1e-9, "{found:?} of {alone:?}");
    }
    // Keeping the polarisations apart matters.
    assert!(largest > 1e-3, "{largest}");
}

/// A coated product, the same at all wavelengths.
fn random_product(numbers: &mut Numbers) -> GlazingProduct {
    let t = numbers.within(0.05, 0.9);
    let [front, back] = [0, 1].map(|_| numbers.within(0.0, 1.0 - t));
    grey(COATED, [t, front, back])
}

/// A short-pass and a long-pass filter: nothing passes both, whatever their means.
#[test]
fn sheets_are_combined_by_wavelength() {
    let step = |[a, b]: [f64; 2]| {
        let line = |nm: f64, t: f64| [nm, t, 0.0, 0.0];
        product(&file(COATED, &[line(300.0, a), line(550.0, a), line(551.0, b), line(900.0, b)]))
    };
    let (short, long) = (step([1.0, 0.0]), step([0.0, 1.0]));
    let [a, b] = [&short, &long].map(|it| it.normal().transmittance);
    assert!((a + b - 1.0).abs() < 1e-12 && (0.3..0.7).contains(&a), "{a} {b}");
    let [t, front, back] = array(glazing(&[(&short, false), (&long, true)]).visible(1.0));
    assert!(t.abs() < 1e-12 && front.abs() < 1e-12 && back.abs() < 1e-12, "{t} {front} {back}");
    let twice = glazing(&[(&short, false), (&short, true)]).visible(1.0);
    assert!((twice.transmittance - a).abs() < 1e-12);
}

#[test]
fn coated_sheets_follow_the_published_curves() {
    // Finlayson et al. 1993, as EnergyPlus' engineering reference tabulates them.
    let clear =
        |c: f64| -0.0015 + 3.355 * c - 3.840 * c * c + 1.460 * c * c * c + 0.0288 * c * c * c * c;
    let bronze =
        |c: f64| -0.002 + 2.813 * c - 2.341 * c * c - 0.05725 * c * c * c + 0.599 * c * c * c * c;
    for t in [0.3, 0.64, 0.65, 0.8] {
        let sheet = glazing(&[(&grey(COATED, [t, 0.1, 0.05]), false)]);
        assert!(apart(array(sheet.visible(1.0)), [t, 0.1, 0.05]) < 1e-12);
        for cos in [0.9, 0.7, 0.5, 0.3, 0.15] {
            let expected = t * if t > 0.645 { clear(cos) } else { bronze(cos) };
            let found = sheet.visible(cos);
            // Scaled to the value at normal incidence: by 0.2 and 1.2 %.
            let off = (found.transmittance / expected - 1.0).abs();
            assert!(off < 0.013, "{t} at {cos}: {found:?} not {expected}");
            assert!(found.front_reflectance > 0.1 - 1e-12);
            assert!(found.back_reflectance > 0.05 - 1e-12);
        }
        let [t, front, back] = array(sheet.visible(0.0));
        assert!(t < 1e-12 && front > 0.99 && back > 0.99, "{t} {front} {back}");
    }
}

#[test]
fn no_glazing_makes_light() {
    let mut numbers = Numbers(3);
    for _ in 0..300 {
        let count = 1 + (5.0 * numbers.next()) as usize;
        let products: Vec<(GlazingProduct, bool)> = (0..count)
            .map(|_| {
                let mut line = |nm: f64| {
                    let t = numbers.next();
                    let r = (1.0 - t) * numbers.next();
                    [nm, t, r, r * 0.999]
                };
                let lines = [300.0, 400.0, 470.0, 550.0, 620.0, 900.0].map(&mut line);
                let words = if numbers.next() < 0.5 { COATED } else { UNCOATED };
                let read = read_glazing(file(words, &lines).as_bytes()).unwrap();
                (read.product, numbers.next() < 0.5)
            })
            .collect();
        let layers: Vec<_> = products.iter().map(|(it, flipped)| (it, *flipped)).collect();
        let all = glazing(&layers);
        for cos in [0.0, 1e-12, 1e-3, numbers.next(), numbers.next(), 1.0] {
            let [t, front, back] = array(all.visible(cos));
            assert!(t >= 0.0 && front >= 0.0 && back >= 0.0, "{t} {front} {back}");
            assert!(t + front <= 1.0 && t + back <= 1.0, "{t} {front} {back} at {cos}");
        }
    }
    assert_eq!(array(Glazing::new(Vec::new()).visible(0.4)), [1.0, 0.0, 0.0]);
}

#[test]
fn oddities_are_told_and_what_makes_no_sense_is_refused() {
    use WarningKind as K;
    let visible =
        |t: f64, front: f64, back: f64| [[300.0, t, front, back], [900.0, t, front, back]];
    let stated = "\"integrated_results_summary\": [{\"tfvis\": 0.7, \"rfvis\": 0.1, \
                  \"rbvis\": 0.1}], \"subtype\": \"coated\"";
    let short = [[400.0, 0.8, 0.1, 0.1], [720.0, 0.8, 0.1, 0.1]];
    for (text, kind, needle) in [
        (
            file(COATED, &visible(0.9, 0.11, 0.1)),
            K::SharesExceedOne,
            "1.0100 together in spectral_data[0]",
        ),
        (file(COATED, &visible(0.9, -0.01, 0.1)), K::NegativeScattering, "spectral_data[0]"),
        (file(COATED, &short), K::ShortSpectrum, "from 400 to 720 nm; expected 380 to 780 nm"),
        (file(UNCOATED, &visible(0.8, 0.1, 0.15)), K::UnlikeUncoated, "0.1000 and 0.1500"),
        (file(UNCOATED, &visible(0.5, 0.4, 0.4)), K::UnlikeUncoated, "refractive index of"),
        (file(stated, &visible(0.8, 0.1, 0.1)), K::StatedOtherwise, "0.7000, but 0.8000 by"),
    ] {
        let read = read_glazing(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"));
        let [warning] = read.warnings.as_slice() else { panic!("{:?}", read.warnings) };
        assert_eq!(warning.kind(), kind);
        assert!(warning.to_string().contains(needle), "no {needle} in: {warning}");
    }
    let blocks = "{\"subtype\": \"coated\", \"physical_properties\": {\"optical_properties\": \
        {\"optical_data\": {\"angle_blocks\": [{\"incidence_angle\": 0, \"wavelength_data\": [\
        {\"w\": \"0.3\", \"specular\": {\"tf\": 0.5, \"tb\": \"0.6\", \"rf\": 0, \"rb\": 0}}, \
        {\"w\": 0.9, \"specular\": {\"tf\": 0.5, \"tb\": 0.6, \"rf\": 0, \"rb\": 0}}]}, \
        {\"incidence_angle\": 60, \"wavelength_data\": []}]}}}}";
    let read = read_glazing(blocks.as_bytes()).unwrap();
    let kinds: Vec<K> = read.warnings.iter().map(|warning| warning.kind()).collect();
    assert_eq!(kinds, [K::OtherIncidences, K::TransmittancesDiffer]);
    assert!((read.product.normal().transmittance - 0.55).abs() < 1e-12);
    for (text, wanted) in [
        ("".to_owned(), "1:1: found EOF while parsing a value"),
        ("[1]".to_owned(), "1:"),
        ("{\"name\": \"\u{e9}\u{e9}\", x".to_owned(), "1:16: found"),
        ("{}".to_owned(), "1:1: found no spectrum; expected measured values"),
        (file(COATED, &[]), "1:1: found no spectrum"),
        (file(COATED, &visible(1.2, 0.1, 0.1)), "found 1.2 in spectral_data[0]; expected shares"),
        (file(COATED, &[[1e3, 0.5, 0.1, 0.1], [2e3, 0.5, 0.1, 0.1]]), "visible ones, at least"),
        (file(COATED, &[[5e5, 0.5, 0.1, 0.1], [4e5, 0.5, 0.1, 0.1]]), "expected rising"),
        (file(COATED, &[[-5.0, 0.5, 0.1, 0.1]]), "micrometres within 0.01"),
        (file(COATED, &visible(0.5, 0.1, 0.1)).replace("\"T\"", "\"U\""), "3:"),
        (
            file(COATED, &visible(0.5, 0.1, 0.1)).replace("\"T\": 0.5", "\"T\": \"a\""),
            "found invalid value: string \"a\"; expected a finite number",
        ),
        (blocks.replace("\"incidence_angle\": 0", "\"incidence_angle\": 5"), "no angle_blocks"),
        (blocks.replace("}}, ", "}, \"diffuse\": {}}, "), "diffuse values in wavelength_data[0]"),
        ("{\"measured_data\": {\"is_specular\": false}}".to_owned(), "is_specular = false"),
        ("[".repeat(10_000), "1:"),
        (format!("{{\"x\": {}", "[".repeat(10_000)), "EOF while parsing a list"),
    ] {
        let error = read_glazing(text.as_bytes()).unwrap_err().to_string();
        assert!(error.contains(wanted), "no {wanted:?} in: {error}");
    }
}
