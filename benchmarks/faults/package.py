"""The supervisors with one module replaced, and all that import it loaded anew, beside the real ones."""

import ast
import sys
from collections.abc import Iterator, Mapping, Set
from contextlib import contextmanager
from functools import cache
from importlib import import_module
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import CodeType, ModuleType

from benchmarks.faults.mutate import path
from benchmarks.measure import ROOT

PACKAGE = "rovercheck.supervisor"


@cache
def modules() -> Mapping[str, CodeType]:
    """Every module of the package but the bench, compiled."""
    files = sorted((ROOT / PACKAGE.replace(".", "/")).rglob("*.py"))
    parts = [f.relative_to(ROOT).with_suffix("").parts for f in files]
    names = [".".join(p[:-1] if p[-1] == "__init__" else p) for p in parts]
    kept = [name for name in names if not name.startswith(f"{PACKAGE}.bench")]
    return {name: compile(path(name).read_bytes(), f"{name}.py", "exec") for name in kept}


@cache
def _imported(name: str) -> Set[str]:
    """The modules of the package that a module names in its imports."""
    tree = ast.parse(path(name).read_bytes())
    found = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom) and node.module}
    return found & modules().keys()


@cache
def importers(module: str) -> Set[str]:
    """The module and all that import it, also through others."""
    found = {module}
    while more := {name for name in modules() if name not in found and _imported(name) & found}:
        found |= more
    return found


class _Finder(MetaPathFinder, Loader):
    """Imports modules from their code."""

    def __init__(self, codes: Mapping[str, CodeType]) -> None:
        self._codes = codes

    def find_spec(self, fullname: str, path: object = None, target: object = None) -> ModuleSpec | None:
        if fullname not in self._codes:
            return None
        inner = any(name.startswith(f"{fullname}.") for name in modules())
        return ModuleSpec(fullname, self, is_package=inner)

    def exec_module(self, module: ModuleType) -> None:
        exec(self._codes[module.__name__], module.__dict__)


@contextmanager
def replaced(module: str, source: str) -> Iterator[None]:
    """Within it, imports give a module of another source, and fresh ones of all that import it.

    What the imports raise, they raise.
    """
    for name in modules():
        import_module(name)  # what stays must be there
    fresh = importers(module)
    codes = {**{name: modules()[name] for name in fresh}, module: compile(source, f"{module}.py", "exec")}
    finder = _Finder(codes)
    kept = {name: sys.modules.pop(name) for name in fresh if name in sys.modules}
    sys.meta_path.insert(0, finder)
    try:
        import_module(PACKAGE)
        yield
    finally:
        sys.meta_path.remove(finder)
        for name in fresh:
            sys.modules.pop(name, None)
        sys.modules.update(kept)
