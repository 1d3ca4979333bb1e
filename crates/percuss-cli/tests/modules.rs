//! The top-level modules of every crate form layers: no two of them use each other, directly or through others.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use tempfile::TempDir;
use toml::Table;

use crate::support::{
    module_graph::{ModuleGraph, ROOT},
    names_in,
};

/// The crates of the workspace from the lowest layer up, each with those that it may depend on. Tests may use any.
const LAYERS: &[(&str, &[&str])] = &[
    ("percuss-core", &[]),
    ("percuss-models", &["percuss-core"]),
    ("percuss-input", &["percuss-core", "percuss-models"]),
    (
        "percuss-studies",
        &["percuss-core", "percuss-input", "percuss-models"],
    ),
    (
        "percuss",
        &[
            "percuss-core",
            "percuss-input",
            "percuss-models",
            "percuss-studies",
        ],
    ),
    ("percuss-report", &["percuss"]),
    ("percuss-research", &["percuss", "percuss-report"]),
    ("percuss-serve", &["percuss", "percuss-report"]),
    (
        "percuss-cli",
        &[
            "percuss",
            "percuss-report",
            "percuss-research",
            "percuss-serve",
        ],
    ),
    ("percuss-py", &["percuss", "percuss-cli", "percuss-report"]),
    // A workspace of its own.
    ("percuss-book", &[]),
];

/// The crates of the workspace by name, each with its `lib.rs`.
fn crates() -> BTreeMap<String, PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let roots = names_in(&folder).into_iter().map(|name| {
        let root = folder.join(&name).join("src/lib.rs");
        (name, root)
    });
    roots.filter(|(_, root)| root.is_file()).collect()
}

#[test]
fn no_two_modules_of_a_crate_use_each_other() {
    let crates = crates();
    assert!(crates.len() >= 6, "{crates:?}");
    let mut text = String::new();
    for (name, root) in &crates {
        let graph = ModuleGraph::read(root);
        for cycle in graph.cycles() {
            let modules: Vec<&str> = cycle.iter().map(String::as_str).collect();
            text += &format!("{name}: {} use each other:\n", modules.join(", "));
            text += &graph.describe(|from, to| cycle.contains(from) && cycle.contains(to));
        }
    }
    assert!(text.is_empty(), "{text}");
}

/// The crates of the project that a crate depends on, outside its tests.
fn dependencies(name: &str) -> Vec<String> {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../{name}/Cargo.toml"));
    let manifest: Table = fs::read_to_string(manifest).unwrap().parse().unwrap();
    let listed = manifest["dependencies"].as_table().unwrap().keys();
    listed
        .filter(|name| name.starts_with("percuss"))
        .cloned()
        .collect()
}

#[test]
fn a_crate_depends_on_lower_layers_only() {
    let known: Vec<&str> = LAYERS.iter().map(|(name, _)| *name).collect();
    let mut found: Vec<String> = crates().into_keys().collect();
    found.retain(|name| !known.contains(&name.as_str()));
    assert!(found.is_empty(), "no layer: {found:?}");
    for (layer, (name, allowed)) in LAYERS.iter().enumerate() {
        let lower = &known[..layer];
        assert!(allowed.iter().all(|below| lower.contains(below)), "{name}");
        let mut used = dependencies(name);
        used.sort();
        assert_eq!(used, *allowed, "dependencies of {name}");
    }
}

/// The estimate of the model error is added to the record of a result: what runs a case is independent of benchmarks and published tests.
#[test]
fn no_run_consults_a_benchmark() {
    let studies = ModuleGraph::read(&crates()["percuss-studies"]);
    for table in ["model_error", "experiments", "validate"] {
        assert!(studies.modules.contains(table), "{table}");
    }
    let consults = studies.describe(|from, to| from == "summary" && to == "model_error");
    assert!(!consults.is_empty(), "who adds the estimate?");
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let with_data = names_in(&folder)
        .into_iter()
        .filter(|name| folder.join(name).join("data").is_dir());
    assert_eq!(
        with_data.collect::<Vec<_>>(),
        ["percuss-models", "percuss-research", "percuss-studies"]
    );
    // A table of worked numbers for the tests of a formula.
    assert_eq!(
        names_in(&folder.join("percuss-models/data")),
        ["lanz-odermatt.csv"]
    );
}

/// The project's own research stands in a crate that the program alone uses.
#[test]
fn research_is_apart() {
    for module in ["benchmark", "damping", "paper"] {
        for (name, root) in crates()
            .iter()
            .filter(|(name, _)| *name != "percuss-research" && *name != "percuss-cli")
        {
            let graph = ModuleGraph::read(root);
            assert!(!graph.modules.contains(module), "{name}: {module}");
        }
    }
}

/// The solvers check each other, so they share nothing but what lies below all of them.
#[test]
fn no_kind_of_model_uses_another() {
    let graph = ModuleGraph::read(&crates()["percuss-models"]);
    let kinds = ["analytic", "axi", "chain", "fdm", "particles"];
    assert!(kinds.iter().all(|kind| graph.modules.contains(*kind)));
    let text = graph.describe(|from, to| kinds.contains(&from) && kinds.contains(&to));
    assert!(text.is_empty(), "{text}");
}

