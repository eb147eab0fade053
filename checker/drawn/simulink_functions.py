"""Simulink functions of charts: the subsystem in the block of a chart that a call executes."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.parsed import FunctionNode, ParsedChart
from rovercheck.checker.drawn.records import DrawnBlock, DrawnSystem
from rovercheck.checker.drawn.wiring import number_of

ARGUMENTS = {"ArgIn": "Inport", "ArgOut": "Outport"}
"""What the ports of a function are called since R2014b."""


@dataclass(frozen=True)
class SimulinkFunction:
    """A function with its blocks: arguments and results by name, in the order of the ports."""

    node: FunctionNode
    system: DrawnSystem
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


def simulink_functions(block: DrawnBlock, chart: ParsedChart) -> Iterator[SimulinkFunction]:
    """The Simulink functions of a chart.  Raises ``DrawnFault`` for one without the blocks of its label."""
    for state in chart.root.every():
        for node in state.functions.values():
            if node.drawn.function == "Simulink":
                yield _function(block, node)


def _function(block: DrawnBlock, node: FunctionNode) -> SimulinkFunction:
    system = _subsystem(block, node)
    found = SimulinkFunction(node, system, _names(system, "Inport"), _names(system, "Outport"))
    signature, name = node.signature, node.signature.name
    for what, own, drawn in (
        ("Inports", signature.inputs, found.inputs), ("Outports", signature.outputs, found.outputs)
    ):  # fmt: skip
        if {*own} != {*drawn} or len(own) != len(drawn):
            shown, said = (", ".join(filter(None, some)) or "none" for some in (drawn, own))
            raise DrawnFault(
                f"the Simulink function {name} has the {what} {shown}, and its label says {said}: give both "
                "the same names"
            )
    missing = [one for one in (*found.inputs, *found.outputs) if one not in node.data]
    if missing:
        raise DrawnFault(f"the Simulink function {name} has no datum {missing[0]}: save the model again")
    return found


def _subsystem(block: DrawnBlock, node: FunctionNode) -> DrawnSystem:
    name, inside = node.drawn.block or node.signature.name, block.system
    every = () if inside is None else inside.blocks
    found = [one.system for one in every if one.kind == "SubSystem" and one.shown == " ".join(name.split())]
    if len(found) != 1 or found[0] is None:
        raise DrawnFault(
            f"the Simulink function {node.signature.name} (SSID {node.drawn.ssid}) has no subsystem {name} "
            "in the block of its chart: if it is a link to a library, break that, and save the model again"
        )
    system = found[0]
    return replace(system, blocks=tuple(_as_port(one) for one in system.blocks))


def _as_port(block: DrawnBlock) -> DrawnBlock:
    if block.kind not in ARGUMENTS:
        return block
    name = block.parameters.get("ArgumentName", block.name)
    return replace(block, kind=ARGUMENTS[block.kind], name=name)


def _names(system: DrawnSystem, kind: str) -> tuple[str, ...]:
    return tuple(o.shown for o in sorted((o for o in system.blocks if o.kind == kind), key=number_of))


__all__ = ["SimulinkFunction", "simulink_functions"]
