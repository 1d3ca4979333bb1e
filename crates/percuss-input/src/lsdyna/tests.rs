use super::*;
use crate::{
    error::Error,
    material::{Library, Strength},
};

/// 4340 of Johnson and Cook in mm, kg and ms, in columns, with an equation of state that a part joins.
const DECK: &str = "\
*KEYWORD
*NODE
       1             0.0             0.0             0.0
*PART
the plate
$#     pid     secid       mid     eosid
         1         1        11        21
the projectile
         2         1        12         0
*MAT_JOHNSON_COOK_TITLE
4340 steel, plate
$#     mid        ro         g         e        pr       dtf        vp    rateop
        11 7.8300E-6      80.0     208.0       0.3
$#       a         b         n         c         m        tm        tr      epso
     0.792      0.51      0.26     0.014      1.03    1793.0     298.0     0.001
$#      cp        pc     spall        it        d1        d2        d3        d4
     477.0     -9.00       2.0       0.0      0.05      3.44      2.12     0.002
      0.61
*MAT_098
        12   7.85E-6     200.0      0.29
     0.811    0.1547     0.156   0.00749      2.15       1.8       0.0     0.001
*EOS_GRUNEISEN
        21    3574.0      1.92       0.0       0.0      1.69

*EOS_GRUNEISEN
        11    9999.0      1.00       0.0       0.0      1.00
*MAT_RIGID
        13   7.85E-6     200.0      0.29
*END
";

fn units(name: &str) -> UnitSystem {
    UnitSystem::named(name).unwrap()
}

