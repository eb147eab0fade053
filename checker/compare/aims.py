"""What the charts compare with and wait for, found in their formulas: the values and lengths to aim at."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise, product

from rovercheck.spec_model.abstraction import Board
from rovercheck.spec_model.abstraction.interface import Carriage
from rovercheck.spec_model.abstraction.signals import BoardSignal, Raw, computed, plain
from rovercheck.spec_model.lang.action import Action, Assign, each_action, expressions
from rovercheck.spec_model.lang.chart import Component, Enabled
from rovercheck.spec_model.lang.domain import Num, Unit
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Temporal, Var
from rovercheck.spec_model.lang.operators import COMPARISONS, Op
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.lang.walk import nodes, variables

CHOICES = 8
"""A parameter with more values is left at 0."""
COMBINATIONS = 64
"""Combinations of parameters in which one comparison is looked at."""
MILLISECONDS = Unit.of("ms")
BENDS = COMPARISONS | {Op.MIN, Op.MAX, Op.ABS, Op.MOD}


@dataclass(frozen=True, order=True)
class Boundary:
    """A value of an input, in its unit, at which a comparison of the charts changes.

    With ``datum`` it is a distance from what the charts hold; with ``source`` and ``steps`` it is one while
    the source has been silent for so many steps.
    """

    signal: str
    value: Fraction
    datum: str = ""
    source: str = ""
    steps: int = 0


@dataclass(frozen=True)
class Aims:
    """Boundaries of the inputs, and lengths in steps: of timers and counters, and of a source's silence."""

    boundaries: tuple[Boundary, ...]
    timers: tuple[int, ...]
    silences: Mapping[str, tuple[int, ...]]
    means: tuple[int, ...]


@cache
def _aims(name: str, system: System, board: Board) -> Aims:
    return Aims(
        tuple(sorted(set(_boundaries(board)))),
        tuple(sorted(set(_timers(system)))),
        _silences(board),
        tuple(sorted(set(_means(system)))),
    )


def aims(board: Board) -> Aims:
    """Everything to aim at on a board."""
    return _aims(board.name, board.system, board)


def together(some: Iterable[Aims]) -> Aims:
    """All that several boards with the same inputs are aimed at with."""
    every = list(some)
    stamps = dict.fromkeys(stamp for one in every for stamp in one.silences)
    return Aims(
        tuple(sorted({b for one in every for b in one.boundaries})),
        tuple(sorted({n for one in every for n in one.timers})),
        {s: tuple(sorted({n for one in every for n in one.silences.get(s, ())})) for s in stamps},
        tuple(sorted({n for one in every for n in one.means})),
    )


def formulas(system: System) -> list[Expr]:
    """Every guard and every expression of an action, and what enables a subsystem."""
    found = [e for c in system.charts for e in c.expressions]
    found += [e for b in system.blocks for e in expressions(b.do)]
    return found + list(_enabling(system.components))


def _enabling(components: Iterable[Component]) -> Iterator[Expr]:
    for component in components:
        if isinstance(component, Enabled):
            yield component.by
            yield from _enabling(component.components)


# --- lengths ------------------------------------------------------------------------------------


def _timers(system: System) -> Iterator[int]:
    """The spans of temporal words, and the constants that counters are compared with."""
    for node in nodes(*formulas(system)):
        match node:
            case Temporal(_, _, span) if span is not None:
                yield span.ticks(system.step_ms)
            case Apply(op, (Var() as counter, Const(limit)), _) if op in COMPARISONS and limit > 1:
                if counter.name in system.written and _counts(counter):
                    yield limit


def _counts(counter: Var) -> bool:
    """Whether a variable may be a count of steps: a hidden whole number without unit."""
    return counter.hidden and isinstance(counter.sort, Num) and not counter.sort.unit


def _means(system: System) -> Iterator[int]:
    """The mean gaps in steps that a record is compared with: ``sum of gaps > number * limit``."""
    for node in nodes(*formulas(system)):
        match node:
            case Apply(Op.GT, (total, Apply(Op.MUL | Op.SCALE, (Var(), Const(limit)), _)), _):
                in_ms = isinstance(total.sort, Num) and total.sort.unit == MILLISECONDS
                yield limit // system.step_ms if in_ms else limit


def stamp_of_age(board: Board) -> dict[str, str]:
    """The stamp from which each age is computed."""
    return {v.var.name: v.signal.name for v in board.interface.by_carriage[Carriage.AGE]}


def _silences(board: Board) -> dict[str, tuple[int, ...]]:
    """The ages in steps that the charts compare each stamp's with."""
    stamps = stamp_of_age(board)
    found: dict[str, set[int]] = {stamp: set() for stamp in stamps.values()}
    for node in _comparisons(board.system):
        for name, limit in _age_limits(node):
            if name in stamps:
                found[stamps[name]].add(limit)
    return {stamp: tuple(sorted(limits)) for stamp, limits in found.items()}


def _age_limits(node: Apply) -> Iterator[tuple[str, int]]:
    match node.args:
        case (Var(name, domain), Const(limit, Num(resolution))) if isinstance(domain.sort, Num):
            yield name, int(limit * resolution / domain.sort.resolution)
        case (Apply(Op.SCALE, (Var(name), Const(factor)), _), Const(limit)):
            yield name, limit // factor


