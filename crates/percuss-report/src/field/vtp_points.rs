//! Material points of a file of VTK's XML format, for pictures.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::vtp::{BODY, MARKER, POINTS, SECTION, SIDES};

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

/// Header and appended data of a file; `None` when it is none.
fn parts(file: &[u8]) -> Option<(&str, &[u8])> {
    let start = file.windows(MARKER.len()).position(|part| part == MARKER)?;
    let text = std::str::from_utf8(&file[..start]).ok()?;
    Some((text, &file[start + MARKER.len()..]))
}

/// Text between a tag and a character.
fn after<'a>(text: &'a str, tag: &str, end: char) -> Option<&'a str> {
    let from = text.find(tag)? + tag.len();
    text[from..].split(end).next()
}

/// Bytes of an array of a file.
fn bytes(file: &[u8], name: &str, components: usize) -> Option<Vec<u8>> {
    let (text, data) = parts(file)?;
    let tag =
        format!(r#"Name="{name}" NumberOfComponents="{components}" format="appended" offset=""#);
    let offset: usize = after(text, &tag, '"')?.parse().ok()?;
    let size = u32::from_le_bytes(data.get(offset + 12..offset + 16)?.try_into().ok()?);
    let packed = data.get(offset + 16..offset + 16 + size as usize)?;
    let mut bytes = Vec::new();
    ZlibDecoder::new(packed).read_to_end(&mut bytes).ok()?;
    Some(bytes)
}

/// Numbers of an array of a file.
pub(super) fn values(file: &[u8], name: &str, components: usize) -> Option<Vec<f32>> {
    let bytes = bytes(file, name, components)?;
    let (entries, _) = bytes.as_chunks::<4>();
    let values = entries.iter().map(|entry| f32::from_le_bytes(*entry));
    Some(values.collect())
}

/// Body of every point of a file.
pub(super) fn bodies(file: &[u8]) -> Option<Vec<u8>> {
    bytes(file, BODY, 1)
}

/// Time of a file [s].
pub(super) fn time(file: &[u8]) -> Option<f64> {
    number(parts(file)?.0, "TimeValue")
}

/// A constant of a file.
fn number(text: &str, name: &str) -> Option<f64> {
    let tag = format!(r#"Name="{name}" NumberOfTuples="1" format="ascii">"#);
    after(text, &tag, '<')?.parse().ok()
}

/// Reads a file of material points; `None` when it is none.
pub(crate) fn decode(file: &[u8], array: &str, components: usize) -> Option<Points> {
    let (text, _) = parts(file)?;
    let number = |name: &str| number(text, name);
    let floats = |name: &str, components: usize| values(file, name, components);
    let points = floats(POINTS, 3)?;
    let section = number(SECTION).map(|section| section as f32);
    // Of bodies in space what is near the plane of the picture.
    let is_shown = |point: &[f32]| section.is_none_or(|section| 2.0 * point[2].abs() <= section);
    let shown: Vec<bool> = points.chunks_exact(3).map(is_shown).collect();
    let places: Vec<[f32; 2]> = points
        .chunks_exact(3)
        .map(|point| [point[0], -point[1]])
        .collect();
    let volumes = floats("volume", 1)?;
    // A plane body, which stands on both sides of the axis, has its area for a volume.
    let is_plane = places.iter().any(|[across, _]| *across < 0.0);
    let size = |([radius, _], volume): (&[f32; 2], &f32)| match (section, is_plane) {
        (Some(_), _) => volume.cbrt(),
        (None, true) => volume.sqrt(),
        (None, false) => (volume / (2.0 * std::f32::consts::PI * radius)).sqrt(),
    };
    let points = Points {
        time: number("TimeValue")?,
        depth: number("depth")?,
        sizes: places.iter().zip(&volumes).map(size).collect(),
        places,
        bodies: bodies(file)?,
        values: floats(array, components)?
            .chunks_exact(components)
            .map(|value| match value {
                [value] => *value,
                vector => vector.iter().map(|entry| entry * entry).sum::<f32>().sqrt(),
            })
            .collect(),
    };
    let sides: Vec<[f32; 2]> = floats(SIDES, 2)?
        .chunks_exact(2)
        .map(|pair| [pair[0], pair[1]])
        .collect();
    let (points, sides) = match section {
        Some(_) => points.only(&shown, &sides),
        None => (points, sides),
    };
    Some(points.in_equal_parts(&sides))
}

impl Points {
    /// Those that are shown, with their sides.
    fn only(self, shown: &[bool], sides: &[[f32; 2]]) -> (Self, Vec<[f32; 2]>) {
        fn kept<T: Copy>(of: &[T], shown: &[bool]) -> Vec<T> {
            let pairs = of.iter().zip(shown);
            pairs
                .filter(|(_, shown)| **shown)
                .map(|(of, _)| *of)
                .collect()
        }
        let points = Self {
            places: kept(&self.places, shown),
            bodies: kept(&self.bodies, shown),
            sizes: kept(&self.sizes, shown),
            values: kept(&self.values, shown),
            ..self
        };
        (points, kept(sides, shown))
    }

    /// Large particles as several of the size that most have: a picture closes gaps of that size.
    fn in_equal_parts(self, sides: &[[f32; 2]]) -> Self {
        /// Along a side: beyond, no picture shows a difference.
        const MOST: f32 = 64.0;
        let mut smallest: Vec<f32> = sides.iter().map(|[a, b]| a.min(*b)).collect();
        let middle = smallest.len() / 2;
        if middle == 0 {
            return self;
        }
        let usual = *smallest.select_nth_unstable_by(middle, f32::total_cmp).1;
        let mut parts = Self {
            time: self.time,
            depth: self.depth,
            ..Self::default()
        };
        for (index, [radius, depth]) in self.places.iter().enumerate() {
            let [across, along] = sides[index].map(|side| match side > 0.0 {
                true => (side / usual).round().clamp(1.0, MOST),
                false => 1.0,
            });
            for part in 0..(across * along) as usize {
                let [column, row] = [part % across as usize, part / across as usize];
                let off =
                    |part: usize, count: f32, side: f32| ((part as f32 + 0.5) / count - 0.5) * side;
                parts.places.push([
                    radius + off(column, across, sides[index][0]),
                    depth + off(row, along, sides[index][1]),
                ]);
                parts.bodies.push(self.bodies[index]);
                parts
                    .sizes
                    .push(self.sizes[index] / (across * along).sqrt());
                parts.values.push(self.values[index]);
            }
        }
        parts
    }
}
