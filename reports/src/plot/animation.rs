//! Fields over time as an animated GIF: methods side by side, one frame a time, one scale for all.
//!
//! What stands still is drawn once; a frame holds the rectangle in which it differs from the one
//! before. Colours are those of the map and a ramp of greys for all that is drawn around it.

use super::axis::{Panel, TITLE_TEXT};
use super::drawing::{Align, Drawing};
use super::heat::{Colours, colour_bar};
use super::snapshots::{BAR, FOOT, Field, SnapshotPlot, WIDTH, draw_ground, field_part, outline};
use super::{PlotError, palette};
use gif::{Encoder, Frame, Repeat};
use plotters::style::RGBColor;

/// Place of the panels: room for headlines and the time above them.
const TOP: f64 = 34.0;
/// Height of the line with the time.
const LINE: u32 = 22;
/// Greys of the ramp, from ink to paper.
const GREYS: usize = 54;
/// Time for which a frame stands (1/100 s); the last one stands [`HOLD`] times as long.
const DELAY: u16 = 8;
const HOLD: u16 = 12;

/// Colours by their index in the file.
struct Colouring {
    map: Colours,
    all: Vec<RGBColor>,
}

impl Colouring {
    fn new(map: Colours) -> Self {
        let ink = f64::from(palette::INK.0);
        let grey = |i: usize| {
            let share = i as f64 / (GREYS - 1) as f64;
            let level = (ink + share * (255.0 - ink)).round() as u8;
            RGBColor(level, level, level)
        };
        let all = map.levels().chain((0..GREYS).map(grey)).collect();
        Colouring { map, all }
    }

    /// The file's table.
    fn table(&self) -> Vec<u8> {
        self.all.iter().flat_map(|c| [c.0, c.1, c.2]).collect()
    }

    /// The nearest colours of pixels; neighbours are mostly alike.
    fn indices(&self, pixels: &[u8]) -> Vec<u8> {
        let mut last: ([u8; 3], u8) = ([0; 3], self.nearest([0; 3]));
        let of = |pixel: &[u8]| {
            let pixel = [pixel[0], pixel[1], pixel[2]];
            if pixel != last.0 {
                last = (pixel, self.nearest(pixel));
            }
            last.1
        };
        pixels.chunks_exact(3).map(of).collect()
    }

    fn nearest(&self, pixel: [u8; 3]) -> u8 {
        let distance = |c: &RGBColor| {
            let part = |a: u8, b: u8| (i32::from(a) - i32::from(b)).pow(2);
            part(c.0, pixel[0]) + part(c.1, pixel[1]) + part(c.2, pixel[2])
        };
        let best = (0..self.all.len()).min_by_key(|&i| distance(&self.all[i]));
        // There are at most 256.
        best.unwrap_or(0) as u8
    }
}

impl SnapshotPlot {
    /// The plot as an animated GIF, one frame a row, with the scale of [`Self::draw`].
    pub fn to_gif(&self) -> Result<Vec<u8>, PlotError> {
        self.check()?;
        let colours = Colouring::new(Colours::sequential(self.scale()));
        let still = self.still(&colours)?;
        let (width, height) = still.size();
        let (width, height) = (width as usize, height as usize);
        let ground = colours.indices(&still.to_pixels(1)?);
        let failed = |error: gif::EncodingError| PlotError::Backend(error.to_string());
        let mut file = Vec::new();
        let table = colours.table();
        let mut encoder =
            Encoder::new(&mut file, width as u16, height as u16, &table).map_err(failed)?;
        encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
        let mut shown: Vec<u8> = Vec::new();
        for (row, (time, fields)) in self.rows.iter().enumerate() {
            let mut pixels = ground.clone();
            for (column, field) in fields.iter().enumerate() {
                let part = field_part(&self.panel(column, TOP), field);
                paint(&mut pixels, width, &part, field, &colours.map);
            }
            write_time(&mut pixels, width, *time, &colours)?;
            let last = row + 1 == self.rows.len();
            let mut frame = changed(&shown, &pixels, width);
            frame.delay = if last { HOLD * DELAY } else { DELAY };
            encoder.write_frame(&frame).map_err(failed)?;
            shown = pixels;
        }
        drop(encoder);
        Ok(file)
    }

