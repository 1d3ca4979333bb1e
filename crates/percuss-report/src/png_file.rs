//! Pictures as PNG files.

use png::{
    BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter, PixelDimensions, Unit,
};
use resvg::tiny_skia::Pixmap;

use crate::{ReportError, figure::SpareMemory};

/// Pixels per metre: 240 per inch, so that a figure is as wide as its PDF file.
const PER_METRE: u32 = 9449;

/// The PNG file of an opaque picture; an error names it. The memory of the picture goes to `spare`.
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
    let mut done = 0;
    // Four pixels at a time, with four bytes behind them that the next ones overwrite.
    while let Some(four) = bytes[4 * done..].first_chunk() {
        let four = u128::from_le_bytes(*four);
        let color = |place: u32| (four >> (8 * place)) & (0xff_ffff << (24 * place));
        let colors = color(0) | color(1) | color(2) | color(3);
        if let Some(place) = bytes[3 * done..].first_chunk_mut() {
            *place = colors.to_le_bytes();
        }
        done += 4;
    }
    for pixel in done..pixels {
        for channel in 0..3 {
            bytes[3 * pixel + channel] = bytes[4 * pixel + channel];
        }
    }
    bytes.truncate(3 * pixels);
    bytes
}

#[cfg(test)]
mod tests {
    use resvg::tiny_skia::{Color, Pixmap};

    use super::opaque;

    #[test]
    fn colours_stand_side_by_side() {
        for width in 1..20 {
            let mut picture = Pixmap::new(width, 1).unwrap();
            picture.fill(Color::WHITE);
            let bytes = picture.data_mut().chunks_exact_mut(4).enumerate();
            for (i, pixel) in bytes {
                let i = u8::try_from(i).unwrap();
                pixel[..3].copy_from_slice(&[i, 100 + i, 200 + i]);
            }
            let colors: Vec<u8> = (0..u8::try_from(width).unwrap())
                .flat_map(|i| [i, 100 + i, 200 + i])
                .collect();
            assert_eq!(opaque(picture), colors);
        }
    }
}
