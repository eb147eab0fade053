"""Runs that show cases: the file beside the baseline, and what is recorded of the rover."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.model.kept_runs import PREMISES, KeptRun, file_of, read, text
from rovercheck.checker.model.kept_runs import SCHEMA as SCHEMAS
from rovercheck.checker.model.rover import rover
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.runs.known_runs import reached
from rovercheck.checker.verify.runs.replay import replay
from rovercheck.properties.premise import premise
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.errors import ModelError

SCHEMA = SCHEMAS.format(PREMISES)
LONG = 500
"""Ticks; longer runs are gone through on the lowered system alone, which takes a sixth of the time."""


def test_a_run_is_read_as_it_was_written(tmp_path: Path) -> None:
    held = [{"a": 1, "b": 0}] * 3
    runs = {
        "P-2": KeptRun("hall", Run({"c": 4}, (*held, {"a": 1, "b": 7}))),
        "P-1": KeptRun("x", Run({}, ({},))),
    }
    file = tmp_path / "premises.json"
    file.write_text(text(runs), encoding="utf-8")
    assert read(file) == runs
    assert json.loads(text(runs))["runs"]["P-2"]["blocks"] == [[3, {"a": 1, "b": 0}], [1, {"b": 7}]]


def test_no_file_is_no_run(tmp_path: Path) -> None:
    assert read(tmp_path / "premises.json") == {}


@pytest.mark.parametrize(
    ("written", "said"),
    [
        ("", "Expecting value"),
        ("[]", "holds no runs"),
        ('{"schema": "rovercheck/check/1", "runs": {}}', "its schema is 'rovercheck/check/1'"),
        (f'{{"schema": "{SCHEMA}"}}', "KeyError: 'runs'"),
        (
            f'{{"schema": "{SCHEMA}", "runs": {{"A": {{"system": "x", "frozen": {{}}}}}}}}',
            "KeyError: 'blocks'",
        ),
        (
            f'{{"schema": "{SCHEMA}", "runs": {{"A": {{"system": "x", "frozen": {{}}, '
            '"blocks": [[1000000000000, {}]]}}}',
            "more than 1,000,000 in all",
        ),
        (
            f'{{"schema": "{SCHEMA}", "runs": {{"A": {{"system": "x", "frozen": {{"n": "far"}}, '
            '"blocks": []}}}',
            "n is 'far', no whole number",
        ),
        ("[" * 100_000, "holds no runs"),
    ],
)
def test_a_file_with_something_else_is_told(tmp_path: Path, written: str, said: str) -> None:
    file = tmp_path / "premises.json"
    file.write_text(written, encoding="utf-8")
    with pytest.raises(ModelError, match="check --record-premises") as error:
        read(file)
    assert said in str(error.value)


@pytest.mark.long
def test_every_proof_about_a_case_has_a_run_that_shows_it() -> None:
    """What has none makes `check` search: record it anew, or restate a property that speaks of nothing."""
    model = rover()
    proved = [p for p in model.properties.values() if model.expected(p.id).verdict == "proved"]
    cases = {p.id: case for p in proved if (case := premise(p)) is not None}
    runs = read(file_of(model))
    assert cases.keys() - runs.keys() == set()
    for id, case in cases.items():
        kept = runs[id]
        system = model.systems[kept.system]
        asked = replace(case, on=system.name)
        assert id in reached(system, [asked], [kept.run])
        if len(kept.run) < LONG:
            question = reduce(lowered(system), [asked])
            assert len(replay(question.system, question.goals[0], kept.run)) == len(kept.run)
