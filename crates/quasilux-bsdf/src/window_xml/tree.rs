//! Tensor trees: nodes in braces.

use super::block::Block;
use crate::tokens;
use crate::tokens::Style;
use crate::tokens::Tokens;
use crate::tree::TensorTree;
use crate::tree::TreeBuilder;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::{ParseError, Position, Token, quoted};

/// The tree of one block.
pub(super) fn read(
    block: &Block<'_, '_>,
    rank: usize,
    warnings: &mut Warnings,
) -> Result<TensorTree, ParseError> {
    let basis = block.element.child("AngleBasis");
    let is_known = |text: &str| text.eq_ignore_ascii_case("LBNL/Shirley-Chiu");
    if !basis.is_some_and(|basis| is_known(basis.text())) {
        let at = basis.map_or(block.element.at, |basis| basis.text_at);
        let found = quoted(basis.map_or("", |basis| basis.text()));
        return Err(ParseError::new(at, found, "AngleBasis: LBNL/Shirley-Chiu"));
    }
    let Some(data) = block.element.child("ScatteringData") else {
        let found = "no element ScatteringData";
        return Err(ParseError::new(block.element.at, found, "the tree of the block"));
    };
    let mut parser = Parser {
        tokens: Tokens::new(data.text(), data.text_at, Style::Braces),
        builder: TreeBuilder::new(rank - 2),
        warnings,
    };
    let root = parser.expect("{")?;
    parser.node(0, 0, root)?;
    if let Some(further) = parser.tokens.next() {
        let expected = "the end of the data after the tree (left out)";
        parser.warnings.push(
            WarningKind::TrailingValues,
            further.at,
            quoted(further.text),
            expected,
        );
    }
    parser.builder.finish().ok_or_else(|| too_large(data.text_at))
}

struct Parser<'t, 'w> {
    tokens: Tokens<'t>,
    builder: TreeBuilder,
    warnings: &'w mut Warnings,
}

impl<'t> Parser<'t, '_> {
    /// A node whose opening brace is read: branches, or a grid of values.
    fn node(&mut self, node: usize, level: usize, opened: Position) -> Result<(), ParseError> {
        let first = self.next("a node or a value")?;
        if first.text != "{" {
            return self.grid(node, level, opened, first);
        }
        let too_deep = || too_large(opened);
        let first_child = self.builder.branch(node, level).ok_or_else(too_deep)?;
        let children = 1 << self.builder.axes();
        for child in 0..children {
            let opened = if child == 0 { first.at } else { self.expect("{")? };
            self.node(first_child + child, level + 1, opened)?;
        }
        self.expect("}").map(|_| ())
    }

    /// A grid whose first value is read.
    fn grid(
        &mut self,
        node: usize,
        level: usize,
        opened: Position,
        first: Token<'t>,
    ) -> Result<(), ParseError> {
        let mut values = Vec::new();
        let mut token = first;
        while token.text != "}" {
            values.push(tokens::value(token, self.warnings)?);
            token = self.next("a value or }")?;
        }
        let axes = self.builder.axes();
        let log_side =
            (0..super::super::tree::DEEPEST).find(|log| 1 << (log * axes) == values.len());
        let Some(log_side) = log_side else {
            let expected = format!("1, {}, {} .. values", 1 << axes, 1 << (2 * axes));
            return Err(ParseError::new(opened, format!("a grid of {}", values.len()), expected));
        };
        let grid = self.builder.grid(node, level, &values, log_side);
        grid.ok_or_else(|| too_large(opened))
    }

    fn expect(&mut self, brace: &str) -> Result<Position, ParseError> {
        let expected = match brace {
            "{" => format!("{{, for each of {} nodes", 1 << self.builder.axes()),
            _ => format!("}}, after {} nodes", 1 << self.builder.axes()),
        };
        let token = self.next(&expected)?;
        if token.text != brace {
            return Err(ParseError::new(token.at, quoted(token.text), expected));
        }
        Ok(token.at)
    }

    fn next(&mut self, expected: &str) -> Result<Token<'t>, ParseError> {
        let end = self.tokens.at();
        self.tokens.next().ok_or_else(|| ParseError::new(end, "the end of the data", expected))
    }
}

fn too_large(at: Position) -> ParseError {
    ParseError::new(at, "a deeper node", "a tree of no more than 12 levels and 4e9 nodes")
}
