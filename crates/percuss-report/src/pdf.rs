//! Figures as PDF files: one page of lines, areas and outlines of texts.

use std::io::Write;

use flate2::{Compression, write::ZlibEncoder};
use pdf_writer::{
    Content, Filter, Finish, Name, Pdf, Rect, Ref, TextStr,
    types::{LineCapStyle, LineJoinStyle},
};
use resvg::{
    tiny_skia::{Path, PathSegment, Point, Transform},
    usvg::{
        BlendMode, ClipPath, Color, Fill, FillRule, Group, LineCap, LineJoin, Node, Paint,
        PaintOrder, Path as Shape, Stroke,
    },
};

use crate::{Figure, ReportError, pixels::tree};

/// Points of the page per SVG user unit: most figures are 182 mm wide, as two columns of a journal, and their texts 7 points high or more.
const POINTS: f32 = 0.6;

/// Objects of a file: all files have the same ones, and one more for each opacity.
const CATALOG: i32 = 1;
const PAGES: i32 = 2;
const PAGE: i32 = 3;
const CONTENT: i32 = 4;
const INFO: i32 = 5;
const STATES: i32 = 6;

impl Figure {
    /// The figure as a PDF file of one page, 0.6 points per SVG user unit. Texts are outlines: no reader needs the font.
    ///
    /// # Errors
    /// [`ReportError::Figure`].
    pub fn pdf(&self) -> Result<Vec<u8>, ReportError> {
        let tree = tree(&self.name, &self.svg)?;
        let failure = |reason: String| ReportError::Figure {
            name: self.name.clone(),
            reason,
        };
        let (width, height) = (POINTS * tree.size().width(), POINTS * tree.size().height());
        let mut page = Page {
            content: Content::new(),
            opacities: Vec::new(),
        };
        // Pages have their origin at the bottom.
        page.content
            .transform([POINTS, 0.0, 0.0, -POINTS, 0.0, height]);
        page.group(tree.root(), 1.0)
            .map_err(|what| failure(format!("a PDF file has no {what} here")))?;
        page.file(&self.title, width, height)
            .map_err(|error| failure(error.to_string()))
    }
}

/// A page in the making.
struct Page {
    content: Content,
    /// Opacities of areas and lines that occur, in thousandths.
    opacities: Vec<u16>,
}

