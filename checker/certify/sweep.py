"""Checking a large closed set without a solver: all its valuations at once, vector of inputs by vector.

The formulas of a tick are evaluated on columns of numbers.  Neither the printing of formulas nor a solver
is trusted, nor anything of the engine: the set is unfolded from its diagram.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import product
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from checker.certify.diagram import TRUE, Diagram, count
from checker.certify.outcome import Accepted, Rejected, TooMuch, told
from checker.certify.question import Question
from checker.encode.intervals import intervals, postorder
from spec_model.lang.domain import Domain
from spec_model.lang.expr import Apply, Const, Expr, Named, Var
from spec_model.lang.operators import Op
from spec_model.lang.walk import variables

MOST = 20_000_000_000
"""Numbers that are computed at most: about a minute."""
CALLS = 20_000_000
"""Columns that are computed at most."""
ROWS = 1 << 14
"""Valuations in a column."""

Column = NDArray[np.int64]
Columns = Mapping[str, Column]
Member = Callable[[Columns], NDArray[np.bool_]]


def swept(asked: Question, diagram: Diagram) -> Accepted | Rejected | TooMuch:
    """Whether the closed set meets its obligations, shown on all of its valuations."""
    domains = {v.name: v.domain for v in asked.state}
    roots = (*asked.tick.next.values(), *asked.tick.assume)
    if not diagram.variables:
        return TooMuch("the diagram asks for no variable")
    if variables(*roots).keys() & domains.keys() - set(diagram.variables):
        return TooMuch("a tick reads a variable that the diagram does not ask for")
    size = count(diagram, [domains[n] for n in diagram.variables])
    choices, nodes = prod(len(v.domain) for v in asked.tick.inputs), len(list(postorder(*roots)))
    if size * choices * nodes > MOST or choices * nodes * (size // ROWS + 1) > CALLS:
        return TooMuch(f"{size:,} valuations and {choices:,} vectors of inputs are too many to try")
    if any(max(-i.low, i.high) >= 1 << 62 for i in intervals(*roots).values()):
        return TooMuch("a formula needs more than 63 bits")
    for frozen in product(*(v.domain.values for v in asked.tick.frozen)):
        initial = {v.name: v.init for v in asked.tick.variables}
        initial |= dict(zip((v.name for v in asked.tick.frozen), frozen, strict=True))
        if initial not in diagram:
            return Rejected("initiation", told(asked.state, initial))
    formulas = Formulas(asked.tick.inputs, asked.tick.assume, asked.tick.next)
    member = partial(contained, diagram.root, levels(diagram, domains))
    for at in unfolded(diagram.root, levels(diagram, domains)):
        broken = _broken(asked, formulas, member, at)
        if broken is not None:
            return broken
    return Accepted(f"{size:,} valuations and {choices:,} vectors of inputs tried")


def _broken(asked: Question, formulas: "Formulas", member: Member, at: Columns) -> Rejected | None:
    """What is wrong with the ticks from some valuations."""
    names = [v.name for v in asked.tick.inputs]
    rows = len(next(iter(at.values())))
    of_state = formulas.of_state(at)
    for inputs in product(*(v.domain.values for v in asked.tick.inputs)):
        here = {**at, **dict(zip(names, (np.array(i) for i in inputs), strict=True))}
        assumed, after = formulas(here, of_state)
        allowed = np.ones(rows, dtype=bool)
        for part in assumed:
            allowed &= part != 0
        after = {n: np.broadcast_to(c, rows) for n, c in after.items()}
        wrong = _wrong(asked, member, {**at, **after})
        for obligation, bad in wrong.items():
            found = np.flatnonzero(allowed & bad)
            if len(found):
                values = {n: int(np.broadcast_to(c, rows)[found[0]]) for n, c in here.items()}
                reached = {n: int(c[found[0]]) for n, c in after.items()}
                words = told((*asked.state, *asked.tick.inputs), values)
                return Rejected(obligation, f"{words}; after 1 ticks {told(asked.state, reached)}")
    return None


def _wrong(asked: Question, member: Member, after: Columns) -> dict[str, NDArray[np.bool_]]:
    """Which rows break which obligation."""
    outside = [~_inside(v.domain, after[v.name]) for v in asked.tick.variables]
    reached = [after[claim] != 0 for claim in asked.claims]
    return {
        "domains": np.logical_or.reduce(outside),
        "safety": np.logical_or.reduce(reached),
        "consecution": ~member(after),
    }


def _inside(domain: Domain, values: Column) -> NDArray[np.bool_]:
    if domain.dense:
        return (domain.low <= values) & (values <= domain.high)
    return np.isin(values, np.array(domain.values))


# --- the set -------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Level:
    """What a diagram asks of one variable, as tables sorted by node.

    ``edges`` has rows of node, low, high, to; ``pairs`` of node, value, to; ``values`` are the domain.
    """

    name: str
    edges: Column
    pairs: Column
    values: Column


def levels(diagram: Diagram, domains: Mapping[str, Domain]) -> list[Level]:
    """The levels of a diagram, from the first variable to the last."""
    edges: list[list[tuple[int, int, int, int]]] = [[] for _ in diagram.variables]
    for number, node in enumerate(diagram.nodes, 1):
        edges[node.variable] += ((number, *edge) for edge in node.edges)
    return [
        _level(name, np.array(rows, dtype=np.int64).reshape(len(rows), 4), domains[name])
        for name, rows in zip(diagram.variables, edges, strict=True)
    ]


def _level(name: str, edges: Column, domain: Domain) -> Level:
    sizes = edges[:, 2] - edges[:, 1] + 1
    edge = np.repeat(np.arange(len(edges)), sizes)
    values = edges[edge, 1] + np.arange(len(edge)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    pairs = np.stack([edges[edge, 0], values, edges[edge, 3]], axis=1)
    return Level(name, edges, pairs[_inside(domain, values)], np.array(domain.values, dtype=np.int64))


def unfolded(root: int, asked: Sequence[Level]) -> Iterator[Columns]:
    """The valuations of the set, some of them at a time."""
    yield from _unfolded(np.array([root]), asked, ())


def _unfolded(numbers: Column, asked: Sequence[Level], done: tuple[Column, ...]) -> Iterator[Columns]:
    """Those that begin with the rows of ``done``, each at the node that ``numbers`` says."""
    if len(done) == len(asked):
        yield dict(zip((level.name for level in asked), done, strict=True))
        return
    level = asked[len(done)]
    first, last = (np.searchsorted(level.pairs[:, 0], numbers, side) for side in ("left", "right"))
    free = ~np.isin(numbers, level.edges[:, 0])
    sizes = np.where(free, len(level.values), last - first)
    for part in np.array_split(np.arange(len(numbers)), int(sizes.sum()) // ROWS + 1):
        rows = np.repeat(part, sizes[part])
        if len(rows):
            within = np.arange(len(rows)) - np.repeat(np.cumsum(sizes[part]) - sizes[part], sizes[part])
            pairs = level.pairs[np.where(free[rows], 0, first[rows] + within)] if len(level.pairs) else _NONE
            values = np.where(free[rows], level.values[np.where(free[rows], within, 0)], pairs[:, 1])
            following = np.where(free[rows], numbers[rows], pairs[:, 2])
            yield from _unfolded(following, asked, (*(c[rows] for c in done), values))


_NONE: Column = np.zeros((1, 3), dtype=np.int64)


def contained(root: int, asked: Sequence[Level], at: Columns) -> NDArray[np.bool_]:
    """Which rows belong to the set."""
    numbers = np.full(len(next(iter(at.values()))), root)
    for level in asked:
        asking = np.flatnonzero(np.isin(numbers, level.edges[:, 0]))
        numbers[asking] = _next(level.edges, numbers[asking], at[level.name][asking])
    return np.asarray(numbers == TRUE)


def _next(edges: Column, numbers: Column, values: Column) -> Column:
    """Where the edges of each row's node lead with its value; -1 for nowhere.  Edges are in order."""
    if not len(numbers):
        return numbers
    least = min(int(edges[:, 1].min()), int(values.min(initial=0)))
    span = max(int(edges[:, 2].max()), int(values.max(initial=0))) - least + 1
    keys = edges[:, 0] * span + edges[:, 1] - least
    found = np.searchsorted(keys, numbers * span + values - least, "right") - 1
    edge = edges[np.maximum(found, 0)]
    hit = (found >= 0) & (edge[:, 0] == numbers) & (edge[:, 1] <= values) & (values <= edge[:, 2])
    return np.where(hit, edge[:, 3], -1)