/// A crate in a folder of its own.
fn made_up(files: &[(&str, &str)]) -> (TempDir, ModuleGraph) {
    let folder = TempDir::new().unwrap();
    for (name, text) in files {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, text).unwrap();
    }
    let graph = ModuleGraph::read(&folder.path().join("lib.rs"));
    (folder, graph)
}

/// The edges that leave a module, as `to:line,line`.
fn edges(graph: &ModuleGraph, module: &str) -> Vec<String> {
    let edges = graph.edges.iter().filter(|((from, _), _)| from == module);
    let edge = |((_, to), mentions): (&(String, String), &std::collections::BTreeSet<_>)| {
        let lines: Vec<String> = mentions
            .iter()
            .map(|mention: &crate::support::module_graph::Mention| mention.line.to_string())
            .collect();
        format!("{to}:{}", lines.join(","))
    };
    edges.map(edge).collect()
}

const MADE_UP: &str = "
pub mod a; mod b; pub mod c; mod d; mod e; mod f; mod g;
pub use b::{Bee, deep::Sting as Needle};
pub(crate) use c::Sea;
pub struct Own;
pub fn start() { f::begin() }
";

#[test]
fn every_way_to_name_a_module_is_an_edge() {
    let below = "
use super::super::{b::Bee,
    c as sea};
use super::{own::x, super::d::{self, y}};
use self::inner::z;
fn f() { super::helper(); crate::e::run::<crate::f::T>(0..5) }
mod inner { pub(in crate::a) fn z() -> super::super::super::g::G { super::super::helper() } }
";
    let a = "
mod below; mod own;
/* use crate::e::x; /* nested */ use crate::f::y; */
// use crate::e::x;
/// [`crate::e::x`]
const TEXT: &str = \"crate::e::x \\\" crate::f\";
const RAW: &str = r#\"crate::e::x \" crate::f\"#;
const MARK: (char, char) = ('\"', '\\'');
fn helper<'a>(text: &'a str) -> &'a str { text }
pub(in crate::a) fn shown() {}
#[cfg(test)]
use crate::e::X;
#[cfg(test)]
mod tests { use crate::f::Y; fn t() { crate::g::go(); } }
#[cfg(all(test, unix))]
pub(crate) fn for_tests<A, B>(_: crate::g::G) { crate::g::go() }
struct S { #[cfg(test)] only: crate::e::X, kept: crate::d::D }
#[derive(crate::c::Sea)]
#[serde(with = \"crate::g::text\", default = \"fallback\")]
struct T;
";
    let (_folder, graph) = made_up(&[
        ("lib.rs", MADE_UP),
        ("a/mod.rs", a),
        ("a/below.rs", below),
        ("a/own.rs", ""),
        (
            "b.rs",
            "pub mod deep; use crate::{Own, Sea};\nmacro_rules! m { () => { $crate::d::make!() } }\n#[macro_export]\nmacro_rules! made { () => {} }\n",
        ),
        (
            "b/deep.rs",
            "use crate::Needle;\npub use crate::{e::{run, g as _}, f::*};\n#[cfg(not(test))]\nuse crate::g::G;\n",
        ),
        ("c.rs", "use crate as root;\n"),
        (
            "d.rs",
            "pub use crate::Bee;\nuse std::e::Not; use super::Needle;\n",
        ),
        (
            "e.rs",
            "fn f() { for x in crate::c::list() { g::no::path(x) } }\nfn h() { crate::made!() }\n",
        ),
        ("f.rs", ""),
        ("g.rs", "use crate::*;\n"),
    ]);
    assert_eq!(
        edges(&graph, "a"),
        ["b:2", "c:3,18", "d:4,4,17", "e:6", "f:6", "g:7,19"]
    );
    assert_eq!(
        edges(&graph, "b"),
        ["c:1", "d:2", "e:2,2", "f:2", "g:4", "lib.rs:1"]
    );
    assert_eq!(edges(&graph, "c"), ["lib.rs:1"]);
    assert_eq!(edges(&graph, "d"), ["b:1,2"]);
    assert_eq!(edges(&graph, "e"), ["b:2", "c:1"]);
    assert_eq!(edges(&graph, "f"), [""; 0]);
    assert_eq!(
        edges(&graph, "g"),
        ["a:1", "b:1", "c:1", "d:1", "e:1", "f:1", "lib.rs:1"]
    );
    assert_eq!(edges(&graph, ROOT), ["f:6"]);
}

#[test]
fn a_cycle_is_named_with_the_lines_that_close_it() {
    let (_folder, graph) = made_up(&[
        ("lib.rs", "mod a; mod b; mod c; mod d; mod e;"),
        ("a.rs", "\nuse crate::b::B;"),
        ("b.rs", "use crate::c::C;"),
        ("c.rs", "\n\nfn f() { crate::a::f() }\nuse crate::d::D;"),
        ("d.rs", ""),
        ("e.rs", "use crate::a::A;"),
    ]);
    let cycles = graph.cycles();
    assert_eq!(cycles.len(), 1);
    let modules: Vec<&str> = cycles[0].iter().map(String::as_str).collect();
    assert_eq!(modules, ["a", "b", "c"]);
    let text = graph.describe(|from, to| cycles[0].contains(from) && cycles[0].contains(to));
    assert_eq!(text.matches(" -> ").count(), 3, "{text}");
    assert!(
        text.contains("c -> a\n") && text.contains("c.rs:3 crate::a::f"),
        "{text}"
    );
}
