//! Former names of keys: a file with one gets an error that names the key of today.

/// Keys of a case and of a file of materials: the former name and that of today. A `*` is the index of an entry of a
/// list, or the id of a material.
const RENAMED: [(&str, &str); 6] = [
    ("projectile.velocity", "projectile.impact_velocity"),
    ("experiments.*.velocity", "experiments.*.impact_velocity"),
    ("chain.target_closure", "chain.target_resistance"),
    ("chain.erosion_closure", "chain.erosion_criterion"),
    (
        "materials.*.calibrated.shots",
        "materials.*.calibrated.tests",
    ),
    ("*.calibrated.shots", "*.calibrated.tests"),
];

/// A former key and its name of today.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Renamed {
    former: String,
    today: String,
}

impl Renamed {
    /// The new name of a dotted key; `None` for all other keys.
    pub fn of(key: &str) -> Option<Self> {
        let parts: Vec<&str> = key.split('.').collect();
        let (_, today) = RENAMED.iter().find(|(former, _)| matches(former, &parts))?;
        let whole = today.split('.').zip(&parts).map(|(name, part)| match name {
            "*" => *part,
            name => name,
        });
        Some(Self {
            former: key.to_owned(),
            today: whole.collect::<Vec<_>>().join("."),
        })
    }

    /// The same of the last parts of both, which is what a table of keys has.
    pub fn in_its_table(self) -> Self {
        let last = |key: String| key.rsplit('.').next().unwrap_or_default().to_owned();
        Self {
            former: last(self.former),
            today: last(self.today),
        }
    }

    /// What is wrong.
    pub fn message(&self) -> String {
        format!("the key `{}` was renamed", self.former)
    }

    /// What to do.
    pub fn help(&self) -> String {
        format!("write `{}`; its values and units are the same", self.today)
    }
}

fn matches(pattern: &str, parts: &[&str]) -> bool {
    let names: Vec<&str> = pattern.split('.').collect();
    let same = |(name, part): (&&str, &&str)| *name == "*" || name == part;
    names.len() == parts.len() && names.iter().zip(parts).all(same)
}
