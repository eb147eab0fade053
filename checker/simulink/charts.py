"""Charts as Stateflow writes them: elements with properties, of which only those are there that are not as
by default.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import chain
from typing import Literal, TypeVar, cast

from rovercheck.checker.drawn.records import (
    ChartLanguage,
    DrawnActivity,
    DrawnChart,
    DrawnChartKind,
    DrawnContent,
    DrawnData,
    DrawnEvent,
    DrawnFunctionKind,
    DrawnJunction,
    DrawnScope,
    DrawnState,
    DrawnStateKind,
    DrawnTransition,
    DrawnTrigger,
    Point,
    Rectangle,
)
from rovercheck.checker.simulink.truth_tables import truth_table
from rovercheck.checker.simulink.xml import XmlElement, numbers
from rovercheck.spec_model.lang.errors import ModelError

Word = TypeVar("Word")

CHARTS: Mapping[str, DrawnChartKind] = {
    "": "chart",
    "EML_CHART": "MATLAB function",
    "TRUTHTABLE_CHART": "truth table",
    "STATE_EVENT_TABLE_CHART": "state transition table",
}
LANGUAGES: Mapping[str, ChartLanguage] = {"": "C", "0": "C", "1": "C with bit operations", "2": "MATLAB"}
STATES: Mapping[str, DrawnStateKind] = {
    "OR_STATE": "exclusive", "AND_STATE": "parallel", "FUNC_STATE": "function", "GROUP_STATE": "box"
}  # fmt: skip
SCOPES: Mapping[str, DrawnScope] = {
    "": "local", "INPUT_DATA": "input", "OUTPUT_DATA": "output", "LOCAL_DATA": "local",
    "CONSTANT_DATA": "constant", "PARAMETER_DATA": "parameter", "TEMPORARY_DATA": "temporary",
    "FUNCTION_INPUT_DATA": "function input", "FUNCTION_OUTPUT_DATA": "function output",
    "DATA_STORE_MEMORY_DATA": "data store",
}  # fmt: skip
TRIGGERS: Mapping[str, DrawnTrigger] = {
    "": "", "FUNCTION_CALL_EVENT": "function call", "RISING_EDGE_EVENT": "rising",
    "FALLING_EDGE_EVENT": "falling", "EITHER_EDGE_EVENT": "either",
}  # fmt: skip
UPDATES: Mapping[str, Literal["inherited", "discrete", "continuous"]] = {
    "": "inherited", "INHERITED": "inherited", "DISCRETE": "discrete", "CONTINUOUS": "continuous"
}  # fmt: skip
MACHINES: Mapping[str, Literal["classic", "Mealy", "Moore"]] = {
    "": "classic", "CLASSIC_MACHINE": "classic", "MEALY_MACHINE": "Mealy", "MOORE_MACHINE": "Moore"
}  # fmt: skip

ACTIVITIES: Mapping[str, DrawnActivity] = {
    "": "child", "CHILD_ACTIVITY": "child", "SELF_ACTIVITY": "self", "LEAF_STATE_ACTIVITY": "leaf"
}  # fmt: skip

_NAME = re.compile(r"\s*([^\n/]*)")
_AUTOMATIC = 2**32 - 1
"""The order of pieces of a wire that have none."""


def chart_of(element: XmlElement, part: str, path: str, place: str) -> DrawnChart:
    """A chart from its element; ``place`` names the part in messages.  Raises ``ModelError``."""
    return _ChartReader(element, part, path, place).chart()


class _ChartReader:
    def __init__(self, element: XmlElement, part: str, path: str, place: str) -> None:
        self.element, self.part, self.path, self.place = element, part, path, place
        self._commented = {inner.attributes.get("SSID") for one in element.every() if _is_commented(one)
                           for inner in one.every()} - {None}  # fmt: skip
        """What is commented out, with all that is in it: it is as if it were not drawn."""

    def chart(self) -> DrawnChart:
        one = self.element
        kind = self._word(one, "type", CHARTS)
        language: ChartLanguage = self._word(one, "actionLanguage", LANGUAGES)
        activity = one.child("activeStateOutput")
        content = self._unique(self._content(one, None))
        return DrawnChart(
            path=self.path,
            kind=kind,
            language="MATLAB" if kind == "MATLAB function" else language,
            content=self._with_activities(content, one),
            part=self.part,
            id=self._whole(one, one.attributes.get("id", "0"), "the id"),
            parallel=one.property_of("decomposition") == "SET_CHART",
            explicit_order=_on(one, "userSpecifiedStateTransitionExecutionOrder"),
            saturates=_on(one, "saturateOnIntegerOverflow") or kind == "MATLAB function",
            at_initialization=_on(one, "executeAtInitialization"),
            initializes_outputs=_on(one, "initializeOutput"),
            super_step=_on(one, "enableNonTerminalStates"),
            update=self._word(one, "updateMethod", UPDATES),
            sample_time=one.property_of("sampleTime"),
            machine=self._word(one, "stateMachineType", MACHINES),
            exports_functions=_on(one, "exportChartFunctions"),
            activity_output="" if activity is None else activity.property_of("customName") or "active state",
            function=eml.property_of("name") if (eml := one.child("eml")) is not None else "",
        )

    # --- elements ------------------------------------------------------------------------------------------

    def _content(self, holder: XmlElement, state: int | None) -> DrawnContent:
        """What is nested in a chart or a state, which is ``state``."""
        children = holder.child("Children")
        drawn = [] if children is None else children.children
        every = [one for one in drawn if not self._is_left_out(one)]
        wires = (one for one in every if one.tag == "transition" and one.property_of("type") != "SUB")
        return DrawnContent(
            tuple(self._state(one) for one in every if one.tag == "state"),
            tuple(self._transition(one, state) for one in wires),
            tuple(self._junction(one) for one in every if one.tag == "junction"),
            tuple(data_of(one, self.place) for one in every if one.tag == "data"),
            tuple(self._event(one) for one in every if one.tag == "event"),
        )

    def _is_left_out(self, one: XmlElement) -> bool:
        """Whether an element is commented out, or is a transition from or to one that is."""
        ends = [end.property_of("SSID") for end in one.children if end.tag in ("src", "dst")]
        return not self._commented.isdisjoint([one.attributes.get("SSID"), *ends])

    def _unique(self, content: DrawnContent) -> DrawnContent:
        """The same content.  Raises ``ModelError`` if two elements of it have one number."""
        seen: dict[int, int] = {}
        for level in content.every_level():
            every: Iterator[DrawnState | DrawnTransition | DrawnJunction | DrawnData | DrawnEvent] = chain(
                level.states, level.transitions, level.junctions, level.data, level.events
            )
            for one in every:
                if one.ssid in seen:
                    raise ModelError(
                        f"{self.place}, line {one.line}: the element has SSID {one.ssid}, and so has "
                        f"the one in line {seen[one.ssid]}. Save the model again in Simulink."
                    )
                seen[one.ssid] = one.line
        return content

    def _state(self, one: XmlElement) -> DrawnState:
        ssid, label = self._ssid(one), one.property_of("labelString")
        simulink, table, eml = one.child("simulink"), one.child("truthTable"), one.child("eml")
        note = _on(one, "isNoteBox")
        kind: DrawnStateKind = "note" if note else self._word(one, "type", STATES)
        script = "" if eml is None else eml.property_of("script")
        function: DrawnFunctionKind = ""
        if kind == "function":
            function = "MATLAB" if script else "graphical"
            if table is not None and _on(table, "isTruthTable"):
                function = "truth table"
            elif simulink is not None and _on(simulink, "isSimulinkFcn"):
                function = "Simulink"
        return DrawnState(
            ssid=ssid,
            kind=kind,
            name=_name(label, kind),
            label=label,
            content=DrawnContent() if note else self._content(one, ssid),
            parallel=one.property_of("decomposition") == "SET_STATE",
            order=self._whole(one, one.property_of("executionOrder", "0"), "executionOrder"),
            subchart=one.property_of("superState") == "SUBCHART",
            function=function,
            script=script,
            table=None if table is None else truth_table(table, self.place),
            block="" if simulink is None else simulink.property_of("blockName"),
            binding="" if simulink is None else simulink.property_of("binding"),
            atomic=simulink is not None and _on(simulink, "isComponent"),
            action_subsystem=simulink is not None and _on(simulink, "isActionSubsystem"),
            rectangle=cast(Rectangle, numbers(one.property_of("position"), 4)),
            requirement=one.property_of("requirementInfo"),
            line=one.line,
        )

    def _transition(self, one: XmlElement, holder: int | None) -> DrawnTransition:
        source, target = self._end(one, "src"), self._end(one, "dst")
        order = self._whole(one, one.property_of("executionOrder", "0"), "executionOrder")
        ends = (e.property_of("intersection") for e in (one.child("src"), one.child("dst")) if e is not None)
        spots = [cast(Point, numbers(text, 6)[4:]) for text in ends if text]
        label = one.property_of("labelPosition")
        if spots and (middle := one.property_of("midPoint")):
            spots.insert(1, cast(Point, numbers(middle, 2)))
        return DrawnTransition(
            ssid=self._ssid(one),
            source=source,
            target=target,
            label=one.property_of("labelString"),
            order=0 if order == _AUTOMATIC else order,
            inner=source is not None and source == holder,
            points=tuple(spots),
            label_at=cast(Point, numbers(label, 4)[:2]) if label else None,
            line=one.line,
        )

    def _end(self, one: XmlElement, tag: str) -> int | None:
        end = one.child(tag)
        text = "" if end is None else end.property_of("SSID")
        return self._whole(one, text, f"{tag}/SSID") if text else None

    def _junction(self, one: XmlElement) -> DrawnJunction:
        at = cast(Point, numbers(one.property_of("position"), 2))
        return DrawnJunction(self._ssid(one), one.property_of("type") == "HISTORY_JUNCTION", at, one.line)

    def _event(self, one: XmlElement) -> DrawnEvent:
        scopes: Mapping[str, Literal["local", "input", "output"]] = {
            "": "local", "LOCAL_EVENT": "local", "INPUT_EVENT": "input", "OUTPUT_EVENT": "output"
        }  # fmt: skip
        scope, trigger = self._word(one, "scope", scopes), self._word(one, "trigger", TRIGGERS)
        name = one.property_of("name") or one.attributes.get("name", "")
        return DrawnEvent(self._ssid(one), name, scope, trigger if scope != "local" else "", one.line)

    # --- activities ----------------------------------------------------------------------------------------

    def _with_activities(self, content: DrawnContent, chart: XmlElement) -> DrawnContent:
        """The content with what its outputs of active states tell: of themselves, children or leaves."""
        holders = {self._ssid(one): one for one in chart.every() if one.tag == "state"}
        own = chart.child("activeStateOutput")
        data = []
        for one in content.data:
            at, output = one.activity_of, own
            if at in holders:
                output = holders[at].child("activeStateOutput")
            elif own is not None and (at is not None or one.name == own.property_of("customName")):
                at = 0
            if at is None or one.scope != "output":
                data.append(one)
                continue
            mode: DrawnActivity = "self" if at and (output is None or one.type == "boolean") else "child"
            if output is not None and (at == 0 or one.type != "boolean"):
                mode = self._word(output, "activityMode", ACTIVITIES)
            type_ = one.type
            if output is not None and type_.startswith("Inherit") and mode != "self":
                type_ = f"Enum: {output.property_of('enumTypeName')}"
            data.append(replace(one, activity_of=at, activity=mode, type=type_))
        return replace(content, data=tuple(data))

    # --- values --------------------------------------------------------------------------------------------

    def _ssid(self, one: XmlElement) -> int:
        text = one.attributes.get("SSID") or one.attributes.get("id", "")
        return self._whole(one, text, "SSID")

    def _whole(self, one: XmlElement, text: str, what: str) -> int:
        return _whole(one, text, what, self.place)

    def _word(self, one: XmlElement, name: str, words: Mapping[str, Word]) -> Word:
        return _word(one, name, words, self.place)


def data_of(one: XmlElement, place: str) -> DrawnData:
    """A datum from its element.  Raises ``ModelError``."""
    size = one.below("props", "array")
    limits = one.below("props", "range")
    message = one.child("message")
    props = one.child("props")
    activity = one.property_of("outputState")
    first = "" if size is None else size.property_of("firstIndex")
    return DrawnData(
        ssid=_whole(one, one.attributes.get("SSID") or one.attributes.get("id", ""), "SSID", place),
        name=one.attributes.get("name", "") or one.property_of("name"),
        scope=_word(one, "scope", SCOPES, place),
        type=one.property_of("dataType"),
        size="" if size is None else size.property_of("size"),
        initial="" if props is None else props.property_of("initialValue"),
        minimum="" if limits is None else limits.property_of("minimum"),
        maximum="" if limits is None else limits.property_of("maximum"),
        first_index=first and str(_whole(one, first, "firstIndex", place)),
        from_workspace=_on(one, "initFromWorkspace"),
        message=message is not None and _on(message, "isMessage"),
        activity_of=_whole(one, activity, "outputState", place) if activity else None,
        line=one.line,
    )


def _whole(one: XmlElement, text: str, what: str, place: str) -> int:
    """A whole number as it is written.  Raises ``ModelError``."""
    written = text.strip()
    if not re.fullmatch(r"-?\d{1,18}", written):
        raise ModelError(
            f"{place}, line {one.line}: {what} of <{one.tag}> is {written[:40]!r}, and no whole number. "
            "Write the number, or save the model again in Simulink."
        )
    return int(written)


def _word(one: XmlElement, name: str, words: Mapping[str, Word], place: str) -> Word:
    """The meaning of a word.  Raises ``ModelError`` for one that is not known."""
    written = one.property_of(name)
    if written not in words:
        known = ", ".join(word for word in words if word)
        raise ModelError(
            f"{place}, line {one.line}: {name} of <{one.tag}> is {written[:40]!r}, which is not known here; "
            f"known are {known}."
        )
    return words[written]


COMMENTED = ("isExplicitlyCommented", "isImplicitlyCommented")


def _is_commented(one: XmlElement) -> bool:
    """Whether a state, a transition or a junction is commented out, as a property of its own says."""
    if one.tag not in ("state", "transition", "junction"):
        return False
    holders = (one, *(child for child in one.children if child.tag not in ("Children", "src", "dst")))
    return any(_on(holder, name) for holder in holders for name in COMMENTED)


def _on(one: XmlElement, name: str) -> bool:
    return one.property_of(name) in ("1", "on", "true")


def _name(label: str, kind: DrawnStateKind) -> str:
    """The name of a state; of a function its whole signature stands in the label."""
    if kind == "function":
        return " ".join(label.replace("...", " ").split())
    found = _NAME.match(label)
    return found[1].strip() if found else ""


def charts_in(root: XmlElement) -> Iterator[XmlElement]:
    """The elements of charts, or of references to them, in a machine."""
    for machine in root.all("machine"):
        for children in machine.all("Children"):
            yield from children.all("chart")


__all__ = ["chart_of", "charts_in", "data_of"]
