//! The chains that all programs of the benchmark advance.

use std::{fs, str::FromStr};

use crate::Outcome;

/// A spring and the mass at its front end.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Spring {
    /// Time step over mass [s/kg].
    pub(crate) kick: f64,
    /// One over length [1/m].
    pub(crate) per_length: f64,
    /// Elastic force at strain 1 [N].
    pub(crate) stiffness: f64,
    /// Force of the power law at strain 1 [N].
    pub(crate) coefficient: f64,
    pub(crate) exponent: f64,
}

/// Chains that differ in impact speed.
#[derive(Debug, Clone)]
pub(crate) struct Problem {
    pub(crate) springs: Vec<Spring>,
    /// Masses of the rod, which has the impact speed.
    pub(crate) rod: usize,
    pub(crate) steps: u64,
    /// [s]
    pub(crate) time_step: f64,
    /// Impact speed of every chain [m/s].
    pub(crate) speeds: Vec<f64>,
}

/// Reads what `runner/work.py` has written.
pub(crate) fn read(path: &str) -> Outcome<Problem> {
    let text = fs::read_to_string(path)?;
    let mut words = text.split_ascii_whitespace();
    let springs: usize = next(&mut words)?;
    let rod = next(&mut words)?;
    let chains: usize = next(&mut words)?;
    let steps = next(&mut words)?;
    let time_step: f64 = next(&mut words)?;
    let springs = (0..springs).map(|_| {
        let mass: f64 = next(&mut words)?;
        let length: f64 = next(&mut words)?;
        Ok(Spring {
            kick: time_step / mass,
            per_length: 1.0 / length,
            stiffness: next(&mut words)?,
            coefficient: next(&mut words)?,
            exponent: next(&mut words)?,
        })
    });
    let springs = springs.collect::<Outcome<_>>()?;
    let speeds = (0..chains).map(|_| next(&mut words));
    Ok(Problem {
        springs,
        rod,
        steps,
        time_step,
        speeds: speeds.collect::<Outcome<_>>()?,
    })
}

fn next<'a, T: FromStr>(words: &mut impl Iterator<Item = &'a str>) -> Outcome<T> {
    let word = words.next().ok_or("the problem ends too early")?;
    word.parse()
        .map_err(|_| format!("`{word}` in the problem is not what belongs there").into())
}
