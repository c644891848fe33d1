//! Pictures of accuracy against cost.

use super::{Gallery, Picture, PictureError};
use anechoic_reports::plot::{PointPanel, PointPlot, PointSeries, Style};
use anechoic_reports::tradeoff::{ECHOES, Standing, Trade, Tradeoff};

/// Echoes below this, or below the reference's floor, are no longer drawn: they are rounding.
const SMALLEST: f64 = 1e-5;

/// Name of the front's line.
const FRONT: &str = "front";

/// The pictures of a study of accuracy against cost.
pub fn draw_tradeoff(tradeoff: &Tradeoff) -> Gallery {
    let mut gallery = Gallery::default();
    let front = drawn(tradeoff, &|trade| trade.cpu_s);
    gallery.add("tradeoff", over(tradeoff, front, COST));
    let bytes = drawn(tradeoff, &|trade| trade.peak_bytes.map(|b| b / 1048576.0));
    gallery.add("tradeoff-memory", over(tradeoff, bytes, MEMORY));
    let length = tradeoff.wavelengths_m[0];
    let thick = |trade: &Trade| trade.known.thickness_m.map(|l| l / length);
    gallery.add(
        "tradeoff-thickness",
        over(tradeoff, drawn(tradeoff, &thick), THICKNESS),
    );
    gallery
}

/// What a picture is called.
struct About {
    name: &'static str,
    title: &'static str,
    axis: &'static str,
    caption: &'static str,
}

const COST: About = About {
    name: "tradeoff",
    title: "Echo against CPU time",
    axis: "CPU time (s)",
    caption: "Each dot is a run; left and low is good. Dashed: the front, on which no other run leaves less echo in as little time; the extended mesh, which leaves none, is where it ends to the right.",
};
const MEMORY: About = About {
    name: "tradeoff-memory",
    title: "Echo against memory",
    axis: "peak memory (MiB)",
    caption: "Each dot is a run; left and low is good.",
};
const THICKNESS: About = About {
    name: "tradeoff-thickness",
    title: "Echo against thickness",
    axis: "thickness over the length of compressional waves",
    caption: "How thick a layer must be, in wavelengths, so that the answer carries over to other materials and frequencies.",
};

/// The methods' dots, and the front where cost is drawn.
fn drawn(tradeoff: &Tradeoff, x: &dyn Fn(&Trade) -> Option<f64>) -> Vec<PointSeries> {
    let smallest = tradeoff.floor.unwrap_or(0.0).max(SMALLEST);
    let place = |trade: &Trade| {
        let ended = !matches!(trade.standing, Standing::Failed(_));
        let echo = trade.echo.filter(|echo| *echo >= smallest);
        x(trade).zip(echo).filter(|_| ended)
    };
    let series = |name: &str, style: Style, trades: Vec<&Trade>| {
        let mut places: Vec<(f64, f64)> = trades.into_iter().filter_map(place).collect();
        places.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (x, y) = places.into_iter().unzip();
        PointSeries {
            name: name.to_owned(),
            x,
            y,
            style,
            ..PointSeries::default()
        }
    };
    let mut all: Vec<PointSeries> = tradeoff
        .methods()
        .into_iter()
        .map(|method| {
            let own = tradeoff.trades.iter().filter(|t| t.method == method);
            series(method, Style::Dots, own.collect())
        })
        .filter(|series| !series.x.is_empty())
        .collect();
    let front = tradeoff
        .trades
        .iter()
        .filter(|t| t.standing == Standing::Front);
    all.push(series(FRONT, Style::Dashed, front.collect()));
    all
}

fn over(
    tradeoff: &Tradeoff,
    mut series: Vec<PointSeries>,
    about: About,
) -> Result<Option<Picture>, PictureError> {
    if about.name != COST.name {
        series.pop();
    }
    if series.iter().all(|series| series.x.is_empty()) {
        return Ok(None);
    }
    let mut rules: Vec<(f64, String)> = ECHOES
        .iter()
        .map(|echo| (*echo, format!("{} %", 100.0 * echo)))
        .collect();
    let lowest = series
        .iter()
        .flat_map(|s| &s.y)
        .copied()
        .fold(f64::INFINITY, f64::min);
    let near = |floor: &f64| *floor > 0.05 * lowest;
    if let Some(floor) = tradeoff.floor.filter(near) {
        rules.push((floor, "floor of the reference".to_owned()));
    }
    let drawing = PointPlot {
        x_name: about.axis.to_owned(),
        x_log: true,
        panels: vec![PointPanel {
            title: "mean echo ratio of the groups of receivers".to_owned(),
            y_name: "echo ratio".to_owned(),
            log: true,
            rules,
            series,
            ..PointPanel::default()
        }],
    }
    .draw()?;
    Ok(Some(Picture {
        name: about.name.to_owned(),
        title: about.title.to_owned(),
        caption: about.caption.to_owned(),
        drawing,
        raster: false,
    }))
}
