"""``rovercheck list --json``: what there is, for machines; ``checker/schemas/list-1.json`` describes it."""

from collections.abc import Sequence
from typing import Final, Generic, Literal, TypeVar

from typing_extensions import TypedDict

from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.checker.engines import ALL, AUTO, engines
from rovercheck.checker.io.document import Count, Ordinal, PlaceRow, Text, place_row
from rovercheck.checker.model import Model
from rovercheck.checker.results.format import Kind, Need
from rovercheck.properties.expected import VerdictWord
from rovercheck.properties.forms import Property
from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.repairs import proposals

SCHEMA: Final = "rovercheck/list/1"


class PropertyRow(TypedDict):
    """A property."""

    id: Text
    text: str
    formally: list[str]
    """What is checked, in words: the sentence, then each formula that it names."""
    system: str
    """The system that it is about."""
    area: str
    requirements: list[str]
    readings: list[str]
    """Interpretations under which it is stated."""
    costly: bool
    """Decided only with --full."""
    expected: VerdictWord
    """The verdict on record."""
    because: str
    """The reason on record, if it is no proof."""
    place: PlaceRow | None
    """Where it is written, if that is known."""


class SystemRow(TypedDict):
    """A system."""

    name: Text
    text: str
    notes: list[str]
    charts: list[str]
    blocks: list[str]
    tick_ms: Ordinal
    more_runs: bool
    """It has runs that the specification does not have."""
    fewer_runs: bool
    """It lacks some runs of the specification."""
    assumptions: list[str]
    """Ids of what is assumed of its environment."""


class ChartRow(TypedDict):
    """A chart."""

    name: Text
    text: str
    states: Count
    arrows: Count
    """Its transitions."""


class RequirementItem(TypedDict):
    """A requirement."""

    id: Text
    text: str
    source: str
    checkable: str
    reason: str
    """Why no property covers it."""
    properties: list[str]
    """Ids of those that cover it."""


class AssumptionRow(TypedDict):
    """An assumption, and the systems that make it."""

    id: Text
    text: str
    systems: list[str]


class InterpretationItem(TypedDict):
    """A sentence of the document with several meanings."""

    id: Text
    about: str
    says: str
    choices: dict[str, str]
    """Each choice, and what it means."""
    default: str
    not_modelled: dict[str, str]
    """Choices that the charts cannot show, and why."""
    scenario: str
    """What tells the choices apart."""
    because: str
    """Why the default is the default."""


class RepairRow(TypedDict):
    """A repair."""

    name: Text
    text: str
    fixes: list[str]
    """Ids of properties that hold with it."""
    gives_up: dict[str, str]
    """Ids of properties that no longer hold, and why."""
    changes: list[str]
    """Charts and blocks."""
    readings: dict[str, str]
    """Interpretations taken instead of the default."""


class EngineRow(TypedDict):
    """An engine, or a name that stands for several."""

    name: Text
    text: str
    engines: list[str]
    """The engines that the name stands for."""


class FormatRow(TypedDict):
    """A format of output."""

    name: Text
    of: Kind
    suffix: str
    """What the names of its files end with."""
    text: str
    needs: list[Need]
    """What is worked out before anything is written: the run as the boards see it, a run to every state."""


What = TypeVar("What")
Row = TypeVar("Row")


class ListOf(TypedDict, Generic[What, Row]):
    """What ``rovercheck list WHAT --json`` prints."""

    schema: Literal["rovercheck/list/1"]
    what: What
    items: list[Row]


PropertyList = ListOf[Literal["properties"], PropertyRow]
SystemList = ListOf[Literal["systems"], SystemRow]
ChartList = ListOf[Literal["charts"], ChartRow]
RequirementList = ListOf[Literal["requirements"], RequirementItem]
AssumptionList = ListOf[Literal["assumptions"], AssumptionRow]
InterpretationList = ListOf[Literal["readings"], InterpretationItem]
RepairList = ListOf[Literal["repairs"], RepairRow]
EngineList = ListOf[Literal["engines"], EngineRow]
FormatList = ListOf[Literal["formats"], FormatRow]

ListDocument = (
    PropertyList
    | SystemList
    | ChartList
    | RequirementList
    | AssumptionList
    | InterpretationList
    | RepairList
    | EngineList
    | FormatList
)
"""What ``rovercheck list WHAT --json`` prints."""


def document(what: str, chosen: Sequence[Property], model: Model | None) -> ListDocument:
    """One of the lists; ``chosen`` are the properties if it is theirs.

    ``model`` is None for a list that is the same whatever is checked.  Raises ``KeyError`` for other names.
    """
    return _general(what) if model is None else _of(model, what, chosen)


