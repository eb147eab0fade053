"""Native code for the explicit search: made with LLVM in memory, no compiler needed."""

import ctypes
from dataclasses import dataclass
from typing import Any

import numpy as np
from llvmlite import ir
from numpy.typing import NDArray

from checker.encode.native.expressions import TooWide
from checker.encode.native.jit import Library
from checker.encode.native.layout import Layout, OutsideDomain, layout
from checker.encode.native.quiet import Shift, moved_on, shifts
from checker.encode.native.retrace import LEAVE_DOMAIN, REACH_TARGET, UNREAD, add_retrace
from checker.encode.native.search import BATCH, Status, Task, add_search
from checker.encode.native.table import CONTEXT, Table

Words = NDArray[np.uint64]
Numbers = NDArray[np.uint32]

__all__ = [
    "BATCH",
    "CONTEXT",
    "LEAVE_DOMAIN",
    "REACH_TARGET",
    "UNREAD",
    "Layout",
    "NativeRetrace",
    "NativeSearch",
    "OutsideDomain",
    "Shift",
    "Status",
    "Task",
    "TooWide",
    "layout",
    "moved_on",
    "shifts",
]


def _address(array: NDArray[Any]) -> ctypes.c_void_p:
    return ctypes.c_void_p(array.ctypes.data)


@dataclass(frozen=True)
class NativeSearch:
    """The compiled search: ``search``, ``rehash`` and ``known`` on arrays that the caller owns."""

    library: Library
    task: Task

    @staticmethod
    def compile(task: Task) -> "NativeSearch":
        """Compile for a task.  Raises ``TooWide`` where 64 bits do not suffice."""
        module = ir.Module("search")
        table = Table(module, task.layout.words)
        store = table.store()
        table.rehash()
        table.known()
        add_search(module, task, table, store)
        return NativeSearch(Library(module), task)

    def search(self, *arrays: NDArray[Any]) -> Status:
        """context, words, parents, table, buffer, origins, hits: see ``search.add_search``."""
        call = self.library.function("search", ctypes.c_int64, [ctypes.c_void_p] * len(arrays))
        return Status(call(*map(_address, arrays)))

    def rehash(self, table: Words, words: Words, count: int) -> None:
        """Enter the first ``count`` stored valuations into an empty table."""
        types = [ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p, ctypes.c_int64]
        call = self.library.function("rehash", None, types)
        call(_address(table), len(table) - 1, _address(words), count)

    def known(self, table: Words, words: Words, asked: Words) -> NDArray[np.bool_]:
        """Which of the valuations asked about are stored."""
        found: NDArray[np.int64] = np.zeros(len(asked), dtype=np.int64)
        types = [ctypes.c_void_p, ctypes.c_int64, *[ctypes.c_void_p] * 2, ctypes.c_int64, ctypes.c_void_p]
        call = self.library.function("known", None, types)
        call(_address(table), len(table) - 1, _address(words), _address(asked), len(asked), _address(found))
        return found.astype(np.bool_)


@dataclass(frozen=True)
class NativeRetrace:
    """The compiled search for the inputs of one tick."""

    library: Library
    task: Task

    @staticmethod
    def compile(task: Task) -> "NativeRetrace":
        module = ir.Module("retrace")
        add_retrace(module, task)
        return NativeRetrace(Library(module), task)

    def inputs(self, before: Words, target: Words, wanted: int) -> dict[str, int]:
        """The inputs read on a path from ``before`` that fits, by name.  Raises ``LookupError``."""
        chosen = np.zeros(max(1, len(self.task.system.inputs)), dtype=np.int64)
        types = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_int64, ctypes.c_void_p]
        call = self.library.function("retrace", ctypes.c_int64, types)
        one, two = np.ascontiguousarray(before), np.ascontiguousarray(target)
        if not call(_address(one), _address(two), wanted, _address(chosen)):
            raise LookupError("no inputs lead from one stored valuation to the next")
        values = zip(self.task.system.inputs, chosen, strict=False)
        return {v.name: int(raw) for v, raw in values if raw != UNREAD}
