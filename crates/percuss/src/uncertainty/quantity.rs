//! Results that an uncertainty is computed of.

use crate::{outcome::Outcome, summary::ResultRecord};

/// A scalar result of a shot.
#[derive(Clone, Copy)]
pub struct Quantity {
    /// Its name in results, with the unit.
    pub name: &'static str,
    /// Its name in words.
    pub in_words: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Whether it is looked at unless others are asked for.
    pub main: bool,
    read: fn(&ResultRecord) -> Option<f64>,
}

impl Quantity {
    /// Its value, if the shot has one.
    pub fn of(&self, record: &ResultRecord) -> Option<f64> {
        (self.read)(record).filter(|value| value.is_finite())
    }
}

impl std::fmt::Debug for Quantity {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name)
    }
}

const fn quantity_of(
    [name, in_words, unit]: [&'static str; 3],
    main: bool,
    read: fn(&ResultRecord) -> Option<f64>,
) -> Quantity {
    Quantity {
        name,
        in_words,
        unit,
        main,
        read,
    }
}

/// All of them. Adding one is one entry here.
pub static QUANTITIES: &[Quantity] = &[
    // A shot that goes through has no depth.
    quantity_of(
        ["depth_of_penetration_mm", "depth of penetration", "mm"],
        true,
        |r| {
            r.depth_of_penetration_mm
                .filter(|_| r.outcome != Outcome::Perforated)
        },
    ),
    // What is stopped has none left.
    quantity_of(
        ["residual_velocity_m_s", "residual velocity", "m/s"],
        true,
        |r| {
            r.residual_velocity_m_s
                .map(|velocity| match r.outcome.perforated() {
                    Some(false) => 0.0,
                    _ => velocity,
                })
        },
    ),
    quantity_of(
        ["ballistic_limit_m_s", "ballistic limit", "m/s"],
        true,
        |r| r.ballistic_limit_m_s,
    ),
    quantity_of(
        [
            "projectile_final_length_mm",
            "final projectile length",
            "mm",
        ],
        true,
        |r| r.projectile_final_length_mm,
    ),
    quantity_of(
        [
            "projectile_final_diameter_mm",
            "final projectile diameter",
            "mm",
        ],
        false,
        |r| r.projectile_final_diameter_mm,
    ),
    quantity_of(
        ["projectile_final_mass_g", "final projectile mass", "g"],
        false,
        |r| r.projectile_final_mass_g,
    ),
    quantity_of(
        ["plug_velocity_m_s", "velocity of the plug", "m/s"],
        false,
        |r| r.plug_velocity_m_s,
    ),
    quantity_of(["plug_mass_g", "mass of the plug", "g"], false, |r| {
        r.plug_mass_g
    }),
    quantity_of(["time_to_rest_us", "time to rest", "us"], false, |r| {
        r.time_to_rest_us
    }),
    quantity_of(["peak_force_kn", "peak force", "kN"], false, |r| {
        r.peak_force_kn
    }),
    quantity_of(["contact_time_us", "contact time", "us"], false, |r| {
        r.contact_time_us
    }),
];

/// The quantity of this name.
pub fn quantity(name: &str) -> Option<&'static Quantity> {
    QUANTITIES.iter().find(|quantity| quantity.name == name)
}
