//! The numbers of results, sweeps and histories, from their lists.

use std::fmt::Write;

use percuss::{
    history::{ELEMENT_COLUMNS, HistoryColumn, SAMPLE_COLUMNS},
    summary::{RESULT_FIELDS, ResultField, Role},
};

const INTRODUCTION: &str = "# Results

Names, units and meaning of all results. This page is written by the program.

Names end with the unit: mm, g, us, ns, kN, MPa, J, K, m/s and N s. These are the units of the field, and JSON, files and Python have the same ones: a
largest `contact_force_kn` of a history compares with `peak_force_kn` of the result without a conversion. In Python, `history.si` has the histories in SI units.

## Results of a run

`percuss run --json`, `percuss compare --json` and the attributes of a result in Python. In the column *use*, **main** results are evaluated by
`percuss uncertainty` unless others are named; the other *results* can be named with `--quantity`. Sweeps have every number as a column.

| name | value | meaning | use |
|---|---|---|---|
";

const SWEEP: &str = "
## Columns of a sweep

Every number above, null where a model does not give it, and:

| column | meaning |
|---|---|
| `run` | number of the run, from 0 |
| an input | key and unit, such as `projectile.impact_velocity_m_s`; the column of an option holds its words |
| `outcome`, `termination`, `scheme`, `target_resistance`, `criterion` | the texts above |
| `expected_error`, `expected_error_low`, `expected_error_high` | estimated error of the depth: median, 10th and 90th percentile |
| `band_of`, `band_low`, `band_high` | range that the model gives its main number |
| `details` | numbers that the model alone has, as JSON |
| `warnings` | list of texts, as JSON |
| `error` | `reason` above, or what is wrong with the case of this row |
";

const HISTORY: &str = "
## Histories

`history.csv`, `history.parquet`, and `history` of a result in Python.

";

const PROFILES: &str = "
## States along the axis

`profiles.parquet`, `final-profile.csv`, and `history.profiles` in Python. The files have the column `time_us` before these.

";

/// The page of all results.
pub(crate) fn page() -> String {
    let mut page = String::from(INTRODUCTION);
    for field in RESULT_FIELDS {
        let (name, kind) = (field.name, field.kind.describe());
        let meaning = field.description();
        let _ = writeln!(page, "| `{name}` | {kind} | {meaning} | {} |", used(field));
    }
    page += SWEEP;
    page += HISTORY;
    page += &columns(SAMPLE_COLUMNS);
    page += PROFILES;
    page += &columns(ELEMENT_COLUMNS);
    page
}

fn used(field: &ResultField) -> &'static str {
    match field.number.as_ref().map(|number| number.role) {
        Some(Role::Input) => "given by the case",
        Some(Role::Main) => "**main**",
        Some(Role::Result) => "result",
        Some(Role::Detail) => "detail",
        Some(Role::Numerics) => "numerics",
        None => "",
    }
}

fn columns<R>(columns: &[HistoryColumn<R>]) -> String {
    let mut text = String::from("| column | in SI units | meaning |\n|---|---|---|\n");
    for column in columns {
        let (name, si_name) = (column.name(), column.si_name());
        let _ = writeln!(text, "| `{name}` | `{si_name}` | {} |", column.description);
    }
    text
}
