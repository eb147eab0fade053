"""Verdicts on properties about infinite runs: a stronger bounded property first, then what refutes them.

A ``LeadsTo`` or ``Settles`` is broken by a loop; that there is none proves it.  A ``Recoverable`` is
broken by a state from which there is no way back (``checker.verify.liveness.verdicts``).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from rovercheck.checker.engines import Progress
from rovercheck.checker.process.faults import attempted
from rovercheck.checker.results.graph import Values
from rovercheck.checker.results.trace import counted_ticks
from rovercheck.checker.results.verdict import (
    Answer,
    Exhausted,
    Open,
    Proved,
    Reached,
    Unknown,
    Unreachable,
    Verdict,
    Violated,
)
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.system.slice import check_way_back, sliced
from rovercheck.checker.verify.liveness.loops import LoopQuery, loop_query, looped
from rovercheck.checker.verify.liveness.repetition import repeating_loop
from rovercheck.checker.verify.portfolio.question import PortfolioQuestion, Prior
from rovercheck.checker.verify.portfolio.shape import VAST, shape
from rovercheck.checker.verify.reachable import ReachableSearch, TooLarge
from rovercheck.checker.verify.result import EngineQuery, Result, check_domains
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import replay
from rovercheck.checker.verify.runs.reproduce import only_there
from rovercheck.properties.forms import Form, HoldsAfter, LeadsTo, Property, Recoverable, Responds, Settles
from rovercheck.properties.reduce import Goal, Question, reduce
from rovercheck.spec_model.lang.action import Assign
from rovercheck.spec_model.lang.domain import boolean
from rovercheck.spec_model.lang.expr import Const, Var, all_of
from rovercheck.spec_model.lang.system import System, TransitionSystem
from rovercheck.spec_model.lang.time import Span

# --- the way back --------------------------------------------------------------------------------------

ENGINE = "graph"
MOST_VALUATIONS = 20_000
MOST_TICKS = 500_000


@dataclass(frozen=True)
class Trap:
    """A state of ``variables`` that is reached after some tick, and how many it can lead to."""

    variables: tuple[Var, ...]
    valuation: Values
    leads_to: int


def recovered(prop: Property, system: System, query: EngineQuery, progress: Progress) -> Verdict:
    """The verdict on a ``Recoverable``: proved, a run into a trap, or unknown for a large system."""
    question = reduce(lowered(system), [prop])
    open_ = left_open(question.system, query)
    if open_ is not None:
        return open_
    if system.over:
        reason = f"{system.name} is an over-approximation, whose ways back need not be ways of the charts"
        return Unknown(reason, 0, ENGINE)
    try:
        found = trapped(question, question.goals[0].var, progress)
    except TooLarge:
        limit = f"more than {MOST_VALUATIONS:,} states or {MOST_TICKS:,} ticks between them"
        return Unknown(f"{limit}; all of them are needed to tell what can be reached again", 0, ENGINE)
    if isinstance(found, Exhausted):
        return Proved(found, ENGINE)
    return shown(question, found, query)


def left_open(system: TransitionSystem, query: EngineQuery) -> Unknown | None:
    """Unknown, unless every run stays in all domains: a graph of states goes on where a run does not.

    Raises ``LeavesDomain`` if some run is known to leave one.
    """
    if not system.checks:
        return None
    found = query(system, [])
    check_domains(system, found)
    for check, _ in system.checks:
        answer, by = found[check.name]
        if isinstance(answer, Open):
            reason = f"it is not known whether values stay in their domains; {check.doc}? {answer.reason}"
            return Unknown(reason, answer.depth, by)
    return None


def trapped(question: Question, to: Var, progress: Progress) -> Trap | Exhausted:
    """The first state after some tick from which no run reaches ``to``, if there is one."""
    part = sliced(question.system, [to])
    carried = [v for v in (*part.frozen, *part.variables) if v.name != to.name]
    variables = (*carried, to)
    search = ReachableSearch(part, variables, MOST_VALUATIONS, MOST_TICKS, progress)
    depth = dict.fromkeys(search.initial(), 0)
    following: dict[Values, set[Values]] = {}
    leaving_own: dict[Values, int] = {}
    for valuation, leaving in search:
        leaving_own[valuation[:-1]] = len(leaving)
        following[valuation] = {after for after, _ in leaving}
        for after in following[valuation]:
            depth.setdefault(after, depth[valuation] + 1)
    back = _reached((v for v in following if v[-1]), _reversed(following))
    lost = [after for afters in following.values() for after in afters if after not in back]
    if lost:
        nearest = min(lost, key=lambda v: (depth[v], v))
        return Trap(variables, nearest, len({v[:-1] for v in _reached([nearest], following)}))
    # The flag that says where to come back to is none of the system's own variables.
    nearest_own: dict[Values, int] = {}
    for valuation, ticks in depth.items():
        nearest_own[valuation[:-1]] = min(ticks, nearest_own.get(valuation[:-1], ticks))
    names = tuple(v.name for v in carried)
    return Exhausted(len(nearest_own), sum(leaving_own.values()), max(nearest_own.values()), names)


def _reversed(following: Mapping[Values, set[Values]]) -> Mapping[Values, set[Values]]:
    before: dict[Values, set[Values]] = {valuation: set() for valuation in following}
    for valuation, afters in following.items():
        for after in afters:
            before[after].add(valuation)
    return before


def _reached(start: Iterable[Values], following: Mapping[Values, set[Values]]) -> set[Values]:
    found = set(start)
    queue = list(found)
    while queue:
        new = following[queue.pop()] - found
        found |= new
        queue += new
    return found


def shown(question: Question, trap: Trap, query: EngineQuery) -> Verdict:
    """A shortest run into the trap, replayed."""
    [goal] = question.goals
    entered = Var(f"{goal.var.name} trap", boolean, 0, "the run is in a state without a way back")
    there = all_of(*(v == Const(raw, v.sort) for v, raw in zip(trap.variables, trap.valuation, strict=True)))
    system = replace(
        question.system,
        variables=(*question.system.variables, entered),
        step=(*question.system.step, Assign(entered, there)),
    )
    found = query(system, [entered])
    check_domains(system, found)
    answer, by = found[entered.name]
    if not isinstance(answer, Reached):
        return Unknown(f"a trap is known to exist, but {by} found no run into it", 0, by)
    into = Goal(goal.property, entered, False, goal.parts, goal.memory)
    trace = replay(system, into, minimise_inputs(system, entered, answer.run))
    return Violated(replace(trace, trapped=trap.leads_to), ENGINE)


Systems = Mapping[str, System]

NO_LOOP = "no loop closes"
"""What an exhausted search for loops has shown."""

SETTLING = "settling"
"""What finds loops by chance, in the place of an engine's name."""


