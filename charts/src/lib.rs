//! Drawings of measured numbers, as SVG text: no files, no fonts, no dependencies.

pub mod axis;
pub mod field;
pub mod heat_map;
pub mod legible;
pub mod map;
pub mod plot;
pub mod style;
pub mod svg;
pub mod text;
pub mod work_precision;
