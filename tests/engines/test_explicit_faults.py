"""Faults put into the explicit engine on purpose: the comparison with the naive search sees each of them.

The comparison asks for verdicts, lengths of runs, runs that replay, and the very set of states.
Without a fault the same systems agree.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import Any

import pytest

from rovercheck.checker.encode import native, path_statements, paths
from rovercheck.checker.encode.native import Field, Layout, body, expressions, quiet, retrace, search, table
from rovercheck.checker.encode.native.expressions import BIT, INT
from rovercheck.checker.engines import Limits, Timers, explicit
from rovercheck.checker.engines import quiet as silent
from rovercheck.checker.engines.explicit import answers, levels, parents, runs
from rovercheck.checker.system.partition import Partition, partitions
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Var, const, flag, var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.words import minimum
from tests import naive
from tests.engines.compared import SYSTEMS, Differs, Group, chain, compare, must_agree
from tests.faults import PatchSuite

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
    first = {Op.MIN: lambda emit, args: emit.as_int(args[0])}
    patch.setattr(expressions, "OPERATIONS", {**expressions.OPERATIONS, **first})


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

    real = table.StateTable._note_parent
    patch.setattr(table.StateTable, "_note_parent", note)


def fields_overlap(patch: pytest.MonkeyPatch) -> None:
    def overlapping(variables: Sequence[Var]) -> Layout:
        made = real(variables)
        return replace(made, fields=tuple(replace(f, shift=max(0, f.shift - 1)) for f in made.fields))

    real = native.layout
    patch.setattr(answers, "layout", overlapping)


def a_low_end_is_forgotten(patch: pytest.MonkeyPatch) -> None:
    """The lowest value is not taken off when a variable is packed."""

    def code(own: Any, f: Field) -> Any:
        build = own.builder
        made = build.load(own.slots[f.var.name].place)
        return build.zext(made, INT) if made.type == BIT else build.udiv(made, INT(f.stride))

    patch.setattr(search, "_code", code)


def a_value_is_never_taken(patch: pytest.MonkeyPatch) -> None:
    def choose(self: body.Body, var_: Var, values: tuple[int, ...], span: object) -> None:
        real(self, var_, values[:1], None)

    real = body.Body._choose
    patch.setattr(body.Body, "_choose", choose)


def a_fork_restores_nothing(patch: pytest.MonkeyPatch) -> None:
    for module in (search, retrace):
        patch.setattr(module, "saved", lambda program, live: dict.fromkeys(range(1000), ()))


def a_fork_is_missed(patch: pytest.MonkeyPatch) -> None:
    """Going back to a fork, the program never takes another value."""

    def advance(self: body.Body, back: Any, kept: Any, resume: Any, over: Any) -> None:
        self.builder.position_at_end(back)
        self.builder.branch(over)

    patch.setattr(body.Body, "_advance", advance)


def a_sure_choice_takes_one_value(patch: pytest.MonkeyPatch) -> None:
    def each(self: body.Body, statement: path_statements.Each) -> None:
        real(self, replace(statement, span=(const(0), const(1))))

    real = body.Body._each
    patch.setattr(body.Body, "_each", each)


def other_choices_of_a_round_are_overlooked(patch: pytest.MonkeyPatch) -> None:
    """A loop over the values of one input takes no other choice of its round into account."""

    def alone(program: Iterable[object]) -> Iterator[object]:
        return (replace(s, alone=True) if isinstance(s, path_statements.Each) else s for s in program)

    patch.setattr(paths, "_alone", alone)


def hashes_are_those_of_others(patch: pytest.MonkeyPatch) -> None:
    def place(self: Any, build: Any, i: Any) -> Any:
        return real(self, build, build.lshr(i, INT(1)))

    real = table._Hashes._place
    patch.setattr(table._Hashes, "_place", place)


def the_else_branch_is_lost(patch: pytest.MonkeyPatch) -> None:
    def branch(self: body.Body, condition: Any, then: Any, otherwise: Any) -> None:
        real(self, condition, then, ())

    real = body.Body._branch
    patch.setattr(body.Body, "_branch", branch)


def all_is_known(patch: pytest.MonkeyPatch) -> None:
    """The table says "known" whenever another state lies where one belongs."""
    patch.setattr(table.StateTable, "_same", lambda *_: BIT(1))


def nothing_is_known(patch: pytest.MonkeyPatch) -> None:
    """The table never recognises a state; the search ends all the same, by its depth."""
    patch.setattr(table.StateTable, "_same", lambda *_: BIT(0))
    patch.setattr(
        answers,
        "LevelSearch",
        lambda n, limits, *rest: levels.LevelSearch(n, replace(limits, depth=4), *rest),
    )


def only_the_first_word_is_compared(patch: pytest.MonkeyPatch) -> None:
    def hashed(self: Any, build: Any, key: Any) -> Any:
        return real(self, build, key[:1])

    def same(self: Any, build: Any, a: Any, entry: Any, key: Any, mixed_: Any) -> Any:
        mark = build.and_(mixed_, INT((1 << 32) - 1))
        return build.icmp_unsigned("==", build.lshr(entry, INT(32)), mark) if self.words > 1 else one(
            self, build, a, entry, key, mixed_
        )  # fmt: skip

    real, one = table.StateTable.hash, table.StateTable._same
    patch.setattr(table.StateTable, "hash", hashed)
    patch.setattr(table.StateTable, "_same", same)


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
    patch.setattr(answers, "LevelSearch", _small)


def _small(*args: Any) -> levels.LevelSearch:
    """A search whose table must grow at once."""
    made = levels.LevelSearch(*args)
    made.store.table = made.store.table[:8].copy()
    return made


def differences() -> Iterator[str]:
    """The systems on which the engine and the naive search differ."""
    for made in SYSTEMS:
        try:
            compare(made)
        except Differs:
            yield made.__name__


class TestExplicit(PatchSuite):
    FAULTS = (
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
        a_sure_choice_takes_one_value,
        other_choices_of_a_round_are_overlooked,
        hashes_are_those_of_others,
        the_else_branch_is_lost,
        all_is_known,
        nothing_is_known,
        only_the_first_word_is_compared,
        a_goal_is_overlooked,
        goals_are_mixed_up,
        a_level_is_taken_for_the_one_before,
        rehashing_forgets,
    )

    def wrong(self) -> Iterator[str]:
        return differences()


# --- faults of what only some searches use -----------------------------------------------------------


def test_a_small_table_is_no_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    """What ``rehashing_forgets`` adds to the fault does no harm alone."""
    monkeypatch.setattr(answers, "LevelSearch", _small)
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
    """The comparison itself tells a wrong number of states from a right one."""
    system, goals = chain()
    longer = replace(system, step=(*system.step, Assign(goals[0], const(False))))
    with pytest.raises(Differs):
        must_agree(
            system,
            goals[0],
            explicit.check(longer, goals, Limits(), silent)["end"],
            naive.search(system, goals),
        )
