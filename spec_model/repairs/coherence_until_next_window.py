"""Coherence: what a long window says of the motion holds until the next one ends."""

from rovercheck.spec_model.board2.coherence import differs, long_ends, long_result
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import ite
from rovercheck.spec_model.repairs import Repair


def kept(block: Block) -> Block:
    """The last action writes the result in every step: it says inconsistent for one step in 3 s only."""
    return Block(
        block.name,
        [*block.do[:-1], assign(long_result, ite(long_ends, ~differs, long_result))],
        text=block.text,
    )


_ONE_STEP = "It lets a long window tell only in the step in which it ends."

until_next = Repair(
    name="coherence-until-next-window",
    text="Coherence.long keeps its result between the ends of two long windows.",
    fixes=("PB2-28b",),
    blocks={"Coherence.long": kept},
    gives_up=dict.fromkeys(("PB2-28f", "PB2-28g"), _ONE_STEP),
)
