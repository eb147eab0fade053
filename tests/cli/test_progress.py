"""The progress line: how much is done, since when, and what is under way."""

import io
from pathlib import Path

import click
import pytest
from rich.console import Console

from rovercheck.checker.cli import app, run
from rovercheck.checker.commands.shared import progress
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.progress import SearchWatch, Watch
from rovercheck.checker.commands.shared.silence import say_more, silence


def watch() -> Watch:
    made = Watch(Console(file=io.StringIO()), 5, of="graphs")
    made.say("relay PB1-11", "explicit: 20,000 states, depth 7")
    made.say("board1 PB1-15", "bmc: depth 12")
    return made


def test_the_line_tells_what_every_search_does() -> None:
    expected = (
        "0 of 5 graphs, 0 s so far | relay PB1-11: explicit: 20,000 states, depth 7 | "
        "board1 PB1-15: bmc: depth 12"
    )
    assert watch().line() == expected


def test_what_is_over_is_counted_and_no_longer_shown() -> None:
    made = watch()
    made.finished("relay PB1-11")
    assert made.line() == "1 of 5 graphs, 0 s so far | board1 PB1-15: bmc: depth 12"


@pytest.mark.parametrize("width", [20, 40, 80])
def test_on_a_terminal_every_search_has_its_share_of_the_width(width: int) -> None:
    line = watch().line(width)
    assert len(line) <= width and line.startswith("0 of 5 graphs")
    if width == 80:
        assert "relay" in line and "board1" in line


def test_a_log_gets_a_line_now_and_then(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr(progress, "monotonic", lambda: now[0])
    log = io.StringIO()
    made = Watch(Console(file=log), 2)
    for now[0] in (1.0, 9.0, 11.0, 12.0):
        made.say("relay [PB1-11]", "working")
    assert log.getvalue().splitlines() == ["0 of 2, 11 s so far | relay [PB1-11]: working"]


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
    assert log.getvalue() == "0 of 2, 11 s so far | relay: working\n"


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
    quick = {"completion", "docs", "import", "init", "list", "map"}
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


def test_a_check_counts_properties_and_says_how_long_it_will_take(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr(progress, "monotonic", lambda: now[0])
    made = SearchWatch(Console(file=io.StringIO()), 12, False, {"relay PB1-11": 100.0, "rover X": 20.0}, 2)
    made.plan(["relay PB1-11", "rover X", "new Y"])
    made.say("relay PB1-11", "bmc: depth 24, 4 goals open")
    now[0] = 40.0
    assert made.line() == (
        "0 of 12 properties, 40 s so far, about 1 min 0 s left | relay PB1-11: searching, 24 ticks deep"
    )
    made.over("relay PB1-11")
    made.counted()
    assert made.took == {"relay PB1-11": 40.0}
    assert made.line() == "1 of 12 properties, 40 s so far, about 20 s left"


def test_nothing_is_said_of_the_time_left_where_nothing_is_known_of_it() -> None:
    made = SearchWatch(Console(file=io.StringIO()), 12, False, {"other": 1.0}, 2)
    made.plan(["relay PB1-11", "rover X"])
    assert made.line() == "0 of 12 properties, 0 s so far"


def test_engines_speak_with_verbose_only() -> None:
    made = SearchWatch(Console(file=io.StringIO()), 1, False, {}, 1)
    with click.Context(click.Command("any")) as context:
        for verbose, said in ((False, "searching, 24 ticks deep"), (True, "bmc: depth 24, 4 goals open")):
            say_more(context, click.Option(["--verbose"]), verbose)
            made.say("relay PB1-11", "bmc: depth 24, 4 goals open")
            assert made.line().endswith(f"relay PB1-11: {said}")
