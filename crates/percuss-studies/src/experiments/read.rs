//! Files of tests.

use std::{collections::BTreeMap, path::Path};

use super::{
    Experiment, Kind, Properties, Split, Strength, Struck,
    columns::{COLUMNS, MEASURED, RIGID_WALL, SEMI_INFINITE, known, known_measured},
    materials,
};
use crate::{
    csv_table::{CsvRow, CsvTable, KnownColumn, recognise},
    document::read_text,
    error::{Error, InputError},
    material::{Library, Trust},
    problem::Nose,
    units::{plain_name, shorten},
};

/// Tests of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct TestFile<T> {
    /// The tests, in the order of the rows.
    pub tests: Vec<T>,
    /// Columns of other names, which nothing reads.
    pub unread_columns: Vec<String>,
    /// Columns with other names or units than those of the program, each as `` `V0 (ft/s)` as `impact_velocity_m_s`, converted ``.
    pub read_as: Vec<String>,
}

/// Reads a file of tests whose materials a library has; [`COLUMNS`] says what it holds. Other columns are not read.
///
/// # Errors
/// [`Error::Read`] when it cannot be read, [`Error::Input`] with the place when its content is not valid.
pub fn read(path: impl AsRef<Path>, library: &Library) -> Result<TestFile<Experiment>, Error> {
    let path = path.as_ref();
    file(&path.display().to_string(), &read_text(path)?, library)
}

/// Reads tests from a text; `name` stands for the file in messages.
///
/// # Errors
/// [`Error::Input`] with the place when the text is not valid.
pub fn read_str(name: &str, text: &str, library: &Library) -> Result<Vec<Experiment>, Error> {
    Ok(file(name, text, library)?.tests)
}

pub(super) fn file(
    name: &str,
    text: &str,
    library: &Library,
) -> Result<TestFile<Experiment>, Error> {
    let (mut table, records) = CsvTable::read(name, text)?;
    let required = COLUMNS.iter().filter(|column| column.required);
    let mut required: Vec<&str> = required.map(|column| column.name).collect();
    let mut known = known();
    if !table
        .header
        .iter()
        .any(|name| plain_name(name) == "measured")
    {
        let of_kinds: Vec<KnownColumn<'_>> = known_measured().collect();
        let has_any = recognise(&table, &of_kinds, &[])?
            .columns
            .iter()
            .any(Option::is_some);
        if has_any {
            required.retain(|name| !["kind", "measured", "unit"].contains(name));
            known.extend(of_kinds);
        }
    }
    let recognised = recognise(&table, &known, &required)?;
    table.adopt(&recognised, &known);
    let mut tests: Vec<Experiment> = Vec::new();
    let mut rows: BTreeMap<String, CsvRow<'_>> = BTreeMap::new();
    for record in records {
        let row = CsvRow {
            table: &table,
            record,
        };
        let test = test(&row, tests.len() + 1, library)?;
        if rows.contains_key(&test.id) {
            return Err(row
                .error(
                    "id",
                    format!("a second test is named `{}`", shorten(&test.id)),
                    "give it another id",
                )
                .into());
        }
        rows.insert(test.id.clone(), row);
        tests.push(test);
    }
    for test in &tests {
        let (Some(first), Some(row)) = (&test.duplicate_of, rows.get(&test.id)) else {
            continue;
        };
        if first == &test.id || !rows.contains_key(first) {
            return Err(row
                .error(
                    "duplicate_of",
                    format!("no other test of this file is named `{}`", shorten(first)),
                    "write the id of the row that it repeats, or leave it empty",
                )
                .into());
        }
    }
    if tests.is_empty() {
        return Err(table
            .error(
                0..0,
                "",
                "the file holds no test",
                "write one row per test below the header",
            )
            .into());
    }
    Ok(TestFile {
        tests,
        unread_columns: recognised.unread,
        read_as: recognised.read_as,
    })
}

