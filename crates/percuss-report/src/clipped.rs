//! Drawings in pieces, each clipped to a rectangle or to nothing, that are drawn one over the other.
//!
//! Drawn whole, every clipped part would take a picture and a mask of its own: a third of the time of a figure.

use std::ops::Range;

use resvg::{
    tiny_skia::{Pixmap, Rect, Transform},
    usvg::{
        Tree,
        roxmltree::{Document, Node},
    },
};

/// Pixels by which lines may be drawn beyond their bounds.
const MARGIN: f32 = 2.0;

/// A drawing of its own, and the rectangle that it is clipped to, in user units.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Piece {
    pub(crate) svg: String,
    pub(crate) clip: Option<Rect>,
}

/// Pieces of a drawing, back to front. Clips that are no rectangles, or inside of groups, stay in their pieces.
pub(crate) fn pieces(svg: &str) -> Vec<Piece> {
    let divided = Document::parse(svg).ok();
    let divided = divided.and_then(|document| divide(svg, &document));
    divided.unwrap_or_else(|| {
        vec![Piece {
            svg: svg.to_owned(),
            clip: None,
        }]
    })
}

/// The pieces, if all that lies in user units is as wide as it says.
fn divide(svg: &str, document: &Document<'_>) -> Option<Vec<Piece>> {
    let root = document.root_element();
    let children = inside(root)?;
    if root.has_attribute("viewBox") || root.has_attribute("transform") {
        return None;
    }
    let header = &svg[root.range().start..children.start];
    let definitions = root.children().filter(|node| node.has_tag_name("defs"));
    let definitions: String = definitions.map(|node| &svg[node.range()]).collect();
    let piece = |content: &str, clip| Piece {
        svg: format!("{header}{definitions}{content}</svg>"),
        clip,
    };
    let (mut all, mut open) = (Vec::new(), String::new());
    for node in root.children().filter(|node| !node.has_tag_name("defs")) {
        match clip(document, node) {
            None => open += &svg[node.range()],
            Some(clip) => {
                all.push(piece(&std::mem::take(&mut open), None));
                if let Some(content) = inside(node) {
                    all.push(piece(&svg[content], Some(clip)));
                }
            }
        }
    }
    all.push(piece(&open, None));
    Some(all)
}

/// Where the content of an element stands, if it has any.
fn inside(node: Node<'_, '_>) -> Option<Range<usize>> {
    let (first, last) = (node.first_child()?, node.last_child()?);
    Some(first.range().start..last.range().end)
}

/// Rectangle of a group that is clipped to one and does nothing else.
fn clip(document: &Document<'_>, node: Node<'_, '_>) -> Option<Rect> {
    let is_clip = node.has_tag_name("g") && node.attributes().len() == 1;
    let place = node.attribute("clip-path").filter(|_| is_clip)?;
    let id = place.strip_prefix("url(#")?.strip_suffix(')')?;
    let path = document
        .descendants()
        .find(|node| node.has_tag_name("clipPath") && node.attribute("id") == Some(id))?;
    let mut shapes = path.children().filter(Node::is_element);
    let (shape, None) = (shapes.next()?, shapes.next()) else {
        return None;
    };
    let is_plain = shape.has_tag_name("rect") && shape.attributes().len() == 4;
    let number = |name| shape.attribute(name)?.parse().ok();
    let size = (
        number("x")?,
        number("y")?,
        number("width")?,
        number("height")?,
    );
    Rect::from_xywh(size.0, size.1, size.2, size.3)
        .filter(|_| is_plain && path.attributes().len() == 1)
}

/// Draws a piece over a picture, at a number of pixels per user unit. What lies outside of the clip is put back afterwards.
pub(crate) fn draw(tree: &Tree, clip: Option<Rect>, scale: f32, pixels: &mut Pixmap) {
    let outside = clip.map(|clip| outside(tree, clip, scale, pixels));
    let outside = outside.unwrap_or_default();
    let before: Vec<_> = outside
        .iter()
        .map(|place| pixels.data()[place.clone()].to_vec())
        .collect();
    let transform = Transform::from_scale(scale, scale);
    resvg::render(tree, transform, &mut pixels.as_mut());
    for (place, before) in outside.into_iter().zip(before) {
        pixels.data_mut()[place].copy_from_slice(&before);
    }
}

