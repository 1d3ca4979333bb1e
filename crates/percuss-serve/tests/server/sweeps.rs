//! Sweeps of the page: the rows, the figures and the errors of `percuss sweep`.

use std::{
    fs::{self, File},
    io::Write,
    path::Path,
    sync::atomic::AtomicBool,
    thread,
    time::{Duration, Instant},
};

use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::RowAccessor,
};
use percuss::sweep::{BatchKernel, Sweep};
use percuss_report::sweep::{PlotRequest, SweepFolder, merge, plot};
use percuss_serve::{Options, RequestLimits};
use serde_json::{Value, json};

use crate::support::{PAPER, Served, post_request};

/// Runs of which some erode, some perforate and one has no case.
const GRID: &str = "
base = 'scenario.toml'
model = 'chain'
design = 'grid'
[[parameter]]
key = 'projectile.impact_velocity'
linear = { from = '150 m/s', to = '600 m/s', count = 7 }
[[parameter]]
key = 'target.thickness'
log = { from = '5 mm', to = '20 mm', count = 3 }
";

fn asked(sweep: &str) -> Value {
    let coarse = PAPER.replace("= 40", "= 10").replace("= 80", "= 20");
    json!({ "name": "shot", "case": coarse, "sweep": sweep })
}

/// Numbers as they are after they were written and read: reading may cost the last bit.
fn as_read(numbers: &impl serde::Serialize) -> Value {
    serde_json::from_str(&serde_json::to_string(numbers).unwrap()).unwrap()
}

/// What is drawn inside the axes: above it stands the name of the case, which is that of the folder.
fn drawn(svg: &str) -> &str {
    let (_, inside) = svg.split_once("<g clip-path=").unwrap();
    inside.split_once('>').unwrap().1
}

/// What the page downloads is computed by the command into the same rows and figures.
#[test]
fn the_files_of_the_page_give_its_rows_on_the_command_line() {
    let served = Served::new(Options::default());
    let lines = served.post("/api/study/sweep", &asked(GRID)).lines();
    let done = &lines[lines.len() - 1]["done"];
    assert!(lines[0]["progress"]["words"].to_string().contains("runs"));

    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["sweep.toml", "scenario.toml"] {
        fs::write(at(name), done["files"][name].as_str().unwrap()).unwrap();
    }
    let sweep = Sweep::load(at("sweep.toml")).unwrap();
    let rows = SweepFolder::open(&at("rows"), &sweep, false).unwrap();
    let kernel = BatchKernel::new(sweep.model);
    let stop = AtomicBool::new(false);
    rows.compute(&sweep, &kernel, &rows.missing(1, 1), &stop, &|_| {})
        .unwrap();
    merge(&[at("rows")], &at("rows.parquet"), None).unwrap();

    let file = SerializedFileReader::new(File::open(at("rows.parquet")).unwrap()).unwrap();
    let schema = file.metadata().file_metadata().schema_descr();
    let place = |name: &str| {
        let mut names = schema.columns().iter().map(|column| column.name());
        names.position(|found| found == name).unwrap()
    };
    let numbers = done["numbers"].as_array().unwrap();
    assert!(numbers.len() > 10);
    assert_eq!(numbers[0]["quantity"], "depth_of_penetration_mm");
    assert_eq!(numbers[0]["label"], "Depth of penetration (mm)");
    let mut count = 0;
    for (i, row) in file.get_row_iter(None).unwrap().enumerate() {
        let row = row.unwrap();
        let shown = &done["rows"][i];
        let inputs = [row.get_double(1).unwrap(), row.get_double(2).unwrap()];
        assert_eq!(shown["inputs"], as_read(&inputs));
        let error = row.get_string(place("error")).unwrap();
        assert_eq!(shown["reason"].as_str(), Some(error.as_str()));
        for number in numbers {
            let column = place(number["quantity"].as_str().unwrap());
            let value = row.get_double(column).ok();
            assert_eq!(number["values"][i], as_read(&value), "{number}");
        }
        count += 1;
    }
    assert_eq!((count, &done["runs"]), (21, &json!(21)));
    let csv = done["files"]["rows.csv"].as_str().unwrap();
    assert!(csv.starts_with("run,projectile.impact_velocity_m_s,target.thickness_mm,outcome,"));

    // A curve a thickness, and a map of both.
    let figure = plot(&[at("rows")], &PlotRequest::default()).unwrap();
    let name = format!("{}.svg", figure.name);
    assert_eq!(name, "curves-depth_of_penetration_mm.svg");
    let of_page = done["files"][&name].as_str().unwrap();
    assert!(drawn(of_page) == drawn(&figure.svg), "{of_page}");
    assert_eq!(
        done["drawn"][0]["chart"]["series"]
            .as_array()
            .unwrap()
            .len(),
        3
    );
    assert_eq!(done["drawn"][1]["style"], "map");
    assert_eq!(done["drawn"][1]["chart"]["y"]["log"], true);
}

