//! Fields as a file of VTK's XML format: PolyData, appended raw data, compressed.
//!
//! Everything is in SI units. Points stand at (radius, −depth, 0), in space at (x, −depth, y), so that the axis of symmetry is the vertical one and the projectile
//! flies down. Material points are vertices, bonds lines; elements along the axis are rectangles of their length and diameter. Values other than
//! positions and volumes keep twelve bits of their mantissa, better than one part in 4000.

use std::{fmt::Write as _, io::Write};

use flate2::{Compression, write::ZlibEncoder};
use percuss::{
    axi::Particle,
    frames::{Across, Bonds, Fields, Frame},
    history::ElementState,
};
use rayon::prelude::*;

use super::FieldQuantity;

pub(super) const MARKER: &[u8] = b"<AppendedData encoding=\"raw\">\n_";
const END: &[u8] = b"\n</AppendedData>\n</VTKFile>\n";

/// An array: name, components, and what it takes of a particle.
type Column = (&'static str, usize, fn(&Particle) -> [f64; 3]);

const COLUMNS: [Column; 8] = [
    ("pressure", 1, |p| of(FieldQuantity::Pressure, p)),
    ("von_mises_stress", 1, |p| {
        of(FieldQuantity::VonMisesStress, p)
    }),
    ("plastic_strain", 1, |p| of(FieldQuantity::PlasticStrain, p)),
    ("temperature", 1, |p| of(FieldQuantity::Temperature, p)),
    ("density", 1, |p| of(FieldQuantity::Density, p)),
    ("damage", 1, |p| of(FieldQuantity::Damage, p)),
    ("volume", 1, |p| [p.volume, 0.0, 0.0]),
    (SIDES, 2, |p| [p.sides[0], p.sides[1], 0.0]),
];
/// A scalar quantity as the components of an array.
fn of(quantity: FieldQuantity, particle: &Particle) -> [f64; 3] {
    [quantity.si_value(particle), 0.0, 0.0]
}

/// Width and height of a particle's section before the impact.
pub(super) const SIDES: &str = "sides";
/// Thickness of the section of bodies in space that pictures show [m].
pub(super) const SECTION: &str = "section";
pub(super) const POINTS: &str = "points";
pub(super) const BODY: &str = "body";
const CONNECTIVITY: &str = "connectivity";
const OFFSETS: &str = "offsets";
const BOND_DAMAGE: &str = "bond_damage";

/// A number of an element with its name.
type ElementColumn = (&'static str, fn(&ElementState) -> f64);

const ELEMENT_COLUMNS: [ElementColumn; 4] = [
    ("axial_stress", |e| e.stress),
    ("axial_strain", |e| e.strain),
    ("plastic_strain", |e| e.plastic_strain),
    ("temperature", |e| e.temperature),
];

/// An array of a file: name, type, components and its block.
type Array = (&'static str, &'static str, usize, Vec<u8>);

/// Particles or bonds whose numbers are packed at a time.
const AT_ONCE: usize = 1 << 15;

/// An array that is packed as it grows, so that its numbers never stand in memory together.
struct Packer {
    name: &'static str,
    kind: &'static str,
    components: usize,
    /// Bytes that are not packed yet.
    pending: Vec<u8>,
    /// Bytes that are.
    size: usize,
    encoder: ZlibEncoder<Vec<u8>>,
}

impl Packer {
    fn new(name: &'static str, kind: &'static str, components: usize) -> Self {
        Self {
            name,
            kind,
            components,
            pending: Vec::new(),
            size: 0,
            encoder: ZlibEncoder::new(Vec::new(), Compression::fast()),
        }
    }

    fn floats(name: &'static str, components: usize) -> Self {
        Self::new(name, "Float32", components)
    }

    fn integers(name: &'static str) -> Self {
        Self::new(name, "Int32", 1)
    }

    /// Adds numbers, rounded or exact.
    fn add_floats(&mut self, values: &[f64], exact: bool) {
        for value in values {
            let value = *value as f32;
            let value = if exact { value } else { rounded(value) };
            self.pending.extend(value.to_le_bytes());
        }
    }

    fn add_integer(&mut self, value: i32) {
        self.pending.extend(value.to_le_bytes());
    }

    fn pack(&mut self) {
        self.size += self.pending.len();
        // Writing to memory does not fail.
        let _ = self.encoder.write_all(&self.pending);
        self.pending.clear();
    }

    /// The array as VTK stores it: number of blocks, size of a block, size of a last smaller one, compressed size, data.
    fn finish(mut self) -> Array {
        self.pack();
        let packed = self.encoder.finish().unwrap_or_default();
        let head = [1, self.size as u32, 0, packed.len() as u32];
        let mut block: Vec<u8> = head.into_iter().flat_map(u32::to_le_bytes).collect();
        block.extend(packed);
        (self.name, self.kind, self.components, block)
    }
}

/// An array of numbers, rounded or exact.
fn floats(
    name: &'static str,
    components: usize,
    values: impl Iterator<Item = f64>,
    exact: bool,
) -> Packer {
    let mut packer = Packer::floats(name, components);
    for value in values {
        packer.add_floats(&[value], exact);
    }
    packer
}

fn integers(name: &'static str, values: impl Iterator<Item = i32>) -> Packer {
    let mut packer = Packer::integers(name);
    for value in values {
        packer.add_integer(value);
    }
    packer
}

fn bytes(name: &'static str, bytes: Vec<u8>) -> Packer {
    Packer {
        pending: bytes,
        ..Packer::new(name, "UInt8", 1)
    }
}

/// The arrays, each packed.
fn finished(packers: Vec<Packer>) -> Vec<Array> {
    packers.into_par_iter().map(Packer::finish).collect()
}

/// The file of a frame.
pub(crate) fn encode(frame: &Frame<'_>) -> Vec<u8> {
    match &frame.fields {
        Fields::Elements(elements) => encode_elements(frame, elements),
        fields => encode_particles(frame, fields),
    }
}

/// Arrays at particles; the last one has their places.
struct Particles {
    count: usize,
    arrays: Vec<Packer>,
}

impl Particles {
    fn of(fields: &Fields<'_>, across: Option<&Across>) -> Self {
        let mut bodies = Packer::new(BODY, "UInt8", 1);
        let mut velocities = Packer::floats("velocity", 3);
        let mut columns = COLUMNS.map(|(name, components, _)| Packer::floats(name, components));
        let mut places = Packer::floats(POINTS, 3);
        let mut count = 0;
        for (number, (body, particle)) in fields.particles().enumerate() {
            // Vectors of particles in space have a third component.
            let vector = |[x, z]: [f64; 2], part: usize| {
                [
                    x,
                    -z,
                    across.map_or(0.0, |across| across.places[number][part]),
                ]
            };
            bodies.pending.push(body as u8);
            velocities.add_floats(&vector(particle.velocity, 1), false);
            places.add_floats(&vector(particle.position, 0), true);
            for ((name, components, value), column) in COLUMNS.iter().zip(&mut columns) {
                column.add_floats(&value(&particle)[..*components], *name == "volume");
            }
            count = number + 1;
            if count % AT_ONCE == 0 {
                let others = [&mut bodies, &mut velocities, &mut places];
                (columns.par_iter_mut().chain(others.into_par_iter())).for_each(Packer::pack);
            }
        }
        let mut arrays = vec![bodies, velocities];
        arrays.extend(columns);
        arrays.push(places);
        Self { count, arrays }
    }
}

fn encode_particles(frame: &Frame<'_>, fields: &Fields<'_>) -> Vec<u8> {
    let none = Bonds::default();
    let (cell, bonds, across): (f64, &Bonds<'_>, Option<&Across>) = match fields {
        Fields::Particles {
            cell,
            bonds,
            across,
            ..
        } => (*cell, bonds, across.as_ref()),
        _ => (0.0, &none, None),
    };
    let Particles { count, arrays } = Particles::of(fields, across);
    let mut data = finished(arrays);
    let points = data.pop();
    let constants = [
        ("TimeValue", frame.time),
        ("cell", cell),
        ("depth", frame.depth),
        (SECTION, across.map_or(0.0, |across| across.section)),
    ];
    let vertices = Shapes::new(
        ("Verts", 1),
        integers(CONNECTIVITY, 0..count as i32),
        integers(OFFSETS, std::iter::once(count as i32)),
    );
    let (lines, damage) = lines(bonds);
    assemble(File {
        // Bodies in a plane have no section.
        constants: &constants[..if across.is_some() { 4 } else { 3 }],
        points: (count, points),
        data: (
            "PointData Scalars=\"plastic_strain\" Vectors=\"velocity\"",
            data,
        ),
        cells: damage,
        shapes: std::iter::once(vertices).chain(lines).collect(),
    })
}

/// Bonds as lines, and their damage behind a value for the cell of all vertices; none of a body without bonds.
fn lines(bonds: &Bonds<'_>) -> (Option<Shapes>, Vec<Array>) {
    // Rounded, a bond that nearly fails would look broken.
    let mut damage = floats(BOND_DAMAGE, 1, std::iter::once(0.0), true);
    let mut connectivity = Packer::integers(CONNECTIVITY);
    let mut offsets = Packer::integers(OFFSETS);
    let mut count = 0;
    for bond in bonds.iter() {
        damage.add_floats(&[f64::from(bond.damage)], true);
        for end in bond.ends {
            connectivity.add_integer(end as i32);
        }
        count += 1;
        offsets.add_integer(2 * count as i32);
        if count % AT_ONCE == 0 {
            let all = [&mut damage, &mut connectivity, &mut offsets];
            all.into_par_iter().for_each(Packer::pack);
        }
    }
    if count == 0 {
        return (None, Vec::new());
    }
    let lines = Shapes::new(("Lines", count), connectivity, offsets);
    (Some(lines), finished(vec![damage]))
}

fn encode_elements(frame: &Frame<'_>, elements: &[ElementState]) -> Vec<u8> {
    let count = elements.len();
    let corners = elements.iter().flat_map(|element| {
        let (radius, half) = (0.5 * element.diameter, 0.5 * element.length);
        let (behind, ahead) = (half - element.position, -half - element.position);
        [
            [-radius, behind],
            [radius, behind],
            [radius, ahead],
            [-radius, ahead],
        ]
    });
    let places = corners.flat_map(|[x, y]| [x, y, 0.0]);
    let bodies = elements.iter().map(|element| element.part as u8).collect();
    let mut data = vec![bytes(BODY, bodies)];
    for (name, value) in ELEMENT_COLUMNS {
        data.push(floats(name, 1, elements.iter().map(value), false));
    }
    let points = floats(POINTS, 3, places, true).finish();
    assemble(File {
        constants: &[("TimeValue", frame.time), ("depth", frame.depth)],
        points: (4 * count, Some(points)),
        data: ("CellData Scalars=\"plastic_strain\"", finished(data)),
        cells: Vec::new(),
        shapes: vec![Shapes::new(
            ("Polys", count),
            integers(CONNECTIVITY, 0..4 * count as i32),
            integers(OFFSETS, (1..=count as i32).map(|element| 4 * element)),
        )],
    })
}

/// Content of a file.
struct File<'a> {
    constants: &'a [(&'a str, f64)],
    /// Their number and their coordinates.
    points: (usize, Option<Array>),
    /// Start tag of the arrays at points or in cells, and the arrays. All arrays are packed.
    data: (&'a str, Vec<Array>),
    /// Arrays in cells beside arrays at points.
    cells: Vec<Array>,
    shapes: Vec<Shapes>,
}

