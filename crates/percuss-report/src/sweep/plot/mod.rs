//! Figures of a sweep: curves, maps and parallel coordinates, chosen by the varied parameters.

mod curves;
mod data;
mod held;
mod map;
mod parallel;
mod quantity;

use std::path::PathBuf;

use data::Data;
pub use held::{SweepChart, SweepNumber, charts, numbers, parallel_figure};

use super::{manifest::Varied, parts::Parts, rows::Rows};
use crate::{Figure, ReportError, names};

/// Largest number of curves unless curves are requested.
const CURVES: usize = 6;

/// Style of the figure of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlotStyle {
    /// Result versus a parameter, with one curve per value of a second one.
    Curves,
    /// Result as colour versus two parameters.
    Map,
    /// Parallel coordinates: one axis per parameter, one line per run.
    Parallel,
}

impl PlotStyle {
    /// Its name on the command line and in the name of the file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Curves => "curves",
            Self::Map => "map",
            Self::Parallel => "parallel",
        }
    }
}

/// Figure to draw; missing entries are chosen by the varied parameters and the results.
#[derive(Debug, Clone, Default)]
pub struct PlotRequest {
    /// Column of the result to draw.
    pub quantity: Option<String>,
    /// Style.
    pub style: Option<PlotStyle>,
    /// Key of the parameter of the horizontal axis.
    pub x: Option<String>,
    /// Key of the parameter of the vertical axis of a map, or with one curve per value.
    pub y: Option<String>,
}

/// Draws a result of the rows of folders with parts of one sweep. The figure shows or counts rows without it.
///
/// # Errors
/// [`ReportError::Sweep`] when the folders hold no sweep, or no row, or the request does not fit it; [`ReportError::Read`].
pub fn plot(folders: &[PathBuf], request: &PlotRequest) -> Result<Figure, ReportError> {
    let parts = Parts::open(folders)?;
    let fail = |reason: String, remedy: String| ReportError::Sweep {
        path: parts.first().to_owned(),
        reason,
        remedy,
    };
    let manifest = &parts.manifest;
    let quantity = quantity::choose(&parts, request.quantity.as_deref())?;
    let place = |wanted: &Option<String>, option: &str| match wanted {
        None => Ok(None),
        Some(key) => {
            let mut all = manifest.parameters.iter();
            let place = all.position(|varied| varied.key == *key || varied.column == *key);
            place.map(Some).ok_or_else(|| {
                let keys: Vec<&str> = manifest.parameters.iter().map(|p| &*p.key).collect();
                let near = quantity::meant(key, &keys);
                let remedy = format!("{near}{option} takes one of {}", keys.join(", "));
                fail(format!("the sweep does not vary `{key}`"), remedy)
            })
        }
    };
    let (x, y) = (place(&request.x, "--x")?, place(&request.y, "--y")?);
    if x.is_some() && x == y {
        return Err(fail(
            "--x and --y name the same parameter".to_owned(),
            "name two, or leave one out".to_owned(),
        ));
    }
    if request.style == Some(PlotStyle::Parallel) && (x.is_some() || y.is_some()) {
        return Err(fail(
            "parallel coordinates draw all parameters, and --x or --y selects some".to_owned(),
            "leave them out, or draw --style curves or --style map".to_owned(),
        ));
    }
    let rows = Rows::read(&parts, &quantity)?;
    if rows.values.is_empty() {
        return Err(fail(
            "no block of the sweep is computed".to_owned(),
            "`percuss sweep SWEEP.toml --out DIR --resume` computes them".to_owned(),
        ));
    }
    let data = Data::new(manifest, &quantity, rows);
    let choice = Choice::of(&data, request.style, x, y);
    if choice.style == PlotStyle::Map && choice.y.is_none() {
        return Err(fail(
            "a map needs two parameters, and the sweep varies one".to_owned(),
            "draw it with --style curves".to_owned(),
        ));
    }
    Ok(match choice.style {
        PlotStyle::Curves => curves::chart(&data, choice.x, choice.y).draw(),
        PlotStyle::Map => map::chart(&data, choice.x, choice.y.unwrap_or(choice.x)).draw(),
        PlotStyle::Parallel => parallel::draw(&data),
    })
}

/// Style and parameters of a figure.
struct Choice {
    style: PlotStyle,
    x: usize,
    y: Option<usize>,
}

impl Choice {
    /// Follows the request; what it leaves open suits what is varied: curves of one parameter or two where one takes few
    /// values, a map of two, parallel coordinates of more.
    fn of(data: &Data<'_>, style: Option<PlotStyle>, x: Option<usize>, y: Option<usize>) -> Self {
        let varied: Vec<usize> = data.varied();
        let named = x.is_some() || y.is_some();
        // Words have no order, and a parameter with many values makes the better axis.
        let rank = |i: &usize| (data.is_numeric(*i), data.count(*i));
        let mut order = varied.clone();
        order.sort_by_key(|i| std::cmp::Reverse(rank(i)));
        let x = x.unwrap_or_else(|| {
            let mut free = order.iter().filter(|i| Some(**i) != y);
            free.next().copied().unwrap_or(0)
        });
        let second = order.iter().find(|i| **i != x).copied();
        let few = |i: usize| data.is_list(i) && data.count(i) <= CURVES;
        let style = style.unwrap_or(match (varied.len(), y.or(second)) {
            (3.., _) if !named => PlotStyle::Parallel,
            (_, Some(i)) if y.is_some() || varied.len() == 2 => match few(i) {
                true => PlotStyle::Curves,
                false => PlotStyle::Map,
            },
            _ => PlotStyle::Curves,
        });
        let y = match style {
            PlotStyle::Map => y.or(second),
            // Among more than two the others are averaged over, unless one is named.
            _ => y.or(second.filter(|i| varied.len() == 2 && few(*i))),
        };
        Self { style, x, y }
    }
}

/// Name of a parameter with its unit in parentheses.
fn label(varied: &Varied) -> String {
    names::parameter_label(&varied.key, &varied.unit)
}
