//! Options of `xform`: transforms in order, arrays of copies, and what else it changes.
//!
//! `-t x y z`, `-rx -ry -rz` in degrees, `-s` and the mirrors `-mx -my -mz` act one after the
//! other. `-a n` makes n copies, to which what stands behind it is applied 0 to n - 1 times; `-i n`
//! applies it n times. The next of them ends it. Arrays multiply, so that their product is bounded.

use super::document::shown;
use super::frame::Frame;
use glam::DVec3;

/// Most copies of one command.
pub(super) const MAX_COPIES: u64 = 1_000_000;
/// Most transforms of one command.
const MAX_STEPS: usize = 100_000;
/// Most arrays of one command.
const MAX_ARRAYS: usize = 64;

/// Transforms that are applied together.
#[derive(Clone, Debug)]
struct Block {
    frame: Frame,
    repeat: Repeat,
}

#[derive(Clone, Copy, Debug)]
enum Repeat {
    Times(u64),
    Array(u64),
}

/// Transforms of a command; an array has several.
#[derive(Clone, Debug, Default)]
pub(super) struct Transforms {
    blocks: Vec<Block>,
}

/// A whole command.
#[derive(Clone, Debug, Default)]
pub(super) struct Xform {
    pub(super) transforms: Transforms,
    /// `-I`: fronts become backs.
    pub(super) is_inverted: bool,
    /// `-n`: a prefix of the names of surfaces.
    pub(super) name: Option<String>,
    /// `-m`: the modifier of all surfaces.
    pub(super) modifier: Option<String>,
    pub(super) files: Vec<String>,
}

/// Hands out arguments.
struct Arguments<'a> {
    words: &'a [String],
    next: usize,
}

impl Arguments<'_> {
    fn word(&mut self, of: &str) -> Result<&str, String> {
        self.next += 1;
        let word = self.words.get(self.next - 1).map(String::as_str);
        word.ok_or_else(|| format!("{of} of xform lacks an argument"))
    }

    fn number(&mut self, of: &str) -> Result<f64, String> {
        let word = self.word(of)?;
        let number = word.parse().ok().filter(|number: &f64| number.abs() <= 1e15);
        number.ok_or_else(|| format!("{of} of xform has {}; expected a number", shown(word)))
    }

    fn count(&mut self, of: &str, least: u64) -> Result<u64, String> {
        let word = self.word(of)?;
        let count = word.parse().ok().filter(|&count: &u64| count >= least && count <= 1 << 40);
        count.ok_or_else(|| {
            format!("{of} of xform has {}; expected a whole number from {least}", shown(word))
        })
    }
}

impl Transforms {
    /// Takes the transforms at the front; the number of arguments that they are.
    pub(super) fn parse(words: &[String]) -> Result<Parsed, String> {
        let mut arguments = Arguments { words, next: 0 };
        let mut all = Self::default();
        all.start(Repeat::Times(1));
        while let Some(option) = words.get(arguments.next) {
            let of = option.as_str();
            if !(of.starts_with('-') && of.len() > 1) {
                break;
            }
            if arguments.next > MAX_STEPS {
                return Err(format!("xform has more than {MAX_STEPS} options; expected fewer"));
            }
            arguments.next += 1;
            let frame = match of {
                "-t" => {
                    let [x, y, z] =
                        [arguments.number(of)?, arguments.number(of)?, arguments.number(of)?];
                    Frame::shifted(DVec3::new(x, y, z))
                }
                "-rx" => Frame::about(0, arguments.number(of)?),
                "-ry" => Frame::about(1, arguments.number(of)?),
                "-rz" => Frame::about(2, arguments.number(of)?),
                "-s" => scale(arguments.number(of)?)?,
                "-mx" => Frame::mirrored(0),
                "-my" => Frame::mirrored(1),
                "-mz" => Frame::mirrored(2),
                "-a" => {
                    all.start(Repeat::Array(arguments.count(of, 1)?));
                    continue;
                }
                "-i" => {
                    all.start(Repeat::Times(arguments.count(of, 0)?));
                    continue;
                }
                _ => return Err(unknown(of)),
            };
            let block = all.blocks.last_mut().expect("a block is there from the start");
            block.frame = block.frame.then(&frame);
        }
        all.join_shared();
        all.must_be_bounded()?;
        Ok(Parsed { transforms: all, used: arguments.next })
    }

