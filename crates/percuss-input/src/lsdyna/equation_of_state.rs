//! Card of the equation of state of Mie and Grüneisen.

use super::{
    UnitSystem,
    deck::{Deck, Field, Keyword},
    johnson_cook::rounded,
};
use crate::{error::Error, material::EquationOfState, units::Velocity};

/// An equation of state of a deck.
pub(super) struct GruneisenCard {
    /// Its number in the deck.
    pub(super) number: f64,
    /// Line of its keyword.
    pub(super) line: usize,
    pub(super) equation: EquationOfState,
}

/// Reads a card; what it leaves out goes to `warnings`.
pub(super) fn read(
    deck: &Deck<'_>,
    keyword: &Keyword<'_>,
    units: UnitSystem,
    warnings: &mut Vec<String>,
) -> Result<GruneisenCard, Error> {
    let [number, speed, s1, s2, s3, gruneisen, a, e0]: [Field; 8] = keyword.card(deck, 0)?;
    let [v0, _, curve]: [Field; 3] = keyword.card(deck, 1)?;
    let required = |field: &Field, name: &str| {
        field.value.ok_or_else(|| {
            let message = format!("`{name}` of *{} is not given", keyword.name);
            deck.error(&field.span, message, "write the number".to_owned())
        })
    };
    // An initial relative volume of 0 is that of a blank field, 1.
    let v0 = v0.value.filter(|&volume| volume != 0.0 && volume != 1.0);
    let others = [("S2", s2.value), ("S3", s3.value), ("A", a.value)];
    let states = [("E0", e0.value), ("V0", v0), ("LCID", curve.value)];
    let left_out: Vec<&str> = others
        .into_iter()
        .chain(states)
        .filter(|(_, value)| value.is_some_and(|value| value != 0.0))
        .map(|(name, _)| name)
        .collect();
    if !left_out.is_empty() {
        warnings.push(format!(
            "line {}, *{}: {} left out: here U_s = C + S1 u_p, Γ ρ is constant, and the body starts at rest without pressure",
            deck.line(&keyword.span),
            keyword.name,
            left_out.join(", ")
        ));
    }
    Ok(GruneisenCard {
        line: deck.line(&keyword.span),
        number: required(&number, "EOSID")?,
        equation: EquationOfState {
            sound_speed: Velocity::new(rounded(required(&speed, "C")? * units.velocity())),
            slope: required(&s1, "S1")?,
            gruneisen: required(&gruneisen, "GAMAO")?,
            sources: Vec::new(),
            note: String::new(),
        },
    })
}
