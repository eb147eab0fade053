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
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import Domain, Sort
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
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
    "checker/system/partition.py",
    "checker/system/slice.py",
    "spec_model/__init__.py",
    "spec_model/lang",
)
"""Files and folders of modules that take part in compiling."""


def fingerprint(
    system: TransitionSystem, layout: Layout, goals: Iterable[Var], shifts: Iterable[Shift]
) -> str:
    """The key of the code for a sliced system.  Raises ``OSError`` without the sources."""
    text = _Text()
    text.add(compiler())
    for name, variables in (("in", system.inputs), ("own", system.variables), ("frozen", system.frozen)):
        text.add(name, *map(text.expr, variables))
    text.add("temps", *map(text.expr, system.temps))
    text.add("goals", *map(text.expr, goals))
    text.add("assume", text.expr(system.assume))
    text.program(system.step)
    text.add("layout", layout.words)
    for f in layout.fields:
        text.add(text.expr(f.var), f.word, f.shift, f.bits, f.stride, f.low, f.top)
    for s in shifts:
        text.add("shift", s.word, s.shift, s.mask, s.by, s.top)
    return sha256("\n".join(text.lines).encode()).hexdigest()


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


class _Text:
    """Lines that determine what is added; formulas and domains are numbered and written once."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.known: dict[int, tuple[int, object]] = {}
        """Number by ``id``; what is numbered is held, so that ids stay unique."""

    def add(self, *words: object) -> None:
        self.lines.append(" ".join(map(str, words)))

    def program(self, program: Iterable[object]) -> None:
        for statement in program:
            if isinstance(statement, Assign):
                self.add("assign", self.expr(statement.var), self.expr(statement.value))
            elif isinstance(statement, If):
                self.add("if", self.expr(statement.condition))
                self.program(statement.then)
                self.add("else")
                self.program(statement.otherwise)
                self.add("end")
            else:
                raise AssertionError(statement)

    def expr(self, expr: Expr) -> int:
        """The number of a formula."""
        known = self.known.get(id(expr))
        return known[0] if known else self._numbered(expr, self._words(expr))

    def _words(self, expr: Expr) -> tuple[object, ...]:
        match expr:
            case Const(value, sort):
                return ("const", value, self._plain(sort))
            case Var(name, domain, init):
                return ("var", repr(name), self._plain(domain), init)
            case Named(_, body):
                return ("named", self.expr(body))
            case Apply(op, args, sort):
                return (op.value, self._plain(sort), *map(self.expr, args))
        raise AssertionError(expr.__class__)

    def _plain(self, value: Domain | Sort) -> int:
        known = self.known.get(id(value))
        return known[0] if known else self._numbered(value, (repr(value),))

    def _numbered(self, value: object, words: tuple[object, ...]) -> int:
        number = len(self.known)
        self.known[id(value)] = number, value
        self.add(number, *words)
        return number
