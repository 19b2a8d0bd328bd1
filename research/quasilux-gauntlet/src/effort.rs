//! How much is done: the options of the command.

use crate::families;
use crate::references::{self, RoomReferences};
use quasilux_transport::EstimatorKind;
use std::path::PathBuf;

/// What the command prints for `--help`.
pub const HELP: &str = "\
Hard rooms at random against a reference that shares no code with quasilux.

--rooms N            so many rooms, one of each family after the other (60)
--family NAME        only families whose names contain this; may be given several times
--number N           in each family only the room of this number
--seeds N            runs of each room and estimator (8)
--first-seed N       the seed of the first of them (1)
--limits A,B,..      looks at one run, in s (1,3,10,30)
--estimator NAME     may be given several times (bidirectional)
--rel-tol SHARE      half-width over value that runs go for (0.03)
--reference-seconds S   time for the references of one room; 0 computes none (120)
--out FOLDER         runs and references are kept there, and a run that is there is not repeated
                     (target/gauntlet)
--quick              rooms whose references are shipped, one seed, 1 s: what CI runs
--references-only    compute references, run nothing
--list               the families and what their references rely on
--write              write the project files of the rooms to the folder, run nothing
";

/// What is done.
#[derive(Clone, Debug, PartialEq)]
pub struct Effort {
    /// How many rooms.
    pub rooms: u64,
    /// Parts of names of families; all of them where it is empty.
    pub families: Vec<String>,
    /// The number of the rooms in their families, where there is to be one alone.
    pub number: Option<u64>,
    /// Runs of each room and estimator.
    pub seeds: u64,
    /// The first seed.
    pub first_seed: u64,
    /// Rising, in s.
    pub limits_s: Vec<f64>,
    /// How light is estimated.
    pub estimators: Vec<EstimatorKind>,
    /// Half-width over value that runs go for.
    pub rel_tol: f64,
    /// Time for the references of a room.
    pub reference_seconds: f64,
    /// Where results are kept.
    pub out: PathBuf,
    /// Whether only rooms are taken whose references are shipped.
    pub is_quick: bool,
    /// Which part of the work is done.
    pub part: Part,
}

/// Which part of the work is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of it.
    All,
    /// References alone.
    References,
    /// The list of families is printed.
    List,
    /// Project files of rooms are written.
    Write,
    /// The help is printed.
    Help,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            rooms: 60,
            families: Vec::new(),
            number: None,
            seeds: 8,
            first_seed: 1,
            limits_s: vec![1.0, 3.0, 10.0, 30.0],
            estimators: Vec::new(),
            rel_tol: 0.03,
            reference_seconds: 120.0,
            out: PathBuf::from("target/gauntlet"),
            is_quick: false,
            part: Part::All,
        }
    }
}

impl Effort {
    /// Reads the options.
    ///
    /// # Errors
    /// When they cannot be made sense of.
    pub fn parse(arguments: &[String]) -> Result<Self, String> {
        let mut effort = Self::default();
        let mut rest = arguments.iter();
        while let Some(option) = rest.next() {
            let is_alone = effort.take_switch(option);
            if !is_alone {
                let value = rest.next().ok_or_else(|| format!("{option} needs a value"))?;
                effort.take(option, value)?;
            }
        }
        if effort.estimators.is_empty() {
            effort.estimators.push(EstimatorKind::Bidirectional);
        }
        let known = |part: &String| families::ALL.iter().any(|it| it.name.contains(part.as_str()));
        match effort.families.iter().find(|part| !known(part)) {
            Some(part) => Err(format!("no family's name contains {part:?}; --list names them")),
            None => Ok(effort),
        }
    }

    fn take_switch(&mut self, option: &str) -> bool {
        match option {
            "--quick" => {
                (self.seeds, self.limits_s, self.reference_seconds) = (1, vec![1.0], 0.0);
                self.is_quick = true;
            }
            "--references-only" => self.part = Part::References,
            "--list" => self.part = Part::List,
            "--write" => self.part = Part::Write,
            "--help" | "-h" => self.part = Part::Help,
            _ => return false,
        }
        true
    }

