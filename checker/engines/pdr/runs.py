"""Traces of a circuit as runs of the system, and their replay by the reference semantics."""

from pysat.solvers import Minisat22

from checker.encode.bits import Circuit, Literal
from checker.encode.bits.cnf import Cnf
from checker.engines.pdr.search import Traced
from checker.results.verdict import Run
from spec_model.lang.evaluate import admissible, step
from spec_model.lang.system import TransitionSystem


def others(circuit: Circuit) -> dict[Literal, int] | None:
    """Values of the inputs outside the cone that the assumption allows; None if there are none, so that
    the system has no run at all."""
    bits = [bit.literal for bit in circuit.others]
    cnf = Cnf(circuit.aig, bits, [circuit.loose])
    solver = Minisat22([*cnf.clauses, [cnf.literal(circuit.loose)]])
    if not solver.solve():
        return None
    return {bit: int(x > 0) for bit, x in zip(bits, solver.get_model(), strict=False)}


def run_of(traced: Traced, circuit: Circuit, outside: dict[Literal, int]) -> Run:
    """The run of the whole system that a trace stands for."""
    leaves = [*(latch.literal for latch in circuit.latches), *(bit.literal for bit in circuit.inputs)]

    def values(literals: tuple[int, ...]) -> dict[Literal, int]:
        return {leaves[abs(x) - 1]: int(x > 0) for x in literals}

    return circuit.run(values(traced.latches), [values(tick) | outside for tick in traced.inputs])


def replayed(system: TransitionSystem, run: Run) -> list[dict[str, int]]:
    """The valuation before the first tick and after each.  Raises ``ArithmeticError`` if the run is none."""
    if any(run.frozen[v.name] not in v.domain for v in system.frozen):
        raise ArithmeticError("the engine is wrong: its run has frozen values outside their domains")
    at = {**system.init, **run.frozen}
    visited = [at]
    for number, inputs in enumerate(run.inputs, 1):
        if not admissible(system, at, inputs):
            raise ArithmeticError(f"the engine is wrong: its run is not admissible in tick {number}")
        at = step(system, at, inputs)
        visited.append(at)
    return visited
