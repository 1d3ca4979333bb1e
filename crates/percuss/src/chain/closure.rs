//! What stands for the target of a case that does not say.

use super::expanding;
use crate::{
    case::{Nose, Scheme, TargetClosure},
    regime::TargetKind,
    scenario::{Scenario, TargetBody},
};

/// The closure of a case that names none: an expanding cavity in a thick target of one metal, where it errs least against the
/// axisymmetric reference, unless the case gives an option that only a column has; a column everywhere else.
///
/// `column_diameter` says whether the case gives one.
pub(crate) fn default_closure(scenario: &Scenario, column_diameter: bool) -> TargetClosure {
    let options = &scenario.options.chain;
    let judged = options.scheme == Scheme::Conservative
        && scenario.projectile.nose == Nose::Flat
        && matches!(
            TargetKind::of(scenario),
            TargetKind::SemiInfinite | TargetKind::ThickPlate
        )
        && expanding::not_applicable(scenario).is_none();
    if judged && !column_diameter && !options.asks_for_a_column() {
        TargetClosure::ExpandingCavity
    } else {
        TargetClosure::Column
    }
}

/// The closure that a run has; `None` where the scheme or the target has no choice of one.
pub(crate) fn closure_in_use(scenario: &Scenario) -> Option<TargetClosure> {
    let options = &scenario.options.chain;
    let solid = matches!(scenario.target, TargetBody::Layers { .. });
    (solid && options.scheme == Scheme::Conservative).then(|| options.target_closure())
}

#[cfg(test)]
mod tests {
    use super::closure_in_use;
    use crate::{
        case::{self, TargetClosure},
        scenario::Scenario,
    };

    const THICK: &str = "material = 'aluminium-2024-t351', thickness = '25 mm'";

    fn load(target: &str, options: &str) -> Scenario {
        let text = format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', velocity = '230 m/s' }}\n\
             target = {{ {target} }}\n{options}\n"
        );
        case::load_str("shot", &text).unwrap_or_else(|error| panic!("{error}"))
    }

    #[test]
    fn a_thick_target_is_a_cavity_unless_the_case_asks_for_a_column() {
        let (column, cavity) = (TargetClosure::Column, TargetClosure::ExpandingCavity);
        let semi_infinite = "material = 'copper', thickness = 'semi-infinite'";
        for (target, options, expected) in [
            (THICK, "", Some(cavity)),
            (semi_infinite, "", Some(cavity)),
            (
                "material = 'copper', thickness = '24.9 mm'",
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
            ("rigid_wall = true", "", None),
            ("constant_pressure = '1 GPa'", "", None),
            (THICK, "chain.target_closure = 'column'", Some(column)),
            (
                THICK,
                "chain.target_closure = 'diverging'",
                Some(TargetClosure::Diverging),
            ),
            (THICK, "chain.constraint_factor = 2.7", Some(column)),
            (THICK, "chain.border_shear = 0.577", Some(column)),
            (THICK, "chain.kinematics = 'logarithmic'", Some(column)),
            (THICK, "chain.damping_ratio = 0.0", Some(column)),
            (
                THICK,
                "chain.artificial_viscosity.linear = 0.1",
                Some(column),
            ),
            (THICK, "chain.erosion_closure = 'tate'", Some(column)),
            (THICK, "chain.erosion_closure = 'strain'", Some(cavity)),
            (THICK, "chain.erosion_strain = 1.5", Some(cavity)),
            (THICK, "chain.projectile_elements = 80", Some(cavity)),
            (THICK, "fdm.border_shear = 0.0", Some(cavity)),
            (THICK, "chain.scheme = 'published'", None),
        ] {
            let scenario = load(target, options);
            assert_eq!(closure_in_use(&scenario), expected, "{target} {options}");
        }
    }

    #[test]
    fn what_never_yields_or_is_not_flat_is_a_column() {
        let elastic = "[materials.e]\nname = 'e'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\n\
                       poissons_ratio = 0.3\nstrength.elastic = {}";
        let scenario = load("material = 'e', thickness = '30 mm'", elastic);
        assert_eq!(closure_in_use(&scenario), Some(TargetClosure::Column));
        let text = format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '5 mm', nose = 'hemisphere', velocity = '230 m/s' }}\n\
             target = {{ {THICK} }}\n"
        );
        let scenario = case::load_str("shot", &text).unwrap();
        assert_eq!(closure_in_use(&scenario), Some(TargetClosure::Column));
    }
}
