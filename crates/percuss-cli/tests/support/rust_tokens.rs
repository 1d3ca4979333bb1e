//! Tokens of Rust source text with their lines: names, paths and brackets, without comments.

/// A piece of source text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Piece {
    /// An identifier or keyword; `r#` is left out.
    Name(String),
    /// `::`.
    PathSeparator,
    /// Any other single character.
    Mark(char),
    /// A string; attributes may hold paths in one.
    Text(String),
    /// A character, number or lifetime.
    Literal,
}

/// A piece and the line that it starts on, counted from 1.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Token {
    pub piece: Piece,
    pub line: usize,
}

impl Token {
    pub fn is_name(&self, name: &str) -> bool {
        matches!(&self.piece, Piece::Name(found) if found == name)
    }

    pub fn is(&self, mark: char) -> bool {
        self.piece == Piece::Mark(mark)
    }
}

/// Splits source text into tokens.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut reader = Reader {
        characters: text.chars().collect(),
        at: 0,
        line: 1,
    };
    let mut found = Vec::new();
    while let Some(token) = reader.next_token() {
        found.push(token);
    }
    found
}

struct Reader {
    characters: Vec<char>,
    at: usize,
    line: usize,
}

impl Reader {
    fn peek(&self, ahead: usize) -> Option<char> {
        self.characters.get(self.at + ahead).copied()
    }

    fn advance(&mut self) -> Option<char> {
        let character = self.peek(0)?;
        self.at += 1;
        self.line += usize::from(character == '\n');
        Some(character)
    }

    fn starts_with(&self, text: &str) -> bool {
        let mut characters = text.chars().enumerate();
        characters.all(|(ahead, character)| self.peek(ahead) == Some(character))
    }

    fn next_token(&mut self) -> Option<Token> {
        self.skip_blanks_and_comments();
        let line = self.line;
        let first = self.peek(0)?;
        let piece = if self.starts_with("::") {
            self.at += 2;
            Piece::PathSeparator
        } else if first == '"' || self.string_prefix() > 0 {
            Piece::Text(self.read_string())
        } else if first == '\'' {
            self.read_character_or_lifetime();
            Piece::Literal
        } else if first.is_ascii_digit() {
            self.read_word();
            Piece::Literal
        } else if is_word(first) {
            Piece::Name(self.read_word())
        } else {
            self.advance();
            Piece::Mark(first)
        };
        Some(Token { piece, line })
    }

    fn skip_blanks_and_comments(&mut self) {
        loop {
            if self.starts_with("//") {
                while self.peek(0).is_some_and(|next| next != '\n') {
                    self.advance();
                }
            } else if self.starts_with("/*") {
                self.skip_block_comment();
            } else if self.peek(0).is_some_and(char::is_whitespace) {
                self.advance();
            } else {
                return;
            }
        }
    }

    /// Block comments nest.
    fn skip_block_comment(&mut self) {
        let mut depth = 0;
        loop {
            if self.starts_with("/*") {
                depth += 1;
                self.at += 2;
            } else if self.starts_with("*/") {
                depth -= 1;
                self.at += 2;
                if depth == 0 {
                    return;
                }
            } else if self.advance().is_none() {
                return;
            }
        }
    }

    /// Length of what stands before the quotation mark or the hashes of a string with a prefix, 0 where there is no such string.
    fn string_prefix(&self) -> usize {
        for prefix in ["br", "cr", "r", "b", "c"] {
            if !self.starts_with(prefix) {
                continue;
            }
            let length = prefix.len();
            let hashes = (0..).take_while(|hash| self.peek(length + hash) == Some('#'));
            let hashes = if prefix.ends_with('r') {
                hashes.count()
            } else {
                0
            };
            if self.peek(length + hashes) == Some('"') {
                return length;
            }
        }
        0
    }

    /// Content of a string as it is written, escapes included.
    fn read_string(&mut self) -> String {
        let prefix = self.string_prefix();
        let raw = (0..prefix).any(|ahead| self.peek(ahead) == Some('r'));
        self.at += prefix;
        let mut hashes = 0;
        while self.peek(0) == Some('#') {
            hashes += 1;
            self.at += 1;
        }
        self.at += 1;
        let end = format!("\"{}", "#".repeat(hashes));
        let start = self.at;
        while self.peek(0).is_some() && !self.starts_with(&end) {
            if !raw && self.peek(0) == Some('\\') {
                self.advance();
            }
            self.advance();
        }
        let content = self.characters[start..self.at].iter().collect();
        self.at += end.len();
        content
    }

    /// `'x'` and `'\n'` are characters, `'x` without a closing mark is a lifetime.
    fn read_character_or_lifetime(&mut self) {
        self.at += 1;
        if self.peek(0) == Some('\\') {
            self.at += 2;
            while self.advance().is_some_and(|next| next != '\'') {}
        } else if self.peek(1) == Some('\'') {
            self.advance();
            self.at += 1;
        } else {
            self.read_word();
        }
    }

    fn read_word(&mut self) -> String {
        if self.starts_with("r#") {
            self.at += 2;
        }
        let mut word = String::new();
        while let Some(next) = self.peek(0).filter(|next| is_word(*next)) {
            word.push(next);
            self.at += 1;
        }
        word
    }
}

fn is_word(character: char) -> bool {
    character == '_' || character.is_alphanumeric()
}
