//! A page as one self-contained HTML file.

use super::{Block, typeset};
use crate::table::Table;

const STYLE: &str = "\
:root{color-scheme:light dark;--ink:#1c2024;--soft:#5b6470;--line:#d8dce1;--stripe:#f5f6f8;--paper:#fff;--link:#0b5cad}\
@media(prefers-color-scheme:dark){:root{--ink:#e6e8eb;--soft:#a2abb6;--line:#3a414a;--stripe:#22272d;--paper:#171a1e;--link:#7ab8f5}}\
*{box-sizing:border-box}\
body{margin:0 auto;padding:1.5rem 1rem 4rem;max-width:74rem;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif}\
h1{font-size:1.7rem;line-height:1.2}h2{margin-top:2.5rem;padding-top:.6rem;border-top:1px solid var(--line)}h3{margin-top:1.8rem}\
p,li{max-width:52rem;overflow-wrap:anywhere}a{color:var(--link)}\
.wide{overflow-x:auto;margin:.8rem 0}\
table{border-collapse:collapse;font-size:.86rem;font-variant-numeric:tabular-nums}\
th,td{padding:.25rem .7rem;text-align:left;vertical-align:top;border-bottom:1px solid var(--line)}\
th{position:sticky;top:0;background:var(--paper);border-bottom:2px solid var(--soft);vertical-align:bottom}\
tbody tr:nth-child(even){background:var(--stripe)}\
.n{text-align:right;white-space:nowrap}\
figure{margin:1rem 0;max-width:860px}figure svg{display:block;width:100%;height:auto;background:#fff;border-radius:6px}\
figcaption{color:var(--soft);font-size:.86rem;margin-top:.3rem}\
summary{cursor:pointer;color:var(--link)}\
@media print{details>*{display:block}}";

/// The page as HTML.
pub fn render(page: &[Block<'_>]) -> String {
    let title = page.iter().find_map(|block| match block {
        Block::Title(title) => Some(escape(title)),
        _ => None,
    });
    let mut writer = Writer::default();
    writer.blocks(page);
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, \
         initial-scale=1\">\n<title>{}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<main>\n{}</main>\n</body>\n</html>\n",
        title.unwrap_or_default(),
        writer.text
    )
}

/// Text as HTML shows it.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\'' => escaped.push_str("&#39;"),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[derive(Default)]
struct Writer {
    text: String,
    figures: usize,
}

impl Writer {
    fn blocks(&mut self, blocks: &[Block<'_>]) {
        for block in blocks {
            self.block(block);
        }
    }

    fn block(&mut self, block: &Block<'_>) {
        match block {
            Block::Title(text) => self.element("h1", text),
            Block::Heading(text) => self.element("h2", text),
            Block::Subheading(text) => self.element("h3", text),
            Block::Text(text) => self.element("p", text),
            Block::List(items) => {
                self.text += "<ul>\n";
                for item in items {
                    self.element("li", item);
                }
                self.text += "</ul>\n";
            }
            Block::Table(table) => self.table(table),
            Block::Figure(figure) => {
                self.figures += 1;
                // Names within one drawing must not meet those of the next one on the page.
                let prefix = format!("f{}-", self.figures);
                let svg = figure
                    .svg
                    .replace(" id=\"", &format!(" id=\"{prefix}"))
                    .replace("url(#", &format!("url(#{prefix}"))
                    .replace("href=\"#", &format!("href=\"#{prefix}"));
                let svg = svg.find("<svg").map_or("", |at| &svg[at..]);
                self.text += &format!(
                    "<figure>\n{svg}\n<figcaption>{}</figcaption>\n</figure>\n",
                    escape(&figure.title)
                );
            }
            Block::Folded(summary, blocks) => {
                self.text += &format!("<details>\n<summary>{}</summary>\n", escape(summary));
                self.blocks(blocks);
                self.text += "</details>\n";
            }
            Block::WebOnly(blocks) => self.blocks(blocks),
        }
    }

    fn element(&mut self, name: &str, text: &str) {
        self.text += &format!("<{name}>{}</{name}>\n", escape(text));
    }

    fn table(&mut self, table: &Table) {
        let class = |number: bool| if number { " class=\"n\"" } else { "" };
        self.text += "<div class=\"wide\" tabindex=\"0\"><table>\n";
        // Pairs of a name and a value have no headings.
        if table
            .columns
            .iter()
            .any(|column| !column.title().is_empty())
        {
            self.text += "<thead><tr>";
            for column in &table.columns {
                let (class, title) = (class(column.numbers), escape(&column.title()));
                self.text += &format!("<th{class}>{title}</th>");
            }
            self.text += "</tr></thead>\n";
        }
        self.text += "<tbody>\n";
        for index in 0..table.len() {
            self.text += "<tr>";
            for (cell, column) in table.row(index).zip(&table.columns) {
                let cell = escape(&typeset(cell, column.numbers));
                self.text += &format!("<td{}>{cell}</td>", class(column.numbers));
            }
            self.text += "</tr>\n";
        }
        self.text += "</tbody>\n</table></div>\n";
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_of_a_text_becomes_markup() {
        let page = [
            Block::Title("<b>".to_owned()),
            Block::Table(
                Table::of(&["<script>alert('x')</script>"])
                    .numbers("a & b", "", |cell| *cell)
                    .table(),
            ),
        ];
        let html = render(&page);
        assert!(!html.contains("<script") && !html.contains("<b>"), "{html}");
        assert!(html.contains("<th class=\"n\">a &amp; b</th>"), "{html}");
        assert!(html.contains("&lt;script&gt;alert(&#39;x&#39;)"), "{html}");
    }
}
