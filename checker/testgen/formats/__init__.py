"""Tests as files that others run: a folder of CSV files, a pytest file, a C program."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.testgen.formats import csv_files, pytest_files
from rovercheck.checker.testgen.formats.c_files import c_files
from rovercheck.checker.testgen.formats.expected_outputs import ExpectedTest
from rovercheck.spec_model.abstraction import Board

Write = Callable[[Board, Sequence[ExpectedTest]], Mapping[str, str]]
"""The files, by name, that tests of a board become."""

FORMATS: Mapping[str, Write] = {
    "csv": csv_files.csv_files,
    "pytest": pytest_files.pytest_files,
    "c": c_files,
}

__all__ = ["FORMATS", "ExpectedTest", "Write"]
