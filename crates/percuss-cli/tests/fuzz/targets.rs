//! What mutated input is given to.

use std::{
    fs,
    ops::ControlFlow,
    path::Path,
    sync::{LazyLock, atomic::AtomicBool},
    time::{Duration, Instant},
};

use percuss::{
    Error, Scenario,
    calibrate::Fitted,
    case,
    case::Document,
    checkpoint::Header,
    experiments, lsdyna,
    lsdyna::UnitSystem,
    material::Library,
    model::{self, Checkpoints, Control, MODELS, Model},
    outcome::RunResult,
    sweep::Sweep,
    uncertainty::Study,
    v50,
};
use percuss_cli::VirtualFiles;
use percuss_report::sweep::{SweepFolder, status};
use rayon::{ThreadPool, ThreadPoolBuilder};
use tempfile::TempDir;

use super::http;

/// Start of a message that says that an invariant does not hold.
pub const BROKEN: &str = "broken: ";
/// Runs that are expected to take longer, and those that do, are not waited for.
const QUICK: f64 = 0.02;
const PATIENCE: Duration = Duration::from_secs(2);

/// End of an input: its kind, or the message of an error.
pub type End = Result<&'static str, String>;

/// What an input is given to.
type Attempt = Box<dyn Fn(&[u8]) -> End>;

/// A kind of input.
pub struct Target {
    pub kind: &'static str,
    /// Valid inputs to start from.
    pub seeds: Vec<String>,
    pub run: Attempt,
}

impl Target {
    fn new(kind: &'static str, seeds: Vec<String>, run: impl Fn(&[u8]) -> End + 'static) -> Self {
        Self {
            kind,
            seeds,
            run: Box::new(run),
        }
    }

    /// Of input that is text.
    fn of_text(
        kind: &'static str,
        seeds: Vec<String>,
        run: impl Fn(&str) -> End + 'static,
    ) -> Self {
        Self::new(kind, seeds, move |bytes| {
            run(&String::from_utf8_lossy(bytes))
        })
    }
}

/// The target of a kind.
pub fn targets(kind: &str) -> Target {
    match kind {
        "case" => Target::of_text("case", cases(), case),
        "material_file" => of_material_files(),
        "sweep" => Target::of_text("sweep", sweeps(), sweep),
        "uncertainty" => Target::of_text("uncertainty", uncertainties(), |text| {
            refused(Study::of(&Document::new("case", text)))
        }),
        "calibration" => Target::of_text("calibration", calibrations(), |text| {
            refused(Fitted::read_with("file.toml", |_| {
                Ok(Document::new("file.toml", text))
            }))
        }),
        "tests_of_limits" => Target::of_text("tests_of_limits", vec![LIMITS.to_owned()], limits),
        "tests_of_depths" => Target::of_text("tests_of_depths", depths(), |text| {
            refused(experiments::read_str(
                "tests.csv",
                text,
                Library::built_in(),
            ))
        }),
        "lsdyna" => Target::of_text("lsdyna", decks(), deck),
        "checkpoint" => of_checkpoints(),
        "manifest" => of_manifests(),
        "command_line" => Target::of_text("command_line", command_lines(), command_line),
        "http" => Target::new("http", http::seeds(), http::request),
        _ => panic!("{kind}"),
    }
}

/// End of what reads something.
fn refused<T>(read: Result<T, Error>) -> End {
    match read {
        Ok(_) => Ok("read"),
        Err(Error::Input(error)) => Err(format!("{} {} {}", error.key, error.message, error.help)),
        Err(error) => Err(error.to_string()),
    }
}

fn files(folder: &str, ending: &str) -> Vec<String> {
    let root = Path::new(crate::support::TESTS).join(folder);
    let mut paths: Vec<_> = fs::read_dir(&root)
        .unwrap()
        .flat_map(|entry| {
            let path = entry.unwrap().path();
            [path.join("scenario.toml"), path]
        })
        .filter(|path| path.is_file() && path.to_string_lossy().ends_with(ending))
        .collect();
    paths.sort();
    paths
        .iter()
        .map(|path| fs::read_to_string(path).unwrap())
        .collect()
}

const STARTER: &str = include_str!("../../src/commands/new/starter.toml");

fn cases() -> Vec<String> {
    let mut cases = files("../../../cases", "scenario.toml");
    cases.push(STARTER.to_owned());
    cases
}

