"""The step of a transition system as a Python function, which asks for what is not known when it needs it."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any, cast

from rovercheck.checker.conformance.numbers import value_of
from rovercheck.checker.conformance.recording import Raw
from rovercheck.checker.encode.python_text import OPERATIONS, Row, text_of
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.expr import Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem

Known = tuple[Raw | None, ...]
"""Values in the order of the variables; ``None``: any value."""

Number = Any
"""An integer, a fraction or a decimal."""

Step = Callable[[Known, Known], tuple[Known, Known]]
"""From a state and inputs to the state after the step and the outputs (``None``: nothing required).

Raises ``NeededInputs`` when it must read a value that is not known.
"""


class NeededInputs(Exception):
    """The step reads a value that is not known: the name of the state or input that it stems from.

    It is always one that the step is given: of a copy it is the variable that was copied.
    """

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(name)


@dataclass(frozen=True)
class BeliefOutcome:
    """What a step may lead to: the states before and after it, and the outputs it requires."""

    before: Known
    after: Known
    outputs: Known


TakenStep = tuple[Known, Known, Known]
"""The states before and after a step, and the outputs it requires; measured ones may be ``Decimal``."""


@dataclass(frozen=True)
class ProgramOutput:
    """A variable whose value after the step is asked for, unless a condition holds then."""

    var: Var
    unless: Expr


def compiled(system: TransitionSystem, outputs: Sequence[ProgramOutput], known: bool = False) -> Step:
    """The step of a system, which has no checks of domains.

    ``known``: it is quicker, and must only be given values that are known; measured ones may be ``Decimal``
    too, in a context that traps ``Inexact``.
    """
    state, inputs = system.variables, system.inputs
    names = _Names(frozenset() if known else _copied(system.step), known)
    lines = [f"{_tuple(names.of(v) for v in state)} = state"] if state else []
    lines += [f"{_tuple(names.of(v) for v in inputs)} = inputs"] if inputs else []
    every = (*state, *inputs, *system.temps)
    lines += [f"{names.origin(v)} = {v.name!r}" for v in every if names.is_copied_to(v)]
    body = list(_statements(system.step, names))
    shown = _tuple(f"None if {_value(o.unless, names)} else {names.of(o.var)}" for o in outputs)
    lines += [*body, f"return {_tuple(names.of(v) for v in state)}, {shown}"]
    source = "def step(state, inputs):\n" + "\n".join(f"    {line}" for line in lines)
    scope: dict[str, object] = {
        "need": _need, "mod": _mod, "div": _div, "Fraction": Fraction, "Decimal": Decimal
    }  # fmt: skip
    exec(compile(source, f"<step of {system.name}>", "exec"), scope)
    return cast(Step, scope["step"])


def _need(name: str) -> Raw:
    raise NeededInputs(name)


def _mod(a: Number, b: Number) -> Number:
    """``a % b``, which of decimals has the sign of a."""
    rest = a % b
    if isinstance(rest, Decimal) and rest and (rest < 0) != (b < 0):
        return rest + b
    return rest


def _div(a: Number, b: Number) -> Number:
    """``a // b``, which of decimals is rounded towards zero."""
    if isinstance(a, Decimal) or isinstance(b, Decimal):
        return int((a - _mod(a, b)) / b)
    return a // b


_OF_KNOWN: Mapping[Op, Row] = {
    **OPERATIONS,
    Op.MOD: lambda a, b: f"mod({a}, {b})",
    Op.DIV: lambda a, b: f"div({a}, {b})",
}
"""Operators on values that may be decimals."""


class _Names:
    """Python names of variables, and of those that hold where the value of a copy comes from."""

    def __init__(self, copies: frozenset[str], all_known: bool = False) -> None:
        self._known: dict[str, str] = {}
        self._copies = copies
        self.all_known = all_known

    def of(self, var: Var) -> str:
        number = value_of(var.name)
        if number is not None:
            return self._literal(number)
        return self._known.setdefault(var.name, f"v{len(self._known)}")

    def _literal(self, number: Fraction) -> str:
        """A decimal where decimals are computed with, if it can be one."""
        exact = Decimal(number.numerator) / number.denominator
        return repr(exact) if self.all_known and Fraction(exact) == number else repr(number)

    def is_copied_to(self, var: Var) -> bool:
        """Whether the step may make it a copy of another variable."""
        return var.name in self._copies

    def origin(self, var: Var) -> str:
        """What tells the state or input from which the value of the variable stems, if that is not known."""
        return f"{self.of(var)}_from" if self.is_copied_to(var) else repr(var.name)


def _copied(program: Sequence[Action]) -> frozenset[str]:
    """The variables that some assignment makes copies of others."""
    found = set[str]()
    for statement in program:
        if isinstance(statement, If):
            found |= _copied(statement.then) | _copied(statement.otherwise)
        elif isinstance(statement, Assign) and isinstance(_inner(statement.value), Var):
            found.add(statement.var.name)
    return frozenset(found)


def _inner(value: Expr) -> Expr:
    return value.body if isinstance(value, Named) else value


def _tuple(parts: Iterator[str]) -> str:
    return f"({''.join(f'{part}, ' for part in parts)})"


def _statements(program: Sequence[Action], names: _Names) -> Iterator[str]:
    for statement in program:
        if isinstance(statement, Assign):
            yield from _assigned(statement.var, statement.value, names)
        elif isinstance(statement, If):
            yield from _conditional(statement, names)


def _assigned(var: Var, value: Expr, names: _Names) -> Iterator[str]:
    """A copy of what is not known is not known either, and stems from the same."""
    inner = _inner(value)
    if not isinstance(inner, Var) or names.all_known:
        yield f"{names.of(var)} = {_value(value, names)}"
    elif inner.name != var.name:
        yield f"{names.of(var)}, {names.origin(var)} = {names.of(inner)}, {names.origin(inner)}"


def _conditional(statement: If, names: _Names) -> Iterator[str]:
    for word, branch in (
        (f"if {_value(statement.condition, names)}", statement.then),
        ("else", statement.otherwise),
    ):
        if branch or word != "else":
            yield f"{word}:"
            yield from (f"    {line}" for line in [*_statements(branch, names)] or ["pass"])


def _value(expr: Expr, names: _Names) -> str:
    if names.all_known:
        return text_of(expr, names.of, _OF_KNOWN)

    def read(var: Var) -> str:
        name = names.of(var)
        return f"({name} if {name} is not None else need({names.origin(var)}))"

    return text_of(expr, read)
