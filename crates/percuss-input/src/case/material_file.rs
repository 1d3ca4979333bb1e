//! Files of materials: records under `[NAME]`, or under `[materials.NAME]` as in a case.

use std::{fmt, path::Path};

use serde::{Deserialize, Deserializer, de};

use super::Document;
use crate::{
    check::Check,
    error::Error,
    material::{Material, MaterialTable},
};

/// Table that a case keeps its materials in.
pub(super) const TABLE: &str = "materials";

/// The records of a file with the tables that they stand in.
#[derive(Debug, Default)]
struct MaterialFile {
    /// Under `[NAME]`.
    plain: MaterialTable,
    /// Under `[materials.NAME]`.
    nested: MaterialTable,
}

impl<'de> Deserialize<'de> for MaterialFile {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;

        impl<'de> de::Visitor<'de> for Visitor {
            type Value = MaterialFile;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("tables of materials")
            }

            fn visit_map<A: de::MapAccess<'de>>(
                self,
                mut map: A,
            ) -> Result<MaterialFile, A::Error> {
                let mut file = MaterialFile::default();
                while let Some(id) = map.next_key::<String>()? {
                    match id.as_str() {
                        TABLE => file.nested = map.next_value()?,
                        _ => {
                            let material: Material = map.next_value()?;
                            file.plain.insert(id, material);
                        }
                    }
                }
                Ok(file)
            }
        }

        deserializer.deserialize_map(Visitor)
    }
}

/// Reads a file of materials.
///
/// # Errors
/// [`Error::Read`] when it cannot be read, [`Error::Input`] when its content is not valid.
pub fn load_materials(path: impl AsRef<Path>) -> Result<MaterialTable, Error> {
    read(&Document::read(path)?.of_materials())
}

/// Records as a file of materials.
pub fn materials_toml(records: &MaterialTable) -> String {
    // A material holds nothing that TOML could not.
    toml::to_string(records).unwrap_or_default()
}

fn read(document: &Document) -> Result<MaterialTable, Error> {
    let MaterialFile { plain, nested } = document.parse()?;
    let mut diagnostics = Vec::new();
    let mut check = Check::new(&mut diagnostics);
    for (id, material) in &plain {
        material.check(&mut check.within(id));
        if nested.contains_key(id) {
            check.of_material().fail(
                id,
                format!("the material `{id}` is given twice: as [{id}] and as [{TABLE}.{id}]"),
                "keep one of the two tables",
            );
        }
    }
    for (id, material) in &nested {
        material.check(&mut check.within(TABLE).within(id));
    }
    document.report(diagnostics)?;
    Ok(plain.into_iter().chain(nested).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECORD: &str = "name = 'Foam'\ndensity = '30 kg/m3'\nyoungs_modulus = '20 MPa'\npoissons_ratio = 0.1\n\
                          strength.perfectly_plastic.flow_stress = '400 kPa'\n";

    fn read_text(text: &str) -> Result<MaterialTable, Error> {
        read(&Document::new("mine.toml", text).of_materials())
    }

    #[test]
    fn records_stand_under_their_name_or_as_in_a_case() {
        let plain = read_text(&format!("[foam]\n{RECORD}")).unwrap();
        let nested = read_text(&format!("[materials.foam]\n{RECORD}")).unwrap();
        assert_eq!(plain, nested);
        let both = read_text(&format!("[a]\n{RECORD}\n[materials.b]\n{RECORD}")).unwrap();
        assert_eq!(both.keys().collect::<Vec<_>>(), ["a", "b"]);
    }

    #[test]
    fn errors_name_the_table_that_is_written() {
        let wrong = RECORD.replace("0.1", "0.7");
        for (header, key) in [
            ("[foam]", "`foam.poissons_ratio`"),
            ("[materials.foam]", "`materials.foam.poissons_ratio`"),
        ] {
            let error = read_text(&format!("{header}\n{wrong}"))
                .unwrap_err()
                .to_string();
            assert!(
                error.starts_with("mine.toml:5:") && error.contains(key),
                "{error}"
            );
        }
        let twice = read_text(&format!("[foam]\n{RECORD}\n[materials.foam]\n{RECORD}"));
        let error = twice.unwrap_err().to_string();
        assert!(error.contains("`foam` is given twice"), "{error}");
    }
}
