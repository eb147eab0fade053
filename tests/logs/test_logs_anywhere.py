"""Own logs cut at any tick, outputs perturbed at any tick, columns left out: judged, no internal error."""

import csv
from functools import cache
from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.program import NeededInputs
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.logs import ColumnMap, LogResult, examine
from rovercheck.spec_model.abstraction import boards
from rovercheck.spec_model.abstraction.stamps import NOW
from tests.logs.recorded import copied, long_log
from tests.profiles import examples, full

SCENARIOS = Path(__file__).parents[2] / "examples" / "scenarios"
BOARDS = ("board1", "board2")
COLUMNS = [(b.name, name) for b in boards().values() for name in Vocabulary(b).signals]
OUTPUTS = [(b.name, o.name) for b in boards().values() for o in b.outputs]

Text = dict[str, str]


def rows_of(file: Path) -> list[Text]:
    with file.open(encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


@cache
def recorded(board: str) -> tuple[Text, ...]:
    rows = copied(long_log(board))
    return tuple({n: str(int(v) if isinstance(v, bool) else v) for n, v in row.items()} for row in rows)


@pytest.fixture(scope="module")
def obstacle(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Text]]:
    """The logs of both boards when something appears ahead."""
    folder = tmp_path_factory.mktemp("own")
    assert run(["simulate", str(SCENARIOS / "obstacle_stop.toml"), "--log", str(folder), "--no-plot"]) is (
        Exit.AS_EXPECTED
    )
    return {board: rows_of(folder / f"{board}.csv") for board in BOARDS}


def judged(folder: Path, rows: list[Text], board: str, without: tuple[str, ...] = ()) -> LogResult:
    names = [n for n in rows[0] if n not in without]
    file = folder / "log.csv"
    with file.open("w", encoding="utf-8", newline="") as lines:
        table = csv.DictWriter(lines, names, extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)
    return examine(file, ColumnMap(), board)


def test_the_log_of_an_obstacle_that_begins_later(tmp_path: Path, obstacle: dict[str, list[Text]]) -> None:
    """The flag of the step before is a copy: what is asked for is what was copied."""
    found = judged(tmp_path, obstacle["board2"][58:], "board2")
    assert "command" in found.behaviour.compared and not found.deviates and found.start == "any"


@pytest.mark.parametrize("board", BOARDS)
def test_a_good_log_deviates_nowhere_however_it_is_cut(
    board: str, tmp_path: Path, obstacle: dict[str, list[Text]]
) -> None:
    rows = obstacle[board]
    for start in range(1, len(rows) - 1, 41):
        assert not judged(tmp_path, rows[start : start + 6], board).deviates


@pytest.mark.parametrize(("board", "column"), COLUMNS)
def test_a_good_log_deviates_nowhere_whichever_column_is_absent(
    board: str, column: str, tmp_path: Path, obstacle: dict[str, list[Text]]
) -> None:
    """At the beginning or in the middle, in the full suite at both."""
    for start in (0, 230) if full() else (Random(column).choice((0, 230)),):
        found = judged(tmp_path, obstacle[board][start : start + 10], board, (column,))
        assert column == NOW or not found.deviates


STRANGE = ("", "0", "1", "3", "7", "-1", "0.5", "255", "1e17", "-1e30", "1e309", "nan", "CMD_ESTOP", "x")


@pytest.mark.parametrize(("board", "output"), OUTPUTS)
def test_an_output_may_be_anything_at_any_tick(board: str, output: str, tmp_path: Path) -> None:
    random = Random(output)
    for start, count in ((0, 5 if full() else 2), (random.randrange(1, 1800), 1)):
        for _ in range(count):
            rows = [dict(row) for row in recorded(board)[start : start + 12]]
            random.choice(rows)[output] = random.choice(STRANGE)
            judged(tmp_path, rows, board)


@examples(15)
@given(data=st.data(), board=st.sampled_from(BOARDS))
def test_anything_at_once(tmp_path_factory: pytest.TempPathFactory, data: st.DataObject, board: str) -> None:
    names = [n for n in Vocabulary(boards()[board]).signals if n != NOW]
    start = data.draw(st.integers(0, 1900))
    rows = [dict(row) for row in recorded(board)[start : start + data.draw(st.sampled_from([2, 6, 20]))]]
    for _ in range(data.draw(st.integers(0, 3))):
        row = data.draw(st.sampled_from(rows))
        row[data.draw(st.sampled_from(names))] = data.draw(
            st.sampled_from(STRANGE) | st.text(max_size=4) | st.floats().map(str)
        )
    if data.draw(st.booleans()) and len(rows) > 2:
        del rows[1 : data.draw(st.integers(2, len(rows) - 1))]
    without = data.draw(st.lists(st.sampled_from([*names, NOW]), max_size=8, unique=True))
    judged(tmp_path_factory.getbasetemp(), rows, board, tuple(without))


# --- the root of it: what a step asks for --------------------------------------------------------


@cache
def parts(board: str, without: str) -> tuple[LogCone, ...]:
    one = boards()[board]
    vocabulary = Vocabulary(one)
    seen = {name for name, sight in vocabulary.sights.items() if sight.signal.name != without}
    return cones(one, frozenset(seen), frozenset(o.name for o in one.outputs if o.name != without))


@pytest.mark.parametrize(("board", "column"), COLUMNS)
def test_a_step_asks_only_for_what_it_is_given_and_not_twice(board: str, column: str) -> None:
    """Values unknown at random: each one that is asked for is told, until the step is done."""
    random = Random(column)
    for part in parts(board, column):
        state, inputs = part.system.variables, part.system.inputs
        for chance in (0.0, 0.5, 0.9):
            known = {v.name: v.init for v in (*state, *inputs) if random.random() < chance}
            while True:
                given = tuple(known.get(v.name) for v in state), tuple(known.get(v.name) for v in inputs)
                try:
                    part.step(*given)
                    break
                except NeededInputs as needed:
                    assert needed.name not in known, "told, and asked for again"
                    known[needed.name] = random.choice(part.system.var(needed.name).domain.values)
