//! Material points as a file of VTK's XML format: PolyData, appended raw data, compressed.
//!
//! Everything is in SI units. Points stand at (radius, −depth, 0), so that the axis of symmetry is the vertical one and the shot
//! goes down. Values but positions and volumes keep twelve bits of their mantissa, better than one part in 4000: what is left of
//! the others compresses, and nobody sees the difference.

use std::{
    fmt::Write as _,
    io::{Read, Write},
};

use flate2::{Compression, read::ZlibDecoder, write::ZlibEncoder};
use percuss::{axi::Particle, frames::Frame};
use rayon::prelude::*;

const MARKER: &[u8] = b"<AppendedData encoding=\"raw\">\n_";

/// An array: name, components, and what it takes of a particle.
type Column = (&'static str, usize, fn(&Particle) -> [f64; 3]);

const COLUMNS: [Column; 8] = [
    ("velocity", 3, |p| [p.velocity[0], -p.velocity[1], 0.0]),
    ("pressure", 1, |p| {
        [p.pressure + p.viscous_pressure, 0.0, 0.0]
    }),
    ("von_mises_stress", 1, |p| [p.equivalent_stress(), 0.0, 0.0]),
    ("plastic_strain", 1, |p| [p.plastic_strain, 0.0, 0.0]),
    ("temperature", 1, |p| [p.temperature, 0.0, 0.0]),
    ("density", 1, |p| [p.mass / p.volume, 0.0, 0.0]),
    ("damage", 1, |p| [p.damage, 0.0, 0.0]),
    ("volume", 1, |p| [p.volume, 0.0, 0.0]),
];
const POINTS: &str = "points";
const BODY: &str = "body";

/// The file of a frame.
pub(crate) fn encode(frame: &Frame<'_>) -> Vec<u8> {
    let particles: Vec<(usize, &Particle)> = frame.particles().collect();
    let count = particles.len();
    let floats =
        |exact: bool, components: usize, value: &(dyn Fn(&Particle) -> [f64; 3] + Sync)| {
            let mut bytes = Vec::with_capacity(4 * components * count);
            for (_, particle) in &particles {
                for entry in &value(particle)[..components] {
                    let entry = *entry as f32;
                    let entry = if exact { entry } else { rounded(entry) };
                    bytes.extend(entry.to_le_bytes());
                }
            }
            bytes
        };
    let mut arrays: Vec<(&str, &str, usize, Vec<u8>)> = vec![(
        BODY,
        "UInt8",
        1,
        particles.iter().map(|(body, _)| *body as u8).collect(),
    )];
    for (name, components, value) in COLUMNS {
        let bytes = floats(name == "volume", components, &value);
        arrays.push((name, "Float32", components, bytes));
    }
    let place = |p: &Particle| [p.position[0], -p.position[1], 0.0];
    arrays.push((POINTS, "Float32", 3, floats(true, 3, &place)));
    let numbers = (0..count as i32).flat_map(i32::to_le_bytes).collect();
    arrays.push(("connectivity", "Int32", 1, numbers));
    arrays.push(("offsets", "Int32", 1, (count as i32).to_le_bytes().to_vec()));
    let blocks: Vec<Vec<u8>> = arrays
        .par_iter()
        .map(|(_, _, _, bytes)| block(bytes))
        .collect();

    let mut offset = 0;
    let mut tags = Vec::new();
    for ((name, kind, components, _), block) in arrays.iter().zip(&blocks) {
        tags.push(format!(
            r#"<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{offset}"/>"#
        ));
        offset += block.len();
    }
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n<FieldData>\n",
    );
    for (name, value) in [
        ("TimeValue", frame.time),
        ("cell", frame.cell),
        ("depth", frame.depth),
    ] {
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            r#"<DataArray type="Float64" Name="{name}" NumberOfTuples="1" format="ascii">{value:e}</DataArray>"#
        );
    }
    let _ = write!(
        text,
        "</FieldData>\n<Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"1\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"0\">\n<PointData Scalars=\"plastic_strain\" Vectors=\"velocity\">\n{}\n</PointData>\n\
         <Points>\n{}\n</Points>\n<Verts>\n{}\n</Verts>\n</Piece>\n</PolyData>\n",
        tags[..=COLUMNS.len()].join("\n"),
        tags[COLUMNS.len() + 1],
        tags[COLUMNS.len() + 2..].join("\n"),
    );
    let mut file = text.into_bytes();
    file.extend(MARKER);
    file.extend(blocks.concat());
    file.extend(b"\n</AppendedData>\n</VTKFile>\n");
    file
}

/// A number with twelve bits of mantissa.
fn rounded(value: f32) -> f32 {
    const DROPPED: u32 = 23 - 12;
    let bits = value.to_bits();
    let half = 1_u32 << (DROPPED - 1);
    // Infinities and what is no number have no bits to lose; those do not occur in a run that goes on.
    f32::from_bits((bits.saturating_add(half)) & !((1 << DROPPED) - 1))
}

