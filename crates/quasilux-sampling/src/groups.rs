//! Coherent groups: the indices below N, regrouped so that the points of a group lie close
//! together.
//!
//! A. Voloboy, K. Dmitriev, E. Kopylov (2003), after K. Dmitriev, S. Brabec, K. Myszkowski, H.-P.
//! Seidel, "Interactive global illumination using selective photon tracing" (EGWR 2002): the
//! radical inverses of i and i + n b^k differ by less than b^-k, so photons whose indices agree
//! modulo the product of b_j^k_j start at the same light in nearly the same direction: they visit
//! the same nodes and cache lines. For a matrix over bits the same holds of the cosets of a
//! subspace: the indices x with R x = 0, R the first k_j rows of the matrices C_j.
//!
//! Groups are numbered so that neighbours are close as well: the first digits of a number are the
//! first shared digits of its points, those of all dimensions in turn, so that the groups of one
//! coarser partition follow each other.

use crate::point_set::{Generator, PointSet};
use crate::randomization::Randomization;
use crate::sequence::BinaryMatrices;

/// How many leading digits of a dimension the members of a group share.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SharedDigits {
    /// The dimension.
    pub dimension: u32,
    /// The number of digits, in the base of the dimension.
    pub digits: u32,
}

/// A partition of the indices 0 .. N into groups of nearby points.
///
/// ```
/// use quasilux_sampling::{CoherentGroups, PointSet, Randomization, Sequence};
/// let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 7);
/// let groups = CoherentGroups::with_size(&points, 1 << 12, &[0, 1, 2], 64).unwrap();
/// assert_eq!(groups.len(), 64);
/// let close = |i, j| (points.coordinate(i, 0) - points.coordinate(j, 0)).abs() < 0.25;
/// let first = groups.group(5).next().unwrap();
/// assert!(groups.group(5).all(|index| close(index, first)));
/// ```
#[derive(Clone, Debug)]
pub struct CoherentGroups {
    count: u64,
    shared: Vec<SharedDigits>,
    bases: Vec<u32>,
    partition: Partition,
}

#[derive(Clone, Debug)]
enum Partition {
    /// Indices that agree modulo the product of `factors`: the lowest digit of an index in this
    /// mixed radix is the highest digit of its group's number.
    Residues { period: u64, factors: Vec<u32> },
    /// Cosets of the span of `kernel`. Bit r of a group's number adds `labels[r]` to its first
    /// index, which flips one shared digit of the points, the last one for r = 0.
    Cosets { kernel: Vec<u64>, labels: Vec<u64> },
}

impl CoherentGroups {
    /// Groups of the indices below `count` whose points agree in the leading digits of the given
    /// dimensions.
    ///
    /// `None` for pseudo-random points, for dimensions past the sequence's own and for the first of
    /// Hammersley's, and when the indices or the groups would be more than 2^63.
    #[must_use]
    pub fn new(points: &PointSet, count: u64, shared: &[SharedDigits]) -> Option<Self> {
        if count > 1 << 63 {
            return None;
        }
        let base = |shared: &SharedDigits| points.digit_base(shared.dimension);
        let bases = shared.iter().map(base).collect::<Option<Vec<u32>>>()?;
        let partition = match points.generator {
            Generator::Binary(matrices) => cosets(matrices, count, shared),
            Generator::Radical { .. } => residues(shared, &bases)?,
            Generator::Independent | Generator::Varied(_) => return None,
        };
        Some(Self { count, shared: shared.to_vec(), bases, partition })
    }

    /// Groups of about `size` members (at least as many, where `count` is a multiple of the number
    /// of groups) that are close in the given dimensions: the widest dimension is divided until
    /// another division would make the groups smaller.
    #[must_use]
    pub fn with_size(points: &PointSet, count: u64, dimensions: &[u32], size: u64) -> Option<Self> {
        let mut shared: Vec<SharedDigits> =
            dimensions.iter().map(|&dimension| SharedDigits { dimension, digits: 0 }).collect();
        let mut groups = Self::new(points, count, &shared)?;
        loop {
            let widths = (0..shared.len()).map(|place| groups.width(place));
            let widest = widths.enumerate().max_by(|(i, a), (j, b)| a.total_cmp(b).then(j.cmp(i)));
            let Some((widest, _)) = widest else { return Some(groups) };
            shared[widest].digits += 1;
            match Self::new(points, count, &shared) {
                Some(finer)
                    if finer.len() <= count / size.max(1) && shared[widest].digits <= 53 =>
                {
                    groups = finer;
                }
                _ => return Some(groups),
            }
        }
    }

