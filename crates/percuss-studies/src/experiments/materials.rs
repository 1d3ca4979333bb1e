//! Check that a row makes a case: existing materials, quantities in their ranges.

use super::{Experiment, Struck};
use crate::{
    check::Diagnostic,
    csv_table::CsvRow,
    error::{InputError, Subject},
    material::Library,
};

/// Makes sure that a case can be made of a test with each of its records.
pub(super) fn check(
    test: &Experiment,
    row: &CsvRow<'_>,
    library: &Library,
) -> Result<(), Box<InputError>> {
    let unknown = |column: &str, name: &str, help: &str| {
        let near = library.suggestion(name);
        let error = row.error(
            column,
            library.unknown(name),
            format!("{near}`percuss materials` lists all; {help}"),
        );
        Box::new(InputError {
            subject: Subject::Material,
            ..*error
        })
    };
    for name in &test.projectile_materials {
        if library.find(name).is_none() {
            return Err(unknown(
                "projectile_material",
                name,
                "`--materials FILE.toml` adds your own",
            ));
        }
    }
    if let Struck::Body {
        material,
        properties: None,
        ..
    } = &test.target
        && library.find(material).is_none()
    {
        return Err(unknown(
            "target_material",
            material,
            "`--materials FILE.toml` adds your own; or give its properties, target_density_kg_m3 and so on",
        ));
    }
    for record in &test.projectile_materials {
        if let Err(diagnostics) = test.resolve(record, library) {
            let diagnostic = diagnostics.into_iter().next();
            let diagnostic = diagnostic
                .unwrap_or_else(|| Diagnostic::whole("no case can be made of this row", ""));
            return Err(row.error(
                column_of(&diagnostic.key),
                diagnostic.message,
                diagnostic.help,
            ));
        }
    }
    Ok(())
}

/// The column that a key of a case comes from.
fn column_of(key: &str) -> &'static str {
    let columns = [
        ("projectile.diameter", "diameter_mm"),
        ("projectile.length", "length_mm"),
        ("projectile.mass", "mass_g"),
        ("projectile.nose", "nose_ratio"),
        ("projectile.impact_velocity", "impact_velocity_m_s"),
        ("projectile.temperature", "temperature_k"),
        ("target.thickness", "thickness_mm"),
        ("density", "target_density_kg_m3"),
        ("youngs_modulus", "target_youngs_modulus_gpa"),
        ("poissons_ratio", "target_poissons_ratio"),
        ("ultimate_strength", "target_ultimate_mpa"),
        ("brinell_hardness", "target_brinell_hardness"),
        ("compressive_strength", "target_concrete_strength_mpa"),
        ("exponent", "target_hardening_exponent"),
        ("yield_stress", "target_yield_mpa"),
        ("strength", "target_yield_mpa"),
    ];
    let found = columns.iter().find(|(part, _)| key.contains(part));
    found.map_or("id", |(_, column)| column)
}
