"""The published schemas say what commands write, and nothing more."""

from typing import Any

import pytest
from jsonschema import Draft202012Validator

from docs.reference.schemas import DOCUMENTS
from tests.schemas import FOLDER, published


def test_every_file_is_a_document_s() -> None:
    assert {file.stem for file in FOLDER.glob("*.json")} == set(DOCUMENTS)


@pytest.mark.parametrize("name", DOCUMENTS)
def test_a_schema_is_one_and_closed(name: str) -> None:
    """No record allows a key that it does not name, wherever in the document it stands."""
    schema = published(name)
    Draft202012Validator.check_schema(schema)
    records = [*schema["$defs"].values(), *([schema] if "properties" in schema else [])]
    objects = [one for one in records if one.get("type") == "object"]
    assert objects and all(one["additionalProperties"] is False for one in objects)
    assert all(one.get("description") for one in objects), "a docstring is its description"


def test_a_mistake_is_seen() -> None:
    right: dict[str, Any] = {"schema": "rovercheck/doctor/1", "ok": True, "findings": []}
    judge = Draft202012Validator(published("doctor-1"))
    wrong = [
        {**right, "ok": 1},
        {**right, "more": 1},
        {**right, "schema": "rovercheck/doctor/2"},
        {"ok": True},
    ]
    assert judge.is_valid(right) and not any(map(judge.is_valid, wrong))
