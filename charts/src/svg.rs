//! The little of SVG that our figures need.

use std::fmt::Write as _;

/// A drawing under construction; lengths are pixels, the origin is the upper left corner.
#[derive(Debug)]
pub struct Svg {
    width: f64,
    height: f64,
    title: String,
    body: String,
}

/// Where a text stands relative to its place.
#[derive(Debug, Clone, Copy)]
pub enum Anchor {
    /// It starts there.
    Start,
    /// Its middle is there.
    Middle,
    /// It ends there.
    End,
}

/// How a line is broken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Not at all.
    None,
    /// Long dashes.
    Long,
    /// Dots.
    Dots,
}

impl Svg {
    /// A white sheet; `title` is read out where the drawing is not seen.
    #[must_use]
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        Self { width, height, title: escaped(title), body: String::new() }
    }

    /// A rectangle of one colour; `corner` is its upper left one.
    pub fn rectangle(&mut self, corner: [f64; 2], size: [f64; 2], fill: Colour) {
        let ([x, y], [width, height]) = (corner, size);
        self.line(&format!(
            r#"<rect x="{x:.2}" y="{y:.2}" width="{width:.2}" height="{height:.2}" fill="{}"/>"#,
            fill.hex()
        ));
    }

    /// A polygon of one colour. Its edge has that colour too: a hairline of the sheet would shine through between
    /// neighbours.
    pub fn polygon(&mut self, points: &[[f64; 2]], fill: Colour) {
        let fill = fill.hex();
        self.line(&format!(r#"<polygon points="{}" fill="{fill}" stroke="{fill}"/>"#, joined(points)));
    }

    /// The edges of a polygon.
    pub fn outline(&mut self, points: &[[f64; 2]], stroke: Colour, width: f64) {
        self.line(&format!(
            r#"<polygon points="{}" fill="none" stroke="{}" stroke-width="{width}"/>"#,
            joined(points),
            stroke.hex()
        ));
    }

    /// A line of text on a baseline.
    pub fn text(&mut self, place: [f64; 2], size: f64, anchor: Anchor, fill: Colour, text: &str) {
        self.text_of_class(place, size, anchor, fill, "", text);
    }

    fn text_of_class(
        &mut self,
        place: [f64; 2],
        size: f64,
        anchor: Anchor,
        fill: Colour,
        class: &str,
        text: &str,
    ) {
        let [x, y] = place;
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.line(&format!(
            r#"<text{class} x="{x:.2}" y="{y:.2}" font-size="{size}" text-anchor="{anchor}" fill="{}">{}</text>"#,
            fill.hex(),
            escaped(text)
        ));
    }

    /// The label of a tick; those of one axis share its name.
    pub fn tick(&mut self, place: [f64; 2], size: f64, anchor: Anchor, axis: &str, text: &str) {
        let class = format!(r#" class="tick {}""#, escaped(axis));
        self.text_of_class(place, size, anchor, Colour::BLACK, &class, text);
    }

    /// A line of text that runs upwards through its place, its middle there.
    pub fn text_upwards(&mut self, place: [f64; 2], size: f64, fill: Colour, text: &str) {
        let [x, y] = place;
        self.line(&format!(
            r#"<text transform="translate({x:.2} {y:.2}) rotate(-90)" font-size="{size}" text-anchor="middle" fill="{}">{}</text>"#,
            fill.hex(),
            escaped(text)
        ));
    }

    /// Straight lines through points.
    pub fn path(&mut self, points: &[[f64; 2]], stroke: Colour, width: f64, dash: Dash) {
        self.polyline(points, "", stroke, width, dash);
    }

    /// The curve of a series. Whoever draws one series in parts, or a sample of it in a legend, names it alike.
    pub fn series(&mut self, points: &[[f64; 2]], name: &str, stroke: Colour, width: f64, dash: Dash) {
        self.polyline(points, &format!(r#" class="series {}""#, escaped(name)), stroke, width, dash);
    }

    fn polyline(&mut self, points: &[[f64; 2]], class: &str, stroke: Colour, width: f64, dash: Dash) {
        let dash = match dash {
            Dash::None => "",
            Dash::Long => r#" stroke-dasharray="6 4""#,
            Dash::Dots => r#" stroke-dasharray="1.5 3""#,
        };
        self.line(&format!(
            r#"<polyline{class} points="{}" fill="none" stroke="{}" stroke-width="{width}"{dash}/>"#,
            joined(points),
            stroke.hex()
        ));
    }

    /// A ring, or a disc where `fill` is the colour of its edge.
    pub fn circle(
        &mut self,
        centre: [f64; 2],
        radius: f64,
        fill: Option<Colour>,
        stroke: Colour,
        width: f64,
    ) {
        let [x, y] = centre;
        let fill = fill.map_or_else(|| "none".to_owned(), Colour::hex);
        self.line(&format!(
            r#"<circle cx="{x:.2}" cy="{y:.2}" r="{radius}" fill="{fill}" stroke="{}" stroke-width="{width}"/>"#,
            stroke.hex()
        ));
    }

    /// A bar of the colours, the first below, with labels at parts of its height.
    pub fn colour_bar(&mut self, corner: [f64; 2], size: [f64; 2], labels: &[(f64, String)]) {
        const STRIPES: usize = 40;
        let ([x, y], [width, height]) = (corner, size);
        for stripe in 0..STRIPES {
            let part = stripe as f64 / STRIPES as f64;
            let top = y + height * (1.0 - part - 1.0 / STRIPES as f64);
            self.rectangle([x, top], [width, height / STRIPES as f64 + 0.5], Colour::on_scale(part));
        }
        for (part, label) in labels {
            let tick = y + height * (1.0 - part);
            self.path(&[[x + width, tick], [x + width + 3.0, tick]], Colour::GREY, 1.0, Dash::None);
            self.tick([x + width + 6.0, tick + 4.0], 11.0, Anchor::Start, "colour", label);
        }
    }

    fn line(&mut self, element: &str) {
        writeln!(self.body, "{element}").expect("a String takes any text");
    }

    /// The file's text.
    #[must_use]
    pub fn finish(self) -> String {
        let Self { width, height, title, body } = self;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
             height=\"{height:.0}\" font-family=\"sans-serif\" stroke-width=\"0.3\">\n<title>{title}</title>\n\
             <rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"#ffffff\"/>\n{body}</svg>\n"
        )
    }
}

fn joined(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Red, green and blue, 0 to 255.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Colour([f64; 3]);

impl Colour {
    /// Black.
    pub const BLACK: Self = Self([0.0; 3]);
    /// White.
    pub const WHITE: Self = Self([255.0; 3]);
    /// For what stands behind.
    pub const GREY: Self = Self([120.0; 3]);
    /// A colour that the scale does not have.
    pub const STEEL: Self = Self([205.0, 92.0, 60.0]);

    /// Light grey, for the lines of a grid.
    pub const PALE: Self = Self([224.0; 3]);
    /// Nearly white, for what lies behind a grid.
    pub const MIST: Self = Self([240.0; 3]);
    /// Colours that colour-blind readers tell apart (Okabe and Ito 2008; the last one is ours, their yellow being too pale
    /// for a line on white).
    pub const LINES: [Self; 8] = [
        Self([0.0, 114.0, 178.0]),
        Self([213.0, 94.0, 0.0]),
        Self([0.0, 158.0, 115.0]),
        Self([204.0, 121.0, 167.0]),
        Self([230.0, 159.0, 0.0]),
        Self([86.0, 180.0, 233.0]),
        Self([0.0, 0.0, 0.0]),
        Self([124.0, 72.0, 20.0]),
    ];

    /// Dark blue at 0 over green to yellow at 1; rising in brightness, so that it survives a copier.
    #[must_use]
    pub fn on_scale(part: f64) -> Self {
        const STOPS: [[f64; 3]; 5] = [
            [62.0, 20.0, 90.0],
            [57.0, 86.0, 140.0],
            [32.0, 146.0, 140.0],
            [98.0, 202.0, 96.0],
            [252.0, 230.0, 60.0],
        ];
        let place = part.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
        let below = (0..STOPS.len() - 1).rfind(|&stop| stop as f64 <= place).unwrap_or(0);
        let share = place - below as f64;
        let mut mixed = [0.0; 3];
        for channel in 0..3 {
            mixed[channel] = (1.0 - share) * STOPS[below][channel] + share * STOPS[below + 1][channel];
        }
        Self(mixed)
    }

    /// Black or white, whichever is read better on this.
    #[must_use]
    pub fn ink(self) -> Self {
        let [red, green, blue] = self.0;
        if 0.299 * red + 0.587 * green + 0.114 * blue > 140.0 { Self::BLACK } else { Self::WHITE }
    }

    fn hex(self) -> String {
        let [red, green, blue] = self.0;
        format!("#{red:02x}{green:02x}{blue:02x}", red = byte(red), green = byte(green), blue = byte(blue))
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is held between 0 and 255"
)]
fn byte(value: f64) -> u8 {
    value.round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_grows_brighter() {
        let brightness = |part: f64| Colour::on_scale(part).0.iter().sum::<f64>();
        assert!((0..20).all(|i| brightness(f64::from(i) / 20.0) < brightness(f64::from(i + 1) / 20.0)));
        assert_eq!(Colour::on_scale(-1.0).hex(), "#3e145a");
        assert_eq!(Colour::on_scale(2.0).hex(), "#fce63c");
        assert_eq!(
            (Colour::on_scale(0.0).ink(), Colour::on_scale(1.0).ink()),
            (Colour::WHITE, Colour::BLACK)
        );
    }

    #[test]
    fn no_two_colours_of_lines_are_near_each_other() {
        for (index, one) in Colour::LINES.iter().enumerate() {
            for other in &Colour::LINES[index + 1..] {
                let distance: f64 = one.0.iter().zip(other.0).map(|(a, b)| (a - b).powi(2)).sum();
                assert!(distance.sqrt() > 60.0, "{one:?} and {other:?}");
            }
        }
    }

    #[test]
    fn a_drawing_is_a_file() {
        let mut svg = Svg::new(10.0, 20.0, "a < b");
        svg.text([1.0, 2.0], 11.0, Anchor::Middle, Colour::BLACK, "x & y");
        insta::assert_snapshot!(svg.finish(), @r##"
        <svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 20" width="10" height="20" font-family="sans-serif" stroke-width="0.3">
        <title>a &lt; b</title>
        <rect width="10" height="20" fill="#ffffff"/>
        <text x="1.00" y="2.00" font-size="11" text-anchor="middle" fill="#000000">x &amp; y</text>
        </svg>
        "##);
    }
}
