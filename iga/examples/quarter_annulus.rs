//! A quarter of a ring: exact with a single element, and just as exact after each refinement.
//!
//! Run with `cargo run -p partita-iga --example quarter_annulus`.

use std::f64::consts::PI;

use partita_iga::{BasisValues, Derivatives, Side, Spline, build, project};

const INNER: f64 = 1.0;
const OUTER: f64 = 1.5;

/// Points and weights of the three-point Gauss rule on [0, 1].
const GAUSS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let ring = build::quarter_annulus(INNER, OUTER)?.elevate_degree(0, 1);
    let exact = PI / 4.0 * (OUTER * OUTER - INNER * INNER);

    println!("{:>8}  {:>14}  {:>12}  {:>12}", "elements", "control points", "radius error", "area error");
    for parts in [1, 2, 4, 8, 16] {
        let fine = ring.subdivide(0, parts)?.subdivide(1, 2 * parts)?;
        let (radius, area) = (radius_error(&fine), (area(&fine) - exact).abs());
        println!(
            "{:>8}  {:>14}  {radius:>12.1e}  {area:>12.1e}",
            fine.element_count(),
            fine.control_points().len()
        );
    }

    let (outer, _) = ring.side(Side::RIGHT);
    let projection = project::closest_point(&outer, &[2.0, 1.0]);
    println!("\nthe outer arc is {:.6} from (2, 1), at xi = {:.6}", projection.distance, projection.xi[0]);
    Ok(())
}

/// Largest deviation of the outer side from the circle.
fn radius_error(ring: &Spline<2>) -> f64 {
    let (outer, _) = ring.side(Side::RIGHT);
    let error = |xi: f64| {
        let [x, y] = outer.point(&[xi]);
        (x.hypot(y) - OUTER).abs()
    };
    (0..=1000).map(|i| error(f64::from(i) / 1000.0)).fold(0.0, f64::max)
}

/// Integral of the Jacobian over all elements: the loop that a solver writes, too.
fn area(ring: &Spline<2>) -> f64 {
    let mut basis = BasisValues::new(ring);
    let mut area = 0.0;
    for element in ring.elements() {
        for (s, weight_s) in GAUSS {
            for (t, weight_t) in GAUSS {
                ring.basis(&element.at([s, t]), Derivatives::First, &mut basis);
                let [a, b, _] = basis.first_of(ring.control_points());
                area += weight_s * weight_t * element.measure() * (a[0] * b[1] - a[1] * b[0]);
            }
        }
    }
    area
}
