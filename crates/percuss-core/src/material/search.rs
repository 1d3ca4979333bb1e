//! Search of the material library, and suggestions for a name that it does not have.

use super::{Library, MaterialEntry, MaterialGroup, reason_not_modelled};
use crate::error::nearest;

/// Other words for what the library has: spellings, symbols of elements, and common abbreviations.
const SYNONYMS: &[(&str, &str)] = &[
    ("al", "aluminium"),
    ("alu", "aluminium"),
    ("aluminum", "aluminium"),
    ("armor", "armour"),
];
/// Families that a suggestion names at most.
const MOST: usize = 8;

/// What a list of materials is narrowed to; everything without one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Filter<'a> {
    /// Words that id, family, group, name, aliases or state hold.
    pub words: &'a str,
    /// Group.
    pub group: Option<MaterialGroup>,
    /// Family of alternative records.
    pub family: Option<&'a str>,
    /// Smallest and largest Brinell hardness [kgf/mm2]; records without one are left out.
    pub brinell: Option<[f64; 2]>,
}

impl Filter<'_> {
    fn holds(&self, entry: &MaterialEntry) -> bool {
        let material = &entry.material;
        let group = self.group.is_none_or(|it| material.group == Some(it));
        let family = self
            .family
            .is_none_or(|it| material.family.as_deref() == Some(it));
        let hard = self.brinell.is_none_or(|[least, most]| {
            let hardness = material.brinell_hardness;
            hardness.is_some_and(|it| (least..=most).contains(&it))
        });
        group && family && hard && self.has_words(entry)
    }

    fn has_words(&self, entry: &MaterialEntry) -> bool {
        let text = text_of(entry);
        let words = self.words.to_lowercase();
        words.split_whitespace().map(synonym).all(|word| {
            // A symbol of one or two letters is a name of its own, not a part of words.
            match word.len() {
                0..=2 => text.split_whitespace().any(|part| part == word),
                _ => text.contains(word),
            }
        })
    }
}

impl Library {
    /// The records whose id, family, group, name, aliases or state hold every word, in the order of their ids. Case does not matter, and
    /// common synonyms are known: `aluminum`, `armor`.
    pub fn search(&self, words: &str) -> Vec<&MaterialEntry> {
        match words.trim().is_empty() {
            true => Vec::new(),
            false => self.filter(&Filter {
                words,
                ..Filter::default()
            }),
        }
    }

    /// The records that a filter leaves, in the order of their ids.
    pub fn filter(&self, filter: &Filter<'_>) -> Vec<&MaterialEntry> {
        self.iter().filter(|entry| filter.holds(entry)).collect()
    }

    /// What is wrong with a name to which no record answers.
    pub fn unknown(&self, name: &str) -> String {
        let name_shown = crate::units::shorten(name);
        match self.with_alias(name).len() {
            0 | 1 => format!("no material is named `{name_shown}`"),
            _ => format!("several materials are named `{name_shown}`"),
        }
    }

    /// What a user may have meant by a name that is no id, no family and no alias, or why there is no such record, in one sentence or two
    /// that end with a space; empty where nothing is near.
    pub fn suggestion(&self, name: &str) -> String {
        if let Some(reason) = reason_not_modelled(name) {
            return format!("{reason}. ");
        }
        let fitting = families(&self.with_alias(name));
        if fitting.len() > 1 {
            let named = listed(&fitting, fitting.len());
            return format!("take one of {named}. ");
        }
        let mut found = self.search(name);
        if found.is_empty() {
            // `steel-4340`: the words of a name in any order.
            found = self.search(&name.replace(['-', '_'], " "));
        }
        let families = families(&found);
        match families.as_slice() {
            [] => self
                .nearest(name)
                .map_or_else(String::new, |near| format!("did you mean `{near}`? ")),
            [one] => format!("did you mean `{one}`? "),
            several => {
                let more = match several.len() > MOST {
                    true => ", …",
                    false => "",
                };
                let kind = synonym(&name.to_lowercase()).to_owned();
                format!("records of {kind}: {}{more}. ", listed(several, MOST))
            }
        }
    }

