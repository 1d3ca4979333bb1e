//! The top-level modules of every crate form layers: no two of them use each other, directly or through others.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use tempfile::TempDir;

use crate::support::{
    module_graph::{ModuleGraph, ROOT},
    names_in,
};

/// The layers of the library from the lowest up: a module uses modules of its own layer and of lower ones.
const LAYERS: &[(&str, &[&str])] = &[
    (
        "core",
        &[
            "check",
            "document",
            "error",
            "fragments",
            "guard",
            "history",
            "lanes",
            "ledger",
            "material",
            "options",
            "outcome",
            "power",
            "problem",
            "refusal",
            "regime",
            "resistance",
            "richardson",
            "scenario",
            "shapes",
            "solver",
            "statistics",
            "units",
        ],
    ),
    ("models", &["analytic", "axi", "chain", "fdm", "model"]),
    ("input", &["case", "inputs"]),
    (
        "studies",
        &[
            "calibrate",
            "compare",
            "converge",
            "limit",
            "model_error",
            "shots",
            "summary",
            "sweep",
            "uncertainty",
            "v50",
            "validate",
        ],
    ),
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

#[test]
fn no_module_of_the_library_uses_a_higher_layer() {
    let graph = ModuleGraph::read(&crates()["percuss"]);
    let layer = |module: &str| {
        LAYERS
            .iter()
            .position(|(_, modules)| modules.contains(&module))
    };
    let listed: usize = LAYERS.iter().map(|(_, modules)| modules.len()).sum();
    for module in graph.modules.iter().filter(|module| *module != ROOT) {
        assert!(layer(module).is_some(), "module `{module}` has no layer");
    }
    assert_eq!(
        listed,
        graph.modules.len() - 1,
        "a layer lists a module that does not exist"
    );
    let text = graph.describe(|from, to| layer(from) < layer(to));
    assert!(
        text.is_empty(),
        "these edges lead to a higher layer:\n{text}"
    );
}

/// The estimate of the model error is added to the record of a result: what runs a case is independent of benchmarks and published tests.
#[test]
fn no_run_consults_a_benchmark() {
    let graph = ModuleGraph::read(&crates()["percuss"]);
    let tables = ["model_error", "shots", "validate"];
    assert!(tables.iter().all(|table| graph.modules.contains(*table)));
    let runs = |module: &str| LAYERS[..3].iter().any(|(_, names)| names.contains(&module));
    let text = graph.describe(|from, to| (runs(from) || from == ROOT) && tables.contains(&to));
    assert!(text.is_empty(), "{text}");
    let consults = graph.describe(|from, to| from == "summary" && to == "model_error");
    assert!(!consults.is_empty(), "who adds the estimate?");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../percuss/data");
    assert_eq!(
        names_in(&data),
        ["lanz-odermatt.csv", "model-error", "shots"]
    );
}

/// The program alone uses the crate of the project's own research.
#[test]
fn no_product_crate_needs_the_research() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let users = names_in(&folder).into_iter().filter(|name| {
        let manifest = fs::read_to_string(folder.join(name).join("Cargo.toml"));
        manifest.is_ok_and(|text| text.contains("\npercuss-research"))
    });
    assert_eq!(users.collect::<Vec<_>>(), ["percuss-cli"]);
    for module in ["damping", "judge", "judgement", "paper", "study"] {
        for name in ["percuss", "percuss-report"] {
            let graph = ModuleGraph::read(&crates()[name]);
            assert!(!graph.modules.contains(module), "{name}: {module}");
        }
    }
}

/// The solvers check each other, so they share nothing but what lies below all of them.
#[test]
fn no_kind_of_model_uses_another() {
    let graph = ModuleGraph::read(&crates()["percuss"]);
    let kinds = ["analytic", "axi", "chain", "fdm"];
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
            "pub mod deep; use crate::{Own, Sea};\nmacro_rules! m { () => { $crate::d::make!() } }\n",
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
            "fn f() { for x in crate::c::list() { g::no::path(x) } }\n",
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
    assert_eq!(edges(&graph, "e"), ["c:1"]);
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
