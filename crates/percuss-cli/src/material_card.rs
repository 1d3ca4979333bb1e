//! A material as text for people.

use percuss::{
    material::{Library, Material, MaterialEntry, TulerButcher, references},
    units::{Pressure, Velocity, significant},
};

use crate::terminal::{bold, width, wrap};

const LABEL: usize = 24;

/// Everything that is known of a material.
pub fn text(entry: &MaterialEntry, library: &Library) -> String {
    let material = &entry.material;
    let mut text = format!("{}\n", bold(&material.name));
    names(entry, &mut text);
    constants(material, &mut text);
    strength(material, &mut text);
    equation_of_state(material, &mut text);
    damage(material, &mut text);
    validity(material, &mut text);
    provenance(material, &mut text);
    let rivals: Vec<&MaterialEntry> = library.rivals(entry).collect();
    if !rivals.is_empty() {
        heading("rivals of the same family", &mut text);
        for rival in rivals {
            let star = if rival.material.recommended {
                " ★"
            } else {
                ""
            };
            let line = format!("  {}{star}: {}\n", rival.id, rival.material.name);
            text += &line;
        }
    }
    text
}

fn names(entry: &MaterialEntry, text: &mut String) {
    let material = &entry.material;
    row("id", &entry.id, text);
    if let Some(family) = &material.family {
        let star = if material.recommended {
            " ★ (this record answers to the family's name)"
        } else {
            ""
        };
        row("family", &format!("{family}{star}"), text);
    }
    if let Some(state) = &material.state {
        row("state", state, text);
    }
    row("from", &entry.origin, text);
}

fn constants(material: &Material, text: &mut String) {
    heading("constants", text);
    row("density", &material.density.to_string(), text);
    row(
        "Young's modulus",
        &material.youngs_modulus.to_string(),
        text,
    );
    row(
        "Poisson's ratio",
        &material.poissons_ratio.to_string(),
        text,
    );
    let rounded = |si: f64| significant(si, 4);
    let shear = Pressure::new(material.shear_modulus() * 1e-9).si();
    row(
        "shear modulus",
        &format!("{} GPa (from E and ν)", rounded(shear)),
        text,
    );
    let bulk = material.bulk_modulus() * 1e-9;
    row(
        "bulk modulus",
        &format!("{} GPa (from E and ν)", rounded(bulk)),
        text,
    );
    if let Some(stress) = material.yield_stress {
        row(
            "yield stress",
            &format!("{stress} (static, for information)"),
            text,
        );
    }
    if let Some(stress) = material.ultimate_strength {
        row("ultimate strength", &stress.to_string(), text);
    }
    if let Some(hardness) = material.brinell_hardness {
        row("Brinell hardness", &hardness.to_string(), text);
    }
    if let Some(stress) = material.spall_strength {
        row("spall strength", &stress.to_string(), text);
    }
    if let Some(TulerButcher {
        threshold: Some(threshold),
        exponent: Some(exponent),
        time_at_twice_threshold: Some(time),
    }) = material.tuler_butcher
    {
        let words = format!("{time} at twice {threshold}, exponent {exponent}");
        row("Tuler-Butcher failure", &words, text);
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
        row(label, value.as_deref().unwrap_or("not given"), text);
    }
    row(
        "room temperature",
        &material.room_temperature.to_string(),
        text,
    );
    let speed = Velocity::new(material.bar_wave_speed().round());
    row("elastic wave speed", &format!("{speed} (thin bar)"), text);
    let impedance = rounded(material.bar_impedance() * 1e-6);
    row(
        "impedance",
        &format!("{impedance}e6 kg/(m2 s) (thin bar)"),
        text,
    );
}

fn strength(material: &Material, text: &mut String) {
    let law = material.strength.law();
    heading(&format!("strength law: {}", material.strength.key()), text);
    *text += &format!("  {}\n", law.equation());
    for (name, value) in law.parameters() {
        row(name, &value, text);
    }
}

