"""Functions over the bits of a circuit as decision diagrams of one manager, in one order of variables.

Every bit has a variable, and below it, if it is a latch that may change, one for its next value.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import count

from oxidd.bcdd import BCDDFunction as Function
from oxidd.bcdd import BCDDManager, BCDDSubstitution
from oxidd.util import BooleanOperator, DDMemoryError

from rovercheck.checker.encode.bits import FALSE, Bit, Circuit, Literal
from rovercheck.checker.encode.bits.inputs import InputCut

_CACHED = 1 << 20
"""Entries of the cache at most: it is zeroed at once, which should not take longer than a small search."""
_LITTLE = 1 << 21
"""Nodes below which nothing is removed."""


class Overdrawn(Exception):
    """More nodes were made than were granted."""


class NodeStore:
    """The nodes of all diagrams of a process: at most so many at a time.

    There is one, since each reserves a gigabyte of address space for the stacks of its threads and gives
    it back late.  Building a diagram raises ``DDMemoryError`` when there is no node left.
    """

    def __init__(self, nodes: int) -> None:
        self.manager = BCDDManager(nodes, min(nodes // 4, _CACHED), 1)
        self._nodes = nodes
        self._removed = 0
        self._full = _LITTLE

    @property
    def used(self) -> int:
        """Nodes in use, and those not yet removed."""
        return self.manager.approx_num_inner_nodes()

    @property
    def made(self) -> int:
        """Nodes made so far, as a measure of work."""
        return self.used + self._removed

    def tidy(self) -> None:
        """Remove what nobody refers to if the nodes have doubled since the last time, or half are used."""
        if self.used > min(self._full, self._nodes // 2):
            self._removed += self.manager.gc()
            self._full = max(_LITTLE, 2 * self.used)


class Space:
    """The functions over the latches of a circuit and the cut of its inputs, in one order of variables.

    ``current`` and ``next`` give the variable of a bit by its literal, ``hidden`` that of an input which the
    cut stands for; latches that keep their value have no next one.  ``granted`` is how many nodes may be
    made before ``Overdrawn`` is raised.
    """

    def __init__(
        self, store: NodeStore, circuit: Circuit, cut: InputCut, order: Sequence[str], granted: int | None
    ) -> None:
        self.circuit = circuit
        self.cut = cut
        self.granted = granted
        self.current: dict[Literal, int] = {}
        self.next: dict[Literal, int] = {}
        self.hidden: dict[Literal, int] = {}
        self._store = store
        self._before = store.made
        self._number(order, count(store.manager.num_vars()))
        self.manager = store.manager
        self.manager.add_vars(len(self.current) + len(self.next) + len(self.hidden))
        self.inputs = tuple(self.current[bit.literal] for bit in cut.bits)
        self._built = self._start(self.current)
        pairs = [(n, self.manager.var(self.current[literal])) for literal, n in self.next.items()]
        self._renaming = BCDDSubstitution(pairs)

    @property
    def used(self) -> int:
        """Nodes in use by all spaces, and those not yet removed."""
        return self._store.used

    @property
    def made(self) -> int:
        """Nodes made since this space was."""
        return self._store.made - self._before

    def pause(self) -> None:
        """To be called between operations: nodes are removed, and the grant is checked."""
        self._store.tidy()
        if self.granted is not None and self.made > self.granted:
            raise Overdrawn(f"{self.made} nodes were made, {self.granted} granted")

    def _number(self, order: Sequence[str], free: Iterator[int]) -> None:
        """High bits first: they decide whether a counter is above a bound."""
        groups = _grouped([*(latch.bit for latch in self.circuit.latches), *self.cut.bits])
        changing = {x.literal for x in self.circuit.latches if x.next != x.literal}
        for name in order:
            for bit in reversed(groups.pop(name)):
                self.current[bit.literal] = next(free)
                if bit.literal in changing:
                    self.next[bit.literal] = next(free)
        self.current |= {bit.literal: next(free) for bit in self.circuit.others}
        self.hidden |= {bit.literal: next(free) for bit in self.cut.hidden}

    def _start(self, bits: Mapping[Literal, int]) -> dict[int, Function]:
        known = {literal >> 1: self.manager.var(variable) for literal, variable in bits.items()}
        return {FALSE: self.manager.false()} | known

    def build(self, literals: Iterable[Literal]) -> None:
        """Make the functions of these literals known."""
        self._build(self._built, literals)

    def __call__(self, literal: Literal) -> Function:
        """The function that a literal stands for, of those that were built and not forgotten."""
        return _of(self._built, literal)

    def forget(self) -> None:
        """Let go of all that was built: functions that others hold stay."""
        self._built.clear()

    def definitions(self) -> list[list[tuple[Literal, Function]]]:
        """For each part of the cut its bits, and what they stand for over the hidden inputs."""
        built = self._start(self.hidden)
        self._build(built, [bit.literal for part in self.cut.parts for bit in part])
        return [[(b.literal, _of(built, b.literal)) for b in part] for part in self.cut.parts]

    def _build(self, built: dict[int, Function], literals: Iterable[Literal]) -> None:
        fanins = self.circuit.aig.fanins
        todo = [literal >> 1 for literal in literals]
        while todo:
            node = todo[-1]
            missing = [] if node in built else [x >> 1 for x in fanins[node] if x >> 1 not in built]
            todo += missing
            if not missing:
                todo.pop()
                if node not in built:
                    a, b = fanins[node]
                    built[node] = _of(built, a) & _of(built, b)
                    self.pause()

    def cube(self, values: Mapping[int, bool]) -> Function:
        """The conjunction of variables, negated where the value is false."""
        result = self.manager.true()
        for variable in sorted(values, reverse=True):
            own = self.manager.var(variable)
            result = (own if values[variable] else ~own) & result
        return result

    def all(self, variables: Iterable[int]) -> Function:
        """The conjunction of variables, which is also how a set of them is given to a quantifier."""
        return self.cube(dict.fromkeys(variables, True))

    def renamed(self, function: Function) -> Function:
        """The function of next values as one of current values."""
        return function.substitute(self._renaming)


def _grouped(bits: Iterable[Bit]) -> dict[str, list[Bit]]:
    found: dict[str, list[Bit]] = {}
    for bit in bits:
        found.setdefault(bit.var.name, []).append(bit)
    return found


def _of(built: Mapping[int, Function], literal: Literal) -> Function:
    function = built[literal >> 1]
    return ~function if literal & 1 else function


def meets(a: Function, b: Function) -> bool:
    """Whether both are true somewhere."""
    return (a & b).satisfiable()


def product(a: Function, b: Function, away: Function) -> Function:
    """The conjunction, without the variables that are the conjuncts of ``away``."""
    return a.apply_exists(BooleanOperator.AND, b, away)


def support(function: Function) -> set[int]:
    """The variables that a function depends on."""
    found: set[int] = set()
    seen: set[Function] = set()
    todo = [function]
    while todo:
        at = todo.pop()
        variable = at.node_var()
        if variable is not None and at not in seen:
            seen.add(at)
            found.add(variable)
            todo += at.cofactors() or ()
    return found


__all__ = ["DDMemoryError", "Function", "NodeStore", "Overdrawn", "Space", "meets", "product", "support"]
