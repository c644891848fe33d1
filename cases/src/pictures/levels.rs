//! Pictures of a convergence study: one an error.

use super::{Gallery, Picture, PictureError};
use crate::over::{CELLS, POINTS, STEP};
use anechoic_reports::convergence::{Convergence, Curve, Refinement};
use anechoic_reports::plateau::EXPECTED;
use anechoic_reports::plot::{ConvergencePlot, ConvergenceSeries};

/// Metric, file, title.
const PICTURES: [(&str, &str, &str); 2] = [
    ("rel_l2", "convergence", "Convergence of the whole series"),
    (
        "peak_error",
        "convergence-peak",
        "Convergence of the largest deviation",
    ),
];

/// The pictures of convergence studies: of the first under plain names, of others with their field's.
pub fn draw_convergence(refinement: &Refinement) -> Gallery {
    let mut gallery = Gallery::default();
    for (i, study) in refinement.studies.iter().enumerate() {
        for (metric, name, title) in PICTURES {
            let name = match i {
                0 => name.to_owned(),
                _ => format!("{name}-{}", study.over.replace('.', "-")),
            };
            gallery.add(&name, picture(study, metric, &name, title));
        }
    }
    gallery
}

/// One error at all receivers that have an order; none when no receiver has one.
fn picture(
    convergence: &Convergence,
    metric: &str,
    name: &str,
    title: &str,
) -> Result<Option<Picture>, PictureError> {
    let sizes: Vec<f64> = convergence.levels.iter().map(|level| level.size).collect();
    let shown = convergence.curves.iter().filter(|c| c.metric == metric);
    let series = |curve: &Curve| {
        let errors: Result<Vec<f64>, &String> = curve
            .errors
            .iter()
            .map(|error| error.as_ref().copied())
            .collect();
        Some(ConvergenceSeries {
            name: curve.place.clone(),
            h: sizes.clone(),
            errors: errors.ok()?,
            order: Some(curve.order.as_ref().ok()?.fit.value),
        })
    };
    let series: Vec<ConvergenceSeries> = shown.filter_map(series).collect();
    if series.is_empty() {
        return Ok(None);
    }
    let drawing = ConvergencePlot {
        quantity: metric.to_owned(),
        series,
        refined: match convergence.over.as_str() {
            CELLS => "cell size h (m)".to_owned(),
            STEP => "time step (s)".to_owned(),
            POINTS => "distance of points (m)".to_owned(),
            field => field.to_owned(),
        },
        slope: EXPECTED,
    }
    .draw()?;
    Ok(Some(Picture {
        name: name.into(),
        title: format!("{title} over {}", convergence.over),
        caption: format!(
            "`{metric}` of {} at the receivers, on logarithmic axes; the triangle has the slope of a scheme of second order.",
            convergence.method
        ),
        drawing,
        raster: false,
    }))
}
