"""The binary AIGER 1.9 format: bad states and an invariant constraint over a circuit of latches.

Armin Biere, Keijo Heljanko, Siert Wieringa: AIGER 1.9 and Beyond, 2011.
"""

from rovercheck.checker.export.netlist import netlist
from rovercheck.checker.export.problem import Problem
from rovercheck.checker.results.format import Format

FORMAT = Format("aiger", "problem", ".aig", "AIGER 1.9, binary: for ABC, and every bit-level model checker")


def export(problem: Problem) -> bytes:
    """The problem as a binary file; the names of bits follow the circuit, the header comes last."""
    made = netlist(problem)
    lines = [f"aig {made.counts}\n"]
    lines += [f"{latch.next} 1\n" if latch.init else f"{latch.next}\n" for latch in made.latches]
    gates = b"".join(_delta(own - high) + _delta(high - low) for own, high, low in made.gates)
    comment = "".join(f"{line}\n" for line in ("c", *problem.header))
    return "".join([*lines, made.roots]).encode() + gates + (made.symbols + comment).encode()


def _delta(number: int) -> bytes:
    """Seven bits a byte, the low ones first."""
    out = bytearray()
    while number >= 0x80:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    out.append(number)
    return bytes(out)
