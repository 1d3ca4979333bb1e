//! All constants of a material, for the terminal and the page.

use percuss::{
    material::{Library, Material, MaterialEntry, TulerButcher, references},
    units::{Velocity, significant},
};

use crate::{
    page::{Block, html},
    table::Table,
};

/// Constants of a material in sections.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MaterialCard {
    /// Its name.
    pub title: String,
    /// The first section has no heading.
    pub sections: Vec<CardSection>,
}

/// A section of a card.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct CardSection {
    /// Its heading.
    pub heading: String,
    /// Lines.
    pub lines: Vec<CardLine>,
}

/// A line of a card.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CardLine {
    /// A name and a value with its unit.
    Row(String, String),
    /// An equation or a name, which is not broken.
    Line(String),
    /// Running text.
    Paragraph(String),
}

impl CardLine {
    /// Name and value of a row.
    fn pair(&self) -> Option<(&str, &str)> {
        match self {
            Self::Row(name, value) => Some((name, value)),
            Self::Line(_) | Self::Paragraph(_) => None,
        }
    }
}

impl MaterialCard {
    /// The card of a material of a library.
    pub fn new(entry: &MaterialEntry, library: &Library) -> Self {
        let material = &entry.material;
        let mut card = Self {
            title: material.name.clone(),
            sections: vec![CardSection::default()],
        };
        names(entry, &mut card);
        constants(material, &mut card);
        strength(material, &mut card);
        equation_of_state(material, &mut card);
        damage(material, &mut card);
        fracture(material, &mut card);
        validity(material, &mut card);
        provenance(material, &mut card);
        rivals(entry, library, &mut card);
        card
    }

    /// The card as one self-contained HTML page.
    pub fn html(&self) -> String {
        let mut page = vec![Block::Title(self.title.clone())];
        for section in &self.sections {
            if !section.heading.is_empty() {
                page.push(Block::Heading(section.heading.clone()));
            }
            let kinds = section
                .lines
                .chunk_by(|a, b| a.pair().is_some() && b.pair().is_some());
            page.extend(kinds.map(|lines| {
                match &lines[0] {
                    CardLine::Line(text) | CardLine::Paragraph(text) => Block::Text(text.clone()),
                    CardLine::Row(..) => Block::Table(
                        Table::of(lines)
                            .words("", |line| {
                                line.pair().map_or("", |(name, _)| name).to_owned()
                            })
                            .words("", |line| {
                                line.pair().map_or("", |(_, value)| value).to_owned()
                            })
                            .table(),
                    ),
                }
            }));
        }
        html::render(&page)
    }

    fn heading(&mut self, heading: &str) {
        self.sections.push(CardSection {
            heading: heading.to_owned(),
            lines: Vec::new(),
        });
    }

    fn add(&mut self, line: CardLine) {
        if let Some(section) = self.sections.last_mut() {
            section.lines.push(line);
        }
    }

    fn row(&mut self, name: &str, value: &str) {
        self.add(CardLine::Row(name.to_owned(), value.to_owned()));
    }

    fn line(&mut self, text: &str) {
        self.add(CardLine::Line(text.to_owned()));
    }

    fn paragraph(&mut self, text: &str) {
        self.add(CardLine::Paragraph(text.to_owned()));
    }

    /// Limitations and sources of a part of a record, where it has them.
    fn origin(&mut self, note: &str, sources: &[String]) {
        if !note.is_empty() {
            self.paragraph(note);
        }
        if !sources.is_empty() {
            self.row("from", &sources.join(", "));
        }
    }
}

fn names(entry: &MaterialEntry, card: &mut MaterialCard) {
    let material = &entry.material;
    card.row("id", &entry.id);
    if let Some(family) = &material.family {
        let star = if material.recommended {
            " ★ (selected by the name of the family)"
        } else {
            ""
        };
        card.row("family", &format!("{family}{star}"));
    }
    if let Some(group) = material.group {
        card.row("group", group.key());
    }
    if !material.aliases.is_empty() {
        card.row("aliases", &material.aliases.join(", "));
    }
    if let Some(state) = &material.state {
        card.row("state", state);
    }
    card.row("from", &entry.origin);
}

fn constants(material: &Material, card: &mut MaterialCard) {
    card.heading("constants");
    card.row("density", &material.density.to_string());
    card.row("Young's modulus", &material.youngs_modulus.to_string());
    card.row("Poisson's ratio", &material.poissons_ratio.to_string());
    let rounded = |si: f64| significant(si, 4);
    let shear = material.shear_modulus() * 1e-9;
    card.row(
        "shear modulus",
        &format!("{} GPa (from E and ν)", rounded(shear)),
    );
    let bulk = material.bulk_modulus() * 1e-9;
    card.row(
        "bulk modulus",
        &format!("{} GPa (from E and ν)", rounded(bulk)),
    );
    if let Some(stress) = material.yield_stress {
        card.row(
            "yield stress",
            &format!("{stress} (static, for information)"),
        );
    }
    if let Some(stress) = material.ultimate_strength {
        card.row("ultimate strength", &stress.to_string());
    }
    if let Some(hardness) = material.brinell_hardness {
        card.row("Brinell hardness", &hardness.to_string());
    }
    if let Some(stress) = material.spall_strength {
        card.row("spall strength", &stress.to_string());
    }
    if let Some(TulerButcher {
        threshold: Some(threshold),
        exponent: Some(exponent),
        time_at_twice_threshold: Some(time),
    }) = material.tuler_butcher
    {
        let words = format!("{time} at twice {threshold}, exponent {exponent}");
        card.row("Tuler-Butcher failure", &words);
    }
    let known = [
        (
            "specific heat",
            material.specific_heat.map(|heat| heat.to_string()),
        ),
        (
            "melting temperature",
            material
                .melting_temperature
                .map(|melting| melting.to_string()),
        ),
    ];
    for (label, value) in known {
        card.row(label, value.as_deref().unwrap_or("not given"));
    }
    card.row("room temperature", &material.room_temperature.to_string());
    let speed = Velocity::new(material.bar_wave_speed().round());
    card.row("elastic wave speed", &format!("{speed} (thin bar)"));
    let impedance = rounded(material.bar_impedance() * 1e-6);
    card.row("impedance", &format!("{impedance}e6 kg/(m2 s) (thin bar)"));
}

