//! Former keys in each kind of file: the error names the place, the former key and the new one.

use percuss::{
    Error, InputError, calibrate::Fitted, case, case::Document, sweep::Sweep, uncertainty::Study,
};

const CASE: &str = "projectile = { material = 'copper', length = '20 mm', diameter = '5 mm', impact_velocity = '230 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";

fn input<T>(result: Result<T, Error>) -> InputError {
    match result.err() {
        Some(Error::Input(error)) => *error,
        other => panic!("{other:?}"),
    }
}

fn assert_says(error: &InputError, file: &str, line: usize, former: &str, today: &str) {
    assert_eq!((error.file.as_str(), error.line()), (file, line), "{error}");
    assert!(
        error.message.contains(&format!("`{former}` was renamed")),
        "{error}"
    );
    assert!(
        error.help.starts_with(&format!("write `{today}`")),
        "{error}"
    );
    let marked = &error.text[error.span.clone()];
    assert!(marked.contains(former), "{marked}");
}

#[test]
fn a_former_key_of_a_case_is_named_with_the_new_one() {
    let read = |text: &str| input(case::load_str("case.toml", text));
    let former = read(&CASE.replace("impact_velocity", "velocity"));
    assert_eq!(former.key, "projectile.velocity");
    assert_says(&former, "case.toml", 1, "velocity", "impact_velocity");
    let experiment = "[[experiments]]\nballistic_limit = '300 m/s'\nsource = 'a'\n\
                      [[experiments]]\nvelocity = '230 m/s'\ndepth_of_penetration = '1 mm'\nsource = 'a'\n";
    let former = read(&format!("{CASE}{experiment}"));
    assert_eq!(former.key, "experiments.1.velocity");
    assert_says(&former, "case.toml", 7, "velocity", "impact_velocity");
    for (table, former, today) in [
        (
            "target_closure = 'column'",
            "target_closure",
            "target_resistance",
        ),
        (
            "erosion_closure = 'tate'",
            "erosion_closure",
            "erosion_criterion",
        ),
    ] {
        let error = read(&format!("{CASE}[chain]\n{table}\n"));
        assert_says(&error, "case.toml", 4, former, today);
    }
    // The same name elsewhere is a key that never was.
    let other = read(&format!("{CASE}[chain]\nvelocity = '1 m/s'\n"));
    assert!(other.message.starts_with("unknown key"), "{other}");
}

#[test]
fn a_former_key_of_a_calibrated_material_is_named_with_the_new_one() {
    let material = "[materials.mine]\nname = 'mine'\n[materials.mine.calibrated]\nparameters = []\nfrom = 'copper'\nmodel = 'taylor'\n\
                    sources = []\nshots = []\npercuss_version = '0.1.0'\nseed = 0\n";
    let error = input(case::load_str("case.toml", &format!("{CASE}{material}")));
    assert_says(&error, "case.toml", 10, "shots", "tests");
}

#[test]
fn a_former_key_of_a_varied_number_is_named_with_the_new_one() {
    let (former, today) = ("projectile.velocity", "projectile.impact_velocity");
    let normal = "normal = { mean = '230 m/s', standard_deviation = '3 m/s' }\n";
    let parameter = format!("key = 'projectile.velocity'\n{normal}");

    let sweep = format!(
        "base = 'case.toml'\nmodel = 'chain'\ndesign = 'sobol'\nsamples = 4\n[[parameter]]\n{parameter}"
    );
    let base = Document::new("case.toml", CASE);
    let error = input(Sweep::of(
        &Document::new("sweep.toml", sweep.as_str()),
        &base,
    ));
    assert_says(&error, "sweep.toml", 6, former, today);
    let joined = sweep.replace("projectile.velocity", today)
        + "[correlation]\nparameters = ['projectile.velocity', 'target.thickness']\nmatrix = [[1.0, 0.0], [0.0, 1.0]]\n";
    let error = input(Sweep::of(&Document::new("sweep.toml", joined), &base));
    assert_says(&error, "sweep.toml", 9, former, today);

    let case = format!("{CASE}[[uncertainty.parameter]]\n{parameter}");
    let error = input(Study::of(&Document::new("case.toml", case)));
    assert_says(&error, "case.toml", 4, former, today);

    let fit = format!("[[parameter]]\n{parameter}");
    let error = input(Fitted::read_with("fit.toml", |_| {
        Ok(Document::new("fit.toml", fit.as_str()))
    }));
    assert_says(&error, "fit.toml", 2, former, today);
    let error = input(Fitted::read("projectile.velocity=100..300 m/s"));
    assert_says(&error, "--fit", 1, former, today);
}