/// A case that can be read is run by every model that is expected to be quick.
fn case(text: &str) -> End {
    let scenario = match case::load_str("case", text) {
        Ok(scenario) => scenario,
        Err(error) => return refused::<()>(Err(error)),
    };
    for model in MODELS {
        let applies = model::applicability(*model, &scenario);
        let estimate = applies.map(|_| model.estimate(&scenario));
        if estimate.is_ok_and(|cost| cost.seconds < QUICK && cost.memory < 1e8) {
            run(*model, &scenario)?;
        }
    }
    Ok("run")
}

fn run(model: &dyn Model, scenario: &Scenario) -> End {
    // In a thread of its own: one that waits for a part of this run would take up a long run of another test.
    let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    match alone.unwrap().install(|| impatient(model, scenario)) {
        Ok(result) => match broken(&result) {
            Some(what) => Err(format!("{BROKEN}{}: {what}", model.name())),
            None => Ok("run"),
        },
        Err(Error::NotApplicable { .. } | Error::Numerical(_) | Error::Cancelled { .. }) => {
            Ok("no result")
        }
        Err(error) => Err(format!("{BROKEN}{}: {error}", model.name())),
    }
}

/// A run that is stopped when it takes long.
fn impatient(model: &dyn Model, scenario: &Scenario) -> Result<RunResult, Error> {
    let start = Instant::now();
    let mut watch = |_: model::Progress| match start.elapsed() < PATIENCE {
        true => ControlFlow::Continue(()),
        false => ControlFlow::Break(()),
    };
    let mut control = Control {
        progress: Some(&mut watch),
        ..Control::default()
    };
    model::run(model, scenario, &mut control)
}

/// What is wrong with a result, if anything is.
fn broken(result: &RunResult) -> Option<String> {
    let numbers = [
        ("depth", result.depth_of_penetration),
        ("residual velocity", result.residual_velocity),
        ("final length", result.projectile_final_length),
        ("peak force", result.peak_force),
        ("end time", result.end_time),
    ];
    let odd = numbers
        .iter()
        .find(|(_, number)| number.is_some_and(|number| !number.is_finite()));
    odd.map(|(name, number)| format!("{name} = {number:?}"))
}

fn of_material_files() -> Target {
    let folder = TempDir::new().unwrap();
    let case = format!(
        "material_files = ['own.toml']\n{}",
        crate::support::CASE.replace("material = \"copper\"", "material = \"own\"")
    );
    fs::write(folder.path().join("case.toml"), case).unwrap();
    let record = "[materials.own]\nname = 'Own'\ndensity = '8960 kg/m3'\nyoungs_modulus = '124 GPa'\npoissons_ratio = 0.34\n\
        yield_stress = '90 MPa'\nspecific_heat = '383 J/(kg K)'\nmelting_temperature = '1356 K'\nstrength = { johnson_cook = { a = '90 MPa', b = '292 MPa', n = 0.31, c = 0.025, m = 1.09, \
        reference_rate = '1 1/s' } }\n";
    let seeds = vec![record.to_owned()];
    Target::new("material_file", seeds, move |bytes| {
        fs::write(folder.path().join("own.toml"), bytes).unwrap();
        refused(case::load(folder.path().join("case.toml")))
    })
}

fn sweeps() -> Vec<String> {
    let mut sweeps = files("bad-sweeps", ".toml");
    sweeps.push(SWEEP.to_owned());
    sweeps.push(GRID.to_owned());
    sweeps
}

const SWEEP: &str = "base = 'case.toml'\nmodel = 'crater_energy'\nsamples = 100\ndesign = 'sobol'\n[[parameter]]\nkey = 'projectile.impact_velocity'\n\
    uniform = { from = '100 m/s', to = '300 m/s' }\n[[parameter]]\nkey = 'projectile.length'\nnormal = { mean = '10 mm', standard_deviation = '1 mm' }\n";
const GRID: &str = "base = 'case.toml'\nmodel = 'crater_energy'\ndesign = 'grid'\n[[parameter]]\nkey = 'projectile.impact_velocity'\nlinear = { from = '100 m/s', to = '300 m/s', count = 3 }\n\
    [[parameter]]\nkey = 'target.thickness'\nlog = { from = '10 mm', to = '30 mm', count = 4 }\n";

