//! The lines of a file that are not compiled for tests alone.

use crate::modules::tests_left_out::{
    attributes_of, attributes_of_member, attributes_of_trait_member, is_test,
};
use std::collections::BTreeSet;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{ImplItem, Item, TraitItem};

/// How many lines a file has in all, and of which kinds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LineCounts {
    /// All lines.
    pub all: usize,
    /// Those outside items that exist in tests alone.
    pub shipped: usize,
    /// Those of them that are neither blank nor a comment.
    pub code: usize,
}

impl LineCounts {
    /// Counts the lines of a Rust file.
    ///
    /// # Errors
    /// When the text is not Rust.
    pub fn new(text: &str) -> Result<Self, String> {
        let file = syn::parse_file(text).map_err(|error| error.to_string())?;
        let mut tests = TestLines::default();
        tests.visit_file(&file);
        let is_code = |line: &str| !line.trim().is_empty() && !line.trim().starts_with("//");
        let mut counts = Self::default();
        for (i, line) in text.lines().enumerate() {
            let is_shipped = !tests.lines.contains(&(i + 1));
            counts.all += 1;
            counts.shipped += usize::from(is_shipped);
            counts.code += usize::from(is_shipped && is_code(line));
        }
        Ok(counts)
    }

    /// The lines of a file that exists in tests alone.
    #[must_use]
    pub fn of_test_file(text: &str) -> Self {
        Self { all: text.lines().count(), ..Self::default() }
    }

    /// Adds the lines of another file.
    pub fn add(&mut self, other: Self) {
        self.all += other.all;
        self.shipped += other.shipped;
        self.code += other.code;
    }
}

#[derive(Default)]
struct TestLines {
    lines: BTreeSet<usize>,
}

impl TestLines {
    fn leave_out(&mut self, item: &impl Spanned) {
        let span = item.span();
        self.lines.extend(span.start().line..=span.end().line);
    }
}

impl<'ast> Visit<'ast> for TestLines {
    fn visit_item(&mut self, item: &'ast Item) {
        if is_test(attributes_of(item)) {
            self.leave_out(item);
        } else {
            visit::visit_item(self, item);
        }
    }

    fn visit_impl_item(&mut self, member: &'ast ImplItem) {
        if is_test(attributes_of_member(member)) {
            self.leave_out(member);
        }
    }

    fn visit_trait_item(&mut self, member: &'ast TraitItem) {
        if is_test(attributes_of_trait_member(member)) {
            self.leave_out(member);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_tests_comments_and_blank_lines_are_told_apart() {
        let text = "//! Head.\n\nfn f() {\n    // why\n    g();\n}\n\n\
                    #[cfg(test)]\nmod tests {\n    fn h() {}\n}\n\
                    impl A {\n    #[cfg(test)]\n    fn i() {}\n}\n";
        let counts = LineCounts::new(text).unwrap();
        assert_eq!(counts, LineCounts { all: 15, shipped: 9, code: 5 });
    }
}
