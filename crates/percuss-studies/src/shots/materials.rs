//! Whether a case can be made of a row: materials that exist, quantities in their ranges.

use super::{Shot, Struck, row::Row};
use crate::{
    check::Finding,
    error::{InputError, Subject},
    material::Library,
    units::shorten,
};

/// Makes sure that a case can be made of a shot with each of its records.
pub(super) fn check(shot: &Shot, row: &Row<'_>, library: &Library) -> Result<(), Box<InputError>> {
    let unknown = |column: &str, name: &str, help: &str| {
        let near = library.suggestion(name);
        let error = row.error(
            column,
            format!("no material is named `{}`", shorten(name)),
            format!("{near}`percuss materials` lists all; {help}"),
        );
        Box::new(InputError {
            subject: Subject::Material,
            ..*error
        })
    };
    for name in &shot.projectile_materials {
        if library.find(name).is_none() {
            return Err(unknown(
                "projectile_material",
                name,
                "a file of materials can add your own",
            ));
        }
    }
    if let Struck::Body {
        material,
        properties: None,
        ..
    } = &shot.target
        && library.find(material).is_none()
    {
        return Err(unknown(
            "target_material",
            material,
            "or give its properties, target_density_kg_m3 and so on",
        ));
    }
    for record in &shot.projectile_materials {
        if let Err(findings) = shot.resolve(record, library) {
            let finding = findings.into_iter().next();
            let finding =
                finding.unwrap_or_else(|| Finding::whole("no case can be made of this row", ""));
            return Err(row.error(column_of(&finding.key), finding.message, finding.help));
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
        ("projectile.velocity", "impact_velocity_m_s"),
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