    /// The number of groups; some are empty where `count` is no multiple of it.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "there is at least one group")]
    pub fn len(&self) -> u64 {
        match &self.partition {
            Partition::Residues { period, .. } => *period,
            Partition::Cosets { labels, .. } => 1 << labels.len(),
        }
    }

    /// The indices of one group, in a fixed order.
    #[must_use]
    pub fn group(&self, number: u64) -> Group<'_> {
        let members = match &self.partition {
            Partition::Residues { period, factors } => {
                Members::Residues { next: reversed(number, *period, factors), period: *period }
            }
            Partition::Cosets { kernel, labels } => {
                let chosen = labels.iter().enumerate().filter(|(r, _)| number >> r & 1 == 1);
                let first = chosen.fold(0, |first, (_, label)| first ^ label);
                Members::Cosets { kernel, next: first, step: 0 }
            }
        };
        Group { count: if number < self.len() { self.count } else { 0 }, members }
    }

    /// All indices below `count`, group by group, each once.
    pub fn indices(&self) -> impl Iterator<Item = u64> + '_ {
        (0..self.len()).flat_map(|number| self.group(number))
    }

    /// The dimensions, and how many digits the members of a group share in each.
    #[must_use]
    pub fn shared(&self) -> &[SharedDigits] {
        &self.shared
    }

    /// The bound b^-k on the spread of each coordinate within a group, in the order of
    /// [`shared`](Self::shared): any two members differ by less. Under
    /// [`Rotation`](crate::Randomization::CranleyPattersonRotation) they do so modulo 1.
    #[must_use]
    pub fn bounds(&self) -> Vec<f64> {
        (0..self.shared.len()).map(|place| self.width(place)).collect()
    }

    /// What the bound promises, measured: the largest minus the smallest coordinate of the members
    /// of a group, in the order of [`shared`](Self::shared); 0 for an empty group. Under
    /// [`Rotation`](crate::Randomization::CranleyPattersonRotation), the length of the shortest arc
    /// of the circle of length 1 that holds them.
    #[must_use]
    pub fn spreads(&self, points: &PointSet, number: u64) -> Vec<f64> {
        let spread = |shared: &SharedDigits| {
            let coordinates =
                self.group(number).map(|index| points.coordinate(index, shared.dimension));
            match points.randomization() {
                Randomization::CranleyPattersonRotation => shortest_arc(coordinates.collect()),
                Randomization::None | Randomization::DigitalShift | Randomization::Owen => {
                    let (low, high) = coordinates
                        .fold((1.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
                    (high - low).max(0.0)
                }
            }
        };
        self.shared.iter().map(spread).collect()
    }

    fn width(&self, place: usize) -> f64 {
        (0..self.shared[place].digits).fold(1.0, |width, _| width / f64::from(self.bases[place]))
    }
}

/// The indices of one group.
#[derive(Clone, Debug)]
pub struct Group<'a> {
    count: u64,
    members: Members<'a>,
}

#[derive(Clone, Debug)]
enum Members<'a> {
    Residues { next: u64, period: u64 },
    Cosets { kernel: &'a [u64], next: u64, step: u64 },
}

impl Iterator for Group<'_> {
    type Item = u64;

    fn next(&mut self) -> Option<u64> {
        match &mut self.members {
            Members::Residues { next, period } => {
                let index = Some(*next).filter(|index| *index < self.count)?;
                match next.checked_add(*period) {
                    Some(following) => *next = following,
                    None => self.count = 0,
                }
                Some(index)
            }
            Members::Cosets { kernel, next, step } => {
                // Gray code: each member is the one before it plus one vector of the kernel.
                while *step < 1 << kernel.len() {
                    let index = *next;
                    *step += 1;
                    if let Some(vector) = kernel.get(step.trailing_zeros() as usize) {
                        *next ^= vector;
                    }
                    if index < self.count {
                        return Some(index);
                    }
                }
                None
            }
        }
    }
}

