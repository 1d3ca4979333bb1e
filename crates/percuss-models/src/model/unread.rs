//! Options that a model does not read.

use super::{MODELS, Model};

/// Why a change of a key has no effect on a model: it is an option of another one. `None` for a key that the model may read.
pub fn why_unread(model: &dyn Model, key: &str) -> Option<String> {
    let (table, _) = key.split_once('.')?;
    let owner = MODELS.iter().find(|other| other.name() == table)?;
    (!model.reads_options_of(owner.name())).then(|| {
        format!(
            "`{key}` has no effect: model `{}` does not read the table `{table}`",
            model.name()
        )
    })
}

#[cfg(test)]
mod tests {
    use std::{fs, path::Path};

    use super::*;
    use crate::model::model;

    #[test]
    fn options_of_other_models_have_no_effect() {
        let why = |name: &str, key: &str| why_unread(model(name).unwrap(), key);
        assert_eq!(
            why("chain", "tate.target_resistance").unwrap(),
            "`tate.target_resistance` has no effect: model `chain` does not read the table `tate`"
        );
        assert!(why("chain", "fdm.courant").is_some());
        for key in [
            "chain.heat_fraction",
            "fdm.courant",
            "target.thickness",
            "fdm",
        ] {
            assert_eq!(why("fdm", key), None);
        }
    }

    /// What a model says is held against its source: every `options.TABLE` there is of a table that it reads.
    #[test]
    fn a_model_reads_the_tables_that_it_says_it_reads() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let mut read = Vec::new();
        for known in MODELS {
            let name = known.name();
            let places = [
                folder.join(name),
                folder.join("analytic").join(name),
                folder.join("analytic").join(format!("{name}.rs")),
            ];
            let texts: Vec<String> = places.iter().flat_map(|place| texts_of(place)).collect();
            assert!(!texts.is_empty(), "no source of `{name}`");
            for table in MODELS.iter().map(|other| other.name()) {
                let option = format!("options.{table}");
                let is_read = texts.iter().any(|text| {
                    text.match_indices(&option).any(|(at, _)| {
                        let next = text[at + option.len()..].chars().next();
                        !next.is_some_and(|next| next.is_alphanumeric() || next == '_')
                    })
                });
                if is_read {
                    assert!(known.reads_options_of(table), "`{name}` reads `{table}`");
                    read.push((name, table));
                } else if table != name {
                    assert!(!known.reads_options_of(table), "`{name}`, `{table}`");
                }
            }
        }
        assert!(read.contains(&("fdm", "chain")) && read.contains(&("tate", "tate")));
    }

    /// The Rust files of a folder and of the folders in it; a file alone.
    fn texts_of(place: &Path) -> Vec<String> {
        let Ok(entries) = fs::read_dir(place) else {
            return fs::read_to_string(place).into_iter().collect();
        };
        entries
            .flat_map(|entry| texts_of(&entry.unwrap().path()))
            .collect()
    }
}