/// Vertices, lines or polygons.
struct Shapes {
    tag: &'static str,
    count: usize,
    /// Numbers of their points, and where each ends among them.
    arrays: Vec<Array>,
}

impl Shapes {
    fn new((tag, count): (&'static str, usize), connectivity: Packer, offsets: Packer) -> Self {
        Self {
            tag,
            count,
            arrays: finished(vec![connectivity, offsets]),
        }
    }
}

/// The file of its arrays.
fn assemble(file: File<'_>) -> Vec<u8> {
    let (tag, data) = file.data;
    let (in_data, in_cells) = (data.len(), file.cells.len());
    let counts: Vec<(&str, usize)> = (file.shapes.iter())
        .map(|shapes| (shapes.tag, shapes.count))
        .collect();
    let mut blocks: Vec<Array> = data.into_iter().chain(file.cells).collect();
    blocks.extend(file.points.1);
    blocks.extend(file.shapes.into_iter().flat_map(|shapes| shapes.arrays));
    let mut offset = 0;
    let mut tags = Vec::new();
    for (name, kind, components, block) in &blocks {
        tags.push(format!(
            r#"<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="appended" offset="{offset}"/>"#
        ));
        offset += block.len();
    }
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt32\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n<FieldData>\n",
    );
    for (name, value) in file.constants {
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            r#"<DataArray type="Float64" Name="{name}" NumberOfTuples="1" format="ascii">{value:e}</DataArray>"#
        );
    }
    let number = |kind: &str| {
        let of_kind = counts.iter().find(|(tag, _)| *tag == kind);
        of_kind.map_or(0, |(_, count)| *count)
    };
    let mut tags = tags.into_iter();
    let mut next = |count: usize| {
        let some: Vec<String> = tags.by_ref().take(count).collect();
        some.join("\n")
    };
    let end = tag.split(' ').next().unwrap_or(tag);
    let _ = write!(
        text,
        "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"{}\">\n<{tag}>\n{}\n</{end}>\n",
        file.points.0,
        number("Verts"),
        number("Lines"),
        number("Polys"),
        next(in_data),
    );
    if in_cells > 0 {
        let _ = writeln!(text, "<CellData>\n{}\n</CellData>", next(in_cells));
    }
    let _ = writeln!(text, "<Points>\n{}\n</Points>", next(1));
    for (tag, _) in &counts {
        let _ = writeln!(text, "<{tag}>\n{}\n</{tag}>", next(2));
    }
    text += "</Piece>\n</PolyData>\n";
    let mut bytes = text.into_bytes();
    bytes.extend(MARKER);
    bytes.reserve_exact(offset + END.len());
    for (.., block) in blocks {
        bytes.extend(block);
    }
    bytes.extend(END);
    bytes
}

