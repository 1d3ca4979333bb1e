//! Expected error of a ballistic limit: the errors of its model on published limits of the same kind.

use std::{
    f64::consts::PI,
    sync::{LazyLock, OnceLock},
};

use serde::Serialize;

use crate::{
    Scenario,
    experiments::{self, Kind, Split},
    material::{Library, Material},
    model::{Model, fast_models},
    model_error::ModelErrorEstimate,
    outcome::BandQuantity,
    regime::{ProjectileRegime, Regime, STRENGTH_STRAIN, TargetKind, at_least, nose_factor},
    validate::{self, Standing},
    validity::{Measure, NoseKind, Range},
};

/// Fewest published limits that an expected error rests on.
const FEWEST: usize = 5;
/// Factor by which densities and Young's moduli of plates of the same kind of metal differ at most.
const SAME_METAL: f64 = 1.3;
/// Factor by which flow stresses of plates that are about as strong differ at most.
const SAME_STRENGTH: f64 = 2.0;
/// Difference of angles to the normal that are about the same, at most [rad].
const SAME_ANGLE: f64 = 10.0 * PI / 180.0;
/// Factor by which the shape factors of noses that are about as sharp differ at most.
const SAME_NOSE: f64 = 2.0;

/// Expected error of a ballistic limit; plain numbers, 0.1 for a limit 10 % too high. The names are stable.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExpectedLimitError {
    /// Median and 10th and 90th percentile of the errors, and how many there are.
    #[serde(flatten)]
    pub errors: ModelErrorEstimate,
    /// Errors on limits that the model was neither fitted to nor chosen on.
    pub blind: usize,
    /// What the published limits have in common with the case.
    pub kind: String,
}

impl ExpectedLimitError {
    /// The error and its basis in words.
    pub fn describe(&self) -> String {
        let count = self.errors.cases;
        let blind = match self.blind {
            0 => "; not blind: the model was fitted to or chosen on them".to_owned(),
            blind if blind < count => format!("; {blind} of them blind"),
            _ => String::new(),
        };
        format!(
            "{}, from {count} published limits of {}{blind}",
            self.errors.describe(),
            self.kind
        )
    }
}

/// What published limits are compared by.
#[derive(Debug, Clone, PartialEq)]
struct Plate {
    is_flat: bool,
    nose_factor: f64,
    projectile: ProjectileRegime,
    target: TargetKind,
    density: f64,
    youngs_modulus: f64,
    flow_stress: f64,
    /// Angle between the path and the normal of the plate [rad].
    obliquity: f64,
}

impl Plate {
    /// The kind of a case at its impact velocity; `None` unless one plate is struck, at the temperature of the published limits.
    fn of(scenario: &Scenario) -> Option<Self> {
        if scenario.is_heated() {
            return None;
        }
        let layer = scenario.only_layer()?;
        let regime = Regime::of(scenario);
        let material: &Material = &layer.material;
        Some(Self {
            is_flat: NoseKind::of(scenario.projectile.nose) == NoseKind::Flat,
            nose_factor: nose_factor(scenario.projectile.nose),
            projectile: regime.projectile,
            target: regime.target,
            density: material.density.si(),
            youngs_modulus: material.youngs_modulus.si(),
            flow_stress: material.flow_stress(STRENGTH_STRAIN)?,
            obliquity: scenario.obliquity,
        })
    }

    fn is_of_metal(&self, other: &Self) -> bool {
        let near = |a: f64, b: f64, factor: f64| (a / b).max(b / a) <= factor;
        near(self.density, other.density, SAME_METAL)
            && near(self.youngs_modulus, other.youngs_modulus, SAME_METAL)
            && near(self.flow_stress, other.flow_stress, SAME_STRENGTH)
    }

