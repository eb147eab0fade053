"""Faults put into the explicit engine on purpose: the comparison with the naive search sees each of them.

The comparison asks for verdicts, lengths of runs, runs that replay, and the very set of valuations.
Every fault is first shown to be one: without it the same systems agree.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import pytest

from checker.encode import native
from checker.encode.native import Field, Layout, OutsideDomain, body, quiet, retrace, search, table
from checker.encode.native.expressions import BIT, INT, Expressions
from checker.engine import Limits, Timers
from checker.engine import quiet as silent
from checker.engines import explicit
from checker.engines.explicit import levels, parents, runs
from checker.partition import Partition, partitions
from checker.verdict import Answer, Exhausted, Reached, Unreachable
from spec_model.lang.action import Assign, If
from spec_model.lang.domain import chosen, integer
from spec_model.lang.expr import Op, Var, all_of, const, flag, ite, var
from spec_model.lang.system import Statement, TransitionSystem
from spec_model.lang.words import minimum
from tests import naive

Fault = Callable[[pytest.MonkeyPatch], None]
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
        _compare(system, goal, answers[goal.name], expected)


def _compare(system: TransitionSystem, goal: Var, answer: Answer, expected: naive.Searched) -> None:
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
            must(because.skipped or because.states == len(states), f"{because.states} valuations")
            must(because.closed is None or _closed(because) == states, "other valuations")
        case _:
            raise Differs(answer)


def _closed(because: Exhausted) -> set[naive.State]:
    assert because.closed is not None
    found = set()
    for row in because.closed.words.tolist():
        raw = {
            p.var.name: (row[p.word] >> p.shift & (1 << p.bits) - 1) * p.stride + p.var.domain.low
            for p in because.closed.places
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


def wide() -> Group:
    """A valuation of two words."""
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
    """More valuations in a level than one batch holds."""
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


SYSTEMS = (mixed, wide, many, overflowing, chain)


@pytest.mark.parametrize("made", SYSTEMS)
def test_without_a_fault_all_agree(made: Callable[[], Group]) -> None:
    compare(made)


# --- faults ------------------------------------------------------------------------------------------


def an_input_cell_is_dropped(patch: pytest.MonkeyPatch) -> None:
    def fewer(system: TransitionSystem) -> dict[str, Partition]:
        return {n: replace(p, cells=p.cells[:-1] or p.cells) for n, p in partitions(system).items()}

    patch.setattr(search, "partitions", fewer)


def cells_are_merged(patch: pytest.MonkeyPatch) -> None:
    """The second cell of an input is taken for its first."""

    def fewer(system: TransitionSystem) -> dict[str, Partition]:
        return {n: replace(p, cells=(p.cells[0], *p.cells[2:])) for n, p in partitions(system).items()}

    patch.setattr(search, "partitions", fewer)


def no_domain_is_checked(patch: pytest.MonkeyPatch) -> None:
    for module in (search, retrace):
        patch.setattr(module, "outside", lambda *_: BIT(0))


def a_minimum_is_its_first_argument(patch: pytest.MonkeyPatch) -> None:
    """A counter does not saturate."""

    def number(self: Expressions, op: Op, args: Any) -> Any:
        return self.as_int(args[0]) if op is Op.MIN else real(self, op, args)

    real = Expressions._number
    patch.setattr(Expressions, "_number", number)


def a_batch_is_dropped(patch: pytest.MonkeyPatch) -> None:
    def flush(self: Any) -> None:
        self.build.store(INT(0), self.filled)

    patch.setattr(search._Search, "_flush", flush)


def the_last_batch_is_dropped(patch: pytest.MonkeyPatch) -> None:
    def put(self: Any, name: str, value: Any) -> None:
        real(self, name, INT(0) if name == "filled" else value)

    real = search._Search.put
    patch.setattr(search._Search, "put", put)


def parents_are_off_by_one(patch: pytest.MonkeyPatch) -> None:
    real = parents.Unary.__getitem__
    patch.setattr(parents.Unary, "__getitem__", lambda self, n: max(0, real(self, n) - 1))


def a_parents_bit_is_misplaced(patch: pytest.MonkeyPatch) -> None:
    def note(self: Any, build: Any, parents: Any, index: Any, origin: Any) -> None:
        real(self, build, parents, build.add(index, INT(1)), origin)

    real = table.Table._note_parent
    patch.setattr(table.Table, "_note_parent", note)


def fields_overlap(patch: pytest.MonkeyPatch) -> None:
    def overlapping(variables: Sequence[Var]) -> Layout:
        made = real(variables)
        return replace(made, fields=tuple(replace(f, shift=max(0, f.shift - 1)) for f in made.fields))

    real = native.layout
    patch.setattr(explicit, "layout", overlapping)


def a_low_end_is_forgotten(patch: pytest.MonkeyPatch) -> None:
    """The lowest value is not taken off when a variable is packed."""

    def code(own: Any, f: Field) -> Any:
        build = own.builder
        made = build.load(own.slots[f.var.name].place)
        return build.zext(made, INT) if made.type == BIT else build.udiv(made, INT(f.stride))

    patch.setattr(search, "_code", code)


def a_value_is_never_taken(patch: pytest.MonkeyPatch) -> None:
    def choose(self: body.Body, var_: Var, values: tuple[int, ...]) -> None:
        real(self, var_, values[:1])

    real = body.Body._choose
    patch.setattr(body.Body, "_choose", choose)


def a_fork_restores_nothing(patch: pytest.MonkeyPatch) -> None:
    for module in (search, retrace):
        patch.setattr(module, "saved", lambda program, live: dict.fromkeys(range(1000), ()))


def a_fork_is_missed(patch: pytest.MonkeyPatch) -> None:
    """Going back to a fork, the program never takes another value."""

    def advance(self: body.Body, back: Any, kept: Any, resume: Any) -> None:
        self.builder.position_at_end(back)
        self.builder.branch(self.back)

    patch.setattr(body.Body, "_advance", advance)


def the_else_branch_is_lost(patch: pytest.MonkeyPatch) -> None:
    def branch(self: body.Body, condition: Any, then: Any, otherwise: Any) -> None:
        real(self, condition, then, ())

    real = body.Body._branch
    patch.setattr(body.Body, "_branch", branch)


def all_is_known(patch: pytest.MonkeyPatch) -> None:
    """The table says "known" whenever another valuation lies where one belongs."""
    patch.setattr(table.Table, "_same", lambda *_: BIT(1))


def nothing_is_known(patch: pytest.MonkeyPatch) -> None:
    """The table never recognises a valuation; the search ends all the same, by its depth."""
    patch.setattr(table.Table, "_same", lambda *_: BIT(0))
    patch.setattr(
        explicit, "Search", lambda n, limits, *rest: levels.Search(n, replace(limits, depth=4), *rest)
    )


def only_the_first_word_is_compared(patch: pytest.MonkeyPatch) -> None:
    def hashed(self: Any, build: Any, key: Any) -> Any:
        return real(self, build, key[:1])

    def same(self: Any, build: Any, a: Any, entry: Any, key: Any, mixed_: Any) -> Any:
        mark = build.and_(mixed_, INT((1 << 32) - 1))
        return build.icmp_unsigned("==", build.lshr(entry, INT(32)), mark) if self.words > 1 else one(
            self, build, a, entry, key, mixed_
        )  # fmt: skip

    real, one = table.Table.hash, table.Table._same
    patch.setattr(table.Table, "hash", hashed)
    patch.setattr(table.Table, "_same", same)


def a_goal_is_overlooked(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(search._Search, "_goals", lambda self: None)


def goals_are_mixed_up(patch: pytest.MonkeyPatch) -> None:
    def hit(self: Any, number: int, value: Any) -> None:
        real(self, 0, value)

    real = search._Search._hit
    patch.setattr(search._Search, "_hit", hit)


def a_level_is_taken_for_the_one_before(patch: pytest.MonkeyPatch) -> None:
    def line(self: runs.Runs, last: int, level: int) -> Any:
        return real(self, last, level)[:-1] or real(self, last, level)

    real = runs.Runs.line
    patch.setattr(runs.Runs, "line", line)


def rehashing_forgets(patch: pytest.MonkeyPatch) -> None:
    def rehash(self: Any, table_: Any, words: Any, count: int) -> None:
        real(self, table_, words, count // 2)

    real = native.NativeSearch.rehash
    patch.setattr(native.NativeSearch, "rehash", rehash)
    patch.setattr(explicit, "Search", _small)


def _small(*args: Any) -> levels.Search:
    """A search whose table must grow at once."""
    made = levels.Search(*args)
    made.store.table = made.store.table[:8].copy()
    return made


FAULTS: tuple[Fault, ...] = (
    an_input_cell_is_dropped,
    cells_are_merged,
    no_domain_is_checked,
    a_minimum_is_its_first_argument,
    a_batch_is_dropped,
    the_last_batch_is_dropped,
    parents_are_off_by_one,
    a_parents_bit_is_misplaced,
    fields_overlap,
    a_low_end_is_forgotten,
    a_value_is_never_taken,
    a_fork_restores_nothing,
    a_fork_is_missed,
    the_else_branch_is_lost,
    all_is_known,
    nothing_is_known,
    only_the_first_word_is_compared,
    a_goal_is_overlooked,
    goals_are_mixed_up,
    a_level_is_taken_for_the_one_before,
    rehashing_forgets,
)


def differences() -> Iterator[str]:
    """The systems on which the engine and the naive search differ."""
    for made in SYSTEMS:
        try:
            compare(made)
        except Differs:
            yield made.__name__


@pytest.mark.parametrize("fault", FAULTS, ids=lambda f: f.__name__)
def test_a_fault_is_seen(fault: Fault, monkeypatch: pytest.MonkeyPatch) -> None:
    fault(monkeypatch)
    assert list(differences())


# --- faults of what only some searches use -----------------------------------------------------------


def test_a_small_table_is_no_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    """What ``rehashing_forgets`` adds to the fault does no harm alone."""
    monkeypatch.setattr(explicit, "Search", _small)
    assert not list(differences())


def waiting() -> Group:
    """Two ages that start at different times."""
    go, stop = flag("go"), flag("stop")
    a, b, end, never = var("a", integer(0, 9)), var("b", integer(0, 7)), flag("end"), flag("never")
    step = (
        If((a > 0) | go, (Assign(a, minimum(a + 1, 9)),)),
        If((b > 0) | stop, (Assign(b, minimum(b + 1, 7)),)),
        Assign(end, (a == 9) & (b == 5)),
        Assign(never, (a == 9) & (b > 7)),
    )
    return TransitionSystem("waiting", (go, stop), (), (a, b, end, never), (), step), (end, never)


def test_quiet_ticks_without_a_fault() -> None:
    compare(waiting, Timers.SKIP)


@pytest.mark.parametrize("lost", ["every line", "a step"])
def test_a_fault_of_quiet_ticks_is_seen(lost: str, monkeypatch: pytest.MonkeyPatch) -> None:
    real = quiet.emit_moved_on

    def moved(build: Any, words: Sequence[Any], shifts: Sequence[quiet.Shift]) -> Any:
        if lost == "a step":
            return real(build, words, [replace(s, by=2 * s.by) for s in shifts])
        return real(build, words, shifts)

    monkeypatch.setattr(search, "emit_moved_on", moved)
    if lost == "every line":
        monkeypatch.setattr(search._Search, "_move_on", lambda self: None)
        with pytest.raises(Differs):
            compare(waiting, Timers.SKIP)
    else:  # nothing is expected where nothing leads to: all is stored, and nothing is lost
        compare(waiting, Timers.SKIP)


def test_a_constant_of_the_comparison() -> None:
    """The comparison itself tells a wrong number of valuations from a right one."""
    system, goals = chain()
    longer = replace(system, step=(*system.step, Assign(goals[0], const(False))))
    with pytest.raises(Differs):
        _compare(
            system,
            goals[0],
            explicit.check(longer, goals, Limits(), silent)["end"],
            naive.search(system, goals),
        )
