"""Properties of a model of Simulink as properties of the model that was written of it."""

import ast
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.export.source.layout import laid_out, listed, quoted
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.errors import ModelError, did_you_mean

ASKED = "simulink_model"


@dataclass(frozen=True)
class WrittenNames:
    """What properties may name of a written model.

    ``imported`` is the line that imports its ``module``, without what it is called; ``signals`` are the
    words of Python by the names in Simulink, ``charts`` those of charts.
    """

    imported: str
    system: str
    signals: Mapping[str, str]
    charts: Mapping[str, tuple[str, Chart]]


@dataclass(frozen=True)
class _Edit:
    start: int
    end: int
    text: str


def rewritten(text: str, names: WrittenNames) -> str:
    """A file of properties that asks for ``simulink_model(...)``, about the written model in place of it.

    Raises ``ModelError`` with the line of what cannot be written anew.
    """
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError, RecursionError) as error:
        raise ModelError(f"it is no Python: {error}") from error
    rewriter = _Rewriter(text, names)
    rewriter.module(tree)
    data = text.encode()
    for one in sorted(rewriter.edits, key=lambda edit: edit.start, reverse=True):
        data = data[: one.start] + one.text.encode() + data[one.end :]
    return data.decode()


class _Rewriter:
    """Finds what is to be replaced; places are counted in bytes, as Python does."""

    def __init__(self, text: str, names: WrittenNames) -> None:
        self._names, self.edits = names, list[_Edit]()
        self._starts = [0]
        for line in text.encode().splitlines(keepends=True):
            self._starts.append(self._starts[-1] + len(line))
        self._models: list[str] = []
        self._done: set[int] = set()

    def module(self, tree: ast.Module) -> None:
        imports = [one for one in tree.body if self._imports(one)]
        asked = [one for one in tree.body if self._asks(one)]
        if len(asked) != 1 or not imports:
            line = asked[1].lineno if len(asked) > 1 else 1
            raise ModelError(
                f"line {line}: it does not say `name = {ASKED}(...)` once, at the level of the file"
            )
        [statement] = asked
        assert isinstance(statement, ast.Assign)
        [target] = statement.targets
        assert isinstance(target, ast.Name)
        self._models.append(target.id)
        self._import(imports[0], target.id)
        self._remove(statement)
        for node in ast.walk(tree):
            self._replace(node)
        for node in ast.walk(tree):
            if (
                isinstance(node, ast.Name)
                and node.id in (*self._models, ASKED)
                and id(node) not in self._done
            ):
                raise ModelError(
                    f"line {node.lineno}: `{node.id}` is used otherwise than as {node.id}[NAME], "
                    f"{node.id}.active(STATE) or {node.id}.system"
                )

    @staticmethod
    def _imports(node: ast.stmt) -> bool:
        return isinstance(node, ast.ImportFrom) and any(
            one.name == ASKED and not one.asname for one in node.names
        )

    @staticmethod
    def _asks(node: ast.stmt) -> bool:
        return (
            isinstance(node, ast.Assign)
            and isinstance(node.value, ast.Call)
            and isinstance(node.value.func, ast.Name)
            and node.value.func.id == ASKED
            and len(node.targets) == 1
            and isinstance(node.targets[0], ast.Name)
        )

    def _import(self, node: ast.stmt, name: str) -> None:
        assert isinstance(node, ast.ImportFrom)
        kept = [one for one in node.names if one.name != ASKED]
        words = ", ".join(f"{one.name} as {one.asname}" if one.asname else one.name for one in kept)
        shown = f"\n\nfrom {node.module} import {words}" if words else ""
        if len(shown) > 90:
            inner = "".join(f"    {word},\n" for word in words.split(", "))
            shown = f"\n\nfrom {node.module} import (\n{inner})"
        line = self._names.imported
        self._edit(node, f"{line}{shown}" if line.endswith(f" {name}") else f"{line} as {name}{shown}")

    def _remove(self, statement: ast.Assign) -> None:
        """The statement with its line, where it has one."""
        start, end = (
            self._starts[statement.lineno - 1],
            self._starts[statement.end_lineno or statement.lineno],
        )
        self.edits.append(_Edit(start, end, ""))
        self._done |= {id(node) for node in ast.walk(statement)}

    def _replace(self, node: ast.AST) -> None:
        match node:
            case ast.Subscript(ast.Name(model) as owner, ast.Constant(str() as name)) if (
                model in self._models
            ):
                self._done.add(id(owner))
                self._edit(node, f"{model}.{self._signal(name, node)}")
            case ast.Call(ast.Attribute(ast.Name(model) as owner, "active"), states, []) if (
                model in self._models
            ):
                texts = [
                    one.value
                    for one in states
                    if isinstance(one, ast.Constant) and isinstance(one.value, str)
                ]
                if len(texts) != len(states):
                    raise ModelError(f"line {node.lineno}: the names of its states are no plain texts")
                self._done.add(id(owner))
                self._edit(node, self._active(model, texts, node))
            case ast.Attribute(ast.Name(model) as owner, "system") if model in self._models:
                self._done.add(id(owner))
                self._edit(node, f"{model}.{self._names.system}")
            case ast.GeneratorExp(
                ast.Subscript(ast.Name(model) as owner, ast.Name(each)), [turns]
            ) | ast.ListComp(ast.Subscript(ast.Name(model) as owner, ast.Name(each)), [turns]) if (
                model in self._models
            ):
                words = list(self._each(turns, each))
                if not words:
                    return
                self._done.add(id(owner))
                shown = [f"{model}.{self._signal(word, node)}" for word in words]
                ends = "[]" if isinstance(node, ast.ListComp) else "()"
                self._edit(node, f"{ends[0]}{', '.join(shown)}{',' if len(shown) == 1 else ''}{ends[1]}")

    @staticmethod
    def _each(turns: ast.comprehension, name: str) -> Iterator[str]:
        """The texts of ``for name in ("a", "b")``."""
        match turns:
            case ast.comprehension(ast.Name(own), ast.Tuple(some) | ast.List(some), []) if own == name:
                if all(isinstance(one, ast.Constant) and isinstance(one.value, str) for one in some):
                    yield from (str(one.value) for one in some if isinstance(one, ast.Constant))

    def _signal(self, name: str, node: ast.AST) -> str:
        found = self._names.signals.get(name)
        if found is None:
            line = getattr(node, "lineno", 1)
            raise ModelError(
                f"line {line}: {name} is no variable of the written model. "
                f"{did_you_mean(name, self._names.signals)}"
            )
        return found

    def _active(self, model: str, states: Sequence[str], node: ast.AST) -> str:
        by_chart: dict[str, list[str]] = {}
        for state in states:
            word, path = self._state(state, getattr(node, "lineno", 1))
            by_chart.setdefault(word, []).append(path)
        shown = [f"{model}.{word}.active({', '.join(map(quoted, some))})" for word, some in by_chart.items()]
        return shown[0] if len(shown) == 1 else f"({' | '.join(shown)})"

    def _state(self, state: str, line: int) -> tuple[str, str]:
        path = state.replace("/", ".")
        first, _, rest = path.partition(".")
        wanted = [(first, rest)] if first in self._names.charts and rest else []
        wanted += [(name, path) for name in self._names.charts]
        for name, inside in wanted:
            word, chart = self._names.charts[name]
            try:
                return word, ".".join(chart.path(inside))
            except ModelError:
                continue
        raise ModelError(f"line {line}: no chart has one state {state!r}")

    def _edit(self, node: ast.AST, text: str) -> None:
        assert isinstance(node, ast.expr | ast.stmt)
        assert node.end_lineno is not None and node.end_col_offset is not None
        start = self._starts[node.lineno - 1] + node.col_offset
        self.edits.append(_Edit(start, self._starts[node.end_lineno - 1] + node.end_col_offset, text))


