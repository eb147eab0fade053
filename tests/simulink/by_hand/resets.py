"""Enabled subsystems whose states begin anew whenever they are enabled, or are held."""

from collections.abc import Callable, Iterator

from rovercheck.checker.simulink.writer.packages import WrittenModel
from tests.simulink.by_hand.models import ByHand, Given

SCRIPT = """function p = sum_up(i)
persistent n;
if isempty(n)
    n = int16(2);
end
n = n + i;
p = n;
end
"""


def _enabled(states: str) -> Callable[[], WrittenModel]:
    """A chart with a local datum, times and changes, a MATLAB function with memory, and a delay."""

    def made() -> WrittenModel:
        model = WrittenModel("one", step="0.1")
        sub, inside = model.root.subsystem("S", 1, 3, "enable")
        inside.block("EnablePort", "on", {}, {}, StatesWhenEnabling=states)
        given = inside.inport("i", 1, OutDataTypeStr="int16")
        block, chart = inside.chart("C")
        chart.data("i", "input", "int16")
        chart.data("t", "output", "int16", 50)
        chart.data("n", "local", "int16", 3)
        one, two = (
            chart.state("One\nen: t = t + 1; if hasChanged(i), t = t + 20; end\ndu: n = n + i;"),
            chart.state("Two\nen: t = n;"),
        )
        chart.transition(None, one)
        chart.transition(one, two, "[after(2, tick)]")
        chart.transition(two, one, "[hasChanged(i)]")
        number, function = inside.chart("F", "MATLAB Function", SCRIPT)
        function.data("i", "input", "int16")
        function.data("p", "output", "int16")
        delay = inside.block("UnitDelay", "last", {"in": 1, "out": 1}, {}, InitialCondition="int16(4)")
        add = inside.block("Sum", "add", {"in": 2, "out": 1}, {}, Inputs="++", OutDataTypeStr="int16")
        for source, target in (
            (given, block), (given, number), (given, add), (delay, f"{add}/2"), (add, delay),
            (block, inside.outport("t", 1)), (number, inside.outport("p", 2)), (add, inside.outport("s", 3)),
        ):  # fmt: skip
            inside.line(source, target)
        port = model.root.inport("u", 1, OutDataTypeStr="int16")
        model.root.line(port, sub)
        model.root.line(port, f"{sub}#enable")
        for end, name in enumerate("tps", 1):
            model.root.line(f"{sub}/{end}", model.root.outport(name, end))
        return model

    return made


def _by_hand(anew: bool) -> Callable[[Given], Iterator[tuple[float, ...]]]:
    def first() -> tuple[str, int, int, int, int, int, int | None]:
        return "", 0, 50, 3, 2, 4, None

    def simulate(given: Given) -> Iterator[tuple[float, ...]]:
        state, ticks, t, n, kept, delay, before = first()
        on, outputs = False, (50, 0, 0)
        for u in given:
            was, on = on, u > 0
            if on:
                if anew and not was:
                    state, ticks, t, n, kept, delay, before = first()
                ticks += 1
                if not state:
                    state, ticks, t = "One", 0, t + 1
                elif state == "One" and ticks >= 2:
                    state, ticks, t = "Two", 0, n
                elif state == "One":
                    n += u
                elif before is not None and u != before:
                    state, ticks, t = "One", 0, t + 21
                before, kept, delay = u, kept + u, delay + u
                outputs = (t, kept, delay)
            yield outputs

    return simulate


RESETS = tuple(
    ByHand(f"states {states}", _enabled(states), _by_hand(states == "reset")) for states in ("held", "reset")
)

__all__ = ["RESETS"]
