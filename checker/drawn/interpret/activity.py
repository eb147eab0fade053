"""What an output tells of the states that are active."""

from collections.abc import Collection

from rovercheck.checker.drawn.activity import NONE, activity_members
from rovercheck.checker.drawn.faults import DrawnFault
from rovercheck.checker.drawn.interpret.memory import TypeTable
from rovercheck.checker.drawn.interpret.values import MatlabValue, logical
from rovercheck.checker.drawn.parsed import ParsedChart, StateNode
from rovercheck.checker.drawn.records import DrawnData


def activity(
    one: DrawnData, chart: ParsedChart, active: Collection[StateNode], types: TypeTable
) -> MatlabValue:
    """Whether its state is active, or the member of the child or leaf that is.  Raises ``DrawnFault``."""
    if one.activity == "self":
        state = chart.states.get(one.activity_of or 0)
        return logical(state in active if one.activity_of else bool(active))
    told = activity_members(chart.drawn, one).items()
    name = next((name for ssid, name in told if chart.states.get(ssid) in active), NONE)
    owner = one.type.partition(":")[2].strip()
    found = types.member(name, owner)
    if found is None:
        raise DrawnFault(f"{one.name}: {owner} has no member {name}, as a state is named")
    return found


__all__ = ["activity"]
