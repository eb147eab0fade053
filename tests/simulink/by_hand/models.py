"""What a model by hand is made of: how it is drawn, what it pins, and a simulation of it."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import WrittenModel

Given = Iterable[int]
Simulation = Callable[[Given], Iterator[tuple[float, ...]]]


@dataclass(frozen=True)
class ByHand:
    """A model with one input ``u``; ``pins`` are the rules that it rests on, by the titles of the sheet."""

    name: str
    pins: tuple[str, ...]
    draw: Callable[[], WrittenModel]
    simulate: Simulation
    inputs: tuple[int, ...] = field(default=(0, 1, 2, 3))


def tell(digit: int) -> str:
    """An action that mixes a digit into ``t``, so that ``t`` tells the order of all that was done."""
    return f"t = mod(t * 7 + {digit}, 9973);"


class Told:
    """The same in a simulation by hand."""

    def __init__(self) -> None:
        self.t = 0

    def __call__(self, *digits: int) -> None:
        for one in digits:
            self.t = (self.t * 7 + one) % 9973


def one_chart(
    draw: Callable[[WrittenChart], None],
    outs: Mapping[str, str] | None = None,
    kind: str = "int8",
    **more: object,
) -> Callable[[], WrittenModel]:
    """A model of one chart with the input ``u``; ``t`` is its output unless others are given."""

    def made() -> WrittenModel:
        model = WrittenModel("one", step="0.1")
        block, chart = model.root.chart("C")
        chart.more = more
        chart.data("u", "input", kind)
        for name, type_ in (outs or {"t": "uint32"}).items():
            chart.data(name, "output", type_)
        draw(chart)
        model.root.line(model.root.inport("u", 1, OutDataTypeStr=kind), block)
        for number, name in enumerate(outs or {"t": ""}, 1):
            model.root.line(f"{block}/{number}", model.root.outport(name, number))
        return model

    return made


__all__ = ["ByHand", "Given", "Simulation", "Told", "one_chart", "tell"]
