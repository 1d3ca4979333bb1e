//! Figures in pixels.

use std::sync::{Arc, OnceLock};

use resvg::{
    tiny_skia::{Color, Pixmap, Transform},
    usvg::{Options, Tree, fontdb::Database},
};

use crate::{Figure, ReportError, clipped, figure::SpareMemory, png_file};

/// Pixels of a PNG per SVG user unit.
const PNG_SCALE: f32 = 2.0;
/// What the drawings of charts begin with.
const BACKGROUND: &str = r#"<rect width="100%" height="100%" fill="white" />"#;

impl Figure {
    /// The figure as a PNG file, two pixels per SVG user unit.
    ///
    /// # Errors
    /// [`ReportError::Figure`].
    pub fn png(&self) -> Result<Vec<u8>, ReportError> {
        self.png_from(&SpareMemory::default())
    }

    /// The same in memory of other figures.
    pub(crate) fn png_from(&self, spare: &SpareMemory) -> Result<Vec<u8>, ReportError> {
        let pixels = self.pixels_in(PNG_SCALE, spare)?;
        png_file::encode(&self.name, pixels, spare)
    }

    /// The figure on white, at a number of pixels per SVG user unit.
    pub(crate) fn pixels(&self, scale: f32) -> Result<Pixmap, ReportError> {
        self.pixels_in(scale, &SpareMemory::default())
    }

    fn pixels_in(&self, scale: f32, spare: &SpareMemory) -> Result<Pixmap, ReportError> {
        // The white behind all of it stands in the picture already.
        let pieces = clipped::pieces(&self.svg.replacen(BACKGROUND, "", 1));
        let trees = pieces
            .iter()
            .map(|piece| Ok((tree(&self.name, &piece.svg)?, piece.clip)));
        let trees: Vec<_> = trees.collect::<Result<_, _>>()?;
        let size = trees
            .first()
            .and_then(|(tree, _)| tree.size().to_int_size().scale_by(scale))
            .ok_or_else(|| failure(&self.name, "it has no area".to_owned()))?;
        let bytes = 4 * size.width() as usize * size.height() as usize;
        let mut pixels = Pixmap::from_vec(spare.take(bytes), size)
            .ok_or_else(|| failure(&self.name, "it is too large".to_owned()))?;
        pixels.fill(Color::WHITE);
        for (tree, clip) in &trees {
            clipped::draw(tree, *clip, scale, &mut pixels);
        }
        Ok(pixels)
    }
}

/// Draws an SVG over a picture.
pub(crate) fn draw_over(pixels: &mut Pixmap, svg: &str, scale: f32) -> Result<(), ReportError> {
    let tree = tree("overlay", svg)?;
    resvg::render(
        &tree,
        Transform::from_scale(scale, scale),
        &mut pixels.as_mut(),
    );
    Ok(())
}

/// Reads a drawing with the built-in fonts.
pub(crate) fn tree(name: &str, svg: &str) -> Result<Tree, ReportError> {
    let options = Options {
        fontdb: fonts(),
        font_family: "DejaVu Sans".to_owned(),
        ..Options::default()
    };
    Tree::from_str(svg, &options).map_err(|error| failure(name, error.to_string()))
}

fn failure(name: &str, reason: String) -> ReportError {
    ReportError::Figure {
        name: name.to_owned(),
        reason,
    }
}

/// The built-in fonts, read once.
fn fonts() -> Arc<Database> {
    static FONTS: OnceLock<Arc<Database>> = OnceLock::new();
    FONTS
        .get_or_init(|| {
            let mut fonts = Database::new();
            fonts.load_font_data(dejavu::sans::regular().to_vec());
            fonts.load_font_data(dejavu::sans::bold().to_vec());
            fonts.set_sans_serif_family("DejaVu Sans");
            Arc::new(fonts)
        })
        .clone()
}
