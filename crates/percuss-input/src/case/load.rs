//! Case files: reading, checks, and conversion to a scenario; errors name the place.

use std::{collections::BTreeMap, path::Path};

use super::{Case, load_materials, measured_curves::measured_curves, resolve::resolve};
use crate::{
    check::{Check, Diagnostic},
    document::Document,
    error::Error,
    material::Library,
    problem::{Gauge, MeasuredTable},
    scenario::Scenario,
};

/// Reads a case file and everything that it names.
///
/// # Errors
/// [`Error::Read`] when a file cannot be read, [`Error::Input`] when its content is not valid.
pub fn load(path: impl AsRef<Path>) -> Result<Scenario, Error> {
    scenario(&Document::read(path)?)
}

/// Reads a case from a text; `name` stands for the file in messages.
///
/// # Errors
/// [`Error::Input`] when the text is not a valid case. A text cannot name material files.
pub fn load_str(name: &str, text: &str) -> Result<Scenario, Error> {
    scenario(&Document::new(name, text))
}

/// The materials that a case can name: the built-in ones, its own and those of its material files.
///
/// # Errors
/// Those of [`load`], but what the case describes beside its materials need not fit together.
pub fn library(document: &Document) -> Result<Library, Error> {
    let case: Case = document.parse()?;
    let mut diagnostics = Vec::new();
    case.check_materials(&mut Check::new(&mut diagnostics));
    document.report(diagnostics)?;
    library_of(&case, document)
}

/// The case that it describes, with everything that it names.
///
/// # Errors
/// [`Error::Input`] when it is not valid, or a file that it names.
pub fn scenario(document: &Document) -> Result<Scenario, Error> {
    let case: Case = document.parse()?;
    let mut scenario = scenario_of_models(document)?;
    scenario.measured_curves = measured_curves(&case, document)?;
    Ok(scenario)
}

/// The same without what no model sees: the curves of other files.
pub(super) fn scenario_of_models(document: &Document) -> Result<Scenario, Error> {
    let case: Case = document.parse()?;
    let mut diagnostics = Vec::new();
    case.check(&mut Check::new(&mut diagnostics));
    document.report(diagnostics)?;

    let library = library_of(&case, document)?;
    let mut diagnostics = Vec::new();
    let scenario = resolve(
        &document.name,
        case,
        &library,
        &mut Check::new(&mut diagnostics),
    );
    document.report(diagnostics)?;
    scenario.ok_or_else(|| {
        let diagnostic = Diagnostic::whole("the case could not be resolved", "");
        document.place(diagnostic).into()
    })
}

/// The built-in materials with those of a case.
pub(super) fn library_of(case: &Case, document: &Document) -> Result<Library, Error> {
    let mut library = Library::built_in().clone();
    library.add(&case.materials, &format!("{} (this case)", document.name));
    let mut given: BTreeMap<String, &Path> = BTreeMap::new();
    for (i, relative) in case.material_files.iter().enumerate() {
        let refuse = |message: &str, help: &str| {
            Diagnostic::at(&format!("material_files.{i}"), message, help)
        };
        let Some(folder) = &document.folder else {
            let message = "a case that comes from no file cannot name material files";
            let help = "put the materials into its `materials` table";
            return Err(document.place(refuse(message, help).of_material()).into());
        };
        let table = match load_materials(folder.join(relative)) {
            // The case names the file, so the place in the case is what a user has to look at.
            Err(error @ Error::Read { .. }) => {
                let (message, remedy) = error.message_and_help();
                let help = "paths in `material_files` are relative to the case file";
                let help = match remedy.as_str() {
                    "" => help.to_owned(),
                    remedy => format!("{remedy}; {help}"),
                };
                let refusal = refuse(&message, &help).of_material_file();
                return Err(document.place(refusal).into());
            }
            other => other?,
        };
        // One of the two would be ignored.
        if let Some(id) = table.keys().find(|id| case.materials.contains_key(*id)) {
            let message = format!(
                "the material `{id}` is given by the case and by the file `{}`",
                relative.display()
            );
            let help = "rename or remove one of the two";
            let diagnostic = Diagnostic::at(&format!("materials.{id}"), message, help);
            return Err(document.place(diagnostic.of_material()).into());
        }
        if let Some((id, first)) = table.keys().find_map(|id| given.get_key_value(id)) {
            let message = format!(
                "the material `{id}` is given by the files `{}` and `{}`",
                first.display(),
                relative.display()
            );
            let help = "rename or remove one of the two";
            return Err(document.place(refuse(&message, help).of_material()).into());
        }
        given.extend(table.keys().map(|id| (id.clone(), relative.as_path())));
        library.add(&table, &relative.display().to_string());
    }
    Ok(library)
}

