"""Tests as a pytest file that runs any implementation of their boards."""

import json
import textwrap
from collections.abc import Iterable, Iterator, Sequence

from rovercheck.checker.board_tests.rows import Moment, by_board, clock_of, rows, start_ms
from rovercheck.checker.results.board_test import BoardTest, BoardUnderTest

WIDTH = 106

HEAD = '''"""{about}

It runs {names}:

    ROVERCHECK_IMPL=KIND:WHAT pytest THIS_FILE{only}

or `pytest --impl KIND:WHAT` where the option is known, as beside the files of `rovercheck generate-tests`.
"""

import os
from contextlib import ExitStack, closing
from functools import cache
from math import isclose
{paths}
import pytest
from rovercheck.checker.adapters import start
{boards}
CLOCK, TICK_MS, CLOCK_ENDS = {clock}, {tick_ms}, 2**32
NEAR = 1e-6  # in the unit, or as a part of the value: single precision will do
IMPLEMENTATIONS = {{
{implementations}}}

# Of each board the tests by name: the time of the first step, and rows of steps with equal inputs.  A row is
# how many, the inputs that change (of a time stamp: how many ms before each of these steps its datum came,
# None where none comes), and the outputs required that change (None: any value).
TESTS = {{
'''

TAIL = '''}


def played(board, now, rows):
    """The inputs of each step, and the outputs required after it."""
    stamps = {s.name for s in board.inputs if s.stamp}
    at, lags, required = board.at_power_up(), {}, {}
    for count, given, wanted in rows:
        lags |= {name: value for name, value in given.items() if name in stamps}
        at |= {name: value for name, value in given.items() if name not in stamps}
        required |= wanted
        for _ in range(count):
            renewed = {name: (now - lag) % CLOCK_ENDS for name, lag in lags.items() if lag is not None}
            at |= {CLOCK: now} | renewed
            yield dict(at), {name: value for name, value in required.items() if value is not None}
            now = (now + TICK_MS) % CLOCK_ENDS


def near(required, actual):
    return actual is not None and isclose(required, actual, rel_tol=NEAR, abs_tol=NEAR)


@pytest.fixture(scope="module")
def started(request):
    """The implementation of a board, started once."""
    named = request.config.getoption("--impl", None) or os.environ.get("ROVERCHECK_IMPL")
    with ExitStack() as stack:
        yield cache(lambda board: stack.enter_context(
            closing(start(named or IMPLEMENTATIONS[board], boards()[board]))
        ))


@pytest.mark.parametrize(("board", "name"), [(board, name) for board in TESTS for name in TESTS[board]])
def test_outputs(board, name, started):
    implementation, seen = started(board), set()
    implementation.reset()
    for step, (inputs, required) in enumerate(played(boards()[board], *TESTS[board][name]), start=1):
        actual = implementation.step(inputs)
        seen |= actual.keys()  # what it never gives is not compared
        wrong = {n: (v, actual.get(n)) for n, v in required.items()
                 if n in seen and not near(v, actual.get(n))}
        assert not wrong, f"step {step} ({inputs[CLOCK]} ms), output: (required, actual) {wrong}"
'''


OF_THE_ROVER = "from rovercheck.spec_model.abstraction import boards\n"
OF_A_MODEL = """from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.model.load import load

MODEL = {path}


@cache
def boards():
    return {{name: of_model(load(MODEL), name) for name in TESTS}}

"""


def pytest_file(about: Sequence[str], tests: Sequence[BoardTest]) -> str:
    """The text of the file; ``about`` are the paragraphs with which it begins."""
    of_board, model = by_board(tests), tests[0].board.model
    head = HEAD.format(
        about="\n\n".join(textwrap.fill(_quotable(text), WIDTH) for text in about),
        names=_run_by(of_board),
        only=f" -k {tests[0].board.name}" if len(of_board) > 1 else "",
        paths="from pathlib import Path\n" if model else "",
        boards=OF_A_MODEL.format(path=f"Path({_text(model)})") if model else OF_THE_ROVER,
        clock=_text(clock_of(tests[0].board.inputs)),
        tick_ms=tests[0].board.tick_ms,
        implementations="".join(f"    {_text(b.name)}: {_text(b.implementation)},\n" for b in of_board),
    )
    shown = (
        f"    {_text(board.name)}: {{\n{''.join(map(_test, found))}    }},\n"
        for board, found in of_board.items()
    )
    return head + "".join(shown) + TAIL


def _run_by(boards: Iterable[BoardUnderTest]) -> str:
    named = " and ".join(f"`{_quotable(b.implementation)}`" for b in boards if b.implementation)
    return f"{named}.  For another" if named else "the implementation that is named"


def _test(test: BoardTest) -> str:
    goals = "".join(f"            # {' '.join(goal.split())}\n" for goal in test.goals)
    return f"        {_text(test.name)}: ({start_ms(test)}, [\n{goals}{''.join(_rows(test))}        ]),\n"


def _rows(test: BoardTest) -> Iterator[str]:
    """Each row below the steps and the time that it stands for."""
    first, start = 1, start_ms(test)
    for count, given, required in rows(test):
        last = first + count - 1
        steps = f"steps {first} to {last}" if count > 1 else f"step {first}"
        yield f"            # {steps}, from {start + (first - 1) * test.board.tick_ms} ms\n"
        row = f"({count}, {_values(given)}, {_values(required)}),"
        lines = textwrap.wrap(row, WIDTH - 12, break_long_words=False, break_on_hyphens=False)
        yield textwrap.indent("\n ".join(lines), " " * 12) + "\n"
        first = last + 1


def _values(values: Moment) -> str:
    return f"{{{', '.join(f'{_text(name)}: {value!r}' for name, value in values.items())}}}"


def _text(shown: str) -> str:
    return json.dumps(shown)


def _quotable(text: str) -> str:
    """Text that can stand in a documentation string."""
    return text.replace("\\", "\\\\").replace('"', "'")
