"""A system's step as Python code: a run is gone through in a hundredth of the time that the reference takes.

What is found with it is confirmed by the reference semantics (``spec_model.lang.evaluate``) where it counts.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from rovercheck.checker.encode import python_text
from rovercheck.checker.encode.python_text import Row, between
from rovercheck.checker.system.intervals import postorder
from rovercheck.spec_model.lang.action import Action, Assign, If
from rovercheck.spec_model.lang.domain import Domain
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import children, nodes

DEEPEST = 60
"""Operators that are nested in one line; Python reads some two hundred parentheses."""
SHORT = 30
"""Letters of a part that is written out again where it occurs several times."""
BRANCHES = 80
"""Branches inside each other; Python indents a hundred times."""

OPERATIONS: Mapping[Op, Row] = {
    **python_text.OPERATIONS,
    Op.NOT: lambda a: f"(not {a})",
    Op.AND: between("and"),
    Op.OR: between("or"),
}
"""Every operator in Python; truth values are as they come, which is quicker."""

Ticks = Callable[[Sequence[int], Sequence[Sequence[int]], dict[int, int]], None]


class TooDeep(Exception):
    """A program is nested more deeply than Python reads."""


class CompiledStep:
    """Goes through runs of a system and notes when some of its truth values, the goals, are first true.

    Raises ``TooDeep`` for a system whose step or formulas are nested beyond all measure.
    """

    def __init__(self, system: TransitionSystem, goals: Sequence[Var]) -> None:
        self._system = system
        self._goals = tuple(goals)
        kept = (*system.frozen, *system.variables)
        self._kept = kept
        self._begins = {v.name: v.init for v in kept}
        self._given = tuple((v.name, v.init) for v in system.inputs)
        self._ticks = _compiled(list(_Writer(system, kept, goals).lines()))

    def first(self, frozen: Mapping[str, int], inputs: Sequence[Mapping[str, int]]) -> dict[str, int]:
        """The goals that are true after some tick, by name, and the first such tick.

        The run ends before a tick whose inputs are not allowed and with one that leaves a domain.
        """
        at = {**self._begins, **{n: v for n, v in frozen.items() if n in self._begins}}
        if any(at[v.name] not in v.domain for v in self._system.frozen):
            return {}
        given = [tuple(tick.get(name, init) for name, init in self._given) for tick in inputs]
        found: dict[int, int] = {}
        self._ticks([at[v.name] for v in self._kept], given, found)
        return {self._goals[number].name: tick for number, tick in found.items()}


def _compiled(lines: Sequence[str]) -> Ticks:
    made: dict[str, Any] = {}
    try:
        exec(compile("\n".join(lines), "<a step>", "exec"), made)
    except (SyntaxError, RecursionError, MemoryError) as error:
        raise TooDeep(str(error)) from error
    ticks: Ticks = made["ticks"]
    return ticks


class _Writer:
    """Writes the step of a system as the lines of a function of that type."""

    def __init__(self, system: TransitionSystem, kept: Sequence[Var], goals: Sequence[Var]) -> None:
        self._system, self._goals, self._kept = system, goals, kept
        every = (*kept, *system.inputs, *system.temps)
        self._names = {v.name: f"v{number}" for number, v in enumerate(every)}
        self._sets: list[str] = []
        self._parts = 0

    def lines(self) -> Iterator[str]:
        """The function."""
        system = self._system
        body = [
            *self._allowed(),
            "  tick += 1",
            *self._program(system.step, 2),
            *(f"  if {self._names[check.name]}: return" for check, _ in system.checks),
        ]
        yield from self._sets
        yield "def ticks(state, given, found):"
        yield f" {self._listed(self._kept)} = state"
        yield " tick = 0"
        yield f" for {self._listed(system.inputs)} in given:"
        yield from body
        for number, goal in enumerate(self._goals):
            yield f"  if {self._names[goal.name]} and {number} not in found: found[{number}] = tick"

    def _listed(self, variables: Sequence[Var]) -> str:
        return "[" + ", ".join(self._names[v.name] for v in variables) + "]"

    def _allowed(self) -> Iterator[str]:
        for var in self._system.inputs:
            yield f"  if not {self._inside(self._names[var.name], var.domain)}: return"
        before, assumed = self._formula(self._system.assume)
        yield from ("  " + line for line in before)
        yield f"  if not {assumed}: return"

    def _inside(self, name: str, domain: Domain) -> str:
        if domain.dense:
            return f"{domain.low} <= {name} <= {domain.high}"
        self._sets.append(f"d{len(self._sets)} = {{{', '.join(map(str, domain.values))}}}")
        return f"({name} in d{len(self._sets) - 1})"

    def _program(self, program: Sequence[Action], depth: int) -> Iterator[str]:
        if depth > BRANCHES:
            raise TooDeep("branches")
        indent = " " * depth
        for action in program:
            if isinstance(action, Assign):
                before, value = self._formula(action.value)
                yield from (indent + line for line in before)
                yield f"{indent}{self._names[action.var.name]} = {value}"
            else:
                assert isinstance(action, If), "a step holds no sends"
                before, condition = self._formula(action.condition)
                yield from (indent + line for line in before)
                yield f"{indent}if {condition}:"
                yield from self._program(action.then, depth + 1) if action.then else [f"{indent} pass"]
                if action.otherwise:
                    yield f"{indent}else:"
                    yield from self._program(action.otherwise, depth + 1)

    def _formula(self, expr: Expr) -> tuple[list[str], str]:
        """Lines to go before, for what occurs several times or is nested deeply, and the formula."""
        before: list[str] = []
        times = Counter(id(child) for node in nodes(expr) for child in children(node))
        texts: dict[int, tuple[str, int]] = {}
        for node in postorder(expr):
            text, deep = self._text(node, texts)
            if deep >= DEEPEST or (times[id(node)] > 1 and len(text) > SHORT):
                self._parts += 1
                before.append(f"p{self._parts} = {text}")
                text, deep = f"p{self._parts}", 0
            texts[id(node)] = text, deep
        return before, texts[id(expr)][0]

    def _text(self, expr: Expr, parts: Mapping[int, tuple[str, int]]) -> tuple[str, int]:
        """The formula, whose parts are known, and how deeply it is nested."""
        match expr:
            case Const(value):
                return (str(value) if value >= 0 else f"({value})"), 0
            case Var(name):
                return self._names[name], 0
            case Named(_, body):
                return parts[id(body)]
            case Apply(op, args):
                deep = 1 + max(parts[id(arg)][1] for arg in args)
                return OPERATIONS[op](*(parts[id(arg)][0] for arg in args)), deep
        raise AssertionError(f"{expr} speaks of the past")


__all__ = ["CompiledStep", "TooDeep"]