impl Case {
    /// The scenario of a case that is built in code; `name` stands for it in results and errors.
    ///
    /// ```
    /// use percuss::{
    ///     case::{Case, Projectile, Target},
    ///     model::{self, Control},
    ///     units::{Length, Velocity},
    /// };
    ///
    /// let mm = |value: f64| Length::new(1e-3 * value);
    /// let rod = Projectile::rod("copper", mm(12.74), mm(4.8), Velocity::new(230.0));
    /// let mut case = Case::new(rod, Target::plate("aluminium-2024-t351", mm(25.0)));
    /// case.chain.projectile_elements = Some(80);
    /// let scenario = case.scenario("copper-on-aluminium")?;
    /// let result = model::run(model::model("chain")?, &scenario, &mut Control::default())?;
    /// assert!(result.depth_of_penetration.is_some());
    /// # Ok::<(), percuss::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Input`] with the key of what is wrong.
    pub fn scenario(self, name: &str) -> Result<Scenario, Error> {
        let document = Document::new(name, "");
        if !self.material_files.is_empty() {
            let message = "a case that comes from no file cannot name material files";
            let help = "put the materials into its `materials` table";
            let diagnostic = Diagnostic::at("material_files", message, help).of_material();
            return Err(document.place(diagnostic).into());
        }
        let curves = measured_curves(&self, &document)?;
        let scenario = self
            .into_scenario(name, Library::built_in())
            .map_err(|diagnostics| {
                let unknown = || Diagnostic::whole("the case could not be resolved", "");
                let first = diagnostics.into_iter().next().unwrap_or_else(unknown);
                Error::from(document.place(first))
            })?;
        Ok(Scenario {
            measured_curves: curves,
            ..scenario
        })
    }

    /// The scenario of a case that comes from no text, its own materials included; otherwise what is wrong with it.
    pub fn into_scenario(self, name: &str, library: &Library) -> Result<Scenario, Vec<Diagnostic>> {
        let mut diagnostics = Vec::new();
        self.check(&mut Check::new(&mut diagnostics));
        if !diagnostics.is_empty() {
            return Err(diagnostics);
        }
        let mut own = None;
        if !self.materials.is_empty() {
            own.insert(library.clone()).add(&self.materials, name);
        }
        let library = own.as_ref().unwrap_or(library);
        let scenario = resolve(name, self, library, &mut Check::new(&mut diagnostics));
        scenario
            .filter(|_| diagnostics.is_empty())
            .ok_or(diagnostics)
    }

    fn check(&self, check: &mut Check<'_>) {
        self.projectile.check(&mut check.within("projectile"));
        self.target.check(&mut check.within("target"));
        self.model_options().check(check, &self.target);
        Gauge::check_all(&self.gauges, check);
        self.history.check(&mut check.within("history"));
        MeasuredTable::check_all(&self.measured_curves, &self.gauges, check);
        for (i, experiment) in self.experiments.iter().enumerate() {
            let mut check = check.within(&format!("experiments.{i}"));
            experiment.check(&mut check, &self.target);
        }
        if let Some(uncertainty) = &self.uncertainty {
            uncertainty.check(&mut check.within("uncertainty"));
        }
        self.check_materials(check);
    }

    fn check_materials(&self, check: &mut Check<'_>) {
        for (id, material) in &self.materials {
            material.check(&mut check.within("materials").within(id));
        }
    }
}
