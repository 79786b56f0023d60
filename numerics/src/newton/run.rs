//! The loop itself.

use super::{
    Bound, Check, Failure, Iteration, Limit, Problem, Report, ResidualNorm, ReusableFactor, Settings, Verdict,
};

/// Runs Newton iterations on `problem` from its current iterate until the bound is met, `limit` is reached
/// or the callback `after` says stop.
///
/// ```text
/// evaluate R at the entry
/// repeat   Before: |R| below its bound, or at round-off? converged
///          limit reached? leave
///          (dR/ds) ds = -R,  s <- s + ds,  evaluate R
///              (with a kept factor where it serves; if |R| rises, back to s, and with the factor there)
///          not finite, exploded, standing still? fail
///          Lagged: |R| before this solve below its bound, or at round-off? converged
///          callback says stop? leave
/// ```
///
/// A residual [at round-off](Problem::round_offs) counts as converged whatever the bound asks for, and the report says so.
///
/// The entry residual is evaluated in every call, whatever an earlier call left behind. The callback sees
/// every iteration, the last one included. The residual of the report, and all that the problem assembled
/// with it, belongs to the last iterate. The tangent is assembled only where another iteration can follow and needs it:
/// a linear problem is factored once, and with [`Settings::reuse_factor`] the residual decides first whether the last
/// factor serves on, so that R is evaluated once more where it does not.
///
/// ```
/// use partita_numerics::newton::{self, Limit, Problem, ResidualNorm, Settings, Verdict};
///
/// /// x^2 = 2.
/// struct Root { x: f64 }
///
/// impl Problem for Root {
///     type Error = std::convert::Infallible;
///     fn assemble(&mut self, _with_tangent: bool) -> Result<ResidualNorm, Self::Error> {
///         Ok(ResidualNorm::new((self.x * self.x - 2.0).abs(), 2.0))
///     }
///     fn solve_and_update(&mut self) -> Result<(), Self::Error> {
///         self.x -= (self.x * self.x - 2.0) / (2.0 * self.x);
///         Ok(())
///     }
/// }
///
/// let mut root = Root { x: 1.0 };
/// let report = newton::solve(&mut root, &Settings::default(), Limit::ToConvergence, |_, _| Verdict::Continue)?;
/// assert!(report.converged && report.iterations == 4);
/// assert!((root.x - 2_f64.sqrt()).abs() < 1e-11);
/// # Ok::<(), newton::Failure<std::convert::Infallible>>(())
/// ```
///
/// # Errors
///
/// If the problem fails, or the residual is not finite or explodes. With [`Limit::ToConvergence`] also if the
/// bound is not met within [`Settings::max_iterations`] or the residual stands still at round-off; with
/// [`Limit::AtMost`] the report says so instead.
pub fn solve<P: Problem>(
    problem: &mut P,
    settings: &Settings,
    limit: Limit,
    mut after: impl FnMut(&mut P, &Iteration) -> Verdict,
) -> Result<Report, Failure<P::Error>> {
    let bound = settings.bound;
    let lagged = settings.check == Check::Lagged;
    let most = match limit {
        Limit::AtMost(iterations) => iterations,
        Limit::ToConvergence => settings.max_iterations,
    };
    let mut has_tangent = most > 0 && needs_tangent(problem, settings);
    let entry = assemble(problem, 0, has_tangent, None)?;
    let mut report = Report::at_entry(entry, has_tangent);
    let mut watch = Watch::new(entry);
    let mut level = Level::of(problem, bound, &entry);
    report.entry_converged = level.is_converged();
    if level.is_converged() && !lagged {
        report.converge(level);
    }
    // A factor whose step was taken back is not tried again, whatever the problem says of it: the loop ends for every problem.
    let mut was_taken_back = false;
    while !report.converged && !report.stopped_by_callback && report.iterations < most {
        let index = report.iterations + 1;
        let before = report.exit;
        let refactors = was_taken_back || needs_tangent(problem, settings);
        was_taken_back = false;
        if refactors && !has_tangent {
            assemble(problem, report.iterations, true, Some((entry, before)))?;
            report.count_assembly(true);
        }
        let is_chord = !refactors && problem.reusable_factor() == ReusableFactor::Earlier;
        let solved = if refactors { problem.solve_and_update() } else { problem.solve_reusing_factor() };
        solved.map_err(|source| Failure::Problem { iteration: index, source })?;
        report.count_solve(refactors);
        let is_last = index == most || (lagged && level.is_converged());
        has_tangent = !is_last && needs_tangent(problem, settings);
        let residual = assemble(problem, index, has_tangent, Some((entry, before)));
        report.count_assembly(has_tangent);
        let reached = residual.as_ref().map_or(Level::Above, |residual| Level::of(problem, bound, residual));
        if is_chord && !reached.is_converged() && raises(&before, residual.as_ref().ok()) {
            problem.take_back();
            problem.drop_factor();
            (has_tangent, was_taken_back) = (false, true);
            continue;
        }
        let residual = residual?;
        report.iterations = index;
        report.exit = residual;
        if !reached.is_converged() && is_slow(settings, &before, &residual) {
            problem.drop_factor();
        }
        let judged = if lagged { level } else { reached };
        level = reached;
        if judged.is_converged() {
            report.converge(judged);
        }
        watch.check_growth(index, residual, settings.divergence_factor)?;
        report.stagnated = watch.stands_still(residual) && !report.converged && !level.is_converged();
        if report.stagnated && limit == Limit::ToConvergence {
            let round_offs = problem.round_offs();
            return Err(Failure::Stagnated { iteration: index, residual, bound, round_offs });
        }
        let verdict = after(problem, &Iteration { index, before, after: residual });
        report.stopped_by_callback = verdict == Verdict::Stop;
    }
    if limit == Limit::ToConvergence && !report.converged && !report.stopped_by_callback {
        let Report { iterations, exit: residual, .. } = report;
        return Err(Failure::TooManyIterations { iterations, entry, residual, bound });
    }
    Ok(report)
}

