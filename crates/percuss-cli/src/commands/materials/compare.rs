//! `percuss materials compare`: flow curves of several materials.

use std::path::PathBuf;

use clap::Args;
use percuss::{
    material::{Library, MaterialEntry},
    units::{StrainRate, Temperature, significant},
};
use percuss_report::{FlowCurve, flow_figure, material_label, table::Table};
use serde::Serialize;

use super::show;
use crate::{
    failure::Failure, figure_formats::FigureArgs, file_list::FileList, output, response::Response,
    run_folder::RunFolder, table::plain,
};

const LONG_ABOUT: &str = "\
Compare the flow curves of materials: stress against plastic strain at constant
strain rates and at one constant temperature, without pressure. A run heats the
material as it deforms; a flow curve does not.

With --out DIR the curves are written as flow-curves.json, and drawn as SVG and
PNG: one colour a material, one kind of line a strain rate. Beyond six materials
colours return with other kinds of lines, so that 48 curves differ.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials compare rha 4340 1006
  percuss materials compare ofhc ofhc-copper-steinberg --rate '1e5 1/s'
  percuss materials compare 6061 7039 --temperature '400 K' --out curves

Exit codes: 0 ok, 2 bad input or no such material, 4 a file could not be read or
written";

/// Plastic strains of the table.
const STRAINS: [f64; 4] = [0.0, 0.02, 0.1, LARGEST_STRAIN];
/// Plastic strain at which curves end.
const LARGEST_STRAIN: f64 = 0.5;
/// Least and largest strain rate [1/s].
const RATES: [f64; 2] = [1e-8, 1e9];
/// Least and largest temperature [K].
const TEMPERATURES: [f64; 2] = [1.0, 6000.0];

/// Compare the flow curves of materials
#[derive(Debug, Args)]
#[command(long_about = LONG_ABOUT, after_help = AFTER_HELP)]
pub struct Compare {
    /// Ids, families or aliases of the materials
    #[arg(required = true, value_name = "NAMES")]
    names: Vec<String>,
    /// Plastic strain rate; repeat the option for several
    #[arg(long, value_name = "RATE", value_parser = rate)]
    #[arg(default_values = ["0.001 1/s", "1000 1/s"])]
    rate: Vec<StrainRate>,
    /// Temperature; each material's own room temperature when not given
    #[arg(long, value_name = "TEMPERATURE", value_parser = temperature)]
    temperature: Option<Temperature>,
    /// Write flow-curves.json and the figure to a folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    pub figures: FigureArgs,
}

/// A flow curve as JSON.
#[derive(Debug, Serialize)]
struct Curve {
    /// Id of the material.
    material: String,
    /// Plastic strain rate [1/s].
    strain_rate_per_s: f64,
    /// Temperature [K].
    temperature_k: f64,
    /// Plastic strains.
    plastic_strain: Vec<f64>,
    /// Flow stresses [MPa].
    flow_stress_mpa: Vec<f64>,
}

/// A material at a strain rate: plastic strains and stresses [Pa].
struct Computed<'a> {
    entry: &'a MaterialEntry,
    /// Name of the material in the legend.
    label: String,
    /// Numbers of the material and of the rate.
    place: [usize; 2],
    rate: StrainRate,
    temperature: f64,
    curve: Vec<(f64, f64)>,
    /// Stresses at `STRAINS`.
    stresses: [f64; STRAINS.len()],
}

impl Compare {
    pub fn run(&self, library: &Library, json: bool) -> Result<(), Failure> {
        let computed = self.compute(library)?;
        let (curves, files) = self.write(&computed)?;
        if json {
            return output::print_json(&curves);
        }
        FileList::new(&files).print_under(table(&computed))
    }

    /// Output of --json.
    pub fn execute(&self, library: &Library) -> Result<Response, Failure> {
        let (curves, files) = self.write(&self.compute(library)?)?;
        Response::json_of(&curves, files)
    }

