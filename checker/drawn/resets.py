"""What of a subsystem begins anew when it is disabled or enabled, as its ports say."""

from collections.abc import Iterator, Mapping

from rovercheck.checker.drawn.records import DrawnBlock, DrawnChart, DrawnSystem
from rovercheck.checker.drawn.store_order import MEMORY
from rovercheck.checker.drawn.wiring import CONTROL

HELD = "Set States when enabling to held"


def begins_anew(outport: DrawnBlock) -> bool:
    """Whether an output has its initial value while its subsystem is disabled."""
    return outport.parameters.get("OutputWhenDisabled", "held") == "reset"


def is_reset(system: DrawnSystem) -> bool:
    """Whether all in a subsystem is as at first whenever it is enabled after it was disabled."""
    return any(one.kind == "EnablePort" and _says_reset(one) for one in system.blocks)


def _says_reset(port: DrawnBlock) -> bool:
    return port.parameters.get("StatesWhenEnabling", "held") == "reset"


def resets_refused(system: DrawnSystem) -> str:
    """Why what begins anew in a subsystem has no meaning here; empty if it has one."""
    controls = {one.kind for one in system.blocks if one.kind in CONTROL}
    for one in system.blocks:
        if one.kind in CONTROL and one.kind != "EnablePort" and _says_reset(one):
            return "StatesWhenEnabling = reset is known here with an enable port alone; held is"
        if one.kind != "Outport" or not begins_anew(one) or not controls:
            continue
        if controls != {"EnablePort"}:
            return f"{one.shown}: OutputWhenDisabled = reset is known here with an enable port alone; held is"
        if one.parameters.get("InitialOutput", "[]").strip() == "[]":
            return f"{one.shown}: OutputWhenDisabled = reset needs an initial output. Write one, as 0"
    return ""


def states_refused(
    block: DrawnBlock, controlled: bool, charts: Mapping[str, DrawnChart]
) -> Iterator[str]:  # fmt: skip
    """Why a subsystem whose states begin anew has no meaning here.

    ``controlled``: it is in another one that is not executed in every step.
    """
    if block.system is None or block.chart or not is_reset(block.system):
        return
    if controlled:
        yield (
            "its states begin anew when it is enabled, and what it is in is enabled, triggered or "
            f"called: whether that enables it, too, is not known here. {HELD}."
        )
    for one in block.system.every_block():
        name = one.path.removeprefix(f"{block.path}/")
        if why := _kept(one, charts):
            yield f"its states begin anew when it is enabled, and {name} in it {why}. {HELD}."


def _kept(block: DrawnBlock, charts: Mapping[str, DrawnChart]) -> str:
    """Why it is not known here what of a block begins anew with the subsystem around it."""
    if block.kind == MEMORY:
        return "is a data store"
    if block.chart:
        chart = charts.get(block.chart)
        return "" if chart is None else _of_chart(chart)
    if block.system is not None and any(one.kind in CONTROL for one in block.system.blocks):
        return "is controlled itself"
    return ""


def _of_chart(chart: DrawnChart) -> str:
    levels = list(chart.content.every_level())
    if chart.at_initialization:
        return "is entered before the first step"
    if any(one.scope != "local" for level in levels for one in level.events):
        return "has events from or to other blocks"
    if any(one.history for level in levels for one in level.junctions):
        return "has a history junction"
    if any(one.function == "Simulink" for one in chart.content.every_state()):
        return "has Simulink functions"
    return ""


__all__ = ["begins_anew", "is_reset", "resets_refused", "states_refused"]