    /// The id or family nearest to a mistyped name.
    fn nearest(&self, name: &str) -> Option<String> {
        let families = self
            .iter()
            .filter_map(|entry| entry.material.family.as_deref());
        let ids = self.iter().map(|entry| entry.id.as_str());
        nearest(name, families.chain(ids))
    }
}

/// The families of records, each once.
fn families<'a>(entries: &[&'a MaterialEntry]) -> Vec<&'a str> {
    let mut families: Vec<&str> = Vec::new();
    for entry in entries {
        let family = entry.material.family.as_deref().unwrap_or(&entry.id);
        if !families.contains(&family) {
            families.push(family);
        }
    }
    families
}

/// The first names of a list.
fn listed(names: &[&str], most: usize) -> String {
    let named: Vec<String> = names
        .iter()
        .take(most)
        .map(|name| format!("`{name}`"))
        .collect();
    named.join(", ")
}

impl MaterialEntry {
    /// What a search looks at, in lower case: id, family, group, name, aliases and state, and the other words for those in it.
    pub fn search_text(&self) -> String {
        let mut text = text_of(self);
        let others = SYNONYMS.iter().filter(|(_, own)| text.contains(own));
        let others: Vec<&str> = others.map(|(other, _)| *other).collect();
        for other in others {
            text += " ";
            text += other;
        }
        text
    }
}

/// The library's word for a word.
fn synonym(word: &str) -> &str {
    let known = SYNONYMS.iter().find(|(other, _)| *other == word);
    known.map_or(word, |(_, own)| own)
}