/// A sweep that can be read gives runs at its ends and in its middle.
fn sweep(text: &str) -> End {
    let case = Document::new("case.toml", crate::support::CASE);
    let read = Sweep::of(&Document::new("sweep.toml", text), &case);
    if let Ok(sweep) = &read {
        let last = sweep.runs() - 1;
        for index in [0, last / 2, last] {
            let _ = sweep.run(index);
        }
        let cost = sweep.estimate(sweep.runs());
        if cost.seconds.is_nan() {
            return Err(format!("{BROKEN}cost {cost:?}"));
        }
    }
    refused(read)
}

fn uncertainties() -> Vec<String> {
    let mut seeds = files("bad-uncertainties", ".toml");
    seeds.extend(
        files("../../../cases", "scenario.toml")
            .into_iter()
            .filter(|text| text.contains("uncertainty")),
    );
    seeds.push(STARTER.to_owned());
    seeds
}

fn calibrations() -> Vec<String> {
    let fitted = include_str!("../../../../cases/taylor-copper-wilkins/calibration.toml");
    vec![fitted.to_owned(), SWEEP.to_owned()]
}

const LIMITS: &str = "impact_velocity_m_s,perforated,note\n184.3,yes,\n181.5,no,stopped\n183,no,\n\"185\",yes,\"a, b\"\n184,no,\n";

fn limits(text: &str) -> End {
    let read = v50::read_str("tests.csv", text);
    if let Ok(tests) = &read {
        let found = v50::estimate(tests, v50::SPAN);
        let is_odd = |value: Option<f64>| value.is_some_and(|value| !value.is_finite());
        if let Some(odd) = found
            .estimates
            .iter()
            .find(|estimate| is_odd(estimate.v50_m_s))
        {
            return Err(format!("{BROKEN}{odd:?}"));
        }
    }
    refused(read)
}

fn depths() -> Vec<String> {
    let table = include_str!("../../../percuss-studies/data/experiments/experiments.csv");
    let lines: Vec<&str> = table.lines().collect();
    let few = |rows: &[&str]| format!("{}\n{}\n", lines[0], rows.join("\n"));
    lines[1..].chunks(4).take(12).map(few).collect()
}

const DECK: &str = "*KEYWORD\n*PART\nthe plate\n         1         1        11        21\n*MAT_JOHNSON_COOK_TITLE\n4340 steel, plate\n\
\x20       11 7.8300E-6      80.0     208.0       0.3\n     0.792      0.51      0.26     0.014      1.03    1793.0     298.0     0.001\n\
\x20    477.0     -9.00       2.0       0.0      0.05      3.44      2.12     0.002\n      0.61\n*MAT_098\n\
\x20       12   7.85E-6     200.0      0.29\n     0.811    0.1547     0.156   0.00749      2.15       1.8       0.0     0.001\n\
*EOS_GRUNEISEN\n        21    3574.0      1.92       0.0       0.0      1.69\n\n*END\n";
const SHORT_DECK: &str =
    "*MAT_015\n1,7.83e-6,80,208,0.3\n0.8,0.5,0.3,0.01,1,1800,300,0.001\n0,0,0,0,0.1,0.9,-1.5,0\n";

fn decks() -> Vec<String> {
    vec![DECK.to_owned(), SHORT_DECK.to_owned()]
}

/// A deck in every system of units: in one of them its numbers are those of a metal.
fn deck(text: &str) -> End {
    let read = UnitSystem::ALL.map(|units| refused(lsdyna::read("deck.k", text, units)));
    let best = read.iter().position(Result::is_ok).unwrap_or(0);
    read[best].clone()
}

/// Keeps one checkpoint.
struct Keeper(Vec<u8>);

impl Checkpoints for Keeper {
    fn is_due(&mut self) -> bool {
        true
    }

    fn keep(&mut self, bytes: &[u8]) -> ControlFlow<()> {
        self.0 = bytes.to_vec();
        ControlFlow::Break(())
    }
}

