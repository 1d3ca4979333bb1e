//! `percuss materials compare`: flow curves of several materials.

use std::path::PathBuf;

use clap::Args;
use percuss::{
    material::{Library, MaterialEntry},
    units::{StrainRate, Temperature, significant},
};
use percuss_report::{FlowCurve, flow_figure, table::Table};
use serde::Serialize;

use super::show;
use crate::{
    failure::Failure, file_list::FileList, output, response::Response, run_folder::RunFolder,
    table::plain,
};

const LONG_ABOUT: &str = "\
Compare the flow curves of materials: stress against plastic strain at constant
strain rates and at one constant temperature, without pressure. A run heats the
material as it deforms; a flow curve does not.

With --out DIR the curves are written as flow-curves.json, and drawn as SVG and
PNG.";

const AFTER_HELP: &str = "\
Examples:
  percuss materials compare rha 4340 1006
  percuss materials compare ofhc ofhc-copper-steinberg --rate '1e5 1/s'
  percuss materials compare 6061 7039 --temperature '400 K' --out curves

Exit codes: 0 ok, 2 bad input or no such material, 4 a file could not be read or
written";

/// Plastic strains of the table.
const STRAINS: [f64; 4] = [0.0, 0.02, 0.1, 0.5];
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

impl Compare {
    pub fn run(&self, library: &Library, json: bool) -> Result<(), Failure> {
        let (curves, files) = self.compute(library)?;
        if json {
            return output::print_json(&curves);
        }
        FileList::new(&files).print_under(self.table(library)?)
    }

    /// Output of --json.
    pub fn execute(&self, library: &Library) -> Result<Response, Failure> {
        let (curves, files) = self.compute(library)?;
        Response::json_of(&curves, files)
    }

    fn entries<'a>(&self, library: &'a Library) -> Result<Vec<&'a MaterialEntry>, Failure> {
        let names = self.names.iter();
        names.map(|name| show::find(library, name)).collect()
    }

    fn temperature_of(&self, entry: &MaterialEntry) -> f64 {
        let own = entry.material.room_temperature;
        self.temperature.unwrap_or(own).si()
    }

    /// Strains and stresses [Pa] of a material.
    fn points(
        &self,
        entry: &MaterialEntry,
        rate: StrainRate,
        largest: f64,
    ) -> Result<Vec<(f64, f64)>, Failure> {
        let temperature = self.temperature_of(entry);
        let curve = entry.material.flow_curve(largest, rate.si(), temperature);
        curve.ok_or_else(|| Failure::Material {
            message: format!("`{}` has no flow curve", entry.id),
            help: format!(
                "its strength law `{}` never flows",
                entry.material.strength.key()
            ),
        })
    }

    fn compute(&self, library: &Library) -> Result<(Vec<Curve>, Vec<PathBuf>), Failure> {
        let entries = self.entries(library)?;
        let mut folder = RunFolder::wanted(self.out.as_deref(), None)?;
        let (mut curves, mut shown) = (Vec::new(), Vec::new());
        for (index, entry) in entries.iter().enumerate() {
            for rate in &self.rate {
                let points = self.points(entry, *rate, STRAINS[STRAINS.len() - 1])?;
                curves.push(Curve {
                    material: entry.id.clone(),
                    strain_rate_per_s: rate.si(),
                    temperature_k: self.temperature_of(entry),
                    plastic_strain: points.iter().map(|point| point.0).collect(),
                    flow_stress_mpa: points.iter().map(|point| point.1 * 1e-6).collect(),
                });
                shown.push(FlowCurve {
                    name: format!("{}, {rate}", entry.id),
                    material: index,
                    points,
                });
            }
        }
        if let Some(folder) = &mut folder {
            folder.put("flow-curves.json", output::json(&curves)?.as_bytes())?;
            let figure = flow_figure(&shown, &self.caption());
            folder.add(figure.write(folder.path())?);
        }
        Ok((curves, folder.map_or_else(Vec::new, RunFolder::written)))
    }

    fn caption(&self) -> String {
        match self.temperature {
            Some(temperature) => format!("isothermal at {temperature}, no pressure"),
            None => "isothermal at the room temperature of each record, no pressure".to_owned(),
        }
    }

    /// Flow stresses at a few strains, one row a curve.
    fn table(&self, library: &Library) -> Result<String, Failure> {
        let mut rows: Vec<[String; 6]> = Vec::new();
        for entry in self.entries(library)? {
            for rate in &self.rate {
                let mut row = [entry.id.clone(), rate.to_string()].to_vec();
                for strain in STRAINS {
                    let points = self.points(entry, *rate, strain)?;
                    let stress = points.last().map_or(f64::NAN, |point| point.1);
                    row.push(significant(stress * 1e-6, 4).to_string());
                }
                rows.extend(<[String; 6]>::try_from(row));
            }
        }
        let mut table = Table::of(&rows)
            .words("flow stress [MPa] of", |row| row[0].clone())
            .words("strain rate", |row| row[1].clone());
        for (index, strain) in STRAINS.iter().enumerate() {
            let name = format!("at strain {strain}");
            table = table.numbers(&name, "", move |row| row[index + 2].clone());
        }
        Ok(plain(&table.table(), 1))
    }
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
