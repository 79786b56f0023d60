//! Drawings of measured numbers, as SVG text: no files, no fonts, no dependencies.

pub mod axis;
pub mod svg;
pub mod work_precision;