def _general(what: str) -> ListDocument:
    match what:
        case "interpretations":  # by an older name in version 1 of the document
            return InterpretationList(schema=SCHEMA, what="readings", items=_interpretations())
        case "repairs":
            return RepairList(schema=SCHEMA, what="repairs", items=_repairs())
        case "engines":
            return EngineList(schema=SCHEMA, what="engines", items=_engines())
        case "formats":
            return FormatList(schema=SCHEMA, what="formats", items=_formats())
    raise KeyError(what)


def _of(model: Model, what: str, chosen: Sequence[Property]) -> ListDocument:
    match what:
        case "properties":
            return PropertyList(schema=SCHEMA, what="properties", items=[_property(p, model) for p in chosen])
        case "systems":
            return SystemList(schema=SCHEMA, what="systems", items=_systems(model))
        case "charts":
            return ChartList(schema=SCHEMA, what="charts", items=_charts(model))
        case "requirements":
            return RequirementList(schema=SCHEMA, what="requirements", items=_requirements(model))
        case "assumptions":
            return AssumptionList(schema=SCHEMA, what="assumptions", items=_assumptions(model))
    raise KeyError(what)


def _property(prop: Property, model: Model) -> PropertyRow:
    on_record = model.expected(prop.id)
    return {
        "id": prop.id,
        "text": prop.text,
        "formally": list(formally(prop, model.systems[prop.on])),
        "system": prop.on,
        "area": prop.area,
        "requirements": list(prop.covers),
        "readings": list(prop.interpretations),
        "costly": prop.costly,
        "expected": on_record.verdict,
        "because": on_record.because,
        "place": place_row(prop.place),
    }


def _systems(model: Model) -> list[SystemRow]:
    return [_system(system) for system in model.systems.values()]


def _system(system: System) -> SystemRow:
    return {
        "name": system.name,
        "text": system.text,
        "notes": list(system.notes),
        "charts": [chart.name for chart in system.charts],
        "blocks": [block.name for block in system.blocks],
        "tick_ms": system.tick_ms,
        "more_runs": system.over,
        "fewer_runs": system.under,
        "assumptions": [one.id for one in system.assumptions],
    }


def _charts(model: Model) -> list[ChartRow]:
    return [_chart(chart) for chart in model.charts.values()]


def _chart(chart: Chart) -> ChartRow:
    return {
        "name": chart.name,
        "text": chart.text,
        "states": len(chart.states) - 1,  # without the chart itself
        "arrows": len(chart.transitions),
    }


def _requirements(model: Model) -> list[RequirementItem]:
    covering: dict[str, list[str]] = {}
    for prop in model.properties.values():
        for id in prop.covers:
            covering.setdefault(id, []).append(prop.id)
    return [
        {
            "id": one.id,
            "text": one.text,
            "source": one.source,
            "checkable": one.checkable,
            "reason": one.reason,
            "properties": covering.get(one.id, []),
        }
        for one in model.requirements.values()
    ]


def _assumptions(model: Model) -> list[AssumptionRow]:
    holders: dict[tuple[str, str], list[str]] = {}
    for system in model.systems.values():
        for one in system.assumptions:
            holders.setdefault((one.id, one.text), []).append(system.name)
    return [{"id": id, "text": text, "systems": names} for (id, text), names in holders.items()]


def _interpretations() -> list[InterpretationItem]:
    return [
        {
            "id": one.id,
            "about": one.about,
            "says": one.says,
            "choices": dict(one.choices),
            "default": one.default,
            "not_modelled": dict(one.not_modelled),
            "scenario": one.scenario,
            "because": one.because,
        }
        for one in ambiguities().values()
    ]


def _repairs() -> list[RepairRow]:
    return [
        {
            "name": one.name,
            "text": one.text,
            "fixes": list(one.fixes),
            "gives_up": dict(one.gives_up),
            "changes": [*one.charts, *one.blocks],
            "readings": dict(one.interpretations),
        }
        for one in proposals().values()
    ]


def _engines() -> list[EngineRow]:
    """The engines, and the names that stand for several of them."""
    single: list[EngineRow] = [
        {"name": e.NAME, "text": e.SUMMARY, "engines": [e.NAME]} for e in engines().values()
    ]
    names = list(engines())
    return [
        *single,
        {"name": AUTO, "text": "engines in turn; the first conclusive answer counts", "engines": names},
        {"name": ALL, "text": "every engine, and their answers are compared", "engines": names},
    ]


def _formats() -> list[FormatRow]:
    from rovercheck.checker.commands.list.run import formats

    return [
        {"name": f.name, "of": f.kind, "suffix": f.suffix, "text": f.summary, "needs": sorted(f.needs)}
        for f in formats()
    ]


__all__ = ["document"]
