//! Data files of Radiance: values on a grid of one or two coordinates.
//!
//! ```text
//! number of coordinates            comments from # on
//! first last count                 or, where both are equal, as many positions behind them
//! values, the last coordinate fastest
//! ```

/// Most values of a file.
const MAX_VALUES: usize = 1_000_000;

/// Values on a grid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Data {
    /// Positions of each coordinate, rising.
    pub(super) axes: Vec<Vec<f64>>,
    values: Vec<f64>,
}

struct Numbers<'t> {
    /// With the numbers of their lines.
    words: Box<dyn Iterator<Item = (usize, &'t str)> + 't>,
    /// Of the last word.
    line: usize,
}

impl Numbers<'_> {
    fn next(&mut self, expected: &str) -> Result<f64, String> {
        let word = self.words.next();
        let (line, word) = word.ok_or_else(|| format!("it ends; expected {expected}"))?;
        self.line = line;
        let number = word.parse().ok().filter(|number: &f64| number.is_finite());
        number.ok_or_else(|| {
            let found = super::document::shown(word);
            format!("line {line} has {found}; expected {expected}, a number")
        })
    }

    fn count(&mut self, expected: &str, most: usize) -> Result<usize, String> {
        let number = self.next(expected)?;
        let is_count = number.fract() == 0.0 && number >= 1.0 && number <= most as f64;
        if is_count {
            Ok(number as usize)
        } else {
            Err(format!("{number} in line {} is not {expected}", self.line))
        }
    }
}

impl Data {
    /// Reads a file; `Err` says what was expected.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let uncommented = text.lines().map(|line| line.split('#').next().unwrap_or_default());
        let words = (1..)
            .zip(uncommented)
            .flat_map(|(line, text)| text.split_whitespace().map(move |word| (line, word)));
        let mut numbers = Numbers { words: Box::new(words), line: 1 };
        let dimensions = numbers.count("the number of coordinates, 1 or 2", 2)?;
        let mut axes = Vec::new();
        let mut count = 1_usize;
        for _ in 0..dimensions {
            let mut axis = axis(&mut numbers)?;
            count = count.saturating_mul(axis.len());
            if axis.len() > 1 && axis[0] > axis[1] {
                return Err(format!(
                    "its positions up to line {} fall; expected rising ones",
                    numbers.line
                ));
            }
            if !axis.windows(2).all(|pair| pair[0] < pair[1]) {
                return Err(format!("its positions up to line {} do not rise", numbers.line));
            }
            axes.push(std::mem::take(&mut axis));
        }
        if count > MAX_VALUES {
            return Err(format!("it has more than {MAX_VALUES} values"));
        }
        let mut values = Vec::new();
        for _ in 0..count {
            values.push(numbers.next("a value")?);
        }
        Ok(Self { axes, values })
    }

    /// Between the values linear in each coordinate; 0 beyond them.
    pub(super) fn value(&self, at: &[f64]) -> f64 {
        let mut places = at.iter().zip(&self.axes).map(|(&at, axis)| place(axis, at));
        let Some(Some(first)) = places.next() else { return 0.0 };
        match (self.axes.len(), places.next()) {
            (1, _) => first.between(self.values[first.index], self.get(first.index + 1)),
            (_, Some(Some(second))) => {
                let columns = self.axes[1].len();
                let row = |row: usize| {
                    let at = row * columns + second.index;
                    second.between(self.get(at), self.get(at + 1))
                };
                first.between(row(first.index), row(first.index + 1))
            }
            _ => 0.0,
        }
    }

    fn get(&self, index: usize) -> f64 {
        self.values.get(index).copied().unwrap_or(0.0)
    }

    /// Whether no value is below 0.
    pub(super) fn is_of_light(&self) -> bool {
        self.values.iter().all(|&value| value >= 0.0)
    }
}

fn axis(numbers: &mut Numbers<'_>) -> Result<Vec<f64>, String> {
    let (first, last) = (numbers.next("where it begins")?, numbers.next("where it ends")?);
    let count = numbers.count("a number of positions", MAX_VALUES)?;
    let mut axis = Vec::new();
    if first == last && count > 1 {
        for _ in 0..count {
            axis.push(numbers.next("a position")?);
        }
    } else {
        let step = (last - first) / (count.max(2) - 1) as f64;
        axis.extend((0..count).map(|index| first + step * index as f64));
        if count > 1 {
            axis[count - 1] = last;
        }
    }
    Ok(axis)
}

/// A place between two positions.
struct Between {
    index: usize,
    share: f64,
}

impl Between {
    fn between(&self, before: f64, after: f64) -> f64 {
        if self.share == 0.0 { before } else { before + self.share * (after - before) }
    }
}

/// Positions that are off by rounding only are those at the ends.
fn place(axis: &[f64], at: f64) -> Option<Between> {
    let (first, last) = (axis[0], axis[axis.len() - 1]);
    let near = 1e-9 * (1.0 + last.abs());
    if axis.len() == 1 {
        return Some(Between { index: 0, share: 0.0 });
    }
    if !(at >= first - near && at <= last + near) {
        return None;
    }
    let at = at.clamp(first, last);
    let index = axis.partition_point(|&position| position <= at).clamp(1, axis.len() - 1) - 1;
    Some(Between { index, share: (at - axis[index]) / (axis[index + 1] - axis[index]) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_are_read_and_interpolated() {
        let data = Data::parse("# two\n2\n0 90 2\n0 0 3  0 45 180\n1 2 3\n5 6 # end\n7").unwrap();
        assert_eq!(data.axes, [vec![0.0, 90.0], vec![0.0, 45.0, 180.0]]);
        let near = |at: [f64; 2], value: f64| {
            assert!((data.value(&at) - value).abs() < 1e-12, "{at:?}");
        };
        near([0.0, 0.0], 1.0);
        near([90.0, 180.0], 7.0);
        near([45.0, 22.5], 3.5);
        near([90.0 + 1e-12, 45.0], 6.0);
        assert_eq!(data.value(&[91.0, 45.0]), 0.0);
        let line = Data::parse("1 0 10 3 1 2 4").unwrap();
        assert_eq!((line.value(&[7.5]), line.value(&[10.0])), (3.0, 4.0));
        for wrong in ["", "3 0 1 2", "1 0 90 1e9 5", "1 0 90 2 1", "1 5 0 2 1 1", "1 0 0 2 5 5 1 1"]
        {
            assert!(Data::parse(wrong).is_err(), "{wrong}");
        }
        let error = Data::parse("1\n0 9 2\n# x\n1 x").unwrap_err();
        assert!(error.contains("line 4 has x"), "{error}");
    }
}