/// A checkpoint with a change is refused: a text holds its place and the new bytes.
fn of_checkpoints() -> Target {
    let scenario = case::load_str("case", crate::support::CASE).unwrap();
    let model = model::model("chain").unwrap();
    let mut keeper = Keeper(Vec::new());
    let mut control = Control {
        checkpoints: Some(&mut keeper),
        ..Control::default()
    };
    model::run(model, &scenario, &mut control).unwrap_err();
    let whole = keeper.0;
    let seeds = ["0 a", "20 b", "1000 xyz", "30 ", "50 5"]
        .map(str::to_owned)
        .to_vec();
    Target::new("checkpoint", seeds, move |bytes| {
        let (place, put) = bytes.split_at(bytes.iter().position(|b| *b == b' ').unwrap_or(0));
        let place = String::from_utf8_lossy(place)
            .parse::<f64>()
            .unwrap_or(0.0)
            .abs() as usize
            % whole.len();
        let mut changed = whole.clone();
        match put.len() {
            0 | 1 => changed.truncate(place),
            _ => {
                let end = (place + put.len()).min(whole.len());
                changed.splice(place..end, put.iter().copied());
            }
        }
        if changed == whole {
            return Ok("whole");
        }
        let mut control = Control {
            resume: Some(&changed),
            ..Control::default()
        };
        let read = Header::read(&changed, "chain", &scenario);
        match (read, model::run(model, &scenario, &mut control)) {
            (Err(Error::Checkpoint { reason, .. }), Err(Error::Checkpoint { .. })) => Err(reason),
            other => Err(format!("{BROKEN}{other:?}")),
        }
    })
}

/// A manifest with a change is refused, or says the same.
fn of_manifests() -> Target {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("out");
    let case = Document::new("case.toml", crate::support::CASE);
    let sweep = Sweep::of(&Document::new("sweep.toml", GRID), &case).unwrap();
    drop(SweepFolder::open(&path, &sweep, false).unwrap());
    let manifest = fs::read_dir(&path)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .find(|path| path.to_string_lossy().contains("manifest"))
        .unwrap();
    let whole = fs::read_to_string(&manifest).unwrap();
    Target::new("manifest", vec![whole.clone()], move |bytes| {
        // Kept as long as the target.
        let _ = &folder;
        fs::write(&manifest, bytes).unwrap();
        let state = status(&path).map(|_| ()).map_err(|error| error.to_string());
        let opened = SweepFolder::open(&path, &sweep, true).map(|_| ());
        match (state, opened) {
            (Err(message), _) => Err(message),
            (Ok(()), Err(error)) => Err(error.to_string()),
            (Ok(()), Ok(())) if same(bytes, &whole) => Ok("whole"),
            _ => Err(format!("{BROKEN}a changed manifest was taken")),
        }
    })
}

/// Whether two texts are the same but for white space.
fn same(bytes: &[u8], whole: &str) -> bool {
    let bare = |text: &str| text.split_whitespace().collect::<String>();
    bare(&String::from_utf8_lossy(bytes)) == bare(whole)
}

fn command_lines() -> Vec<String> {
    [
        "run\ncase.toml\n--fast\n--model\ncrater_energy",
        "compare\ncase.toml\n--fast\n--velocity\n100..200:3",
        "limit\ncase.toml\n--model\nplugging",
        "materials\ncopper",
        "models\nchain",
        "schema",
        "converge\ncase.toml\n--model\nfdm\n--levels\n2",
        "uncertainty\ncase.toml\n--model\ncrater_energy\n--samples\n16",
        "calibrate\n--fit\nmaterials.copper.yield_stress=20..300 MPa\n--data\nbuiltin\n--model\nwilkins_guinan",
    ]
    .map(str::to_owned)
    .to_vec()
}

/// Threads for command lines alone: in the common pool one that waits may take up a run of minutes of another test.
static THREADS: LazyLock<ThreadPool> = LazyLock::new(|| {
    let threads = ThreadPoolBuilder::new().num_threads(2).build();
    threads.expect("threads start")
});

/// A command line of a word per line, whose case is a text; a command that computes is stopped at once.
fn command_line(text: &str) -> End {
    let mut words: Vec<String> = text.lines().map(str::to_owned).collect();
    words.insert(0, "percuss".to_owned());
    // Nothing is written into the folder of the tests.
    if words
        .iter()
        .any(|word| word.starts_with("--o") || word == "new" || word == "man" || word == "validate")
    {
        return Ok("left out");
    }
    let mut virtual_files = VirtualFiles::default();
    virtual_files.put(
        "case.toml",
        Document::new("case.toml", crate::support::CASE),
    );
    let stop = AtomicBool::new(true);
    let words = words.into_iter().map(Into::into);
    let end = THREADS.install(|| {
        percuss_cli::execute(words, &virtual_files, &stop, &mut |_, _| {
            ControlFlow::Break(())
        })
    });
    match end {
        Ok(_) => Ok("answered"),
        Err(failure) => Err(failure.plain_text()),
    }
}
