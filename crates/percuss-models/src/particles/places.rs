//! Places of particles in a checkpoint: arrays of any length are no part of the format.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::bonded::At;

pub(super) fn serialize<S: Serializer, const D: usize>(
    places: &[(At, [f64; D])],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let flat: Vec<(At, Vec<f64>)> = places.iter().map(|(at, p)| (*at, p.to_vec())).collect();
    flat.serialize(serializer)
}

pub(super) fn deserialize<'de, S: Deserializer<'de>, const D: usize>(
    deserializer: S,
) -> Result<Vec<(At, [f64; D])>, S::Error> {
    let flat = Vec::<(At, Vec<f64>)>::deserialize(deserializer)?;
    let of = |(at, place): (At, Vec<f64>)| {
        let place = place.try_into();
        place
            .map(|place| (at, place))
            .map_err(|_| serde::de::Error::custom("a place of another number of dimensions"))
    };
    flat.into_iter().map(of).collect()
}