/// Whether the next solve has to factor the tangent of its iterate.
fn needs_tangent<P: Problem>(problem: &P, settings: &Settings) -> bool {
    match problem.reusable_factor() {
        ReusableFactor::Missing => true,
        ReusableFactor::Earlier => settings.reuse_factor.is_none(),
        ReusableFactor::Exact => false,
    }
}

/// Whether an iteration fell short of the decrease that a reused factor has to bring.
fn is_slow(settings: &Settings, before: &ResidualNorm, after: &ResidualNorm) -> bool {
    let Settings { bound, reuse_factor, .. } = settings;
    let falls = |wanted: f64| {
        bound.measure(after) < wanted * bound.measure(before) && after.absolute < wanted * before.absolute
    };
    reuse_factor.is_some_and(|wanted| !falls(wanted))
}

/// Whether a step has led away from the solution, or to where there is no residual. (In itself: the scale of a residual
/// may grow with it.)
fn raises(before: &ResidualNorm, after: Option<&ResidualNorm>) -> bool {
    after.is_none_or(|after| after.absolute >= before.absolute)
}

/// Where the last residual stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    Above,
    /// Above the bound, but not above its round-off.
    AtRoundOff,
    BelowBound,
}

/// Round-off is looked for in relative residuals below this.
const SMALL: f64 = 1e-2;

impl Level {
    /// That of `residual`, the last one that `problem` assembled.
    fn of<P: Problem>(problem: &mut P, bound: Bound, residual: &ResidualNorm) -> Self {
        if bound.met(residual) {
            Self::BelowBound
        } else if residual.relative < SMALL && problem.round_offs() <= 1.0 {
            Self::AtRoundOff
        } else {
            Self::Above
        }
    }

    /// What lies below the bound, or at round-off, cannot be asked to fall on.
    fn is_converged(self) -> bool {
        self != Self::Above
    }
}

/// Assembles and refuses a residual that is not finite.
fn assemble<P: Problem>(
    problem: &mut P,
    iteration: usize,
    with_tangent: bool,
    before: Option<(ResidualNorm, ResidualNorm)>,
) -> Result<ResidualNorm, Failure<P::Error>> {
    let residual = problem.assemble(with_tangent).map_err(|source| Failure::Problem { iteration, source })?;
    if residual.is_finite() { Ok(residual) } else { Err(Failure::NotFinite { iteration, residual, before }) }
}

impl Report {
    fn at_entry(entry: ResidualNorm, with_tangent: bool) -> Self {
        Self {
            iterations: 0,
            assemblies: 1,
            tangents: usize::from(with_tangent),
            factorizations: 0,
            solves: 0,
            entry,
            exit: entry,
            entry_converged: false,
            converged: false,
            at_round_off: false,
            stopped_by_callback: false,
            stagnated: false,
        }
    }

    fn converge(&mut self, level: Level) {
        self.converged = true;
        self.at_round_off = level == Level::AtRoundOff;
    }

    fn count_assembly(&mut self, with_tangent: bool) {
        self.assemblies += 1;
        self.tangents += usize::from(with_tangent);
    }

    fn count_solve(&mut self, with_factorization: bool) {
        self.factorizations += usize::from(with_factorization);
        self.solves += 1;
    }
}

/// Relative residuals at which a standstill is round-off, and for how many iterations the residual must not have fallen by
/// `DECREASE`. Round-off of a nearly incompressible solid is far above that of its terms: a standstill there must last.
/// Above both, it is a hard problem.
const ROUND_OFF: [(f64, usize); 2] = [(1e-8, 3), (1e-5, 10)];
const DECREASE: f64 = 0.9;

/// Watches the residuals of one call for growth and for standstill.
struct Watch {
    entry: ResidualNorm,
    /// The size a residual is compared with: that of the entry and of its terms, or the first one above zero.
    reference: f64,
    lowest: f64,
    since_lowest: usize,
}

impl Watch {
    fn new(entry: ResidualNorm) -> Self {
        let reference = entry.absolute.max(entry.scale());
        Self { entry, reference, lowest: entry.absolute, since_lowest: 0 }
    }

    fn check_growth<E>(
        &mut self,
        iteration: usize,
        residual: ResidualNorm,
        factor: f64,
    ) -> Result<(), Failure<E>> {
        if self.reference == 0.0 {
            self.reference = residual.absolute.max(residual.scale());
        }
        if residual.absolute > factor * self.reference {
            return Err(Failure::Diverged { iteration, entry: self.entry, residual });
        }
        Ok(())
    }

    fn stands_still(&mut self, residual: ResidualNorm) -> bool {
        if residual.absolute < DECREASE * self.lowest {
            self.lowest = residual.absolute;
            self.since_lowest = 0;
        } else {
            self.since_lowest += 1;
        }
        ROUND_OFF.iter().any(|&(level, patience)| residual.relative < level && self.since_lowest >= patience)
    }
}