def unbounded(prop: Property, systems: Systems, query: EngineQuery, progress: Progress) -> Result:
    """The result of one property about infinite runs.

    Raises ``ModelError`` when the model leaves a domain, ``ReplayError`` when a run cannot be replayed.
    """
    proved = _by_bound(prop, systems, query)
    if proved is not None:
        return Result(prop, proved, prop.on)
    if isinstance(prop.form, Recoverable):
        return Result(prop, recovered(prop, systems[prop.on], query, progress), prop.on)
    return _by_loop(prop, systems, query, progress)


# --- a bounded property that is stronger -----------------------------------------------------------


def _by_bound(prop: Property, systems: Systems, query: EngineQuery) -> Proved | None:
    """A proof by the bounded property that implies this one, if there is one and it holds."""
    bounded = _bounded(prop, systems)
    if bounded is None:
        return None
    form, span = bounded
    question = reduce(lowered(systems[prop.on]), [replace(prop, form=form)])
    goal = question.goals[0].var
    found = query(question.system, [goal])
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


def _by_loop(prop: Property, systems: Systems, query: EngineQuery, progress: Progress) -> Result:
    system = systems[prop.on]
    asked, answer, by = _loop_answer(prop, system, query, progress)
    if not (isinstance(answer, Reached) and system.over):
        return _result(asked, answer, by)
    if not system.concrete:
        reason = only_there(system.name, len(answer.run))
        return Result(prop, Unknown(reason, len(answer.run) - 1, by), system.name)
    there = systems[system.concrete]
    result = _result(*_loop_answer(replace(prop, on=there.name), there, query, progress))
    if isinstance(result.verdict, Unknown):
        reason = (
            f"a loop of {system.name}, an over-approximation, was found "
            f"after {counted_ticks(len(answer.run))}; not reproduced on {there.name}: {result.verdict.reason}"
        )
        result = replace(result, verdict=replace(result.verdict, reason=reason))
    return result


def _loop_answer(
    prop: Property, system: System, query: EngineQuery, progress: Progress
) -> tuple[LoopQuery, Answer, str]:
    question = reduce(lowered(system), [prop])
    asked = loop_query(question, question.goals[0])
    loop = attempted(SETTLING, system.name, lambda: repeating_loop(asked, progress)) if _vast(asked) else None
    if isinstance(loop, Reached):
        if question.system.checks and shape(PortfolioQuestion(question.system, ())).enumerable:
            check_domains(question.system, query(question.system, []))
        return asked, loop, SETTLING
    found = query(asked.lasso.system, [asked.lasso.goal], Prior.SHORT)
    check_domains(asked.lasso.system, found)
    return asked, *found[asked.lasso.goal.name]


def _vast(asked: LoopQuery) -> bool:
    """Whether pairs of states are too wide to enumerate, so that a long loop is best met by chance."""
    return shape(PortfolioQuestion(asked.lasso.system, (asked.lasso.goal,))).bits > VAST


def _result(asked: LoopQuery, answer: Answer, by: str) -> Result:
    prop, name = asked.goal.property, asked.question.system.name
    match answer:
        case Reached(run):
            return Result(prop, Violated(looped(asked, run), by), name)
        case Unreachable(because):
            return Result(prop, Proved(because, by, NO_LOOP), name)
        case Open(reason, depth):
            return Result(prop, Unknown(reason, depth, by), name)