# --- formulas ------------------------------------------------------------------------------------


class Formulas:
    """The assumption and the next values as columns.

    What no input changes is computed once for all vectors of inputs.
    """

    def __init__(self, inputs: Sequence[Var], assume: Sequence[Expr], following: Mapping[str, Expr]) -> None:
        self._assume, self._next = assume, following
        names, moved = {v.name for v in inputs}, set[int]()
        nodes = list(postorder(*assume, *following.values()))
        for node in nodes:
            of_input = isinstance(node, Var) and node.name in names
            if of_input or any(id(inner) in moved for inner in _inside_of(node)):
                moved.add(id(node))
        self._still = [node for node in nodes if id(node) not in moved]
        self._moved = [node for node in nodes if id(node) in moved]

    def of_state(self, at: Columns) -> dict[int, Column]:
        """The columns of all that depends on no input, by ``id``."""
        return _columns(self._still, at, {})

    def __call__(self, at: Columns, known: Mapping[int, Column]) -> tuple[list[Column], dict[str, Column]]:
        """The conjuncts of the assumption, and the next values; ``known`` is what ``of_state`` gives."""
        found = _columns(self._moved, at, dict(known))
        return [found[id(e)] for e in self._assume], {n: found[id(e)] for n, e in self._next.items()}


def _columns(nodes: Sequence[Expr], at: Columns, known: dict[int, Column]) -> dict[int, Column]:
    for node in nodes:
        known[id(node)] = _node(node, at, known)
    return known


