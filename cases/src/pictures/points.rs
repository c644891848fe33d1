//! Pictures of a sweep, part by part: echo over the parameter, what is left late, and cost.

use super::{Gallery, Picture, PictureError};
use anechoic_reports::plot::{PointPanel, PointPlot, PointSeries};
use anechoic_reports::sweep::{Range, Sweep, SweepEntry, SweepPart};

/// The pictures of a sweep.
pub fn draw_sweep(sweep: &Sweep) -> Gallery {
    let mut gallery = Gallery::default();
    for part in &sweep.parts {
        if part.points.iter().filter(|p| p.value.is_some()).count() < 2 {
            continue;
        }
        let name = |what: &str| format!("{}-{what}", file_name(&part.name));
        gallery.add("echo", echo(part, name("echo")));
        gallery.add("late", late(part, name("late")));
    }
    gallery
}

/// A part's name as that of a file.
fn file_name(part: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
    part.chars().map(plain).collect()
}

/// Echo of each group over the parameter, on a logarithmic scale, and the cost.
fn echo(part: &SweepPart, name: String) -> Result<Option<Picture>, PictureError> {
    let methods = part.methods();
    let series = |number: &dyn Fn(&SweepEntry) -> Option<f64>| -> Vec<PointSeries> {
        let of = |method: &&str| {
            let (x, y) = part.curve(method, number).into_iter().unzip();
            PointSeries {
                name: (*method).to_owned(),
                x,
                y,
                ..PointSeries::default()
            }
        };
        methods.iter().map(of).filter(|s| !s.x.is_empty()).collect()
    };
    let of_group = |group: &str, entry: &SweepEntry| {
        let found = entry.echo.iter().find(|(name, _)| name == group);
        found.and_then(|(_, echo)| echo.clone().ok())
    };
    let mut panels: Vec<PointPanel> = part
        .groups()
        .into_iter()
        .map(|group| PointPanel {
            title: group.to_owned(),
            y_name: "echo ratio".to_owned(),
            log: true,
            series: series(&|entry| of_group(group, entry)),
            ..PointPanel::default()
        })
        .filter(|panel| !panel.series.is_empty())
        .collect();
    if panels.is_empty() {
        return Ok(None);
    }
    panels.push(PointPanel {
        title: "cost".to_owned(),
        y_name: "CPU time of 1000 steps".to_owned(),
        unit: "s".to_owned(),
        series: series(&SweepEntry::cpu_s_per_1000),
        ..PointPanel::default()
    });
    let drawing = PointPlot {
        x_name: part.axis.clone(),
        x_log: false,
        panels,
    }
    .draw()?;
    Ok(Some(Picture {
        name,
        title: part.title.clone(),
        caption: "Echo ratio (mean of each group of receivers) and CPU time over the parameter; zero is perfect.".into(),
        drawing,
        raster: false,
    }))
}

/// Displacements late in the run less the reference's mean, with its own range, as the paper draws them.
fn late(part: &SweepPart, name: String) -> Result<Option<Picture>, PictureError> {
    let references = part.points.iter().filter_map(|point| point.late_reference);
    let Some(band) = references.reduce(|a, b| Range {
        min: a.min.min(b.min),
        mean: a.mean,
        max: a.max.max(b.max),
    }) else {
        return Ok(None);
    };
    let series = part.methods().into_iter().map(|method| {
        let mut series = PointSeries {
            name: method.to_owned(),
            ..PointSeries::default()
        };
        for point in &part.points {
            let entry = point.entries.iter().find(|entry| entry.method == method);
            if let (Some(x), Some(late), Some(reference)) = (
                point.value,
                entry.and_then(|e| e.late),
                point.late_reference,
            ) {
                series.x.push(x);
                series.y.push(late.mean - reference.mean);
                let ends = [late.min, late.max].map(|u| u - reference.mean);
                series.whiskers.push(ends);
            }
        }
        series
    });
    let series: Vec<PointSeries> = series.filter(|s| !s.x.is_empty()).collect();
    if series.is_empty() {
        return Ok(None);
    }
    let drawing = PointPlot {
        x_name: part.axis.clone(),
        x_log: false,
        panels: vec![PointPanel {
            title: format!("receiver {}", part.late_at),
            y_name: "|u| − mean of the reference".to_owned(),
            unit: "m".to_owned(),
            band: Some((
                [band.min - band.mean, band.max - band.mean],
                "reference".to_owned(),
            )),
            series,
            ..PointPanel::default()
        }],
    }
    .draw()?;
    Ok(Some(Picture {
        name,
        title: format!("{}: late displacement", part.title),
        caption: "Mean (dot), smallest and largest magnitude of displacement once echoes are looked for, less the reference's mean; shaded: the reference's own range.".into(),
        drawing,
        raster: false,
    }))
}
