"""``rovercheck doctor``: every part is named, what is missing is told with what it adds."""

import json
import os
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import replace
from importlib.metadata import PackageNotFoundError
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker import cache
from rovercheck.checker.cli import run
from rovercheck.checker.commands.doctor import run as doctor
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.engines import Limits, engines
from rovercheck.checker.results.verdict import Unknown
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.result import Result
from rovercheck.spec_model.lang.system import System

ROOT = Path(__file__).parents[2]


def test_it_knows_every_package_that_rovercheck_requires() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert {one.partition(">")[0] for one in project["dependencies"]} == set(doctor.REQUIRED)
    optional = project["optional-dependencies"]
    asked = (one for name, some in optional.items() for one in some if name != "all")
    extras = {one.partition(">")[0].partition("[")[0] for one in asked}
    assert extras <= set(doctor.OPTIONAL)


@pytest.fixture
def untried(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(doctor, "tried", lambda engine: "")


def test_all_is_well_here_and_every_engine_was_tried(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doctor", "--json"]) is Exit.AS_EXPECTED
    seen = json.loads(capsys.readouterr().out)
    trials = {f["name"]: f for f in seen["findings"] if f["kind"] == "trial"}
    assert seen["ok"] and set(trials) == {f"engine {name}" for name in engines()}
    assert all(f["ok"] and f["found"].startswith("works") for f in trials.values())


def test_what_is_optional_and_missing_is_told_with_what_it_adds(
    untried: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("shutil.which", lambda name: None)
    assert run(["doctor"]) is Exit.AS_EXPECTED
    seen = capsys.readouterr().out
    assert "– spin" in seen and "missing; a judge of export --format promela" in seen
    assert "All that is required works." in seen
    assert max(map(len, seen.splitlines())) <= 80


def test_a_missing_requirement_is_told_and_fails(
    untried: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def without_oxidd(name: str) -> str:
        if name == "oxidd":
            raise PackageNotFoundError(name)
        return "1.0"

    monkeypatch.setattr(doctor, "version", without_oxidd)
    monkeypatch.setattr(doctor, "find_spec", lambda name: None)
    assert run(["doctor"]) is Exit.FAILED
    seen = capsys.readouterr().out
    assert "✗ oxidd" in seen and "Broken: oxidd." in seen


@pytest.mark.parametrize("raised", [ImportError("no library"), KeyError("x"), MemoryError()])
def test_an_engine_that_fails_is_told_and_fails(
    raised: Exception, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails(engine: str) -> str:
        if engine == "bdd":
            raise raised
        return "says proved of what is violated" if engine == "bmc" else ""

    monkeypatch.setattr(doctor, "tried", fails)
    assert run(["doctor"]) is Exit.FAILED
    seen = capsys.readouterr().out
    assert type(raised).__name__ in seen and "Broken: engine bdd, engine bmc." in seen


def test_a_wrong_engine_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    true, false = doctor.properties()
    assert doctor.tried("explicit") == ""
    monkeypatch.setattr(doctor, "properties", lambda: (_renamed(false, "true"), _renamed(true, "false")))
    assert "of what is violated in the third tick" in doctor.tried("explicit")


def test_an_engine_that_gives_up_on_what_is_true_is_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    assert doctor.tried("bmc") == "", "it proves nothing, and looks as deep as it was asked to"

    def giving_up(task: Task, systems: Mapping[str, System], engine: str, limits: Limits) -> Iterator[Result]:
        for found in decide(task, systems, engine, limits):
            unknown = Unknown("no more time", 7, "bmc")
            yield replace(found, verdict=unknown) if found.property.id == "true" else found

    monkeypatch.setattr("rovercheck.checker.verify.decide.decide", giving_up)
    assert doctor.tried("bmc") == "says unknown of what is true"


def _renamed(prop: object, id: str) -> object:
    return replace(prop, id=id)  # type: ignore[type-var]


def test_a_cache_that_is_switched_off_is_no_fault(
    untried: None, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROVERCHECK_CACHE", "")
    run(["doctor", "--json"])
    [found] = [f for f in json.loads(capsys.readouterr().out)["findings"] if f["name"] == "cache"]
    assert found["ok"] and "switched off" in found["found"]


@pytest.mark.skipif(not hasattr(os, "getuid"), reason="there are no modes of files to look at")
@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        ("", ""),
        ("cache", "not used: Others may write to the folder {cache}: chmod go-w {cache}"),
        (
            "secret",
            "not used: The secret of the cache, {secret}, can be read or written by others: delete it",
        ),
        ("inside", "not used: The secret of the cache, {inside}, would be inside the cache"),
    ],
)
def test_where_the_cache_and_its_secret_are_and_why_they_are_not_used(
    spoil: str,
    said: str,
    untried: None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    places = {name: tmp_path / name for name in ("cache", "secret")} | {"inside": tmp_path / "cache" / "x"}
    monkeypatch.setenv(cache.VARIABLE, str(places["cache"]))
    monkeypatch.setenv(cache.SECRET, str(places["secret"]))
    assert shown(capsys)["ok"], "neither is made yet"
    assert not any(tmp_path.iterdir())
    cache.write("key", b"code")
    match spoil:
        case "cache" | "secret":
            places[spoil].chmod(0o777)
        case "inside":
            monkeypatch.setenv(cache.SECRET, str(places["inside"]))
    found = shown(capsys)
    assert found["ok"] == (not spoil) and not found["required"]
    assert f"{places['cache']}: 1 file, 0.0 MiB; sealed with {tmp_path}" in found["found"]
    assert said.format(**places) in found["found"]


def shown(capsys: pytest.CaptureFixture[str]) -> dict[str, Any]:
    """What is said of the cache."""
    capsys.readouterr()
    run(["doctor", "--json"])
    [found] = [f for f in json.loads(capsys.readouterr().out)["findings"] if f["name"] == "cache"]
    assert isinstance(found, dict)
    return found


@pytest.mark.parametrize(
    ("variables", "said"),
    [
        ({}, "2 entries, 0.0 MiB"),
        ({"ROVERCHECK_STORE": ""}, "none: $ROVERCHECK_STORE is empty"),
        ({"ROVERCHECK_CACHE": ""}, "none: there is no cache"),
    ],
)
def test_whether_verdicts_are_kept_and_how_many(
    variables: Mapping[str, str],
    said: str,
    untried: None,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path / "cache"))
    monkeypatch.setenv(cache.SECRET, str(tmp_path / "secret"))
    monkeypatch.delenv("ROVERCHECK_STORE", raising=False)
    for name in ("a-verdict-json", "b-verdict-json", "c-search-quick"):
        cache.write(name, b"{}")
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    assert run(["doctor", "--json"]) is Exit.AS_EXPECTED
    rows = json.loads(capsys.readouterr().out)["findings"]
    [found] = [row for row in rows if row["name"] == "verdicts kept"]
    assert found["ok"] and found["found"] == said
