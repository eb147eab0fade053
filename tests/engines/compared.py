"""The explicit engine compared with the naive search, on small systems that between them need all of it."""

from collections.abc import Callable
from functools import cache

from rovercheck.checker.encode.native import OutsideDomain
from rovercheck.checker.engines import Limits, Timers, explicit
from rovercheck.checker.engines import quiet as silent
from rovercheck.checker.results.verdict import Answer, Exhausted, Reached, Unreachable
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import chosen, integer
from rovercheck.spec_model.lang.expr import FALSE, Var, all_of, flag, ite, var
from rovercheck.spec_model.lang.system import Statement, TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive

Group = tuple[TransitionSystem, tuple[Var, ...]]


class Differs(AssertionError):
    """The engine and the naive search do not agree."""


def must(holds: bool, what: object) -> None:
    if not holds:
        raise Differs(what)


# --- the comparison ----------------------------------------------------------------------------------


@cache
def _expected(made: Callable[[], Group]) -> tuple[Group, naive.Searched]:
    group = made()
    return group, naive.search(*group)


def compare(made: Callable[[], Group], timers: Timers = Timers.EXACT) -> None:
    """Raises ``Differs`` where the engine does not say what the naive search says."""
    (system, goals), expected = _expected(made)
    broken = any(dict(s)[v.name] not in v.domain for s in expected.states for v in system.variables)
    try:
        answers = explicit.check(system, goals, Limits(timers=timers), silent)
    except OutsideDomain:
        must(broken, "a value is said to be outside its domain")
        return
    except (LookupError, AssertionError, IndexError) as problem:
        raise Differs(problem) from problem
    must(not broken, "a value is outside its domain")
    for goal in goals:
        must_agree(system, goal, answers[goal.name], expected)


def must_agree(system: TransitionSystem, goal: Var, answer: Answer, expected: naive.Searched) -> None:
    """Raises ``Differs`` where one answer is not what the naive search says."""
    match answer:
        case Reached(run):
            must(len(run) == expected.reached.get(goal.name), f"{goal.name} after {len(run)} ticks")
            try:
                last = naive.replay(system, run)[-1]
            except AssertionError as problem:
                raise Differs(problem) from problem
            must(bool(last[goal.name]), f"{goal.name} is false after its run")
        case Unreachable(Exhausted() as because):
            must(goal.name not in expected.reached, f"{goal.name} is reachable")
            states = naive.projected(expected.states, because.variables)
            must(because.skipped or because.states == len(states), f"{because.states} states")
            must(because.closed is None or _closed(because) == states, "other states")
        case _:
            raise Differs(answer)


def _closed(because: Exhausted) -> set[naive.State]:
    assert because.closed is not None
    found = set()
    for row in because.closed.whole.words.tolist():
        raw = {
            p.var.name: (row[p.word] >> p.shift & (1 << p.bits) - 1) * p.stride + p.low
            for p in because.closed.whole.places
        }
        found.add(tuple((n, raw[n]) for n in because.variables))
    return found


# --- systems that each fault shows on ----------------------------------------------------------------


def mixed() -> Group:
    """Inputs with cells, a sparse and a negative number, a counter, branches that choose."""
    level, go, pick = var("level", integer(0, 9)), flag("go"), var("pick", chosen([-5, 0, 10]))
    mode, kept = var("mode", chosen([-5, 0, 10])), var("kept", integer(-2, 1))
    count, seen = var("count", integer(0, 4)), flag("seen")
    reached, far, never = flag("reached"), flag("far"), flag("never")
    step: tuple[Statement, ...] = (
        If(go, (Assign(mode, pick),), (Assign(kept, ite(level > 5, kept, ite(kept < 1, kept + 1, -2))),)),
        Assign(seen, (level > 3) & (level < 6)),
        Assign(count, ite(seen, minimum(count + 1, 4), count)),
        Assign(reached, (count == 3) & (mode == 10)),
        Assign(far, all_of(count == 4, kept == 1, mode == -5)),
        Assign(never, (count == 4) & (kept > 1)),
    )
    made = TransitionSystem(
        "mixed", (level, go, pick), (), (mode, kept, count, seen, reached, far, never), (), step
    )
    return made, (reached, far, never)


def long() -> Group:
    """A step so long that between two forks one input is always chosen and another sometimes."""
    sure, maybe, x = flag("sure"), flag("maybe"), var("x", integer(0, 3))
    both, never = flag("both"), flag("never")
    turns = (Assign(x, ite(x == 3, 0, x + 1)),) * 40
    step: tuple[Statement, ...] = (
        Assign(both, sure),
        If(sure, (If(maybe, (Assign(x, ite(x < 2, x + 1, x)),), (Assign(both, FALSE),)),)),
        *turns,
        Assign(both, both & (x == 3)),
        Assign(never, both & (x < 3)),
    )
    return TransitionSystem("long", (sure, maybe), (), (x, both, never), (), step), (both, never)


def wide() -> Group:
    """A state of two words."""
    values = [0, 5, (1 << 60) - 1]
    a, b = var("a", chosen(values)), var("b", chosen(values))
    source, end, never = var("source", chosen(values)), flag("end"), flag("never")
    step = (
        Assign(end, (a == 5) & (b > 5)),
        Assign(never, (a == 7) | (b == 7)),
        Assign(b, a),
        Assign(a, source),
    )
    return TransitionSystem("wide", (source,), (), (a, b, end, never), (), step), (end, never)


def many() -> Group:
    """More states in a level than one batch holds."""
    tag, go, count = var("tag", integer(0, 2500)), flag("go"), var("count", integer(0, 2))
    end, never = flag("end"), flag("never")
    step = (
        Assign(end, (count == 2) & (tag == 2500)),
        Assign(never, (count == 2) & (tag < 0)),
        If(go & (tag > 2), (Assign(count, minimum(count + 1, 2)),)),
    )
    return TransitionSystem("many", (go,), (tag,), (count, end, never), (), step), (end, never)


def overflowing() -> Group:
    """A counter that goes beyond its domain."""
    count, go, never = var("count", integer(0, 6)), flag("go"), flag("never")
    step = (Assign(never, count == 9), If(go & (count < 9), (Assign(count, count + 1),)))
    return TransitionSystem("overflowing", (go,), (), (count, never), (), step), (never,)


def chain() -> Group:
    """A run of twelve ticks, each of which needs an input of its own."""
    place, key, end = var("place", integer(0, 12)), var("key", integer(0, 12)), flag("end")
    step = (
        Assign(place, ite(key == place, minimum(place + 1, 12), ite(key == 12, 0, place))),
        Assign(end, place == 12),
    )
    return TransitionSystem("chain", (key,), (), (place, end), (), step), (end,)


SYSTEMS = (mixed, long, wide, many, overflowing, chain)
