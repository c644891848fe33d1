//! Drawings as SVG and PNG.
//!
//! Both are drawn larger than their logical size: plotters snaps to whole pixels, so the SVG is
//! drawn four times as large and shown at its logical size, and the PNG is averaged down to twice
//! the logical size.

use super::drawing::{Align, Drawing, Label, Mark};
use super::{PlotError, palette};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontStyle, register_font};
use std::sync::OnceLock;

/// Pixels drawn for a logical pixel.
const DRAWN: u32 = 4;
/// Pixels of a PNG for a logical pixel.
const PNG_SCALE: u32 = 2;

const FONT: &str = "sans-serif";
static FONT_BYTES: &[u8] = include_bytes!("../../assets/DejaVuSans.ttf");

impl Drawing {
    /// The picture as SVG.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        ready_font()?;
        let mut text = String::new();
        let size = (self.width * DRAWN, self.height * DRAWN);
        {
            let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
            self.draw_on(&root, Pen::Path)?;
            root.present().map_err(backend)?;
        }
        // Shown at its logical size; the view box keeps the fine raster.
        let drawn = format!(r#"width="{}" height="{}" "#, size.0, size.1);
        let shown = format!(r#"width="{}" height="{}" "#, self.width, self.height);
        Ok(text.replacen(&drawn, &shown, 1))
    }

    /// The picture as PNG, two pixels for a logical one.
    pub fn to_png(&self) -> Result<Vec<u8>, PlotError> {
        let pixels = self.to_pixels(PNG_SCALE)?;
        encode(&pixels, self.width * PNG_SCALE, self.height * PNG_SCALE)
    }

    /// The picture as RGB, row by row, with `scale` pixels for a logical one; `scale` divides
    /// [`DRAWN`].
    pub(super) fn to_pixels(&self, scale: u32) -> Result<Vec<u8>, PlotError> {
        ready_font()?;
        let size = (self.width * DRAWN, self.height * DRAWN);
        let mut pixels = vec![0u8; size.0 as usize * size.1 as usize * 3];
        {
            let root = BitMapBackend::with_buffer(&mut pixels, size).into_drawing_area();
            self.draw_on(&root, Pen::Round)?;
            root.present().map_err(backend)?;
        }
        let factor = DRAWN / scale;
        Ok(average(&pixels, size.0 as usize, factor as usize))
    }

    fn draw_on<DB: DrawingBackend>(
        &self,
        root: &DrawingArea<DB, Shift>,
        pen: Pen,
    ) -> Result<(), PlotError> {
        root.fill(&palette::PAPER).map_err(backend)?;
        for mark in &self.marks {
            draw_mark(root, mark, pen)?;
        }
        Ok(())
    }
}

/// Width of a text (logical pixels).
pub(super) fn text_width(text: &str, size: f64) -> Result<f64, PlotError> {
    ready_font()?;
    // Measured large, because the library rounds to whole pixels.
    let font = (FONT, size * 10.0).into_font();
    let (width, _) = font.box_size(text).map_err(backend)?;
    Ok(f64::from(width) / 10.0)
}

fn backend(error: impl std::fmt::Display) -> PlotError {
    PlotError::Backend(error.to_string())
}

/// Registers the bundled font once; without it the first text panics.
fn ready_font() -> Result<(), PlotError> {
    static READY: OnceLock<bool> = OnceLock::new();
    let ready = *READY.get_or_init(|| register_font(FONT, FontStyle::Normal, FONT_BYTES).is_ok());
    if ready {
        Ok(())
    } else {
        Err(PlotError::Backend("the bundled font is damaged".to_owned()))
    }
}

fn pixel((x, y): (f64, f64)) -> (i32, i32) {
    let scale = f64::from(DRAWN);
    ((x * scale).round() as i32, (y * scale).round() as i32)
}

fn draw_mark<DB: DrawingBackend>(
    root: &DrawingArea<DB, Shift>,
    mark: &Mark,
    pen: Pen,
) -> Result<(), PlotError> {
    let scale = f64::from(DRAWN);
    match mark {
        Mark::Path(points, stroke) => {
            let width = (stroke.width * scale).round().max(1.0) as u32;
            let style = stroke.colour.stroke_width(width);
            let pieces = if stroke.dashed {
                dashes(points, 6.0, 4.0)
            } else {
                vec![points.clone()]
            };
            for piece in pieces {
                let path: Vec<(i32, i32)> = piece.into_iter().map(pixel).collect();
                match pen {
                    Pen::Path => {
                        root.draw(&PathElement::new(path, style)).map_err(backend)?;
                    }
                    Pen::Round => draw_round(root, &path, style, width)?,
                }
            }
            Ok(())
        }
        Mark::Area(points, colour) => {
            let path: Vec<(i32, i32)> = points.iter().copied().map(pixel).collect();
            root.draw(&Polygon::new(path, colour.filled()))
                .map_err(backend)
        }
        Mark::Fill(from, to, colour) => root
            .draw(&Rectangle::new([pixel(*from), pixel(*to)], colour.filled()))
            .map_err(backend),
        Mark::Dot(centre, radius, colour) => root
            .draw(&Circle::new(
                pixel(*centre),
                (radius * scale).round() as i32,
                colour.filled(),
            ))
            .map_err(backend),
        Mark::Text(label) => draw_label(root, label, scale),
    }
}

/// Draws a path segment by segment with a disc at each joint: the library's own bitmaps of thick paths
/// run out into long spikes where a path turns back.
fn draw_round<DB: DrawingBackend>(
    root: &DrawingArea<DB, Shift>,
    path: &[(i32, i32)],
    style: ShapeStyle,
    width: u32,
) -> Result<(), PlotError> {
    for pair in path.windows(2) {
        root.draw(&PathElement::new(pair.to_vec(), style))
            .map_err(backend)?;
    }
    let joints = path.get(1..path.len().saturating_sub(1)).unwrap_or(&[]);
    for joint in joints.iter().filter(|_| width > 2) {
        let disc = Circle::new(*joint, (width / 2) as i32, style.color.filled());
        root.draw(&disc).map_err(backend)?;
    }
    Ok(())
}

/// How paths are put down.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pen {
    /// As one path, whose joints the viewer draws.
    Path,
    /// Segment by segment with round joints.
    Round,
}

