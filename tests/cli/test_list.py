"""``rovercheck list --json``: every list follows its schema and has all that there is."""

import json
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.cli import run
from rovercheck.checker.commands.list import LISTS
from rovercheck.checker.commands.list.run import formats
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.engines import engines
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.requirements import requirements
from rovercheck.spec_model.ambiguity import ambiguities
from rovercheck.spec_model.repairs import proposals
from rovercheck.spec_model.rover import systems
from tests.model_files.files import START
from tests.schemas import published

SCHEMA: Any = published("list-1")
JUDGE = Draft202012Validator(SCHEMA)


OLDER = {"interpretations": "readings"}
"""What version 1 of the document calls a list by an older name."""


def listed(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[Any]:
    """The items of a list that follows the schema."""
    assert run(["list", *arguments, "--json"]) is Exit.AS_EXPECTED
    seen = json.loads(capsys.readouterr().out)
    assert [f"{e.json_path}: {e.message}" for e in JUDGE.iter_errors(seen)] == []
    assert seen["what"] == OLDER.get(arguments[0], arguments[0])
    items: list[Any] = seen["items"]
    return items


ALL = [
    ("properties", catalogue()),
    ("systems", systems()),
    ("requirements", requirements()),
    ("interpretations", ambiguities()),
    ("repairs", proposals()),
    ("engines", (*engines(), "auto", "all")),
    ("formats", {one.name for one in formats()}),
    ("charts", {chart.name for system in systems().values() for chart in system.charts}),
    ("assumptions", {one.id for system in systems().values() for one in system.assumptions}),
]


def test_the_schema_is_one_and_every_list_is_tested() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert {what for what, _ in ALL} == set(LISTS)
    kinds = [SCHEMA["$defs"][one["$ref"].rpartition("/")[2]]["properties"]["what"] for one in SCHEMA["anyOf"]]
    assert sorted(kind["const"] for kind in kinds) == sorted(OLDER.get(what, what) for what in LISTS)


@pytest.mark.parametrize(("what", "names"), ALL, ids=[what for what, _ in ALL])
def test_a_list_has_all_there_is(what: str, names: Any, capsys: pytest.CaptureFixture[str]) -> None:
    items = listed(capsys, what)
    assert {item.get("id") or item["name"] for item in items} == set(names)


def test_a_property_is_told_with_its_verdict_on_record(capsys: pytest.CaptureFixture[str]) -> None:
    [one] = listed(capsys, "properties", "PB1-15")
    assert (one["system"], one["expected"]) == ("relay", "violated")
    assert one["formally"][0].startswith("Formally: ") and one["because"].startswith("The transition")
    assert one["place"]["file"] == "properties/areas/relay.py"


def test_lists_of_a_model_of_ones_own(capsys: pytest.CaptureFixture[str]) -> None:
    model = ("--model", str(START / "heater.py"))
    assert [p["id"] for p in listed(capsys, "properties", *model)] == ["HEAT-1", "HEAT-2", "HEAT-3"]
    assert [c["name"] for c in listed(capsys, "charts", *model)] == ["Heater"]
    assert run(["list", "repairs", "--json", *model]) is Exit.USAGE


def test_the_schema_refuses_another_list() -> None:
    good = {"schema": "rovercheck/list/1", "what": "charts", "items": []}
    item = {"name": "A", "text": "", "states": 1, "arrows": 0}
    assert JUDGE.is_valid(good) and JUDGE.is_valid({**good, "items": [item]})
    changes: list[dict[str, object]] = [
        {"schema": "rovercheck/list/2"},
        {"what": "engines", "items": [item]},
        {"items": [{**item, "states": -1}]},
        {"more": 1},
    ]
    for change in changes:
        assert not JUDGE.is_valid({**good, **change})
