//! Sweeps, computed in this process or block by block on a cluster.

use std::{
    ops::ControlFlow,
    path::{Path, PathBuf},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
    },
};

use percuss::{
    document::read_text,
    sweep::{BatchKernel, Kernel, Stopped, Sweep as Loaded, SweepRow, SweepRun},
};
use percuss_cli::{start_threads, thread_pool};
use percuss_report::sweep::{Block, SweepFolder as Folder};
use pyo3::{exceptions::PyValueError, prelude::*, types::PyBytes};

use crate::{errors::raise, fork::with_threads, law::Laws, monitor::run_monitored};

/// A sweep that was read and checked.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct Sweep {
    sweep: Loaded,
    path: PathBuf,
    laws: Arc<Laws>,
}

#[pymethods]
impl Sweep {
    /// Reads a sweep file and the case that it names; strength laws go with a name that tells them from others.
    #[new]
    #[pyo3(signature = (path, projectile_law=None, target_law=None, law_name=String::new()))]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        projectile_law: Option<Py<PyAny>>,
        target_law: Option<Py<PyAny>>,
        law_name: String,
    ) -> PyResult<Self> {
        let mut sweep = Loaded::load(&path).map_err(|error| raise(py, error))?;
        let laws = Arc::new(Laws {
            projectile: projectile_law,
            target: target_law,
            ..Laws::default()
        });
        if let Ok(first) = sweep.run(0).scenario {
            laws.check(py, &first)?;
        }
        if !laws.are_none() {
            sweep = sweep.with_change(Arc::clone(&laws).as_change(law_name));
        }
        Ok(Self { sweep, path, laws })
    }

    /// Number of runs.
    #[getter]
    fn runs(&self) -> u64 {
        self.sweep.runs()
    }

    /// The files that it rests on: itself, its base case and the material files of that.
    fn files(&self, py: Python<'_>) -> PyResult<Vec<PathBuf>> {
        let base = &self.sweep.base;
        let mut files = vec![self.path.clone(), base.clone()];
        let text = read_text(base).map_err(|error| raise(py, error))?;
        let case: toml::Table = text
            .parse()
            .map_err(|error: toml::de::Error| PyValueError::new_err(error.to_string()))?;
        let materials = case.get("material_files").and_then(toml::Value::as_array);
        let folder = base.parent().unwrap_or(Path::new(""));
        let names = materials
            .into_iter()
            .flatten()
            .filter_map(toml::Value::as_str);
        files.extend(names.map(|name| folder.join(name)));
        Ok(files)
    }

    /// The file of a block, computed on this thread.
    fn block<'py>(&self, py: Python<'py>, block: u64) -> PyResult<Bound<'py, PyBytes>> {
        if block >= self.sweep.blocks() {
            return Err(PyValueError::new_err(format!("there is no block {block}")));
        }
        let stop = AtomicBool::new(false);
        let kernel = BatchKernel::new(self.sweep.model);
        start_threads().map_err(|failure| raise(py, failure))?;
        let computed =
            py.detach(|| with_threads(|| Block::compute(&self.sweep, &kernel, block, &stop)));
        match computed.map_err(|error| raise(py, error))? {
            Some(computed) => Ok(PyBytes::new(py, &computed.content)),
            None => Err(PyValueError::new_err("the block was stopped")),
        }
    }
}

/// A kernel whose rows count only while no law in Python has failed.
struct LawKernel<'a> {
    kernel: BatchKernel,
    laws: &'a Laws,
}

impl Kernel for LawKernel<'_> {
    fn rows(&self, runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped> {
        let rows = self.kernel.rows(runs, stop);
        match self.laws.flow() {
            ControlFlow::Continue(()) => rows,
            ControlFlow::Break(()) => {
                stop.store(true, Ordering::Relaxed);
                Err(Stopped)
            }
        }
    }
}

/// A folder that this process alone writes results to, until it is closed.
#[pyclass(frozen, module = "percuss._percuss")]
pub struct SweepFolder(Mutex<Option<Arc<Folder>>>);

impl SweepFolder {
    fn folder(&self) -> PyResult<Arc<Folder>> {
        let folder = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let closed = || PyValueError::new_err("the folder is closed");
        folder.as_ref().map(Arc::clone).ok_or_else(closed)
    }
}

#[pymethods]
impl SweepFolder {
    /// Makes the folder of a sweep, or takes one that holds a part of it when `resume` says so.
    #[new]
    fn new(
        py: Python<'_>,
        path: PathBuf,
        sweep: &Bound<'_, Sweep>,
        resume: bool,
    ) -> PyResult<Self> {
        let folder = Folder::open(&path, &sweep.get().sweep, resume);
        let folder = folder.map_err(|error| raise(py, error))?;
        Ok(Self(Mutex::new(Some(Arc::new(folder)))))
    }

    /// Lets other processes write to it: what refers to this object, such as the traceback of an error, may live long.
    fn close(&self) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = None;
    }

    /// The blocks that are missing of part `part` of `parts`, counted from 1.
    fn missing(&self, part: u64, parts: u64) -> PyResult<Vec<u64>> {
        Ok(self.folder()?.missing(part, parts))
    }

    /// Takes the file of a block that was computed elsewhere.
    fn put(&self, py: Python<'_>, block: u64, content: &[u8]) -> PyResult<()> {
        let folder = self.folder()?;
        folder.put(block, content).map_err(|error| raise(py, error))
    }
}

/// Computes what a folder lacks of part `part` of `parts`. Returns whether all of it was computed.
#[pyfunction]
#[pyo3(signature = (sweep, folder, part, parts, threads=None, progress=None))]
pub fn compute_sweep(
    py: Python<'_>,
    sweep: &Bound<'_, Sweep>,
    folder: &Bound<'_, SweepFolder>,
    part: u64,
    parts: u64,
    threads: Option<u16>,
    progress: Option<Py<PyAny>>,
) -> PyResult<bool> {
    let laws = &sweep.get().laws;
    let (sweep, folder) = (&sweep.get().sweep, folder.get().folder()?);
    let blocks = folder.missing(part, parts);
    let due: u64 = blocks
        .iter()
        .map(|block| folder.manifest().runs_in(*block))
        .sum();
    let computed = run_monitored(py, progress.as_ref(), |progress_state| {
        let done = AtomicU64::new(0);
        let on_progress = |rows: &[SweepRow]| {
            let done = done.fetch_add(rows.len() as u64, Ordering::Relaxed) + rows.len() as u64;
            // Whether to go on is asked of the progress_state by the folder itself.
            let _ = progress_state
                .on_progress(done as f64 / due as f64, &format!("{done} of {due} runs"));
        };
        let pool = thread_pool(threads)?;
        let kernel = LawKernel {
            kernel: BatchKernel::new(sweep.model),
            laws,
        };
        Ok(pool.install(|| {
            folder.compute(sweep, &kernel, &blocks, progress_state.stop(), &on_progress)
        })?)
    });
    match laws.take_error() {
        Some(error) => Err(error),
        None => computed,
    }
}
