//! The program `partita`: reads the command line, calls the library, says how it went.

mod args;
mod failure;
mod progress;
mod standing;
mod sweeps;

use std::fs;
use std::io::{self, ErrorKind, Write as _};
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Parser;
use partita::output::tables::{self, TableError};
use partita::output::{Clock, Ending, Summary};
use partita::scene::Resolved;
use partita::session::{Options, RunError, Session};
use partita::warning::{self, Warning};
use partita::{build, check, output, plan, scene};

use args::{Arguments, Check, Command, Manner, Plan, Resume, Rows, Run, SceneArguments, Table};
use failure::Failure;
use progress::Progress;
use standing::Standing;

/// Set when the user asks to stop; the run ends after its step.
static STOP: AtomicBool = AtomicBool::new(false);

/// Exit code of a program that was interrupted.
const INTERRUPTED: u8 = 130;

fn main() -> ExitCode {
    let clock = Clock::start();
    let outcome = match Arguments::parse().command {
        Command::Run(arguments) => run(&arguments, clock),
        Command::Check(arguments) => check(&arguments),
        Command::Plan(arguments) => plan(&arguments),
        Command::Resume(arguments) => resume(&arguments, clock),
        Command::Table(arguments) => table(&arguments),
        Command::Study(arguments) => sweeps::study(&arguments),
        Command::Stability(arguments) => sweeps::stability(&arguments),
        Command::Sweep(command) => sweeps::sweep(&command),
    };
    outcome.unwrap_or_else(|failure| failure.show())
}

fn run(arguments: &Run, clock: Clock) -> Result<ExitCode, Failure> {
    let resolved = scene::load(&arguments.scene.path, &arguments.scene.overrides)?;
    let dir = arguments.out.clone().unwrap_or_else(|| Path::new("runs").join(&resolved.name));
    let options = options(&arguments.manner);
    let built = build::march_on(&resolved, options.threads())?;
    let warnings = warning::of(&resolved, &built);
    // What is denied is shown even to those who asked for quiet.
    if !arguments.manner.quiet || arguments.deny_warnings {
        warn(&warnings);
    }
    deny(&warnings, arguments.deny_warnings)?;
    beyond_the_end(&arguments.manner, &resolved);
    if arguments.force {
        output::remove_run(&dir)?;
    }
    let session = Session::start_with(built, &resolved, &dir, options, clock)
        .map_err(Failure::before_the_first_step)?;
    finish(session, &dir, &arguments.manner)
}

fn check(arguments: &Check) -> Result<ExitCode, Failure> {
    let outcome = look_at(&arguments.scene);
    if arguments.json {
        return check_in_json(outcome, arguments.deny_warnings);
    }
    let Checked { description, warnings } = outcome?;
    warn(&warnings);
    let denied = deny(&warnings, arguments.deny_warnings);
    if denied.is_ok() {
        print(&description)?;
    }
    denied.map(|()| ExitCode::SUCCESS)
}

/// A scene that was built, in words.
struct Checked {
    description: String,
    warnings: Vec<Warning>,
}

fn look_at(scene: &SceneArguments) -> Result<Checked, Failure> {
    let resolved = scene::load(&scene.path, &scene.overrides)?;
    let run = build::march(&resolved)?;
    check::look_ahead(&resolved, &run)?;
    Ok(Checked { description: check::describe(&resolved, &run), warnings: warning::of(&resolved, &run) })
}

/// The same as one object; its exit code is that of the words.
fn check_in_json(outcome: Result<Checked, Failure>, deny: bool) -> Result<ExitCode, Failure> {
    let (object, code) = match outcome {
        Ok(Checked { description, warnings }) => {
            let denied = deny && warning::open(&warnings).next().is_some();
            let object = serde_json::json!({ "sound": true, "description": description, "warnings": warnings, "errors": [] });
            (object, if denied { ExitCode::from(failure::WRONG_INPUT) } else { ExitCode::SUCCESS })
        }
        Err(failure) => {
            let errors = failure.problems();
            (serde_json::json!({ "sound": false, "warnings": [], "errors": errors }), failure.code())
        }
    };
    print(&(serde_json::to_string_pretty(&object).expect("strings and lists") + "\n"))?;
    Ok(code)
}

/// Prints the warnings that the scene does not accept, one line each, on stderr.
fn warn(warnings: &[Warning]) {
    for warning in warning::open(warnings) {
        eprintln!("{warning}");
    }
}

fn deny(warnings: &[Warning], denied: bool) -> Result<(), Failure> {
    let count = warning::open(warnings).count();
    if denied && count > 0 { Err(Failure::denied(count)) } else { Ok(()) }
}

fn plan(arguments: &Plan) -> Result<ExitCode, Failure> {
    let resolved = scene::load(&arguments.scene.path, &arguments.scene.overrides)?;
    print(&format!("{}\n\n{}", resolved.scene.title, plan::Plan::of(&resolved.scene).table().to_plain()))?;
    Ok(ExitCode::SUCCESS)
}

