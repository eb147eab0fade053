"""Names for the charts, blocks and data of a model, each of one thing only."""

from collections.abc import Sequence

from rovercheck.checker.drawn.lower.view import plain_name
from rovercheck.checker.drawn.parsed import StateNode
from rovercheck.checker.drawn.records import DrawnBlock, DrawnChart, DrawnData, DrawnModel
from rovercheck.checker.drawn.stores import DATA_STORE


class ModelNames:
    """Names of one model in the system."""

    def __init__(self, model: DrawnModel) -> None:
        self._charts = _chart_names(model.charts)
        self._taken = _shared_names(model)
        self._blocks: dict[str, str] = {}
        self.data_written = _written(model)
        """The names of data that charts write, and of ports."""
        data = (one for chart in model.charts for one in chart.content.data)
        self._data = {one.name for one in data if one.scope != DATA_STORE}
        self._data |= {one.shown for one in model.system.blocks if one.kind in ("Inport", "Outport")}

    def of_chart(self, chart: DrawnChart) -> str:
        """The name of a chart in the system."""
        return self._charts[chart.path]

    def of_block(self, block: DrawnBlock, short: str) -> str:
        """The name of what a block remembers: the short one where nothing else in the model has it."""
        if block.id not in self._blocks:
            others = {*self._blocks.values(), *self._data, *self._charts.values()}
            named = (short, plain_name(block.path), plain_name(f"{block.path} {block.id}"))
            self._blocks[block.id] = next(one for one in named if one not in others)
        return self._blocks[block.id]

    def of_datum(self, chart: DrawnChart, one: DrawnData, node: StateNode) -> str:
        """The name of a datum of a chart: its own, where nothing else in the model has it."""
        if node.parent is None and one.name not in self._taken:
            return one.name
        inside = node.path.removeprefix(chart.path).strip("/").replace("/", ".")
        return ".".join(filter(None, (self.of_chart(chart), inside, one.name)))


def _chart_names(charts: Sequence[DrawnChart]) -> dict[str, str]:
    """A name for each chart: the last one of its path where that is enough."""
    last = [plain_name(one.name) for one in charts]
    return {
        one.path: name if last.count(name) == 1 else plain_name(one.path.replace("/", "_"))
        for one, name in zip(charts, last, strict=True)
    }


def _written(model: DrawnModel) -> set[str]:
    every = (one for chart in model.charts for level in chart.content.every_level() for one in level.data)
    ports = {one.shown for one in model.system.blocks if one.kind in ("Inport", "Outport")}
    return ports | {one.name for one in every if one.scope != "input"}


def _shared_names(model: DrawnModel) -> set[str]:
    """Names that are no name of one datum alone: of several data, of root inputs, or of other outputs."""
    seen: list[str] = [
        d.name for chart in model.charts for d in chart.content.data if d.scope not in ("input", DATA_STORE)
    ]
    ports = [one.shown for one in model.system.blocks if one.kind == "Inport"]
    return {name for name in seen if seen.count(name) > 1} | set(ports)


__all__ = ["ModelNames"]
