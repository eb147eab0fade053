"""What stands in a model that was read, as rows of texts of which a construct can be asked."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import asdict
from typing import Any

from rovercheck.checker.drawn.records import DrawnModel

Row = Mapping[str, object]
"""A record of the document that ``import --json`` prints, with its kind as ``of``."""
Construct = Mapping[str, str]
"""A kind, as ``of``, and patterns that the texts of some fields have."""
KINDS = {
    "charts": "chart", "states": "state", "transitions": "transition", "junctions": "junction",
    "data": "datum", "events": "event", "blocks": "block", "lines": "line", "enumerations": "enumeration",
    "buses": "bus", "parameters": "parameter", "table": "table",
}  # fmt: skip
"""The kinds of records, by the names of the fields in which they stand."""


def rows_of(model: DrawnModel) -> list[Row]:
    """Every record in a model; ``text`` is each label and each script."""
    document = asdict(model)
    found = [{"of": "model", **document}, *_records(document)]
    texts = (one.get(field) for one in found for field in ("label", "script"))
    return [*found, *({"of": "text", "says": text} for text in texts if text)]


def has(rows: list[Row], construct: Construct) -> bool:
    """Whether one of the rows is of that kind, and has all those texts."""
    return any(
        all(re.search(pattern, str(row.get(field, ""))) for field, pattern in construct.items())
        for row in rows
    )


def _records(record: Mapping[str, Any]) -> Iterator[dict[str, object]]:
    for field, value in record.items():
        kind = KINDS.get(field, "")
        some = value if isinstance(value, list | tuple) else [value]
        for one in (one for one in some if isinstance(one, dict)):
            more = _ends(one) if kind == "chart" else {}
            if kind:
                yield {"of": kind, **one}
            for inner in _records(one):
                yield {**inner, **more.get(inner.get("ssid"), {})}


# --- where transitions lead --------------------------------------------------------------------------------


def _ends(chart: Mapping[str, Any]) -> dict[object, dict[str, object]]:
    """Of each transition of a chart which way it goes, and of each junction how many leave it, by SSID."""
    above: dict[int, tuple[int, ...]] = {}
    kinds: dict[int, str] = {}
    found: list[tuple[dict[str, Any], tuple[int, ...]]] = []

    def enter(content: Mapping[str, Any], path: tuple[int, ...]) -> None:
        found.extend((one, path) for one in content["transitions"])
        for one in content["junctions"]:
            above[one["ssid"]], kinds[one["ssid"]] = path, "history" if one["history"] else "junction"
        for one in content["states"]:
            above[one["ssid"]], kinds[one["ssid"]] = path, "state"
            enter(one["content"], (*path, one["ssid"]))

    enter(chart["content"], ())
    made: dict[object, dict[str, object]] = {}
    for one, path in found:
        source, target = one["source"], one["target"]
        goes, to = _way(source, target, above), kinds.get(target, "nothing")
        held = "in it" if path[-1:] == (target,) else "outside"
        made[one["ssid"]] = {"goes": goes, "from": kinds.get(source, "nothing"), "to": to, "held": held}
    junctions = [ssid for ssid, kind in kinds.items() if kind == "junction"]
    ways = {ssid: [one["target"] for one, _ in found if one["source"] == ssid] for ssid in junctions}
    for ssid in junctions:
        seen, waiting = set[int](), ways[ssid][:]
        while waiting:
            at = waiting.pop()
            waiting += [] if at in seen else ways.get(at, [])
            seen.add(at)
        made[ssid] = {"leave": len(ways[ssid]), "in_circle": ssid in seen}
    return made


def _way(source: int | None, target: int | None, above: Mapping[int, tuple[int, ...]]) -> str:
    if source is None or target is None or source not in above or target not in above:
        return "default" if source is None else "nowhere"
    if source == target:
        return "to itself"
    if source in above[target]:
        return "into itself"
    if target in above[source]:
        return "to the state around"
    return "beside" if above[source] == above[target] else "across"


__all__ = ["Construct", "Row", "has", "rows_of"]
