"""Charts as XML, with the properties that Stateflow writes and in its order."""

from collections.abc import Sequence
from xml.etree.ElementTree import Element

from rovercheck.checker.simulink.writer.charts import (
    WrittenChart,
    WrittenData,
    WrittenElement,
    WrittenEvent,
    WrittenJunction,
    WrittenState,
    WrittenTable,
    WrittenTransition,
)
from rovercheck.checker.simulink.writer.elements import Values, below, made, put
from rovercheck.checker.simulink.writer.layout import ChartLayout

KINDS = (WrittenState, WrittenData, WrittenEvent, WrittenTransition, WrittenJunction)
"""The order in which elements of one level stand in a file."""
TYPES = {
    "MATLAB Function": "EML_CHART",
    "Truth Table": "TRUTHTABLE_CHART",
    "State Transition Table": "STATE_EVENT_TABLE_CHART",
}
LANGUAGES = {"MATLAB": 2, "C with bit operations": 1}
INHERITED = {"INPUT_DATA": "Inherit: Same as Simulink", "OUTPUT_DATA": "Inherit: Same as Simulink"}


class ChartXml:
    """Writes one chart, whose number in its machine is ``id``."""

    def __init__(self, chart: WrittenChart, id_: int) -> None:
        self.chart, self.id = chart, id_
        self.layout = ChartLayout.of(chart)

    def element(self) -> Element:
        """The chart with all that is in it."""
        one = self.chart
        root = made("chart", {"id": str(self.id)}, {
            "name": one.path, "windowPosition": "[-1 -7 1200 800]", "viewLimits": "[0 800 0 600]",
            "screen": "[1 1 1920 1080 1.25]", "viewObj": self.id, "ssIdHighWaterMark": one.last,
            "decomposition": "SET_CHART" if one.parallel else "CLUSTER_CHART",
            "type": TYPES.get(one.kind), "chartFileNumber": one.number,
        })  # fmt: skip
        if one.is_function:
            put(root, {"disableImplicitCasting": 1})
            below(root, "eml", {"name": one.function_name})
        else:
            put(root, {
                "saturateOnIntegerOverflow": 1 if one.saturates else None,
                "userSpecifiedStateTransitionExecutionOrder": 1 if one.explicit else None,
                "disableImplicitCasting": 1, "actionLanguage": LANGUAGES.get(one.language),
            })  # fmt: skip
        put(root, one.more)
        for tag, values in one.inside.items():
            below(root, tag, values)
        self._children(root, one.children, self.id)
        return root

    def _children(self, root: Element, children: Sequence[WrittenElement], viewer: int) -> None:
        if children:
            holder = below(root, "Children")
            holder.extend(
                self._one(one, viewer) for kind in KINDS for one in children if isinstance(one, kind)
            )

    def _one(self, one: WrittenElement, viewer: int) -> Element:
        match one:
            case WrittenState():
                return self._state(one, viewer)
            case WrittenTransition():
                return _finished(self._transition(one, viewer), one)
            case WrittenJunction():
                return _finished(self._junction(one, viewer), one)
            case WrittenData():
                return _finished(_data(one), one)
            case WrittenEvent():
                values = {"name": one.name, "scope": one.scope, "trigger": one.trigger}
                return _finished(_numbered("event", one, values), one)
        raise TypeError(one)

    def _state(self, one: WrittenState, viewer: int) -> Element:
        root = _numbered("state", one, {
            "labelString": one.label, "position": _numbers(*self.layout.frames[one.ssid]),
            "fontSize": 12, "superState": "SUBCHART" if one.subchart else None, "subviewer": viewer,
        })  # fmt: skip
        if one.subchart and one.type != "FUNC_STATE":
            below(root, "subviewS")
        put(root, {"type": one.type, "decomposition": "SET_STATE" if one.parallel else "CLUSTER_STATE"})
        below(root, "eml", {"isEML": 1, "script": one.script} if one.script else {})
        if one.table is not None:
            _table(root, one.table)
        put(root, {"executionOrder": one.order or None})
        _finished(root, one)
        self._children(root, one.children, one.ssid if one.subchart else viewer)
        return root

    def _transition(self, one: WrittenTransition, viewer: int) -> Element:
        start, middle, stop = self.layout.points.get(one.ssid, ((0, 0), (0, 0), (0, 0)))
        label = _numbers(*self.layout.labels.get(one.ssid, (0, 0)), 60, 16)
        root = _numbered("transition", one, {
            "labelString": one.label, "labelPosition": label, "fontSize": 12
        })  # fmt: skip
        leaves = "0 1 0 0" if one.source is None else f"2 {-1 if one.inner else 1} 0 0.5"
        enters = f"4 {1 if one.inner and one.target is one.source else -1} 0 0.5"
        for tag, end, border, (x, y) in (
            ("src", one.source, leaves, start), ("dst", one.target, enters, stop)
        ):  # fmt: skip
            at = f"[{border} {x:g} {y:g} 0 0]"
            below(root, tag, {"SSID": None if end is None else end.ssid, "intersection": at})
        across, down = sorted((start[0], stop[0])), sorted((start[1], stop[1]))
        put(root, {
            "midPoint": _numbers(*middle), "dataLimits": _numbers(*across, *down), "subviewer": viewer,
            "drawStyle": "SMART",
        })  # fmt: skip
        below(root, "slide", {"sticky": "BOTH_STICK"})
        put(root, {
            "type": one.wire or None, "firstSubWire": one.first or None, "subLink": one.link or None,
            "executionOrder": one.order,
        })  # fmt: skip
        return root

    def _junction(self, one: WrittenJunction, viewer: int) -> Element:
        x, y, across, down = self.layout.frames[one.ssid]
        return _numbered("junction", one, {
            "labelString": "H" if one.history else None,
            "position": _numbers(x + across / 2, y + down / 2, across / 2),
            "subviewer": viewer,
            "type": "HISTORY_JUNCTION" if one.history else "CONNECTIVE_JUNCTION",
        })  # fmt: skip


