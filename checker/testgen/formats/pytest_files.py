"""A pytest file that runs the tests against any implementation of a board."""

from collections.abc import Mapping, Sequence

from rovercheck.checker.testgen.formats.expected_outputs import ExpectedTest, rows
from rovercheck.spec_model.abstraction import Board

HEAD = '''"""Covering tests of {board}, made by `rovercheck generate-tests`.

Run them against an implementation with `pytest {file} --impl KIND:WHAT`, by default ours.
"""

import pytest
from rovercheck.checker.adapters import start
from rovercheck.checker.testgen.scripts import steps, unfolded
from rovercheck.spec_model.abstraction import boards

BOARD = boards()["{board}"]
OURS = "{ours}"
NEAR = 1e-6  # in the unit, or as a part of the value: single precision will do

# A test is rows of steps with equal inputs: how many, the inputs that change (of a time stamp: whether the
# datum is new in each of these steps), and the outputs required that change (None: any value will do).
TESTS = {{
'''

TAIL = """}


@pytest.fixture(scope="module")
def implementation(request):
    run = start(request.config.getoption("--impl", None) or OURS, BOARD)
    yield run
    run.close()


@pytest.mark.parametrize("name", TESTS)
def test_outputs(name, implementation):
    rows = TESTS[name]
    inputs = steps(BOARD, unfolded(BOARD, [(held, given) for held, given, _ in rows]))
    required, wrong = {}, {}
    implementation.reset()
    numbers = (row for row in rows for _ in range(row[0]))
    for step, (given, row) in enumerate(zip(inputs, numbers), start=1):
        required |= row[2]
        actual = implementation.step(given)
        wrong = {n: (v, actual[n]) for n, v in required.items() if v is not None and n in actual
                 and abs(actual[n] - v) > NEAR * max(1, abs(v))}
        assert not wrong, f"step {step} ({given['now_ms']} ms), output: (required, actual) {wrong}"
"""

CONFTEST = '''"""The option that names the implementation under test."""


def pytest_addoption(parser):
    parser.addoption("--impl", help="the implementation under test, KIND:WHAT")
'''


def pytest_files(board: Board, tests: Sequence[ExpectedTest]) -> Mapping[str, str]:
    """The file of tests, and the ``conftest.py`` with its option."""
    name = f"test_cover_{board.name}.py"
    head = HEAD.format(board=board.name, file=name, ours=board.supervisor)
    return {name: head + "".join(_test(board, t) for t in tests) + TAIL, "conftest.py": CONFTEST}


def _test(board: Board, test: ExpectedTest) -> str:
    goals = "".join(f"        # {goal}\n" for goal in test.goals)
    shown = "".join(f"        {row!r},\n" for row in rows(board, test))
    return f"    {test.name!r}: [\n{goals}{shown}    ],\n"