fn residues(shared: &[SharedDigits], bases: &[u32]) -> Option<Partition> {
    let mut powers: Vec<(u32, u64)> = Vec::new();
    for (shared, base) in shared.iter().zip(bases) {
        let power = u64::from(*base).checked_pow(shared.digits)?;
        match powers.iter_mut().find(|(other, _)| other == base) {
            Some((_, other)) => *other = power.max(*other),
            None => powers.push((*base, power)),
        }
    }
    let period = powers.iter().try_fold(1_u64, |period, (_, power)| period.checked_mul(*power))?;
    let mut factors: Vec<(u64, u32)> = Vec::new();
    for (base, power) in powers {
        let divided = std::iter::successors(Some(1_u64), |by| by.checked_mul(u64::from(base)));
        factors.extend(divided.take_while(|by| *by < power).map(|by| (by, base)));
    }
    // The coarsest divisions first.
    factors.sort_unstable();
    let factors = factors.into_iter().map(|(_, base)| base).collect();
    (period <= 1 << 63).then_some(Partition::Residues { period, factors })
}

/// The number below `period`, the product of `factors`, whose digits in this mixed radix are those
/// of `number` in reverse.
fn reversed(number: u64, period: u64, factors: &[u32]) -> u64 {
    let (mut rest, mut value, mut sum) = (number, period, 0);
    for factor in factors.iter().rev().copied().map(u64::from) {
        value /= factor;
        sum += rest % factor * value;
        rest /= factor;
    }
    sum
}

/// A row in reduced echelon form: its pivot is its lowest bit, in no other row.
struct Row {
    row: u64,
    /// The independent rows that it is the sum of, the first in bit 0.
    of: u64,
}

/// Solves R x = 0 for the indices x of as many bits as `count` - 1 has: at most 63.
fn cosets(matrices: &BinaryMatrices, count: u64, shared: &[SharedDigits]) -> Partition {
    let bits = 64 - count.saturating_sub(1).leading_zeros();
    let mut rows: Vec<Row> = Vec::new();
    for digit in 0..64 {
        for shared in shared.iter().filter(|shared| digit < shared.digits) {
            let row = matrix_row(matrices, bits, shared.dimension, digit);
            add_row(&mut rows, row);
        }
    }
    rows.sort_unstable_by_key(|row| row.row.trailing_zeros());
    let sum = |chosen: &dyn Fn(&Row) -> bool| {
        rows.iter().filter(|row| chosen(row)).fold(0, |sum, row| sum | lowest(row.row))
    };
    let label = |r: usize| sum(&|row| row.of >> r & 1 == 1);
    let pivots = sum(&|_| true);
    let kernel_vector = |free: u32| 1 << free | sum(&|row| row.row >> free & 1 == 1);
    let kernel = (0..bits).filter(|bit| pivots >> bit & 1 == 0).map(kernel_vector).collect();
    Partition::Cosets { kernel, labels: (0..rows.len()).rev().map(label).collect() }
}

/// Adds a row unless it is a sum of those that are there.
fn add_row(rows: &mut Vec<Row>, row: u64) {
    let mut new = Row { row, of: 0 };
    for other in rows.iter() {
        if new.row & lowest(other.row) != 0 {
            new = Row { row: new.row ^ other.row, of: new.of ^ other.of };
        }
    }
    if new.row == 0 {
        return;
    }
    new.of ^= 1 << rows.len();
    for other in rows.iter_mut() {
        if other.row & lowest(new.row) != 0 {
            *other = Row { row: other.row ^ new.row, of: other.of ^ new.of };
        }
    }
    rows.push(new);
}

/// Row `digit` of a matrix, column k in bit k.
fn matrix_row(matrices: &BinaryMatrices, bits: u32, dimension: u32, digit: u32) -> u64 {
    (0..bits).map(|k| ((matrices.column(k, dimension) >> digit) & 1) << k).sum()
}

/// All of the circle but the widest gap between neighbours.
fn shortest_arc(mut coordinates: Vec<f64>) -> f64 {
    coordinates.sort_unstable_by(f64::total_cmp);
    let [first, .., last] = coordinates[..] else { return 0.0 };
    let gaps = coordinates.windows(2).map(|pair| pair[1] - pair[0]);
    1.0 - gaps.fold(first + 1.0 - last, f64::max)
}

fn lowest(row: u64) -> u64 {
    row & row.wrapping_neg()
}
