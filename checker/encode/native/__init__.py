"""Native code for the explicit search: made with LLVM, no compiler needed, and kept on disk."""

import ctypes
from contextlib import suppress
from dataclasses import dataclass
from math import prod
from typing import Any, Literal

import numpy as np
from llvmlite import ir
from numpy.typing import NDArray

from rovercheck.checker import cache
from rovercheck.checker.encode.native.expressions import TooWide
from rovercheck.checker.encode.native.jit import NativeLibrary, OptimisationLevel, object_code
from rovercheck.checker.encode.native.layout import Field, Layout, OutsideDomain, layout
from rovercheck.checker.encode.native.quiet import Shift, moved_on, shifts
from rovercheck.checker.encode.native.retrace import LEAVE_DOMAIN, REACH_TARGET, UNREAD, add_retrace
from rovercheck.checker.encode.native.search import BATCH, NativeTask, Status, add_search
from rovercheck.checker.encode.native.successors import ExpansionEnd, add_successors
from rovercheck.checker.encode.native.table import CONTEXT, StateTable

Words = NDArray[np.uint64]
Numbers = NDArray[np.uint32]

__all__ = [
    "BATCH",
    "CONTEXT",
    "LEAVE_DOMAIN",
    "REACH_TARGET",
    "UNREAD",
    "ExpansionEnd",
    "Field",
    "Layout",
    "NativeRetrace",
    "NativeSearch",
    "NativeSuccessors",
    "NativeTask",
    "OptimisationLevel",
    "OutsideDomain",
    "Shift",
    "Status",
    "TooWide",
    "layout",
    "moved_on",
    "shifts",
]


def _address(array: NDArray[Any]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


@dataclass
class NativeSearch:
    """The compiled search: ``search``, ``rehash`` and ``known`` on arrays that the caller owns.

    The code may change between two calls (see ``improve``): what it works on is all in the arrays.
    """

    task: NativeTask
    library: NativeLibrary
    level: OptimisationLevel
    text: str | None = None
    """The module, where it was written and better code may be made of it."""

    @staticmethod
    def compile(task: NativeTask) -> "NativeSearch":
        """Compile for a task in little time, or take better code from the cache.

        Raises ``TooWide`` where 64 bits do not suffice.
        """
        fast = _kept("search", task, OptimisationLevel.FAST)
        if fast is not None:
            return NativeSearch(task, fast, OptimisationLevel.FAST)
        kept = _kept("search", task, OptimisationLevel.QUICK)
        if kept is not None:
            return NativeSearch(task, kept, OptimisationLevel.QUICK)
        text = assembly("search", task)
        return NativeSearch(task, *_made("search", task, OptimisationLevel.QUICK, text), text)

    def improve(self) -> None:
        """Compile to code that runs fast, unless that was done."""
        if self.level is not OptimisationLevel.FAST:
            text = self.text or assembly("search", self.task)
            self.library, self.level = _made("search", self.task, OptimisationLevel.FAST, text)
            self.text = None

    def search(self, *arrays: NDArray[Any]) -> Status:
        """context, words, parents, table, buffer, origins, hits: see ``search.add_search``."""
        call = self.library.function("search", ctypes.c_int64, [ctypes.c_void_p] * len(arrays))
        return Status(call(*map(_address, arrays)))

    def rehash(self, table: Words, words: Words, count: int) -> None:
        """Enter the first ``count`` stored states into an empty table."""
        types = [ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64]
        call = self.library.function("rehash", None, types)
        call(_address(table), len(table), _address(words), count)

    def known(self, table: Words, words: Words, asked: Words) -> NDArray[np.bool_]:
        """Which of the states asked about are stored."""
        found: NDArray[np.int64] = np.zeros(len(asked), dtype=np.int64)
        types = [ctypes.c_void_p, ctypes.c_int64, *[ctypes.c_void_p] * 2, ctypes.c_int64, ctypes.c_void_p]
        call = self.library.function("known", None, types)
        call(_address(table), len(table), _address(words), _address(asked), len(asked), _address(found))
        return found.astype(np.bool_)


_MANY = 1 << 14
"""Combinations of cells from which on single ticks are worth code that runs fast."""


def _level(task: NativeTask) -> OptimisationLevel:
    """How well to compile code that runs all ways through some ticks."""
    return (
        OptimisationLevel.FAST
        if prod(len(p.cells) for p in task.cells.values()) >= _MANY
        else OptimisationLevel.QUICK
    )


@dataclass(frozen=True)
class NativeRetrace:
    """The compiled search for the inputs of one tick."""

    task: NativeTask
    library: NativeLibrary

    @staticmethod
    def compile(task: NativeTask) -> "NativeRetrace":
        return NativeRetrace(task, _library("retrace", task, _level(task)))

    def inputs(self, before: Words, target: Words, wanted: int) -> dict[str, int]:
        """The inputs read on a path from ``before`` that fits, by name.  Raises ``LookupError``."""
        chosen = np.zeros(max(1, len(self.task.system.inputs)), dtype=np.int64)
        types = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p]
        call = self.library.function("retrace", ctypes.c_int64, types)
        one, two = np.ascontiguousarray(before), np.ascontiguousarray(target)
        if not call(_address(one), _address(two), wanted, _address(chosen)):
            raise LookupError("no inputs lead from one stored state to the next")
        values = zip(self.task.system.inputs, chosen, strict=False)
        return {v.name: int(raw) for v, raw in values if raw != UNREAD}


