"""Cones of a graph as clauses (Tseitin, 1968), for SAT solvers.

Conjunctions used once are merged into the conjunction that uses them, and case distinctions and
exclusive ors are recognised, so that there are fewer variables than nodes.
"""

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from rovercheck.checker.encode.bits.aig import Aig, Literal

Clause = list[int]


class Cnf:
    """The clauses of cones of one graph.

    A variable of a solver is a positive number and its negation the negative one (DIMACS).  The nodes
    ``first`` are variables 1, 2, ... in their order; the next variable is always true.  ``definitions``
    has the clauses that define a variable by others; variables without a definition are inputs.
    """

    def __init__(self, aig: Aig, first: Sequence[Literal], roots: Iterable[Literal]) -> None:
        self._aig = aig
        self._variable = {literal >> 1: number for number, literal in enumerate(first, 1)}
        self.true = len(first) + 1
        self._variable[0] = -self.true
        self.variables = self.true
        """The greatest number of a variable."""
        self.definitions: dict[int, tuple[Clause, ...]] = {self.true: ([self.true],)}
        roots = list(roots)
        cone = aig.cone(roots)
        gates = [node for node in cone if aig.fanins[node] != (0, 0)]
        used = Counter(fanin >> 1 for node in gates for fanin in aig.fanins[node])
        self._shared = {r >> 1 for r in roots} | {node for node, count in used.items() if count > 1}
        self._encode(gates, [node for node in cone if aig.fanins[node] == (0, 0)])

    @property
    def clauses(self) -> list[Clause]:
        """All definitions together."""
        return [clause for definition in self.definitions.values() for clause in definition]

    def literal(self, literal: Literal) -> int:
        """The number that stands for a literal of the graph.  Raises ``KeyError`` outside the cones."""
        number = self._variable[literal >> 1]
        return -number if literal & 1 else number

    def _encode(self, gates: Sequence[int], inputs: Sequence[int]) -> None:
        for node in inputs:
            self._number(node)
        wanted, todo = dict[int, list[Literal] | tuple[Literal, Literal, Literal]](), list(gates[::-1])
        needed = {node for node in gates if node in self._shared}
        for node in todo:  # from the roots down: what is needed is known before its turn comes
            if node in needed:
                case = self._case(node)
                wanted[node] = self._merged(node) if case is None else case
                needed.update(literal >> 1 for literal in wanted[node])
        for node in reversed(wanted):
            output, what = self._number(node), wanted[node]
            numbers = [self.literal(x) for x in what]
            made = _conjunction(output, numbers) if isinstance(what, list) else _case(output, *numbers)
            self.definitions[output] = tuple(made)

    def _number(self, node: int) -> int:
        if node not in self._variable:
            self.variables += 1
            self._variable[node] = self.variables
        return self._variable[node]

    def _merged(self, node: int) -> list[Literal]:
        """The literals of a conjunction whose parts are used nowhere else."""
        found, todo = dict[Literal, None](), list(self._aig.fanins[node])
        while todo:
            literal = todo.pop()
            inner = literal >> 1
            if literal & 1 or inner in self._shared or self._aig.fanins[inner] == (0, 0):
                found[literal] = None
            else:
                todo += self._aig.fanins[inner]
        return list(found)

    def _case(self, node: int) -> tuple[Literal, Literal, Literal] | None:
        """Test, then and otherwise of a node that is a case distinction: ``!(a & !b) & !(!a & !c)``."""
        p, q = self._aig.fanins[node]
        if not (p & q & 1) or {p >> 1, q >> 1} & self._shared:
            return None
        if (0, 0) in (self._aig.fanins[p >> 1], self._aig.fanins[q >> 1]):
            return None
        (a, b), (c, d) = self._aig.fanins[p >> 1], self._aig.fanins[q >> 1]
        for x, y in ((a, b), (b, a)):
            for z, w in ((c, d), (d, c)):
                if x == z ^ 1:
                    return x, y ^ 1, w ^ 1
        return None


def _conjunction(output: int, inputs: Sequence[int]) -> Iterator[Clause]:
    yield from ([-output, number] for number in inputs)
    yield [output, *(-number for number in inputs)]


def _case(output: int, test: int, then: int, other: int) -> Iterator[Clause]:
    """The last two clauses follow from the others and let a solver see more by propagation."""
    yield [-test, -then, output]
    yield [-test, then, -output]
    yield [test, -other, output]
    yield [test, other, -output]
    if abs(then) != abs(other):
        yield [-then, -other, output]
        yield [then, other, -output]