    /// Makes one block of those at the end that all copies share.
    fn join_shared(&mut self) {
        if let Some(last) = self.blocks.last_mut()
            && let Repeat::Times(times) = last.repeat
        {
            let frame = power(&last.frame, times);
            (last.frame, last.repeat) = (frame, Repeat::Times(1));
            if let [.., before, _] = self.blocks.as_mut_slice()
                && let Repeat::Times(1) = before.repeat
            {
                before.frame = before.frame.then(&frame);
                self.blocks.pop();
            }
        }
    }

    /// Blocks that each copy goes through.
    pub(super) fn steps(&self) -> u64 {
        self.blocks.len() as u64
    }

    fn start(&mut self, repeat: Repeat) {
        self.join_shared();
        self.blocks.push(Block { frame: Frame::default(), repeat });
    }

    fn must_be_bounded(&self) -> Result<(), String> {
        if self.sizes().count() > MAX_ARRAYS {
            return Err(format!("xform has more than {MAX_ARRAYS} arrays; expected fewer"));
        }
        let copies = self.sizes().try_fold(1_u64, u64::checked_mul);
        if copies.is_none_or(|copies| copies > MAX_COPIES) {
            return Err(format!("the arrays of xform make more than {MAX_COPIES} copies"));
        }
        Ok(())
    }

    fn sizes(&self) -> impl Iterator<Item = u64> + '_ {
        self.blocks.iter().filter_map(|block| match block.repeat {
            Repeat::Array(size) => Some(size),
            Repeat::Times(_) => None,
        })
    }

    /// How many copies there are.
    pub(super) fn copies(&self) -> u64 {
        self.sizes().product()
    }

    /// The frame of a copy; the last array counts fastest. `None` beyond all numbers.
    pub(super) fn copy(&self, number: u64) -> Option<Copy> {
        let mut rest = number;
        let mut left = self.copies();
        let mut copy = Copy { frame: Frame::default(), suffix: String::new() };
        for block in &self.blocks {
            let times = match block.repeat {
                Repeat::Times(times) => times,
                Repeat::Array(size) => {
                    left /= size;
                    let index = rest / left;
                    rest %= left;
                    copy.suffix.push_str(&format!(".{index}"));
                    index
                }
            };
            copy.frame = copy.frame.then(&power(&block.frame, times));
        }
        copy.frame.is_finite().then_some(copy)
    }
}

/// Transforms, and the number of arguments that they are.
pub(super) struct Parsed {
    pub(super) transforms: Transforms,
    pub(super) used: usize,
}

/// A copy of an array.
#[derive(Debug)]
pub(super) struct Copy {
    pub(super) frame: Frame,
    /// Its numbers, each behind a point.
    pub(super) suffix: String,
}

/// A frame applied some times, by squares.
fn power(frame: &Frame, mut times: u64) -> Frame {
    let (mut power, mut square) = (Frame::default(), *frame);
    while times > 0 {
        if times & 1 == 1 {
            power = power.then(&square);
        }
        square = square.then(&square);
        times >>= 1;
    }
    power
}

fn scale(by: f64) -> Result<Frame, String> {
    if by == 0.0 {
        return Err("-s of xform is 0; expected another factor".to_owned());
    }
    let frame = Frame::scaled(by.abs());
    if by > 0.0 {
        return Ok(frame);
    }
    let turned = (0..3).fold(Frame::default(), |all, axis| all.then(&Frame::mirrored(axis)));
    Ok(frame.then(&turned))
}

fn unknown(option: &str) -> String {
    let option = shown(option);
    format!(
        "the option {option} of xform is not read; expected -t, -rx, -ry, -rz, -s, -mx, -my, -mz, \
         -a or -i"
    )
}

