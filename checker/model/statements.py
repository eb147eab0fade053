"""The other faults of a file that cannot be run: its statements one by one, without what is wrong.

Python stops at the first error.  Here a statement that fails is run again without the transition or action
that is at fault, and what needs a name that a faulty statement should have made is left out.
"""

import ast
import sys
import traceback
from collections.abc import Callable, Iterator
from copy import copy
from pathlib import Path
from types import ModuleType
from typing import Any

from rovercheck.spec_model.lang.chart import Chart

Located = Callable[[BaseException], str]
"""What is told of an error, with its place."""

_REMOVABLE = frozenset({"to", "assign", "when", "send"})
"""What a chart still is one without: names of states stay as they are."""


def statement_faults(file: Path, name: str, located: Located) -> Iterator[str]:
    """What is wrong with each statement of a file, and with the labels of the charts that it makes.

    ``name`` is that of the module, whose neighbours can be imported.
    """
    try:
        tree = ast.parse(file.read_bytes(), str(file))
    except (SyntaxError, ValueError, RecursionError):
        return  # that is the one fault that can be told
    module = ModuleType(name)
    module.__file__, module.__package__ = str(file), name.rpartition(".")[0]
    before = sys.modules.get(name)
    sys.modules[name] = module  # data classes look up where they are written
    broken = set[str]()
    try:
        for statement in tree.body:
            if broken & _read(statement):
                broken |= _bound(statement)
                continue
            sound, faults = _run(statement, file, vars(module), located)
            yield from faults
            if not sound:
                broken |= _bound(statement)
        yield from (fault for chart in _charts(vars(module)) for fault in chart.label_faults)
    finally:
        del sys.modules[name]
        if before is not None:
            sys.modules[name] = before


def _run(statement: ast.stmt, file: Path, scope: dict[str, Any], located: Located) -> tuple[bool, list[str]]:
    """Whether a statement could be run, if need be without some parts; and what is wrong with it."""
    faults = list[str]()
    while True:
        try:
            exec(_compiled(statement, file), scope)
            return True, faults
        except KeyboardInterrupt:
            raise
        except BaseException as error:  # as where the whole file is run
            faults.append(located(error))
            smaller = _without(statement, error, file)
            if smaller is None:
                return False, faults
            statement = smaller


def _compiled(statement: ast.stmt, file: Path) -> Any:
    return compile(ast.Module([statement], []), str(file), "exec", dont_inherit=True)


def _without(statement: ast.stmt, error: BaseException, file: Path) -> ast.stmt | None:
    """The statement without the innermost transition or action that the error comes from."""
    frames = traceback.extract_tb(error.__traceback__)
    at = next((f for f in frames if f.filename == str(file) and f.name == "<module>"), None)
    if at is None or at.lineno is None or at.end_lineno is None or at.colno is None or at.end_colno is None:
        return None
    start, end = (at.lineno, at.colno), (at.end_lineno, at.end_colno)
    found = [n for n in ast.walk(statement) if _removable(n) and _start(n) <= start and end <= _end(n)]
    lists = [n for n in ast.walk(statement) if isinstance(n, ast.List | ast.Tuple)]
    for node in sorted((n for n in found if isinstance(n, ast.Call)), key=_start, reverse=True):
        holder = next((one for one in lists if any(e is node for e in one.elts)), None)
        if holder is not None:
            left: ast.stmt | None = _Left(node).visit(statement)
            return left
    return None


class _Left(ast.NodeTransformer):
    """Leaves one element out of a list, in a copy of what is around it.

    Of a transition its target stays: the others keep their numbers.
    """

    def __init__(self, left: ast.Call) -> None:
        self._left, self._bare = left, copy(left)
        self._bare.args, self._bare.keywords = left.args[:1], []
        self._keep = ast.unparse(left.func) == "to" and (len(left.args) > 1 or bool(left.keywords))

    def generic_visit(self, node: ast.AST) -> ast.AST:
        node = copy(node)
        for field, value in ast.iter_fields(node):
            if isinstance(value, list):
                bare = [self._bare] if self._keep else []
                parts = [part for one in value for part in (bare if one is self._left else [one])]
                setattr(node, field, [self.visit(one) if isinstance(one, ast.AST) else one for one in parts])
            elif isinstance(value, ast.AST):
                setattr(node, field, self.visit(value))
        return node


def _removable(node: ast.AST) -> bool:
    return isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _REMOVABLE


def _start(node: ast.AST) -> tuple[int, int]:
    assert isinstance(node, ast.expr)
    return node.lineno, node.col_offset


def _end(node: ast.AST) -> tuple[int, int]:
    assert isinstance(node, ast.expr)
    return node.end_lineno or 0, node.end_col_offset or 0


def _read(statement: ast.stmt) -> set[str]:
    """The names that a statement needs."""
    return {n.id for n in ast.walk(statement) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}


def _bound(statement: ast.stmt) -> set[str]:
    """The names that a statement makes."""
    found = set[str]()
    for node in ast.walk(statement):
        match node:
            case ast.Name(id, ast.Store()):
                found.add(id)
            case ast.FunctionDef(name) | ast.AsyncFunctionDef(name) | ast.ClassDef(name):
                found.add(name)
            case ast.alias(name, asname):
                found.add(asname or name.partition(".")[0])
    return found


def _charts(scope: dict[str, Any]) -> Iterator[Chart]:
    """The charts that a file names, in lists and tuples too."""
    for value in scope.values():
        for one in value if isinstance(value, list | tuple) else (value,):
            if isinstance(one, Chart):
                yield one
