//! A cantilever under its own weight: small enough to be run again and again.

/// The scene.
pub const SCENE: &str = r#"title = "Cantilever"

[time]
step = 1.0
steps = 1

[structure]
density = 1000.0
body_force = [0.0, -2000.0]
clamped = ["left"]
time_scheme = "quasi_static"

[structure.geometry.rectangle]
size = [1.0, 0.1]
elements = [2, 1]

[structure.material.saint_venant_kirchhoff]
young_modulus = 1e6
poisson_ratio = 0.0

[structure.newton]
tolerance = { relative = 1e-10 }

[output.probes]
tip = { structure_displacement = [1.0, 0.5] }
"#;

/// A study of it that is sound, as if it stood beside `cantilever.toml`; tests break it in one place.
pub const STUDY: &str = r#"title = "Cantilever: elements and degree"
scene = "cantilever.toml"
wanted = 1e-4
refinements = [
    { name = "2 elements", set = [] },
    { name = "4 elements", set = ["structure.geometry.rectangle.elements=[4, 1]"] },
    { name = "8 elements", set = ["structure.geometry.rectangle.elements=[8, 1]"] },
]

[quantity]
name = "deflection of the tip"
column = "tip_displacement_y"
take = "last"

[reference]
set = ["structure.geometry.rectangle.elements=[16, 1]", "structure.geometry.rectangle.degree=[4, 2]"]

[[choice]]
name = "degree 2"

[[choice]]
name = "degree 3"
set = ["structure.geometry.rectangle.degree=[3, 2]"]
"#;
