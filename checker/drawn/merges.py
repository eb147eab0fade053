"""Merge blocks: several subsystems, of which each is executed in some steps only, give one signal."""

from collections.abc import Mapping, Sequence

from rovercheck.checker.drawn.calls import Port, is_called
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.records import DrawnBlock
from rovercheck.checker.drawn.wiring import CONTROL, number_of

UNSAID = "[]"
"""An initial output that a block does not say."""
ZEROS = (UNSAID, "0", "false")


def merged(block: DrawnBlock, inputs: Sequence[Port | None], blocks: Mapping[str, DrawnBlock]) -> list[Port]:
    """The outputs that a Merge block merges, in the order of its ports; a port without a line gives none.

    It gives that of the subsystem that was executed last.  Raises ``DrawnFault`` for what is no output of a
    subsystem that is controlled or called, and for one whose first value the block would have to guess.
    """
    found = [port for port in inputs if port is not None]
    for name, number in found:
        source = blocks.get(name)
        if source is None:
            raise DrawnFault(f"the block {name}, which feeds it, is not there")
        inside = () if source.system is None or source.chart else source.system.blocks
        if not (any(one.kind in CONTROL for one in inside) or is_called(source)) or source.chart:
            raise DrawnFault(
                f"{source.shown_path} feeds it: put that into a subsystem that is enabled, "
                "triggered or called"
            )
        ends = (one for one in inside if one.kind == "Outport" and number_of(one) == number)
        begins = {one.parameters.get("InitialOutput", UNSAID).strip() for one in ends}
        if block.parameters.get("InitialOutput", UNSAID).strip() == UNSAID and not begins <= {*ZEROS}:
            raise DrawnFault("what feeds it has an initial output, and it has none: give it one, too")
    if len({name for name, _ in found}) != len(found):
        raise DrawnFault("one subsystem feeds it twice: put that into two subsystems")
    if not found:
        raise DrawnFault("nothing is connected to it: connect a subsystem, or delete it")
    return found


__all__ = ["UNSAID", "merged"]
