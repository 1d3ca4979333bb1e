//! Page of all materials: a table with their numbers.

use axum::response::Response;
use percuss::{
    material::{Library, Material, MaterialEntry, MaterialGroup},
    units::significant,
};
use percuss_report::escape_html;

use crate::{assets, constants::quantity, http};

/// Digits of the numbers of the table.
const DIGITS: usize = 3;

/// `GET /materials`.
pub(crate) async fn get() -> Response {
    http::page(page(Library::built_in()))
}

/// The page with a row for each material; the records of a family stand together.
fn page(library: &Library) -> String {
    let mut entries: Vec<&MaterialEntry> = library.iter().collect();
    // Materials without a group come last.
    let place = |entry: &MaterialEntry| (entry.material.group.is_none(), entry.material.group);
    entries.sort_by_key(|entry| (place(entry), family(entry), &entry.id));
    let groups = MaterialGroup::ALL.into_iter();
    let groups = groups.filter(|group| entries.iter().any(|e| e.material.group == Some(*group)));
    let options = groups.map(|group| {
        let words = escape_html(group.describe());
        format!("<option value=\"{}\">{words}</option>", group.key())
    });
    assets::template("materials.html")
        .replace("<!--groups-->", &options.collect::<String>())
        .replace(
            "<!--rows-->",
            &entries.into_iter().map(row).collect::<String>(),
        )
}

/// The family of a material; one without is a family of its own.
fn family(entry: &MaterialEntry) -> &str {
    entry.material.family.as_deref().unwrap_or(&entry.id)
}

fn row(entry: &MaterialEntry) -> String {
    let material = &entry.material;
    let star = if material.recommended { " ★" } else { "" };
    let group = material.group.map_or("", MaterialGroup::key);
    let id = escape_html(&entry.id);
    let words = [
        format!(
            "<a href=\"/materials/{id}\">{}</a>{star}",
            escape_html(&material.name)
        ),
        format!("<code>{id}</code>{}", other_names(entry)),
        group.replace('_', " "),
    ];
    let hardness = material.brinell_hardness;
    let yields = material.strength.law().initial_yield_stress(material);
    let numbers = [
        Some(material.density.si()),
        Some(material.youngs_modulus.si() * 1e-9),
        hardness,
        yields.map(|stress| stress * 1e-6),
    ];
    let more = [
        escape_html(&law(material)),
        escape_html(material.state.as_deref().unwrap_or_default()),
        material.trust.letter().to_owned(),
    ];
    let cell = |text: &String| format!("<td>{text}</td>");
    let number = |value: &Option<f64>| match value {
        // Four digits tell densities apart.
        Some(value) if *value >= 1000.0 => format!("<td class=\"number\">{value:.0}</td>"),
        Some(value) => format!("<td class=\"number\">{}</td>", significant(*value, DIGITS)),
        None => "<td class=\"number\">–</td>".to_owned(),
    };
    format!(
        "<tr data-words=\"{}\" data-group=\"{group}\" data-hardness=\"{}\">{}{}{}</tr>\n",
        escape_html(&entry.search_text()),
        hardness.map_or_else(String::new, |hardness| hardness.to_string()),
        words.iter().map(cell).collect::<String>(),
        numbers.iter().map(number).collect::<String>(),
        more.iter().map(cell).collect::<String>(),
    )
}

/// Family and aliases, by which a case may name the material too; only the recommended record has the name of the family.
fn other_names(entry: &MaterialEntry) -> String {
    let material = &entry.material;
    let family = material.family.iter().filter(|_| material.recommended);
    let names: Vec<String> = family
        .chain(&material.aliases)
        .map(|name| escape_html(name))
        .collect();
    match names.is_empty() {
        true => String::new(),
        false => format!(" <span class=\"soft\">{}</span>", names.join(", ")),
    }
}

/// The strength law with its constants in one line, as `power law: σ₀ 450 MPa, n 0.1`.
fn law(material: &Material) -> String {
    let name = material.strength.key().replace('_', " ");
    let constants: Vec<String> = material
        .strength
        .law()
        .parameters()
        .into_iter()
        .map(|(symbol, value)| {
            // The key in a file follows the symbol in parentheses.
            let symbol = symbol.split(" (").next().unwrap_or(symbol);
            format!("{symbol} {}", short(&value))
        })
        .collect();
    match constants.is_empty() {
        true => name,
        false => format!("{name}: {}", constants.join(", ")),
    }
}

/// A number, with or without a unit, to a few digits.
fn short(value: &str) -> String {
    let (number, unit) = quantity(value).unwrap_or((f64::NAN, ""));
    match value.parse().unwrap_or(number) {
        number if number.is_finite() => format!("{} {unit}", significant(number, DIGITS))
            .trim_end()
            .to_owned(),
        _ => value.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_material_has_a_row_with_its_numbers() {
        let library = Library::built_in();
        let page = page(library);
        assert_eq!(
            page.matches("<tr data-words").count(),
            library.iter().count()
        );
        let at = page.find("href=\"/materials/rha-class-1-plate\"").unwrap();
        let start = page[..at].rfind("<tr").unwrap();
        let row = &page[start..at + page[at..].find("</tr>").unwrap()];
        let entry = library.find("rha-class-1-plate").unwrap();
        let hardness = entry.material.brinell_hardness.unwrap();
        for part in [
            format!("data-hardness=\"{hardness}\""),
            format!(">{:.0}</td>", entry.material.density.si()),
            format!("<td>{}</td>", entry.material.trust.letter()),
        ] {
            assert!(row.contains(&part), "{part}: {row}");
        }
    }

    #[test]
    fn a_law_is_one_line_with_units() {
        let copper = &Library::built_in()
            .find("copper-woodward")
            .unwrap()
            .material;
        let line = law(copper);
        assert!(
            line.starts_with("power law: σ₀ ") && line.contains(" MPa, n "),
            "{line}"
        );
        for (value, shown) in [
            ("2.94827 GPa", "2.95 GPa"),
            ("0.09342", "0.0934"),
            ("true", "true"),
        ] {
            assert_eq!(short(value), shown);
        }
    }
}
