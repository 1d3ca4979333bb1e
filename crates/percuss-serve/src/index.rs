//! The page with the results of its first case.

use axum::{extract::State, response::Response};
use percuss::{
    material::{Library, MaterialEntry},
    model::{CostClass, MODELS, Model},
};
use percuss_report::{palette, result_rows::Row};
use serde::Serialize;
use std::sync::Arc;

use crate::{
    RequestLimits, StartCase, assets, cases,
    form::{self, Field},
    http,
    response::CaseResponse,
};

/// Rows of results that the page shows before its script runs.
const FIRST_ROWS: usize = 12;
/// Length of a long value [characters].
const LONG: usize = 36;

/// The page as text.
#[derive(Debug)]
pub(crate) struct Index(String);

/// Initial data of the page.
#[derive(Serialize)]
struct Start<'a> {
    version: &'static str,
    name: &'a str,
    answer: &'a CaseResponse,
    fields: Vec<Field>,
    models: Vec<ModelRecord>,
    materials: Vec<MaterialRecord<'a>>,
    cases: Vec<cases::ReadyCase>,
    bounds: LimitsRecord,
    experiment_color: &'static str,
}

#[derive(Serialize)]
struct ModelRecord {
    name: &'static str,
    summary: &'static str,
    slow: bool,
}

#[derive(Serialize)]
struct MaterialRecord<'a> {
    id: &'a str,
    name: &'a str,
    family: Option<&'a str>,
    recommended: bool,
    trust: &'static str,
    sources: &'a [String],
    /// What a search looks at.
    words: String,
}

#[derive(Serialize)]
struct LimitsRecord {
    elements: usize,
    seconds: u64,
}

impl Index {
    pub(crate) fn new(case: &StartCase, answer: &CaseResponse, bounds: &RequestLimits) -> Self {
        let start = Start {
            version: env!("CARGO_PKG_VERSION"),
            name: &case.name,
            answer,
            fields: form::fields(),
            models: MODELS.iter().map(|model| model_record(*model)).collect(),
            materials: Library::built_in().iter().map(material_record).collect(),
            cases: cases::all(),
            bounds: LimitsRecord {
                elements: bounds.elements,
                seconds: bounds.seconds,
            },
            experiment_color: palette::EXPERIMENT,
        };
        // Within a script element `<` could end it.
        let data = serde_json::to_string(&start).unwrap_or_default();
        let data = data.replace('<', "\\u003c");
        let mut first: Vec<&Row> = answer.rows[0].iter().take(FIRST_ROWS).collect();
        // Long values come last.
        first.sort_by_key(|(_, value)| is_long(value));
        let rows: String = first.into_iter().map(row).collect();
        let page = assets::template("index.html")
            .replace("<!--answer-->", &rows)
            .replace("<!--data-->", &data);
        Self(page)
    }

    /// `GET /`.
    pub(crate) async fn get(State(index): State<Arc<Self>>) -> Response {
        http::page(index.0.clone())
    }
}

fn model_record(model: &dyn Model) -> ModelRecord {
    ModelRecord {
        name: model.name(),
        summary: model.summary(),
        slow: model.cost() == CostClass::Minutes,
    }
}

fn material_record(entry: &MaterialEntry) -> MaterialRecord<'_> {
    let material = &entry.material;
    MaterialRecord {
        id: &entry.id,
        name: &material.name,
        family: material.family.as_deref(),
        recommended: material.recommended,
        trust: material.trust.letter(),
        sources: &material.sources,
        words: entry.search_text(),
    }
}

fn is_long(value: &str) -> bool {
    value.chars().count() > LONG
}

/// A row as the script of the page makes it.
fn row((label, value): &Row) -> String {
    let class = match is_long(value) {
        true => " class=\"long\"",
        false => "",
    };
    format!(
        "<div{class}><dt>{}</dt><dd>{}</dd></div>",
        percuss_report::escape_html(label),
        percuss_report::escape_html(value)
    )
}
