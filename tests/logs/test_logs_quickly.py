"""Rows that are taken together say what the same rows say one by one, whatever is wrong with a log."""

from collections.abc import Sequence
from dataclasses import replace
from decimal import Context, Decimal, localcontext
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.conformance.cones import LogCone, cones
from rovercheck.checker.conformance.decoder import InputDecoder
from rovercheck.checker.conformance.follower import Behaviour, BoardFollower
from rovercheck.checker.conformance.lookahead import EXACT
from rovercheck.checker.conformance.mismatch import LogMismatch
from rovercheck.checker.conformance.program import Known, Number, _div, _mod
from rovercheck.checker.conformance.recording import LogBlock, Raw
from rovercheck.checker.conformance.signals import Vocabulary
from rovercheck.checker.conformance.tracker import TrackedRow, Tracker
from rovercheck.checker.logs import ColumnMap
from rovercheck.checker.logs.log import LogLayout, open_log
from rovercheck.spec_model.abstraction import boards
from tests.logs.recorded import Row, frozen, late, record, swapped, written
from tests.profiles import examples

BOARDS = ("board1", "board2")


def parts_of(layout: LogLayout, seen: frozenset[str]) -> tuple[LogCone, ...]:
    vocabulary = Vocabulary(boards()[layout.board])
    return cones(vocabulary.board, seen, layout.signals - vocabulary.inputs)


def followed(file: Path, plainly: bool, lengths: Sequence[int] = ()) -> tuple[list[object], Behaviour]:
    """What is heard of a log meanwhile, and said at the end; ``plainly``: row by row."""
    log = open_log(file, ColumnMap())
    blocks = [piece for block in log.blocks() for piece in cut(block, lengths)]
    from_power_up = log.start == "power-up"
    decoder = InputDecoder(Vocabulary(boards()[log.layout.board]), log.layout.signals, from_power_up)
    parts = [replace(part) for part in parts_of(log.layout, decoder.seen)]
    heard: list[object] = []
    follower = BoardFollower(
        parts, {}, decoder.seen, from_power_up, (lambda *_: None) if plainly else None, watched=True
    )
    follower.heard = heard.extend
    for block in blocks:
        follower.block(block, decoder.decode(block))
    return heard, follower.end()


def cut(block: LogBlock, lengths: Sequence[int]) -> list[LogBlock]:
    """The rows of a block as several."""
    found, start = [], 0
    for end in [*(n for n in lengths if n < len(block)), len(block)]:
        part = slice(start, end)
        values = {name: cells[part] for name, cells in block.values.items()}
        found.append(LogBlock(block.lines[part], block.ticks[part], block.missing[part], values))
        start = end
    return found


def spoil(rows: list[Row], board: str, random: Random) -> list[Row]:
    """Some of what may be wrong with a log."""
    one = boards()[board]
    outputs = [o.name for o in one.outputs if o.name in rows[0]]
    inputs = [s.name for s in one.inputs if s.name != "now_ms"]
    for _ in range(random.choice((0, 1, 5, 40))):
        row, name = random.choice(rows), random.choice(outputs)
        row[name] = random.choice((0, 1, 2, 3, 0.5, -1, 250))
    for _ in range(random.choice((0, 0, 1, 4))):
        first, name = random.randrange(len(rows)), random.choice([*outputs, *inputs])
        cell = random.choice((1e12, float("nan"), 1 / 3, 7.25))
        for row in rows[first : first + random.choice((1, 2, 30))]:
            row[name] = cell
    kind = random.randrange(6)
    if kind == 0:
        late(rows, random.choice(outputs))
    elif kind == 1:
        swapped(rows, *random.sample(outputs, 2))
    elif kind == 2:
        frozen(rows, outputs, len(rows) // 3, len(rows) // 2)
    elif kind == 3:
        name = random.choice(outputs)
        for row in rows[len(rows) // 4 :]:
            row[name] = 1
    if random.random() < 0.4:
        rows = rows[random.randrange(30) :]
    if random.random() < 0.4:
        first = random.randrange(len(rows) // 2)
        rows = [*rows[:first], *rows[first + random.choice((1, 3, 9)) :]]
    return rows


@pytest.mark.parametrize("board", BOARDS)
@examples(4)
@given(seed=st.integers(0, 10**6))
def test_rows_taken_together_say_what_they_say_one_by_one(
    tmp_path_factory: pytest.TempPathFactory, board: str, seed: int
) -> None:
    """The same mismatches in the same order, deviations, evidence, situations and parts that are open."""
    random, one = Random(seed), boards()[board]
    rows = spoil(record(one, 110, seed, random.choice((0.01, 0.05, 0.3))), board, random)
    names = [s.name for s in one.inputs if s.name != "now_ms"] + [o.name for o in one.outputs]
    without = random.sample(names, random.choice((0, 0, 0, 1)))
    file = written(tmp_path_factory.mktemp("log"), rows, without)
    lengths = sorted(random.sample(range(1, 50), random.choice((0, 2, 6))))
    assert followed(file, False, lengths) == followed(file, True)


@pytest.mark.parametrize("board", BOARDS)
def test_a_good_log_is_taken_together_nearly_throughout(
    board: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing but the first rows, if any, is gone through one by one."""
    rows = record(boards()[board], 400)
    one_by_one: list[int] = []
    step = Tracker.step

    def noted(tracker: Tracker, row: TrackedRow) -> LogMismatch | None:
        one_by_one.append(row.tick)
        return step(tracker, row)

    monkeypatch.setattr(Tracker, "step", noted)
    followed(written(tmp_path, rows), False)
    assert len(one_by_one) <= 4


@pytest.mark.parametrize("board", BOARDS)
@examples(3)
@given(random=st.randoms(use_true_random=False))
def test_the_quick_step_is_the_step(board: str, random: Random) -> None:
    """Of every part, with values between those of the domains, as fractions and as decimals."""
    vocabulary = Vocabulary(boards()[board])
    outputs = frozenset(o.name for o in vocabulary.board.outputs)
    for part in cones(vocabulary.board, frozenset(vocabulary.sights), outputs):
        state: Known = tuple(v.init for v in part.system.variables)
        for _ in range(15):
            values: list[Raw] = [random.choice(v.domain.values) for v in part.system.inputs]
            between = [i for i, v in enumerate(part.system.inputs) if len(v.domain) > 2]
            if between and not any("mask" in part.system.inputs[i].name for i in between):
                values[random.choice(between)] += Fraction(random.randrange(8), 8)
            alike = [v if like is None else like[v] for v, like in zip(values, part.likes, strict=True)]
            wanted = part.step(state, tuple(values))
            assert part.quick_step(state, tuple(values)) == wanted
            assert part.step(state, tuple(alike)) == wanted
            with localcontext(EXACT) as exact:

                def quick(value: Raw | None, exact: Context = exact) -> Number:
                    if not isinstance(value, Fraction):
                        return value
                    return exact.divide(value.numerator, value.denominator)

                found = part.quick_step(tuple(map(quick, state)), tuple(map(quick, values)))
            assert found == wanted
            state = wanted[0]


@pytest.mark.parametrize("a", [-7, -4, 0, 4, 7])
@pytest.mark.parametrize("b", [-3, 3])
def test_decimals_are_divided_as_whole_numbers_are(a: int, b: int) -> None:
    with localcontext(EXACT):
        assert (_mod(Decimal(a), b), _div(Decimal(a), b)) == (a % b, a // b)
        half = Fraction(2 * a + 1, 2)
        assert _mod(Decimal(2 * a + 1) / 2, b) == half % b
        assert _div(Decimal(2 * a + 1) / 2, b) == half // b