/// Bytes of a picture outside of a rectangle that a drawing may change.
fn outside(tree: &Tree, clip: Rect, scale: f32, pixels: &Pixmap) -> Vec<Range<usize>> {
    let size = [pixels.width(), pixels.height()];
    let within = |low: f32, high: f32, margin: f32, most: u32| {
        let pixel = |place: f32| place.round().clamp(0.0, most as f32) as usize;
        pixel(low * scale - margin)..pixel(high * scale + margin)
    };
    let all = tree.root().abs_stroke_bounding_box();
    let columns = within(all.left(), all.right(), MARGIN, size[0]);
    let rows = within(all.top(), all.bottom(), MARGIN, size[1]);
    let kept_columns = within(clip.left(), clip.right(), 0.0, size[0]);
    let kept_rows = within(clip.top(), clip.bottom(), 0.0, size[1]);
    let of_row = |row: usize| {
        let sides = if kept_rows.contains(&row) {
            [
                columns.start..kept_columns.start.min(columns.end),
                kept_columns.end.max(columns.start)..columns.end,
            ]
        } else {
            [columns.clone(), 0..0]
        };
        let first = row * size[0] as usize;
        sides.map(|columns| 4 * (first + columns.start)..4 * (first + columns.end))
    };
    let places = rows.flat_map(of_row);
    places.filter(|place| !place.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use resvg::tiny_skia::Color;

    use super::*;
    use crate::pixels::tree;

    const HEADER: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="40" height="30">"#;
    const CLIP: &str =
        r#"<defs><clipPath id="c"><rect x="10" y="5" width="20" height="15"/></clipPath></defs>"#;

    fn picture(pieces: &[Piece]) -> Vec<u8> {
        let mut pixels = Pixmap::new(80, 60).unwrap();
        pixels.fill(Color::WHITE);
        for piece in pieces {
            draw(
                &tree("test", &piece.svg).unwrap(),
                piece.clip,
                2.0,
                &mut pixels,
            );
        }
        pixels.take()
    }

    /// As it is drawn in one piece.
    fn whole(svg: &str) -> Vec<u8> {
        picture(&[Piece {
            svg: svg.to_owned(),
            clip: None,
        }])
    }

    #[test]
    fn pieces_draw_the_same_picture_as_the_whole() {
        let shapes = [
            r#"<rect x="2" y="1" width="35" height="27" fill="red"/>"#,
            r#"<rect x="12" y="8" width="5" height="5" fill="blue"/>"#,
            r#"<path d="M -500 -300 L 900 700" stroke="green" stroke-width="3"/>"#,
            r#"<path d="M 35 0 L 35 30" stroke="green"/>"#,
            r#"<path d="M 0 2 L 9 2" stroke="black" stroke-width="2"/>"#,
            "",
        ];
        for shape in shapes {
            let svg = format!(
                r#"{HEADER}<rect x="0" y="0" width="20" height="30" fill="yellow"/>{CLIP}<g clip-path="url(#c)">{shape}</g><circle cx="10" cy="5" r="4"/></svg>"#
            );
            let pieces = pieces(&svg);
            assert_eq!(pieces.len(), if shape.is_empty() { 2 } else { 3 });
            assert!(picture(&pieces) == whole(&svg), "{shape}");
        }
    }

    #[test]
    fn other_clips_stay_in_one_piece() {
        let content = r#"<rect x="0" y="0" width="40" height="30"/>"#;
        let others = [
            format!(r#"{CLIP}<g clip-path="url(#c)" opacity="0.5">{content}</g>"#),
            format!(r#"{CLIP}<g transform="scale(2)"><g clip-path="url(#c)">{content}</g></g>"#),
            format!(
                r#"<defs><clipPath id="c"><circle cx="9" cy="9" r="9"/></clipPath></defs><g clip-path="url(#c)">{content}</g>"#
            ),
            format!(r##"<g clip-path="url(#absent)">{content}</g>"##),
        ];
        for other in others {
            let svg = format!("{HEADER}{other}</svg>");
            let pieces = pieces(&svg);
            assert!(pieces.iter().all(|piece| piece.clip.is_none()), "{svg}");
            assert!(picture(&pieces) == whole(&svg), "{svg}");
        }
    }
}
