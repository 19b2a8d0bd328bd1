//! Tuples of unlike types in the signature of a function: a named struct would say which is which.

use proc_macro2::Span;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{ParenthesizedGenericArguments, ReturnType, Signature, TypeFnPtr, TypeTuple};

/// The tuples of unlike types in arguments, bounds and result, at any depth, as written. What a
/// closure takes and returns is left out, and so are tuples of one type, such as `(f64, f64)`.
pub(super) fn in_signature(signature: &Signature) -> Vec<String> {
    let mut collector = Collector { found: Vec::new() };
    collector.visit_generics(&signature.generics);
    signature.inputs.iter().for_each(|argument| collector.visit_fn_arg(argument));
    if let ReturnType::Type(_, result) = &signature.output {
        collector.visit_type(result);
    }
    collector.found
}

struct Collector {
    found: Vec<String>,
}

impl<'ast> Visit<'ast> for Collector {
    fn visit_type_tuple(&mut self, tuple: &'ast TypeTuple) {
        let parts: Vec<String> = tuple.elems.iter().map(|part| written(part.span())).collect();
        if parts.windows(2).any(|pair| pair[0] != pair[1]) {
            self.found.push(format!("({})", parts.join(", ")));
        }
        visit::visit_type_tuple(self, tuple);
    }

    fn visit_parenthesized_generic_arguments(&mut self, _: &'ast ParenthesizedGenericArguments) {}

    fn visit_type_fn_ptr(&mut self, _: &'ast TypeFnPtr) {}
}

/// A type as written, with single spaces.
fn written(span: Span) -> String {
    span.source_text().unwrap_or_default().split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use crate::style::functions::of_text;

    fn tuples(text: &str) -> Vec<String> {
        of_text(text).into_iter().flat_map(|function| function.tuples).collect()
    }

    #[test]
    fn unlike_types_are_rejected_wherever_they_hide() {
        for text in [
            "fn f() -> (f64, u8) {}",
            "fn f(x: (f64, u8)) {}",
            "fn f(x: &[(f64, u8)]) {}",
            "fn f() -> Option<(f64, u8)> {}",
            "fn f() -> Result<Vec<(f64, u8)>, String> {}",
            "fn f() -> impl Iterator<Item = (f64, u8)> {}",
            "fn f<I: Iterator<Item = (f64, u8)>>(x: I) {}",
            "fn f<I>(x: I) where I: Iterator<Item = (f64, u8)> {}",
            "fn f() -> [(f64, u8); 2] {}",
            "impl A { fn f(&self) -> (f64, u8) {} }",
            "trait A { fn f(&self) -> (f64, u8); }",
            "fn f() -> ((f64, u8), (f64, u8)) {}",
        ] {
            let found = tuples(text);
            assert!(!found.is_empty(), "{text}");
            assert!(found.iter().all(|tuple| tuple == "(f64, u8)"), "{text}: {found:?}");
        }
        assert_eq!(tuples("fn f(a: (A, B)) -> (B, A) {}"), ["(A, B)", "(B, A)"]);
    }

    #[test]
    fn like_types_closures_and_bodies_are_allowed() {
        for text in [
            "fn f() -> (f64, f64) {}",
            "fn f() {}",
            "fn f(x: (f64,)) -> () {}",
            "fn f(x: impl Fn((f64, u8)) -> (f64, u8)) {}",
            "fn f(x: &dyn Fn(f64, u8), y: fn((f64, u8)) -> (f64, u8)) {}",
            "fn f() { let x: (f64, u8) = (0.0, 1); }",
            "#[cfg(test)]\nfn f() -> (f64, u8) {}",
        ] {
            assert_eq!(tuples(text), [""; 0], "{text}");
        }
    }
}