def _numbers(*values: float) -> str:
    return f"[{' '.join(f'{one:g}' for one in values)}]"


def _numbered(tag: str, one: WrittenElement, values: Values) -> Element:
    return made(tag, {"SSID": str(one.ssid)}, values)


def _finished(root: Element, one: WrittenElement) -> Element:
    """The element with what is said beyond its kind."""
    put(root, one.more)
    for tag, values in one.inside.items():
        below(root, tag, values)
    return root


def _table(root: Element, table: WrittenTable) -> None:
    """A truth table: its cells column by column."""
    element = below(root, "truthTable", {"isTruthTable": 1})
    rows = len(table.conditions) + 1
    columns = [[""] * rows, [*table.conditions, ""]]
    for one in table.decisions:
        letters, _, chosen = one.partition(" ")
        columns.append([*letters, chosen])
    grids = {
        "predicateArray": columns, "actionArray": [[""] * len(table.actions), list(table.actions)]
    }  # fmt: skip
    for name, grid in grids.items():
        size = f"{len(grid[0])}*{len(grid)}"
        array = below(element, "Array", None, PropName=name, Type="Cell", Dimension=size)
        for cell in (cell for column in grid for cell in column):
            below(array, "Cell").text = cell


def _data(one: WrittenData) -> Element:
    root = made("data", {"SSID": str(one.ssid), "name": one.name}, {"scope": one.scope})
    props = below(root, "props")
    below(props, "array", {"size": one.size})
    if one.low is not None or one.high is not None:
        below(props, "range", {"minimum": one.low, "maximum": one.high})
    below(props, "type", {**_type(one.type), "isSigned": 1, "wordLength": 16})
    built_in = one.type in ("double", "single", "boolean") or "int" in one.type
    put(props, {"frame": "SF_FRAME_NO" if built_in else "SF_FRAME_INHERITED", "initialValue": one.initial})
    below(props, "unit", {"name": "inherit"})
    inherited = INHERITED.get(one.scope, "Inherit: From definition in chart")
    put(root, {"dataType": one.type or inherited})
    return root


def _type(written: str) -> Values:
    """The type once more, as the editor keeps it."""
    kind, _, name = written.partition(": ")
    if not written:
        return {"method": "SF_INHERITED_TYPE", "primitive": "SF_DOUBLE_TYPE"}
    if kind == "Enum":
        return {"method": "SF_ENUM_TYPE", "primitive": "SF_DOUBLE_TYPE", "enumType": name}
    if kind == "Bus":
        return {"method": "SF_SIMULINK_OBJECT_TYPE", "primitive": "SF_DOUBLE_TYPE", "busObject": name}
    return {"primitive": f"SF_{written.upper()}_TYPE"}


__all__ = ["ChartXml"]