def _inside_of(node: Expr) -> Sequence[Expr]:
    match node:
        case Named(_, body):
            return (body,)
        case Apply(_, args, _):
            return args
    return ()


def _node(node: Expr, at: Columns, known: Mapping[int, Column]) -> Column:
    match node:
        case Const(value, _):
            return np.array(value, dtype=np.int64)
        case Var(name):
            return at[name]
        case Named(_, body):
            return known[id(body)]
        case Apply(op, args, _):
            return np.asarray(_MEANING[op](*(known[id(a)] for a in args)), dtype=np.int64)
    raise AssertionError(f"{node} speaks of the past")


def _all(*args: Column) -> NDArray[Any]:
    result = np.asarray(args[0] != 0)
    for other in args[1:]:
        result = result & (other != 0)
    return result


def _chosen(condition: Column, then: Column, otherwise: Column) -> NDArray[Any]:
    return np.where(condition != 0, then, otherwise)


_MEANING: dict[Op, Callable[..., NDArray[Any]]] = {
    Op.NOT: lambda a: 1 - a,
    Op.AND: _all,
    Op.OR: lambda *args: 1 - _all(*(1 - a for a in args)).astype(np.int64),
    Op.ITE: _chosen,
    Op.EQ: lambda a, b: a == b,
    Op.NE: lambda a, b: a != b,
    Op.LT: lambda a, b: a < b,
    Op.LE: lambda a, b: a <= b,
    Op.GT: lambda a, b: a > b,
    Op.GE: lambda a, b: a >= b,
    Op.ADD: lambda a, b: a + b,
    Op.SUB: lambda a, b: a - b,
    Op.NEG: lambda a: -a,
    Op.MUL: lambda a, b: a * b,
    Op.SCALE: lambda a, b: a * b,
    Op.DIV: lambda a, b: a // b,
    Op.MOD: lambda a, b: a % b,
    Op.ABS: np.abs,
    Op.MIN: np.minimum,
    Op.MAX: np.maximum,
    Op.BIT: lambda a, b: a >> b & 1,
}
OPERATORS = frozenset(_MEANING)
"""The operators that are evaluated."""
