//! The fluid's mesh.

use std::path::Path;

use partita_mesh::Mesh;
use partita_mesh::generate::{self, Diagonal};
use partita_mesh::refine;

use super::content::{self, Content};
use super::read::{self, Input};
use super::{FLUID_FILE, Shapes};
use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{Circle, Count, Diagonals, FluidMesh, GmshMesh, Positive, Real, RectangleMesh};

/// More would make millions of triangles of a single one.
const MOST_REFINEMENTS: usize = 10;

/// The mesh, or what is wrong with it.
pub(super) fn mesh(
    mesh: &FluidMesh,
    folder: &Path,
    shapes: &mut Shapes,
    check: &mut Check<'_>,
) -> Option<Mesh<2>> {
    let (made, place) = match mesh {
        FluidMesh::Rectangle(mesh) => (rectangle(mesh), &["fluid", "mesh", "rectangle"][..]),
        FluidMesh::Gmsh(mesh) => {
            (from_file(mesh, folder, shapes, check), &["fluid", "mesh", "gmsh", "file"][..])
        }
    };
    made.map_err(|finding| check.add(finding.mark_unless(check.value(place), "this mesh"))).ok()
}

fn rectangle(mesh: &RectangleMesh) -> Result<Mesh<2>, Finding> {
    let made = generate::rectangle(&generate::RectangleMesh {
        origin: mesh.origin.map(Real::get),
        size: mesh.size.map(Positive::get),
        divisions: mesh.divisions.map(Count::get),
        pattern: mesh.diagonals.into(),
    });
    made.map_err(|error| Finding::of(&error))
}

impl From<Diagonals> for Diagonal {
    fn from(diagonals: Diagonals) -> Self {
        match diagonals {
            Diagonals::Crossed => Self::Crossed,
            Diagonals::Right => Self::Right,
            Diagonals::Left => Self::Left,
            Diagonals::Alternating => Self::Alternating,
        }
    }
}

fn from_file(
    mesh: &GmshMesh,
    folder: &Path,
    shapes: &mut Shapes,
    check: &Check<'_>,
) -> Result<Mesh<2>, Finding> {
    let (file, bytes) = read::gmsh(&mesh.file, mesh.scale, folder)?;
    let mut content = Content::new(&mesh.file, &file, mesh.surfaces.as_ref());
    let table = ["fluid", "mesh", "gmsh"];
    let part = content::choose(file, mesh.surfaces.as_ref(), &mesh.file, check, table)?;
    content.turned = part.is_inverted(2);
    content.touching(&part);
    let mut made =
        part.into_mesh().map_err(|error| Finding::of(&error).led_by(&format!("{}: ", mesh.file)))?;
    content.bounds(&made.groups().iter().map(|group| &*group.name).collect::<Vec<_>>());
    shapes.fluid_file = Some(content);
    if mesh.refine > MOST_REFINEMENTS {
        return Err(Finding::new(format!(
            "refined {} times the mesh would not fit any machine",
            mesh.refine
        ))
        .hint("each time it has four times as many triangles: refine it once or twice"));
    }
    let circles: Vec<_> = mesh
        .circles
        .iter()
        .map(|(group, Circle { center, radius })| (group.as_str(), center.map(Real::get), radius.get()))
        .map(|(group, center, radius)| refine::Circle { group, center, radius })
        .collect();
    for _ in 0..mesh.refine {
        made = refine::refine(&made, &circles).map_err(|error| Finding::of(&error))?;
    }
    shapes.inputs.push(Input { name: FLUID_FILE, bytes });
    Ok(made)
}
