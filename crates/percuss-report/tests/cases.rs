//! Figures and history files of whole runs.

use std::collections::HashSet;

use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::Field,
};
use percuss::{Scenario, case, model, outcome::RunResult};
use percuss_report::{Figure, FigureFormat, ReportError, run_figures, write_histories};
use resvg::{tiny_skia::Pixmap, usvg};

const PLATE: &str = r#"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
"#;
const TAYLOR: &str = r#"
title = "Taylor test & a price in $"
projectile = { material = "copper", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "183 m/s" }
target = { rigid_wall = true }
"#;
const EROSION: &str = r#"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "800 m/s" }
target = { material = "aluminium-2024-t351", thickness = "50 mm" }
chain.target_resistance = "column"
"#;

fn run(text: &str) -> (Scenario, RunResult) {
    let scenario = case::load_str("case", text).unwrap();
    let chain = model::model("chain").unwrap();
    let result = model::run(chain, &scenario, &mut model::Control::recording()).unwrap();
    (scenario, result)
}

fn names(figures: &[Figure]) -> Vec<&str> {
    figures.iter().map(|figure| figure.name.as_str()).collect()
}

/// Every figure is an SVG of the size that its PNG has at half scale, and the PNG is not blank.
fn assert_drawn(figures: &[Figure]) {
    for figure in figures {
        let name = &figure.name;
        let tree = usvg::Tree::from_str(&figure.svg, &usvg::Options::default()).unwrap();
        let size = tree.size().to_int_size();
        assert_eq!(size.width(), 860, "{name}");
        assert!((300..=660).contains(&size.height()), "{name}: {size:?}");
        let picture = Pixmap::decode_png(&figure.png().unwrap()).unwrap();
        assert_eq!(picture.width(), 2 * size.width(), "{name}");
        assert_eq!(picture.height(), 2 * size.height(), "{name}");
        let colors: HashSet<_> = picture
            .pixels()
            .iter()
            .map(|p| (p.red(), p.green(), p.blue()))
            .collect();
        // Smoothed edges of text alone make some twenty shades of grey.
        let least = if name == "stress-xt" { 80 } else { 60 };
        assert!(colors.len() >= least, "{name}: {} colours", colors.len());
        assert!(!figure.svg.contains("NaN"), "{name}");
    }
}

#[test]
fn a_plate_has_all_figures_but_the_length() {
    let (scenario, result) = run(PLATE);
    let figures = run_figures(&scenario, &result).unwrap();
    assert_eq!(
        names(&figures),
        [
            "depth-time",
            "velocity-time",
            "force-time",
            "energy-time",
            "strain-profile",
            "stress-xt",
            "rod-shape"
        ]
    );
    assert_drawn(&figures);
    assert!(figures[0].title.contains("12.74 mm × 4.8 mm copper"));
}

#[test]
fn a_rigid_wall_has_a_length_but_no_depth() {
    let (scenario, result) = run(TAYLOR);
    let figures = run_figures(&scenario, &result).unwrap();
    assert_eq!(names(&figures)[..2], ["length-time", "velocity-time"]);
    assert!(!names(&figures).contains(&"depth-time"));
    assert_drawn(&figures);
    assert!(
        figures
            .iter()
            .all(|figure| figure.svg.contains("Taylor test &amp; a price in $"))
    );
}

#[test]
fn an_eroding_rod_has_depth_and_length() {
    let (scenario, result) = run(EROSION);
    assert!(result.numerics().eroded_elements.0 > 0);
    let figures = run_figures(&scenario, &result).unwrap();
    assert_eq!(names(&figures)[..2], ["depth-time", "length-time"]);
    assert_drawn(&figures);
}

#[test]
fn what_heats_up_shows_its_temperature() {
    let hot = TAYLOR.replace("\"copper\"", "\"ofhc-copper-johnson-cook\"");
    assert_ne!(hot, TAYLOR);
    for (text, shown) in [(hot.as_str(), true), (TAYLOR, false)] {
        let (scenario, result) = run(text);
        let figures = run_figures(&scenario, &result).unwrap();
        assert_eq!(names(&figures).contains(&"temperature-profile"), shown);
        assert_drawn(&figures);
    }
}

#[test]
fn a_case_at_rest_has_figures_along_the_axis() {
    let (scenario, result) = run(&TAYLOR.replace("183 m/s", "0 m/s"));
    let figures = run_figures(&scenario, &result).unwrap();
    assert_eq!(names(&figures), ["strain-profile", "rod-shape"]);
    assert_drawn(&figures);
}

