//! Records from the cards of a deck.

use super::{
    Imported, UnitSystem,
    deck::{Deck, Field, Keyword},
    equation_of_state::{self, GruneisenCard},
    johnson_cook::{Card, Found},
};
use crate::{
    check::Check,
    error::Error,
    material::{Material, MaterialTable},
};

/// The two numbers of a part that belong together: of its material and of its equation of state.
type Pair = (f64, f64);

/// Reads all materials of a deck.
pub(super) fn read(deck: &Deck<'_>, units: UnitSystem) -> Result<Imported, Error> {
    let mut imported = Imported::default();
    let (mut found, mut equations, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
    for keyword in &deck.keywords {
        let mut card = Card {
            deck,
            keyword,
            units,
            warnings: Vec::new(),
        };
        match keyword.name_and_title().0 {
            "MAT_JOHNSON_COOK" | "MAT_015" | "MAT_15" => found.push((keyword, card.complete()?)),
            "MAT_SIMPLIFIED_JOHNSON_COOK" | "MAT_098" | "MAT_98" => {
                found.push((keyword, card.simplified()?));
            }
            "EOS_GRUNEISEN" | "EOS_004" | "EOS_4" => {
                let equation =
                    equation_of_state::read(deck, keyword, units, &mut imported.warnings)?;
                equations.push(equation);
            }
            "PART" => pairs.extend(parts(deck, keyword)?),
            name if name.starts_with("MAT_") || name.starts_with("EOS_") => {
                card.warnings.push(format!(
                    "line {}: *{name} is not read",
                    deck.line(&keyword.span)
                ));
            }
            "INCLUDE" => card.warnings.push(format!(
                "line {}: *INCLUDE is not followed: give the file itself",
                deck.line(&keyword.span)
            )),
            _ => {}
        }
        imported.warnings.append(&mut card.warnings);
    }
    if found.is_empty() {
        let message = "the deck has no material that can be read".to_owned();
        let help = "*MAT_JOHNSON_COOK and *MAT_SIMPLIFIED_JOHNSON_COOK are read".to_owned();
        return Err(deck.error(&(0..0), message, help));
    }
    let mut joined = vec![false; equations.len()];
    for (keyword, Found { number, material }) in found {
        let all = equations_of(number, &equations, &pairs);
        if all.len() > 1 {
            imported.warnings.push(format!(
                "line {}: parts join the material {number} with {} equations of state, and the first is taken",
                deck.line(&keyword.span),
                all.len()
            ));
        }
        let first = all.first().copied();
        all.into_iter().for_each(|index| joined[index] = true);
        let material = Material {
            equation_of_state: first.map(|index| equations[index].equation.clone()),
            ..material
        };
        check(deck, keyword, units, &material)?;
        insert(&mut imported.records, number, material);
    }
    for (card, _) in equations.iter().zip(joined).filter(|(_, joined)| !joined) {
        imported.warnings.push(format!(
            "line {}: the equation of state {} is left out: no material that was read has it",
            card.line, card.number
        ));
    }
    Ok(imported)
}

/// Material and equation of state of every part below a keyword: a heading and a card each.
fn parts(deck: &Deck<'_>, keyword: &Keyword<'_>) -> Result<Vec<Pair>, Error> {
    let mut pairs = Vec::new();
    for card in (1..keyword.cards()).step_by(2) {
        let [_, _, material, equation]: [Field; 4] = keyword.card(deck, card)?;
        if let (Some(material), Some(equation)) = (material.value, equation.value) {
            pairs.push((material, equation));
        }
    }
    Ok(pairs)
}

/// Places of the equations of state that parts join with a material; without parts, of that of the same number.
fn equations_of(material: f64, equations: &[GruneisenCard], pairs: &[Pair]) -> Vec<usize> {
    let is_joined = |equation: f64| match pairs.is_empty() {
        true => equation == material,
        false => pairs.contains(&(material, equation)),
    };
    let all = equations.iter().enumerate();
    all.filter(|(_, card)| is_joined(card.number))
        .map(|(index, _)| index)
        .collect()
}

/// Fails where no material has the values.
fn check(
    deck: &Deck<'_>,
    keyword: &Keyword<'_>,
    units: UnitSystem,
    material: &Material,
) -> Result<(), Error> {
    let mut findings = Vec::new();
    material.check(&mut Check::new(&mut findings));
    match findings.into_iter().next() {
        None => Ok(()),
        Some(finding) => {
            let message = format!("`{}`: {}", finding.key, finding.message);
            let help = format!(
                "{} (the deck was read in {}, stresses in {}: is that its unit system?)",
                finding.help, units.name, units.pressure_unit
            );
            Err(deck.error(&keyword.span, message, help))
        }
    }
}

/// Adds a record under an id of its title.
fn insert(records: &mut MaterialTable, number: f64, material: Material) {
    let words = material.name.to_lowercase();
    let words = words.split(|c: char| !c.is_ascii_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    let mut id = words.join("-");
    if id.is_empty() || records.contains_key(&id) {
        id = format!("{id}-{number}").trim_matches('-').to_owned();
    }
    let mut copy = 2;
    let first = id.clone();
    while records.contains_key(&id) {
        id = format!("{first}-{copy}");
        copy += 1;
    }
    records.insert(id, material);
}