impl Xform {
    /// Reads the arguments behind the name of the command.
    pub(super) fn parse(words: &[String]) -> Result<Self, String> {
        let mut xform = Self::default();
        let mut arguments = Arguments { words, next: 0 };
        while let Some(option) = words.get(arguments.next) {
            match option.as_str() {
                // Commands in files are expanded in any case.
                "-c" | "-e" => arguments.next += 1,
                "-I" => {
                    xform.is_inverted = !xform.is_inverted;
                    arguments.next += 1;
                }
                "-n" => {
                    arguments.next += 1;
                    let name = arguments.word("-n")?;
                    let outer = xform.name.take().map_or_else(String::new, |it| it + ".");
                    xform.name = Some(outer + name);
                }
                "-m" => {
                    arguments.next += 1;
                    let name = arguments.word("-m")?.to_owned();
                    xform.modifier.get_or_insert(name);
                }
                "-f" => {
                    return Err(
                        "files of arguments (-f) of xform are not read; write its options \
                                in the command"
                            .to_owned(),
                    );
                }
                _ => break,
            }
        }
        let rest = words.get(arguments.next..).unwrap_or(&[]);
        let Parsed { transforms, used } = Transforms::parse(rest)?;
        xform.transforms = transforms;
        xform.files = rest[used..].to_vec();
        Ok(xform)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(text: &str) -> Vec<String> {
        text.split_whitespace().map(str::to_owned).collect()
    }

    fn moved(options: &str, number: u64, point: [f64; 3]) -> DVec3 {
        let Parsed { transforms, used } = Transforms::parse(&words(options)).unwrap();
        assert_eq!(used, words(options).len());
        transforms.copy(number).unwrap().frame.point(DVec3::from_array(point))
    }

    fn expect(options: &str, number: u64, point: [f64; 3], there: [f64; 3]) {
        let found = moved(options, number, point);
        assert!((found - DVec3::from_array(there)).length() < 1e-12, "{options}: {found}");
    }

    /// By hand: each step acts on the outcome of the one before it.
    #[test]
    fn steps_act_in_their_order() {
        expect("-t 1 0 0 -rz 90", 0, [0.0; 3], [0.0, 1.0, 0.0]);
        expect("-rz 90 -t 1 0 0", 0, [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]);
        expect("-mx -s 2 -t 1 2 3", 0, [1.0, 0.0, 0.0], [-1.0, 2.0, 3.0]);
        expect("-rx 90", 0, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        expect("-ry 90", 0, [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        expect("-s -2", 0, [1.0, 2.0, 3.0], [-2.0, -4.0, -6.0]);
        expect("-i 3 -t 1 0 0 -i 1 -rz 180", 0, [0.0; 3], [-3.0, 0.0, 0.0]);
    }

    #[test]
    fn arrays_multiply_and_are_bounded() {
        let array = "-t 9 0 0 -a 3 -t 1 0 0 -a 2 -t 0 1 0 -i 1 -s 2";
        let all = Transforms::parse(&words(array)).unwrap().transforms;
        assert_eq!(all.copies(), 6);
        expect(array, 0, [0.0; 3], [18.0, 0.0, 0.0]);
        expect(array, 3, [0.0; 3], [20.0, 2.0, 0.0]);
        expect(array, 5, [0.0; 3], [22.0, 2.0, 0.0]);
        assert_eq!(all.copy(5).unwrap().suffix, ".2.1");
        let refusal = |options: &str| Transforms::parse(&words(options)).err().expect("a refusal");
        assert!(refusal("-a 1000 -a 1000 -a 1000").contains("more than 1000000 copies"));
        assert!(refusal("-a 4000000000 -a 4000000000 -a 4000000000").contains("copies"));
        assert!(refusal("-a 0").contains("from 1"));
        assert!(refusal("-a").contains("lacks an argument"));
        assert!(refusal("-q 1").contains("option -q"));
        let beyond = Transforms::parse(&words("-i 1000000 -t 1e10 0 0")).unwrap();
        assert!(beyond.transforms.copy(0).is_none());
        let xform = Xform::parse(&words("-n a -m b -I -t 1 2 3 x.rad y.rad")).unwrap();
        assert_eq!((xform.name.as_deref(), xform.modifier.as_deref()), (Some("a"), Some("b")));
        assert!(xform.is_inverted && xform.files == ["x.rad", "y.rad"]);
        assert!(refusal(&"-a 1 ".repeat(50_000)).contains("more than 64 arrays"));
        assert!(refusal(&"-mx ".repeat(200_000)).contains("more than 100000 options"));
        let shared = format!("-a 9 -t 1 0 0 {}", "-i 1 -t 0 1 0 ".repeat(9000));
        let shared = Transforms::parse(&words(&shared)).unwrap().transforms;
        assert_eq!(shared.steps(), 3);
        let frame = shared.copy(2).unwrap().frame;
        assert_eq!(frame.shift, DVec3::new(2.0, 9000.0, 0.0));
    }

    /// As `xform` of Radiance 6.1 prints it.
    #[test]
    fn options_that_are_given_twice() {
        let xform = Xform::parse(&words("-m a -m b -I -I -n a -n b x.rad")).unwrap();
        assert_eq!(xform.modifier.as_deref(), Some("a"));
        assert_eq!(xform.name.as_deref(), Some("a.b"));
        assert!(!xform.is_inverted);
    }
}
