//! `docs/reproduction.md` and its figures, made of the published numbers, ours, and a page of remarks.

mod sections;
mod tables;

use std::path::Path;

use super::case::Case;
use super::claims::{Judged, judge};
use super::counts::{Count, heat_maps};
use super::facts::Facts;
use super::published::Published;
use super::results;
use super::substitutes::{Substitute, of_scene};
use crate::report::File;
use crate::sensitivity;
use crate::task::{self, TaskError};

const FILE: &str = "docs/reproduction.md";
const REMARKS: &str = "paper/remarks.md";

/// Everything the page says.
pub(crate) struct Page {
    published: Published,
    ours: [Facts; 2],
    judged: Vec<Judged>,
    /// Of both scenes.
    substitutes: [Vec<Substitute>; 2],
    /// The section on the sensitivity set.
    sensitivity: String,
    remarks: String,
}

impl Page {
    /// The page of the results in the repository.
    pub(crate) fn read(root: &Path) -> Result<Self, TaskError> {
        Self::new(root, Published::read(root)?, results::read(root)?)
    }

    /// The page of these results.
    pub(crate) fn new(root: &Path, published: Published, ours: [Facts; 2]) -> Result<Self, TaskError> {
        let mut substitutes = [Vec::new(), Vec::new()];
        for (case, substitutes) in Case::ALL.into_iter().zip(&mut substitutes) {
            *substitutes = of_scene(&task::read(&root.join("scenes").join(case.scene()).join("scene.toml"))?);
        }
        let judged = judge(&ours);
        let (sensitivity, remarks) = (sensitivity::section(root)?, task::read(&root.join(REMARKS))?);
        Ok(Self { published, ours, judged, substitutes, sensitivity, remarks })
    }

    /// The page, each of its figures, and the verdict on each claim.
    pub(crate) fn files(&self) -> Vec<File> {
        let mut files = vec![(FILE.to_owned(), self.text())];
        for (facts, published) in self.ours.iter().zip(&self.published.facts) {
            for count in [Count::Coupling, Count::Newton] {
                let title = format!("{}: {}", facts.case.scene(), count.title());
                let panels = [("published", &published.grid), ("ours", &facts.grid)];
                let path = format!("docs/{}", heat_map_path(facts.case, count));
                files.push((path, heat_maps(&title, panels, count)));
            }
        }
        files.push((results::path("claims.csv"), results::claims_table(&self.judged).to_text()));
        files
    }

    /// The page.
    pub(crate) fn text(&self) -> String {
        let mut text = format!("{INTRODUCTION}\n## In short\n\n{}", self.summary());
        for facts in &self.ours {
            text += &tables::grid_section(facts, &self.published);
        }
        text += &tables::adaptive_section(&self.ours, &self.published);
        text += &sections::claims(&self.judged);
        text += &self.sensitivity;
        text += &sections::cost(&self.ours);
        text += &sections::snapshots();
        text += &sections::substituted(&self.substitutes);
        text + "\n" + &self.remarks
    }

    /// How near the counts come and which claims hold.
    pub(crate) fn summary(&self) -> String {
        tables::distribution(&self.ours, &self.published) + "\n" + &sections::held(&self.judged)
    }
}

/// Where a heat map stands, seen from the page.
fn heat_map_path(case: Case, count: Count) -> String {
    let name = match count {
        Count::Coupling => "coupling",
        Count::Newton => "newton",
        Count::Fluid => "newton-fluid",
        Count::Structure => "newton-structure",
    };
    format!("figures/{}-{name}.svg", case.scene())
}

const INTRODUCTION: &str = "\
# The paper's tables, repeated

<!-- Written by `cargo xtask reproduce` from paper/published, paper/results and paper/remarks.md. Do not edit. -->

Spenke, Hosters and Behr (*The performance impact of Newton iterations per solver call in partitioned fluid-structure
interaction*, Coupled Problems 2021, arXiv 2106.15930) count the iterations of two coupled cases for different limits
N^f and N^s of Newton iterations per solver call. This page holds their counts beside ours.

**The cases here are substitutes.** The paper gives geometry, material and inflow in figures that are not part of its
text; ours are inferred, as the section *What is substituted* lists. Equal counts can therefore not be expected, similar
ones and the same conclusions can.
";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::workspace_root;

    /// The page were our numbers the published ones.
    fn perfect() -> Page {
        let root = workspace_root();
        let facts = Published::read(root).expect("the files are there").facts;
        Page::new(root, Published::read(root).expect("the files are there"), facts)
            .expect("the scenes are there")
    }

    #[test]
    fn the_published_numbers_would_be_reproduced_exactly() {
        let summary = perfect().summary();
        assert!(summary.contains("| 1 | coupling iterations | 36 | 36 | 36 | 36 |"), "{summary}");
        assert!(summary.contains("9 of 10 claims hold, 0 fail, 1 not known."), "{summary}");
    }

    #[test]
    fn the_page_holds_all_counts_and_links_every_figure() {
        let page = perfect();
        let files = page.files();
        let text = &files[0].1;
        let figures: Vec<&str> =
            files.iter().filter(|(_, text)| text.contains("<svg")).map(|(path, _)| path.as_str()).collect();
        assert_eq!(figures.len(), 4);
        for path in figures {
            let link = path.strip_prefix("docs/").expect("figures stand beside the page");
            assert!(text.contains(&format!("({link})")), "{link}");
        }
        for count in ["617 / 617", "2547 / 2547", "1083 / 1083", "945 / 945", "swapped"] {
            assert!(text.contains(count), "{count}");
        }
    }
}
