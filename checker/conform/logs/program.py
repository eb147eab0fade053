"""The step of a transition system as a Python function, which asks for what is not known when it needs it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import cast

from checker.conform.logs.cells import Raw
from checker.conform.python_text import text_of
from spec_model.lang.action import Action, Assign, If
from spec_model.lang.expr import Expr, Named, Var
from spec_model.lang.system import TransitionSystem

Known = tuple[Raw | None, ...]
"""Values in the order of the variables; ``None``: any value."""

Step = Callable[[Known, Known], tuple[Known, Known]]
"""From a valuation and inputs to the valuation after the step and the outputs (``None``: nothing required).

Raises ``Needed`` when it must read a value that is not known.
"""


class Needed(Exception):
    """The step reads a value that is not known: the name of the variable."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(name)


@dataclass(frozen=True)
class Shown:
    """A variable whose value after the step is asked for, unless a condition holds then."""

    var: Var
    unless: Expr


def compiled(system: TransitionSystem, outputs: Sequence[Shown]) -> Step:
    """The step of a system.  Values between those of a domain are stored like the others."""
    names = _Names()
    state, inputs = system.variables, system.inputs
    lines = [f"{_tuple(names.of(v) for v in state)} = state"] if state else []
    lines += [f"{_tuple(names.of(v) for v in inputs)} = inputs"] if inputs else []
    body = list(_statements(system.step, names))
    shown = _tuple(f"None if {_value(o.unless, names)} else {names.of(o.var)}" for o in outputs)
    lines += [*body, f"return {_tuple(names.of(v) for v in state)}, {shown}"]
    source = "def step(state, inputs):\n" + "\n".join(f"    {line}" for line in lines)
    scope: dict[str, object] = {"need": _need}
    exec(compile(source, f"<step of {system.name}>", "exec"), scope)
    return cast(Step, scope["step"])


def _need(name: str) -> Raw:
    raise Needed(name)


class _Names:
    """Python names of variables."""

    def __init__(self) -> None:
        self._known: dict[str, str] = {}

    def of(self, var: Var) -> str:
        return self._known.setdefault(var.name, f"v{len(self._known)}")


def _tuple(parts: Iterator[str]) -> str:
    return f"({''.join(f'{part}, ' for part in parts)})"


def _statements(program: Sequence[Action], names: _Names) -> Iterator[str]:
    for statement in program:
        if isinstance(statement, Assign):
            yield f"{names.of(statement.var)} = {_assigned(statement.value, names)}"
        elif isinstance(statement, If):
            yield from _conditional(statement, names)


def _assigned(value: Expr, names: _Names) -> str:
    """A copy of what is not known is not known either."""
    inner = value.body if isinstance(value, Named) else value
    return names.of(inner) if isinstance(inner, Var) else _value(value, names)


def _conditional(statement: If, names: _Names) -> Iterator[str]:
    if _guards_a_domain(statement):
        yield from _statements(statement.then, names)
        return
    for word, branch in (
        (f"if {_value(statement.condition, names)}", statement.then),
        ("else", statement.otherwise),
    ):
        if branch or word != "else":
            yield f"{word}:"
            yield from (f"    {line}" for line in [*_statements(branch, names)] or ["pass"])


def _guards_a_domain(statement: If) -> bool:
    """Whether lowering made it, to see values outside a domain, where a measured one may well lie."""
    return any(isinstance(a, Assign) and a.var.name.endswith(".out_of_domain") for a in statement.otherwise)


def _value(expr: Expr, names: _Names) -> str:
    def read(var: Var) -> str:
        name = names.of(var)
        return f"({name} if {name} is not None else need({var.name!r}))"

    return text_of(expr, read)