    fn compute<'a>(&self, library: &'a Library) -> Result<Vec<Computed<'a>>, Failure> {
        let mut computed = Vec::new();
        let found = self.names.iter().map(|name| show::find(library, name));
        let entries = found.collect::<Result<Vec<_>, _>>()?;
        for (material, entry) in entries.iter().enumerate() {
            let name = &entry.material.name;
            let same = entries.iter().filter(|other| other.material.name == *name);
            // Records of one name are told apart by their ids.
            let label = match same.count() {
                1 => material_label(name, &entry.id),
                _ => &entry.id,
            };
            for (index, rate) in self.rate.iter().enumerate() {
                computed.push(self.curve(entry, label, *rate, [material, index])?);
            }
        }
        Ok(computed)
    }

    fn curve<'a>(
        &self,
        entry: &'a MaterialEntry,
        label: &str,
        rate: StrainRate,
        place: [usize; 2],
    ) -> Result<Computed<'a>, Failure> {
        let own = entry.material.room_temperature;
        let temperature = self.temperature.unwrap_or(own).si();
        let curve = entry.material.flow_curve(rate.si(), temperature);
        let Some(curve) = curve else {
            return Err(Failure::Material {
                message: format!("`{}` has no flow curve", entry.id),
                help: format!(
                    "its strength law `{}` never flows",
                    entry.material.strength.key()
                ),
            });
        };
        Ok(Computed {
            entry,
            label: label.to_owned(),
            place,
            rate,
            temperature,
            stresses: STRAINS.map(|strain| curve.stress(strain)),
            curve: curve.points(LARGEST_STRAIN),
        })
    }

    fn write(&self, computed: &[Computed<'_>]) -> Result<(Vec<Curve>, Vec<PathBuf>), Failure> {
        let curves: Vec<Curve> = computed.iter().map(Computed::record).collect();
        let mut folder = RunFolder::wanted(self.out.as_deref(), None, self.figures.formats())?;
        if let Some(folder) = &mut folder {
            folder.put("flow-curves.json", output::json(&curves)?.as_bytes())?;
            let shown: Vec<FlowCurve> = computed.iter().map(Computed::shown).collect();
            let figure = flow_figure(&shown, &self.caption());
            folder.add_figures(&[figure])?;
        }
        Ok((curves, folder.map_or_else(Vec::new, RunFolder::written)))
    }

    fn caption(&self) -> String {
        match self.temperature {
            Some(temperature) => format!("isothermal at {temperature}, no pressure"),
            None => "isothermal at the room temperature of each record, no pressure".to_owned(),
        }
    }
}

impl Computed<'_> {
    fn record(&self) -> Curve {
        Curve {
            material: self.entry.id.clone(),
            strain_rate_per_s: self.rate.si(),
            temperature_k: self.temperature,
            plastic_strain: self.curve.iter().map(|point| point.0).collect(),
            flow_stress_mpa: self.curve.iter().map(|point| point.1 * 1e-6).collect(),
        }
    }

    fn shown(&self) -> FlowCurve {
        let [material, rate] = self.place;
        FlowCurve {
            name: self.label.clone(),
            rate_name: self.rate.to_string(),
            material,
            rate,
            points: self.curve.clone(),
        }
    }
}

/// Flow stresses at a few strains, one row a curve.
fn table(computed: &[Computed<'_>]) -> String {
    let mut table = Table::of(computed)
        .words("flow stress [MPa] of", |row| row.entry.id.clone())
        .words("strain rate", |row| row.rate.to_string());
    for (index, strain) in STRAINS.iter().enumerate() {
        let name = format!("at strain {strain}");
        table = table.numbers(&name, "", move |row| {
            significant(row.stresses[index] * 1e-6, 4).to_string()
        });
    }
    plain(&table.table(), 1)
}

fn rate(text: &str) -> Result<StrainRate, String> {
    let rate: StrainRate = text.parse().map_err(|error| format!("{error}"))?;
    within(rate.si(), RATES, "1/s").map(|()| rate)
}

fn temperature(text: &str) -> Result<Temperature, String> {
    let temperature: Temperature = text.parse().map_err(|error| format!("{error}"))?;
    within(temperature.si(), TEMPERATURES, "K").map(|()| temperature)
}

fn within(value: f64, [least, most]: [f64; 2], unit: &str) -> Result<(), String> {
    match (least..=most).contains(&value) {
        true => Ok(()),
        false => Err(format!(
            "it must be from {least:e} {unit} to {most:e} {unit}"
        )),
    }
}
