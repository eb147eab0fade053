"""``rovercheck list --json``: what there is, for machines; ``checker/schemas/list-1.json`` describes it."""

from collections.abc import Callable, Mapping, Sequence

from rovercheck.checker.commands.shared.property_text import formally
from rovercheck.checker.engines import ALL, AUTO, engines
from rovercheck.checker.model import Model
from rovercheck.properties.forms import Property
from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.lang.chart import Chart
from rovercheck.spec_model.lang.system import System
from rovercheck.spec_model.repairs import proposals

Item = Mapping[str, object]
SCHEMA = 1
IN_SCHEMA = {"interpretations": "readings"}
"""What version 1 of the document calls a list by an older name."""


def document(what: str, chosen: Sequence[Property], model: Model | None) -> Item:
    """One of the lists; ``chosen`` are the properties if it is theirs.

    ``model`` is None for a list that is the same whatever is checked.
    """
    items = ITEMS[what]() if model is None else _of(model, what, chosen)
    return {"schema": f"rovercheck/list/{SCHEMA}", "what": IN_SCHEMA.get(what, what), "items": items}


def _of(model: Model, what: str, chosen: Sequence[Property]) -> list[Item]:
    return [_property(p, model) for p in chosen] if what == "properties" else OF_MODEL[what](model)


def _property(prop: Property, model: Model) -> Item:
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
        "place": {"file": prop.place.path, "line": prop.place.line} if prop.place else None,
    }


def _systems(model: Model) -> list[Item]:
    return [_system(system) for system in model.systems.values()]


def _system(system: System) -> Item:
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


def _charts(model: Model) -> list[Item]:
    return [_chart(chart) for chart in model.charts.values()]


def _chart(chart: Chart) -> Item:
    return {
        "name": chart.name,
        "text": chart.text,
        "states": len(chart.states) - 1,  # without the chart itself
        "arrows": len(chart.transitions),
    }


def _requirements(model: Model) -> list[Item]:
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


def _assumptions(model: Model) -> list[Item]:
    holders: dict[tuple[str, str], list[str]] = {}
    for system in model.systems.values():
        for one in system.assumptions:
            holders.setdefault((one.id, one.text), []).append(system.name)
    return [{"id": id, "text": text, "systems": names} for (id, text), names in holders.items()]


def _interpretations() -> list[Item]:
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


def _repairs() -> list[Item]:
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


def _engines() -> list[Item]:
    """The engines, and the names that stand for several of them."""
    single: list[Item] = [
        {"name": e.NAME, "text": e.SUMMARY, "engines": [e.NAME]} for e in engines().values()
    ]
    names = list(engines())
    return [
        *single,
        {"name": AUTO, "text": "engines in turn; the first conclusive answer counts", "engines": names},
        {"name": ALL, "text": "every engine, and their answers are compared", "engines": names},
    ]


def _formats() -> list[Item]:
    from rovercheck.checker.commands.list.run import formats

    return [
        {"name": f.name, "of": f.kind, "suffix": f.suffix, "text": f.summary, "needs": sorted(f.needs)}
        for f in formats()
    ]


OF_MODEL: Mapping[str, Callable[[Model], list[Item]]] = {
    "systems": _systems,
    "charts": _charts,
    "requirements": _requirements,
    "assumptions": _assumptions,
}
ITEMS: Mapping[str, Callable[[], list[Item]]] = {
    "interpretations": _interpretations,
    "repairs": _repairs,
    "engines": _engines,
    "formats": _formats,
}