    /// Whether the other one is of such a metal and struck by such a nose at such an angle: errors on others say nothing.
    fn is_like(&self, other: &Self) -> bool {
        let sharper = self.nose_factor / other.nose_factor;
        let is_as_sharp =
            at_least(sharper, 1.0 / SAME_NOSE) && at_least(1.0 / sharper, 1.0 / SAME_NOSE);
        let turned = (self.obliquity - other.obliquity).abs();
        other.is_flat == self.is_flat
            && is_as_sharp
            && at_least(SAME_ANGLE, turned)
            && self.is_of_metal(other)
    }

    /// What the plates of the published limits have in common with it in any case.
    fn metal(&self) -> &'static str {
        match self.obliquity == 0.0 {
            true => "such a metal, about as strong",
            false => "such a metal, about as strong, at about such an angle",
        }
    }

    fn nose(&self) -> &'static str {
        match self.is_flat {
            true => "flat noses",
            false => "noses about as sharp",
        }
    }
}

/// Error of a model on a published limit.
#[derive(Debug, Clone)]
struct LimitError {
    source: String,
    is_blind: bool,
    plate: Plate,
    error: f64,
}

/// Published limits that a case can be made of: the number of the test and its plate.
static PUBLISHED: LazyLock<Vec<(usize, Plate)>> = LazyLock::new(|| {
    let tests = experiments::built_in().iter().enumerate();
    let limits = tests.filter(|(_, test)| test.kind == Kind::BallisticLimit);
    limits
        .filter_map(|(index, test)| {
            let scenario = validate::main_scenario(test, Library::built_in()).ok()?;
            Some((index, Plate::of(&scenario)?))
        })
        .collect()
});

/// A model with its errors on [`PUBLISHED`], each once it is asked for; `None` where it does not count.
type ErrorsOf = (&'static dyn Model, Vec<OnceLock<Option<LimitError>>>);

/// The fast models that predict limits.
static ERRORS: LazyLock<Vec<ErrorsOf>> = LazyLock::new(|| {
    let models = fast_models().into_iter().filter(|model| {
        let predicts = model.validity().predicts;
        predicts.contains(&BandQuantity::BallisticLimit)
    });
    let none_yet = || PUBLISHED.iter().map(|_| OnceLock::new()).collect();
    models.map(|model| (model, none_yet())).collect()
});

/// Errors of a fast model on the published limits that count and whose plates are wanted; none of another model. The runs of other plates
/// are not made.
fn errors_of(model: &str, is_wanted: impl Fn(&Plate) -> bool) -> Vec<&'static LimitError> {
    let Some((model, errors)) = ERRORS.iter().find(|(of, _)| of.name() == model) else {
        return Vec::new();
    };
    let published = PUBLISHED.iter().zip(errors);
    let wanted = published.filter(|((_, plate), _)| is_wanted(plate));
    let computed = wanted.map(|((test, plate), error)| {
        error
            .get_or_init(|| published_error(*model, *test, plate))
            .as_ref()
    });
    computed.flatten().collect()
}

fn published_error(model: &'static dyn Model, index: usize, plate: &Plate) -> Option<LimitError> {
    let test = &experiments::built_in()[index];
    let prediction = validate::with_main_record(model, index, test, Library::built_in());
    let counted = prediction.standing == Standing::Counted;
    Some(LimitError {
        source: test.source.clone(),
        is_blind: prediction.split == Split::Blind,
        plate: plate.clone(),
        error: prediction.relative_error.filter(|_| counted)?,
    })
}

/// Expected error of the limit that a model finds for a case; `None` where fewer than five published limits are of its kind.
/// Limits of a source that the case's own experiments cite are left out.
pub(super) fn expected_error(
    model: &dyn Model,
    scenario: &Scenario,
    limit: f64,
) -> Option<ExpectedLimitError> {
    let predicts = model.validity().predicts;
    if !predicts.contains(&BandQuantity::BallisticLimit) {
        return None;
    }
    let at_limit = scenario.at_impact_velocity(limit);
    // No published plate is thinner than the range of its model: their errors say nothing of one that is.
    let thickness = Measure::ThicknessToDiameter;
    let is_thinner = |range: &Range| {
        let ratio = thickness
            .of(&at_limit)
            .filter(|_| range.measure == thickness);
        ratio.is_some_and(|ratio| !at_least(ratio, range.min))
    };
    if model.validity_for(&at_limit).ranges.iter().any(is_thinner) {
        return None;
    }
    let plate = Plate::of(&at_limit)?;
    let is_own = |source: &String| {
        let mut cited = scenario.experiments.iter().flat_map(|e| &e.sources);
        cited.any(|cited| cited == source)
    };
    let mut errors = errors_of(model.name(), |other| plate.is_like(other));
    errors.retain(|error| !is_own(&error.source));
    expected_among(&errors, &plate)
}

