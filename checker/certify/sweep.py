"""Checking a large closed set without a solver: all its states at once, vector of inputs by vector.

The formulas of a tick are evaluated on columns of numbers.  Neither the printing of formulas nor a solver
is trusted, nor anything of the engine: the set is unfolded from its diagram.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from itertools import accumulate, product
from math import prod
from operator import mul
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rovercheck.checker.certify.diagram import CertifiedDiagram, count, positions
from rovercheck.checker.certify.outcome import Accepted, Rejected, TooMuch, assignment_text
from rovercheck.checker.certify.question import CertifyQuestion
from rovercheck.checker.system.intervals import intervals, postorder
from rovercheck.spec_model.lang.domain import Bool, Domain
from rovercheck.spec_model.lang.expr import Apply, Const, Expr, Named, Var
from rovercheck.spec_model.lang.operators import Op
from rovercheck.spec_model.lang.walk import variables

MOST = 60_000_000_000
"""Numbers that are computed at most: three or four minutes."""
CALLS = 20_000_000
"""Columns that are computed at most."""
ROWS = 1 << 14
"""States in a column."""
FIRST_BITS, BITS = 63, 32
"""Bits of the first word of a row, and of the others, beside which the number of all before has room."""

Column = NDArray[Any]
Columns = Mapping[str, Column]
Member = Callable[[Columns], NDArray[np.bool_]]


def swept(asked: CertifyQuestion, diagram: CertifiedDiagram) -> Accepted | Rejected | TooMuch:
    """Whether the closed set meets its obligations, shown on all of its states."""
    domains = {v.name: v.domain for v in asked.state}
    roots = (*asked.tick.next.values(), *asked.tick.assume)
    if not diagram.variables:
        return TooMuch("the diagram asks for no variable")
    if variables(*roots).keys() & domains.keys() - set(diagram.variables):
        return TooMuch("a tick reads a variable that the diagram does not ask for")
    size = count(diagram, [domains[n] for n in diagram.variables])
    choices = prod(len(v.domain) for v in asked.tick.inputs)
    formulas = Formulas(asked.tick.inputs, asked.tick.assume, asked.tick.next)
    if size * formulas.work > MOST or (size // ROWS + 1) * formulas.work > CALLS:
        return TooMuch(f"{size:,} states and {choices:,} vectors of inputs are too many to try")
    if any(max(-i.low, i.high) >= 1 << 62 for i in intervals(*roots).values()):
        return TooMuch("a formula needs more than 63 bits")
    for frozen in product(*(v.domain.values for v in asked.tick.frozen)):
        initial = {v.name: v.init for v in asked.tick.variables}
        initial |= dict(zip((v.name for v in asked.tick.frozen), frozen, strict=True))
        if initial not in diagram:
            return Rejected("initiation", assignment_text(asked.state, initial))
    try:
        rows = SweepRows(diagram, domains, size)
    except DeadEnd:
        return TooMuch("the diagram has paths that lead to no state")
    for at in rows:
        broken = _broken(asked, formulas, rows.contain, at)
        if broken is not None:
            return broken
    return Accepted(f"{size:,} states and {choices:,} vectors of inputs tried")


def _broken(asked: CertifyQuestion, formulas: "Formulas", member: Member, at: Columns) -> Rejected | None:
    """What is wrong with the ticks from some states."""
    rows = len(next(iter(at.values())))
    for here, allowed, following in formulas.each(at):
        after = {n: np.broadcast_to(c, rows) for n, c in following.items()}
        wrong = _wrong(asked, member, {**at, **after})
        for obligation, bad in wrong.items():
            found = np.flatnonzero(allowed & bad)
            if len(found):
                values = {n: int(np.broadcast_to(c, rows)[found[0]]) for n, c in here.items()}
                reached = {n: int(c[found[0]]) for n, c in after.items()}
                words = assignment_text((*asked.state, *asked.tick.inputs), values)
                return Rejected(obligation, f"{words}; after 1 ticks {assignment_text(asked.state, reached)}")
    return None


def _wrong(asked: CertifyQuestion, member: Member, after: Columns) -> dict[str, NDArray[np.bool_]]:
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


class DeadEnd(Exception):
    """A diagram has more paths than states."""


class SweepRows:
    """The states of a diagram packed into words, among which others are looked up.

    The code of a value is its place in the domain.  Each variable has its bits in one of the words; those
    after the first are looked up together with the number of all words before.  Raises ``DeadEnd`` where
    there are more than ``size`` paths, which only a diagram has that was made by hand.
    """

    def __init__(self, diagram: CertifiedDiagram, domains: Mapping[str, Domain], size: int) -> None:
        self._size = size
        values_of = (np.array(domains[name].values, dtype=np.int64) for name in diagram.variables)
        self._columns = list(zip(diagram.variables, values_of, strict=True))
        self._at: list[tuple[int, int]] = []
        word, used = 0, 0
        for _, values in self._columns:
            bits = (len(values) - 1).bit_length()
            if used + bits > (BITS if word else FIRST_BITS):
                word, used = word + 1, 0
            self._at.append((word, used))
            used += bits
        self._words: Column = np.stack(self._unfolded(self._edges(diagram), diagram.root))
        self._known: list[Column] = []
        number: Column = np.zeros(self._words.shape[1], dtype=np.int64)
        for column in self._words:
            known, number = np.unique(number << BITS | column, return_inverse=True)
            self._known.append(known)

    def __iter__(self) -> Iterator[Columns]:
        """The states, some of them at a time."""
        for first in range(0, self._words.shape[1], ROWS):
            words = self._words[:, first : first + ROWS]
            yield {
                name: values[words[word] >> shift & (1 << (len(values) - 1).bit_length()) - 1]
                for (name, values), (word, shift) in zip(self._columns, self._at, strict=True)
            }

    def contain(self, at: Columns) -> NDArray[np.bool_]:
        """Which rows are among these."""
        rows = len(at[self._columns[0][0]])
        words, found = np.zeros((len(self._known), rows), dtype=np.int64), np.ones(rows, dtype=np.bool_)
        for (name, values), (word, shift) in zip(self._columns, self._at, strict=True):
            code = _code(values, at[name])
            found &= values[code] == at[name]
            words[word] |= code << shift
        number: Column = np.zeros(rows, dtype=np.int64)
        for known, column in zip(self._known, words, strict=True):
            wanted = number << BITS | column
            number = np.minimum(np.searchsorted(known, wanted), len(known) - 1)
            found &= known[number] == wanted
        return found

    def _edges(self, diagram: CertifiedDiagram) -> "Edges":
        nodes = diagram.nodes
        sizes = nodes.high - nodes.low + 1
        edge = np.repeat(np.arange(len(sizes)), sizes)
        value = nodes.low[edge] + np.arange(len(edge)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
        code, own = np.zeros(len(edge), dtype=np.int64), np.zeros(len(edge), dtype=np.bool_)
        asking = nodes.variable[nodes.owner][edge]
        for position, (_, values) in enumerate(self._columns):
            here = np.flatnonzero(asking == position)
            code[here] = _code(values, value[here])
            own[here] = values[code[here]] == value[here]
        owner = nodes.owner[edge][own] + 1
        ends = np.searchsorted(owner, np.arange(len(nodes) + 2))
        return Edges(positions(diagram), ends[:-1], ends[1:], code[own], nodes.to[edge][own])

    def _unfolded(self, edges: "Edges", root: int) -> list[Column]:
        """The words of all paths of a diagram, variable by variable."""
        done: list[Column] = []
        number, last, origin = np.array([root]), np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64)
        for position, ((_, values), (word, shift)) in enumerate(zip(self._columns, self._at, strict=True)):
            if word > len(done):
                done = [*(column[origin] for column in done), last]
                last, origin = np.zeros_like(number), np.arange(len(number))
            free = edges.position[number] != position
            sizes = np.where(free, len(values), edges.last[number] - edges.first[number])
            if sizes.sum() > self._size:
                raise DeadEnd
            rows = np.repeat(np.arange(len(number)), sizes)
            code = np.arange(len(rows)) - np.repeat(np.cumsum(sizes) - sizes, sizes)
            number, asking = number[rows], np.flatnonzero(~free[rows])
            taken = edges.first[number[asking]] + code[asking]
            code[asking], number[asking] = edges.code[taken], edges.to[taken]
            last, origin = last[rows] | code << shift, origin[rows]
        return [*(column[origin] for column in done), last]


@dataclass(frozen=True)
class Edges:
    """The edges of a diagram value by value: from ``first`` to before ``last`` those of a node, by number.

    ``position`` is that of the variable that a node asks; ``code`` and ``to`` belong to an edge.
    """

    position: Column
    first: Column
    last: Column
    code: Column
    to: Column


def _code(values: Column, found: Column) -> Column:
    """The place of each value in a domain, or any place of one that is not in there."""
    if values[-1] - values[0] == len(values) - 1:
        return np.asarray(np.clip(found - values[0], 0, len(values) - 1))
    return np.minimum(np.searchsorted(values, found), len(values) - 1)


# --- formulas ------------------------------------------------------------------------------------


class Formulas:
    """The assumption and the next values as columns, input by input.

    What depends on the first inputs alone is computed once for all values of the others; the inputs that
    most depends on come first.
    """

    def __init__(self, inputs: Sequence[Var], assume: Sequence[Expr], following: Mapping[str, Expr]) -> None:
        self._next = following
        names, read = {v.name for v in inputs}, dict[int, frozenset[str]]()
        nodes = list(postorder(*assume, *following.values()))
        for node in nodes:
            own = {node.name} & names if isinstance(node, Var) else set[str]()
            read[id(node)] = frozenset(own).union(*(read[id(inner)] for inner in _inside_of(node)))
        readers = Counter(name for node in nodes for name in read[id(node)])
        self._inputs = sorted(inputs, key=lambda v: -readers[v.name])
        level = {v.name: position for position, v in enumerate(self._inputs, 1)}
        self._nodes: list[list[Expr]] = [[] for _ in range(len(inputs) + 1)]
        self._assumed: list[list[Expr]] = [[] for _ in range(len(inputs) + 1)]
        for found, wanted in ((self._nodes, nodes), (self._assumed, assume)):
            for one in wanted:
                found[max((level[name] for name in read[id(one)]), default=0)].append(one)

    @property
    def work(self) -> int:
        """How many formulas are evaluated for all inputs of one state."""
        choices = accumulate((len(v.domain) for v in self._inputs), mul, initial=1)
        return sum(len(own) * times for own, times in zip(self._nodes, choices, strict=True))

    def each(self, at: Columns) -> Iterator[tuple[Columns, NDArray[np.bool_], Columns]]:
        """Each vector of inputs beside the states, where it is allowed, and the next values.

        One that the assumption allows nowhere is left out.
        """
        return self._each(0, at, {}, np.ones(len(next(iter(at.values()))), dtype=np.bool_))

    def _each(
        self, level: int, at: Columns, known: Mapping[int, Column], allowed: NDArray[np.bool_]
    ) -> Iterator[tuple[Columns, NDArray[np.bool_], Columns]]:
        found = columns(self._nodes[level], at, known)
        for part in self._assumed[level]:
            allowed = allowed & found[id(part)]
        if not allowed.any():
            return
        if level == len(self._inputs):
            yield at, allowed, {n: found[id(e)] for n, e in self._next.items()}
            return
        var = self._inputs[level]
        for value in var.domain.values:
            yield from self._each(level + 1, {**at, var.name: np.array(value)}, found, allowed)


def columns(nodes: Iterable[Expr], at: Columns, known: Mapping[int, Column]) -> dict[int, Column]:
    """What is ``known``, and the values of more formulas, by ``id``; those inside of one come before it."""
    found = dict(known)
    for node in nodes:
        found[id(node)] = _node(node, at, found)
    return found


def _inside_of(node: Expr) -> Sequence[Expr]:
    match node:
        case Named(_, body):
            return (body,)
        case Apply(_, args, _):
            return args
    return ()


def _node(node: Expr, at: Columns, known: Mapping[int, Column]) -> Column:
    """The column of a formula: truth values for one that is true or false, else 64 bits."""
    kind = np.bool_ if isinstance(node.sort, Bool) else np.int64
    match node:
        case Const(value, _):
            return np.array(value, dtype=kind)
        case Var(name):
            return at[name].astype(kind, copy=False)
        case Named(_, body):
            return known[id(body)]
        case Apply(op, args, _):
            return np.asarray(OPERATIONS[op](*(known[id(a)] for a in args)), dtype=kind)
    raise AssertionError(f"{node} speaks of the past")


def _chosen(condition: Column, then: Column, otherwise: Column) -> Column:
    """One of two; where all rows choose alike, as most do, without copying it."""
    if condition.all():
        return then
    return np.where(condition, then, otherwise) if condition.any() else otherwise


OPERATIONS: Mapping[Op, Callable[..., NDArray[Any]]] = {
    Op.NOT: np.logical_not,
    Op.AND: lambda *args: reduce(np.logical_and, args),
    Op.OR: lambda *args: reduce(np.logical_or, args),
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
"""Every operator on columns, written apart from that of the engines."""
