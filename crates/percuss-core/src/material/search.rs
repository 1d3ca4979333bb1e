//! Search of the material library, and suggestions for a name that it does not have.

use super::{Library, MaterialEntry};
use crate::error::nearest;

/// Other words for what the library has: spellings, symbols of elements, and common abbreviations.
const SYNONYMS: &[(&str, &str)] = &[
    ("al", "aluminium"),
    ("alu", "aluminium"),
    ("aluminum", "aluminium"),
    ("armor", "steel"),
    ("armour", "steel"),
    ("armox", "steel"),
    ("cu", "copper"),
    ("fe", "iron"),
    ("hha", "steel"),
    ("pb", "lead"),
    ("rha", "steel"),
    ("ta", "tantalum"),
    ("ti", "ti-6al-4v"),
    ("ti64", "ti-6al-4v"),
    ("titanium", "ti-6al-4v"),
    ("w", "tungsten"),
    ("wc", "tungsten-carbide"),
    ("wha", "tungsten-alloy"),
    ("wolfram", "tungsten"),
];
/// Names of armour steels that the library has no record of: its other steels are no equivalents.
const ARMOUR: &[&str] = &["armor", "armour", "armox", "hha", "rha"];
/// Families that a suggestion names at most.
const MOST: usize = 8;

impl Library {
    /// The records whose id, family, name or state hold every word, in the order of their ids. Case does not matter, and common
    /// synonyms are known: `aluminum`, `titanium`, `rha`.
    pub fn search(&self, words: &str) -> Vec<&MaterialEntry> {
        let words = words.to_lowercase();
        let wanted: Vec<&str> = words.split_whitespace().map(synonym).collect();
        let has = |entry: &&MaterialEntry| {
            let text = text_of(entry);
            wanted.iter().all(|word| text.contains(word))
        };
        match wanted.is_empty() {
            true => Vec::new(),
            false => self.iter().filter(has).collect(),
        }
    }

    /// What a user may have meant by a name that is no id and no family, in one sentence or two that end with a space; empty where
    /// nothing is near.
    pub fn suggestion(&self, name: &str) -> String {
        let mut families: Vec<&str> = Vec::new();
        for entry in self.search(name) {
            let family = entry.material.family.as_deref().unwrap_or(&entry.id);
            if !families.contains(&family) {
                families.push(family);
            }
        }
        let armour = match ARMOUR.contains(&name.to_lowercase().as_str()) {
            true => "the library has no armour steel of that name; ",
            false => "",
        };
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
                let named: Vec<String> = several
                    .iter()
                    .take(MOST)
                    .map(|family| format!("`{family}`"))
                    .collect();
                let kind = synonym(&name.to_lowercase()).to_owned();
                format!("{armour}records of {kind}: {}{more}. ", named.join(", "))
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

/// The library's word for a word.
fn synonym(word: &str) -> &str {
    let known = SYNONYMS.iter().find(|(other, _)| *other == word);
    known.map_or(word, |(_, own)| own)
}

/// What a search looks at.
fn text_of(entry: &MaterialEntry) -> String {
    let material = &entry.material;
    let [family, state] = [&material.family, &material.state].map(|text| text.as_deref());
    [
        &entry.id,
        family.unwrap_or_default(),
        &material.name,
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
        assert!(ids("aluminium").len() >= 6, "{:?}", ids("aluminium"));
        assert_eq!(ids("aluminium lesuer"), ["6061-t6-lesuer"]);
        assert_eq!(ids("titanium"), ["ti-6al-4v-static", "ti-6al-4v-steinberg"]);
        assert!(ids("unobtainium").is_empty() && ids("  ").is_empty());
    }

    #[test]
    fn a_general_word_suggests_families_and_a_typo_one_name() {
        let library = Library::built_in();
        for (name, parts) in [
            (
                "steel",
                &["`4340`", "`weldox-460-e`", "`s-7-tool-steel`"][..],
            ),
            ("RHA", &["no armour steel of that name", "`4340`"]),
            ("aluminum", &["`6061-t6`", "`aluminium-2024-t351`"]),
            ("aluminium", &["`6061-t6`", "`aluminium-2024-t351`"]),
            ("titanium", &["did you mean `ti-6al-4v`?"]),
            ("wolfram", &["`tungsten`", "`tungsten-alloy`"]),
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
