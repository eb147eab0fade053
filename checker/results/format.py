"""A format of output as a record: what users type, what it shows, and what it must be given."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Literal


class Need(StrEnum):
    """What must be worked out before a thing is written in a format."""

    BOARD_STEPS = "board steps"
    """The run as the boards see it."""
    STATE_RUNS = "state runs"
    """A run to every state."""


class Option(StrEnum):
    """What ``render`` takes by keyword, beside the thing to show."""

    EVERYTHING = "everything"
    """Also what the property does not depend on."""
    WIDTH = "width"
    """Columns of the terminal."""
    MOST = "most"
    """Nodes of the largest graph that is drawn."""


Kind = Literal["trace", "statechart", "graph", "problem"]

KINDS: Mapping[Kind, str] = {
    "trace": "rovercheck trace",
    "statechart": "rovercheck graph CHART",
    "graph": "rovercheck graph SYSTEM --project",
    "problem": "rovercheck export",
}
"""What there are formats of, with the command that writes it."""


@dataclass(frozen=True)
class Format:
    """One way to write a thing down; the record stands in the module that writes it.

    ``kind`` is one of ``KINDS``; ``suffix`` is what its files end with; ``summary`` is one line for people.
    ``beside`` names a format whose file is written together with this one's, and whose name ``render`` is
    given as ``dump``.
    """

    name: str
    kind: Kind
    suffix: str
    summary: str
    needs: frozenset[Need] = frozenset()
    takes: frozenset[Option] = frozenset()
    beside: str = ""
