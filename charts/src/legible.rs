//! Whether a drawing can be read: its texts lie on the sheet and clear of each other and of the curves, axes have ticks,
//! and no two series look alike.
//!
//! It reads the SVG text that [`Svg`](crate::svg::Svg) writes, so that it judges a file as well as a fresh drawing.

use crate::text;

/// An axis with fewer labels tells no scale.
const FEWEST_TICKS: usize = 3;
/// Height of a text above its baseline and below, as parts of the size of its font.
const ASCENT: f64 = 0.76;
const DESCENT: f64 = 0.22;
/// Texts may touch by this much \[pixels\].
const TOUCH: f64 = 0.5;

/// A rectangle: left, top, right, bottom \[pixels\].
#[derive(Debug, Clone, Copy, PartialEq)]
struct Extent([f64; 4]);

impl Extent {
    fn overlaps(&self, other: &Self) -> bool {
        let (Self([left, top, right, bottom]), Self(o)) = (self, other);
        left + TOUCH < o[2] && o[0] + TOUCH < *right && top + TOUCH < o[3] && o[1] + TOUCH < *bottom
    }

    /// Whether a straight line passes through, the margin `TOUCH` left out.
    fn is_crossed(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let Self([left, top, right, bottom]) = self;
        let (low, high) = ([left + TOUCH, top + TOUCH], [right - TOUCH, bottom - TOUCH]);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let way = to[axis] - from[axis];
            let (a, b) = (low[axis] - from[axis], high[axis] - from[axis]);
            if way == 0.0 {
                if a > 0.0 || b < 0.0 {
                    return false;
                }
                continue;
            }
            let (first, last) = if way > 0.0 { (a / way, b / way) } else { (b / way, a / way) };
            enter = enter.max(first);
            leave = leave.min(last);
        }
        enter < leave
    }
}

struct Text {
    words: String,
    extent: Extent,
    class: String,
}

struct Curve {
    class: String,
    look: String,
    points: Vec<[f64; 2]>,
}

/// What is wrong with a drawing, in words; empty if it can be read.
#[must_use]
pub fn faults(svg: &str) -> Vec<String> {
    let texts: Vec<Text> = elements(svg, "text").filter_map(text_of).collect();
    let curves: Vec<Curve> = elements(svg, "polyline").filter_map(curve_of).collect();
    let mut faults = beyond_the_sheet(svg, &texts);
    for (index, one) in texts.iter().enumerate() {
        for other in texts[index + 1..].iter().filter(|other| one.extent.overlaps(&other.extent)) {
            faults.push(format!("`{}` and `{}` overlap", one.words, other.words));
        }
        let crosses =
            |curve: &&Curve| curve.points.windows(2).any(|ends| one.extent.is_crossed(ends[0], ends[1]));
        if let Some(curve) = curves.iter().find(crosses) {
            faults.push(format!("`{}` lies on the curve of {}", one.words, curve.class));
        }
    }
    faults.extend(short_axes(&texts));
    faults.extend(twins(&curves));
    faults
}

fn beyond_the_sheet(svg: &str, texts: &[Text]) -> Vec<String> {
    let head = elements(svg, "svg").next().unwrap_or_default();
    let (Some(width), Some(height)) = (number(head, "width"), number(head, "height")) else {
        return vec!["the sheet has no size".to_owned()];
    };
    let beyond = |text: &&Text| {
        let Extent([left, top, right, bottom]) = text.extent;
        left < -TOUCH || top < -TOUCH || right > width + TOUCH || bottom > height + TOUCH
    };
    texts.iter().filter(beyond).map(|text| format!("`{}` runs off the sheet", text.words)).collect()
}

/// Texts of class `tick NAME` belong to one axis.
fn short_axes(texts: &[Text]) -> Vec<String> {
    let mut axes: Vec<(&str, usize)> = Vec::new();
    for name in texts.iter().filter_map(|text| text.class.strip_prefix("tick ")) {
        match axes.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => axes.push((name, 1)),
        }
    }
    let short = axes.into_iter().filter(|(_, count)| *count < FEWEST_TICKS);
    short.map(|(name, count)| format!("axis {name} has {count} ticks")).collect()
}

/// Curves of different classes `series NAME` that look the same.
fn twins(curves: &[Curve]) -> Vec<String> {
    let mut looks: Vec<(&str, &str)> = Vec::new();
    let mut faults = Vec::new();
    for curve in curves {
        match looks.iter().find(|(_, look)| *look == curve.look) {
            Some((class, _)) if *class != curve.class => {
                faults.push(format!("{} and {class} look alike", curve.class));
            }
            Some(_) => {}
            None => looks.push((&curve.class, &curve.look)),
        }
    }
    faults
}

/// Each element of that name, from its name to its end.
fn elements<'a>(svg: &'a str, name: &'a str) -> impl Iterator<Item = &'a str> {
    svg.split('<').filter_map(move |element| element.strip_prefix(name).filter(|rest| rest.starts_with(' ')))
}

fn attribute<'a>(element: &'a str, name: &str) -> Option<&'a str> {
    element.split_once(&format!(" {name}=\""))?.1.split('"').next()
}

fn number(element: &str, name: &str) -> Option<f64> {
    attribute(element, name)?.parse().ok()
}

