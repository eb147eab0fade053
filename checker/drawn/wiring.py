"""Which output feeds which input: through subsystems that only group, Goto and From, and in which order."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from rovercheck.checker.drawn.calls import GENERATOR, SPLIT, Calls, FunctionCall, Port, function_calls
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.records import DrawnBlock, DrawnSystem
from rovercheck.checker.drawn.store_order import Uses, order_by_stores

CONTROL = {"EnablePort": "enable", "TriggerPort": "trigger", "ActionPort": "ifaction"}
DELAYS = ("UnitDelay", "Memory")


@dataclass
class SystemWiring:
    """The blocks of a system that do something, in their order of execution, and what feeds them.

    Of the inputs ``feeds`` says which output each is, by the block and the name of its port; what is fed by
    an Inport of the system itself is fed by that block.  ``calls`` are the outputs that are function calls;
    what they call stands before the chart that calls it.
    """

    order: list[DrawnBlock] = field(default_factory=list)
    feeds: dict[tuple[str, str], Port] = field(default_factory=dict)
    calls: dict[Port, tuple[FunctionCall, ...]] = field(default_factory=dict)

    @property
    def called(self) -> set[str]:
        """The blocks, by their ids, that are executed where a chart calls them."""
        return {call.target for calls in self.calls.values() for call in calls}

    def inputs_of(self, block: DrawnBlock) -> list[Port | None]:
        """What feeds each input of a block, those too to which nothing is connected."""
        ports = [int(port) for target, port in self.feeds if target == block.id and port.isdigit()]
        most = max(ports, default=0)
        if block.system is None:
            most = max(most, _inputs_said(block))
        elif not block.chart:
            ports += [number_of(one) for one in block.system.blocks if one.kind == "Inport"]
            most = min(max(ports, default=0), MOST_INPUTS)
        return [self.feeds.get((block.id, str(number))) for number in range(1, most + 1)]


def wired(system: DrawnSystem, uses: Uses) -> SystemWiring:
    """The wiring of a system, of which blocks use data stores.

    Raises ``DrawnFault`` for blocks that feed themselves without a delay, and for those whose order shows in
    a data store and is not drawn.
    """
    return _Wires(system).wiring(uses)


def _is_group(block: DrawnBlock) -> bool:
    """Whether a block only groups others: it has no control and is not atomic."""
    if block.kind != "SubSystem" or block.chart or block.system is None:
        return False
    atomic = block.parameters.get("TreatAsAtomicUnit") == "on"
    return not atomic and not any(one.kind in CONTROL for one in block.system.blocks)


def number_of(block: DrawnBlock) -> int:
    """The number of an Inport or Outport."""
    return int(block.parameters.get("Port", "1"))


ONE_INPUT = (
    "Gain", "DataTypeConversion", "Abs", "Saturate", "CompareToConstant", "CompareToZero", "Selector",
    "Outport", "DataStoreWrite", *DELAYS,
)  # fmt: skip
MOST_INPUTS = 10_000


def _inputs_said(block: DrawnBlock) -> int:
    """How many inputs a block has as its ports or its parameters say, at most 10,000."""
    said, written = block.parameters.get("ports in", ""), block.parameters.get("Inputs", "").strip()
    signs = written.replace("|", "")
    if block.kind == "Logic":
        fewest = 1 if block.parameters.get("Operator") == "NOT" else int(signs) if signs.isdigit() else 2
    elif block.kind in ("Sum", "Product"):
        fewest = int(signs) if signs.isdigit() else len(signs) or 2
    else:
        fewest = {"RelationalOperator": 2, "Switch": 3}.get(block.kind, int(block.kind in ONE_INPUT))
    return min(max(fewest, int(said) if said.isdigit() else 0), MOST_INPUTS)


class _Wires:
    def __init__(self, system: DrawnSystem) -> None:
        self._system = system
        self._blocks: dict[str, DrawnBlock] = {}
        self._in: dict[str, DrawnBlock] = {}
        self._lines: dict[tuple[str, str], Port] = {}
        self._gotos: dict[str, list[DrawnBlock]] = {}
        self._take(system, None)

    def _take(self, system: DrawnSystem, group: DrawnBlock | None) -> None:
        for line in system.lines:
            self._lines[line.target, line.to_port] = line.source, line.from_port
        for block in system.blocks:
            self._blocks[block.id] = block
            if group is not None:
                self._in[block.id] = group
            if block.kind == "Goto":
                self._gotos.setdefault(block.parameters.get("GotoTag", "A"), []).append(block)
            if _is_group(block) and block.system is not None:
                self._take(block.system, block)

    def wiring(self, uses: Uses) -> SystemWiring:
        """The wiring.  Raises ``DrawnFault`` for blocks that feed themselves without a delay."""
        found = SystemWiring()
        real = [block for block in self._blocks.values() if self._is_real(block)]
        for target, port in list(self._lines):
            if target in self._blocks and self._is_real(self._blocks[target]):
                source = self._source(self._lines[target, port])
                if source is not None:
                    found.feeds[target, port] = source
        found.calls = function_calls({block.id: block for block in real}, found.feeds)
        calling = {block.id for block in real if block.kind in (SPLIT, GENERATOR)}  # which gives no signal
        found.feeds = {end: source for end, source in found.feeds.items() if source[0] not in calling}
        real = [block for block in real if block.kind != SPLIT]
        found.order = _ordered(real, found.feeds, _callers(found.calls), uses)
        return found

    def _is_real(self, block: DrawnBlock) -> bool:
        grouped = block.id in self._in and block.kind in ("Inport", "Outport")
        return not (_is_group(block) or block.kind in ("Goto", "From", "GotoTagVisibility") or grouped)

    def _source(self, port: Port) -> Port | None:
        """The output of a block that does something, behind others; ``None``: nothing is connected."""
        seen = set[Port]()
        found: Port | None = port
        while found is not None and found not in seen:
            seen.add(found)
            block = self._blocks.get(found[0])
            if block is None or self._is_real(block):
                return found
            if block.kind == "From":
                found = self._lines.get((self._goto(block).id, "1"))
            elif block.kind == "Inport":
                found = self._lines.get((self._in[block.id].id, str(number_of(block))))
            elif block.system is not None:
                ends = (o for o in block.system.blocks if o.kind == "Outport" and number_of(o) == found[1])
                end = next(ends, None)
                found = None if end is None else self._lines.get((end.id, "1"))
        return None

    def _goto(self, block: DrawnBlock) -> DrawnBlock:
        """The Goto with the tag of a From: the one in its own system, else the only one there is."""
        tag = block.parameters.get("GotoTag", "A")
        every = self._gotos.get(tag, [])
        near = [one for one in every if self._in.get(one.id) is self._in.get(block.id)]
        if len(near or every) != 1:
            raise DrawnFault(f"the From {block.path}: there are {len(near or every)} Goto of the tag {tag}")
        return (near or every)[0]


def _callers(calls: Calls) -> dict[str, str]:
    """Of each block that is called what calls first: one called by it may call, too.

    Raises ``DrawnFault`` for charts that call each other.
    """
    by = {call.target: port[0] for port, some in calls.items() for call in some}
    found = {}
    for target, caller in by.items():
        seen = {target}
        while caller in by:
            if caller in seen:
                raise DrawnFault(f"the blocks {', '.join(sorted(seen))} call each other by function calls")
            seen.add(caller)
            caller = by[caller]
        found[target] = caller
    return found


def _ordered(
    blocks: Iterable[DrawnBlock], feeds: Mapping[tuple[str, str], Port], callers: Mapping[str, str],
    used: Uses,
) -> list[DrawnBlock]:  # fmt: skip
    """Each block after those that feed it directly; a delay gives what it got a step before.

    What is called is executed with the chart that calls it: after all that feeds either of them, and before
    all that they feed.
    """
    every = {block.id: block for block in blocks}
    before: dict[str, list[str]] = {block: [] for block in every if block not in callers}
    for (target, port), (source, _) in feeds.items():
        if target not in every or (target in callers and port == "trigger"):
            continue
        if every[target].kind not in DELAYS and source in every and every[source].kind not in DELAYS:
            first, other = callers.get(target, target), callers.get(source, source)
            if first != other or target == source:
                before[first].append(other)
    together: dict[str, list[str]] = {}
    for block in every:
        group = together.setdefault(callers.get(block, block), [])
        group.insert(0 if block in callers else len(group), block)
    order_by_stores(before, {first: [every[one] for one in group] for first, group in together.items()}, used)
    said = " (what a chart calls is executed with it)" if callers else ""
    return [every[name] for first in _sorted(before, said) for name in together[first]]


def _sorted(before: Mapping[str, list[str]], said: str) -> Iterator[str]:
    done, waiting = set[str](), list(before)
    while waiting:
        ready = [one for one in waiting if all(other in done for other in before[one])]
        if not ready:
            raise DrawnFault(f"the blocks {', '.join(waiting[:5])} feed each other without a delay{said}")
        yield from ready
        done.update(ready)
        waiting = [one for one in waiting if one not in done]


__all__ = ["CONTROL", "DELAYS", "SystemWiring", "number_of", "wired"]
