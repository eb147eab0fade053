"""One change of the firmware in several places: a limit of two charts, a rounding of two outputs.

Each place explains deviations of its own, so that each is found by itself; that the same is written in all of
them says that it is one constant or one function of the firmware.
"""

from rovercheck.checker.diagnosis.change import ChartChange

WRITTEN_ONCE = ("interpretation", "repair")
"""What is read otherwise in a whole document."""


def likeness(change: ChartChange) -> tuple[str, ...] | None:
    """What a change has in common with the same one in another place; ``None``: it is told by itself.

    The same comparison of the same data is one in all charts, as ``d1 <= 300`` that becomes ``d1 <= 290``
    in two of them.  Times, numbers and roundings say less about what they are of: they are one in one chart
    alone, numbers where the same datum is assigned.
    """
    if change.reading is not None:
        return None
    match change.kind:
        case "limit" | "comparison":
            return (change.kind, change.old, change.new)
        case "timer":
            return (change.kind, change.chart, change.old, change.new)
        case "constant":
            return (change.kind, change.chart, change.at.rpartition(" ")[2], change.old, change.new)
        case "rounded":
            return (change.kind, change.chart, change.at.partition(" ")[0].partition("/")[0], change.new)
        case _ if change.kind in WRITTEN_ONCE:
            return (change.kind, change.at, change.old, change.new)
    return None


__all__ = ["likeness"]