/// A condition on published limits, and what it is in words.
type Level<'a> = (Box<dyn Fn(&Plate) -> bool + 'a>, String);

/// The expected error from the narrowest kind that has enough errors.
fn expected_among(errors: &[&LimitError], plate: &Plate) -> Option<ExpectedLimitError> {
    let metal = move |other: &Plate| plate.is_like(other);
    let thickness = move |other: &Plate| metal(other) && other.target == plate.target;
    let regime = move |other: &Plate| thickness(other) && other.projectile == plate.projectile;
    let (shape, kind, metal_in_words) = (plate.nose(), plate.target.describe(), plate.metal());
    let levels: [Level<'_>; 3] = [
        (
            Box::new(regime),
            format!(
                "{} projectiles with {shape} on {kind} of {metal_in_words}",
                plate.projectile.describe()
            ),
        ),
        (
            Box::new(thickness),
            format!("projectiles with {shape} on {kind} of {metal_in_words}"),
        ),
        (
            Box::new(metal),
            format!("projectiles with {shape} on plates of any thickness, of {metal_in_words}"),
        ),
    ];
    levels.into_iter().find_map(|(is_of, kind)| {
        let alike: Vec<&&LimitError> = errors.iter().filter(|e| is_of(&e.plate)).collect();
        if alike.len() < FEWEST {
            return None;
        }
        Some(ExpectedLimitError {
            errors: ModelErrorEstimate::of(alike.iter().map(|error| error.error)),
            blind: alike.iter().filter(|error| error.is_blind).count(),
            kind,
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{case, model, problem::Nose};

    fn error(density: f64, target: TargetKind, error: f64) -> LimitError {
        LimitError {
            source: "one".to_owned(),
            is_blind: error > 0.05,
            plate: Plate {
                is_flat: true,
                nose_factor: 1.0,
                projectile: ProjectileRegime::Rigid,
                target,
                density,
                youngs_modulus: 26e6 * density,
                flow_stress: 1e5 * density,
                obliquity: 0.0,
            },
            error,
        }
    }

    #[test]
    fn the_narrowest_kind_with_enough_limits_decides() {
        let steel = (0..5).map(|i| error(7850.0, TargetKind::Plate, -0.3 + 0.1 * f64::from(i)));
        let thin = (0..4).map(|_| error(7850.0, TargetKind::ThinPlate, -0.5));
        let light = (0..6).map(|_| error(2700.0, TargetKind::ThinPlate, 0.4));
        let all: Vec<LimitError> = steel.chain(thin).chain(light).collect();
        let errors: Vec<&LimitError> = all.iter().collect();
        let of = |plate: &Plate| expected_among(&errors, plate).unwrap();
        let medium = of(&all[0].plate);
        assert_eq!((medium.errors.cases, medium.blind), (5, 1));
        assert!((medium.errors.median + 0.1).abs() < 1e-12);
        assert!(medium.kind.contains("rigid projectiles"), "{}", medium.kind);
        // Four thin steel plates are too few: all of steel are taken.
        let thin = of(&all[5].plate);
        assert_eq!(thin.errors.cases, 9);
        assert!(thin.kind.contains("of any thickness"), "{}", thin.kind);
        let copper = Plate {
            density: 8960.0,
            youngs_modulus: 124e9,
            ..all[0].plate.clone()
        };
        // Errors on one metal give no estimate for another one.
        assert_eq!(expected_among(&errors, &copper), None);
        let sharp = Plate {
            is_flat: false,
            ..all[0].plate.clone()
        };
        assert_eq!(expected_among(&errors, &sharp), None);
        // Cores of an ogive nose of 3 calibres say nothing of a hemisphere, nor of a blunt cone; a cone of 40 degrees is about as sharp.
        let nose = |nose: Nose| Plate {
            is_flat: false,
            nose_factor: nose_factor(nose),
            ..all[0].plate.clone()
        };
        let cone = |half_angle: f64| Nose::Cone {
            length_to_diameter: 0.5 / half_angle.to_radians().tan(),
        };
        let ogive = nose(Nose::Ogive { crh: 3.0 });
        let is_like = |other: Nose| (ogive.is_like(&nose(other)), nose(other).is_like(&ogive));
        assert_eq!(is_like(cone(20.0)), (true, true));
        // Hard armour says nothing of soft steel, nor a plate at 45 degrees of one at 30.
        let (soft, hard) = (&all[0].plate, 2.5 * all[0].plate.flow_stress);
        let harder = Plate {
            flow_stress: hard,
            ..soft.clone()
        };
        let at = |degrees: f64| Plate {
            obliquity: degrees.to_radians(),
            ..soft.clone()
        };
        assert!(!soft.is_like(&harder) && !harder.is_like(soft));
        assert!(at(30.0).is_like(&at(40.0)) && !at(30.0).is_like(&at(45.0)));
        assert!(!soft.is_like(&at(30.0)));
        for other in [Nose::Hemisphere, cone(70.0), cone(5.0)] {
            assert_eq!(is_like(other), (false, false), "{other:?}");
        }
    }

    /// The errors are those of the validation, limit by limit.
    #[test]
    fn errors_are_those_of_the_validation() {
        for name in ["plugging", "awerbuch_bodner", "plate_cavity"] {
            let model = model::model(name).unwrap();
            let limits: Vec<experiments::Experiment> = experiments::built_in()
                .iter()
                .filter(|test| test.kind == Kind::BallisticLimit)
                .cloned()
                .collect();
            let go_on = |_| std::ops::ControlFlow::Continue(());
            let validation = validate::run(&[model], &limits, Library::built_in(), &go_on).unwrap();
            let counted = |p: &&validate::Prediction| p.standing == Standing::Counted;
            let main = validation.predictions.iter().filter(|p| p.main_record);
            let expected: Vec<f64> = main
                .filter(counted)
                .filter_map(|p| p.relative_error)
                .collect();
            let found = errors_of(name, |_| true);
            let found: Vec<f64> = found.iter().map(|error| error.error).collect();
            assert!(found.len() > 30, "{name}: {}", found.len());
            assert_eq!(found, expected, "{name}");
        }
    }

    #[test]
    fn a_limit_of_its_own_source_gives_no_estimate() {
        let of = |plate: &str, name: &str, more: &str| {
            let text = format!(
                "projectile = {{ material = 'tool-steel-hrc53', mass = '50 g', diameter = '20 mm', impact_velocity = '300 m/s' }}\n\
                 target = {{ material = '{plate}', thickness = '24 mm' }}\n{more}"
            );
            let scenario = case::load_str("blunt", &text).unwrap();
            let model = model::model(name).unwrap();
            expected_error(model, &scenario, 400.0)
        };
        let own = "[[experiments]]\nballistic_limit = '400 m/s'\nsource = 'gallardy2016'\n";
        let light = "aluminium-2024-t351";
        let all = of(light, "plugging", "").unwrap();
        let others = of(light, "plugging", own).unwrap();
        assert!(others.errors.cases < all.errors.cases, "{others:?} {all:?}");
        assert!(all.blind == all.errors.cases && all.describe().contains("published limits"));
        // Four published limits of flat noses on steel are too few; limits of the chain have not been compared.
        assert_eq!(of("weldox-460-e", "plugging", ""), None);
        assert_eq!(of(light, "chain", ""), None);
    }
}
