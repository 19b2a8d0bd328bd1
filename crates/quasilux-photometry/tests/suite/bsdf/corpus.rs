use quasilux_photometry::bsdf::*;
use glam::DVec3;

fn dir(theta: f64, phi: f64) -> DVec3 {
    let (st, ct) = theta.to_radians().sin_cos();
    let (sp, cp) = phi.to_radians().sin_cos();
    DVec3::new(st * cp, st * sp, ct)
}
#[test]
fn show() {
    let text = std::fs::read_to_string("/tmp/rad.txt").unwrap();
    let mut last = (String::new(), None);
    for line in text.lines() {
        let w: Vec<&str> = line.split(' ').collect();
        if last.0 != w[0] {
            let r = read_bsdf(&std::fs::read(format!("/work/shared/data/bsdf/{}", w[0])).unwrap()).unwrap();
            println!("{} {:?}", w[0], r.bsdf.facts());
            for w in r.warnings { println!("   {w}"); }
            last = (w[0].to_owned(), Some(r.bsdf));
        }
        let b = last.1.as_ref().unwrap();
        let side = if w[1] == "front" { Side::Front } else { Side::Back };
        let way = if w[2] == "reflection" { Way::Reflection } else { Way::Transmission };
        let n: Vec<f64> = w[3..].iter().map(|x| x.parse().unwrap_or(-1.0)).collect();
        let wi = dir(n[0], n[1]);
        let d = b.scattering(side, way);
        let ours = match (d, w[5]) {
            (None, _) => 0.0,
            (Some(d), "-") => d.albedo(wi)[0],
            (Some(d), _) => d.evaluate(wi, dir(n[2], n[3]))[0],
        };
        let e = (ours - n[4]).abs();
        if e > 0.002 * n[4].abs() + 1e-6 { println!("{line}: {ours}"); }
    }
}
