"""Moore charts, which compute outputs before they take transitions, and Mealy charts."""

from collections.abc import Iterator, Mapping
from typing import Any

from rovercheck.checker.simulink.writer.charts import WrittenChart
from tests.simulink.by_hand.models import ByHand, Given, one_chart

MOORE: Mapping[str, Any] = {"stateMachineType": "MOORE_MACHINE", "executeAtInitialization": 1}


def _levels(chart: WrittenChart) -> None:
    """A state with states in it: the actions of all that are active come first, then one transition."""
    off = chart.state("Off\ny = int8(1); z = int8(0); n = int8(0);")
    on = chart.state("On\ny = int8(2); n = n + 1;")
    slow, fast = chart.state("Slow\nz = int8(5);", on), chart.state("Fast\nz = int8(6);", on)
    chart.transition(None, off)
    chart.transition(off, on, "[u == 1]")
    chart.transition(on, off, "[u == 3 || n > 4]")
    chart.transition(None, slow, holder=on)
    chart.transition(slow, fast, "[u == 2]")
    chart.transition(fast, slow, "[after(2, tick)]")


def _levels_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state, n, ticks = "Off", 0, 0
    for u in given:
        ticks += 1
        n = 0 if state == "Off" else n + 1
        outputs = {"Off": (1, 0), "Slow": (2, 5), "Fast": (2, 6)}[state]
        yield (*outputs, n)
        before = state
        if state == "Off":
            state = "Slow" if u == 1 else state
        elif u == 3 or n > 4:
            state = "Off"
        elif state == "Slow" and u == 2:
            state = "Fast"
        elif state == "Fast" and ticks >= 2:
            state = "Slow"
        ticks = ticks if state == before else 0


def _anew(chart: WrittenChart) -> None:
    """Regions with outputs that begin anew: a state that does not write one has it at 0."""
    chart.parallel = True
    first, second = chart.state("First", order=1), chart.state("Second\nc = int8(9);", order=2)
    for region, name, other in ((first, "a", 1), (second, "b", 2)):
        low, high = chart.state("Low", region), chart.state(f"High\n{name} = int8({other});", region)
        chart.transition(None, low, holder=region)
        chart.transition(low, high, f"[u == {other}]")
        chart.transition(high, low, "[u == 0]")


def _anew_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    high = {1: False, 2: False}
    for u in given:
        yield (1 if high[1] else 0, 2 if high[2] else 0, 9)
        high = {one: u != 0 if was else u == one for one, was in high.items()}


def _mealy(chart: WrittenChart) -> None:
    """Outputs are written in condition actions, on paths that fail, too."""
    off, on, junction = chart.state("Off"), chart.state("On"), chart.junction()
    chart.transition(None, off, "{y = int8(7);}")
    chart.transition(off, junction, "[u > 0]{y = int8(1);}")
    chart.transition(junction, on, "[u == 2]{y = int8(2);}")
    chart.transition(on, off, "[u == 0]{y = int8(3);}")


def _mealy_by_hand(given: Given) -> Iterator[tuple[float, ...]]:
    state, y = "", 0
    for u in given:
        if not state:
            state, y = "Off", 7
        elif state == "Off" and u > 0:
            state, y = ("On", 2) if u == 2 else ("Off", 1)
        elif state == "On" and u == 0:
            state, y = "Off", 3
        yield (y,)


def _outs(*names: str) -> dict[str, str]:
    return dict.fromkeys(names, "int8")


MACHINES = (
    ByHand(
        "moore levels",
        one_chart(_levels, _outs("y", "z", "n"), **MOORE), _levels_by_hand,
    ),
    ByHand(
        "moore regions",
        one_chart(_anew, _outs("a", "b", "c"), initializeOutput=1, **MOORE),
        _anew_by_hand,
    ),
    ByHand(
        "mealy",
        one_chart(_mealy, _outs("y"), stateMachineType="MEALY_MACHINE"), _mealy_by_hand,
    ),
)  # fmt: skip

__all__ = ["MACHINES"]
