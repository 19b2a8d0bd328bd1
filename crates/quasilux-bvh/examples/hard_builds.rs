//! cargo run --release -p quasilux-bvh --example hard_builds [TRIANGLES [NAME]]
//!
//! Builds and checks hierarchies over meshes that are hard on a builder, of a million triangles
//! each unless told. The tests do the same with fewer triangles.

#[path = "../tests/it/degenerate_meshes.rs"]
mod degenerate_meshes;
#[allow(dead_code, reason = "the generator of numbers is all that is used")]
#[path = "../tests/it/meshes.rs"]
mod meshes;

use meshes::{NamedMesh, Numbers, hard_meshes};
use quasilux_bvh::TriangleBvh;

fn main() {
    let mut words = std::env::args().skip(1);
    let count = words.next().map_or(Ok(1_000_000), |word| word.parse::<usize>());
    let count = count.expect("the number of triangles is a number");
    let wanted = words.next().unwrap_or_default();
    let numbers = &mut Numbers(6);
    let mut meshes: Vec<NamedMesh> = degenerate_meshes::degenerate_meshes(numbers, count);
    meshes.extend(hard_meshes(numbers, count / 200));
    let mut flaws = 0;
    for NamedMesh { name, mesh } in meshes.into_iter().filter(|mesh| mesh.name.contains(&wanted)) {
        let count = mesh.len();
        match TriangleBvh::build(mesh).validate() {
            Ok(()) => println!("{name}: {count} triangles, valid"),
            Err(flaw) => {
                println!("{name}: {count} triangles, {flaw}");
                flaws += 1;
            }
        }
    }
    assert_eq!(flaws, 0, "{flaws} hierarchies are not valid");
}
