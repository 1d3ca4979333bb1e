//! Formulae of the pages as MathML, which browsers draw without a script or a network.

use math_core::{LatexToMathML, MathDisplay};

/// What begins and ends a formula in a page.
const MARK: &str = "$$";

/// A page with MathML instead of the formulae between `$$`; code blocks stay as they are.
///
/// # Errors
/// The line and the formula that LaTeX would not read, or a formula without an end.
pub(crate) fn with_mathml(page: &str) -> Result<String, String> {
    if !page.contains(MARK) {
        return Ok(page.to_owned());
    }
    let converter = LatexToMathML::new(math_core::MathCoreConfig::default())
        .map_err(|error| format!("{error:?}"))?;
    let mut text = String::new();
    let mut formula: Option<(usize, String)> = None;
    let mut is_code = false;
    for (index, line) in page.split_inclusive('\n').enumerate() {
        is_code ^= line.trim_start().starts_with("```");
        if is_code {
            text += line;
            continue;
        }
        for (part, piece) in line.split(MARK).enumerate() {
            if part > 0 {
                match formula.take() {
                    None => formula = Some((index + 1, String::new())),
                    Some((start, latex)) => text += &mathml(&converter, start, &latex)?,
                }
            }
            match &mut formula {
                Some((_, latex)) => *latex += piece,
                None => text += piece,
            }
        }
    }
    match formula {
        None => Ok(text),
        Some((start, _)) => Err(format!("line {start}: the formula has no end `{MARK}`")),
    }
}

/// A block of HTML, so that nothing in it is read as Markdown.
fn mathml(converter: &LatexToMathML, line: usize, latex: &str) -> Result<String, String> {
    let result = converter
        .convert_with_local_state(latex.trim(), MathDisplay::Block)
        .map_err(|error| format!("line {line}: `{}`: {error}", latex.trim()))?;
    Ok(format!(
        "<div class=\"formula\">{}</div>",
        closed(&result.mathml)
    ))
}

/// The same elements with an end tag for each: HTML outside MathML knows no `<mspace/>`.
fn closed(mathml: &str) -> String {
    let mut text = String::new();
    let mut rest = mathml;
    while let Some((before, after)) = rest.split_once("/>") {
        text += before;
        let name = before.rsplit('<').next().unwrap_or_default();
        let name = name.split_whitespace().next().unwrap_or_default();
        text += &format!("></{name}>");
        rest = after;
    }
    text + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_formula_becomes_mathml_and_code_does_not() {
        let page = "a\n\n$$x_0 = \\tfrac12\\,y,\n z$$\n\n```sh\necho $$\n```\n";
        let text = with_mathml(page).unwrap();
        assert!(text.starts_with("a\n\n<div class=\"formula\"><math display=\"block\">"));
        assert!(text.contains("<mfrac displaystyle=\"false\"><mn>1</mn><mn>2</mn></mfrac>"));
        assert!(
            text.contains("></mspace>") && !text.contains("/>"),
            "{text}"
        );
        assert!(
            text.ends_with("</math></div>\n\n```sh\necho $$\n```\n"),
            "{text}"
        );
    }

    #[test]
    fn a_formula_that_cannot_be_read_is_named_with_its_line() {
        let error = with_mathml("a\n$$ \\nosuch{x} $$\n").unwrap_err();
        assert!(error.starts_with("line 2: `\\nosuch{x}`"), "{error}");
        let error = with_mathml("$$ x\n").unwrap_err();
        assert!(
            error.starts_with("line 1: the formula has no end"),
            "{error}"
        );
    }
}