fn test(row: &CsvRow<'_>, number: usize, library: &Library) -> Result<Experiment, Box<InputError>> {
    if row.record.len() != row.table.header.len() {
        return Err(row.error(
            "id",
            format!(
                "the row has {} fields, and the first line names {}",
                row.record.len(),
                row.table.header.len()
            ),
            "a field with a separator of columns in it stands in double quotes",
        ));
    }
    let (kind, measured, measured_column) = measured(row)?;
    let unusable = row.optional("unusable");
    let usable = unusable.is_none();
    let impact_velocity = match row.number("impact_velocity_m_s")? {
        Some(velocity) => velocity,
        None if kind == Kind::BallisticLimit => measured,
        None => row.required_number("impact_velocity_m_s")?,
    };
    let scaled = |column: &str, factor: f64| row.number(column).map(|v| v.map(|v| v * factor));
    let (length, mass) = (scaled("length_mm", 1e-3)?, scaled("mass_g", 1e-3)?);
    if usable && length.is_some() == mass.is_some() {
        return Err(row.error(
            "mass_g",
            "a projectile has either `length_mm` or `mass_g`",
            "with the material's density one follows from the other: fill in one of them",
        ));
    }
    if let (Kind::Taylor, Some(length)) = (kind, length)
        && measured > length
    {
        return Err(row.error(
            measured_column,
            format!(
                "the final length is larger than the length of {} mm",
                row.text("length_mm")
            ),
            "a rod becomes shorter: are the two columns exchanged?",
        ));
    }
    if kind == Kind::ResidualVelocity && measured > impact_velocity {
        return Err(row.error(
            measured_column,
            "the residual velocity is larger than the impact velocity",
            format!(
                "the impact velocity is {} m/s",
                row.text("impact_velocity_m_s")
            ),
        ));
    }
    let diameter = scaled("diameter_mm", 1e-3)?;
    if usable {
        row.required_number("diameter_mm")?;
        row.required("projectile_material")?;
    }
    let test = Experiment {
        id: match row.table.has("id") {
            true => row.required("id")?,
            false => format!("row {number}"),
        },
        source: row.text("source").to_owned(),
        read_at: row.text("read_at").to_owned(),
        licence: row.text("licence").to_owned(),
        kind,
        projectile_class: row
            .optional("projectile_class")
            .unwrap_or_else(|| row.text("projectile_material").to_owned()),
        projectile_materials: row
            .text("projectile_material")
            .split_whitespace()
            .map(str::to_owned)
            .collect(),
        nose: nose(row)?,
        length,
        diameter,
        mass,
        temperature: row.number("temperature_k")?,
        impact_velocity,
        obliquity_deg: row.number("obliquity_deg")?.unwrap_or(0.0),
        target: target(row, kind)?,
        measured,
        uncertainty: row
            .difference("uncertainty", measured_column)?
            .map(|value| value / kind.shown(1.0)),
        trust: row
            .word(
                "trust",
                &[("A", Trust::A), ("B", Trust::B), ("C", Trust::C)],
            )?
            .unwrap_or_default(),
        split: row
            .word(
                "split",
                &[Split::Blind, Split::Calibration].map(|split| (split.name(), split)),
            )?
            .unwrap_or(Split::Blind),
        flag: row.optional("flag"),
        duplicate_of: row.optional("duplicate_of"),
        unusable,
        note: row.text("note").to_owned(),
    };
    if usable {
        materials::check(&test, row, library)?;
    }
    Ok(test)
}

/// Kind of a test, its measured value in SI units and the column of that.
fn measured(row: &CsvRow<'_>) -> Result<(Kind, f64, &'static str), Box<InputError>> {
    let mut kind = row.word("kind", &Kind::ALL.map(|kind| (kind.name(), kind)))?;
    let column = if row.table.has("measured") {
        "measured"
    } else {
        let filled = MEASURED.into_iter().filter(|(of, column)| {
            kind.is_none_or(|kind| kind == *of) && !row.text(column).is_empty()
        });
        let filled: Vec<(Kind, &str)> = filled.collect();
        match filled.as_slice() {
            [(of, column)] => {
                kind = Some(*of);
                *column
            }
            [] => {
                let message = "the row has no measured value";
                let columns: Vec<&str> = MEASURED.map(|(_, column)| column).to_vec();
                let help = format!("fill in one of {}", columns.join(", "));
                return Err(row.error(kind.map_or("id", |_| "kind"), message, help));
            }
            [_, (_, column), ..] => {
                let message = "the row has more than one measured value";
                let help = "give every value a row of its own, or add a column `kind`";
                return Err(row.error(column, message, help));
            }
        }
    };
    let kind = kind.ok_or_else(|| {
        row.error(
            "kind",
            "`kind` is empty",
            "allowed: taylor, ballistic_limit, depth, residual_velocity",
        )
    })?;
    if column == "measured" {
        row.required("unit")?;
        row.word("unit", &[(kind.unit(), ())])?;
    }
    let measured = row.required_number(column)? / kind.shown(1.0);
    if measured < 0.0 || (measured == 0.0 && kind != Kind::ResidualVelocity) {
        return Err(row.error(
            column,
            format!("{} is out of range", row.text(column)),
            "only a residual velocity can be 0, and nothing less than that",
        ));
    }
    Ok((kind, measured, column))
}

