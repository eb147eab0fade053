"""Quiet ticks on packed states: every running counter moves on by one step, nothing else changes.

A tick that makes a counter reach its end is no quiet one: what it leads to is an event worth storing.
So two states never move on to the same one, and the quiet ticks from a state are one line.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from rovercheck.checker.encode.counters import Counter
from rovercheck.checker.encode.native.expressions import BIT, INT
from rovercheck.checker.encode.native.layout import Layout

NOTHING = -1
"""A word that no state packs to."""


@dataclass(frozen=True)
class Shift:
    """A counter in a word: it runs while its bits are neither 0 nor ``top``, and moves by ``by``."""

    word: int
    shift: int
    mask: int
    by: int
    top: int


def shifts(layout: Layout, counters: Iterable[Counter]) -> tuple[Shift, ...]:
    """Where the counters lie in a packed state; those that do not move by whole bits are left out."""
    moved = {c.var.name: c.by for c in counters}
    found = []
    for f in layout.fields:
        by, rest = divmod(moved.get(f.var.name, 0), f.stride)
        if by and not rest:
            found.append(Shift(f.word, f.shift, f.mask, by, f.most))
    return tuple(found)


def moved_on(words: Sequence[int], shifts: Sequence[Shift]) -> tuple[int, ...] | None:
    """The state after a quiet tick; None where no counter runs or one would reach its end."""
    result = list(words)
    runs = False
    for s in shifts:
        code = words[s.word] >> s.shift & s.mask
        if 0 < code < s.top:
            if not 0 < code + s.by < s.top:
                return None
            result[s.word] += s.by << s.shift
            runs = True
    return tuple(result) if runs else None


def emit_moved_on(build: Any, words: Sequence[Any], shifts: Sequence[Shift]) -> list[Any]:
    """Emit ``moved_on``; its first word is ``NOTHING`` where there is no state."""
    result, runs, ends = list(words), BIT(0), BIT(0)
    for s in shifts:
        code = build.and_(build.lshr(words[s.word], INT(s.shift)), INT(s.mask))
        running = _inside(build, code, s)
        over = build.not_(_inside(build, build.add(code, INT(s.by)), s))
        runs, ends = build.or_(runs, running), build.or_(ends, build.and_(running, over))
        step = build.select(running, INT(s.by << s.shift), INT(0))
        result[s.word] = build.add(result[s.word], step)
    defined = build.and_(runs, build.not_(ends))
    return [build.select(defined, result[0], INT(NOTHING)), *result[1:]]


def _inside(build: Any, code: Any, s: Shift) -> Any:
    above = build.icmp_signed(">", code, INT(0))
    return build.and_(above, build.icmp_signed("<", code, INT(s.top)))