fn equation_of_state(material: &Material, text: &mut String) {
    let Some(eos) = &material.equation_of_state else {
        return;
    };
    heading("equation of state: Mie–Grüneisen", text);
    *text += "  U_s = c₀ + s u_p\n";
    row("c₀", &eos.sound_speed.to_string(), text);
    row("s", &eos.slope.to_string(), text);
    row("Γ₀", &eos.gruneisen.to_string(), text);
    let bulk = material.density.si() * eos.sound_speed.si().powi(2) * 1e-9;
    row("ρ c₀²", &format!("{} GPa", significant(bulk, 4)), text);
    if !eos.note.is_empty() {
        paragraph(&eos.note, text);
    }
    if !eos.sources.is_empty() {
        row("from", &eos.sources.join(", "), text);
    }
}

fn damage(material: &Material, text: &mut String) {
    let Some(damage) = &material.damage else {
        return;
    };
    heading("damage: Johnson–Cook", text);
    *text += &format!("  {}\n", damage.equation());
    let constants = [damage.d1, damage.d2, damage.d3, damage.d4, damage.d5];
    for (name, value) in ["D₁", "D₂", "D₃", "D₄", "D₅"].into_iter().zip(constants) {
        row(name, &value.to_string(), text);
    }
    row(
        "ε̇₀ (reference_rate)",
        &damage.reference_rate.to_string(),
        text,
    );
    if !damage.note.is_empty() {
        paragraph(&damage.note, text);
    }
    if !damage.sources.is_empty() {
        row("from", &damage.sources.join(", "), text);
    }
}

fn validity(material: &Material, text: &mut String) {
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
    heading("fitted up to", text);
    for (label, limit) in limits {
        if let Some(limit) = limit {
            row(label, &limit, text);
        }
    }
}

fn provenance(material: &Material, text: &mut String) {
    let trust = serde_json::json!(material.trust);
    let letter = trust.as_str().unwrap_or_default();
    heading(&format!("trust: {letter}"), text);
    paragraph(material.trust.meaning(), text);
    if !material.note.is_empty() {
        heading("note", text);
        paragraph(&material.note, text);
    }
    if let Some(calibrated) = &material.calibrated {
        heading("calibrated", text);
        row("constants", &calibrated.parameters.join(", "), text);
        row("from the record", &calibrated.from, text);
        row("with the model", &calibrated.model, text);
        row("on", &calibrated.sources.join(", "), text);
        row("measured values", &calibrated.shots.len().to_string(), text);
        let by = format!(
            "percuss {}, seed {}",
            calibrated.percuss_version, calibrated.seed
        );
        row("by", &by, text);
    }
    if material.sources.is_empty() {
        return;
    }
    heading("sources", text);
    for key in &material.sources {
        let Some(reference) = references().get(key) else {
            paragraph(&format!("[{key}]"), text);
            continue;
        };
        let mut entry = format!("[{key}] {}: {}.", reference.label, reference.title);
        for more in [&reference.place, &reference.note] {
            if !more.is_empty() {
                entry += &format!(" {}.", more.trim_end_matches('.'));
            }
        }
        paragraph(&entry, text);
    }
}

fn heading(label: &str, text: &mut String) {
    *text += &format!("\n{}\n", bold(label));
}

fn row(label: &str, value: &str, text: &mut String) {
    let label_width = label.chars().count();
    // Combining marks have no width of their own.
    let marks = label
        .chars()
        .filter(|c| ('\u{300}'..='\u{36f}').contains(c))
        .count();
    let pad = " ".repeat(LABEL.saturating_sub(label_width - marks).max(1));
    let value = wrap(value, width().saturating_sub(LABEL + 2), 0)
        .replace('\n', &format!("\n{:1$}", "", LABEL + 2));
    *text += &format!("  {label}{pad}{value}\n");
}

fn paragraph(words: &str, text: &mut String) {
    *text += &format!("  {}\n", wrap(words, width() - 2, 2));
}
