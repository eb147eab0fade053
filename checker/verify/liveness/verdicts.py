"""Verdicts on properties about infinite runs: a stronger bounded property first, then what refutes them.

A ``LeadsTo`` or ``Settles`` is broken by a loop; that there is none proves it.  A ``Recoverable`` is
broken by a valuation from which there is no way back (``checker.verify.liveness.recover``).
"""

from collections.abc import Mapping
from dataclasses import replace

from checker.engines import Progress
from checker.process.faults import attempted
from checker.results.trace import counted_ticks
from checker.results.verdict import Answer, Open, Proved, Reached, Unknown, Unreachable, Violated
from checker.system.lowered import lowered
from checker.system.slice import check_way_back
from checker.verify.liveness.loops import LoopHunt, hunt, looped
from checker.verify.liveness.recover import recovered
from checker.verify.liveness.settling import settled
from checker.verify.portfolio.question import Hint, PortfolioQuestion
from checker.verify.portfolio.shape import VAST, shape
from checker.verify.result import Ask, Result, check_domains
from checker.verify.runs.reproduce import only_there
from properties.forms import Form, HoldsAfter, LeadsTo, Property, Recoverable, Responds, Settles
from properties.reduce import reduce
from spec_model.lang.system import System
from spec_model.lang.time import Span

Systems = Mapping[str, System]

NO_LOOP = "no loop closes"
"""What an exhausted search for loops has shown."""

SETTLING = "settling"
"""What finds loops by chance, in the place of an engine's name."""


def unbounded(prop: Property, systems: Systems, ask: Ask, progress: Progress) -> Result:
    """The result of one property about infinite runs.

    Raises ``ModelError`` when the model leaves a domain, ``ReplayError`` when a run cannot be replayed.
    """
    proved = _by_bound(prop, systems, ask)
    if proved is not None:
        return Result(prop, proved, prop.on)
    if isinstance(prop.form, Recoverable):
        return Result(prop, recovered(prop, systems[prop.on], ask, progress), prop.on)
    return _by_loop(prop, systems, ask, progress)


# --- a bounded property that is stronger -----------------------------------------------------------


def _by_bound(prop: Property, systems: Systems, ask: Ask) -> Proved | None:
    """A proof by the bounded property that implies this one, if there is one and it holds."""
    bounded = _bounded(prop, systems)
    if bounded is None:
        return None
    form, span = bounded
    question = reduce(lowered(systems[prop.on]), [replace(prop, form=form)])
    goal = question.goals[0].var
    found = ask(question.system, [goal])
    check_domains(question.system, found)
    answer, by = found[goal.name]
    return Proved(answer.because, by, f"even within {span}") if isinstance(answer, Unreachable) else None


def _bounded(prop: Property, systems: Systems) -> tuple[Form, Span] | None:
    match prop.form:
        case LeadsTo(trigger, response, Span() as bound):
            return Responds(trigger, response, bound), bound
        case Settles(premise, then, Span() as bound):
            return HoldsAfter(premise, bound, then), bound
        case Recoverable(to, by, Span() as within) if by is not None:
            concrete = systems[systems[prop.on].concrete or prop.on]
            check_way_back(prop, lowered(concrete))
            return HoldsAfter(by, within, to), within
        case _:
            return None


# --- loops -----------------------------------------------------------------------------------------


def _by_loop(prop: Property, systems: Systems, ask: Ask, progress: Progress) -> Result:
    system = systems[prop.on]
    hunted, answer, by = _hunted(prop, system, ask, progress)
    if not (isinstance(answer, Reached) and system.over):
        return _result(hunted, answer, by)
    if not system.concrete:
        reason = only_there(system.name, len(answer.run))
        return Result(prop, Unknown(reason, len(answer.run) - 1, by), system.name)
    there = systems[system.concrete]
    result = _result(*_hunted(replace(prop, on=there.name), there, ask, progress))
    if isinstance(result.verdict, Unknown):
        reason = (
            f"a loop of {system.name}, an over-approximation, was found "
            f"after {counted_ticks(len(answer.run))}; not reproduced on {there.name}: {result.verdict.reason}"
        )
        result = replace(result, verdict=replace(result.verdict, reason=reason))
    return result


def _hunted(prop: Property, system: System, ask: Ask, progress: Progress) -> tuple[LoopHunt, Answer, str]:
    question = reduce(lowered(system), [prop])
    hunted = hunt(question, question.goals[0])
    loop = attempted(SETTLING, system.name, lambda: settled(hunted, progress)) if _vast(hunted) else None
    if isinstance(loop, Reached):
        if question.system.checks and shape(PortfolioQuestion(question.system, ())).enumerable:
            check_domains(question.system, ask(question.system, []))
        return hunted, loop, SETTLING
    found = ask(hunted.lasso.system, [hunted.lasso.goal], Hint.SHORT)
    check_domains(hunted.lasso.system, found)
    return hunted, *found[hunted.lasso.goal.name]


def _vast(hunted: LoopHunt) -> bool:
    """Whether pairs of valuations are too wide to enumerate, so that a long loop is best met by chance."""
    return shape(PortfolioQuestion(hunted.lasso.system, (hunted.lasso.goal,))).bits > VAST


def _result(hunted: LoopHunt, answer: Answer, by: str) -> Result:
    prop, name = hunted.goal.property, hunted.question.system.name
    match answer:
        case Reached(run):
            return Result(prop, Violated(looped(hunted, run), by), name)
        case Unreachable(because):
            return Result(prop, Proved(because, by, NO_LOOP), name)
        case Open(reason, depth):
            return Result(prop, Unknown(reason, depth, by), name)