/// What a search looks at.
fn text_of(entry: &MaterialEntry) -> String {
    let material = &entry.material;
    let [family, state] = [&material.family, &material.state].map(|text| text.as_deref());
    let aliases = material.aliases.join(" ");
    [
        entry.id.as_str(),
        family.unwrap_or_default(),
        material.group.map_or("", MaterialGroup::key),
        &material.name,
        &aliases,
        state.unwrap_or_default(),
    ]
    .join(" ")
    .to_lowercase()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(words: &str) -> Vec<&'static str> {
        let found = Library::built_in().search(words).into_iter();
        found.map(|entry| entry.id.as_str()).collect()
    }

    #[test]
    fn every_word_has_to_be_found() {
        assert_eq!(ids("aluminium").len(), ids("Aluminum").len());
        assert!(ids("aluminium").len() >= 18, "{:?}", ids("aluminium"));
        assert_eq!(ids("aluminium lesuer 6061"), ["6061-t6-lesuer"]);
        assert_eq!(
            ids("titanium 6al"),
            ["ti-6al-4v-meyer", "ti-6al-4v-static", "ti-6al-4v-steinberg"]
        );
        assert_eq!(
            ids("armor class"),
            ["hha-class-1-plate", "rha-class-1-plate"]
        );
        assert_eq!(ids("pb"), ["lead-steinberg"]);
        assert!(ids("unobtainium").is_empty() && ids("  ").is_empty());
    }

    /// What a page finds that looks for words in the texts.
    #[test]
    fn the_text_of_a_record_has_the_other_words_too() {
        let by_text = |words: &str| -> Vec<&str> {
            let held = |text: &str| {
                words.split_whitespace().all(|word| match word.len() {
                    0..=2 => text.split_whitespace().any(|part| part == word),
                    _ => text.contains(word),
                })
            };
            let library = Library::built_in().iter();
            let found = library.filter(|entry| held(&entry.search_text()));
            found.map(|entry| entry.id.as_str()).collect()
        };
        for words in [
            "aluminum",
            "al",
            "alu 7039",
            "armor class",
            "pb",
            "rha",
            "ti64",
        ] {
            assert!(!ids(words).is_empty(), "{words}");
            assert_eq!(by_text(words), ids(words), "{words}");
        }
    }

    #[test]
    fn group_family_and_hardness_narrow_a_list() {
        let library = Library::built_in();
        let filtered = |filter: Filter<'_>| -> Vec<&str> {
            let found = library.filter(&filter).into_iter();
            found.map(|entry| entry.id.as_str()).collect()
        };
        let everything = Filter::default();
        assert_eq!(filtered(everything).len(), library.iter().count());
        let steel = Filter {
            group: Some(MaterialGroup::Steel),
            ..everything
        };
        assert!(filtered(steel).contains(&"4340-johnson-cook"));
        assert!(!filtered(steel).contains(&"copper-woodward"));
        let hard = Filter {
            brinell: Some([360.0, 370.0]),
            ..steel
        };
        assert_eq!(filtered(hard), ["rha-class-1-plate"]);
        let family = Filter {
            family: Some("ofhc-copper"),
            ..everything
        };
        assert_eq!(
            filtered(family),
            ["ofhc-copper-johnson-cook", "ofhc-copper-steinberg"]
        );
    }

    #[test]
    fn an_alias_leads_to_one_material_or_names_several() {
        let library = Library::built_in();
        for (alias, id) in [
            ("RHA", "rha-class-1-plate"),
            ("rolled homogeneous armour", "rha-class-1-plate"),
            ("304", "304-steinberg"),
            ("mild_steel", "1006-johnson-cook"),
            ("6061", "6061-t6-lesuer"),
            ("OFHC", "ofhc-copper-johnson-cook"),
            ("brass", "cartridge-brass-johnson-cook"),
            ("lead", "lead-steinberg"),
            ("wolfram", "tungsten-steinberg"),
            ("ti64", "ti-6al-4v-steinberg"),
            ("2024-t351", "aluminium-2024-t351-woodward"),
            ("6061-T6", "6061-t6-lesuer"),
            ("Weldox 460 E", "weldox-460-e-borvik"),
            ("304_Steinberg", "304-steinberg"),
        ] {
            let found = library.find(alias).map(|entry| entry.id.as_str());
            assert_eq!(found, Some(id), "{alias}");
        }
        assert!(library.find("5083").is_none());
        let said = library.suggestion("5083");
        assert_eq!(said, "take one of `5083-h112`, `5083-h116`, `5083-h131`. ");
        for several in ["2024", "7075", "armox", "mars", "DU"] {
            assert!(library.with_alias(several).len() > 1, "{several}");
        }
    }

    #[test]
    fn what_cannot_be_modelled_says_why() {
        let said = Library::built_in().suggestion("Dyneema");
        for part in ["isotropic", "percuss limit --tests"] {
            assert!(said.contains(part), "{said}");
        }
    }

    #[test]
    fn a_general_word_suggests_families_and_a_typo_one_name() {
        let library = Library::built_in();
        for (name, parts) in [
            ("steel", &["records of steel: `1006`", "`4340`", ", …"][..]),
            ("aluminum", &["records of aluminium: ", "`6061-t6`"]),
            ("aluminium", &["records of aluminium: ", "`6061-t6`"]),
            ("titanium", &["`ti-6al-4v`", "`titanium-pure`"]),
            ("ofhc-coper", &["did you mean `ofhc-copper`?"]),
        ] {
            let said = library.suggestion(name);
            for part in parts {
                assert!(said.contains(part), "{name}: {said}");
            }
        }
        assert_eq!(library.suggestion("unobtainium"), "");
    }

    /// A synonym leads to records, and none hides a name that the library has.
    #[test]
    fn synonyms_lead_somewhere() {
        for (word, own) in SYNONYMS {
            assert!(!ids(own).is_empty(), "{own}");
            assert!(Library::built_in().find(word).is_none(), "{word}");
        }
    }
}
