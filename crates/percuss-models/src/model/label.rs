//! Names of models in figures.

use std::borrow::Cow;

/// Display names of the models, in the order of the list of models. The names on the command line and in files are other ones.
const LABELS: [(&str, &str); 23] = [
    ("chain", "chain"),
    ("fdm", "finite differences"),
    ("axi", "axisymmetric"),
    ("particles", "bonded particles"),
    ("tate", "Alekseevskii–Tate"),
    ("walker_anderson", "Walker–Anderson"),
    ("lanz_odermatt", "Lanz–Odermatt"),
    ("hydrodynamic", "hydrodynamic"),
    ("forrestal", "Forrestal"),
    ("forrestal_concrete", "Forrestal, concrete"),
    ("cavity_expansion", "cavity expansion"),
    ("poncelet", "Poncelet"),
    ("crater_energy", "crater energy"),
    ("energy_balance", "energy balance"),
    ("momentum_balance", "momentum balance"),
    ("taylor", "Taylor"),
    ("wilkins_guinan", "Wilkins–Guinan"),
    ("plate_cavity", "plate cavity"),
    ("plugging", "plugging"),
    ("recht_ipson", "Recht–Ipson"),
    ("lambert_jonas", "Lambert–Jonas"),
    ("awerbuch_bodner", "Awerbuch–Bodner"),
    ("power_balance", "power balance"),
];

/// Display name of a model for figures; that of a model which is not in the list is its name with spaces. Words after a colon, as in
/// `chain: column`, are kept.
pub fn label(name: &str) -> Cow<'_, str> {
    let (model, more) = match name.find(':') {
        Some(colon) => name.split_at(colon),
        None => (name, ""),
    };
    match LABELS.iter().find(|(known, _)| *known == model) {
        Some((_, label)) if more.is_empty() => Cow::Borrowed(label),
        Some((_, label)) => Cow::Owned(format!("{label}{more}")),
        None => Cow::Owned(name.replace('_', " ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{super::MODELS, LABELS, label};

    #[test]
    fn every_model_has_a_display_name_of_its_own() {
        let models: Vec<&str> = MODELS.iter().map(|model| model.name()).collect();
        assert_eq!(LABELS.map(|(name, _)| name).to_vec(), models);
        for (i, (_, label)) in LABELS.iter().enumerate() {
            assert!(!label.contains('_'), "{label}");
            assert!(LABELS[..i].iter().all(|(_, other)| other != label));
        }
    }

    #[test]
    fn variants_and_models_of_users_have_display_names() {
        assert_eq!(label("crater_energy"), "crater energy");
        assert_eq!(label("chain: column"), "chain: column");
        assert_eq!(label("fdm: rod"), "finite differences: rod");
        assert_eq!(label("my_model"), "my model");
    }
}
