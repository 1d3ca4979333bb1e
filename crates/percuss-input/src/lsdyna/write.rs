//! Cards written from records.

use std::fmt::Write as _;

use super::{UnitSystem, johnson_cook::rounded};
use crate::{
    Refusal,
    material::{JohnsonCook, Material, RateForm, Strength},
};

/// Columns of a field.
const WIDTH: usize = 10;
/// Melting temperature that stands for none [K].
const NO_MELTING: f64 = 1e6;

/// The card `*MAT_JOHNSON_COOK` of a record, and `*EOS_GRUNEISEN` where it has an equation of state, both of one number.
///
/// # Errors
/// The reason where the card cannot say what the record says.
pub fn write(number: usize, material: &Material, units: UnitSystem) -> Result<String, Refusal> {
    let law = law_of(material)?;
    let pressure = |si: f64| si / units.pressure();
    let mut text = format!(
        "*MAT_JOHNSON_COOK_TITLE\n{}\n",
        material.name.replace(['\n', '\r'], " ")
    );
    let young = pressure(material.youngs_modulus.si());
    let poisson = material.poissons_ratio;
    card(
        &mut text,
        &["mid", "ro", "g", "e", "pr", "dtf", "vp", "rateop"],
        &[
            number as f64,
            material.density.si() / units.density(),
            young / (2.0 * (1.0 + poisson)),
            young,
            poisson,
            0.0,
            0.0,
            0.0,
        ],
    );
    let melting = material.melting_temperature;
    card(
        &mut text,
        &["a", "b", "n", "c", "m", "tm", "tr", "epso"],
        &[
            pressure(law.a.si()),
            pressure(law.b.si()),
            law.n,
            law.c,
            law.m,
            melting.map_or(NO_MELTING, |melting| melting.si()),
            material.room_temperature.si(),
            law.reference_rate.si() / units.rate(),
        ],
    );
    // In decks the pressure is positive in compression, and so is D₃.
    let d = material
        .damage
        .as_ref()
        .map_or([0.0; 5], |d| [d.d1, d.d2, -d.d3, d.d4, d.d5]);
    let heat = material.specific_heat.map_or(0.0, |heat| heat.si());
    card(
        &mut text,
        &["cp", "pc", "spall", "it", "d1", "d2", "d3", "d4"],
        &[
            heat / units.specific_heat(),
            0.0,
            0.0,
            0.0,
            d[0],
            d[1],
            d[2],
            d[3],
        ],
    );
    card(&mut text, &["d5"], &[d[4]]);
    if let Some(equation) = &material.equation_of_state {
        text += "*EOS_GRUNEISEN\n";
        card(
            &mut text,
            &["eosid", "c", "s1", "s2", "s3", "gamao", "a", "e0"],
            &[
                number as f64,
                equation.sound_speed.si() / units.velocity(),
                equation.slope,
                0.0,
                0.0,
                equation.gruneisen,
                0.0,
                0.0,
            ],
        );
        card(&mut text, &["v0"], &[1.0]);
    }
    Ok(text)
}

/// The Johnson–Cook law of a record that a card can hold.
fn law_of(material: &Material) -> Result<&JohnsonCook, Refusal> {
    let remedy = "`--format toml` writes every record";
    let law = match &material.strength {
        Strength::JohnsonCook(law) => law,
        other => {
            let reason = format!("`{}` is no Johnson–Cook law", other.key());
            return Err(Refusal::new(reason).with_remedy(remedy));
        }
    };
    let damage_differs = material.damage.as_ref().is_some_and(|damage| {
        damage.rate_form != law.rate_form || damage.reference_rate.si() != law.reference_rate.si()
    });
    let reason = match (law.rate_form, damage_differs) {
        (RateForm::Power, _) => "the card has no power of the strain rate",
        (_, true) => "the card has one reference rate for strength and damage",
        (_, false) => return Ok(law),
    };
    Err(Refusal::new(reason).with_remedy(remedy))
}

/// A card below a comment with the names of its fields.
fn card(text: &mut String, names: &[&str], values: &[f64]) {
    let heads: String = names
        .iter()
        .enumerate()
        .map(|(i, name)| format!("{name:>0$}", if i == 0 { WIDTH - 2 } else { WIDTH }))
        .collect();
    let values: String = values.iter().map(|&value| field(value)).collect();
    // Writing to a text does not fail.
    let _ = writeln!(text, "$#{heads}\n{values}");
}

/// A number in a field, with as many digits as there is room for.
fn field(value: f64) -> String {
    let value = rounded(value);
    let room = WIDTH - 1;
    let fits = |text: &String| text.len() <= room;
    let plain = value.to_string();
    if fits(&plain) {
        return format!("{plain:>WIDTH$}");
    }
    let digits = (0..room).rev();
    let scientific = digits.map(|digits| format!("{value:.digits$e}")).find(fits);
    let fixed = (0..room)
        .rev()
        .map(|digits| format!("{value:.digits$}"))
        .find(fits);
    let error = |text: &String| {
        let read: f64 = text.parse().unwrap_or(f64::NAN);
        (read - value).abs()
    };
    let best = [scientific, fixed].into_iter().flatten();
    let best = best.min_by(|a, b| error(a).total_cmp(&error(b)));
    format!("{:>WIDTH$}", best.unwrap_or(plain))
}