fn refused(deck: &str) -> (String, String, usize) {
    match read("d.k", deck, units("mm-kg-ms")) {
        Err(Error::Input(error)) => (error.message.clone(), error.help.clone(), error.line()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_deck_gives_the_numbers_of_the_library() {
    let found = read("d.k", DECK, units("mm-kg-ms")).unwrap();
    let ids: Vec<&String> = found.records.keys().collect();
    assert_eq!(ids, ["4340-steel-plate", "mat-098"]);
    let plate = &found.records["4340-steel-plate"];
    let known = &Library::built_in()
        .find("4340-johnson-cook")
        .unwrap()
        .material;
    assert_eq!(plate.density, known.density);
    assert_eq!(plate.youngs_modulus, known.youngs_modulus);
    assert_eq!(plate.strength, known.strength);
    assert_eq!(plate.specific_heat, known.specific_heat);
    assert_eq!(plate.melting_temperature, known.melting_temperature);
    assert_eq!(plate.room_temperature, known.room_temperature);
    let numbers = |material: &crate::material::Material| {
        let d = material.damage.clone().unwrap();
        let e = material.equation_of_state.clone().unwrap();
        (
            [d.d1, d.d2, d.d3, d.d4, d.d5],
            [e.sound_speed.si(), e.slope, e.gruneisen],
        )
    };
    assert_eq!(numbers(plate), numbers(known));
    // Without a temperature there is no softening, and no part joins it with an equation of state.
    let projectile = &found.records["mat-098"];
    assert_eq!(projectile.melting_temperature, None);
    assert_eq!(projectile.equation_of_state, None);
}

#[test]
fn what_is_left_out_is_said() {
    let found = read("d.k", DECK, units("mm-kg-ms")).unwrap();
    let all = found.warnings.join("\n");
    for words in [
        "line 10, *MAT_JOHNSON_COOK_TITLE: PC is left out",
        "D3 = 2.12 is taken as -2.12",
        "line 19, *MAT_098: PSFAIL = 2.15 is left out",
        "SIGMAX = 1.8 is left out",
        "line 27: *MAT_RIGID is not read",
        "line 25: the equation of state 11 is left out: no material that was read has it",
    ] {
        assert!(all.contains(words), "`{words}` is not in\n{all}");
    }
    assert_eq!(found.warnings.len(), 6, "{all}");
}

#[test]
fn units_are_those_that_the_caller_names() {
    // The same card in tonnes, mm and seconds.
    let deck = "*MAT_JOHNSON_COOK\n1,7.83e-9,8.e4,208000,0.3\n792,510,0.26,0.014,1.03,1793,298,1\n4.77e8\n";
    let steel = &read("d.k", deck, units("mm-t-s")).unwrap().records["mat-johnson-cook"];
    let plate = &read("d.k", DECK, units("mm-kg-ms")).unwrap().records["4340-steel-plate"];
    assert_eq!(steel.density, plate.density);
    assert_eq!(steel.strength, plate.strength);
    assert_eq!(steel.specific_heat, plate.specific_heat);
    let (message, help, line) = refused(deck);
    assert!(message.contains("density"), "{message}");
    assert!(
        help.contains("the deck was read in mm-kg-ms, stresses in GPa"),
        "{help}"
    );
    assert_eq!(line, 1);
}

#[test]
fn moduli_are_those_of_solids() {
    let deck =
        |card: &str| format!("*MAT_015\n1,7.83e-6,{card}\n0.8,0.5,0.3,0.01,1,1800,300,0.001\n");
    let of = |card: &str| {
        let mut found = read("d.k", &deck(card), units("mm-kg-ms")).unwrap();
        let material = found.records.pop_first().unwrap().1;
        (
            material.youngs_modulus.si(),
            material.poissons_ratio,
            found.warnings,
        )
    };
    assert_eq!(of("80,,0.3"), (208e9, 0.3, vec![]));
    assert_eq!(of(",208,0.3"), (208e9, 0.3, vec![]));
    assert_eq!(of("80,208"), (208e9, 0.3, vec![]));
    let (young, _, warnings) = of("80,200,0.3");
    assert_eq!(young, 208e9);
    assert!(warnings[0].contains("E = 200 is not 2 G (1 + PR) = 208.00000"));
    assert!(refused(&deck("80")).0.contains("two of G, E and PR"));
}

/// Nothing of an equation of state or of damage is left out without a word.
#[test]
fn every_number_without_a_place_has_a_warning() {
    let steel = "*MAT_015\n1,7.83e-6,80,208,0.3\n0.8,0.5,0.3,0.01,1,1800,300,0.001\n0,0,0,0,0.1,0.9,-1.5,0\n";
    let of = |rest: &str| {
        let found = read("d.k", &format!("{steel}{rest}"), units("mm-kg-ms")).unwrap();
        let has = found.records["mat-015"].equation_of_state.is_some();
        (has, found.warnings.join("\n"))
    };
    let (has, quiet) = of("0,0,0,1e-6\n*EOS_004\n1,3574,1.92,0,0,1.69,0,0\n1\n");
    assert!(has && quiet.matches("line").count() == 1, "{quiet}");
    for (rest, words) in [
        ("0,0,0,0.01\n", "EFMIN = 0.01 is left out"),
        (
            "0\n*EOS_004\n1,3574,1.92,0.1,0,1.69,0.46,0\n",
            "S2, A left out",
        ),
        (
            "0\n*EOS_004\n1,3574,1.92,0,0,1.69,0,2.5\n0.98\n",
            "E0, V0 left out",
        ),
        (
            "0\n*EOS_004\n2,3574,1.92,0,0,1.69\n",
            "equation of state 2 is left out",
        ),
        (
            "0\n*EOS_004\n2,3574,1.92,0,0,1.69\n*EOS_004\n3,3600,1.92,0,0,1.69\n*PART\na\n1,1,1,2\nb\n2,1,1,3\n",
            "material 1 with 2 equations of state",
        ),
        (
            "0\n*EOS_004\n1,3574,1.92,0,0,1.69\n*PART_INERTIA\na\n1,1,1,2\n",
            "*PART_INERTIA is not read",
        ),
        (
            "0\n*INCLUDE_TRANSFORM\nother.k\n",
            "*INCLUDE_TRANSFORM is not followed",
        ),
    ] {
        let (_, warnings) = of(rest);
        assert!(warnings.contains(words), "`{words}` is not in\n{warnings}");
    }
}

/// The part says which equation is the material's, whatever options the part has.
#[test]
fn parts_with_options_join_materials_with_their_equations() {
    let deck = |parts: &str| {
        format!(
            "*MAT_015\n1,7.83e-6,80,208,0.3\n0.8,0.5,0.3,0.01,1,1800,300,0.001\n0\n*EOS_004\n1,3940,1.489,0,0,1.69\n\
             *EOS_004\n2,4569,1.49,0,0,2.17\n{parts}"
        )
    };
    for (parts, speed) in [
        ("*PART\nplate\n1,1,1,2\n", Some(4569.0)),
        (
            "*PART_CONTACT\nother\n2,1,7,1\n0.1,0.1\nplate\n1,1,1,2\n0.1,0.1\n",
            Some(4569.0),
        ),
        // What is not read joins nothing.
        (
            "*PART_INERTIA\nplate\n1,1,1,2\n0,0,0,1\n1,0,0,1,0,1\n0,0,0\n",
            None,
        ),
        ("", Some(3940.0)),
    ] {
        let found = read("d.k", &deck(parts), units("mm-kg-ms")).unwrap();
        let equation = &found.records["mat-015"].equation_of_state;
        let found = equation.as_ref().map(|equation| equation.sound_speed.si());
        let near = match (found, speed) {
            (Some(a), Some(b)) => (a - b).abs() < 1e-6 * b,
            (a, b) => a == b,
        };
        assert!(near, "{parts}: {found:?}");
    }
}

#[test]
fn damage_has_one_sign() {
    let deck = |d3: &str| {
        format!(
            "*MAT_015\n1,7.83e-6,80,208,0.3\n0.8,0.5,0.3,0.01,1,1800,300,0.001\n0,0,0,0,0.1,0.9,{d3},0\n"
        )
    };
    for (d3, words) in [("1.5", "taken as -1.5"), ("-1.5", "check the sign")] {
        let found = read("d.k", &deck(d3), units("mm-kg-ms")).unwrap();
        let damage = found.records["mat-015"].damage.as_ref().unwrap();
        assert_eq!(damage.d3, -1.5);
        assert!(found.warnings[0].contains(words), "{:?}", found.warnings);
    }
}

#[test]
fn cards_that_cannot_be_read_are_refused_at_their_place() {
    let card = |first: &str, second: &str| format!("*MAT_015\n{first}\n{second}\n");
    let good = "1,7.83e-6,80,208,0.3";
    for (deck, words, line) in [
        (
            "*NODE\n1,0,0,0\n".to_owned(),
            "no material that can be read",
            1,
        ),
        (card("1,,80,208,0.3", "0.8"), "EPSO", 3),
        (
            card(good, "0.8,0.5,0.3,0.01,1,1800,300,0"),
            "EPSO = 0 is not above 0",
            3,
        ),
        (
            card("1,7.83e-6,80,208,0.3,,,4", "0.8,0,0,0,1,0,0,1"),
            "RATEOP = 4",
            2,
        ),
        (card(good, "0.8,&b,0.3"), "`&b` is no number", 3),
        (card(good, ""), "`EPSO` of *MAT_015 is not given", 3),
        (
            card(good, "800,500,0.3,0.01,1,1800,300,0.001"),
            "strength.johnson_cook.a",
            1,
        ),
    ] {
        let (message, help, at) = refused(&deck);
        assert!(message.contains(words), "{message}");
        assert!(!help.is_empty());
        assert_eq!(at, line, "{message}");
    }
}

#[test]
fn equal_titles_have_ids_of_their_own() {
    let one = |mid: u32| {
        format!(
            "*MAT_015_TITLE\nsteel\n{mid},7.83e-6,80,208,0.3\n0.8,0.5,0.3,0.01,1,1800,300,0.001\n"
        )
    };
    let found = read("d.k", &(one(3) + &one(4) + &one(4)), units("mm-kg-ms")).unwrap();
    let ids: Vec<&String> = found.records.keys().collect();
    assert_eq!(ids, ["steel", "steel-4", "steel-4-2"]);
}

/// What a card can hold is read back with the digits of its fields.
#[test]
fn written_cards_are_read_back() {
    let mut written = 0;
    for entry in Library::built_in().iter() {
        for units in UnitSystem::ALL {
            let Ok(text) = write(7, &entry.material, units) else {
                assert!(
                    !matches!(&entry.material.strength, Strength::JohnsonCook(law)
                    if law.rate_form == crate::material::RateForm::Logarithmic
                    && entry.material.damage.is_none()),
                    "{}",
                    entry.id
                );
                continue;
            };
            written += 1;
            let found = read("d.k", &text, units).unwrap();
            let (_, back) = found.records.into_iter().next().unwrap();
            let near = |a: f64, b: f64| (a - b).abs() <= 2e-4 * b.abs();
            let material = &entry.material;
            assert!(near(back.density.si(), material.density.si()), "{text}");
            assert!(
                near(back.youngs_modulus.si(), material.youngs_modulus.si()),
                "{text}"
            );
            let curve = |m: &crate::material::Material| m.flow_stress(0.1).unwrap();
            assert!(near(curve(&back), curve(material)), "{text}");
            assert_eq!(back.melting_temperature, material.melting_temperature);
            let speed = |m: &crate::material::Material| {
                m.equation_of_state.as_ref().map(|e| e.sound_speed.si())
            };
            match (speed(&back), speed(material)) {
                (Some(a), Some(b)) => assert!(near(a, b), "{text}"),
                (a, b) => assert_eq!(a, b),
            }
            let d3 = |m: &crate::material::Material| m.damage.as_ref().map(|d| d.d3);
            assert_eq!(d3(&back), d3(material), "{text}");
        }
    }
    assert!(written > 100, "{written}");
}

/// The time that a deck takes grows with its length alone: a quarter of a million cards of every kind, and of one number.
#[test]
fn decks_of_many_cards_are_read_at_once() {
    let many = |card: &str| card.repeat(50_000);
    let johnson_cook = "*MAT_JOHNSON_COOK_TITLE\nsteel\n1,7.83e-6,80.,208.,0.3\n0.792,0.51,0.26,0.014,1.03,1793.,298.,0.001\n477.\n";
    let gruneisen = "*EOS_GRUNEISEN\n1,4569.,1.49,0.,0.,2.17,0.46,0.\n0.\n";
    let part = "*PART\nplate\n1,1,1,1\n";
    let deck = [
        many("*MAT_ELASTIC\n"),
        many("*INCLUDE\nother.k\n"),
        many(johnson_cook),
        many(gruneisen),
        many(part),
    ]
    .concat();
    // Without the deck, which an error holds.
    let found = read("deck.k", &deck, UnitSystem::named("mm-kg-ms").unwrap())
        .map_err(|error| error.message_and_help())
        .unwrap();
    assert_eq!(found.records.len(), 50_000);
    assert!(found.records.contains_key("steel-1-50"));
    let said = &found.warnings;
    assert!(said.contains(&"line 1 and 49999 more: *MAT_ELASTIC is not read".to_owned()));
}