/// An array as VTK stores it: number of blocks, size of a block, size of a last smaller one, compressed size, data.
fn block(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    // Writing to memory does not fail.
    let packed = encoder
        .write_all(bytes)
        .and_then(|()| encoder.finish())
        .unwrap_or_default();
    let head = [1, bytes.len() as u32, 0, packed.len() as u32];
    let mut block: Vec<u8> = head.into_iter().flat_map(u32::to_le_bytes).collect();
    block.extend(packed);
    block
}

/// What a picture needs of a file.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Points {
    pub(crate) time: f64,
    pub(crate) depth: f64,
    /// Radius and depth [m].
    pub(crate) places: Vec<[f32; 2]>,
    pub(crate) bodies: Vec<u8>,
    /// Side of the square that a particle fills in the plane of the picture [m].
    pub(crate) sizes: Vec<f32>,
    /// Value of the array asked for: its size where it is a vector.
    pub(crate) values: Vec<f32>,
}

/// Reads a file that [`encode`] made; `None` when it is none.
pub(crate) fn decode(file: &[u8], array: &str, components: usize) -> Option<Points> {
    let start = file.windows(MARKER.len()).position(|part| part == MARKER)?;
    let text = std::str::from_utf8(&file[..start]).ok()?;
    let data = &file[start + MARKER.len()..];
    let after = |tag: &str, end: char| {
        let from = text.find(tag)? + tag.len();
        text[from..].split(end).next()
    };
    let number = |name: &str| -> Option<f64> {
        let tag = format!(r#"Name="{name}" NumberOfTuples="1" format="ascii">"#);
        after(&tag, '<')?.parse().ok()
    };
    let bytes = |name: &str, components: usize| -> Option<Vec<u8>> {
        let tag = format!(
            r#"Name="{name}" NumberOfComponents="{components}" format="appended" offset=""#
        );
        let offset: usize = after(&tag, '"')?.parse().ok()?;
        let size = u32::from_le_bytes(data.get(offset + 12..offset + 16)?.try_into().ok()?);
        let packed = data.get(offset + 16..offset + 16 + size as usize)?;
        let mut bytes = Vec::new();
        ZlibDecoder::new(packed).read_to_end(&mut bytes).ok()?;
        Some(bytes)
    };
    let floats = |name: &str, components: usize| -> Option<Vec<f32>> {
        let bytes = bytes(name, components)?;
        let (entries, _) = bytes.as_chunks::<4>();
        Some(
            entries
                .iter()
                .map(|entry| f32::from_le_bytes(*entry))
                .collect(),
        )
    };
    let places: Vec<[f32; 2]> = floats(POINTS, 3)?
        .chunks_exact(3)
        .map(|point| [point[0], -point[1]])
        .collect();
    let volumes = floats("volume", 1)?;
    let size = |([radius, _], volume): (&[f32; 2], &f32)| {
        (volume / (2.0 * std::f32::consts::PI * radius)).sqrt()
    };
    Some(Points {
        time: number("TimeValue")?,
        depth: number("depth")?,
        sizes: places.iter().zip(&volumes).map(size).collect(),
        places,
        bodies: bytes(BODY, 1)?,
        values: floats(array, components)?
            .chunks_exact(components)
            .map(|value| match value {
                [value] => *value,
                vector => vector.iter().map(|entry| entry * entry).sum::<f32>().sqrt(),
            })
            .collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_gives_back_what_went_in() {
        let mut particle = Particle::default();
        particle.position = [2e-3, 5e-3];
        particle.velocity = [3.0, 4.0];
        (particle.mass, particle.volume) = (2e-6, 1e-9);
        particle.plastic_strain = 0.375;
        let gone = Particle::default();
        let bodies = [[particle, gone], [particle, particle]];
        let frame = Frame {
            number: 3,
            last: false,
            step: 10,
            time: 1.5e-6,
            cell: 1e-4,
            depth: 2e-3,
            bodies: bodies.iter().map(|body| &body[..]).collect(),
        };
        let file = encode(&frame);
        let strain = decode(&file, "plastic_strain", 1).unwrap();
        assert_eq!((strain.time, strain.depth), (1.5e-6, 2e-3));
        assert_eq!(strain.places, [[2e-3, 5e-3]; 3]);
        assert_eq!(strain.bodies, [0, 1, 1]);
        assert_eq!(strain.values, [0.375; 3]);
        assert_eq!(decode(&file, "velocity", 3).unwrap().values, [5.0; 3]);
        assert!(decode(&file[..100], "velocity", 3).is_none());
    }

    #[test]
    fn rounding_keeps_a_value_to_one_part_in_four_thousand() {
        for value in [1.0_f32, -3.7e8, 1.234_567e-5, 0.0, 4095.5] {
            assert!((rounded(value) - value).abs() <= value.abs() / 4000.0);
        }
    }
}
