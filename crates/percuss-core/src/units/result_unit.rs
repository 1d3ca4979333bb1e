//! Units of results and histories, with the ends of the names that carry them.

/// Unit in which files, JSON and Python give a number, beside the SI unit that it is computed in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResultUnit {
    /// Symbol; empty for a plain number.
    pub symbol: &'static str,
    /// End of the name of a number in this unit, such as `_mm`.
    pub suffix: &'static str,
    /// Symbol of the SI unit.
    pub si_symbol: &'static str,
    /// End of the name of a number in the SI unit, such as `_m`.
    pub si_suffix: &'static str,
    /// What a number in SI units is multiplied by.
    pub per_si: f64,
}

const fn scaled(names: [&'static str; 2], si: [&'static str; 2], per_si: f64) -> ResultUnit {
    let [symbol, suffix] = names;
    let [si_symbol, si_suffix] = si;
    ResultUnit {
        symbol,
        suffix,
        si_symbol,
        si_suffix,
        per_si,
    }
}

const fn si(names: [&'static str; 2]) -> ResultUnit {
    scaled(names, names, 1.0)
}

impl ResultUnit {
    /// A ratio or a count.
    pub const NONE: Self = si(["", ""]);
    /// Length.
    pub const MM: Self = scaled(["mm", "_mm"], ["m", "_m"], 1e3);
    /// Area.
    pub const MM2: Self = scaled(["mm2", "_mm2"], ["m2", "_m2"], 1e6);
    /// Mass.
    pub const G: Self = scaled(["g", "_g"], ["kg", "_kg"], 1e3);
    /// Time.
    pub const US: Self = scaled(["us", "_us"], ["s", "_s"], 1e6);
    /// Time step.
    pub const NS: Self = scaled(["ns", "_ns"], ["s", "_s"], 1e9);
    /// Velocity.
    pub const M_S: Self = si(["m/s", "_m_s"]);
    /// Force.
    pub const KN: Self = scaled(["kN", "_kn"], ["N", "_n"], 1e-3);
    /// Stress.
    pub const MPA: Self = scaled(["MPa", "_mpa"], ["Pa", "_pa"], 1e-6);
    /// Energy.
    pub const J: Self = si(["J", "_j"]);
    /// Momentum.
    pub const N_S: Self = si(["N s", "_n_s"]);
    /// Angle.
    pub const DEG: Self = scaled(["°", "_deg"], ["rad", "_rad"], 180.0 / std::f64::consts::PI);
    /// Temperature.
    pub const K: Self = si(["K", "_k"]);

    /// All units that a name can end with; a longer end comes before one that it ends with.
    pub const NAMED: [Self; 12] = [
        Self::M_S,
        Self::N_S,
        Self::MM,
        Self::MM2,
        Self::G,
        Self::US,
        Self::NS,
        Self::KN,
        Self::MPA,
        Self::J,
        Self::K,
        Self::DEG,
    ];

    /// A number in SI units as one in this unit.
    pub fn of_si(&self, si: f64) -> f64 {
        si * self.per_si
    }

    /// The unit that a name ends with, and the name without it; no unit where it ends with none.
    pub fn split(name: &str) -> (&str, Self) {
        let mut found = Self::NAMED.iter().filter_map(|unit| {
            let quantity = name.strip_suffix(unit.suffix)?;
            Some((quantity, *unit))
        });
        found.next().unwrap_or((name, Self::NONE))
    }
}

#[cfg(test)]
mod tests {
    use super::ResultUnit;

    #[test]
    fn names_end_with_their_unit() {
        for (name, quantity, unit) in [
            ("depth_of_penetration_mm", "depth_of_penetration", "mm"),
            ("residual_velocity_m_s", "residual_velocity", "m/s"),
            ("momentum_support_n_s", "momentum_support", "N s"),
            ("time_step_ns", "time_step", "ns"),
            ("plug_mass_g", "plug_mass", "g"),
            ("crack_area_mm2", "crack_area", "mm2"),
            ("energy_residual", "energy_residual", ""),
        ] {
            let (found, of) = ResultUnit::split(name);
            assert_eq!((found, of.symbol), (quantity, unit), "{name}");
        }
    }
}
