"""The shape of the code base in figures: `python -m benchmarks.house`.

Modules and imports are read from the sources, imports inside functions included; a package counts as the
module that its ``__init__.py`` is.
"""

import ast
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import networkx as nx

from benchmarks.markdown import table

ROOT = Path(__file__).parents[1]
TOP = "rovercheck"
SHIPPED = (TOP, "spec_model", "properties", "checker", "supervisor")
"""The folders of what is installed; each but the first is a package below it."""
CHECKER = f"{TOP}.checker"
CHOICES = ("choose", "under")
"""What a chart file must not call: a choice between interpretations belongs beside the figure."""


@dataclass(frozen=True)
class Module:
    """A module by its dotted name, with its source as a tree, its lines, and the modules that it imports."""

    name: str
    tree: ast.Module
    lines: int

    @property
    def folder(self) -> str:
        """The package that holds it."""
        return self.name.rpartition(".")[0]


def modules(root: Path = ROOT) -> dict[str, Module]:
    """All shipped modules by name."""
    found: dict[str, Module] = {}
    for package in SHIPPED:
        for file in sorted((root / package).rglob("*.py")):
            parts = file.relative_to(root).with_suffix("").parts
            inside = parts[:-1] if parts[-1] == "__init__" else parts
            name = ".".join(inside if package == TOP else (TOP, *inside))
            text = file.read_text(encoding="utf-8")
            found[name] = Module(name, ast.parse(text), len(text.splitlines()))
    return found


def imports(known: Mapping[str, Module]) -> "nx.DiGraph[str]":
    """Who imports whom, of the shipped modules."""
    graph: nx.DiGraph[str] = nx.DiGraph()
    graph.add_nodes_from(known)
    for name, module in known.items():
        graph.add_edges_from((name, other) for other in _imported(module.tree, known) if other != name)
    return graph


def _imported(tree: ast.Module, known: Mapping[str, Module]) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                whole = f"{node.module}.{alias.name}"
                yield from (n for n in (whole if whole in known else node.module,) if n in known)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name in known)


def longest_chain(graph: "nx.DiGraph[str]") -> int:
    """Modules on the longest chain of imports, a knot of modules that import each other counted as one."""
    return len(nx.dag_longest_path(nx.condensation(graph)))


def read_once(graph: "nx.DiGraph[str]") -> list[str]:
    """Modules that one module imports, in their own folder, and nobody else."""
    found = []
    for name in graph:
        importers = list(graph.predecessors(name))
        if len(importers) == 1 and importers[0].rpartition(".")[0] == name.rpartition(".")[0]:
            found.append(name)
    return found


def _functions(module: Module) -> Iterator[tuple[str, int]]:
    for node in ast.walk(module.tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            of = node.args
            given = [a for a in (*of.posonlyargs, *of.args, *of.kwonlyargs) if a.arg not in ("self", "cls")]
            yield f"{module.name}.{node.name}", len(given)


def _classes(known: Mapping[str, Module]) -> Counter[str]:
    names = (n.name for m in known.values() for n in m.tree.body if isinstance(n, ast.ClassDef))
    return Counter(name for name in names if not name.startswith("_"))


def _choices(known: Mapping[str, Module]) -> int:
    """Calls in chart files that choose between interpretations."""
    charts = [
        m
        for n, m in known.items()
        if n.startswith(("rovercheck.spec_model.board1", "rovercheck.spec_model.board2"))
    ]
    calls = (n for m in charts for n in ast.walk(m.tree) if isinstance(n, ast.Call))
    return sum(isinstance(call.func, ast.Name) and call.func.id in CHOICES for call in calls)


def figures(root: Path = ROOT) -> list[tuple[str, str]]:
    """What is measured, and how much it is."""
    known = modules(root)
    graph = imports(known)
    checker = [m for n, m in known.items() if n.startswith(CHECKER)]
    loose = [m for m in checker if m.folder == CHECKER and not any(n.folder == m.name for n in checker)]
    name, most = max((pair for m in known.values() for pair in _functions(m)), key=lambda pair: pair[1])
    twice = {n: count for n, count in _classes(known).items() if count > 1}
    return [
        ("modules of checker", f"{len(checker)}"),
        ("lines of checker", f"{sum(m.lines for m in checker):,}"),
        ("loose modules at the top of checker", f"{len(loose)}"),
        ("modules on the longest chain of imports", f"{longest_chain(graph)}"),
        ("modules with a single importer beside them", f"{len(read_once(graph))}"),
        ("most parameters of a function", f"{most} ({name})"),
        ("names of public classes that occur twice or more", f"{len(twice)}"),
        ("choices between interpretations in chart files", f"{_choices(known)}"),
        ("lines of README.md", f"{len((root / 'README.md').read_text(encoding='utf-8').splitlines())}"),
    ]


if __name__ == "__main__":
    print(table(("what", "how much"), figures()))
