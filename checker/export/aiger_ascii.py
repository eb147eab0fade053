"""The ASCII AIGER 1.9 format, which people can read: see the binary one for what it holds."""

from rovercheck.checker.export.netlist import netlist
from rovercheck.checker.export.problem import Problem
from rovercheck.checker.results.format import Format

FORMAT = Format("aag", "problem", ".aag", "AIGER 1.9, ASCII: the same circuit as text")


def export(problem: Problem) -> str:
    """The problem as text; the names of bits follow the circuit, the header comes last."""
    made = netlist(problem)
    first = len(made.inputs) + 1
    lines = [f"aag {made.counts}\n"]
    lines += [f"{2 * n}\n" for n in range(1, first)]
    for n, latch in enumerate(made.latches, first):
        lines.append(f"{2 * n} {latch.next}{' 1' if latch.init else ''}\n")
    gates = (f"{own} {high} {low}\n" for own, high, low in made.gates)
    comment = (f"{line}\n" for line in ("c", *problem.header))
    return "".join([*lines, made.roots, *gates, made.symbols, *comment])
