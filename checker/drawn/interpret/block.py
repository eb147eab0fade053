"""One block at work, and what concerns it alone: its inputs, its memory, its edges."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from rovercheck.checker.drawn.calls import FunctionCall
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.machine import ChartMachine
from rovercheck.checker.drawn.interpret.values import MatlabValue
from rovercheck.checker.drawn.records import DrawnBlock

if TYPE_CHECKING:
    from rovercheck.checker.drawn.interpret.system import SystemAtWork


@dataclass
class BlockAtWork:
    """A block at work: ``inputs`` are what feeds its input ports, by their numbers."""

    block: DrawnBlock
    inputs: list[tuple[str, int] | None]
    system: "SystemAtWork | None" = None
    chart: ChartMachine | None = None
    control: str = ""
    fed: tuple[str, int] | None = None
    """What feeds its control port."""
    trigger: str = "rising"
    memory: MatlabValue | None = None
    outputs: list[MatlabValue] = field(default_factory=list)
    typed: bool = False
    """Whether the outputs of its system have their types, also if that was not executed yet."""
    turn: int = 0
    """In the how many-th turn of a subsystem in its system it was executed last; 0: in none."""
    was: list[float] = field(default_factory=list)
    """The values of its trigger in the step before."""
    on: bool = False
    """Whether it was enabled in the step before."""
    functions: "list[SystemAtWork]" = field(default_factory=list)
    """Of a chart its Simulink functions."""
    calls: Mapping[str, Sequence[FunctionCall]] = field(default_factory=dict)
    """Of a chart its events that are function calls, or of a generator, and what they call in this order."""
    called: bool = False
    """Whether it is executed where a chart calls it, and never else."""
    tried: bool = False
    """Whether it is executed in any step, whatever controls it."""


@contextmanager
def told(node: BlockAtWork) -> Iterator[None]:
    """What has no meaning is told with its block."""
    try:
        yield
    except DrawnFault as fault:
        raise DrawnFault(f"{node.block.shown_path}: {fault}") from fault


def edge(kind: str, before: float, now: float) -> bool:
    """Whether a signal rises or falls through 0 as a trigger of a kind asks for."""
    if kind in ("function call", "function-call"):
        raise DrawnFault("an event that is a function call, and a signal with edges comes in")
    rises, falls = before <= 0 < now, before > 0 >= now
    return {"rising": rises, "falling": falls}.get(kind, rises or falls)


__all__ = ["BlockAtWork", "edge", "told"]
