//! Cards of the Johnson–Cook laws, complete and simplified.

use super::{
    UnitSystem,
    deck::{Deck, Field, Keyword},
};
use crate::{
    error::Error,
    material::{Damage, JohnsonCook, Material, RateForm, Strength, Trust},
    units::{Density, Pressure, SpecificHeat, StrainRate, Temperature},
};

/// From here on a melting temperature, a stress or a strain stands for none [K, any unit, 1].
const NO_MELTING: f64 = 1e5;
const NO_LIMIT: f64 = 1e16;
/// Default of the least failure strain, which is as good as none.
const LEAST_FAILURE: f64 = 1e-6;
/// Difference of two shear moduli that is worth a word.
const MODULI: f64 = 0.01;

/// A law of a deck.
pub(super) struct Card<'k, 'a> {
    pub(super) deck: &'k Deck<'a>,
    pub(super) keyword: &'k Keyword<'a>,
    pub(super) units: UnitSystem,
    pub(super) warnings: Vec<String>,
}

/// A material of a deck.
pub(super) struct Found {
    /// Number of the material in the deck.
    pub(super) number: f64,
    pub(super) material: Material,
}

impl Card<'_, '_> {
    /// The complete law (015).
    pub(super) fn complete(&mut self) -> Result<Found, Error> {
        let [mid, density, shear, young, poisson, _, _, form] = self.card(0)?;
        let [a, b, n, c, m, melting, room, rate] = self.card(1)?;
        let [heat, cutoff, _, _, d1, d2, d3, d4] = self.card(2)?;
        let [d5, _, _, least_failure, ..] = self.card::<8>(3)?;
        if form.value.is_some_and(|form| form != 0.0) {
            let message = format!("the rate form RATEOP = {} is not read", written(&form));
            let help = "0 is: 1 + C ln ε̇*, the only form that both programs have";
            return Err(self.deck.error(&form.span, message, help.to_owned()));
        }
        let (young, poisson) = self.moduli(&shear, &young, &poisson)?;
        let rate = self.rate(&rate)?;
        let melting = melting.value.filter(|&t| t > 0.0 && t < NO_MELTING);
        let mut material = self.material(
            self.required(&density, "RO")?,
            young,
            poisson,
            self.law([&a, &b, &n, &c], m.value, melting.is_some(), rate)?,
        );
        material.melting_temperature = melting.map(Temperature::new);
        if let Some(room) = room.value.filter(|&t| t > 0.0) {
            material.room_temperature = Temperature::new(room);
        }
        let heat = heat.value.filter(|&heat| heat > 0.0);
        material.specific_heat =
            heat.map(|heat| SpecificHeat::new(rounded(heat * self.units.specific_heat())));
        material.damage = self.damage([d1, d2, d3, d4, d5], rate);
        if material.damage.is_some() && least_failure.value.is_some_and(|e| e > LEAST_FAILURE) {
            let words = format!("EFMIN = {} is left out", written(&least_failure));
            self.warn(&words);
        }
        if cutoff.value.is_some_and(|cutoff| cutoff != 0.0) {
            self.warn("PC is left out: give `spall_strength` where the metal spalls");
        }
        Ok(Found {
            number: self.required(&mid, "MID")?,
            material,
        })
    }

    /// The simplified law (098), without temperature.
    pub(super) fn simplified(&mut self) -> Result<Found, Error> {
        let [mid, density, young, poisson, _] = self.card(0)?;
        let [a, b, n, c, failure, most, saturation, rate] = self.card(1)?;
        let rate = match rate.value {
            // The default of the card, in its own unit.
            None => self.units.rate(),
            Some(_) => self.rate(&rate)?,
        };
        for (field, name) in [
            (&failure, "PSFAIL"),
            (&most, "SIGMAX"),
            (&saturation, "SIGSAT"),
        ] {
            if field.value.is_some_and(|v| v > 0.0 && v < NO_LIMIT) {
                self.warn(&format!("{name} = {} is left out", written(field)));
            }
        }
        let material = self.material(
            self.required(&density, "RO")?,
            self.required(&young, "E")?,
            self.required(&poisson, "PR")?,
            self.law([&a, &b, &n, &c], None, false, rate)?,
        );
        Ok(Found {
            number: self.required(&mid, "MID")?,
            material,
        })
    }

    fn card<const N: usize>(&self, index: usize) -> Result<[Field; N], Error> {
        self.keyword.card(self.deck, index)
    }

    fn warn(&mut self, words: &str) {
        let line = self.deck.line(&self.keyword.span);
        let name = &self.keyword.name;
        self.warnings.push(format!("line {line}, *{name}: {words}"));
    }