def begun(title: str, names: WrittenNames) -> str:
    """A file of properties to begin with: that each innermost state can become active."""
    module = names.imported.split()[-1]
    lines = [
        f'"""What must hold of {title}: that each state can become active, to begin with."""', "",
        names.imported, "", "from rovercheck import reachable",
    ]  # fmt: skip
    for word, chart in names.charts.values():
        leaves = [".".join(path) for path, state in chart.states.items() if path and not state.states]
        states = listed(list(map(quoted, leaves)))
        lines += ["", *laid_out(states, before=f"{word.upper()}_STATES = ")]
    lines += ["", "PROPERTIES = ["]
    for word, chart in names.charts.values():
        name = "".join(one if one.isalnum() else "-" for one in chart.name)
        lines += [
            "    reachable(",
            f'        f"{name}-{{number}}",',
            '        f"{state} can become active.",',
            f"        that={module}.{word}.active(state),",
            '        covers=["states"],',
            f"        on={module}.{names.system},",
            "    )",
            f"    for number, state in enumerate({word.upper()}_STATES, 1)",
        ]
        if len(names.charts) > 1:
            lines[-8:] = [f"    {one}" for one in lines[-8:]]
            lines.insert(-8, "    *(")
            lines.append("    ),")
    return "\n".join([*lines, "]"]) + "\n"


__all__ = ["WrittenNames", "begun", "rewritten"]
