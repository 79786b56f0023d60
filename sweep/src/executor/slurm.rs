//! Job arrays of Slurm: one task for each run that has no result yet.
//!
//! Slurm decides when and where a task runs; what a task does is `partita sweep run --index`. Which runs have ended is read from
//! the folder alone, never from Slurm's accounting, so that a task that was killed, or never started, is simply missing.

mod script;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use partita::watch::Watcher;

use super::{Executed, Executor, missing};
use crate::error::SweepError;
use crate::folder::{Folder, SLURM, refused};
use crate::sweep::{Run, Sweep};
use script::Script;

/// Submits job arrays.
#[derive(Debug, Clone)]
pub struct Slurm {
    /// The program `partita`, as tasks find it.
    pub program: PathBuf,
    /// Most tasks of an array; where nothing is said, as many as Slurm takes.
    pub array_size: Option<usize>,
    /// Lines of options for `sbatch`, such as `--time=1:00:00`.
    pub options: Vec<String>,
}

/// `MaxArraySize` of a Slurm that does not say otherwise.
const DEFAULT_ARRAY_SIZE: usize = 1001;

impl Slurm {
    /// The scripts that would be submitted now; nothing is written.
    ///
    /// # Errors
    /// When the folder is another sweep's.
    pub fn dry_run(&self, sweep: &Sweep, dir: &Path) -> Result<Vec<String>, SweepError> {
        let runs = match Folder::look(dir, sweep) {
            Ok(folder) => missing(&folder, sweep.runs()),
            Err(SweepError::Nothing { .. }) => sweep.runs().iter().collect(),
            Err(error) => return Err(error),
        };
        self.scripts(sweep, dir, &runs)
    }

    /// The scripts of these runs, in the order in which they are submitted.
    fn scripts(&self, sweep: &Sweep, dir: &Path, runs: &[&Run]) -> Result<Vec<String>, SweepError> {
        let absolute = |path: &Path| std::path::absolute(path).map_err(refused(path));
        let (file, dir) = (absolute(sweep.file())?, absolute(dir)?);
        let size = self.array_size.or_else(max_array_size).unwrap_or(DEFAULT_ARRAY_SIZE).max(1);
        let first = 1 + last_array(&dir);
        let chunks = runs.chunks(size).zip(first..);
        let script = |(runs, number)| {
            let name = sweep.name();
            Script {
                program: &self.program,
                file: &file,
                dir: &dir,
                name,
                number,
                options: &self.options,
                runs,
            }
        };
        Ok(chunks.map(script).map(|script| script.text()).collect())
    }
}

impl Executor for Slurm {
    /// Other jobs may share the machine.
    fn measures_time(&self) -> bool {
        false
    }

    fn execute(
        &mut self,
        sweep: &Sweep,
        folder: &Folder,
        runs: &[&Run],
        watcher: &mut dyn Watcher,
    ) -> Result<Executed, SweepError> {
        let slurm = folder.dir().join(SLURM);
        fs::create_dir_all(&slurm).map_err(refused(&slurm))?;
        let first = 1 + last_array(folder.dir());
        let mut executed = Executed::default();
        for (number, text) in (first..).zip(self.scripts(sweep, folder.dir(), runs)?) {
            let name = format!("{SLURM}/{}", script::file_name(number));
            folder.put(&name, &text)?;
            let job = submit(folder.dir(), &name).map_err(|what| SweepError::Slurm {
                command: format!("sbatch {name}"),
                what,
                submitted: executed.submitted.iter().map(|(job, _)| job.clone()).collect(),
            })?;
            let tasks = script::tasks(&text);
            watcher.finishes(&format!("job {job}: {tasks} runs, {name}"));
            executed.submitted.push((job, tasks));
        }
        Ok(executed)
    }
}

/// Submits a script from the folder of the sweep; returns the job's number.
fn submit(dir: &Path, script: &str) -> Result<String, String> {
    let mut sbatch = Command::new("sbatch");
    let output = sbatch.arg("--parsable").arg(script).current_dir(dir).output();
    let output = output.map_err(|error| error.to_string())?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).split_whitespace().collect::<Vec<_>>().join(" "));
    }
    // Behind a semicolon stands the name of a cluster.
    let said = String::from_utf8_lossy(&output.stdout);
    Ok(said.trim().split(';').next().unwrap_or_default().to_owned())
}

/// What this Slurm allows.
fn max_array_size() -> Option<usize> {
    let output = Command::new("scontrol").args(["show", "config"]).output().ok()?;
    array_size_in(&String::from_utf8_lossy(&output.stdout))
}

/// Indices of tasks are below `MaxArraySize` and begin at 0.
fn array_size_in(config: &str) -> Option<usize> {
    let value = config.lines().find_map(|line| line.trim().strip_prefix("MaxArraySize"))?;
    value.trim_start().strip_prefix('=')?.trim().parse().ok()
}

/// The highest number of an array that was submitted from this folder, 0 if there was none.
fn last_array(dir: &Path) -> usize {
    let Ok(entries) = fs::read_dir(dir.join(SLURM)) else { return 0 };
    let numbers = entries.flatten().filter_map(|entry| script::number_in(entry.file_name().to_str()?));
    numbers.max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::array_size_in;

    #[test]
    fn the_size_of_arrays_is_read_from_the_configuration() {
        let config =
            "Configuration data as of 2026-01-01\nMaxArraySize            = 8\nMaxJobCount = 10000\n";
        assert_eq!(array_size_in(config), Some(8));
        assert_eq!(array_size_in("MaxJobCount = 10000\n"), None);
    }
}
