"""What of a subsystem begins anew when it is disabled or enabled, as its ports say."""

from rovercheck.checker.drawn.records import DrawnBlock, DrawnSystem
from rovercheck.checker.drawn.wiring import CONTROL


def begins_anew(outport: DrawnBlock) -> bool:
    """Whether an output has its initial value while its subsystem is disabled."""
    return outport.parameters.get("OutputWhenDisabled", "held") == "reset"


def resets_refused(system: DrawnSystem) -> str:
    """Why what begins anew in a subsystem has no meaning here; empty if it has one."""
    controls = {one.kind for one in system.blocks if one.kind in CONTROL}
    for one in system.blocks:
        if one.kind in CONTROL and one.parameters.get("StatesWhenEnabling", "held") == "reset":
            return "StatesWhenEnabling = reset is not known here; held is"
        if one.kind != "Outport" or not begins_anew(one) or not controls:
            continue
        if controls != {"EnablePort"}:
            return f"{one.shown}: OutputWhenDisabled = reset is known here with an enable port alone; held is"
        if one.parameters.get("InitialOutput", "[]").strip() == "[]":
            return f"{one.shown}: OutputWhenDisabled = reset needs an initial output. Write one, as 0"
    return ""


__all__ = ["begins_anew", "resets_refused"]
