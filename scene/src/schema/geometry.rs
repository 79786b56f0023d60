//! `[structure.geometry.*]`: where the structure is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::file::FileName;
use super::fluid::{one, origin};
use super::groups::Groups;
use super::numbers::{Count, Positive, Real};

/// `[structure.geometry.*]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Geometry {
    /// A rectangle along the axes.
    Rectangle(RectanglePatch),
    /// A curved beam: the sector of a ring. Its first parameter runs along the arc, its second to the left of it. With a
    /// sweep of 360 or -360 degrees it is a whole ring: `left` and `right` are joined, the displacement is continuous there
    /// (though not smooth), and neither is a side of its boundary.
    Arc(ArcPatch),
    /// A strip of constant thickness along a smooth curve through points. A curve that ends where it begins closes smoothly;
    /// `left` and `right` are then joined as in a whole ring.
    Curve(CurvePatch),
    /// A patch from a spline file (see the README of `partita-iga`). Its parameters in a scene run from 0 to 1, whatever
    /// its knots are. Opposite sides with the same control points, and weights in the same ratios, are joined as in a whole
    /// ring; the control points of a side that is a single point move as one.
    Spline(SplineFile),
    /// Triangles or quadrilaterals of first or second order from a file of gmsh, instead of a spline; its physical curves are
    /// the groups that `clamped` and `wetted` name.
    Gmsh(SolidMesh),
}

impl Geometry {
    /// Names that every patch has for its sides; none for a mesh, whose file names its groups.
    pub(crate) fn sides(&self) -> Option<[&'static str; 4]> {
        match self {
            Self::Rectangle(_) | Self::Arc(_) | Self::Curve(_) | Self::Spline(_) => {
                Some(["left", "right", "bottom", "top"])
            }
            Self::Gmsh(_) => None,
        }
    }
}

/// `[structure.geometry.rectangle]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RectanglePatch {
    /// Lower left corner \[m\]. Default: `[0, 0]`.
    #[serde(default = "origin")]
    pub origin: [Real; 2],
    /// Width and height \[m\].
    pub size: [Positive; 2],
    /// Spline elements along each side.
    pub elements: [Count; 2],
    /// Spline degree along each side, each from 1 to 9. Default: `[2, 2]`.
    #[serde(default)]
    pub degree: [Degree; 2],
}

/// `[structure.geometry.arc]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ArcPatch {
    /// Centre of the circle \[m\]. Default: `[0, 0]`.
    #[serde(default = "origin")]
    pub center: [Real; 2],
    /// Inner and outer radius \[m\].
    pub radii: [Positive; 2],
    /// Angle from the x axis at which the arc starts \[degrees\].
    pub start: Real,
    /// Angle through which it runs \[degrees\], from -360 to 360, counter-clockwise where positive. Clockwise, `bottom` is
    /// the inner arc.
    pub sweep: Real,
    /// Spline elements along the arc and across.
    pub elements: [Count; 2],
    /// Spline degree along the arc, at least 2, and across. Default: `[2, 2]`.
    #[serde(default)]
    pub degree: [Degree; 2],
}

/// `[structure.geometry.curve]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurvePatch {
    /// Points that the curve passes in this order \[m\], more than its degree along. For a closed curve the last point is
    /// the first again.
    pub points: Vec<[Real; 2]>,
    /// Thickness of the strip \[m\].
    pub thickness: Positive,
    /// Which line of the strip the curve is: `"middle"` (default), `"bottom"` or `"top"`.
    #[serde(default)]
    pub alignment: Alignment,
    /// Spline elements along the curve, at least as many as points less degree (of a closed curve, as points), and across.
    pub elements: [Count; 2],
    /// Spline degree along the curve and across. Default: `[2, 2]`.
    #[serde(default)]
    pub degree: [Degree; 2],
}

/// `structure.geometry.curve.alignment`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Alignment {
    /// The right side, seen along the curve.
    Bottom,
    /// Halfway between the sides.
    #[default]
    Middle,
    /// The left side, seen along the curve.
    Top,
}

/// `[structure.geometry.spline]`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SplineFile {
    /// Spline file, relative to the scene's folder.
    pub file: FileName,
    /// Spline degree along each side, that of the file or higher. Default: that of the file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub degree: Option<[Degree; 2]>,
    /// Elements into which every spline element of the file is cut, along each side. Default: `[1, 1]`.
    #[serde(default = "whole")]
    pub subdivisions: [Count; 2],
}

fn whole() -> [Count; 2] {
    [Count::literal(1); 2]
}

/// `[structure.geometry.gmsh]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolidMesh {
    /// File of format 2.0 to 2.2 or 4.1, text or binary, relative to the scene's folder; it may be that of the fluid.
    pub file: FileName,
    /// Names of the physical surfaces that are the structure, one or a list; must be given where the file has several.
    /// Default: the whole mesh.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<Groups>,
    /// Factor on the file's coordinates: 0.001 for a mesh in millimetres. Default: 1.
    #[serde(default = "one")]
    pub scale: Positive,
}

/// The degree of a spline, 1 to 9.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "i64", into = "usize")]
pub struct Degree(usize);

impl Degree {
    /// The plain number.
    #[must_use]
    pub const fn get(self) -> usize {
        self.0
    }
}

impl Default for Degree {
    fn default() -> Self {
        Self(2)
    }
}

impl TryFrom<i64> for Degree {
    type Error = String;
    fn try_from(value: i64) -> Result<Self, String> {
        usize::try_from(value)
            .ok()
            .filter(|degree| (1..=9).contains(degree))
            .map(Self)
            .ok_or_else(|| format!("{value} is not a spline degree, from 1 to 9"))
    }
}

impl From<Degree> for usize {
    fn from(degree: Degree) -> Self {
        degree.0
    }
}