#[test]
fn a_result_without_history_says_what_to_do() {
    let scenario = case::load_str("case", TAYLOR).unwrap();
    let chain = model::model("chain").unwrap();
    let result = model::run(chain, &scenario, &mut model::Control::default()).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let errors: [ReportError; 2] = [
        run_figures(&scenario, &result).unwrap_err(),
        write_histories(folder.path(), &result, None).unwrap_err(),
    ];
    for error in errors {
        assert!(
            error.to_string().contains("Control::recording()"),
            "{error}"
        );
    }
    assert_eq!(folder.path().read_dir().unwrap().count(), 0);
}

#[test]
fn figures_are_written_as_svg_and_png_and_nothing_else() {
    let (scenario, result) = run(TAYLOR);
    let figure = run_figures(&scenario, &result).unwrap().remove(0);
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path().join("made/on/demand");
    for _ in 0..2 {
        let [svg, png] = &figure.write(&folder, FigureFormat::DEFAULT).unwrap()[..] else {
            panic!("two files")
        };
        assert_eq!(std::fs::read_to_string(svg).unwrap(), figure.svg);
        assert_eq!(std::fs::read(png).unwrap(), figure.png().unwrap());
    }
    assert_eq!(folder.read_dir().unwrap().count(), 2);
    let blocked = folder.join("length-time.svg");
    let error = figure.write(&blocked, FigureFormat::DEFAULT).unwrap_err();
    assert!(error.to_string().contains("length-time.svg"), "{error}");
}

#[test]
fn every_figure_of_a_run_has_a_pdf_file() {
    for case in [TAYLOR, PLATE, EROSION] {
        let (scenario, result) = run(case);
        let folder = tempfile::tempdir().unwrap();
        for figure in run_figures(&scenario, &result).unwrap() {
            let files = figure.write(folder.path(), &[FigureFormat::Pdf]).unwrap();
            let file = std::fs::read(&files[0]).unwrap();
            assert!(file.starts_with(b"%PDF-") && files.len() == 1, "{figure:?}");
        }
    }
}

#[test]
fn csv_and_parquet_hold_the_same_columns_and_values() {
    let (_, result) = run(EROSION);
    let history = result.history.as_ref().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let files = write_histories(folder.path(), &result, None).unwrap();
    let expected = [
        "history.csv",
        "history.parquet",
        "profiles.parquet",
        "final-profile.csv",
    ];
    assert_eq!(files, expected.map(|name| folder.path().join(name)));

    let (header, rows) = read_csv(&files[0]);
    assert_eq!(header.len(), 41);
    assert_eq!(header[..3], ["time_us", "step", "tip_velocity_m_s"]);
    for name in [
        "energy_kinetic_projectile_j",
        "energy_through_rear_face_j",
        "momentum_support_n_s",
    ] {
        assert!(header.iter().any(|column| column == name), "{name}");
    }
    assert_eq!(rows.len(), history.samples.len());
    assert_eq!(read_parquet(&files[1]), (header, rows));

    let (header, all) = read_parquet(&files[2]);
    let elements: usize = history.profiles.iter().map(|p| p.elements.len()).sum();
    assert_eq!(all.len(), elements);
    let (last_header, last) = read_csv(&files[3]);
    assert_eq!(last_header, header);
    assert_eq!(last[..], all[all.len() - last.len()..]);
    assert_eq!(last.len(), history.profiles.last().unwrap().elements.len());
}

type Table = (Vec<String>, Vec<Vec<f64>>);

fn read_csv(path: &std::path::Path) -> Table {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let header = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    let number = |field: &str| field.parse::<f64>().unwrap();
    let rows = reader
        .records()
        .map(|row| row.unwrap().iter().map(number).collect())
        .collect();
    (header, rows)
}

fn read_parquet(path: &std::path::Path) -> Table {
    let file = std::fs::File::open(path).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let schema = reader.metadata().file_metadata().schema();
    let header = schema.get_fields().iter().map(|f| f.name().to_owned());
    let number = |field: &Field| match field {
        Field::Double(value) => *value,
        Field::Long(value) => *value as f64,
        other => panic!("{other:?}"),
    };
    let rows = reader.get_row_iter(None).unwrap().map(|row| {
        row.unwrap()
            .get_column_iter()
            .map(|(_, f)| number(f))
            .collect()
    });
    (header.collect(), rows.collect())
}
