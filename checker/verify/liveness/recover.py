"""The way back: from every reachable valuation some run must reach a condition, or a trap is shown.

The reachable valuations and the ticks between them are enumerated and searched backward from the
condition.  What the backward search misses is a trap: no run leaves it for the condition any more.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from checker.engines import Progress
from checker.results.graph import Values
from checker.results.verdict import Exhausted, Open, Proved, Reached, Unknown, Verdict, Violated
from checker.system.lowered import lowered
from checker.system.slice import sliced
from checker.verify.reachable import ReachableSearch, TooLarge
from checker.verify.result import Ask, check_domains
from checker.verify.runs.calm import calmed
from checker.verify.runs.replay import replay
from properties.forms import Property
from properties.reduce import Goal, Question, reduce
from spec_model.lang.action import Assign
from spec_model.lang.domain import boolean
from spec_model.lang.expr import Const, Var, all_of
from spec_model.lang.system import System, TransitionSystem

ENGINE = "graph"
MOST_VALUATIONS = 20_000
MOST_TICKS = 500_000


@dataclass(frozen=True)
class Trap:
    """A valuation of ``variables`` that is reached after some tick, and how many it can lead to."""

    variables: tuple[Var, ...]
    valuation: Values
    leads_to: int


def recovered(prop: Property, system: System, ask: Ask, progress: Progress) -> Verdict:
    """The verdict on a ``Recoverable``: proved, a run into a trap, or unknown for a large system."""
    question = reduce(lowered(system), [prop])
    open_ = left_open(question.system, ask)
    if open_ is not None:
        return open_
    if system.over:
        reason = f"{system.name} is an over-approximation, whose ways back need not be ways of the charts"
        return Unknown(reason, 0, ENGINE)
    try:
        found = trapped(question, question.goals[0].var, progress)
    except TooLarge:
        limit = f"more than {MOST_VALUATIONS:,} valuations or {MOST_TICKS:,} ticks between them"
        return Unknown(f"{limit}; all of them are needed to tell what can be reached again", 0, ENGINE)
    if isinstance(found, Exhausted):
        return Proved(found, ENGINE)
    return shown(question, found, ask)


def left_open(system: TransitionSystem, ask: Ask) -> Unknown | None:
    """Unknown, unless every run stays in all domains: a graph of valuations goes on where a run does not.

    Raises ``LeavesDomain`` if some run is known to leave one.
    """
    if not system.checks:
        return None
    found = ask(system, [])
    check_domains(system, found)
    for check, _ in system.checks:
        answer, by = found[check.name]
        if isinstance(answer, Open):
            reason = f"it is not known whether values stay in their domains; {check.doc}? {answer.reason}"
            return Unknown(reason, answer.depth, by)
    return None


def trapped(question: Question, to: Var, progress: Progress) -> Trap | Exhausted:
    """The first valuation after some tick from which no run reaches ``to``, if there is one."""
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


def shown(question: Question, trap: Trap, ask: Ask) -> Verdict:
    """A shortest run into the trap, replayed."""
    [goal] = question.goals
    entered = Var(f"{goal.var.name} trap", boolean, 0, "the run is in a valuation without a way back")
    there = all_of(*(v == Const(raw, v.sort) for v, raw in zip(trap.variables, trap.valuation, strict=True)))
    system = replace(
        question.system,
        variables=(*question.system.variables, entered),
        step=(*question.system.step, Assign(entered, there)),
    )
    found = ask(system, [entered])
    check_domains(system, found)
    answer, by = found[entered.name]
    if not isinstance(answer, Reached):
        return Unknown(f"a trap is known to exist, but {by} found no run into it", 0, by)
    into = Goal(goal.property, entered, False, goal.parts, goal.memory)
    trace = replay(system, into, calmed(system, entered, answer.run))
    return Violated(replace(trace, trapped=trap.leads_to), ENGINE)