#[test]
fn more_than_two_parameters_are_drawn_side_by_side() {
    let served = Served::new(Options::default());
    let options =
        "[[parameter]]\nkey = 'chain.target_resistance'\nvalues = ['column', 'diverging']\n";
    let three = format!("{GRID}{options}").replace("count = 7", "count = 2");
    let lines = served.post("/api/study/sweep", &asked(&three)).lines();
    let done = &lines[lines.len() - 1]["done"];
    assert_eq!(done["runs"], 12);
    assert_eq!(
        done["pictures"][0]["name"],
        "parallel-depth_of_penetration_mm"
    );
    assert_eq!(
        done["parameters"][2]["words"],
        json!(["column", "diverging"])
    );

    let two = GRID.replace("projectile.impact_velocity", "projectile.length") + options;
    let words = two.replace(
        "linear = { from = '150 m/s', to = '600 m/s', count = 7 }",
        "values = ['10 mm']",
    );
    let lines = served.post("/api/study/sweep", &asked(&words)).lines();
    let chart = &lines[lines.len() - 1]["done"]["drawn"][1]["chart"];
    assert_eq!(chart["y"]["names"], json!(["column", "diverging"]));
}

/// Every sweep file that the command refuses is refused in the same words, and at the same line.
#[test]
fn errors_are_those_of_the_command() {
    let served = Served::new(Options::default());
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../percuss-cli/tests/bad-sweeps");
    let mut tried = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        // The page has its own base.
        if !text.contains("cases/paper-table1/scenario.toml") {
            continue;
        }
        let error = Sweep::load(&path).unwrap_err();
        let (message, help) = error.message_and_help();
        let percuss::Error::Input(place) = &error else {
            panic!("{error}");
        };
        let asked = json!({ "name": "shot", "case": PAPER, "sweep": text });
        let problem = served.post("/api/study/sweep", &asked).lines()[0]["problem"].clone();
        assert_eq!(problem["message"], message, "{}", path.display());
        assert_eq!(problem["help"], help);
        if problem["place"].is_object() {
            assert_eq!(problem["place"]["line"], place.line());
        }
        tried += 1;
    }
    assert!(tried > 40, "{tried}");
}

#[test]
fn a_sweep_has_bounds() {
    let served = Served::new(Options::default());
    let problem = |sweep: &str| {
        let lines = served.post("/api/study/sweep", &asked(sweep)).lines();
        let problem = &lines[lines.len() - 1]["problem"];
        format!("{}; {}", problem["message"], problem["help"])
    };
    let said = problem(&GRID.replace("count = 7", "count = 1366"));
    assert!(said.contains("the sweep has 4098 runs"), "{said}");
    assert!(
        said.contains("up to 4096; use `percuss sweep` for more"),
        "{said}"
    );
    // Lists take memory before anybody counts the runs.
    let long = GRID
        .replace("count = 7", "count = 1000000")
        .replace("count = 3", "count = 1000000");
    let more = [("length", "mm"), ("diameter", "mm"), ("temperature", "K")].map(|(key, unit)| {
        format!("[[parameter]]\nkey = 'projectile.{key}'\nlinear = {{ from = '300 {unit}', to = '400 {unit}', count = 1000000 }}\n")
    });
    let long = long + "\n" + &more.concat();
    let said = problem(&long);
    assert!(
        said.contains("all lists together have more than 4000000 values"),
        "{said}"
    );
    assert!(problem("").contains("base"), "{said}");
    // A shot that asks for more than the page may is a row with an error.
    let elements = "base = ''\nmodel = 'chain'\ndesign = 'grid'\n[[parameter]]\nkey = 'chain.target_elements'\nvalues = [20, 5000]";
    let lines = served.post("/api/study/sweep", &asked(elements)).lines();
    let done = &lines[lines.len() - 1]["done"];
    assert_eq!(done["rows"][1]["reason"], "the mesh has 5010 elements");
    // A formula has no mesh.
    let formula = elements
        .replace("'chain'\ndesign", "'crater_energy'\ndesign")
        .replace("chain.target_elements", "projectile.impact_velocity")
        .replace("[20, 5000]", "['200 m/s', '300 m/s']");
    let fine = PAPER.replace("= 80", "= 5000");
    let asked = json!({ "name": "shot", "case": fine, "sweep": formula });
    let lines = served.post("/api/study/sweep", &asked).lines();
    let done = &lines[lines.len() - 1]["done"];
    assert_eq!(done["outcomes"], json!({ "at rest": 2 }));
}

/// Who closes the connection, or asks for too long, frees the place.
#[test]
fn a_sweep_ends_when_nobody_waits_and_when_time_is_up() {
    let bounds = RequestLimits {
        runs: 1,
        seconds: 2,
        ..RequestLimits::default()
    };
    let served = Served::new(Options {
        bounds,
        ..Options::default()
    });
    let many = GRID.replace("count = 7", "count = 1300");
    let fine = json!({ "case": PAPER.replace("= 80", "= 900"), "sweep": many });
    let start = Instant::now();
    let lines = served.post("/api/study/sweep", &fine).lines();
    let problem = lines[lines.len() - 1]["problem"]["message"].clone();
    assert_eq!(problem, "the run was stopped at the time limit of 2 s");
    assert!(start.elapsed() < Duration::from_secs(20));

    let body = fine.to_string();
    let mut stream = served.connect();
    let request = post_request(served.address, "/api/study/sweep", body.as_bytes(), "");
    stream.write_all(&request).unwrap();
    thread::sleep(Duration::from_millis(300));
    drop(stream);
    let answer = served.post("/api/answer", &json!({ "case": PAPER, "model": "chain" }));
    assert_eq!(answer.status, 200, "{}", answer.text());
}
