"""All ticks that leave some states, as LLVM code: graphs need every pair, not only what is new."""

from enum import IntEnum
from typing import Any

from rovercheck.checker.encode.native.body import Body
from rovercheck.checker.encode.native.expressions import INT
from rovercheck.checker.encode.native.search import NativeTask, begin, outside, packed
from rovercheck.checker.encode.native.table import WORDS, StateTable, function
from rovercheck.checker.encode.path_statements import saved

MOST_PATHS = 1 << 25
"""Ways through one tick beyond which its state is given up: the code could not be interrupted."""


class ExpansionEnd(IntEnum):
    """Why ``successors`` came back."""

    DONE = 0
    NO_ROOM = 1
    OUTSIDE = 2
    TOO_MANY = 3


def add_successors(module: Any, task: NativeTask) -> None:
    """``successors(words, count, room, found, origins, state)``: expand the first ``count`` states.

    Each path ends in a row of ``found``, which has ``room`` + 1 of them, with the place of its origin in
    ``origins``; rows that repeat the one before are left out.  ``state`` becomes how many states are
    expanded and how many rows belong to them.  Returns an ``ExpansionEnd``.
    """
    _Successors(module, task).emit()


class _Successors:
    def __init__(self, module: Any, task: NativeTask) -> None:
        self.task, self.table = task, StateTable(module, task.layout.words)
        arguments = {"words": WORDS, "count": INT, "room": INT, "found": WORDS, "origins": WORDS}
        _, self.a, self.build = function(module, "successors", INT, {**arguments, "state": WORDS})

    def emit(self) -> None:
        task, build = self.task, self.build
        finished, head = (build.append_basic_block(n) for n in ("finished", "head"))
        most = max(1, len(task.system.inputs))
        self.body = Body(build, saved(task.paths, task.live_at_end), finished, most)
        self.at, self.filled, self.first, self.tried = (
            self.body.local(INT, n) for n in ("at", "filled", "first", "tried")
        )
        for place in (self.at, self.filled):
            build.store(INT(0), place)
        build.branch(head)
        self._head(head)
        before = self.table.load(build, self.a["words"], build.load(self.at))
        begin(self.body, task, task.paths, before)
        self.body.run(task.paths)
        self._end_of_path(before)
        self.body.go_back()
        build.position_at_end(finished)
        build.store(build.add(build.load(self.at), INT(1)), self.at)
        build.branch(head)

    def _head(self, head: Any) -> None:
        """The next state, or the end."""
        build = self.build
        expand, done = (build.append_basic_block(n) for n in ("expand", "done"))
        build.position_at_end(head)
        build.store(build.load(self.filled), self.first)
        build.store(INT(0), self.tried)
        build.cbranch(build.icmp_signed("<", build.load(self.at), self.a["count"]), expand, done)
        build.position_at_end(done)
        self._leave(ExpansionEnd.DONE)
        build.position_at_end(expand)

    def _leave(self, why: ExpansionEnd) -> None:
        """Back to Python; what was found of the current state does not count."""
        build = self.build
        for number, place in enumerate((self.at, self.first)):
            build.store(build.load(place), build.gep(self.a["state"], [INT(number)]))
        build.ret(INT(int(why)))

    def _end_of_path(self, before: list[Any]) -> None:
        build = self.build
        tried = build.add(build.load(self.tried), INT(1))
        build.store(tried, self.tried)
        with build.if_then(build.icmp_signed(">", tried, INT(MOST_PATHS)), likely=False):
            self._leave(ExpansionEnd.TOO_MANY)
        with build.if_then(outside(self.body, self.task.layout), likely=False):
            self._leave(ExpansionEnd.OUTSIDE)
        after = packed(self.body, self.task, self.task.paths, before)
        with build.if_then(build.not_(self._as_before(after))):
            self._keep(after)

    def _as_before(self, after: list[Any]) -> Any:
        """Whether the path ends where the last one that was kept for this state did."""
        build, filled = self.build, self.build.load(self.filled)
        same = build.icmp_signed(">", filled, build.load(self.first))
        last = build.sub(filled, build.zext(same, INT))
        for one, two in zip(after, self.table.load(build, self.a["found"], last), strict=True):
            same = build.and_(same, build.icmp_unsigned("==", one, two))
        return same

    def _keep(self, after: list[Any]) -> None:
        build, filled = self.build, self.build.load(self.filled)
        with build.if_then(build.icmp_signed(">=", filled, self.a["room"]), likely=False):
            self._leave(ExpansionEnd.NO_ROOM)
        self.table.save(build, self.a["found"], filled, after)
        build.store(build.load(self.at), build.gep(self.a["origins"], [filled]))
        build.store(build.add(filled, INT(1)), self.filled)
