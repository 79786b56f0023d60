//! The commands for many runs: `study`, `stability`, `sweep`.

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use partita::scene::file_kind::FileKind;
use partita_sweep::{Collected, Executed, Kind, Order, Slurm, State, Threads};
use serde_json::json;

use crate::args::{Collect, List, Make, Output, Stability, Study, Submit, Sweep, SweepFile};
use crate::failure::{FAILED_RUN, Failure};
use crate::progress::Progress;
use crate::{INTERRUPTED, STOP, print, stop_when_interrupted};

pub(crate) fn study(arguments: &Study) -> Result<ExitCode, Failure> {
    let mut sweep = partita_sweep::Sweep::load_as(FileKind::Study, &arguments.file)?;
    if let Kind::Study(study) = &mut sweep.kind {
        study.ask_for(arguments.wanted);
    }
    let dir = folder(&sweep, arguments.output.out.as_deref());
    let executed = make(&sweep, &dir, &arguments.output, NonZeroUsize::MIN)?;
    let collected = sweep.collect(&dir)?;
    if !arguments.output.quiet {
        eprintln!("output in {}", dir.display());
        print(&collected.words())?;
    }
    Ok(code(&executed, &collected))
}

pub(crate) fn stability(arguments: &Stability) -> Result<ExitCode, Failure> {
    let sweep = partita_sweep::Sweep::load_as(FileKind::Map, &arguments.file)?;
    let dir = folder(&sweep, arguments.output.out.as_deref());
    let executed = make(&sweep, &dir, &arguments.output, jobs(arguments.jobs))?;
    if executed.interrupted || executed.elsewhere > 0 {
        return stopped(&sweep, &dir, &executed);
    }
    let collected = sweep.collect(&dir)?;
    if !arguments.output.quiet {
        print(&collected.words())?;
        eprintln!("output in {}", dir.display());
    }
    Ok(code(&executed, &collected))
}

pub(crate) fn sweep(command: &Sweep) -> Result<ExitCode, Failure> {
    match command {
        Sweep::Plan(arguments) => plan(arguments),
        Sweep::Run(arguments) => run(arguments),
        Sweep::Submit(arguments) => submit(arguments),
        Sweep::Collect(arguments) => collect(arguments),
    }
}

fn plan(arguments: &List) -> Result<ExitCode, Failure> {
    let (sweep, dir) = load(&arguments.sweep)?;
    let states = sweep.states(&dir)?;
    if arguments.json {
        let entry = |(run, state): (&partita_sweep::Run, &State)| {
            let settings: serde_json::Map<_, _> =
                run.labels.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
            json!({
                "index": run.index, "settings": settings, "overrides": run.overrides,
                "fingerprint": run.fingerprint, "state": state.word(),
            })
        };
        let runs: Vec<_> = sweep.runs().iter().zip(&states).map(entry).collect();
        print(&(serde_json::to_string_pretty(&runs).expect("strings and lists") + "\n"))?;
    } else {
        print(&sweep.table(&states).to_plain())?;
    }
    Ok(ExitCode::SUCCESS)
}

fn run(arguments: &Make) -> Result<ExitCode, Failure> {
    let sweep = partita_sweep::Sweep::load(&arguments.file)?;
    let dir = folder(&sweep, arguments.output.out.as_deref());
    if let Some(index) = arguments.index {
        return run_one(&sweep, &dir, index, arguments);
    }
    let executed = make(&sweep, &dir, &arguments.output, jobs(arguments.jobs))?;
    if executed.interrupted || executed.elsewhere > 0 {
        return stopped(&sweep, &dir, &executed);
    }
    report(&sweep, &dir, &executed, arguments.output.quiet)
}

/// One task of a job array. That the run itself fails is a result like another.
fn run_one(
    sweep: &partita_sweep::Sweep,
    dir: &Path,
    index: usize,
    arguments: &Make,
) -> Result<ExitCode, Failure> {
    stop_when_interrupted();
    let only = Some((index, arguments.fingerprint.as_deref()));
    let mut threads = Threads { timed: false, ..Threads::new(NonZeroUsize::MIN, &STOP) };
    let order = Order { dir, force: false, only };
    let executed = sweep.execute(order, &mut threads, &mut Progress::new(true))?;
    let state = sweep.states(dir)?[index];
    if !arguments.output.quiet {
        eprintln!("run {index} ({}): {}", sweep.runs()[index].label(), state.word());
    }
    Ok(if executed.interrupted { ExitCode::from(INTERRUPTED) } else { ExitCode::SUCCESS })
}

