//! `percuss export`: input for other codes.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use percuss::{case, model::Control, particles};
use serde::Serialize;

use crate::{
    failure::Failure,
    file_list::FileList,
    output,
    response::{Response, VirtualFiles},
    run_folder::RunFolder,
    terminal::{bold, width, wrap},
};

const LONG_ABOUT: &str = "\
Write the input of another code for a case.

For LAMMPS: the particles and bonds that a run of the model `particles` starts
from, its rigid wall or round-nosed projectile, its time step and its duration.
Bonds that break are refused. LAMMPS runs the input over many processors, with
its packages BPM and MOLECULE. The README of the folder says what LAMMPS
computes otherwise.";

const AFTER_HELP: &str = "\
Examples:
  percuss export cases/rigid-on-glass-plane/scenario.toml --to lammps --out deck
  cd deck && lmp -in impact.in
  cd deck && mpirun -n 8 lmp -in impact.in -var steps 20000

Exit codes: 0 ok, 2 bad input or a case that the code cannot take, 4 a file
could not be read or written";

/// Write the input of another code for a case
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Export {
    /// Case file
    #[arg(value_name = "CASE.toml")]
    case: PathBuf,
    /// The code
    #[arg(long, value_enum, value_name = "CODE")]
    to: Code,
    /// Folder for the input; made if it does not exist
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Print one JSON object and nothing else on standard output
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Code {
    /// LAMMPS, for bonded particles
    Lammps,
}

/// Result of the command.
#[derive(Debug, Serialize)]
struct Exported {
    code: &'static str,
    /// Particles of the lattice.
    particles: usize,
    /// Whole bonds.
    bonds: usize,
    /// Time step [s].
    time_step_s: f64,
    /// Time steps of the run.
    steps: u64,
    /// What the other code computes otherwise.
    differences: Vec<String>,
}

impl Export {
    pub fn run(&self) -> Result<(), Failure> {
        let (exported, files) = self.export(&VirtualFiles::default())?;
        let list = FileList::new(&files);
        if self.json {
            return list.print_json(&exported, false);
        }
        let mut text = format!(
            "{}\n{} particles, {} bonds, {} steps of {:.3e} s\n",
            bold("Input for LAMMPS"),
            exported.particles,
            exported.bonds,
            exported.steps,
            exported.time_step_s
        );
        for difference in &exported.differences {
            text += &format!("{}\n", wrap(difference, width(), 2));
        }
        list.print_under(text)
    }

    /// Output of --json.
    pub fn execute(&self, virtual_files: &VirtualFiles) -> Result<Response, Failure> {
        let (exported, files) = self.export(virtual_files)?;
        Response::json_of(&exported, files)
    }

    fn export(&self, virtual_files: &VirtualFiles) -> Result<(Exported, Vec<PathBuf>), Failure> {
        let Code::Lammps = self.to;
        let case = virtual_files.read(&self.case)?;
        let scenario = case::scenario(&case)?;
        let made = particles::lammps(&scenario, &mut Control::default())?;
        let exported = Exported {
            code: "lammps",
            particles: made.particles,
            bonds: made.bonds,
            time_step_s: made.time_step,
            steps: made.steps,
            differences: made.differences,
        };
        let mut folder = RunFolder::create(&self.out, Some(&case))?;
        folder.put("impact.in", made.input.as_bytes())?;
        folder.put("particles.data", made.data.as_bytes())?;
        folder.put("README.md", readme(&scenario.name, &exported).as_bytes())?;
        folder.put("export.json", output::json(&exported)?.as_bytes())?;
        Ok((exported, folder.written()))
    }
}

/// Text of the folder for its readers.
fn readme(name: &str, exported: &Exported) -> String {
    let list: String = exported
        .differences
        .iter()
        .map(|words| format!("- {words}\n"))
        .collect();
    format!(
        "# {name}\n\n\
        Input for LAMMPS with the packages BPM and MOLECULE; tried with its version of 22 July 2025.\n\n\
        ```\n\
        lmp -in impact.in\n\
        mpirun -n 8 lmp -in impact.in -var steps 20000 -var every 200\n\
        ```\n\n\
        SI units per metre of width: masses are in kg/m, forces in N/m. `x` is across the direction of impact, `y` the depth below the \
        struck face. Atoms of type 1 are free, of type 2 on the support, of type 3 the projectile.\n\n\
        The log has the mean velocity [m/s] and place [m] of the projectile, or of the strip on a wall. OVITO opens `particles.data` and `particles.dump`.\n\n\
        ## What differs from a run of percuss\n\n{list}"
    )
}
