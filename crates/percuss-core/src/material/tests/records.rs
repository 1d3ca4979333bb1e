//! Records are complete, sourced and found by their names.

use std::collections::BTreeSet;

use super::*;

#[test]
fn every_record_is_sourced_and_explained() {
    for entry in built_in() {
        let MaterialEntry { id, material, .. } = entry;
        assert!(!material.sources.is_empty(), "{id}: no source");
        for source in &material.sources {
            assert!(references().contains_key(source), "{id}: {source} unknown");
        }
        assert_ne!(material.trust, Trust::User, "{id}: trust");
        assert!(!material.note.is_empty(), "{id}: no note");
        assert!(material.family.is_some(), "{id}: no family");
        assert_eq!(diagnostics(material), [], "{id}");
    }
}

#[test]
fn every_reference_says_what_it_is_and_what_was_read() {
    for (key, reference) in references() {
        assert!(!reference.title.is_empty(), "{key}: title");
        assert!(!reference.note.is_empty(), "{key}: note");
        assert!(
            key == "paper" || !reference.place.is_empty(),
            "{key}: place"
        );
        for text in [
            &reference.label,
            &reference.title,
            &reference.place,
            &reference.note,
        ] {
            assert!(
                !text.contains(['{', '}', '\\']),
                "{key}: TeX left in {text}"
            );
        }
    }
}

#[test]
fn a_reference_is_labelled_with_whole_names() {
    assert_eq!(
        references()["vonkarman1950"].label,
        "von Kármán & Duwez 1950"
    );
    assert_eq!(references()["taylor1948"].label, "Taylor 1948");
}

#[test]
fn every_family_recommends_one_record() {
    let families: BTreeSet<_> = built_in()
        .filter_map(|entry| entry.material.family.as_deref())
        .collect();
    for family in families {
        let recommended = built_in()
            .filter(|entry| entry.material.family.as_deref() == Some(family))
            .filter(|entry| entry.material.recommended)
            .count();
        assert_eq!(recommended, 1, "{family}");
        // A record's id hides a family of the same name.
        assert!(built_in().all(|entry| entry.id != family), "{family}");
    }
}

#[test]
fn families_answer_with_the_recommended_record() {
    let expected = [
        ("copper", "copper-woodward"),
        ("aluminium-2024-t351", "aluminium-2024-t351-woodward"),
        ("ofhc-copper", "ofhc-copper-johnson-cook"),
        ("etp-copper", "etp-copper-johnson-cook"),
        ("6061-t6", "6061-t6-lesuer"),
        ("7075-t6", "7075-t6-steinberg"),
        ("7075-t651", "7075-t651-flores-johnson"),
        ("2024-t4", "2024-t4-steinberg"),
        ("4340", "4340-johnson-cook"),
        ("armco-iron", "armco-iron-johnson-cook"),
        ("tantalum", "tantalum-steinberg"),
        ("ti-6al-4v", "ti-6al-4v-steinberg"),
        ("tungsten-alloy", "tungsten-alloy-steinberg"),
        ("tungsten", "tungsten-steinberg"),
        ("s-7-tool-steel", "s-7-tool-steel-johnson-cook"),
        ("cartridge-brass", "cartridge-brass-johnson-cook"),
        ("weldox-460-e", "weldox-460-e-borvik"),
        ("weldox-700-e", "weldox-700-e-flores-johnson"),
        ("apm2-core", "apm2-core-flores-johnson"),
        ("apm2-brass-jacket", "apm2-brass-jacket-flores-johnson"),
        ("apm2-lead-cap", "apm2-lead-cap-flores-johnson"),
    ];
    let library = Library::built_in();
    for (family, id) in expected {
        let entry = library.find(family);
        assert_eq!(
            entry.map(|entry| entry.id.as_str()),
            Some(id),
            "family {family}"
        );
    }
    for (id, rival) in [
        ("ofhc-copper-johnson-cook", "ofhc-copper-steinberg"),
        ("6061-t6-lesuer", "6061-t6-steinberg"),
        ("tungsten-alloy-steinberg", "tungsten-alloy-johnson-cook"),
        ("ti-6al-4v-steinberg", "ti-6al-4v-static"),
    ] {
        let entry = library.find(id).unwrap();
        let rivals: Vec<_> = library.rivals(entry).map(|other| &other.id).collect();
        assert_eq!(rivals, [rival]);
    }
}

/// A key of the bibliography: letters, a year, perhaps one more letter.
fn is_key(word: &str) -> bool {
    let name = word.trim_end_matches(|c: char| c.is_ascii_lowercase());
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name.len() == letters.len() + 4
        && word.len() <= name.len() + 1
        && !letters.is_empty()
        && letters.chars().all(|c| c.is_ascii_lowercase())
}

#[test]
fn pages_of_models_cite_what_the_bibliography_has() {
    let pages = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/models");
    let mut cited = 0;
    for page in std::fs::read_dir(pages).unwrap() {
        let path = page.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let bracketed = text.split('[').skip(1);
        for words in bracketed.filter_map(|rest| rest.split(']').next()) {
            for key in words.split([',', ' ', '\n']).filter(|word| is_key(word)) {
                cited += 1;
                assert!(
                    references().contains_key(key),
                    "{}: {key} is not in references.bib",
                    path.display()
                );
            }
        }
    }
    assert!(cited > 50, "{cited}");
}
