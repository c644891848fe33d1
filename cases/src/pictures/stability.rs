//! The map of a study of stability.

use super::{Gallery, Picture, PictureError};
use anechoic_reports::plot::stability_map;
use anechoic_reports::stability::Stability;

/// The map of a study of stability.
pub fn draw_stability(stability: &Stability) -> Gallery {
    let mut gallery = Gallery::default();
    let made = stability_map(stability).map(|drawing| {
        Some(Picture {
            name: "stability".into(),
            title: "Which methods stay stable".into(),
            caption: "Growth rate of the total energy over the second half of each run, or how it ended. Everything but the extreme is the scene's own.".into(),
            drawing,
            raster: false,
        })
    });
    gallery.add("stability", made.map_err(PictureError::from));
    gallery
}