@dataclass(frozen=True)
class NativeSuccessors:
    """The compiled ticks of a system, all of them."""

    task: NativeTask
    library: NativeLibrary

    @staticmethod
    def compile(task: NativeTask) -> "NativeSuccessors":
        """Compile for a task.  Raises ``TooWide`` where 64 bits do not suffice."""
        return NativeSuccessors(task, _library("successors", task, _level(task)))

    def __call__(self, words: Words, room: int) -> tuple[ExpansionEnd, int, Words, NDArray[np.int64]]:
        """Why it ended, how many of the states are expanded, where their ticks lead, and from which."""
        found = np.empty((room + 1, self.task.layout.words), dtype=np.uint64)
        origins = np.empty(room + 1, dtype=np.int64)
        state = np.zeros(2, dtype=np.int64)
        types = [ctypes.c_void_p, *[ctypes.c_int64] * 2, *[ctypes.c_void_p] * 3]
        call = self.library.function("successors", ctypes.c_int64, types)
        rows = np.ascontiguousarray(words)
        ended = call(_address(rows), len(rows), room, *map(_address, (found, origins, state)))
        return ExpansionEnd(ended), int(state[0]), found[: state[1]], origins[: state[1]]


# --- compiling, or not again -------------------------------------------------------------------------

Kind = Literal["search", "retrace", "successors"]
_FUNCTIONS: dict[Kind, tuple[str, ...]] = {
    "search": ("search", "rehash", "known"),
    "retrace": ("retrace",),
    "successors": ("successors",),
}
"""The functions that code of each kind has."""


def _kept(kind: Kind, task: NativeTask, level: OptimisationLevel) -> NativeLibrary | None:
    """The code from the cache, if it is there and can be loaded."""
    with suppress(OSError):  # the sources cannot be read: nothing says what code was made by
        name = f"{task.key}-{kind}-{level}"
        code = cache.read(name)
        if code is not None:
            try:
                return NativeLibrary(code, _FUNCTIONS[kind])
            except (RuntimeError, LookupError):  # LLVM does not take it, or it is code of another kind
                cache.remove(name)
    return None


LARGE = 1 << 20
"""Signs of a module from which on it is only compiled in little time: LLVM makes fast code of it in minutes,
and twice the module takes it far more than twice the time.  The largest of the rover has half as many."""


def _library(kind: Kind, task: NativeTask, level: OptimisationLevel) -> NativeLibrary:
    """The code from the cache, or compiled and kept there."""
    return _kept(kind, task, level) or _made(kind, task, level, assembly(kind, task))[0]


def _made(
    kind: Kind, task: NativeTask, level: OptimisationLevel, text: str
) -> tuple[NativeLibrary, OptimisationLevel]:
    """The code compiled and kept in the cache; ``FAST`` also where it cannot be made faster."""
    large = len(text) > LARGE
    code = object_code(text, OptimisationLevel.QUICK if large else level)
    level = OptimisationLevel.FAST if large else level
    with suppress(OSError):
        cache.write(f"{task.key}-{kind}-{level}", code)
    return NativeLibrary(code), level


def assembly(kind: Kind, task: NativeTask) -> str:
    """The module of that kind in LLVM's assembly language."""
    module = ir.Module(kind)
    if kind == "search":
        table = StateTable(module, task.layout.words, ordered=not task.shifts)
        store = table.store()
        table.rehash()
        table.known()
        add_search(module, task, table, store)
    elif kind == "successors":
        add_successors(module, task)
    else:
        add_retrace(module, task)
    return str(module)
