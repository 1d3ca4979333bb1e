//! Default target resistance model of a case.

use super::expanding;
use crate::{
    options::{Scheme, TargetResistanceModel},
    problem::Nose,
    regime::{THIN, TargetKind},
    scenario::{Scenario, TargetBody},
};

/// Sets the target resistance model of a case that gives none; it depends on the rest of the case.
pub fn choose_target_resistance(scenario: &mut Scenario) {
    if !scenario.given.target_resistance {
        scenario.options.chain.target_resistance = None;
        let (resistance, reason) = default_resistance_model(scenario);
        scenario.options.chain.target_resistance = Some(resistance);
        scenario.resistance_reason = reason;
    }
}

/// Target resistance of a case that names none, and why it is not the expanding cavity, which is the default of a flat-ended rod on one
/// layer: against the axisymmetric reference it errs least.
fn default_resistance_model(scenario: &Scenario) -> (TargetResistanceModel, Option<String>) {
    let options = &scenario.options.chain;
    let solid = matches!(scenario.target, TargetBody::Layers { .. });
    if !solid || options.scheme != Scheme::Conservative || scenario.projectile.nose != Nose::Flat {
        return (TargetResistanceModel::Column, None);
    }
    match why_a_column(scenario) {
        None => (TargetResistanceModel::ExpandingCavity, None),
        reason => (TargetResistanceModel::Column, reason),
    }
}

fn why_a_column(scenario: &Scenario) -> Option<String> {
    if let Some(refusal) = expanding::not_applicable(scenario) {
        return Some(refusal.to_string());
    }
    if let Some(key) = scenario.options.chain.asks_for_a_column() {
        return Some(format!(
            "`chain.{key}` differs from its default, and only a column has it"
        ));
    }
    let diameter = scenario.projectile.diameter;
    if let TargetBody::Layers {
        column_diameter, ..
    } = scenario.target
        && column_diameter != diameter
    {
        return Some("`target.column_diameter` is not the projectile's diameter".to_owned());
    }
    (TargetKind::of(scenario) == TargetKind::ThinPlate).then(|| {
        format!(
            "below {THIN} projectile diameters of thickness plugging is favoured [woodward1984]"
        )
    })
}

/// The target resistance model that a run has; `None` where the scheme or the target has no choice of one.
pub fn resistance_model_in_use(scenario: &Scenario) -> Option<TargetResistanceModel> {
    let options = &scenario.options.chain;
    let solid = matches!(scenario.target, TargetBody::Layers { .. });
    (solid && options.scheme == Scheme::Conservative).then(|| options.target_resistance())
}

#[cfg(test)]
mod tests {
    use super::resistance_model_in_use;
    use crate::{
        case::{self, TargetResistanceModel},
        scenario::Scenario,
    };

    const THICK: &str = "material = 'aluminium-2024-t351', thickness = '25 mm'";

    fn load(target: &str, options: &str) -> Scenario {
        let text = format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '230 m/s' }}\n\
             target = {{ {target} }}\n{options}\n"
        );
        case::load_str("impact", &text).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn a_target_of_one_layer_is_a_cavity_unless_the_case_asks_for_a_column() {
        let (column, cavity) = (
            TargetResistanceModel::Column,
            TargetResistanceModel::ExpandingCavity,
        );
        let semi_infinite = "material = 'copper', thickness = 'semi-infinite'";
        for (target, options, expected) in [
            (THICK, "", Some(cavity)),
            (semi_infinite, "", Some(cavity)),
            (
                "material = 'copper', thickness = '4.4 mm'",
                "",
                Some(cavity),
            ),
            (
                "material = 'copper', thickness = '4.3 mm'",
                "",
                Some(column),
            ),
            (
                "layers = [{ material = 'copper', thickness = '30 mm' }, { material = 'copper', thickness = '30 mm' }]",
                "",
                Some(column),
            ),
            (
                "material = 'copper', thickness = '25 mm', column_diameter = '6 mm'",
                "",
                Some(column),
            ),
            (
                "material = 'copper', thickness = '25 mm', column_diameter = '5 mm'",
                "",
                Some(cavity),
            ),
            ("rigid_wall = true", "", None),
            ("constant_pressure = '1 GPa'", "", None),
            (THICK, "chain.target_resistance = 'column'", Some(column)),
            (
                THICK,
                "chain.target_resistance = 'diverging'",
                Some(TargetResistanceModel::Diverging),
            ),
            (THICK, "chain.constraint_factor = 2.6", Some(column)),
            (THICK, "chain.border_shear = 0.5", Some(column)),
            (THICK, "chain.kinematics = 'small-strain'", Some(column)),
            (THICK, "chain.erosion_criterion = 'tate'", Some(column)),
            (THICK, "chain.erosion_strain = 1.5", Some(cavity)),
            (THICK, "chain.projectile_elements = 80", Some(cavity)),
            (THICK, "fdm.border_shear = 0.0", Some(cavity)),
            (THICK, "chain.scheme = 'published'", None),
        ] {
            let scenario = load(target, options);
            assert_eq!(
                resistance_model_in_use(&scenario),
                expected,
                "{target} {options}"
            );
            let by_default = !options.contains("target_resistance");
            let reason = scenario.resistance_reason.is_some();
            assert_eq!(
                reason,
                by_default && expected == Some(column),
                "{target} {options}"
            );
        }
    }

    #[test]
    fn what_never_yields_or_is_not_flat_is_a_column() {
        let elastic = "[materials.e]\nname = 'e'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\n\
                       poissons_ratio = 0.3\nstrength.elastic = {}";
        let scenario = load("material = 'e', thickness = '30 mm'", elastic);
        assert_eq!(
            resistance_model_in_use(&scenario),
            Some(TargetResistanceModel::Column)
        );
        let text = format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', nose = 'hemisphere', impact_velocity = '230 m/s' }}\n\
             target = {{ {THICK} }}\n"
        );
        let scenario = case::load_str("impact", &text).unwrap();
        assert_eq!(
            resistance_model_in_use(&scenario),
            Some(TargetResistanceModel::Column)
        );
    }
}