/// A number with twelve bits of mantissa.
fn rounded(value: f32) -> f32 {
    const DROPPED: u32 = 23 - 12;
    let bits = value.to_bits();
    let half = 1_u32 << (DROPPED - 1);
    // Infinities and what is no number have no bits to lose; those do not occur in a run that goes on.
    f32::from_bits((bits.saturating_add(half)) & !((1 << DROPPED) - 1))
}

#[cfg(test)]
pub(super) mod tests {
    use percuss::frames::Bond;

    use super::{
        super::vtp_points::{decode, values},
        *,
    };

    /// A frame of bodies of as many particles each.
    pub(in super::super) fn frame<const N: usize>(
        number: u64,
        bodies: &[[Particle; N]],
        bonds: Vec<Bond>,
    ) -> Frame<'static> {
        let bodies = bodies.iter().map(|body| body.iter().copied().collect());
        Frame {
            number,
            last: false,
            step: 10,
            time: 1.5e-6,
            depth: 2e-3,
            fields: Fields::Particles {
                cell: 1e-4,
                bodies: bodies.collect(),
                bonds: Bonds::Kept(bonds.into()),
                across: None,
            },
        }
    }

    fn bond(from: u32, to: u32, damage: f32) -> Bond {
        Bond {
            ends: [from, to],
            damage,
        }
    }

    #[test]
    fn a_file_gives_back_what_went_in() {
        let particle = Particle {
            position: [2e-3, 5e-3],
            velocity: [3.0, 4.0],
            mass: 2e-6,
            volume: 1e-9,
            plastic_strain: 0.375,
            ..Particle::default()
        };
        let gone = Particle::default();
        let bodies = [[particle, gone], [particle, particle]];
        let frame = frame(3, &bodies, vec![bond(0, 1, 0.5), bond(1, 2, 1.0)]);
        let file = encode(&frame);
        let text = String::from_utf8_lossy(&file);
        assert!(text.contains(r#"NumberOfVerts="1" NumberOfLines="2""#));
        assert_eq!(values(&file, BOND_DAMAGE, 1).unwrap(), [0.0, 0.5, 1.0]);
        let strain = decode(&file, "plastic_strain", 1).unwrap();
        assert_eq!((strain.time, strain.depth), (1.5e-6, 2e-3));
        assert_eq!(strain.places, [[2e-3, 5e-3]; 3]);
        assert_eq!(strain.bodies, [0, 1, 1]);
        assert_eq!(strain.values, [0.375; 3]);
        assert_eq!(decode(&file, "velocity", 3).unwrap().values, [5.0; 3]);
        assert!(decode(&file[..100], "velocity", 3).is_none());
    }

    #[test]
    fn elements_become_rectangles_of_their_length_and_diameter() {
        let element = ElementState {
            part: 1,
            initial_position: 2e-3,
            position: 3e-3,
            displacement: 1e-3,
            length: 1e-3,
            stress: 2e8,
            strain: 0.1,
            plastic_strain: 0.25,
            diameter: 4e-3,
            temperature: 300.0,
            velocity: 0.0,
        };
        let frame = Frame {
            number: 0,
            last: true,
            step: 1,
            time: 1e-6,
            depth: 0.0,
            fields: Fields::Elements(vec![element, element]),
        };
        let file = encode(&frame);
        let text = String::from_utf8_lossy(&file);
        assert!(
            text.contains(r#"NumberOfPoints="8" NumberOfVerts="0""#),
            "{text}"
        );
        assert!(text.contains(r#"NumberOfPolys="2""#) && text.contains("</CellData>"));
        let of = |name| values(&file, name, if name == POINTS { 3 } else { 1 }).unwrap();
        assert_eq!(of("plastic_strain"), [0.25, 0.25]);
        let corners = of(POINTS);
        let height = |corner: usize| corners[3 * corner + 1];
        assert_eq!([height(0), height(2)], [-2.5e-3, -3.5e-3]);
        assert_eq!([corners[0], corners[3]], [-2e-3, 2e-3]);
    }

    #[test]
    fn rounding_keeps_a_value_to_one_part_in_four_thousand() {
        for value in [1.0_f32, -3.7e8, 1.234_567e-5, 0.0, 4095.5] {
            assert!((rounded(value) - value).abs() <= value.abs() / 4000.0);
        }
    }
}
