//! Records from the cards of a deck.

use std::collections::{HashMap, HashSet};

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

/// Most kinds of keywords that are named as left out.
const MOST_KINDS: usize = 100;

/// The two numbers of a part that belong together: of its material and of its equation of state.
type Pair = (f64, f64);

/// Reads all materials of a deck.
pub(super) fn read(deck: &Deck<'_>, units: UnitSystem) -> Result<Imported, Error> {
    let mut imported = Imported::default();
    let (mut found, mut equations, mut pairs) = (Vec::new(), Vec::new(), Vec::new());
    let mut unread = Unread::default();
    let mut has_unread_parts = false;
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
            "PART" => pairs.extend(parts(deck, keyword, 2)?),
            "PART_CONTACT" | "PART_PRINT" => pairs.extend(parts(deck, keyword, 3)?),
            name if name.starts_with("PART_") => {
                has_unread_parts = true;
                let why = "is not read: the equations of state of its parts are left out";
                unread.add(name, why, deck.line(&keyword.span));
            }
            name if name.starts_with("MAT_") || name.starts_with("EOS_") => {
                unread.add(name, "is not read", deck.line(&keyword.span));
            }
            name if name == "INCLUDE" || name.starts_with("INCLUDE_") => {
                let why = "is not followed: give the file itself";
                unread.add(name, why, deck.line(&keyword.span));
            }
            _ => {}
        }
        imported.warnings.append(&mut card.warnings);
    }
    imported.warnings.extend(unread.warnings());
    if found.is_empty() {
        let message = "the deck has no material that can be read".to_owned();
        let help = "*MAT_JOHNSON_COOK and *MAT_SIMPLIFIED_JOHNSON_COOK are read".to_owned();
        return Err(deck.error(&(0..0), message, help));
    }
    let has_parts = has_unread_parts || !pairs.is_empty();
    let mut joins = Joins::new(&equations, has_parts.then_some(&pairs));
    let mut ids = Ids::default();
    for (keyword, Found { number, material }) in found {
        let (first, count) = joins.equations_of(number);
        if count > 1 {
            imported.warnings.push(format!(
                "line {}: parts join the material {number} with {count} equations of state, and the first is taken",
                deck.line(&keyword.span),
            ));
        }
        let material = Material {
            equation_of_state: first.map(|index| equations[index].equation.clone()),
            ..material
        };
        check(deck, keyword, units, &material)?;
        let id = ids.of(&imported.records, number, &material);
        imported.records.insert(id, material);
    }
    for card in equations.iter().filter(|card| !joins.has_joined(card)) {
        imported.warnings.push(format!(
            "line {}: the equation of state {} is left out: no material that was read has it",
            card.line, card.number
        ));
    }
    Ok(imported)
}

/// Material and equation of state of every part below a keyword: a heading, a card, and the further cards of an option each.
fn parts(deck: &Deck<'_>, keyword: &Keyword<'_>, each: usize) -> Result<Vec<Pair>, Error> {
    let mut pairs = Vec::new();
    for card in (1..keyword.cards()).step_by(each) {
        let [_, _, material, equation]: [Field; 4] = keyword.card(deck, card)?;
        if let (Some(material), Some(equation)) = (material.value, equation.value) {
            pairs.push((material, equation));
        }
    }
    Ok(pairs)
}

/// Keywords that are left out, a warning for each kind.
#[derive(Default)]
struct Unread<'a>(Vec<LeftOut<'a>>);

/// A kind of keyword that is left out.
struct LeftOut<'a> {
    name: &'a str,
    why: &'static str,
    first_line: usize,
    /// How often it comes after that.
    more: usize,
}

impl<'a> Unread<'a> {
    fn add(&mut self, name: &'a str, why: &'static str, line: usize) {
        let is_full = self.0.len() == MOST_KINDS;
        match self.0.iter_mut().find(|kind| kind.name == name) {
            Some(kind) => kind.more += 1,
            // A deck of ever new keywords is no deck.
            None if is_full => {}
            None => self.0.push(LeftOut {
                name,
                why,
                first_line: line,
                more: 0,
            }),
        }
    }

    fn warnings(self) -> impl Iterator<Item = String> {
        self.0.into_iter().map(|kind| {
            let LeftOut {
                name,
                why,
                first_line,
                more,
            } = kind;
            match more {
                0 => format!("line {first_line}: *{name} {why}"),
                more => format!("line {first_line} and {more} more: *{name} {why}"),
            }
        })
    }
}

/// Equations of state by the materials that they belong to.
struct Joins {
    /// Places of the equations of a number.
    places: HashMap<u64, Vec<usize>>,
    /// Numbers of the equations of a material; `None` in a deck without parts.
    parts: Option<HashMap<u64, HashSet<u64>>>,
    /// Place of the first equation of a material that was asked for, and how many it has.
    known: HashMap<u64, (Option<usize>, usize)>,
    /// Numbers of the equations that a material has.
    joined: HashSet<u64>,
}

impl Joins {
    fn new(equations: &[GruneisenCard], pairs: Option<&Vec<Pair>>) -> Self {
        let mut places: HashMap<u64, Vec<usize>> = HashMap::new();
        for (place, card) in equations.iter().enumerate() {
            places.entry(key(card.number)).or_default().push(place);
        }
        let parts = pairs.map(|pairs| {
            let mut parts: HashMap<u64, HashSet<u64>> = HashMap::new();
            for (material, equation) in pairs {
                let of_material = parts.entry(key(*material)).or_default();
                of_material.insert(key(*equation));
            }
            parts
        });
        Self {
            places,
            parts,
            known: HashMap::new(),
            joined: HashSet::new(),
        }
    }

    /// Place of the first equation of state that parts join with a material, and how many there are; without parts, of those of the same
    /// number.
    fn equations_of(&mut self, material: f64) -> (Option<usize>, usize) {
        let material = key(material);
        if let Some(known) = self.known.get(&material) {
            return *known;
        }
        let numbers: Vec<u64> = match &self.parts {
            None => vec![material],
            Some(parts) => parts
                .get(&material)
                .into_iter()
                .flatten()
                .copied()
                .collect(),
        };
        let places = || numbers.iter().filter_map(|number| self.places.get(number));
        let found = (
            places().filter_map(|all| all.first()).min().copied(),
            places().map(Vec::len).sum(),
        );
        self.joined.extend(numbers);
        self.known.insert(material, found);
        found
    }

    fn has_joined(&self, card: &GruneisenCard) -> bool {
        self.joined.contains(&key(card.number))
    }
}

/// What stands for a number of a card: equal numbers have equal bits, but for the sign of zero.
fn key(number: f64) -> u64 {
    (number + 0.0).to_bits()
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

/// Ids of records by their titles.
#[derive(Default)]
struct Ids(HashMap<String, usize>);

impl Ids {
    /// An id that no record has.
    fn of(&mut self, records: &MaterialTable, number: f64, material: &Material) -> String {
        let words = material.name.to_lowercase();
        let words = words.split(|c: char| !c.is_ascii_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        let mut id = words.join("-");
        if id.is_empty() || records.contains_key(&id) {
            id = format!("{id}-{number}").trim_matches('-').to_owned();
        }
        let first = id.clone();
        let copy = self.0.entry(first.clone()).or_insert(1);
        while records.contains_key(&id) {
            *copy += 1;
            id = format!("{first}-{copy}");
        }
        id
    }
}
