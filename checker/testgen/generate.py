"""What a user asks for, as boards and goals: whole boards, or single charts of them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.results.board_test import BoardTest
from rovercheck.checker.system.instrument.goals import CoverGoal, GoalKind
from rovercheck.checker.system.instrument.watch import watched
from rovercheck.checker.testgen.expected_outputs import expected
from rovercheck.checker.testgen.formats import FORMATS
from rovercheck.checker.testgen.keep import KeptTests
from rovercheck.checker.testgen.scripts import steps
from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction import boards as of_the_rover
from rovercheck.spec_model.lang.chart import parts
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean


@dataclass(frozen=True)
class Aim:
    """A board, and the goals to be covered by tests of it."""

    board: Board
    goals: tuple[CoverGoal, ...]


def aims(
    names: Sequence[str], kinds: Iterable[GoalKind], boards: Mapping[str, Board] | None = None
) -> list[Aim]:
    """The goals of boards and charts by name; of all boards if none is named, by default those of the rover.

    Tests are always of a whole board.  Raises ``ModelError`` for a name of no board, chart or block.
    """
    among = of_the_rover() if boards is None else boards
    found = [_aim(board, names, frozenset(kinds)) for board in among.values()]
    known = {*among, *(p.name for b in among.values() for p in parts(b.system.components))}
    for name in names:
        if name not in known:
            raise ModelError(f"{name!r} is no board and no chart of one. {did_you_mean(name, known)}")
    return [aim for aim in found if aim.goals]


def _aim(board: Board, names: Sequence[str], kinds: frozenset[GoalKind]) -> Aim:
    goals = watched(board.system, kinds).goals
    whole = not names or board.name in names
    return Aim(board, goals if whole else tuple(g for g in goals if g.part in names))


def only(kept: KeptTests, goals: Iterable[CoverGoal]) -> KeptTests:
    """What a set of tests says of some goals: tests that reach none of them are left out."""
    wanted = {g.id for g in goals}
    tests = [(name, tuple(g for g in reached if g in wanted), script) for name, reached, script in kept.tests]
    return KeptTests(
        tuple(test for test in tests if test[1]),
        tuple(id for id in kept.shortest if id in wanted),
        {id: why for id, why in kept.uncoverable.items() if id in wanted},
        {id: why for id, why in kept.unknown.items() if id in wanted},
    )


def files(aim: Aim, kept: KeptTests, format: str) -> dict[str, str]:
    """The tests, one at least, as files of a format, by name; the interpreter says what they require."""
    return dict(FORMATS[format](aim.board.name, list(_tests(aim, kept))))


def _tests(aim: Aim, kept: KeptTests) -> Iterator[BoardTest]:
    texts = {g.id: f"{g.id}: {g.text}" for g in aim.goals}
    for name, goals, script in kept.tests:
        yield expected(aim.board, name, steps(aim.board, script), [texts[g] for g in goals])
