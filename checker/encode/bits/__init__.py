"""Systems as sequential circuits of conjunctions and negations, for bit-level engines and exports."""

from rovercheck.checker.encode.bits.aig import FALSE, TRUE, Aig, Literal
from rovercheck.checker.encode.bits.blast import Blaster
from rovercheck.checker.encode.bits.model import Bit, Circuit, Latch, circuit

__all__ = ["FALSE", "TRUE", "Aig", "Bit", "Blaster", "Circuit", "Latch", "Literal", "circuit"]
