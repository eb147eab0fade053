"""How commands speak: results on standard output, the rest on standard error; colour for terminals alone."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator, validate

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check.run import CheckOutput, CheckRequest, check
from rovercheck.checker.commands.doctor.run import memory
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.model.variant import Variant
from rovercheck.properties.expected import Expected
from rovercheck.spec_model.rover import systems
from tests.cli.terminal import Terminal
from tests.schemas import published

COMMAND = [sys.executable, "-m", "rovercheck"]
COLOUR = re.compile(r"\x1b\[(?:\d+;)*(?:3[0-7]|9[0-7]|4[0-7]|38;[\d;]+)m")
SCHEMA: Any = published("check-1")


def piped(*arguments: str, said: str = "") -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [*COMMAND, *arguments], input=said, capture_output=True, text=True, check=False, timeout=120
    )


def at_terminal(*arguments: str, **environment: str) -> tuple[int, str]:
    with Terminal([*COMMAND, *arguments], environment=environment) as terminal:
        return terminal.ended(), terminal.seen


@pytest.mark.parametrize(
    "arguments", [("check", "PB1-11", "PB1-15"), ("explore",), ("list", "repairs"), ("doctor", "--json")]
)
def test_into_a_pipe_goes_no_control_character(arguments: tuple[str, ...]) -> None:
    done = piped(*arguments)
    assert done.returncode == Exit.AS_EXPECTED, done.stderr
    assert not re.search(r"[\x00-\x08\x0b-\x1f\x7f]", done.stdout + done.stderr)


def test_a_terminal_shows_colour_and_no_color_takes_it_away() -> None:
    coloured, plain = session(), session(NO_COLOR="1")
    assert "B1_actuating" in coloured and "B1_actuating" in plain
    assert COLOUR.search(coloured)
    assert not COLOUR.search(plain)


def session(**environment: str) -> str:
    """What a terminal shows of a step of a chart."""
    with Terminal([*COMMAND, "explore", "Relay"], environment=environment) as terminal:
        terminal.until("tick 0, 0 ms> ")
        terminal.type("step\n")
        terminal.until("tick 1, 20 ms> ")
        terminal.type("\x04")
        assert terminal.ended() == Exit.AS_EXPECTED
        return terminal.seen


def test_a_terminal_shows_progress_unless_it_is_to_be_quiet() -> None:
    code, seen = at_terminal("check", "PB1-11")
    assert code == Exit.AS_EXPECTED
    assert "so far" in seen and "PB1-11" in seen
    assert at_terminal("check", "PB1-11", "--quiet") == (Exit.AS_EXPECTED, "")


def test_quiet_says_nothing_where_all_is_as_expected(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-11", "PB1-15", "--quiet"]) is Exit.AS_EXPECTED
    assert capsys.readouterr() == ("", "")


def test_quiet_says_what_is_not_as_expected(capsys: pytest.CaptureFixture[str]) -> None:
    known, by_name = Variant({}).properties(), systems()
    asked = [known["PB1-11"], known["PB1-15"]]
    code = check(CheckRequest(asked, by_name, expected=lambda _: Expected()), CheckOutput(quiet=True))
    seen = capsys.readouterr().out
    assert code is Exit.FAILED
    assert "PB1-15" in seen and "violated" in seen and "PB1-11" not in seen


def test_json_alone_is_on_standard_output_and_follows_its_schema(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["check", "PB1-11", "PB1-15", "--json"]) is Exit.AS_EXPECTED
    seen = json.loads(capsys.readouterr().out)
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(seen)
    assert [r["id"] for r in seen["results"]] == ["PB1-11", "PB1-15"]


def test_the_schema_refuses_another_document() -> None:
    good = {
        "schema": "rovercheck/check/1", "variant": "", "complete": True, "exit": 0,
        "chains": [], "results": [],
    }  # fmt: skip
    judge = Draft202012Validator(SCHEMA)
    assert judge.is_valid(good)
    changes: list[dict[str, object]] = [
        {"schema": "rovercheck/check/2"},
        {"exit": 7},
        {"results": [{}]},
        {"more": 1},
    ]
    for change in changes:
        assert not judge.is_valid({**good, **change})


@pytest.mark.parametrize("verb", ["requirements", "doctor"])
def test_a_json_document_follows_its_schema(verb: str, capsys: pytest.CaptureFixture[str]) -> None:
    run([verb, "--json"])
    validate(json.loads(capsys.readouterr().out), published(f"{verb}-1"))


def test_a_quiet_watch_shows_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    from io import StringIO

    from rich.console import Console

    told = StringIO()
    monkeypatch.setattr("rovercheck.checker.commands.shared.progress.PAUSE", 0.0)
    for quiet in (True, False):
        with Watch(Console(file=told), 2, quiet) as watch:
            watch.say("one", "depth 3")
        assert bool(told.getvalue()) is not quiet


def test_memory_is_read_where_the_system_says_it(tmp_path: Path) -> None:
    table = tmp_path / "meminfo"
    table.write_text("MemTotal: 2048 kB\nMemAvailable:  1024 kB\n", encoding="ascii")
    assert memory(table) == (2 << 20, 1 << 20)
    table.write_text("nothing of use\n", encoding="ascii")
    assert memory(table) == memory(tmp_path / "none") == (0, 0)