fn submit(arguments: &Submit) -> Result<ExitCode, Failure> {
    let (sweep, dir) = load(&arguments.sweep)?;
    let named = [("time", &arguments.time), ("partition", &arguments.partition)];
    let mut options: Vec<String> =
        named.iter().filter_map(|(name, value)| Some(format!("--{name}={}", value.as_ref()?))).collect();
    options.extend(arguments.sbatch.iter().cloned());
    options.extend((!arguments.more.is_empty()).then(|| arguments.more.join(" ")));
    let program = std::env::current_exe().unwrap_or_else(|_| PathBuf::from("partita"));
    let array_size = arguments.array_size.map(Into::into);
    let mut slurm = Slurm { program, array_size, options };
    if arguments.dry_run {
        let scripts = slurm.dry_run(&sweep, &dir)?;
        print(&scripts.join("\n"))?;
        return Ok(ExitCode::SUCCESS);
    }
    let order = Order { dir: &dir, force: false, only: None };
    let executed = sweep.execute(order, &mut slurm, &mut Progress::new(false))?;
    if executed.submitted.is_empty() {
        eprintln!("all {} runs have a result; `partita sweep collect` makes the table", sweep.runs().len());
    }
    let jobs: Vec<&str> = executed.submitted.iter().map(|(job, _)| job.as_str()).collect();
    print(&jobs.iter().flat_map(|job| [job, "\n"]).collect::<String>())?;
    Ok(ExitCode::SUCCESS)
}

fn collect(arguments: &Collect) -> Result<ExitCode, Failure> {
    let (sweep, dir) = load(&arguments.sweep)?;
    report(&sweep, &dir, &Executed::default(), false)
}

/// Writes and prints what the sweep came to.
fn report(
    sweep: &partita_sweep::Sweep,
    dir: &Path,
    executed: &Executed,
    quiet: bool,
) -> Result<ExitCode, Failure> {
    let collected = sweep.collect(dir)?;
    if !quiet {
        print(&format!("{}\n{}", collected.words(), collected.troubles()))?;
        eprintln!("output in {}", dir.display());
    }
    Ok(code(executed, &collected))
}

fn load(arguments: &SweepFile) -> Result<(partita_sweep::Sweep, PathBuf), Failure> {
    let sweep = partita_sweep::Sweep::load(&arguments.file)?;
    let dir = folder(&sweep, arguments.out.as_deref());
    Ok((sweep, dir))
}

fn folder(sweep: &partita_sweep::Sweep, out: Option<&Path>) -> PathBuf {
    out.map_or_else(|| Path::new("runs").join(sweep.name()), Path::to_owned)
}

fn jobs(asked: Option<NonZeroUsize>) -> NonZeroUsize {
    let processors = || std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    asked.unwrap_or_else(processors)
}

/// Makes what is missing with the threads of this process.
fn make(
    sweep: &partita_sweep::Sweep,
    dir: &Path,
    output: &Output,
    jobs: NonZeroUsize,
) -> Result<Executed, Failure> {
    stop_when_interrupted();
    let order = Order { dir, force: output.force, only: None };
    Ok(sweep.execute(order, &mut Threads::new(jobs, &STOP), &mut Progress::new(output.quiet))?)
}

/// Not all runs have a result yet: says how it goes on.
fn stopped(sweep: &partita_sweep::Sweep, dir: &Path, executed: &Executed) -> Result<ExitCode, Failure> {
    let states = sweep.states(dir)?;
    let finished = states.iter().filter(|state| matches!(state, State::Finished | State::Failed)).count();
    let all = states.len();
    if executed.interrupted {
        eprintln!("{finished} of {all} runs are finished and kept; the same command goes on from there");
        return Ok(ExitCode::from(INTERRUPTED));
    }
    eprintln!(
        "{finished} of {all} runs are finished, others are made by another process; `partita sweep collect` makes the table \
         when they are done"
    );
    Ok(ExitCode::from(FAILED_RUN))
}

fn code(executed: &Executed, collected: &Collected) -> ExitCode {
    if executed.interrupted {
        ExitCode::from(INTERRUPTED)
    } else if collected.unfinished.is_empty() {
        ExitCode::SUCCESS
    } else {
        ExitCode::from(FAILED_RUN)
    }
}
