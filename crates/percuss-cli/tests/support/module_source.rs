//! A source file as its reader sees it: where it stands, and the modules open there.

use std::path::Path;

use super::rust_tokens::{Piece, Token};

/// The tokens of one file, where the reader stands in it, and the modules open there.
pub struct Source<'a> {
    pub file: &'a Path,
    pub tokens: Vec<Token>,
    pub at: usize,
    pub module: Vec<String>,
    /// For every open brace, whether it is that of a module.
    pub braces: Vec<bool>,
}

impl Source<'_> {
    pub fn token(&self, ahead: usize) -> Option<&Token> {
        self.tokens.get(self.at + ahead)
    }

    pub fn before(&self, back: usize) -> Option<&Token> {
        self.tokens.get(self.at.checked_sub(back)?)
    }

    pub fn name(&self, ahead: usize) -> Option<&str> {
        match &self.token(ahead)?.piece {
            Piece::Name(name) => Some(name),
            _ => None,
        }
    }

    pub fn is(&self, ahead: usize, mark: char) -> bool {
        self.token(ahead).is_some_and(|token| token.is(mark))
    }

    pub fn separates(&self, ahead: usize) -> bool {
        let token = self.token(ahead);
        token.is_some_and(|token| token.piece == Piece::PathSeparator)
    }

    /// Moves behind the bracket that closes the one that the reader stands at.
    pub fn skip_brackets(&mut self) {
        let mut depth = 0;
        while let Some(token) = self.token(0) {
            depth += i32::from("([{".chars().any(|mark| token.is(mark)));
            depth -= i32::from(")]}".chars().any(|mark| token.is(mark)));
            self.at += 1;
            if depth == 0 {
                return;
            }
        }
    }

    /// Reads the attribute that the reader stands at; returns the names in it.
    pub fn attribute(&mut self) -> Vec<String> {
        let start = self.at;
        self.at += 1 + usize::from(self.is(1, '!'));
        self.skip_brackets();
        let names = self.tokens[start..self.at].iter();
        let names = names.filter_map(|token| match &token.piece {
            Piece::Name(name) => Some(name.clone()),
            _ => None,
        });
        names.collect()
    }

    /// Moves behind an item, field or arm, with its other attributes.
    pub fn skip_item(&mut self) {
        while self.is(0, '#') {
            self.attribute();
        }
        let mut until_semicolon = false;
        let mut until_comma = true;
        while let Some(token) = self.token(0) {
            if let Piece::Name(name) = &token.piece {
                let fields = ["fn", "mod", "struct", "enum", "impl", "trait", "union"];
                until_comma &= !fields.contains(&name.as_str());
                until_semicolon |= ["use", "static", "type", "let"].contains(&name.as_str());
            }
            if token.is('{') {
                self.skip_brackets();
                if !until_semicolon {
                    return;
                }
            } else if token.is('(') || token.is('[') {
                self.skip_brackets();
            } else if token.is('}') {
                return;
            } else {
                let ends = token.is(';') || (until_comma && token.is(','));
                self.at += 1;
                if ends {
                    return;
                }
            }
        }
    }
}

/// Reads a tree of `use`: its leaves with the name that each has here and its line.
pub fn read_tree(
    source: &mut Source<'_>,
    above: &[String],
    mut line: usize,
    leaves: &mut Vec<(Vec<String>, String, usize)>,
) {
    let mut segments = above.to_vec();
    let mut name = String::new();
    while let Some(token) = source.token(0).cloned() {
        if token.is(';') && above.is_empty() {
            source.at += 1;
            break;
        }
        if token.is(',') || token.is('}') {
            break;
        }
        source.at += 1;
        match &token.piece {
            Piece::Name(word) if word == "as" => {
                name = source.name(0).unwrap_or("_").to_owned();
                source.at += 1;
            }
            Piece::Name(word) => {
                line = token.line;
                // `{self, …}` names the module above.
                if word != "self" || segments.is_empty() {
                    segments.push(word.clone());
                }
                name = segments.last().cloned().unwrap_or_default();
            }
            Piece::Mark('*') => {
                segments.push("*".to_owned());
                name = "*".to_owned();
            }
            Piece::Mark('{') => {
                while !source.is(0, '}') && source.token(0).is_some() {
                    read_tree(source, &segments, line, leaves);
                    source.at += usize::from(source.is(0, ','));
                }
                source.at += 1;
                name.clear();
                segments.clear();
            }
            _ => {}
        }
    }
    if !segments.is_empty() && !name.is_empty() {
        leaves.push((segments, name, line));
    }
}
