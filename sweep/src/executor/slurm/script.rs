//! The batch script of a job array.

use std::fmt::Write as _;
use std::path::Path;

use crate::folder::SLURM;
use crate::sweep::Run;

/// What an array does.
pub(super) struct Script<'a> {
    pub(super) program: &'a Path,
    pub(super) file: &'a Path,
    pub(super) dir: &'a Path,
    /// Of the sweep.
    pub(super) name: &'a str,
    /// Which array of this folder it is.
    pub(super) number: usize,
    /// Lines of options.
    pub(super) options: &'a [String],
    pub(super) runs: &'a [&'a Run],
}

/// The name of a script below the folder of job arrays.
pub(super) fn file_name(number: usize) -> String {
    format!("array-{number}.sh")
}

/// The number in the name of a script.
pub(super) fn number_in(name: &str) -> Option<usize> {
    name.strip_prefix("array-")?.strip_suffix(".sh")?.parse().ok()
}

/// How many tasks a script has.
pub(super) fn tasks(text: &str) -> usize {
    let table = text.lines().find_map(|line| line.strip_prefix("runs=("));
    table.map_or(0, |table| table.trim_end_matches(')').split_whitespace().count())
}

impl Script<'_> {
    /// The text. Options of the user come first: those that the array cannot do without have the last word.
    pub(super) fn text(&self) -> String {
        let Self { program, file, dir, name, number, options, runs } = self;
        let mut text = "#!/bin/bash\n".to_owned();
        let mut option = |line: &str| writeln!(text, "#SBATCH {line}").expect("a String takes any text");
        let name: String = name.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
        option(&format!("--job-name={name}"));
        options.iter().for_each(|line| option(line));
        option(&format!("--array=0-{}", runs.len() - 1));
        option(&format!("--output={SLURM}/array-{number}.%a.log"));
        option("--open-mode=append");
        let list = |of: &dyn Fn(&Run) -> String| runs.iter().map(|run| of(run)).collect::<Vec<_>>().join(" ");
        write!(
            text,
            "\n# The run of each task, and the fingerprint that it had when this was submitted.\n\
             runs=({})\n\
             fingerprints=({})\n\n\
             exec {} sweep run {} --out {} \\\n    \
             --index \"${{runs[SLURM_ARRAY_TASK_ID]}}\" --fingerprint \"${{fingerprints[SLURM_ARRAY_TASK_ID]}}\"\n",
            list(&|run| run.index.to_string()),
            list(&|run| run.fingerprint.clone()),
            quoted(program),
            quoted(file),
            quoted(dir),
        )
        .expect("a String takes any text");
        text
    }
}

/// A path as one word of the shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(index: usize) -> Run {
        Run { index, labels: Vec::new(), overrides: Vec::new(), fingerprint: format!("{index:016x}") }
    }

    #[test]
    fn a_script_maps_tasks_to_runs_and_quotes_paths() {
        let (first, second) = (run(3), run(17));
        let script = Script {
            program: "bin/partita".as_ref(),
            file: "it's here/tank.toml".as_ref(),
            dir: "out".as_ref(),
            name: "tank 1",
            number: 2,
            options: &["--time=1".to_owned(), "--mem 4G --exclusive".to_owned()],
            runs: &[&first, &second],
        };
        let text = script.text();
        assert_eq!(
            text,
            "#!/bin/bash\n\
             #SBATCH --job-name=tank-1\n\
             #SBATCH --time=1\n\
             #SBATCH --mem 4G --exclusive\n\
             #SBATCH --array=0-1\n\
             #SBATCH --output=slurm/array-2.%a.log\n\
             #SBATCH --open-mode=append\n\
             \n\
             # The run of each task, and the fingerprint that it had when this was submitted.\n\
             runs=(3 17)\n\
             fingerprints=(0000000000000003 0000000000000011)\n\
             \n\
             exec 'bin/partita' sweep run 'it'\\''s here/tank.toml' --out 'out' \\\n    \
             --index \"${runs[SLURM_ARRAY_TASK_ID]}\" --fingerprint \"${fingerprints[SLURM_ARRAY_TASK_ID]}\"\n"
        );
        assert_eq!(tasks(&text), 2);
        assert_eq!((number_in(&file_name(12)), number_in("array-2.0.log")), (Some(12), None));
    }
}
