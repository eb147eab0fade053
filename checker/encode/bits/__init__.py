"""Systems as sequential circuits of conjunctions and negations, for bit-level engines and exports."""

from checker.encode.bits.aig import FALSE, TRUE, Aig, Literal
from checker.encode.bits.blast import Blaster
from checker.encode.bits.model import Bit, Circuit, Latch, circuit

__all__ = ["FALSE", "TRUE", "Aig", "Bit", "Blaster", "Circuit", "Latch", "Literal", "circuit"]
