//! The cursor: which coordinates, and how many.

use quasilux_sampling::{Randomization, SampleCursor};

use crate::support::sobol;

#[test]
fn hands_out_coordinates_in_order() {
    let points = sobol(Randomization::Owen, 1);
    let mut cursor = SampleCursor::new(&points, 77);
    let coordinates = [cursor.next_1d(), cursor.next_2d()[0], cursor.clone().next_1d()];
    assert_eq!(coordinates, [0, 1, 3].map(|dimension| points.coordinate(77, dimension)));
    assert_eq!((cursor.used(), cursor.dimension()), (3, 3));
}

#[test]
fn skips_forward_only_and_counts_what_it_gives() {
    let points = sobol(Randomization::Owen, 1);
    let mut cursor = SampleCursor::new(&points, 5);
    cursor.skip_to(4);
    assert_eq!((cursor.used(), cursor.dimension()), (0, 4));
    assert_eq!(cursor.next_1d(), points.coordinate(5, 4));
    cursor.skip_to(2);
    assert_eq!(cursor.next_1d(), points.coordinate(5, 5));
    assert_eq!((cursor.used(), cursor.dimension()), (2, 6));
}