    fn take(&mut self, option: &str, value: &str) -> Result<(), String> {
        let wrong = |expected: &str| format!("{option} {value}: expected {expected}");
        let whole = || value.parse::<u64>().map_err(|_| wrong("a whole number"));
        let number = |text: &str, is: fn(f64) -> bool, expected: &str| {
            text.parse::<f64>().ok().filter(|&it| is(it)).ok_or_else(|| wrong(expected))
        };
        match option {
            "--rooms" => self.rooms = whole()?,
            "--number" => self.number = Some(whole()?),
            "--seeds" => self.seeds = whole()?,
            "--first-seed" => self.first_seed = whole()?,
            "--family" => self.families.push(value.to_owned()),
            "--limits" => {
                let expected = "rising seconds above 0, with commas";
                let limits = value.split(',').map(|one| number(one, |s| s > 0.0, expected));
                self.limits_s = limits.collect::<Result<_, _>>()?;
                if !self.limits_s.is_sorted_by(|a, b| a < b) {
                    return Err(wrong(expected));
                }
            }
            "--estimator" => {
                let known = EstimatorKind::ALL.into_iter().find(|it| it.name() == value);
                let names = EstimatorKind::ALL.map(EstimatorKind::name).join(", ");
                self.estimators.push(known.ok_or_else(|| wrong(&names))?);
            }
            "--rel-tol" => {
                self.rel_tol = number(value, |x| x > 0.0 && x < 1.0, "a share within 0 to 1")?;
            }
            "--reference-seconds" => {
                self.reference_seconds = number(value, |x| x >= 0.0, "seconds, 0 or more")?;
            }
            "--out" => self.out = PathBuf::from(value),
            _ => return Err(format!("no option {option}\n\n{HELP}")),
        }
        Ok(())
    }

    /// The families and the numbers of the rooms.
    #[must_use]
    pub fn names(&self) -> Vec<RoomName> {
        let is_wanted = |name: &str| {
            self.families.is_empty() || self.families.iter().any(|part| name.contains(part))
        };
        let families = families::ALL.iter().map(|family| family.name).filter(|it| is_wanted(it));
        let families: Vec<&'static str> = families.collect();
        let name = |index: u64| RoomName {
            family: families[(index % families.len() as u64) as usize],
            number: index / families.len() as u64,
        };
        if self.is_quick {
            let known = references::shipped_references().into_iter();
            let name = |known: RoomReferences| {
                let family = families.iter().find(|family| **family == known.family)?;
                Some(RoomName { family, number: known.number })
            };
            return known.filter_map(name).collect();
        }
        match self.number {
            Some(number) => families.iter().map(|family| RoomName { family, number }).collect(),
            None => (0..self.rooms).map(name).collect(),
        }
    }
}

/// Which room.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RoomName {
    /// The name of its family.
    pub family: &'static str,
    /// Its number there.
    pub number: u64,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Effort, String> {
        let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
        Effort::parse(&words)
    }

    #[test]
    fn options_are_read_and_nonsense_is_refused() {
        let effort = parsed("--rooms 3 --seeds 2 --limits 1,3 --estimator path --rel-tol 0.01");
        let effort = effort.unwrap();
        assert_eq!((effort.rooms, effort.seeds, effort.rel_tol), (3, 2, 0.01));
        assert_eq!(
            (effort.limits_s, effort.estimators),
            (vec![1.0, 3.0], vec![EstimatorKind::Path])
        );
        assert_eq!(parsed("").unwrap().estimators, [EstimatorKind::Bidirectional]);
        for wrong in [
            "--rooms",
            "--rooms x",
            "--limits 3,1",
            "--limits 0",
            "--estimator paths",
            "--family nowhere",
            "--no-option 3",
            "--rel-tol 0",
        ] {
            assert!(parsed(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn rooms_are_one_of_each_family_after_the_other() {
        let count = families::ALL.len() as u64;
        let names = Effort { rooms: count + 1, ..Effort::default() }.names();
        assert_eq!((names[0].number, names[count as usize].number), (0, 1));
        assert_eq!(names[0].family, names[count as usize].family);
        let corridors = parsed("--family corridor --rooms 9").unwrap().names();
        assert!(corridors.iter().all(|name| name.family.contains("corridor")));
        let one = parsed("--family corridor --number 7").unwrap().names();
        assert!(one.iter().all(|name| name.number == 7));
    }
}
