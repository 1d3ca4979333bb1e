//! Pictures as PNG files.

use png::{
    BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter, PixelDimensions, Unit,
};
use resvg::tiny_skia::Pixmap;

use crate::{ReportError, figure::SpareMemory};

/// Pixels per metre: 240 per inch, so that a figure is as wide as its PDF file.
const PER_METRE: u32 = 9449;

/// The PNG file of an opaque picture, in whose memory its colours are put side by side and which is spare afterwards; an error names it.
///
/// At the fastest level, with the filter `Up`, the figures of a run are half as large again, and the run takes a fifth less processor time.
pub(crate) fn encode(
    name: &str,
    picture: Pixmap,
    spare: &SpareMemory,
) -> Result<Vec<u8>, ReportError> {
    let failure = |error: EncodingError| ReportError::Figure {
        name: name.to_owned(),
        reason: error.to_string(),
    };
    let (width, height) = (picture.width(), picture.height());
    let colors = opaque(picture);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_deflate_compression(DeflateCompression::Level(1));
    encoder.set_filter(Filter::Up);
    encoder.set_pixel_dims(Some(PixelDimensions {
        xppu: PER_METRE,
        yppu: PER_METRE,
        unit: Unit::Meter,
    }));
    let mut writer = encoder.write_header().map_err(failure)?;
    writer.write_image_data(&colors).map_err(failure)?;
    writer.finish().map_err(failure)?;
    spare.give(colors);
    Ok(bytes)
}

/// Red, green and blue of every pixel of an opaque picture.
fn opaque(picture: Pixmap) -> Vec<u8> {
    let mut bytes = picture.take();
    let pixels = bytes.len() / 4;
    for pixel in 0..pixels {
        let (from, to) = (4 * pixel, 3 * pixel);
        // The fourth of them is overwritten by the next pixel.
        let four = [
            bytes[from],
            bytes[from + 1],
            bytes[from + 2],
            bytes[from + 3],
        ];
        bytes[to..to + 4].copy_from_slice(&four);
    }
    bytes.truncate(3 * pixels);
    bytes
}
