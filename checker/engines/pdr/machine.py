"""The circuit as a solver sees it: numbers for latches, inputs and next values, and clauses for a tick."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.encode.bits import TRUE, Aig, Circuit, Literal
from rovercheck.checker.encode.bits.cnf import Clause, Cnf

LEAVES = ""
"""The name of the goal that some variable leaves its domain; no variable has this name."""


@dataclass(frozen=True)
class PdrMachine:
    """A transition relation in clauses; latch ``n`` of the circuit is variable ``n + 1``.

    definitions  the clauses that define a variable by others, as in ``Cnf``

    after    for the literal of a latch before a tick, the one of its value after it (negative indices
             stand for negative literals)
    assume   holds in every tick
    domains  by latch, what holds before every tick: that no run has left a domain so far, and invariants
    init     literals that hold before the first tick, and so does ``start``
    goals    by name, ``LEAVES`` among them if some variable may leave its domain
    """

    circuit: Circuit
    latches: int
    inputs: tuple[int, ...]
    after: tuple[int, ...]
    assume: int
    domains: Mapping[int, tuple[int, ...]]
    start: int
    init: tuple[int, ...]
    goals: Mapping[str, int]
    true: int
    variables: int
    definitions: Mapping[int, tuple[Clause, ...]]


def machine(circuit: Circuit, known: Sequence[Literal] = ()) -> PdrMachine:
    """The clauses of everything that is asked of a circuit; ``known`` is inductive and holds at the start."""
    goals = dict(circuit.goals)
    if circuit.leaves:
        goals[LEAVES] = circuit.leaves
    latches = [latch.literal for latch in circuit.latches]
    inputs = [bit.literal for bit in circuit.inputs]
    following = [latch.next for latch in circuit.latches]
    conditions = [circuit.assume, circuit.start]
    domains = [*_conjuncts(circuit.aig, circuit.within), *known]
    cnf = Cnf(circuit.aig, [*latches, *inputs], [*following, *conditions, *domains, *goals.values()])
    after = [cnf.literal(x) for x in following]
    assume, start = map(cnf.literal, conditions)
    return PdrMachine(
        circuit,
        len(latches),
        tuple(range(len(latches) + 1, cnf.true)),
        (0, *after, *(-x for x in reversed(after))),
        assume,
        _by_latch(circuit.aig, cnf, domains),
        start,
        tuple(_initial([latch.init for latch in circuit.latches])),
        {name: cnf.literal(x) for name, x in goals.items()},
        cnf.true,
        cnf.variables,
        cnf.definitions,
    )


def _conjuncts(aig: Aig, condition: Literal) -> list[Literal]:
    """Literals whose conjunction the condition is."""
    found, todo = dict[Literal, None](), [condition]
    while todo:
        literal = todo.pop()
        if literal & 1 or aig.fanins[literal >> 1] == (0, 0):
            found[literal] = None
        else:
            todo += aig.fanins[literal >> 1]
    return [literal for literal in found if literal != TRUE]


def _by_latch(aig: Aig, cnf: Cnf, conditions: Iterable[Literal]) -> dict[int, tuple[int, ...]]:
    """For each latch, the conditions that depend on it."""
    found: dict[int, tuple[int, ...]] = {}
    for condition in conditions:
        number = cnf.literal(condition)
        for node in aig.cone([condition]):
            if aig.is_input(node):
                latch = cnf.literal(2 * node)
                found[latch] = (*found.get(latch, ()), number)
    return found


def _initial(values: Sequence[int | None]) -> list[int]:
    return [n if value else -n for n, value in enumerate(values, 1) if value is not None]
