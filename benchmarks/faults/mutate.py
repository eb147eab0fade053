"""Every first-order mutant of a module that Cosmic Ray makes, under a name that survives shifted lines."""

import ast
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path

from benchmarks.measure import ROOT

NEEDS_ARGUMENTS = ("core/VariableReplacer", "core/VariableInserter")
"""Operators for a variable that one names; the others apply everywhere."""


@dataclass(frozen=True)
class Mutant:
    """One change of one module.

    ``within`` is the innermost class or function that the change lies in, ``before`` and ``after`` are the
    lines that differ; ``nth`` counts equal changes within it, from 1.
    """

    module: str
    within: str
    before: str
    after: str
    nth: int
    source: str = field(repr=False, compare=False)

    @property
    def name(self) -> str:
        """What the mutant is called in ``judged.toml``: its place, then the line before and after."""
        place = f"{self.module.removeprefix('rovercheck.supervisor.')} {self.within}".rstrip()
        again = f" [{self.nth}]" if self.nth > 1 else ""
        return f"{place}: {self.before} => {self.after}{again}"


def mutants(module: str) -> Iterator[Mutant]:
    """The mutants of a module, each text once.  Raises ``ModuleNotFoundError`` without Cosmic Ray."""
    source = path(module).read_text(encoding="utf-8")
    scopes, count = _scopes(source), Counter[tuple[str, str, str]]()
    for changed in dict.fromkeys(_changed(source)):
        line, before, after = _difference(source.splitlines(), changed.splitlines())
        key = scopes.get(line, ""), before, after
        count[key] += 1
        yield Mutant(module, *key, count[key], changed)


def _changed(source: str) -> Iterator[str]:
    """What the operators of Cosmic Ray make of a source, one change at a time."""
    tree, mutating, plugins = (import_module(f"cosmic_ray.{part}") for part in ("ast", "mutating", "plugins"))
    nodes = list(tree.ast_nodes(tree.get_ast(source)))
    for name in plugins.operator_names():
        if name not in NEEDS_ARGUMENTS:
            operator = plugins.get_operator(name)()
            for occurrence in range(sum(len(list(operator.mutation_positions(node))) for node in nodes)):
                changed: str | None = mutating.mutate_code(source, operator, occurrence)
                if changed is not None and changed != source:
                    yield changed


def path(module: str) -> Path:
    """The file of a module of the project."""
    stem = ROOT.joinpath(*module.split("."))
    return stem / "__init__.py" if stem.is_dir() else stem.with_suffix(".py")


def _difference(old: list[str], new: list[str]) -> tuple[int, str, str]:
    """The number of the first line that differs, and what differs, without the margins."""
    first = next(
        (i for i, (a, b) in enumerate(zip(old, new, strict=False)) if a != b), min(len(old), len(new))
    )
    same = 0
    while same < min(len(old), len(new)) - first and old[-1 - same] == new[-1 - same]:
        same += 1
    return first + 1, _joined(old[first : len(old) - same]), _joined(new[first : len(new) - same])


def _joined(lines: list[str]) -> str:
    return " ".join(" ".join(lines).split())


def _scopes(source: str) -> dict[int, str]:
    """For each line of a class or function its dotted name, innermost."""
    found: dict[int, str] = {}

    def walk(node: ast.AST, outer: str) -> None:
        for child in ast.iter_child_nodes(node):
            name = outer
            if isinstance(child, ast.ClassDef | ast.FunctionDef):
                name = f"{outer}.{child.name}".lstrip(".")
                first = min([child.lineno, *(d.lineno for d in child.decorator_list)])
                found.update(dict.fromkeys(range(first, (child.end_lineno or first) + 1), name))
            walk(child, name)

    walk(ast.parse(source), "")
    return found