impl Page {
    /// Draws what a group has; an error names what cannot be drawn.
    fn group(&mut self, group: &Group, opacity: f32) -> Result<(), &'static str> {
        if group.mask().is_some() || !group.filters().is_empty() {
            return Err("mask or filter");
        }
        if group.blend_mode() != BlendMode::Normal {
            return Err("blend mode");
        }
        let opacity = opacity * group.opacity().get();
        self.content.save_state();
        self.transform(group.transform());
        if let Some(clip) = group.clip_path() {
            self.clip(clip)?;
        }
        for node in group.children() {
            match node {
                Node::Group(group) => self.group(group, opacity)?,
                Node::Path(shape) => self.shape(shape, opacity)?,
                Node::Text(text) => self.group(text.flattened(), opacity)?,
                Node::Image(_) => return Err("picture"),
            }
        }
        self.content.restore_state();
        Ok(())
    }

    fn transform(&mut self, transform: Transform) {
        if !transform.is_identity() {
            let Transform {
                sx,
                kx,
                ky,
                sy,
                tx,
                ty,
            } = transform;
            self.content.transform([sx, ky, kx, sy, tx, ty]);
        }
    }

    /// Draws nothing outside a region from here on.
    fn clip(&mut self, clip: &ClipPath) -> Result<(), &'static str> {
        if clip.clip_path().is_some() {
            return Err("clip path of a clip path");
        }
        for node in clip.root().children() {
            let Node::Path(shape) = node else {
                return Err("clip path but of shapes");
            };
            let transform = clip.transform().pre_concat(shape.abs_transform());
            let path = shape.data().clone().transform(transform);
            self.path(&path.ok_or("clip path without an area")?);
        }
        self.content.clip_nonzero().end_path();
        Ok(())
    }

    fn shape(&mut self, shape: &Shape, opacity: f32) -> Result<(), &'static str> {
        if !shape.is_visible() {
            return Ok(());
        }
        let (fill, stroke) = (shape.fill(), shape.stroke());
        match shape.paint_order() {
            PaintOrder::FillAndStroke => {
                self.fill(shape.data(), fill, opacity)?;
                self.stroke(shape.data(), stroke, opacity)
            }
            PaintOrder::StrokeAndFill => {
                self.stroke(shape.data(), stroke, opacity)?;
                self.fill(shape.data(), fill, opacity)
            }
        }
    }

    fn fill(&mut self, path: &Path, fill: Option<&Fill>, opacity: f32) -> Result<(), &'static str> {
        let Some(fill) = fill else { return Ok(()) };
        let [r, g, b] = color(fill.paint())?;
        self.opacity(opacity * fill.opacity().get());
        self.content.set_fill_rgb(r, g, b);
        self.path(path);
        match fill.rule() {
            FillRule::NonZero => self.content.fill_nonzero(),
            FillRule::EvenOdd => self.content.fill_even_odd(),
        };
        Ok(())
    }

    fn stroke(
        &mut self,
        path: &Path,
        stroke: Option<&Stroke>,
        opacity: f32,
    ) -> Result<(), &'static str> {
        let Some(stroke) = stroke else { return Ok(()) };
        let [r, g, b] = color(stroke.paint())?;
        self.opacity(opacity * stroke.opacity().get());
        self.content
            .set_stroke_rgb(r, g, b)
            .set_line_width(stroke.width().get())
            .set_miter_limit(stroke.miterlimit().get())
            .set_line_cap(match stroke.linecap() {
                LineCap::Butt => LineCapStyle::ButtCap,
                LineCap::Round => LineCapStyle::RoundCap,
                LineCap::Square => LineCapStyle::ProjectingSquareCap,
            })
            .set_line_join(match stroke.linejoin() {
                LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
                LineJoin::Round => LineJoinStyle::RoundJoin,
                LineJoin::Bevel => LineJoinStyle::BevelJoin,
            });
        let dashes = stroke.dasharray().unwrap_or_default();
        self.content
            .set_dash_pattern(dashes.iter().copied(), stroke.dashoffset());
        self.path(path);
        self.content.stroke();
        Ok(())
    }

    /// Opacity of all that follows in this group.
    fn opacity(&mut self, opacity: f32) {
        let thousandths = (1000.0 * opacity).round() as u16;
        let known = self
            .opacities
            .iter()
            .position(|known| *known == thousandths);
        let number = known.unwrap_or_else(|| {
            self.opacities.push(thousandths);
            self.opacities.len() - 1
        });
        self.content.set_parameters(Name(&state_name(number)));
    }

    fn path(&mut self, path: &Path) {
        let mut at = Point::zero();
        for segment in path.segments() {
            match segment {
                PathSegment::MoveTo(to) => {
                    self.content.move_to(to.x, to.y);
                    at = to;
                }
                PathSegment::LineTo(to) => {
                    self.content.line_to(to.x, to.y);
                    at = to;
                }
                PathSegment::QuadTo(by, to) => {
                    // The same curve with two control points.
                    let towards = |end: Point| {
                        (
                            end.x + 2.0 / 3.0 * (by.x - end.x),
                            end.y + 2.0 / 3.0 * (by.y - end.y),
                        )
                    };
                    let (first, second) = (towards(at), towards(to));
                    self.content
                        .cubic_to(first.0, first.1, second.0, second.1, to.x, to.y);
                    at = to;
                }
                PathSegment::CubicTo(first, second, to) => {
                    self.content
                        .cubic_to(first.x, first.y, second.x, second.y, to.x, to.y);
                    at = to;
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    /// The file with this page alone.
    fn file(self, title: &str, width: f32, height: f32) -> std::io::Result<Vec<u8>> {
        let mut packed = ZlibEncoder::new(Vec::new(), Compression::default());
        packed.write_all(&self.content.finish())?;
        let packed = packed.finish()?;
        let mut pdf = Pdf::new();
        pdf.catalog(Ref::new(CATALOG)).pages(Ref::new(PAGES));
        pdf.pages(Ref::new(PAGES)).kids([Ref::new(PAGE)]).count(1);
        let mut page = pdf.page(Ref::new(PAGE));
        page.media_box(Rect::new(0.0, 0.0, width, height));
        page.parent(Ref::new(PAGES)).contents(Ref::new(CONTENT));
        let numbered = || self.opacities.iter().zip(STATES..).enumerate();
        let mut resources = page.resources();
        let mut states = resources.ext_g_states();
        for (number, (_, place)) in numbered() {
            states.pair(Name(&state_name(number)), Ref::new(place));
        }
        states.finish();
        resources.finish();
        page.finish();
        for (_, (thousandths, place)) in numbered() {
            let opacity = f32::from(*thousandths) / 1000.0;
            pdf.ext_graphics(Ref::new(place))
                .stroking_alpha(opacity)
                .non_stroking_alpha(opacity);
        }
        pdf.stream(Ref::new(CONTENT), &packed)
            .filter(Filter::FlateDecode);
        pdf.document_info(Ref::new(INFO))
            .title(TextStr(title))
            .creator(TextStr("percuss"));
        Ok(pdf.finish())
    }
}

fn state_name(number: usize) -> Vec<u8> {
    format!("o{number}").into_bytes()
}

fn color(paint: &Paint) -> Result<[f32; 3], &'static str> {
    match paint {
        Paint::Color(Color { red, green, blue }) => {
            Ok([*red, *green, *blue].map(|part| f32::from(part) / 255.0))
        }
        Paint::LinearGradient(_) | Paint::RadialGradient(_) => Err("gradient"),
        Paint::Pattern(_) => Err("pattern"),
    }
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use flate2::read::ZlibDecoder;

    use crate::{Figure, ReportError};

    fn figure(content: &str) -> Figure {
        Figure {
            name: "one".to_owned(),
            title: "Depth (mm)".to_owned(),
            svg: format!(
                r#"<svg xmlns="http://www.w3.org/2000/svg" width="860" height="500">{content}</svg>"#
            ),
        }
    }

    /// What stands between two words of a file.
    fn between<'a>(file: &'a [u8], start: &[u8], end: &[u8]) -> &'a [u8] {
        let find = |bytes: &[u8], word: &[u8]| {
            let mut places = bytes.windows(word.len());
            places.position(|window| window == word).unwrap()
        };
        let rest = &file[find(file, start) + start.len()..];
        &rest[..find(rest, end)]
    }

    fn operations(file: &[u8]) -> String {
        let packed = between(file, b"stream\n", b"\nendstream");
        let mut text = String::new();
        ZlibDecoder::new(packed).read_to_string(&mut text).unwrap();
        text
    }

    #[test]
    fn lines_areas_and_clips_stand_at_their_places() {
        let file = figure(
            r##"<clipPath id="c"><rect x="10" y="20" width="30" height="40"/></clipPath>
            <g clip-path="url(#c)" transform="translate(5 6)"><path d="M0 0L100 50" fill="none" stroke="#ff0000" stroke-width="2" stroke-dasharray="4 3" stroke-opacity="0.5"/></g>
            <rect x="1" y="2" width="3" height="4" fill="#0000ff"/>"##,
        )
        .pdf()
        .unwrap();
        assert!(file.starts_with(b"%PDF-"));
        assert_eq!(between(&file, b"/MediaBox [", b"]"), b"0 0 516 300");
        let text = operations(&file);
        // Clip, dashed line in red, filled area in blue, in this order.
        let order = [
            "0.6 0 0 -0.6 0 300 cm",
            "1 0 0 1 5 6 cm",
            "10 20 m\n40 20 l\n40 60 l\n10 60 l\nh\nW\nn",
            "1 0 0 RG\n2 w",
            "[4 3] 0 d\n0 0 m\n100 50 l\nS",
            "0 0 1 rg\n1 2 m\n4 2 l\n4 6 l\n1 6 l\nh\nf",
        ];
        let mut rest = text.as_str();
        for part in order {
            let at = rest.find(part);
            assert!(at.is_some(), "no `{part}` in {rest}");
            rest = &rest[at.unwrap() + part.len()..];
        }
        let opacities = between(&file, b"/CA ", b"\n");
        assert_eq!(opacities, b"0.5");
        assert_eq!(
            text.matches("\nq\n").count() + 1,
            text.matches("\nQ").count()
        );
    }

    #[test]
    fn texts_are_outlines_and_equal_figures_have_equal_files() {
        let text = figure(r#"<text x="100" y="100" font-size="20">o</text>"#);
        let file = text.pdf().unwrap();
        // Two closed outlines, outside and inside.
        assert_eq!(operations(&file).matches("h\n").count(), 2);
        assert_eq!(file, text.pdf().unwrap());
    }

    #[test]
    fn what_is_not_drawn_is_refused() {
        let error = figure(
            r#"<linearGradient id="g"><stop offset="0" stop-color="red"/><stop offset="1" stop-color="blue"/></linearGradient>
            <rect width="10" height="10" fill="url(#g)"/>"#,
        )
        .pdf();
        let Err(ReportError::Figure { name, reason }) = error else {
            panic!("a gradient is drawn")
        };
        assert!(name == "one" && reason.contains("gradient"), "{reason}");
    }
}
