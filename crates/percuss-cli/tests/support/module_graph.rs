//! The graph of a crate's top-level modules, read from its source: which module names which other one, and where.
//!
//! Test modules are left out: what stands under `#[cfg(test)]` may use anything.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use super::{
    module_source::{Source, read_tree},
    rust_tokens::{Piece, tokens},
};

/// Name of the node that stands for the items of `lib.rs` itself.
pub const ROOT: &str = "lib.rs";

/// The place in the source at which one module names another.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Mention {
    pub file: PathBuf,
    pub line: usize,
    pub path: String,
}

/// Top-level modules and the mentions that lead from one to another.
#[derive(Debug, Default)]
pub struct ModuleGraph {
    pub modules: BTreeSet<String>,
    pub edges: BTreeMap<(String, String), BTreeSet<Mention>>,
}

impl ModuleGraph {
    /// Reads a crate from its `lib.rs`.
    pub fn read(root: &Path) -> Self {
        let mut walk = Walk::default();
        walk.read_file(root, root.parent().unwrap(), &[]);
        walk.resolve()
    }

    /// The strongly connected components of more than one module: in each, every module leads to every other.
    pub fn cycles(&self) -> Vec<BTreeSet<String>> {
        let mut left = self.modules.clone();
        let mut cycles = Vec::new();
        while let Some(module) = left.first().cloned() {
            let ahead = self.reachable(&module, |(from, to)| (from, to));
            let behind = self.reachable(&module, |(from, to)| (to, from));
            let component: BTreeSet<_> = ahead.intersection(&behind).cloned().collect();
            left.retain(|module| !component.contains(module));
            if component.len() > 1 {
                cycles.push(component);
            }
        }
        cycles
    }

    fn reachable<'a>(
        &'a self,
        start: &'a String,
        turn: impl Fn((&'a String, &'a String)) -> (&'a String, &'a String),
    ) -> BTreeSet<String> {
        let mut found = BTreeSet::from([start.clone()]);
        let mut open = vec![start];
        while let Some(module) = open.pop() {
            for (from, to) in self.edges.keys().map(|(from, to)| turn((from, to))) {
                if from == module && found.insert(to.clone()) {
                    open.push(to);
                }
            }
        }
        found
    }

    /// The edges that a filter lets pass, one line per edge, with their mentions below.
    pub fn describe(&self, passes: impl Fn(&str, &str) -> bool) -> String {
        let mut text = String::new();
        for ((from, to), mentions) in self.edges.iter().filter(|((a, b), _)| passes(a, b)) {
            text += &format!("  {from} -> {to}\n");
            for Mention { file, line, path } in mentions {
                text += &format!("    {}:{line} {path}\n", file.display());
            }
        }
        text
    }
}

/// A path of the source, from the crate's root, and the module that it stands in.
struct Found {
    within: Vec<String>,
    segments: Vec<String>,
    at: Mention,
}

#[derive(Default)]
struct Walk {
    modules: BTreeSet<String>,
    /// Names that `lib.rs` re-exports, and the modules that they come from.
    exported: BTreeMap<String, String>,
    /// Modules that `lib.rs` re-exports all names of.
    exported_whole: BTreeSet<String>,
    found: Vec<Found>,
}

impl Walk {
    fn read_file(&mut self, file: &Path, folder: &Path, module: &[String]) {
        let text =
            fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let mut source = Source {
            file,
            tokens: tokens(&text),
            at: 0,
            module: module.to_vec(),
            braces: Vec::new(),
        };
        while source.token(0).is_some() {
            self.step(&mut source, folder, module.len());
        }
    }

    fn step(&mut self, source: &mut Source<'_>, folder: &Path, depth: usize) {
        if source.is(0, '#') && (source.is(1, '[') || source.is(1, '!')) {
            self.read_attribute(source);
        } else if source.is(0, '{') {
            source.braces.push(false);
            source.at += 1;
        } else if source.is(0, '}') {
            if source.braces.pop() == Some(true) {
                source.module.pop();
            }
            source.at += 1;
        } else if source.name(0) == Some("mod") && source.name(1).is_some() {
            self.read_module(source, folder, depth);
        } else if source.name(0) == Some("use") {
            self.read_use(source);
        } else if source.name(0).is_some() {
            self.read_path(source);
        } else {
            source.at += 1;
        }
    }

    /// Reads an attribute: one that sets a test apart with its item, the paths of any other one.
    fn read_attribute(&mut self, source: &mut Source<'_>) {
        let start = source.at;
        let names = source.attribute();
        let line = source.tokens[start].line;
        let conditional = names.first().is_some_and(|name| name == "cfg");
        let of_tests = names.iter().any(|name| name == "test" || name == "doctest");
        if conditional && of_tests && !names.iter().any(|name| name == "not") {
            source.skip_item();
            return;
        }
        assert!(
            names.first().is_none_or(|name| name != "path"),
            "{}:{line}: the module graph does not follow `path`",
            source.file.display()
        );
        // An exported macro is a name of the root: `macro_rules`, `!`, name.
        if names.first().is_some_and(|name| name == "macro_export")
            && let (Some(name), Some(module)) = (source.name(2), source.module.first())
        {
            self.exported.insert(name.to_owned(), module.clone());
        }
        let end = source.at;
        source.at = start;
        while source.at < end {
            if let Some(Piece::Text(text)) = source.token(0).map(|token| &token.piece) {
                let path: Vec<String> = text.split("::").map(str::to_owned).collect();
                let line = source.token(0).map_or(line, |token| token.line);
                if path.len() > 1 {
                    self.add(source, path, line);
                }
                source.at += 1;
            } else if source.name(0).is_some() {
                self.read_path(source);
            } else {
                source.at += 1;
            }
        }
    }

