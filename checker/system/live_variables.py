"""Live-variable analysis: names whose value before a program can matter after it, and what it does for them.

Names are bits of a number while programs are gone through, once for each name that turns out to be live.
"""

import threading
from collections.abc import Iterable, Sequence
from typing import NamedTuple, cast

from rovercheck.spec_model.lang.action import If
from rovercheck.spec_model.lang.system import Program, Statement

Names = frozenset[str]

_KEPT = 20_000
"""Statements that are remembered as bits: systems share them, and questions ask of one system in turn."""


class LiveCycle(NamedTuple):
    """What is live at the tick boundary, the program without the rest, and all that this reads and writes."""

    live: Names
    program: Program
    read: Names
    written: Names


def live_before(program: Program, after: Names) -> tuple[Names, Program]:
    """Names whose value before the program can matter to the names ``after`` it, and the program
    without the statements that cannot matter."""
    bits = _Bits.shared()
    nodes, wanted = bits.nodes(program), bits.of(after)
    live, _ = _before(nodes, wanted)
    return bits.names(live), _kept(nodes, wanted).program


def live_cycle(program: Program, wanted: Names, always: Names, outlive: Names) -> LiveCycle:
    """What matters to the ``wanted`` names after some tick, if the values of those that ``outlive`` a tick
    are there in the next, in which the names that are ``always`` live may be read too."""
    bits = _Bits.shared()
    nodes, goals, live, own = bits.nodes(program), bits.of(wanted), bits.of(always), bits.of(outlive)
    while True:
        after = goals | (live & own)
        before, _ = _before(nodes, after)
        if not before & ~live:
            kept = _kept(nodes, after)
            return LiveCycle(bits.names(live), kept.program, bits.names(kept.read), bits.names(kept.written))
        live |= before


class _Node(NamedTuple):
    """A statement: what it writes, what it reads itself, and of a choice its branches."""

    statement: Statement
    written: int
    read: int
    then: "Sequence[_Node] | None"
    otherwise: "Sequence[_Node]"


class _Kept(NamedTuple):
    program: Program
    live: int
    read: int
    written: int


class _Bits:
    """A bit for each name, and the statements that were looked at."""

    _own = threading.local()

    def __init__(self) -> None:
        self._known: dict[str, int] = {}
        self._nodes: dict[int, _Node] = {}
        """By the id of a statement, which is held, so that its id stays its own."""

    @staticmethod
    def shared() -> "_Bits":
        """Those of this thread."""
        found: _Bits | None = getattr(_Bits._own, "bits", None)
        if found is None or len(found._nodes) > _KEPT:
            found = _Bits._own.bits = _Bits()
        return found

    def of(self, names: Iterable[str]) -> int:
        found, known = 0, self._known
        for name in names:
            bit = known.get(name)
            if bit is None:
                bit = known[name] = 1 << len(known)
            found |= bit
        return found

    def names(self, bits: int) -> Names:
        return frozenset(name for name, bit in self._known.items() if bits & bit)

    def nodes(self, program: Program) -> list[_Node]:
        return [self._node(statement) for statement in program]

    def _node(self, statement: Statement) -> _Node:
        known = self._nodes.get(id(statement))
        if known is None:
            known = self._nodes[id(statement)] = self._made(statement)
        return known

    def _made(self, statement: Statement) -> _Node:
        read = self.of(statement.read)
        if not isinstance(statement, If):
            return _Node(statement, self.of((statement.var.name,)), read, None, ())
        then, otherwise = (self.nodes(_program(part)) for part in (statement.then, statement.otherwise))
        written = 0
        for node in (*then, *otherwise):
            written |= node.written
        return _Node(statement, written, read, then, otherwise)


def _program(actions: Sequence[object]) -> Program:
    """A step holds no sends, which the type of a conditional cannot say."""
    return cast(Program, actions)


def _before(nodes: Sequence[_Node], live: int) -> tuple[int, bool]:
    """What is live before, given what is after; and whether any statement matters."""
    matters = False
    for _, written, read, then, otherwise in reversed(nodes):
        if not written & live:
            continue
        if then is None:
            live = live & ~written | read
            matters = True
        else:
            one, first = _before(then, live)
            other, second = _before(otherwise, live)
            if first or second:
                live = one | other | read
                matters = True
    return live, matters


def _kept(nodes: Sequence[_Node], live: int) -> _Kept:
    """The statements that matter, what is live before them, and all that they read and write."""
    kept: list[Statement] = []
    all_read, all_written = 0, 0
    for statement, written, read, then, otherwise in reversed(nodes):
        if not written & live:
            continue
        if then is None:
            live = live & ~written | read
            kept.append(statement)
            all_read |= read
            all_written |= written
            continue
        one, other = _kept(then, live), _kept(otherwise, live)
        if one.program or other.program:
            live = one.live | other.live | read
            kept.append(_choice(statement, one.program, other.program))
            all_read |= read | one.read | other.read
            all_written |= one.written | other.written
    return _Kept(tuple(reversed(kept)), live, all_read, all_written)


def _choice(statement: Statement, then: Program, otherwise: Program) -> Statement:
    """The same object where nothing is left out."""
    assert isinstance(statement, If)
    same = _identical(then, statement.then) and _identical(otherwise, statement.otherwise)
    return statement if same else If(statement.condition, then, otherwise)


def _identical(a: Sequence[object], b: Sequence[object]) -> bool:
    return len(a) == len(b) and all(x is y for x, y in zip(a, b, strict=True))


__all__ = ["LiveCycle", "Names", "live_before", "live_cycle"]
