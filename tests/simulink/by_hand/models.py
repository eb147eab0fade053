"""What a model by hand is made of: how it is drawn, what it pins, and a simulation of it."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from rovercheck.checker.drawn.records import DrawnModel
from rovercheck.checker.simulink.model import read_model
from rovercheck.checker.simulink.writer.charts import WrittenChart
from rovercheck.checker.simulink.writer.packages import Layout, WrittenModel

Given = Iterable[int]
Simulation = Callable[[Given], Iterator[tuple[float, ...]]]


class Package(Protocol):
    """What writes itself as a package, in one of its layouts."""

    layout: Layout

    def save(self, path: Path) -> Path:
        """Write it."""


@dataclass(frozen=True)
class ByHand:
    """A model with one input ``u``; ``beside`` writes files beside it, and says which are to be named."""

    name: str
    draw: Callable[[], Package]
    simulate: Simulation
    inputs: tuple[int, ...] = (0, 1, 2, 3)
    beside: Callable[[Path], Sequence[Path]] = lambda folder: ()

    def read(self, folder: Path, layout: Layout = "parts") -> DrawnModel:
        """The model, as it is read from its package."""
        model = self.draw()
        model.layout = layout
        return read_model(model.save(folder / "one.slx"), self.beside(folder))


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


def held(value: int, low: int, high: int) -> int:
    """The value that is next to one, between both ends."""
    return max(low, min(high, value))


def nearest(value: int, by: int) -> int:
    """The whole number next to a quotient, halves away from 0."""
    whole, rest = divmod(abs(value), by)
    whole += 2 * rest >= by
    return whole if value >= 0 else -whole


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


__all__ = ["ByHand", "Given", "Simulation", "Told", "held", "nearest", "one_chart", "tell"]
