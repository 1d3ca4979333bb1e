//! Names of materials that cannot be had, with the reason.

/// Layers of fibres.
const FIBRES: &str = "layers of fibres fail by stretching and delaminating, and every model here takes the target as one isotropic solid; \
    measured limits can still be fitted with `percuss limit --tests`";
/// Wood.
const WOOD: &str = "the strength of wood depends on the direction of its grain and on moisture, and every model here takes the target as one \
    isotropic solid; measured limits can still be fitted with `percuss limit --tests`";
/// Grains.
const GRAINS: &str = "soil compacts and flows as grains do, and no model here describes that";
/// Liquids and jellies.
const LIQUIDS: &str = "no model here describes a target without static strength; `hydrodynamic` gives the bound for fast jets";
/// Rubber and foam.
const ELASTOMERS: &str =
    "rubber and foam strain elastically by more than 100 %, which no law here describes";
/// Structural steels without a law.
const STRUCTURAL: &str = "no published law of this steel could be read; `1006` is the softest steel of the library and no equivalent, and \
    `weldox-460-e` the mildest plate steel";
/// Austenitic steel without a law.
const AUSTENITIC: &str =
    "no published law of this steel could be read; `304` is the nearest relative and no equivalent";
/// Nylon.
const NYLON: &str = "only its shock Hugoniot is published in a readable place, not its strength";

/// Names, in lower case with hyphens, and why they have no record. A word of a name is enough.
const UNMODELLED: &[(&[&str], &str)] = &[
    (
        &[
            "dyneema",
            "spectra",
            "uhmwpe",
            "kevlar",
            "aramid",
            "twaron",
            "cfrp",
            "gfrp",
            "frp",
            "carbon-fibre",
            "carbon-fiber",
            "fibreglass",
            "fiberglass",
            "glass-fibre",
            "s-glass",
            "e-glass",
        ],
        FIBRES,
    ),
    (
        &["wood", "plywood", "timber", "oak", "pine", "birch", "beech"],
        WOOD,
    ),
    (&["sand", "soil", "clay", "gravel", "plasticine"], GRAINS),
    (&["water", "gelatin", "gelatine", "tissue"], LIQUIDS),
    (&["rubber", "foam", "polyurea", "neoprene"], ELASTOMERS),
    (
        &["a36", "a572", "s235", "s275", "s355", "q235", "q345"],
        STRUCTURAL,
    ),
    (&["316", "316l", "304l"], AUSTENITIC),
    (&["nylon", "pa6", "pa66", "polyamide"], NYLON),
];

/// Why a name has no record, where that is known: the material cannot be modelled, or no law of it could be read.
pub fn reason_not_modelled(name: &str) -> Option<&'static str> {
    let name = super::library::alias_form(name);
    let holds = |word: &str| {
        let is_part = name.split('-').any(|part| part == word);
        is_part || (word.contains('-') && name.starts_with(word))
    };
    let known = UNMODELLED
        .iter()
        .find(|(names, _)| names.iter().any(|word| holds(word)));
    known.map(|(_, reason)| *reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::Library;

    #[test]
    fn reasons_are_given_by_name_and_by_word() {
        for name in ["Dyneema", "dyneema-hb26", "Kevlar 29", "e-glass/epoxy"] {
            assert_eq!(reason_not_modelled(name), Some(FIBRES), "{name}");
        }
        assert_eq!(reason_not_modelled("A36"), Some(STRUCTURAL));
        assert_eq!(reason_not_modelled("316L"), Some(AUSTENITIC));
        assert_eq!(reason_not_modelled("copper"), None);
        assert_eq!(reason_not_modelled("sandwich"), None);
    }

    /// No name with a record is called impossible.
    #[test]
    fn no_record_is_refused() {
        for entry in Library::built_in().iter() {
            let material = &entry.material;
            let family = material.family.iter();
            for name in family.chain(&material.aliases).chain([&entry.id]) {
                assert_eq!(reason_not_modelled(name), None, "{name}");
            }
        }
        for (names, _) in UNMODELLED {
            for name in *names {
                assert!(Library::built_in().find(name).is_none(), "{name}");
            }
        }
    }
}