fn nose(row: &CsvRow<'_>) -> Result<Nose, Box<InputError>> {
    #[derive(Clone, Copy)]
    enum Shape {
        Flat,
        Hemisphere,
        Cone,
        Ogive,
    }
    let shapes = [
        ("flat", Shape::Flat),
        ("hemisphere", Shape::Hemisphere),
        ("cone", Shape::Cone),
        ("ogive", Shape::Ogive),
    ];
    let shape = row.word("nose", &shapes)?.unwrap_or(Shape::Flat);
    Ok(match shape {
        Shape::Flat => Nose::Flat,
        Shape::Hemisphere => Nose::Hemisphere,
        Shape::Cone => Nose::Cone {
            length_to_diameter: row.required_number("nose_ratio")?,
        },
        Shape::Ogive => Nose::Ogive {
            crh: row.required_number("nose_ratio")?,
        },
    })
}

fn target(row: &CsvRow<'_>, kind: Kind) -> Result<Struck, Box<InputError>> {
    let material = row.required("target_material")?;
    let wall = material == RIGID_WALL;
    if wall != (kind == Kind::Taylor) {
        let (message, help) = if wall {
            (
                format!("a rigid wall has no {}", kind.quantity().describe()),
                "write the material of the target",
            )
        } else {
            (
                "a Taylor test has a rigid wall".to_owned(),
                "write rigid-wall",
            )
        };
        return Err(row.error("target_material", message, help));
    }
    if wall {
        return Ok(Struck::RigidWall);
    }
    let thickness = match row.required("thickness_mm")?.as_str() {
        SEMI_INFINITE if kind == Kind::BallisticLimit => {
            return Err(row.error(
                "thickness_mm",
                "a semi-infinite target has no ballistic limit",
                "write its thickness",
            ));
        }
        SEMI_INFINITE => None,
        _ => row.number("thickness_mm")?.map(|mm| mm * 1e-3),
    };
    Ok(Struck::Body {
        material,
        thickness,
        properties: properties(row)?,
    })
}

fn properties(row: &CsvRow<'_>) -> Result<Option<Properties>, Box<InputError>> {
    let any = COLUMNS
        .iter()
        .map(|column| column.name)
        .filter(|name| name.starts_with("target_") && *name != "target_material")
        .any(|name| !row.text(name).is_empty());
    if !any {
        return Ok(None);
    }
    let strength = match (
        row.number("target_yield_mpa")?,
        row.number("target_concrete_strength_mpa")?,
    ) {
        (Some(yield_stress), None) => Strength::Metal {
            yield_stress: yield_stress * 1e6,
            exponent: row.number("target_hardening_exponent")?.unwrap_or(0.0),
        },
        (None, Some(strength)) => Strength::Concrete(strength * 1e6),
        _ => {
            return Err(row.error(
                "target_yield_mpa",
                "a target with properties has either `target_yield_mpa` or `target_concrete_strength_mpa`",
                "fill in one of them, or leave all columns target_density_kg_m3 to target_concrete_strength_mpa empty",
            ));
        }
    };
    Ok(Some(Properties {
        density: row.required_number("target_density_kg_m3")?,
        youngs_modulus: row.required_number("target_youngs_modulus_gpa")? * 1e9,
        poissons_ratio: row.required_number("target_poissons_ratio")?,
        strength,
        ultimate_strength: row.number("target_ultimate_mpa")?.map(|mpa| mpa * 1e6),
        brinell_hardness: row.number("target_brinell_hardness")?,
    }))
}
