"""What determines native code, as one short key: the task, the code that compiles it, the processor.

A search is compiled from nothing but its sliced system, its goals and its quiet ticks, by the modules
of this project named here, by LLVM, and for one processor.  All of that enters the key.
"""

import sys
from collections.abc import Iterable
from functools import cache
from hashlib import sha256
from pathlib import Path
from time import time

import numpy as np

from rovercheck.checker.encode.native.jit import processor
from rovercheck.checker.encode.native.layout import Layout
from rovercheck.checker.encode.native.quiet import Shift
from rovercheck.checker.system.text import SystemText
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TransitionSystem

_ROOT = Path(__file__).parents[3]
_LOADED = time()
"""When this module was loaded, in seconds of the clock that files are dated by."""
SOURCES = (
    "checker/__init__.py",
    "checker/cache",
    "checker/encode",
    "checker/system/__init__.py",
    "checker/system/cells.py",
    "checker/system/intervals.py",
    "checker/system/live_variables.py",
    "checker/system/text.py",
    "checker/system/partition.py",
    "checker/system/slice.py",
    "checker/system/wide_cells.py",
    "spec_model/__init__.py",
    "spec_model/lang",
)
"""Files and folders of modules that take part in compiling."""


def fingerprint(
    system: TransitionSystem, layout: Layout, goals: Iterable[Var], shifts: Iterable[Shift]
) -> str:
    """The key of the code for a sliced system.  Raises ``OSError`` without the sources."""
    text = SystemText()
    text.add(compiler())
    text.system(system)
    text.add("goals", *map(text.expr, goals))
    text.add("layout", layout.words)
    for f in layout.fields:
        text.add(text.expr(f.var), f.word, f.shift, f.bits, f.stride, f.low, f.top)
    for s in shifts:
        text.add("shift", s.word, s.shift, s.mask, s.by, s.top)
    return text.digest


@cache
def compiler() -> str:
    """What compiles: this project's code, the versions of what it uses, the processor.

    Raises ``OSError`` when a source has changed since it was loaded: what runs is no longer what is read.
    """
    digest = sha256()
    for path in sorted(sources()):
        if path.stat().st_mtime > _LOADED:
            raise OSError(f"{path} has changed since it was loaded.")
        digest.update(f"{path.relative_to(_ROOT).as_posix()}\0".encode())
        digest.update(sha256(path.read_bytes()).digest())
    return f"{digest.hexdigest()} {sys.version} {np.__version__} {processor()}"


def sources() -> list[Path]:
    """The files of the modules that take part in compiling."""
    found: list[Path] = []
    for name in SOURCES:
        path = _ROOT / name
        found += path.rglob("*.py") if path.is_dir() else [path]
    return found
