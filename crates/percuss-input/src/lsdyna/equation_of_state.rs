//! Card of the equation of state of Mie and Grüneisen.

use super::{
    deck::{Deck, Field, Keyword},
    johnson_cook::rounded,
    units::UnitSystem,
};
use crate::{error::Error, material::EquationOfState, units::Velocity};

/// An equation of state of a deck.
pub(super) struct GruneisenCard {
    /// Its number in the deck.
    pub(super) number: f64,
    pub(super) equation: EquationOfState,
}

/// Reads a card; what it leaves out goes to `warnings`.
pub(super) fn read(
    deck: &Deck<'_>,
    keyword: &Keyword<'_>,
    units: UnitSystem,
    warnings: &mut Vec<String>,
) -> Result<GruneisenCard, Error> {
    let [number, speed, s1, s2, s3, gruneisen, _, _]: [Field; 8] = keyword.card(deck, 0)?;
    let required = |field: &Field, name: &str| {
        field.value.ok_or_else(|| {
            let message = format!("`{name}` of *{} is not given", keyword.name);
            deck.error(&field.span, message, "write the number".to_owned())
        })
    };
    if [&s2, &s3]
        .iter()
        .any(|field| field.value.is_some_and(|s| s != 0.0))
    {
        let line = deck.line(&keyword.span);
        warnings.push(format!(
            "line {line}, *{}: S2 and S3 are left out: here U_s = C + S1 u_p",
            keyword.name
        ));
    }
    Ok(GruneisenCard {
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