    fn read_module(&mut self, source: &mut Source<'_>, folder: &Path, depth: usize) {
        let name = source.name(1).unwrap().to_owned();
        if source.module.is_empty() {
            self.modules.insert(name.clone());
        }
        let mut module = source.module.clone();
        module.push(name.clone());
        if source.is(2, '{') {
            source.module = module;
            source.braces.push(true);
        } else {
            // Inline modules of this file are folders below its own.
            let folder = source.module[depth..]
                .iter()
                .fold(folder.to_owned(), |a, b| a.join(b));
            let flat = folder.join(format!("{name}.rs"));
            let file = if flat.is_file() {
                flat
            } else {
                folder.join(&name).join("mod.rs")
            };
            self.read_file(&file, &folder.join(&name), &module);
        }
        source.at += 3;
    }

    fn read_use(&mut self, source: &mut Source<'_>) {
        let line = source.token(0).unwrap().line;
        // `pub use` and `pub(crate) use`.
        let is_public = source
            .before(1)
            .is_some_and(|token| token.is_name("pub") || token.is(')'));
        source.at += 1;
        let mut leaves = Vec::new();
        read_tree(source, &[], line, &mut leaves);
        for (segments, name, line) in leaves {
            let first = segments.first().cloned().unwrap_or_default();
            let relative = !["crate", "super", "self"].contains(&first.as_str());
            if source.module.is_empty() && relative {
                // A module below sees every name that the root has, those of a private `use` too.
                if name == "*" {
                    self.exported_whole.insert(first);
                } else {
                    self.exported.insert(name, first);
                }
            }
            // A re-export by the root is a name of its module, not a use of it.
            if !(source.module.is_empty() && is_public) {
                self.add(source, segments, line);
            }
        }
    }

    /// A path in an expression, a type or the body of a macro.
    fn read_path(&mut self, source: &mut Source<'_>) {
        let line = source.token(0).unwrap().line;
        let visibility = source.before(1).is_some_and(|token| token.is_name("in"))
            && source.before(2).is_some_and(|token| token.is('('))
            && source.before(3).is_some_and(|token| token.is_name("pub"));
        let continues = source
            .before(1)
            .is_some_and(|token| token.piece == Piece::PathSeparator);
        let mut segments = vec![source.name(0).unwrap().to_owned()];
        source.at += 1;
        while source.separates(0) && source.name(1).is_some() {
            segments.extend(source.name(1).map(str::to_owned));
            source.at += 2;
        }
        if segments.len() > 1 && !visibility && !continues {
            self.add(source, segments, line);
        }
    }

    /// Keeps a path that starts at the crate's root or at a module above; one that starts at a name in scope was imported.
    fn add(&mut self, source: &Source<'_>, segments: Vec<String>, line: usize) {
        let at = Mention {
            file: source.file.to_owned(),
            line,
            path: segments.join("::"),
        };
        let mut base = source.module.clone();
        let mut rest = segments.as_slice();
        match rest.first().map(String::as_str) {
            Some("crate") => {
                base.clear();
                rest = &rest[1..];
            }
            Some("self" | "super") => {
                while let Some(first @ ("self" | "super")) = rest.first().map(String::as_str) {
                    if first == "super" {
                        base.pop();
                    }
                    rest = &rest[1..];
                }
            }
            _ if base.is_empty() => {}
            _ => return,
        }
        base.extend(rest.iter().cloned());
        self.found.push(Found {
            within: source.module.clone(),
            segments: base,
            at,
        });
    }

    fn resolve(self) -> ModuleGraph {
        let mut graph = ModuleGraph {
            modules: self.modules.clone(),
            edges: BTreeMap::new(),
        };
        graph.modules.insert(ROOT.to_owned());
        for Found {
            within,
            segments,
            at,
        } in &self.found
        {
            let from = within.first().map_or(ROOT, String::as_str);
            for to in self.targets(segments, from) {
                if to != from {
                    let edge = (from.to_owned(), to.to_owned());
                    graph.edges.entry(edge).or_default().insert(at.clone());
                }
            }
        }
        graph
    }

    /// The top-level modules that a path from the root may lead to.
    fn targets<'a>(&'a self, segments: &'a [String], from: &str) -> Vec<&'a str> {
        let Some(first) = segments.first() else {
            return vec![ROOT];
        };
        if self.modules.contains(first) {
            vec![first]
        } else if let Some(module) = self.exported.get(first) {
            // A name of another crate leads to no module.
            self.modules
                .get(module)
                .map(String::as_str)
                .into_iter()
                .collect()
        } else if from == ROOT {
            // A name from another crate, or one of the root's own.
            Vec::new()
        } else if first == "*" {
            // All names of the root, which are those of its modules.
            let all = self.modules.iter().map(String::as_str);
            all.chain([ROOT]).collect()
        } else {
            let whole = self.exported_whole.intersection(&self.modules);
            whole.map(String::as_str).chain([ROOT]).collect()
        }
    }
}
