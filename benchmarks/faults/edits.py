"""Slips of the pen in a chart or a block, for faults that are put in by hand."""

from collections.abc import Callable
from dataclasses import replace

from rovercheck.spec_model.lang.chart import Block, Chart
from rovercheck.spec_model.lang.edit import edit_state, entry

ChartEdit = Callable[[Chart], Chart]
BlockEdit = Callable[[Block], Block]
PartEdit = Callable[[Chart | Block], Chart | Block]


def of_chart(edit: ChartEdit) -> PartEdit:
    """The edit of a part that is a chart."""

    def change(part: Chart | Block) -> Chart:
        assert isinstance(part, Chart)
        return edit(part)

    return change


def of_block(edit: BlockEdit) -> PartEdit:
    """The edit of a part that is a function block."""

    def change(part: Chart | Block) -> Block:
        assert isinstance(part, Block)
        return edit(part)

    return change


def no_entry(name: str, position: int = 0) -> ChartEdit:
    """One entry action of a state forgotten, counted from 0."""
    return lambda c: entry(c, name, lambda acts: (*acts[:position], *acts[position + 1 :]))


def no_during(name: str) -> ChartEdit:
    """The during actions of a state forgotten."""
    return lambda c: edit_state(c, name, lambda s: replace(s, during=()))


def no_exit(name: str) -> ChartEdit:
    """The exit actions of a state forgotten."""
    return lambda c: edit_state(c, name, lambda s: replace(s, exit=()))
