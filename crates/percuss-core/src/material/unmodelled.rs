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
/// Structural and carbon steels without a law.
const STRUCTURAL: &str = "no published law of this steel could be read; `1006` is the softest steel of the library and no equivalent, and \
    `weldox-460-e` the mildest plate steel";
/// Austenitic steel without a law.
const AUSTENITIC: &str =
    "no published law of this steel could be read; `304` is the nearest relative and no equivalent";
/// Steels with a strength above 1 GPa without a law.
const HIGH_STRENGTH: &str = "no published law of this steel could be read; `4340`, `s-7-tool-steel` and `aermet-100` are steels of high strength, \
    and no equivalents";
/// Armour and wear plates without a law.
const ARMOUR: &str = "no published law of this plate could be read; `percuss materials armour --hardness FROM..TO` lists records of its hardness";
/// Nickel alloys without a law.
const NICKEL: &str = "no published law of this alloy could be read; the nickel records are `nickel-200` and `monel`, both softer";
/// Polymers without a law.
const POLYMERS: &str = "no published law of its strength could be read; `polycarbonate` and `pmma` are the polymers of the library";
/// Nylon.
const NYLON: &str = "its shock Hugoniot is published in a readable place, its strength at high rates is not; `polycarbonate` is the nearest \
    ductile polymer, and no equivalent";
/// Rocks and ice.
const ROCKS: &str = "no published law of its strength under impact could be read; `granite` and `concrete` are the only records of that kind, and no equivalents";

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
        &[
            "a36", "a572", "s235", "s275", "s355", "q235", "q345", "1018", "1020", "1045", "c45",
            "ck45", "dp600",
        ],
        STRUCTURAL,
    ),
    (&["316", "316l", "304l", "301", "321"], AUSTENITIC),
    (
        &[
            "4140", "300m", "d6ac", "17-4ph", "17-4", "maraging", "h13", "hy-80",
        ],
        HIGH_STRENGTH,
    ),
    (
        &[
            "hardox",
            "ramor",
            "secure",
            "armox-440",
            "armox-440t",
            "armox-500",
            "armox-500t",
        ],
        ARMOUR,
    ),
    (&["inconel", "hastelloy"], NICKEL),
    (&["nylon", "pa6", "pa66", "polyamide"], NYLON),
    (
        &[
            "epoxy",
            "ptfe",
            "teflon",
            "hdpe",
            "polyethylene",
            "polypropylene",
            "abs",
            "peek",
        ],
        POLYMERS,
    ),
    (
        &["limestone", "marble", "basalt", "sandstone", "rock", "ice"],
        ROCKS,
    ),
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
        assert_eq!(reason_not_modelled("AISI 1018"), Some(STRUCTURAL));
        assert_eq!(reason_not_modelled("Armox 500T"), Some(ARMOUR));
        assert_eq!(reason_not_modelled("HY-80"), Some(HIGH_STRENGTH));
        assert_eq!(reason_not_modelled("copper"), None);
        assert_eq!(reason_not_modelled("sandwich"), None);
    }

    /// A reason names records that exist.
    #[test]
    fn nearest_records_exist() {
        for (_, reason) in UNMODELLED {
            for name in reason.split('`').skip(1).step_by(2) {
                let is_model = name == "hydrodynamic" || name.starts_with("percuss ");
                assert!(
                    is_model || Library::built_in().find(name).is_some(),
                    "{name}"
                );
            }
        }
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
