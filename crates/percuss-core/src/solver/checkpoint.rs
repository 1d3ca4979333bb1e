//! The state of a run as bytes, from which a later run goes on as if it had not been interrupted.
//!
//! A checkpoint belongs to one case, one model and one version of the program: anything else is refused, since the run that
//! goes on would be neither the old one nor a new one.

use serde::{Deserialize, Serialize};

use crate::{
    Error, Scenario,
    material::{Failure, Strength},
    scenario::Given,
};

/// First bytes of every checkpoint, by which a file is known as one.
pub const CHECKPOINT_START: &[u8] = b"percuss checkpoint\n";
/// Raised whenever the content changes its form.
const FORMAT: u32 = 16;

/// What a checkpoint says of itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Header {
    format: u32,
    version: String,
    model: String,
    case: u64,
    /// Of the header, with 0 in this place, and of the content.
    checksum: u64,
    /// Time step that the run had reached.
    pub step: u64,
    /// Time that the run had reached [s].
    pub time: f64,
}

impl Header {
    /// Reads what a checkpoint says of itself.
    ///
    /// # Errors
    /// [`Error::Checkpoint`] when it is none, is damaged, or is of another version of the program, model or case.
    pub fn read(bytes: &[u8], model: &str, scenario: &Scenario) -> Result<Self, Error> {
        Ok(open(bytes, model, scenario)?.0)
    }
}

/// A checkpoint with an archived state.
pub(super) fn seal(
    model: &str,
    scenario: &Scenario,
    (step, time): (u64, f64),
    content: &[u8],
) -> Result<Vec<u8>, Error> {
    let mut header = Header {
        format: FORMAT,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        model: model.to_owned(),
        case: fingerprint(scenario)?,
        checksum: 0,
        step,
        time,
    };
    header.checksum = checksum(&header, content)?;
    let encoded = encode(&header)?;
    Ok([CHECKPOINT_START, &encoded, content].concat())
}

fn encode(header: &Header) -> Result<Vec<u8>, Error> {
    let encoded = postcard::to_stdvec(header);
    encoded.map_err(|error| refused(&format!("it cannot be encoded: {error}"), ""))
}

fn checksum(header: &Header, content: &[u8]) -> Result<u64, Error> {
    let open = Header {
        checksum: 0,
        ..header.clone()
    };
    Ok(hash(encode(&open)?.iter().chain(content)))
}

/// Header and archived state of a checkpoint.
pub(super) fn open<'a>(
    bytes: &'a [u8],
    model: &str,
    scenario: &Scenario,
) -> Result<(Header, &'a [u8]), Error> {
    const RESTART: &str = "start again without `--resume`";
    let Some(rest) = bytes.strip_prefix(CHECKPOINT_START) else {
        return Err(refused("it is no checkpoint of percuss", RESTART));
    };
    // The form of the header depends on the format, which therefore comes first.
    let (format, _) = postcard::take_from_bytes::<u32>(rest).map_err(|_| damaged())?;
    if format != FORMAT {
        return Err(refused("it is of another version of percuss", RESTART));
    }
    let (header, content) = postcard::take_from_bytes::<Header>(rest).map_err(|_| damaged())?;
    let version = env!("CARGO_PKG_VERSION");
    if header.version != version {
        let what = format!("it is of percuss {}, this is {version}", header.version);
        return Err(refused(&what, RESTART));
    }
    if header.checksum != checksum(&header, content)? {
        return Err(damaged());
    }
    if header.model != model {
        let what = format!("it is of model `{}`, not `{model}`", header.model);
        return Err(refused(&what, &format!("give `--model {}`", header.model)));
    }
    if header.case != fingerprint(scenario)? {
        return Err(refused(
            "it is of another case: only its title, sources, experiments, measured curves, and `end_time`, `max_steps` and `end_at_rest` of a model may change",
            "restore the case or start again without `--resume`",
        ));
    }
    Ok((header, content))
}

pub(super) fn damaged() -> Error {
    refused("it is damaged", "start again without `--resume`")
}

fn refused(reason: &str, remedy: &str) -> Error {
    Error::Checkpoint {
        reason: reason.to_owned(),
        remedy: remedy.to_owned(),
    }
}

pub(super) fn without_history() -> Error {
    refused(
        "it is of a run that kept no history",
        "continue without one, or start again",
    )
}

/// A number that stands for everything in a case that its run depends on.
///
/// # Errors
/// [`Error::Checkpoint`] for a law of the caller's own that cannot be told from others.
pub(super) fn fingerprint(scenario: &Scenario) -> Result<u64, Error> {
    let mut bare = Scenario {
        name: String::new(),
        title: String::new(),
        sources: Vec::new(),
        experiments: Vec::new(),
        measured_curves: Vec::new(),
        // A default that is written down changes no run.
        given: Given::default(),
        ..scenario.clone()
    };
    let options = &mut bare.options;
    for (end_time, max_steps) in [
        (&mut options.chain.end_time, &mut options.chain.max_steps),
        (&mut options.fdm.end_time, &mut options.fdm.max_steps),
        (&mut options.axi.end_time, &mut options.axi.max_steps),
        (
            &mut options.particles.end_time,
            &mut options.particles.max_steps,
        ),
    ] {
        *end_time = None;
        *max_steps = None;
    }
    options.chain.end_at_rest = None;
    options.fdm.end_at_rest = None;
    options.axi.end_at_rest = None;
    // Debug output gives every number with all its digits.
    let mut text = format!("{bare:?}");
    for (what, fingerprint) in own_laws(scenario) {
        text += &fingerprint.ok_or_else(|| {
            refused(
                &format!(
                    "{what} is a law of the program's own, which another one could replace unseen"
                ),
                "give the law a `fingerprint`, or keep no checkpoints",
            )
        })?;
    }
    Ok(hash(text.as_bytes()))
}

/// Laws of the caller's own in a case, each with its fingerprint.
fn own_laws(scenario: &Scenario) -> Vec<(String, Option<String>)> {
    let mut found = Vec::new();
    if let Some(law) = &scenario.resistance {
        found.push(("the resistance law".to_owned(), law.0.fingerprint()));
    }
    for (body, material) in scenario.bodies() {
        if let Strength::Own(law) = &material.strength {
            found.push((
                format!("the strength law of the {body}"),
                law.0.fingerprint(),
            ));
        }
    }
    if let Some(Failure::Own(law)) = &scenario.options.chain.failure {
        found.push(("`chain.failure`".to_owned(), law.0.fingerprint()));
    }
    found
}

/// FNV-1a, 64 bits: the same on every machine, which the standard library's hashes do not promise.
fn hash<'a>(bytes: impl IntoIterator<Item = &'a u8>) -> u64 {
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}