fn draw_label<DB: DrawingBackend>(
    root: &DrawingArea<DB, Shift>,
    label: &Label,
    scale: f64,
) -> Result<(), PlotError> {
    let h = match label.align {
        Align::Start => HPos::Left,
        Align::Middle => HPos::Center,
        Align::End => HPos::Right,
    };
    let font = (FONT, label.size * scale).into_font();
    let font = if label.upward {
        font.transform(FontTransform::Rotate270)
    } else {
        font
    };
    let style = TextStyle::from(font)
        .color(&label.colour)
        .pos(Pos::new(h, VPos::Center));
    root.draw(&Text::new(label.text.clone(), pixel(label.at), style))
        .map_err(backend)
}

/// Cuts a polyline into dashes of `on` with gaps of `off` logical pixels.
fn dashes(points: &[(f64, f64)], on: f64, off: f64) -> Vec<Vec<(f64, f64)>> {
    let mut pieces = Vec::new();
    let Some(first) = points.first() else {
        return pieces;
    };
    let mut piece = vec![*first];
    let (mut drawing, mut left) = (true, on);
    for pair in points.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        loop {
            let length = (to.0 - from.0).hypot(to.1 - from.1);
            if length < left {
                left -= length;
                if drawing {
                    piece.push(to);
                }
                break;
            }
            let share = left / length;
            from = (
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            );
            if drawing {
                piece.push(from);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![from];
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
    }
    if drawing && piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}

/// Averages squares of `factor` by `factor` RGB pixels.
fn average(pixels: &[u8], width: usize, factor: usize) -> Vec<u8> {
    let (columns, rows) = (width / factor, pixels.len() / 3 / width / factor);
    let mut out = Vec::with_capacity(columns * rows * 3);
    for y in 0..rows {
        for x in 0..columns {
            for channel in 0..3 {
                let mut sum = 0usize;
                for dy in 0..factor {
                    let start = ((y * factor + dy) * width + x * factor) * 3 + channel;
                    sum += (0..factor)
                        .map(|dx| usize::from(pixels[start + 3 * dx]))
                        .sum::<usize>();
                }
                out.push((sum / (factor * factor)) as u8);
            }
        }
    }
    out
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, PlotError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(backend)?;
    writer.write_image_data(pixels).map_err(backend)?;
    writer.finish().map_err(backend)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::drawing::Stroke;
    use super::*;

    fn sample() -> Drawing {
        let mut drawing = Drawing::new(30, 20);
        drawing.line((0.0, 5.0), (30.0, 5.0), Stroke::solid(palette::INK, 2.0));
        drawing.text("σ < é", (15.0, 12.0), 8.0, Align::Middle);
        drawing
    }

    #[test]
    fn svg_is_shown_at_logical_size_and_escapes_text() {
        let svg = sample().to_svg().expect("drawable");
        assert!(svg.starts_with(r#"<svg width="30" height="20" viewBox="0 0 120 80""#));
        assert!(svg.contains("σ &lt; é"));
        assert!(svg.trim_end().ends_with("</svg>"));
    }

    #[test]
    fn png_decodes_to_twice_the_logical_size() {
        let bytes = sample().to_png().expect("drawable");
        let mut reader = png::Decoder::new(bytes.as_slice())
            .read_info()
            .expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size()];
        let info = reader.next_frame(&mut pixels).expect("one frame");
        assert_eq!((info.width, info.height), (60, 40));
        // On the line, and on the paper above it.
        assert_eq!(pixels[(10 * 60 + 30) * 3], palette::INK.0);
        assert_eq!(pixels[(2 * 60 + 30) * 3], 255);
    }

    #[test]
    fn dashes_leave_gaps_of_the_right_length() {
        let pieces = dashes(&[(0.0, 0.0), (12.0, 0.0), (25.0, 0.0)], 6.0, 4.0);
        assert_eq!(
            pieces,
            vec![
                vec![(0.0, 0.0), (6.0, 0.0)],
                vec![(10.0, 0.0), (12.0, 0.0), (16.0, 0.0)],
                vec![(20.0, 0.0), (25.0, 0.0)]
            ]
        );
    }

    #[test]
    fn wider_texts_are_wider() {
        let short = text_width("pml", 12.0).expect("font");
        let long = text_width("pml-stretched", 12.0).expect("font");
        assert!(short > 10.0 && long > 3.0 * short);
    }
}