fn text_of(element: &str) -> Option<Text> {
    let words = element.split_once('>')?.1;
    let words = words.replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
    let size = number(element, "font-size")?;
    let width = text::width(&words, size);
    let start = match attribute(element, "text-anchor")? {
        "start" => 0.0,
        "middle" => -0.5 * width,
        _ => -width,
    };
    let class = attribute(element, "class").unwrap_or_default().to_owned();
    let extent = if let Some(transform) = attribute(element, "transform") {
        // It runs upwards.
        let (x, y) = transform.strip_prefix("translate(")?.split(')').next()?.split_once(' ')?;
        let (x, y): (f64, f64) = (x.parse().ok()?, y.parse().ok()?);
        Extent([x - ASCENT * size, y - start - width, x + DESCENT * size, y - start])
    } else {
        let (x, y) = (number(element, "x")?, number(element, "y")?);
        Extent([x + start, y - ASCENT * size, x + start + width, y + DESCENT * size])
    };
    Some(Text { words, extent, class })
}

/// A line of class `series NAME`.
fn curve_of(element: &str) -> Option<Curve> {
    let class = attribute(element, "class")?.strip_prefix("series ")?;
    let dash = attribute(element, "stroke-dasharray").unwrap_or_default();
    let look = format!("{} {dash}", attribute(element, "stroke")?);
    let point = |point: &str| {
        let (x, y) = point.split_once(',')?;
        Some([x.parse().ok()?, y.parse().ok()?])
    };
    let points = attribute(element, "points")?.split(' ').filter_map(point).collect();
    Some(Curve { class: class.to_owned(), look, points })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg::{Anchor, Colour, Dash, Svg};

    fn sheet(draw: impl FnOnce(&mut Svg)) -> Vec<String> {
        let mut svg = Svg::new(200.0, 100.0, "a < b");
        draw(&mut svg);
        faults(&svg.finish())
    }

    #[test]
    fn texts_beyond_the_sheet_and_on_each_other_are_faults() {
        let text = |place, anchor, words: &'static str| {
            move |svg: &mut Svg| svg.text(place, 10.0, anchor, Colour::BLACK, words)
        };
        assert_eq!(sheet(text([10.0, 20.0], Anchor::Start, "short")), Vec::<String>::new());
        for (place, anchor) in [
            ([150.0, 20.0], Anchor::Start),
            ([20.0, 20.0], Anchor::End),
            ([190.0, 20.0], Anchor::Middle),
            ([10.0, 4.0], Anchor::Start),
            ([10.0, 99.0], Anchor::Start),
        ] {
            let found = sheet(text(place, anchor, "some words <"));
            assert_eq!(found, ["`some words <` runs off the sheet"], "{place:?}");
        }
        let two = |y: f64| {
            sheet(|svg| {
                svg.text([10.0, 20.0], 10.0, Anchor::Start, Colour::BLACK, "elastic");
                svg.text([40.0, y], 10.0, Anchor::Start, Colour::BLACK, "harmonic");
            })
        };
        assert_eq!((two(24.0), two(32.0)), (vec!["`elastic` and `harmonic` overlap".to_owned()], vec![]));
        let upwards = sheet(|svg| svg.text_upwards([20.0, 20.0], 10.0, Colour::BLACK, "a long name"));
        assert_eq!(upwards, ["`a long name` runs off the sheet"]);
        assert_eq!(
            sheet(|svg| svg.text_upwards([20.0, 50.0], 10.0, Colour::BLACK, "name")),
            Vec::<String>::new()
        );
    }

    #[test]
    fn an_axis_of_two_ticks_is_a_fault() {
        let ticks = |count: u32| {
            sheet(|svg| {
                for k in 0..count {
                    svg.tick([20.0 + 30.0 * f64::from(k), 50.0], 10.0, Anchor::Middle, "x", &k.to_string());
                }
            })
        };
        assert_eq!((ticks(2), ticks(3)), (vec!["axis x has 2 ticks".to_owned()], vec![]));
    }

    #[test]
    fn series_that_look_alike_and_texts_on_curves_are_faults() {
        let draw = |first: Colour, height: f64| {
            sheet(|svg| {
                svg.series(&[[0.0, 10.0], [200.0, 10.0]], "drag", first, 1.0, Dash::None);
                svg.series(&[[0.0, 90.0], [200.0, 90.0]], "lift", Colour::LINES[0], 1.0, Dash::None);
                svg.series(&[[0.0, 80.0], [20.0, 80.0]], "lift", Colour::LINES[0], 1.0, Dash::None);
                svg.text([50.0, height], 10.0, Anchor::Start, Colour::BLACK, "legend");
            })
        };
        assert_eq!(draw(Colour::LINES[1], 50.0), Vec::<String>::new());
        assert_eq!(draw(Colour::LINES[0], 50.0), ["lift and drag look alike"; 2]);
        assert_eq!(draw(Colour::LINES[1], 92.0), ["`legend` lies on the curve of lift"]);
    }

    #[test]
    fn a_line_that_passes_a_corner_does_not_cross() {
        let extent = Extent([10.0, 10.0, 20.0, 20.0]);
        assert!(extent.is_crossed([0.0, 0.0], [30.0, 30.0]) && extent.is_crossed([15.0, 0.0], [15.0, 30.0]));
        assert!(extent.is_crossed([14.0, 15.0], [16.0, 15.0]), "inside");
        assert!(!extent.is_crossed([0.0, 15.0], [9.0, 15.0]) && !extent.is_crossed([0.0, 20.0], [9.0, 30.0]));
        assert!(!extent.is_crossed([12.0, 0.0], [40.0, 15.0]));
    }
}
