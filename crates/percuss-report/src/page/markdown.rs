//! A page as Markdown.

use super::{Block, typeset};
use crate::{figure::IN_PAGES, table::Table};

/// The page as Markdown.
pub fn render(page: &[Block<'_>]) -> String {
    let parts: Vec<String> = page.iter().filter_map(block).collect();
    parts.join("\n\n") + "\n"
}

fn block(block: &Block<'_>) -> Option<String> {
    Some(match block {
        Block::Title(text) => format!("# {}", escape(text)),
        Block::Heading(text) => format!("## {}", escape(text)),
        Block::Subheading(text) => format!("### {}", escape(text)),
        Block::Text(text) => escape(text),
        Block::List(items) => {
            let items: Vec<String> = items
                .iter()
                .map(|item| format!("- {}", escape(item)))
                .collect();
            items.join("\n")
        }
        Block::Table(table) => self::table(table),
        Block::Figure(figure) => format!(
            "![{0}]({1}.{IN_PAGES})\n\n*{0}*",
            escape(&figure.title),
            figure.name
        ),
        Block::Folded(summary, blocks) => format!(
            "<details>\n<summary>{}</summary>\n\n{}\n</details>",
            super::html::escape(summary),
            render(blocks)
        ),
        Block::WebOnly(_) => return None,
    })
}

fn table(table: &Table) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let columns = &table.columns;
    let mut text = row(columns
        .iter()
        .map(|column| escape(&column.title()))
        .collect());
    text += "|";
    for column in columns {
        text += if column.numbers { "---:|" } else { "---|" };
    }
    text.push('\n');
    for index in 0..table.len() {
        let cells = table.row(index).zip(columns);
        text += &row(cells
            .map(|(cell, column)| escape(&typeset(cell, column.numbers)))
            .collect());
    }
    text.trim_end().to_owned()
}

/// Text that Markdown shows as it stands.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    let mut last = ' ';
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        let inside_word =
            last.is_alphanumeric() && chars.peek().is_some_and(|next| next.is_alphanumeric());
        match c {
            '_' if inside_word => escaped.push(c),
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '~' | '$' => escaped.extend(['\\', c]),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '&' => escaped.push_str("&amp;"),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
        last = c;
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_text_becomes_markup() {
        assert_eq!(
            escape("a|b *c* <d> ballistic_limit _e"),
            r"a\|b \*c\* &lt;d&gt; ballistic_limit \_e"
        );
        let page = [Block::Table(
            Table::of(&[()])
                .words("a", |()| "x|y")
                .numbers("n\nof it", "mm", |()| "-1\n2")
                .table(),
        )];
        assert_eq!(
            render(&page),
            "| a | n of it \\[mm\\] |\n|---|---:|\n| x\\|y | \u{2212}1 2 |\n"
        );
    }
}
