//! Animation of pictures as a GIF.

use std::{borrow::Cow, collections::HashMap};

use gif::{DisposalMethod, Encoder, Frame, Repeat};
use resvg::tiny_skia::Pixmap;

use crate::ReportError;

/// How long a picture stays, and the last one [1/100 s].
const DELAY: u16 = 6;
const LAST_DELAY: u16 = 250;
/// Most colours, without the one that leaves a pixel as it was.
const COLORS: usize = 255;
const UNCHANGED: u8 = 255;

/// A picture in the colours of a palette.
pub(crate) struct Indexed {
    width: u16,
    height: u16,
    pixels: Vec<u8>,
}

/// The colours of an animation: given ones, their mixtures with white and black that smooth edges need, and greys.
pub(crate) struct Palette(Vec<[u8; 3]>);

impl Palette {
    pub(crate) fn new(colors: &[[u8; 3]]) -> Self {
        let mut all: Vec<[u8; 3]> = (0..=32).map(|i| [(i * 255 / 32) as u8; 3]).collect();
        all.extend(colors);
        let mixed = |color: &[u8; 3], other: u16, part: u16| {
            color.map(|c| ((u16::from(c) * (4 - part) + other * part) / 4) as u8)
        };
        for (other, part) in [(0x34, 2), (0xff, 2), (0x34, 1), (0x34, 3), (0xff, 1)] {
            all.extend(colors.iter().map(|color| mixed(color, other, part)));
        }
        let mut kept: Vec<[u8; 3]> = Vec::new();
        for color in all {
            if kept.len() < COLORS && !kept.contains(&color) {
                kept.push(color);
            }
        }
        Self(kept)
    }

    /// A picture in these colours.
    pub(crate) fn index(&self, picture: &Pixmap) -> Indexed {
        let mut known: HashMap<[u8; 3], u8> = HashMap::new();
        let nearest = |color: [u8; 3]| {
            let off = |other: &[u8; 3]| -> i32 {
                let squares = color.iter().zip(other);
                squares
                    .map(|(a, b)| (i32::from(*a) - i32::from(*b)).pow(2))
                    .sum()
            };
            let all = self.0.iter().enumerate();
            all.min_by_key(|(_, other)| off(other))
                .map_or(0, |(index, _)| index as u8)
        };
        // Most pixels have the colour of the one before.
        let mut last = ([0; 3], nearest([0; 3]));
        let pixels = picture.pixels().iter().map(|pixel| {
            let color = [pixel.red(), pixel.green(), pixel.blue()];
            if color != last.0 {
                last = (color, *known.entry(color).or_insert_with(|| nearest(color)));
            }
            last.1
        });
        Indexed {
            width: picture.width() as u16,
            height: picture.height() as u16,
            pixels: pixels.collect(),
        }
    }
}

/// Encodes pictures of one size; each one stores what it changes.
pub(crate) fn encode(palette: &Palette, pictures: &[Indexed]) -> Result<Vec<u8>, ReportError> {
    let failure = |error: gif::EncodingError| ReportError::Figure {
        name: "animation".to_owned(),
        reason: error.to_string(),
    };
    let Some(first) = pictures.first() else {
        return Ok(Vec::new());
    };
    let colors = palette.0.concat();
    let mut encoder =
        Encoder::new(Vec::new(), first.width, first.height, &colors).map_err(failure)?;
    encoder.set_repeat(Repeat::Infinite).map_err(failure)?;
    let mut before: Option<&Indexed> = None;
    for (number, picture) in pictures.iter().enumerate() {
        let mut frame = change(before, picture);
        frame.delay = if number + 1 == pictures.len() {
            LAST_DELAY
        } else {
            DELAY
        };
        frame.dispose = DisposalMethod::Keep;
        encoder.write_frame(&frame).map_err(failure)?;
        before = Some(picture);
    }
    encoder.into_inner().map_err(|error| ReportError::Figure {
        name: "animation".to_owned(),
        reason: error.to_string(),
    })
}

/// The smallest rectangle that holds every changed pixel; the others in it are left as they were.
fn change<'a>(before: Option<&Indexed>, picture: &'a Indexed) -> Frame<'a> {
    let (width, height) = (usize::from(picture.width), usize::from(picture.height));
    let Some(before) = before else {
        return Frame {
            width: picture.width,
            height: picture.height,
            buffer: Cow::Borrowed(&picture.pixels),
            ..Frame::default()
        };
    };
    let differs = |at: usize| before.pixels[at] != picture.pixels[at];
    let (mut left, mut right, mut top, mut bottom) = (width, 0, height, 0);
    for row in 0..height {
        for column in 0..width {
            if differs(row * width + column) {
                left = left.min(column);
                right = right.max(column + 1);
                top = top.min(row);
                bottom = row + 1;
            }
        }
    }
    if left >= right {
        (left, right, top, bottom) = (0, 1, 0, 1);
    }
    let mut buffer = Vec::with_capacity((right - left) * (bottom - top));
    for row in top..bottom {
        buffer.extend((left..right).map(|column| {
            let at = row * width + column;
            if differs(at) {
                picture.pixels[at]
            } else {
                UNCHANGED
            }
        }));
    }
    Frame {
        left: left as u16,
        top: top as u16,
        width: (right - left) as u16,
        height: (bottom - top) as u16,
        transparent: Some(UNCHANGED),
        buffer: Cow::Owned(buffer),
        ..Frame::default()
    }
}
