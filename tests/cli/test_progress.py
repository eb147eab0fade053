"""The progress line: how many searches are done, and what each of the others does."""

import io
from pathlib import Path

import click
import pytest
from rich.console import Console

from rovercheck.checker.cli import app, run
from rovercheck.checker.commands.shared import progress
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.progress import Watch
from rovercheck.checker.commands.shared.silence import silence


def watch() -> Watch:
    made = Watch(Console(file=io.StringIO()), 5)
    made.say("relay PB1-11", "explicit: 20,000 states, depth 7")
    made.say("board1 PB1-15", "bmc: depth 12")
    return made


def test_the_line_tells_what_every_search_does() -> None:
    expected = (
        "0/5 searches done | relay PB1-11: explicit: 20,000 states, depth 7 | board1 PB1-15: bmc: depth 12"
    )
    assert watch().line() == expected


def test_what_is_over_is_counted_and_no_longer_shown() -> None:
    made = watch()
    made.finished("relay PB1-11")
    assert made.line() == "1/5 searches done | board1 PB1-15: bmc: depth 12"


@pytest.mark.parametrize("width", [20, 40, 80])
def test_on_a_terminal_every_search_has_its_share_of_the_width(width: int) -> None:
    line = watch().line(width)
    assert len(line) <= width and line.startswith("0/5 searches done")
    if width == 80:
        assert "relay" in line and "board1" in line


def test_a_log_gets_a_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr(progress, "monotonic", lambda: now[0])
    log = io.StringIO()
    made = Watch(Console(file=log), 2)
    for now[0] in (1.0, 9.0, 11.0, 12.0):
        made.say("relay [PB1-11]", "working")
    assert log.getvalue().splitlines() == ["0/2 searches done | relay [PB1-11]: working"]


class Dumb(io.StringIO):
    """A terminal that cannot write over a line."""

    def isatty(self) -> bool:
        return True


def test_a_dumb_terminal_is_a_log(monkeypatch: pytest.MonkeyPatch) -> None:
    now, log = [0.0], Dumb()
    monkeypatch.setattr(progress, "monotonic", lambda: now[0])
    with Watch(Console(file=log, _environ={"TERM": "dumb"}), 2) as made:
        now[0] = 11.0
        made.say("relay", "working")
    assert log.getvalue() == "0/2 searches done | relay: working\n"


@pytest.mark.parametrize("quiet", [False, True])
def test_with_quiet_nothing_is_said_meanwhile(quiet: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    now, log = [0.0], io.StringIO()
    monkeypatch.setattr(progress, "monotonic", lambda: now[0])
    with click.Context(click.Command("any")) as context:
        silence(context, click.Option(["--quiet"]), quiet)
        made = Watch(Console(file=log), 1)
        now[0] = 11.0
        made.say("relay", "working")
    assert bool(log.getvalue()) is not quiet


def test_every_verb_that_takes_its_time_can_be_quiet() -> None:
    quick = {"completion", "init", "list"}
    able = {name for name, verb in app.commands.items() for p in verb.params if "--quiet" in p.opts}
    assert able == app.commands.keys() - quick


def test_a_file_that_is_written_is_named_unless_nobody_wants_to_know(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / "relay.svg"
    for words, said in (([], f"wrote {target}\n"), (["--quiet"], "")):
        assert run(["graph", "Relay", "-o", str(target), *words]) is Exit.AS_EXPECTED
        seen = capsys.readouterr()
        assert (seen.out, seen.err) == ("", said)