fn strength(material: &Material, card: &mut MaterialCard) {
    let law = material.strength.law();
    card.heading(&format!("strength law: {}", material.strength.key()));
    card.line(law.equation());
    for (name, value) in law.parameters() {
        card.row(name, &value);
    }
}

fn equation_of_state(material: &Material, card: &mut MaterialCard) {
    let Some(eos) = &material.equation_of_state else {
        return;
    };
    card.heading("equation of state: Mie–Grüneisen");
    card.line("U_s = c₀ + s u_p");
    card.row("c₀", &eos.sound_speed.to_string());
    card.row("s", &eos.slope.to_string());
    card.row("Γ₀", &eos.gruneisen.to_string());
    let bulk = material.density.si() * eos.sound_speed.si().powi(2) * 1e-9;
    card.row("ρ c₀²", &format!("{} GPa", significant(bulk, 4)));
    card.origin(&eos.note, &eos.sources);
}

fn damage(material: &Material, card: &mut MaterialCard) {
    let Some(damage) = &material.damage else {
        return;
    };
    card.heading("damage: Johnson–Cook");
    card.line(damage.equation());
    let constants = [damage.d1, damage.d2, damage.d3, damage.d4, damage.d5];
    for (name, value) in ["D₁", "D₂", "D₃", "D₄", "D₅"].into_iter().zip(constants) {
        card.row(name, &value.to_string());
    }
    card.row("ε̇₀ (reference_rate)", &damage.reference_rate.to_string());
    card.origin(&damage.note, &damage.sources);
}

fn fracture(material: &Material, card: &mut MaterialCard) {
    let Some(fracture) = &material.fracture else {
        return;
    };
    card.heading("fracture: energy and strength");
    card.row("fracture energy", &fracture.energy.to_string());
    card.row("tensile strength", &fracture.tensile_strength.to_string());
    let length = fracture.characteristic_length(material.youngs_modulus.si());
    card.row("E G/f²", &format!("{} mm", significant(length * 1e3, 3)));
    card.origin(&fracture.note, &fracture.sources);
}

fn validity(material: &Material, card: &mut MaterialCard) {
    let validity = &material.validity;
    let limits = [
        (
            "plastic strain",
            validity.plastic_strain_max.map(|strain| strain.to_string()),
        ),
        (
            "strain rate",
            validity.strain_rate_max.map(|rate| rate.to_string()),
        ),
        (
            "temperature",
            validity.temperature_max.map(|limit| limit.to_string()),
        ),
    ];
    if limits.iter().all(|(_, limit)| limit.is_none()) {
        return;
    }
    card.heading("fitted up to");
    for (label, limit) in limits {
        if let Some(limit) = limit {
            card.row(label, &limit);
        }
    }
}

fn provenance(material: &Material, card: &mut MaterialCard) {
    card.heading(&format!("trust: {}", material.trust.letter()));
    card.paragraph(material.trust.meaning());
    if !material.note.is_empty() {
        card.heading("note");
        card.paragraph(&material.note);
    }
    if let Some(calibrated) = &material.calibrated {
        card.heading("calibrated");
        card.row("constants", &calibrated.parameters.join(", "));
        card.row("from the record", &calibrated.from);
        card.row("with the model", &calibrated.model);
        card.row("on", &calibrated.sources.join(", "));
        card.row("measured values", &calibrated.tests.len().to_string());
        let by = format!(
            "percuss {}, seed {}",
            calibrated.percuss_version, calibrated.seed
        );
        card.row("by", &by);
    }
    if material.sources.is_empty() {
        return;
    }
    card.heading("sources");
    for key in &material.sources {
        let Some(reference) = references().get(key) else {
            card.paragraph(&format!("[{key}]"));
            continue;
        };
        let mut entry = format!("[{key}] {}: {}.", reference.label, reference.title);
        for more in [&reference.place, &reference.note] {
            if !more.is_empty() {
                entry += &format!(" {}.", more.trim_end_matches('.'));
            }
        }
        card.paragraph(&entry);
    }
}

fn rivals(entry: &MaterialEntry, library: &Library, card: &mut MaterialCard) {
    let rivals: Vec<&MaterialEntry> = library.rivals(entry).collect();
    if rivals.is_empty() {
        return;
    }
    card.heading("rivals of the same family");
    for rival in rivals {
        let star = if rival.material.recommended {
            " ★"
        } else {
            ""
        };
        card.line(&format!("{}{star}: {}", rival.id, rival.material.name));
    }
}
