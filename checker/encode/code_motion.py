"""Sinking: the statements of a step that only goals need, moved behind all others.

Whatever such a statement chooses or computes, the state after the tick is the same.  So a search can
store that state first, and then ask of it which goals are reached.
"""

from collections.abc import Iterator

from rovercheck.checker.system.live_variables import Names, live_before
from rovercheck.checker.system.partition import expressions
from rovercheck.checker.system.slice import names
from rovercheck.spec_model.lang.system import Program


def sunk(step: Program, stored: Names) -> tuple[Program, Program]:
    """The step in two parts, to be run one after the other; the second writes nothing that is stored."""
    reads = [names(expressions((s,))) for s in step]
    writes = [s.written for s in step]
    early: set[int] = set()
    while True:
        needed = set(_needed(step, stored, early, writes))
        found = needed | set(_overtaken(needed, reads, writes))
        if found == early:
            first = tuple(s for i, s in enumerate(step) if i in early)
            return first, tuple(s for i, s in enumerate(step) if i not in early)
        early = found


def _needed(step: Program, stored: Names, early: set[int], writes: list[Names]) -> Iterator[int]:
    """The statements that what is stored depends on, and those said to come early: each as a whole."""
    live = stored
    for at in reversed(range(len(step))):
        if at in early or writes[at] & live:
            yield at
            live, _ = live_before((step[at],), live | writes[at])


def _overtaken(early: set[int], reads: list[Names], writes: list[Names]) -> Iterator[int]:
    """Other statements with an early one after them that writes what they read or write."""
    after: set[str] = set()
    for at in reversed(range(len(reads))):
        if at in early:
            after |= writes[at]
        elif not after.isdisjoint(reads[at] | writes[at]):
            yield at
