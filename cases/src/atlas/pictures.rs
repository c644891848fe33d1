//! Pictures of the atlas.

use super::measure::{Measured, OBLIQUE, STEEPEST};
use crate::pictures::Picture;
use anechoic_reference::analytic::oblique::Wave;
use anechoic_reports::plot::{CurvePanel, CurvePlot, Line, PlotError};

/// Lower end of the pictures.
const LOWEST: f64 = 1e-5;

/// Reflection against angle, thickness and cells; those for which there is something to draw.
///
/// # Errors
/// A picture that cannot be drawn, with its name.
pub fn draw(all: &[Measured]) -> Result<Vec<Picture>, (&'static str, PlotError)> {
    let mut pictures = vec![angles(all).map_err(|e| ("reflection-angle", e))?];
    if all.iter().any(|m| !m.thickness.is_empty()) {
        pictures.push(thickness(all).map_err(|e| ("reflection-thickness", e))?);
    }
    if all.iter().any(|m| m.levels.len() > 1) {
        pictures.push(cells(all).map_err(|e| ("reflection-cells", e))?);
    }
    Ok(pictures)
}

/// One panel a wave.
fn panels(
    title: impl Fn(Wave) -> String,
    lines: impl Fn(Wave) -> Vec<Line>,
    closed: impl Fn(Wave) -> Vec<Line>,
) -> Vec<CurvePanel> {
    let panel = |wave| CurvePanel {
        title: title(wave),
        lines: lines(wave),
        closed: closed(wave),
    };
    Wave::BOTH.map(panel).to_vec()
}

fn line(name: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Line {
    let (x, y) = points.into_iter().unzip();
    Line {
        name: name.to_owned(),
        x,
        y,
    }
}

fn name(wave: Wave) -> &'static str {
    match wave {
        Wave::P => "incident P",
        Wave::S => "incident S",
    }
}

fn angles(all: &[Measured]) -> Result<Picture, PlotError> {
    let measured = |wave: Wave| {
        let curve = |m: &Measured| {
            let points = (0..=STEEPEST).map(|a| (a as f64, m.total(wave, a)));
            line(&m.subject.name, points)
        };
        all.iter().map(curve).collect()
    };
    let closed = |wave: Wave| {
        let curve = |m: &Measured| {
            let points: Vec<(f64, f64)> = (0..=STEEPEST)
                .filter_map(|a| Some((a as f64, m.subject.closed(wave, a as f64)?.ok()?)))
                .collect();
            (!points.is_empty()).then(|| line(&m.subject.name, points))
        };
        all.iter().filter_map(curve).collect()
    };
    let cells = |wave| {
        let subject = &all[0].subject;
        format!(
            "{}, {:.1} cells a wavelength",
            name(wave),
            subject.wavelength(wave) / subject.h
        )
    };
    Ok(Picture {
        name: "reflection-angle".into(),
        title: "Reflection against the angle of incidence".into(),
        caption: "Plane waves of the source's frequency that meet a side at an angle: square root of the energy that comes back, P and S together, over that which came. Solid: the solver on the scene's cells; dashed: closed forms of the continuum, which cells of no size would follow. Where a solid line lies above its dashed one, the mesh reflects and not the method.".to_owned(),
        drawing: CurvePlot {
            panels: panels(cells, measured, closed),
            x: ("angle of incidence".into(), "degrees".into()),
            x_log: false,
            y: "reflection".into(),
            lowest: LOWEST,
        }
        .draw()?,
        raster: false,
    })
}

fn thickness(all: &[Measured]) -> Result<Picture, PlotError> {
    let title = |wave: Wave| format!("{} at {OBLIQUE} degrees", name(wave));
    let lines = |wave: Wave| {
        let layers = all.iter().filter(|m| !m.thickness.is_empty());
        let curve = |m: &Measured| {
            let length = m.subject.wavelength(wave);
            let points = m.thickness.iter();
            let points = points.map(|(l, totals)| (l / length, totals[wave as usize]));
            line(&m.subject.side.method, points)
        };
        layers.map(curve).collect()
    };
    Ok(Picture {
        name: "reflection-thickness".into(),
        title: "Reflection against the layer's thickness".into(),
        caption: format!(
            "The scene's cells, layers of 2 to 80 of them with all else as the scene has it, plane waves at {OBLIQUE} degrees. The perfectly matched layer's own aim follows its number of cells."
        ),
        drawing: CurvePlot {
            panels: panels(title, lines, |_| Vec::new()),
            x: ("thickness / wavelength".into(), String::new()),
            x_log: true,
            y: "reflection".into(),
            lowest: LOWEST,
        }
        .draw()?,
        raster: false,
    })
}

fn cells(all: &[Measured]) -> Result<Picture, PlotError> {
    let title = |wave: Wave| format!("{} at {OBLIQUE} degrees", name(wave));
    let lines = |wave: Wave| {
        let curve = |m: &Measured| {
            let length = m.subject.wavelength(wave);
            let points = m.levels.iter();
            let points = points.map(|level| (length / level.h, level.oblique[wave as usize]));
            line(&m.subject.name, points)
        };
        all.iter().map(curve).collect()
    };
    let closed = |wave: Wave| {
        let curve = |m: &Measured| {
            let value = m.subject.closed(wave, OBLIQUE)?.ok()?;
            let length = m.subject.wavelength(wave);
            let points = m.levels.iter().map(|level| (length / level.h, value));
            Some(line(&m.subject.name, points))
        };
        all.iter().filter_map(curve).collect()
    };
    Ok(Picture {
        name: "reflection-cells".into(),
        title: "Reflection against the cells in a wavelength".into(),
        caption: format!(
            "The same side on coarser and finer cells, with steps in proportion, plane waves at {OBLIQUE} degrees. A slope of two is the mesh's own reflection; where a line levels off at its dashed one, the method is what reflects."
        ),
        drawing: CurvePlot {
            panels: panels(title, lines, closed),
            x: ("cells in a wavelength".into(), String::new()),
            x_log: true,
            y: "reflection".into(),
            lowest: LOWEST,
        }
        .draw()?,
        raster: false,
    })
}