    /// All that stands still.
    fn still(&self, colours: &Colouring) -> Result<Drawing, PlotError> {
        let (_, panel_height) = self.panel_size();
        let total = TOP + panel_height + FOOT;
        let mut drawing = Drawing::new(WIDTH as u32, total as u32);
        let Some((_, fields)) = self.rows.first() else {
            return Ok(drawing);
        };
        for (column, field) in fields.iter().enumerate() {
            let panel = self.panel(column, TOP);
            draw_ground(&mut drawing, &panel, &self.meshes[column]);
            outline(&mut drawing, &field_part(&panel, field));
            self.label(&mut drawing, &panel, column, (true, true));
        }
        let name = (self.quantity.as_str(), self.unit.as_str());
        let height = panel_height.min(260.0);
        colour_bar(&mut drawing, (WIDTH - BAR, TOP), height, &colours.map, name);
        Ok(drawing)
    }
}

/// Colours the pixels of a field, but not those of its outline.
fn paint(pixels: &mut [u8], width: usize, part: &Panel, field: &Field, colours: &Colours) {
    let (x_range, y_range) = (part.x.range(), part.y.range());
    let along = |at: usize, from: f64, size: f64| (at as f64 + 0.5 - from) / size;
    let inner = |from: f64, to: f64| from.round() as usize + 1..to.round() as usize - 1;
    field.raster_with(|raster| {
        for row in inner(part.top, part.bottom()) {
            let share = 1.0 - along(row, part.top, part.height);
            let y = y_range.0 + share * (y_range.1 - y_range.0);
            for column in inner(part.left, part.right()) {
                let share = along(column, part.left, part.width);
                let x = x_range.0 + share * (x_range.1 - x_range.0);
                pixels[row * width + column] = colours.level(raster.at(x, y)) as u8;
            }
        }
    });
}

/// Writes the time above the colour bar.
fn write_time(
    pixels: &mut [u8],
    width: usize,
    time: f64,
    colours: &Colouring,
) -> Result<(), PlotError> {
    let left = (WIDTH - BAR) as usize;
    let mut line = Drawing::new(BAR as u32, LINE);
    let middle = 0.5 * f64::from(LINE);
    let text = format!("t = {time:.2} s");
    line.text(&text, (0.0, middle), TITLE_TEXT, Align::Start);
    let text = colours.indices(&line.to_pixels(1)?);
    let columns = BAR as usize;
    for (row, values) in text.chunks_exact(columns).enumerate() {
        let start = row * width + left;
        pixels[start..start + columns].copy_from_slice(values);
    }
    Ok(())
}

/// The rectangle in which `pixels` differ from what is shown; all where nothing is shown, a single
/// pixel where nothing differs.
fn changed(shown: &[u8], pixels: &[u8], width: usize) -> Frame<'static> {
    let height = pixels.len() / width;
    let differs = |row: usize, column: usize| {
        let at = row * width + column;
        shown.get(at) != Some(&pixels[at])
    };
    let in_row = |row: &usize| (0..width).any(|column| differs(*row, column));
    let in_column = |column: &usize| (0..height).any(|row| differs(row, *column));
    let rows = (0..height).find(in_row).zip((0..height).rfind(in_row));
    let columns = (0..width).find(in_column).zip((0..width).rfind(in_column));
    let ((top, bottom), (left, right)) = (rows.unwrap_or((0, 0)), columns.unwrap_or((0, 0)));
    let part = (top..=bottom).flat_map(|row| &pixels[row * width + left..=row * width + right]);
    Frame {
        top: top as u16,
        left: left as u16,
        width: (right - left + 1) as u16,
        height: (bottom - top + 1) as u16,
        buffer: part.copied().collect::<Vec<u8>>().into(),
        ..Frame::default()
    }
}
