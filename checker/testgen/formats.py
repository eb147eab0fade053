"""Generated tests as files that others run: a folder of CSV files, a pytest file, a C program."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.board_tests.c_program import c_program, interface
from rovercheck.checker.board_tests.csv_table import csv_table, csv_text
from rovercheck.checker.board_tests.pytest_file import pytest_file
from rovercheck.checker.io.files import csv_cell
from rovercheck.checker.results.board_test import BoardTest

GOALS = "goals.csv"

CONFTEST = '''"""The option that names the implementation under test."""


def pytest_addoption(parser):
    parser.addoption("--impl", help="the implementation under test, KIND:WHAT")
'''


def _csv(board: str, tests: Sequence[BoardTest]) -> Mapping[str, str]:
    """A file for each test, and one that lists the goals of each."""
    pairs = [[test.name, csv_cell(goal)] for test in tests for goal in test.goals]
    files = {f"{test.name}.csv": csv_table(test) for test in tests}
    return {**files, f"{board}_{GOALS}": csv_text([["test", "goal"], *pairs])}


def _pytest(board: str, tests: Sequence[BoardTest]) -> Mapping[str, str]:
    """The file of tests, and the ``conftest.py`` with its option."""
    return {f"test_cover_{board}.py": pytest_file([_title(board)], tests), "conftest.py": CONFTEST}


def _c(board: str, tests: Sequence[BoardTest]) -> Mapping[str, str]:
    """The program, and the header with the functions that it calls."""
    header = f"cover_{board}.h"
    program = c_program([_title(board)], tests, header)
    return {header: interface(tests[0].board), f"cover_{board}.c": program}


def _title(board: str) -> str:
    return f"Covering tests of {board}, made by `rovercheck generate-tests`."


FORMATS: Mapping[str, Callable[[str, Sequence[BoardTest]], Mapping[str, str]]] = {
    "csv": _csv,
    "pytest": _pytest,
    "c": _c,
}
"""What makes the files, by name, of the tests of a board, one at least."""