    /// A value that is there.
    fn required(&self, field: &Field, name: &str) -> Result<f64, Error> {
        field.value.ok_or_else(|| {
            let message = format!("`{name}` of *{} is not given", self.keyword.name);
            let help = "write the number into its field".to_owned();
            self.deck.error(&field.span, message, help)
        })
    }

    /// Young's modulus, in the unit of the deck, and Poisson's ratio. Solids have G, shells have E and ν.
    fn moduli(&mut self, g: &Field, e: &Field, nu: &Field) -> Result<(f64, f64), Error> {
        let given = |field: &Field| field.value.filter(|&v| v > 0.0);
        match (given(g), given(e), given(nu)) {
            (Some(g), Some(e), Some(nu)) => {
                let own = 2.0 * g * (1.0 + nu);
                if (own / e - 1.0).abs() > MODULI {
                    self.warn(&format!(
                        "E = {e} is not 2 G (1 + PR) = {own:.5}, which is taken: solids of the deck have G"
                    ));
                }
                Ok((own, nu))
            }
            (Some(g), None, Some(nu)) => Ok((2.0 * g * (1.0 + nu), nu)),
            (None, Some(e), Some(nu)) => Ok((e, nu)),
            (Some(g), Some(e), None) => Ok((e, e / (2.0 * g) - 1.0)),
            _ => {
                let message = "two of G, E and PR are needed".to_owned();
                let help = "a record has Young's modulus and Poisson's ratio: write PR, and G or E";
                Err(self.deck.error(&nu.span, message, help.to_owned()))
            }
        }
    }

    /// Reference strain rate [1/s].
    fn rate(&self, field: &Field) -> Result<f64, Error> {
        let rate = self.required(field, "EPSO")?;
        if rate > 0.0 {
            return Ok(rounded(rate * self.units.rate()));
        }
        let message = format!("the reference rate EPSO = {rate} is not above 0");
        let help = "write 1 per second in the unit of the deck: 1, 0.001 or 1e-6";
        Err(self.deck.error(&field.span, message, help.to_owned()))
    }

    fn law(
        &self,
        [a, b, n, c]: [&Field; 4],
        m: Option<f64>,
        melts: bool,
        reference_rate: f64,
    ) -> Result<JohnsonCook, Error> {
        let stress = |value: f64| Pressure::new(rounded(value * self.units.pressure()));
        Ok(JohnsonCook {
            a: stress(self.required(a, "A")?),
            b: stress(b.value.unwrap_or(0.0)),
            n: n.value.unwrap_or(0.0),
            c: c.value.unwrap_or(0.0),
            // Without a melting temperature it has no effect.
            m: m.filter(|_| melts).unwrap_or(1.0),
            reference_rate: StrainRate::new(reference_rate),
            rate_form: RateForm::Logarithmic,
        })
    }

    /// Damage, if there is any. In decks the pressure is positive in compression, so that D₃ is positive there.
    fn damage(&mut self, fields: [Field; 5], reference_rate: f64) -> Option<Damage> {
        let [d1, d2, d3, d4, d5] = fields.map(|field| field.value.unwrap_or(0.0));
        if [d1, d2, d3].iter().all(|&d| d == 0.0) {
            return None;
        }
        if d3 > 0.0 {
            self.warn(&format!(
                "D3 = {d3} is taken as {}: here tension is positive",
                -d3
            ));
        } else if d3 < 0.0 {
            self.warn(&format!(
                "D3 = {d3} is taken as it is, tension positive: check the sign that the deck means"
            ));
        }
        Some(Damage {
            d1,
            d2,
            d3: -d3.abs(),
            d4,
            d5,
            reference_rate: StrainRate::new(reference_rate),
            rate_form: RateForm::Logarithmic,
            sources: Vec::new(),
            note: String::new(),
        })
    }

    fn material(&self, density: f64, young: f64, poisson: f64, law: JohnsonCook) -> Material {
        let (kind, title) = self.keyword.name_and_title();
        let name = title.filter(|title| !title.is_empty()).unwrap_or(kind);
        Material {
            trust: Trust::C,
            note: format!(
                "Read from *{kind} of a deck in {}; its source is not known.",
                self.units.name
            ),
            ..Material::new(
                name,
                Density::new(rounded(density * self.units.density())),
                Pressure::new(rounded(young * self.units.pressure())),
                rounded(poisson),
                Strength::JohnsonCook(law),
            )
        }
    }
}

fn written(field: &Field) -> String {
    field.value.map_or(String::new(), |value| value.to_string())
}

/// A value without the digits that a change of units adds.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}
