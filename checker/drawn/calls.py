"""Function calls: which block each event of a chart has executed at once, in place of a turn of its own."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.records import DrawnBlock, DrawnEvent

Port = tuple[str, int]
"""A block, by its id, and the number of one of its outputs."""
Feeds = Mapping[tuple[str, str], Port]
"""Of inputs, by the block and the name of its port, the output that feeds them."""
CALL = "function-call"
FUNCTION_CALL = "function call"
"""The trigger of such an event in a chart."""


@dataclass(frozen=True)
class FunctionCall:
    """What an event calls: a block, and which of the block's own input events occurs there, from 1."""

    target: str
    event: int


def refuse_seconds(unit: str, events: Iterable[DrawnEvent]) -> None:
    """Raises ``DrawnFault`` for a time in seconds of a chart that function calls wake up.

    Between two calls any time may pass, and several may come in one step.
    """
    if any(one.scope == "input" and one.trigger == FUNCTION_CALL for one in events):
        raise DrawnFault(
            f"a time in {unit} of a chart that function calls wake up: count its calls with tick, or the "
            "time in the chart that calls it"
        )


def is_called(block: DrawnBlock) -> bool:
    """Whether a block is executed where another one calls it, and never else."""
    inside = () if block.system is None else block.system.blocks
    return any(one.kind == "TriggerPort" and one.parameters.get("TriggerType") == CALL for one in inside)


def function_calls(blocks: Mapping[str, DrawnBlock], feeds: Feeds) -> dict[Port, FunctionCall]:
    """The outputs of charts that are function calls, with what they call.  Raises ``DrawnFault``."""
    found = dict[Port, FunctionCall]()
    for block in blocks.values():
        if not is_called(block):
            continue
        callers = set[str]()
        for event, port in enumerate(_initiators(blocks, feeds, block.id, "trigger"), 1):
            if port is None:
                continue
            _refuse_no_chart(block, blocks.get(port[0]))
            if port in found:
                told = blocks[found[port].target]
                raise DrawnFault(f"a function call leads to {_name(told)} and {_name(block)}: {EACH}")
            found[port] = FunctionCall(block.id, event)
            callers.add(port[0])
        if len(callers) > 1:
            told_ = " and ".join(_name(blocks[one]) for one in sorted(callers))
            raise DrawnFault(
                f"the block {_name(block)} is called by {told_}, in an order that is not drawn: let one call"
            )
    return found


EACH = "send an event for each"


def _initiators(
    blocks: Mapping[str, DrawnBlock], feeds: Feeds, target: str, port: str
) -> Iterator[Port | None]:
    """The outputs that come into a port one by one: a Mux brings those of all its inputs."""
    source = feeds.get((target, port))
    mux = None if source is None else blocks.get(source[0])
    if mux is None or mux.kind != "Mux":
        yield source
        return
    said = mux.parameters.get("Inputs", "").strip()
    ports = [int(to) for one, to in feeds if one == mux.id and to.isdigit()]
    count = max([*ports, int(said) if said.isdigit() else 0, 0])
    for number in range(1, min(count, 1_000) + 1):
        yield from _initiators(blocks, feeds, mux.id, str(number))


def _refuse_no_chart(block: DrawnBlock, caller: DrawnBlock | None) -> None:
    """Raises ``DrawnFault`` for a call that comes from no chart beside the block."""
    if caller is not None and caller.chart:
        return
    if caller is not None and caller.kind == "Inport":
        said = "comes from outside its subsystem: draw the chart that calls it beside it"
    elif caller is None:
        said = "comes from no block that is there"
    else:
        said = f"comes from the {caller.kind} block {_name(caller)}: let an event of a chart call it"
    raise DrawnFault(f"the function call of {_name(block)} {said}")


def calls_of(
    block: DrawnBlock, outputs: int, events: Sequence[DrawnEvent], feeds: Feeds,
    calls: Mapping[Port, FunctionCall], blocks: Mapping[str, DrawnBlock],
) -> dict[str, FunctionCall | None]:  # fmt: skip
    """What each output event of a chart calls that is a function call; ``None``: nothing is connected.

    The ports of ``events`` follow those of so many ``outputs``.  Raises ``DrawnFault``.
    """
    found: dict[str, FunctionCall | None] = {}
    for number, event in enumerate(events, outputs + 1):
        port = (block.id, number)
        call, uses = calls.get(port), [target for (target, _), source in feeds.items() if source == port]
        others = [blocks[one] for one in uses if blocks[one].kind != "Terminator"]
        if event.trigger != FUNCTION_CALL:
            if call is not None:
                raise DrawnFault(
                    f"the event {event.name} is no function call, and {_name(blocks[call.target])} waits for "
                    "one: make its trigger Function Call"
                )
            continue
        if len(others) > 1:
            told = " and ".join(_name(one) for one in others)
            raise DrawnFault(f"the function call {event.name} leads to {told}: {EACH}")
        if others and call is None:
            raise DrawnFault(
                f"the function call {event.name} leads to the {others[0].kind} block {_name(others[0])}, "
                "which no function call executes: make its trigger Either Edge, and that of the block either"
            )
        found[event.name] = call
    wrong = [one for one in calls if one[0] == block.id and not 0 <= one[1] - outputs - 1 < len(events)]
    for one in wrong:
        told = _name(blocks[calls[one].target])
        raise DrawnFault(f"output {one[1]} of {_name(block)} is data, and {told} waits for a function call")
    return found


def call_event(name: str, events: Sequence[DrawnEvent], number: int) -> str:
    """The input event that a function call is in the chart that is called.  Raises ``DrawnFault``."""
    if not 0 < number <= len(events):
        raise DrawnFault(f"{name} has {len(events)} input events, and more function calls come in")
    if any(one.trigger != FUNCTION_CALL for one in events):
        raise DrawnFault(
            f"{name} has input events that are function calls and others that are edges: give all the same "
            "trigger"
        )
    return events[number - 1].name


def _name(block: DrawnBlock) -> str:
    return " ".join(block.path.split())


__all__ = [
    "FUNCTION_CALL", "Feeds", "FunctionCall", "Port", "call_event", "calls_of", "function_calls", "is_called",
    "refuse_seconds",
]  # fmt: skip
