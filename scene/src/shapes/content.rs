//! What a mesh file holds beside the mesh that was made of it, and the choice of its surfaces.

use partita_mesh::gmsh::{ConvertError, GmshFile, PhysicalGroup};

use crate::check::Check;
use crate::finding::Finding;
use crate::schema::{FileName, Groups};
use crate::spelling::nearest;

/// The physical groups of a file, and what became of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Content {
    /// The file's name.
    pub file: String,
    /// Every group of the file, by dimension and number.
    pub groups: Vec<(PhysicalGroup, Role)>,
    /// Whether all cells ran clockwise, and were turned.
    pub turned: bool,
}

/// What a physical group is for the mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Its cells are in the mesh, or it is a boundary group.
    Used,
    /// A curve between two cells of the mesh.
    Inside,
    /// A surface that was not chosen, or a curve away from those that were.
    LeftOut,
    /// Points and volumes, of which a plane mesh has no use.
    Unused,
}

/// What to choose from, in one word for each dimension.
const KINDS: [&str; 4] = ["point", "curve", "surface", "volume"];

impl Content {
    /// The groups of `file`, none but the chosen surfaces used so far.
    pub(super) fn new(name: &FileName, file: &GmshFile, surfaces: Option<&Groups>) -> Self {
        let is_chosen = |group: &PhysicalGroup| {
            group.elements > 0 && surfaces.is_none_or(|chosen| chosen.names().contains(&group.name))
        };
        let role = |group: &PhysicalGroup| match group.dimension {
            2 if is_chosen(group) => Role::Used,
            1 | 2 => Role::LeftOut,
            _ => Role::Unused,
        };
        let groups = file.groups().into_iter().map(|group| {
            let role = role(&group);
            (group, role)
        });
        Self { file: name.to_string(), groups: groups.collect(), turned: false }
    }

    /// Marks the curves that touch the part of the file that was chosen.
    pub(super) fn touching(&mut self, part: &GmshFile) {
        let touching = part.groups();
        self.curves(|curve| {
            let is_same = |group: &PhysicalGroup| {
                (group.dimension, &group.name) == (1, &curve.name) && group.elements > 0
            };
            touching.iter().any(is_same).then_some(Role::Inside)
        });
    }

    /// Marks the curves that bound the mesh.
    pub(super) fn bounds(&mut self, names: &[&str]) {
        self.curves(|curve| names.contains(&&*curve.name).then_some(Role::Used));
    }

    fn curves(&mut self, new_role: impl Fn(&PhysicalGroup) -> Option<Role>) {
        for (group, role) in self.groups.iter_mut().filter(|(group, _)| group.dimension == 1) {
            *role = new_role(group).unwrap_or(*role);
        }
    }

    /// What is wrong with naming `name` as a part of the boundary, if the file has such a group but the mesh, which has
    /// `groups`, does not.
    pub(crate) fn elsewhere(&self, name: &str, groups: &[&str]) -> Option<Finding> {
        let (group, role) = self.groups.iter().find(|(group, _)| group.name == name)?;
        let what = match (group.dimension, role) {
            (1, Role::Inside) => format!("the curve `{name}` lies inside the mesh, not on its boundary"),
            (1, Role::LeftOut) => format!("the curve `{name}` does not touch the chosen surfaces"),
            (1, _) => return None,
            (dimension, _) => {
                format!("`{name}` is a {} of {}, no part of the boundary", KINDS[dimension.min(3)], self.file)
            }
        };
        Some(Finding::new(what).hint(format!("groups on the boundary: {}", groups.join(", "))))
    }
}

/// The part of `file` in the chosen surfaces, or what is wrong with the choice; `table` is that of the mesh in the scene.
pub(super) fn choose(
    file: GmshFile,
    surfaces: Option<&Groups>,
    name: &FileName,
    check: &Check<'_>,
    table: [&str; 3],
) -> Result<GmshFile, Finding> {
    let groups = file.groups();
    let chosen = surfaces.map_or(&[][..], Groups::names);
    let place = check.value(&[table[0], table[1], table[2], "surfaces"]);
    file.part(2, chosen).map_err(|error| match error {
        ConvertError::SeveralRegions { groups, .. } => {
            Finding::new(format!("{name} has {} physical surfaces: {}", groups.len(), list(&groups)))
                .hint(format!("say which of them are the {}: {}", table[0], example(&groups, table)))
        }
        ConvertError::Unassigned { cells, groups, .. } => Finding::new(format!(
            "{cells} cells of {name} belong to no physical surface, the others to {}",
            list(&groups)
        ))
        .hint(format!(
            "leave those cells out with {}, or put them into a physical surface, too",
            example(&groups, table)
        )),
        ConvertError::UnknownRegion { name: wanted, groups: known, .. } => {
            unknown(&wanted, name, &groups, &known).mark_if(place, "no such surface")
        }
        other => Finding::of(&other).led_by(&format!("{name}: ")),
    })
}

/// A choice as a line of the scene.
fn example(groups: &[String], table: [&str; 3]) -> String {
    let first = groups.first().map_or("", String::as_str);
    format!("`surfaces = \"{first}\"` or `surfaces = [...]` under `[{}]`", table.join("."))
}

fn unknown(wanted: &str, file: &FileName, groups: &[PhysicalGroup], known: &[String]) -> Finding {
    let choice = if known.is_empty() {
        "the file has no physical surfaces: leave out `surfaces`, and all its cells are taken".to_owned()
    } else {
        format!("physical surfaces of the file: {}", list(known))
    };
    match groups.iter().find(|group| group.name == wanted) {
        Some(group) if group.dimension == 2 => {
            Finding::new(format!("surface `{wanted}` of {file} has no cells"))
                .hint(format!("it is only named: mesh it and save it with the others; {choice}"))
        }
        Some(group) => Finding::new(format!(
            "`{wanted}` is a {} of {file}, not a surface",
            KINDS[group.dimension.min(3)]
        ))
        .hint(choice),
        None => Finding::new(format!("{file} has no physical surface `{wanted}`")).hint(
            match nearest(wanted, known.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => choice,
            },
        ),
    }
}

fn list(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
