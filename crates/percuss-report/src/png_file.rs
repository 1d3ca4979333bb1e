//! Pictures as PNG files.

use png::{
    BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter, PixelDimensions, Unit,
};
use resvg::tiny_skia::Pixmap;

use crate::ReportError;

/// Pixels per metre: 240 per inch, so that a figure is as wide as its PDF file.
const PER_METRE: u32 = 9449;

/// The PNG file of an opaque picture; an error names it.
///
/// At the fastest level, with the filter `Up`, the figures of a run are half as large again, and the run takes a fifth less processor time.
pub(crate) fn encode(name: &str, picture: &Pixmap) -> Result<Vec<u8>, ReportError> {
    let failure = |error: EncodingError| ReportError::Figure {
        name: name.to_owned(),
        reason: error.to_string(),
    };
    let colors: Vec<u8> = picture
        .pixels()
        .iter()
        .flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
        .collect();
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, picture.width(), picture.height());
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
    Ok(bytes)
}
