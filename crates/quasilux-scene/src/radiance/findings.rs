//! What a model has and a scene cannot have: told once for all places where it is so.

use crate::Warning;

/// Remarks of one file, in the order in which they were first made.
#[derive(Debug, Default)]
pub(crate) struct Findings {
    remarks: Vec<Remark>,
    /// Places of remarks beyond the most.
    untold: usize,
}

#[derive(Debug)]
struct Remark {
    message: String,
    first: String,
    count: usize,
}

/// Most different remarks; a file could have any number.
const MAX_REMARKS: usize = 100;

impl Findings {
    /// Notes something at a place, the path of a key or the name of a thing.
    pub(crate) fn note(&mut self, place: &str, message: impl Into<String>) {
        let message = message.into();
        if let Some(known) = self.remarks.iter_mut().find(|remark| remark.message == message) {
            known.count += 1;
        } else if self.remarks.len() < MAX_REMARKS {
            self.remarks.push(Remark { message, first: place.to_owned(), count: 1 });
        } else {
            self.untold += 1;
        }
    }

    /// The remarks on a file.
    pub(crate) fn into_warnings(self, file: &str) -> impl Iterator<Item = Warning> {
        let warning = |file: String| {
            move |Remark { message, first, count }| {
                let message = match count {
                    1 => format!("{first}: {message}"),
                    _ => format!("{message} ({count} places, for example at {first})"),
                };
                Warning::new(&file, None, message)
            }
        };
        let untold = (self.untold > 0).then(|| {
            let message = format!("other findings at {} more places are not told", self.untold);
            Warning::new(file, None, message)
        });
        self.remarks.into_iter().map(warning(file.to_owned())).chain(untold)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_told_is_counted() {
        let mut findings = Findings::default();
        (0..MAX_REMARKS + 3).for_each(|number| findings.note("here", format!("odd {number}")));
        let told: Vec<String> =
            findings.into_warnings("a.hbjson").map(|it| it.to_string()).collect();
        assert_eq!(told.len(), MAX_REMARKS + 1);
        assert!(told[MAX_REMARKS].contains("other findings at 3 more places"), "{told:?}");
    }
}
