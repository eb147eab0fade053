"""Function calls: which block each event of a chart has executed at once, in place of a turn of its own."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.records import DrawnBlock, DrawnEvent

Port = tuple[str, int]
"""A block, by its id, and the number of one of its outputs."""
Feeds = Mapping[tuple[str, str], Port]
"""Of inputs, by the block and the name of its port, the output that feeds them."""
Calls = Mapping[Port, Sequence["FunctionCall"]]
"""Of outputs that are function calls what each calls, in this order."""
CALL = "function-call"
SPLIT, GENERATOR = "FunctionCallSplit", "FunctionCallGenerator"
MOST_CALLS = 100
"""Calls of a generator in one step."""
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


def function_calls(blocks: Mapping[str, DrawnBlock], feeds: Feeds) -> dict[Port, tuple[FunctionCall, ...]]:
    """The outputs that are function calls, with what they call.  Raises ``DrawnFault``."""
    found = dict[Port, dict[tuple[int, ...], FunctionCall]]()
    for block in blocks.values():
        if not is_called(block):
            continue
        callers = set[str]()
        for event, port in enumerate(_initiators(blocks, feeds, block.id, "trigger"), 1):
            if port is None:
                continue
            port, turn = _before_splits(blocks, feeds, port)
            _refuse_no_caller(block, blocks.get(port[0]))
            calls = found.setdefault(port, {})
            if turn in calls:
                told = blocks[calls[turn].target]
                raise DrawnFault(f"a function call leads to {told.shown_path} and {block.shown_path}: {EACH}")
            calls[turn] = FunctionCall(block.id, event)
            callers.add(port[0])
        if len(callers) > 1:
            told_ = " and ".join(blocks[one].shown_path for one in sorted(callers))
            raise DrawnFault(
                f"the block {block.shown_path} is called by {told_}, in an order that is not drawn: let one "
                "call"
            )
    _refuse_other_ends(blocks, feeds)
    made = {port: tuple(calls[turn] for turn in sorted(calls)) for port, calls in found.items()}
    for some in made.values():
        _refuse_backward(blocks, feeds, some)
    return made


EACH = "put a Function-Call Split between, or send an event for each"


def iterations(value: Fraction | float | None) -> int:
    """How often a generator of function calls calls in each step.  Raises ``DrawnFault``."""
    if value is None or value != int(value) or not 0 < value <= MOST_CALLS:
        raise DrawnFault(f"its number of iterations must be a whole constant from 1 to {MOST_CALLS}")
    return int(value)


def rate_said(block: DrawnBlock) -> str:
    """The sample time of a block, as written."""
    if block.kind == GENERATOR:
        return block.parameters.get("sample_time", "1")
    return block.parameters.get("SampleTime", "-1")


def _before_splits(
    blocks: Mapping[str, DrawnBlock], feeds: Feeds, port: Port
) -> tuple[Port, tuple[int, ...]]:
    """The output from which a call comes that splits hand on, and the outputs of these on its way.

    A split executes what is at its first output, then what is at its second.
    """
    way: tuple[int, ...] = ()
    while (block := blocks.get(port[0])) is not None and block.kind == SPLIT:
        source = feeds.get((block.id, "1"))
        if source is None or len(way) > len(blocks):
            raise DrawnFault(
                f"no function call comes into {block.shown_path}: connect one, or delete the block"
            )
        way, port = (port[1], *way), source
    return port, way


def _refuse_other_ends(blocks: Mapping[str, DrawnBlock], feeds: Feeds) -> None:
    """Raises ``DrawnFault`` where a split or a generator leads to what no function call executes."""
    for (target, to), (source, _) in feeds.items():
        from_, block = blocks.get(source), blocks[target]
        if from_ is None or from_.kind not in (SPLIT, GENERATOR) or block.kind in (SPLIT, "Terminator"):
            continue
        if to != "trigger" or not is_called(block):
            raise DrawnFault(
                f"{from_.shown_path} leads to the {block.kind} block {block.shown_path}, which no function "
                "call executes: connect a function-call subsystem, or a chart with one such event"
            )


def _refuse_backward(blocks: Mapping[str, DrawnBlock], feeds: Feeds, calls: Sequence[FunctionCall]) -> None:
    """Raises ``DrawnFault`` where what is called later feeds what is called earlier."""
    for at, late in enumerate(calls):
        for early in calls[:at]:
            if any(
                target == early.target and source[0] == late.target for (target, _), source in feeds.items()
            ):
                first, second = blocks[early.target].shown_path, blocks[late.target].shown_path
                raise DrawnFault(
                    f"{second} feeds {first}, which one function call executes before it: put a delay between"
                )


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


def _refuse_no_caller(block: DrawnBlock, caller: DrawnBlock | None) -> None:
    """Raises ``DrawnFault`` for a call that comes from no chart, and no generator, beside the block."""
    if caller is not None and (caller.chart or caller.kind == GENERATOR):
        return
    if caller is not None and caller.kind == "Inport":
        said = "comes from outside its subsystem: draw the chart that calls it beside it"
    elif caller is None:
        said = "comes from no block that is there"
    else:
        said = f"comes from the {caller.kind} block {caller.shown_path}: let an event of a chart call it"
    raise DrawnFault(f"the function call of {block.shown_path} {said}")


def calls_of(
    block: DrawnBlock, outputs: int, events: Sequence[DrawnEvent], feeds: Feeds,
    calls: Calls, blocks: Mapping[str, DrawnBlock],
) -> dict[str, Sequence[FunctionCall]]:  # fmt: skip
    """What each output event of a chart calls that is a function call, in this order.

    The ports of ``events`` follow those of so many ``outputs``.  Raises ``DrawnFault``.
    """
    found: dict[str, Sequence[FunctionCall]] = {}
    for number, event in enumerate(events, outputs + 1):
        port = (block.id, number)
        which = f"{block.shown_path}, the event {event.name} (SSID {event.ssid})"
        made, uses = calls.get(port, ()), [target for (target, _), source in feeds.items() if source == port]
        others = [blocks[one] for one in uses if one in blocks and blocks[one].kind != "Terminator"]
        if event.trigger != FUNCTION_CALL:
            if made:
                raise DrawnFault(
                    f"{which} is no function call, and {blocks[made[0].target].shown_path} waits for one: "
                    "make its trigger Function Call"
                )
            continue
        if len(others) > 1:
            told = " and ".join(one.shown_path for one in others)
            raise DrawnFault(f"{which} leads to {told}: {EACH}")
        if others and not made:
            raise DrawnFault(
                f"{which} leads to the {others[0].kind} block {others[0].shown_path}, which no function call "
                "executes: make its trigger Either Edge, and that of the block either"
            )
        found[event.name] = made
    wrong = [one for one in calls if one[0] == block.id and not 0 <= one[1] - outputs - 1 < len(events)]
    for one in wrong:
        told = blocks[calls[one][0].target].shown_path
        raise DrawnFault(
            f"output {one[1]} of {block.shown_path} is data, and {told} waits for a function call"
        )
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


__all__ = [
    "FUNCTION_CALL", "GENERATOR", "SPLIT", "Calls", "Feeds", "FunctionCall", "Port", "call_event", "calls_of",
    "function_calls", "is_called", "iterations", "rate_said", "refuse_seconds",
]  # fmt: skip
