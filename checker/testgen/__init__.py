"""Tests that cover the charts: the goals, the runs that reach them, and the set kept with the project."""

from importlib.resources import files

from rovercheck.checker.testgen.keep import read
from rovercheck.checker.testgen.scripts import Test
from rovercheck.spec_model.abstraction import boards

__all__ = ["Test", "kept"]


def kept(board_name: str) -> list[Test]:
    """The covering tests of a board that are kept with the project, each with the goals it reaches.

    Raises ``KeyError`` for an unknown board.
    """
    return read(boards()[board_name], kept_text(board_name))


def kept_text(board_name: str) -> str:
    """The file that holds them."""
    text: str = files(__package__).joinpath("kept", f"{board_name}.json").read_text(encoding="utf-8")
    return text