# --- values -------------------------------------------------------------------------------------


def _comparisons(system: System) -> Iterator[Apply]:
    """Every node at which a formula bends or jumps for a number."""
    for node in nodes(*formulas(system)):
        if isinstance(node, Apply) and isinstance(node.args[0].sort, Num) and node.op in BENDS:
            yield node


def _boundaries(board: Board) -> Iterator[Boundary]:
    signals = {s.name: s for s in board.inputs}
    stamps = stamp_of_age(board)
    definitions = _definitions(board.system)
    for node in _comparisons(board.system):
        for written in _in_terms_of_inputs(node, board.system, definitions):
            for var in variables(written).values():
                signal = signals.get(plain(var))
                if signal and var.name in board.system.inputs and isinstance(var.sort, Num):
                    yield from _of(signal, var, written, stamps)


def _definitions(system: System) -> dict[str, list[Expr]]:
    """What is assigned to each variable, constants left out."""
    actions: list[Action] = [a for c in system.charts for a in c.all_actions]
    actions += [a for b in system.blocks for a in b.do]
    found: dict[str, list[Expr]] = {}
    for action in each_action(actions):
        if isinstance(action, Assign):
            read = variables(action.value)
            if read and action.var.name not in read:
                found.setdefault(action.var.name, []).append(action.value)
    return found


def _in_terms_of_inputs(
    node: Apply, system: System, definitions: Mapping[str, list[Expr]]
) -> Iterator[Apply]:
    """The comparison, with what is computed from inputs replaced by how it is computed."""
    own = variables(node)
    if any(name in system.inputs for name in own):
        yield node
        return
    for name in own:
        for value in definitions.get(name, ()):
            if any(n in system.inputs for n in variables(value)):
                replaced = _replace(node, name, value)
                assert isinstance(replaced, Apply)
                yield replaced


def _replace(expr: Expr, name: str, value: Expr) -> Expr:
    match expr:
        case Var(found) if found == name:
            return value
        case Named(label, body):
            return Named(label, _replace(body, name, value))
        case Apply(op, args, sort):
            return Apply(op, tuple(_replace(a, name, value) for a in args), sort)
    return expr


def _of(signal: BoardSignal, var: Var, node: Apply, stamps: Mapping[str, str]) -> Iterator[Boundary]:
    """The boundaries of one input in a comparison, for every choice of what else it reads."""
    assert isinstance(var.sort, Num)
    others = [v for v in variables(node).values() if v.name != var.name]
    ages = [v for v in others if v.name in stamps]
    held = [v for v in others if _distance(v, var)]
    rooms = [_room(v, stamps) for v in others]
    for values in list(product(*rooms))[:COMBINATIONS]:
        at = dict(zip((v.name for v in others), values, strict=True))
        for root in _roots(signal, var, node, at):
            yield Boundary(
                signal.name,
                root * var.sort.resolution,
                held[0].name if held else "",
                stamps[ages[0].name] if ages else "",
                int(at[ages[0].name]) if ages else 0,
            )


AGES = (25, 26, 50, 250, 625)
"""Ages in steps at which an estimate is aimed at: from the first that counts on up to 12.5 s."""


def _room(other: Var, stamps: Mapping[str, str]) -> tuple[int, ...]:
    if other.name in stamps:
        return AGES
    return (
        tuple(other.domain.values)
        if len(other.domain) <= CHOICES
        else (0 if 0 in other.domain else other.init,)
    )


def _distance(other: Var, var: Var) -> bool:
    """Whether only the distance of the input from a datum of the charts counts."""
    same = isinstance(other.sort, Num) and isinstance(var.sort, Num) and other.sort.unit == var.sort.unit
    return (
        same and bool(other.sort.unit) and len(other.domain) > CHOICES
        if isinstance(other.sort, Num)
        else False
    )


def _roots(signal: BoardSignal, var: Var, node: Apply, at: Mapping[str, int]) -> Iterator[Fraction]:
    """Where the two sides of the comparison are equal, and not so on both sides of it."""
    assert isinstance(var.sort, Num)
    ends = (Fraction(str(signal.low)), Fraction(str(signal.high)))
    points = sorted({*map(Fraction, var.domain.values), *(e / var.sort.resolution for e in ends)})
    gaps = [_gap(node, {**at, var.name: p}) for p in points]
    for k, gap in enumerate(gaps):
        if gap == 0 and any(gaps[j] for j in (k - 1, k + 1) if 0 <= j < len(gaps)):
            yield points[k]
    for (a, fa), (b, fb) in pairwise(zip(points, gaps, strict=True)):
        if fa * fb < 0:
            root = a + (b - a) * fa / (fa - fb)
            if _gap(node, {**at, var.name: root}) == 0:
                yield root


def _gap(node: Apply, at: Mapping[str, Raw]) -> Fraction:
    """Left side minus right side; for a remainder or an absolute value, what it is taken of."""
    known = computed(at)
    if node.op is Op.ABS:
        return Fraction(evaluate(node.args[0], known))
    if node.op is Op.MOD:
        return Fraction(evaluate(node, known))
    return Fraction(evaluate(node.args[0], known)) - Fraction(evaluate(node.args[1], known))
