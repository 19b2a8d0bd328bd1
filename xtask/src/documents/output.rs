//! Whether a program printed what a document says that it prints.

/// What follows differs from run to run: seconds, and threads.
const VARIES: [&str; 2] = [" s on ", " s before it was resumed"];

/// The first line of `shown` that does not come in `printed`, in this order, where every line is
/// looked for behind the one before; numbers of seconds and threads may differ. A document may
/// leave lines out.
pub(super) fn first_missing<'a>(shown: &'a [String], printed: &str) -> Option<&'a str> {
    let mut printed = printed.lines().map(without_time);
    let is_missing = |line: &&String| !printed.any(|other| other == without_time(line));
    shown.iter().find(is_missing).map(String::as_str)
}

/// A line with its seconds and threads taken out, and without blanks at its end.
fn without_time(line: &str) -> String {
    let mut text = line.trim_end().to_owned();
    for mark in VARIES {
        if let Some(at) = text.find(mark) {
            let number = text[..at].rfind(' ').map_or(0, |blank| blank + 1);
            text.replace_range(number..at, "_");
        }
    }
    if let Some(at) = text.find(" s on ") {
        let from = at + " s on ".len();
        let digits = text[from..].find(|c: char| !c.is_ascii_digit()).unwrap_or(0);
        text.replace_range(from..from + digits, "_");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_seconds_and_threads_may_differ() {
        let shown = ["a  1.0 lx".to_owned(), "7 rays, 2.01 s on 2 threads; done".to_owned()];
        let printed = "sensor\na  1.0 lx\n\n7 rays, 12 s on 16 threads; done\nresults in out\n";
        assert_eq!(first_missing(&shown, printed), None);
        let other = printed.replace("1.0 lx", "1.1 lx");
        assert_eq!(first_missing(&shown, &other), Some("a  1.0 lx"));
        let other = printed.replace("7 rays", "8 rays");
        assert_eq!(first_missing(&shown, &other), Some(shown[1].as_str()));
        let turned = [shown[1].clone(), shown[0].clone()];
        assert_eq!(first_missing(&turned, printed), Some("a  1.0 lx"));
    }
}
