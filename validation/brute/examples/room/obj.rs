//! Triangles with the names of their materials, from the lines `v`, `usemtl` and `f` of an OBJ
//! file.

use glam::DVec3;

/// A triangle and its material.
pub(super) struct Shape {
    pub(super) corners: [DVec3; 3],
    pub(super) material: String,
}

pub(super) fn read(text: &str) -> Result<Vec<Shape>, String> {
    let (mut places, mut shapes) = (Vec::new(), Vec::new());
    let mut material = String::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let wrong = || format!("not understood: {line}");
        match words.as_slice() {
            ["v", x, y, z, ..] => {
                let [x, y, z] = [x, y, z].map(|word| word.parse::<f64>());
                let place = |x, y, z| DVec3::new(x, y, z);
                places.push(place(
                    x.map_err(|_| wrong())?,
                    y.map_err(|_| wrong())?,
                    z.map_err(|_| wrong())?,
                ));
            }
            ["usemtl", name] => material = (*name).to_owned(),
            ["f", corners @ ..] => {
                let place = |word: &&str| {
                    let number: usize = word.split('/').next()?.parse().ok()?;
                    places.get(number.checked_sub(1)?).copied()
                };
                let corners: Option<Vec<DVec3>> = corners.iter().map(place).collect();
                let corners = corners.filter(|corners| corners.len() > 2).ok_or_else(wrong)?;
                for pair in corners[1..].windows(2) {
                    let corners = [corners[0], pair[0], pair[1]];
                    shapes.push(Shape { corners, material: material.clone() });
                }
            }
            _ => {}
        }
    }
    Ok(shapes)
}