fn resume(arguments: &Resume, clock: Clock) -> Result<ExitCode, Failure> {
    if !arguments.dir.join(output::SCENE).is_file() {
        return Err(Failure::no_run(&arguments.dir));
    }
    let resolved = scene::load(&arguments.dir, &[])?;
    beyond_the_end(&arguments.manner, &resolved);
    if let Some(standing) = standing::nothing_left(&resolved, &arguments.dir, arguments.manner.steps)? {
        return nothing_to_do(&standing, &arguments.dir, &arguments.manner);
    }
    let session = Session::resume(&resolved, &arguments.dir, options(&arguments.manner), clock)?;
    finish(session, &arguments.dir, &arguments.manner)
}

fn table(arguments: &Table) -> Result<ExitCode, Failure> {
    if !arguments.dir.join(output::RECORDS).is_file() {
        return Err(Failure::no_run(&arguments.dir));
    }
    let rows = match arguments.rows {
        Rows::Iterations => tables::Rows::Iterations,
        Rows::Steps => tables::Rows::Steps,
    };
    let mut stdout = io::BufWriter::new(io::stdout().lock());
    let written = tables::write(&arguments.dir, rows, &mut stdout)
        .and_then(|()| stdout.flush().map_err(TableError::Write));
    match written {
        Err(TableError::Write(error)) if error.kind() == ErrorKind::BrokenPipe => Ok(ExitCode::SUCCESS),
        Err(TableError::Write(error)) => Err(Failure::no_stdout(&error)),
        Err(TableError::Records(error)) => Err(error.into()),
        Ok(()) => Ok(ExitCode::SUCCESS),
    }
}

/// Says that a run has no step left to make, and is left as it is.
fn nothing_to_do(standing: &Standing, dir: &Path, manner: &Manner) -> Result<ExitCode, Failure> {
    if !manner.quiet {
        eprintln!("{standing}");
    }
    if manner.json
        && let Ok(summary) = fs::read_to_string(dir.join(output::SUMMARY))
    {
        print(&summary)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A note where more steps are asked for than the scene has.
fn beyond_the_end(manner: &Manner, resolved: &Resolved) {
    let steps = resolved.scene.time.steps;
    if let Some(asked) = manner.steps.filter(|asked| asked.get() > steps.get() && !manner.quiet) {
        eprintln!(
            "note: --steps {asked} asks for more than the {steps} steps of the scene, where the run ends; `time.steps` says how many there are"
        );
    }
}

/// The first interrupt waits for the end of the step, the second does not. Where no handler can be set, the system's own
/// stays: it stops at once, and a run can be resumed from its last checkpoint.
fn stop_when_interrupted() {
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED.into());
        }
    });
}

fn options(manner: &Manner) -> Options<'static> {
    stop_when_interrupted();
    Options { steps: manner.steps.map(Into::into), stop: Some(&STOP), threads: Some(manner.threads) }
}

fn finish(session: Session<'_>, dir: &Path, manner: &Manner) -> Result<ExitCode, Failure> {
    let summary = session.finish_watched(&mut Progress::new(manner.quiet)).inspect_err(|error| {
        // Where a summary was asked for there is one of a failed run too.
        if let (RunError::Step(_) | RunError::Storage { .. }, true) = (error, manner.json) {
            let _ = fs::read_to_string(dir.join(output::SUMMARY)).map(|summary| print(&summary));
        }
    })?;
    if !manner.quiet {
        comment(&summary, dir);
    }
    if manner.json {
        print(&(serde_json::to_string_pretty(&summary).expect("a summary is plain data") + "\n"))?;
    } else if !manner.quiet {
        print(&summary.table().to_plain())?;
    }
    Ok(match summary.ending {
        Ending::Interrupted => ExitCode::from(INTERRUPTED),
        Ending::Completed | Ending::Stopped | Ending::Failed => ExitCode::SUCCESS,
    })
}

/// What the user should know beside the summary, on stderr.
fn comment(summary: &Summary, dir: &Path) {
    let Summary { steps, unconverged_steps, .. } = summary;
    let dir = dir.display();
    if *unconverged_steps > 0 {
        eprintln!(
            "warning: {unconverged_steps} of {steps} steps ended on the iteration bound, not converged"
        );
    }
    for (field, work) in [("fluid", &summary.fluid), ("structure", &summary.structure)] {
        if work.idle_steps > 0 {
            eprintln!(
                "warning: the {field} made no Newton iteration in {} of {steps} steps, although more than a thousandth of its \
                 load was not balanced: `{field}.newton.tolerance` is too large for this load",
                work.idle_steps
            );
        }
    }
    eprintln!("output in {dir}");
    if matches!(summary.ending, Ending::Interrupted | Ending::Stopped) {
        eprintln!("stopped after step {steps}; go on with `partita resume {dir}`");
    }
}

/// Writes to stdout. A reader who has seen enough is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::no_stdout(&error)),
        _ => Ok(()),
    }
}
