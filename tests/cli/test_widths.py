"""What narrow terminals show: words and names uncut, and commands and paths that can be copied."""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

from rovercheck.checker.cli import app
from rovercheck.checker.commands.shared.text_wrap import filled, fitted, plain, whole
from tests.cli.terminal import Terminal, WarmTerminal, piped
from tests.model_files.files import START

ROOT = Path(__file__).parents[2]
BLANKS = "a folder with blanks in its long name"


def at_terminal(columns: int, *arguments: str, stderr: int | None = None, **environment: str) -> Terminal:
    """What a terminal of so many columns has seen when the command has ended."""
    with WarmTerminal(arguments, columns, stderr=stderr, environment=environment) as terminal:
        terminal.ended()
    terminal.seen = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]", "", terminal.seen)
    return terminal


def words(text: str) -> set[str]:
    return set(text.split())


def too_long(seen: str, columns: int) -> list[str]:
    """Lines that a terminal cuts, but for commands, and for names that have a line of their own."""
    alone = re.compile(r" *(rovercheck |pytest |eval )|\s*\S+$")
    return [line for line in seen.splitlines() if len(line) > columns and not alone.match(line)]


# --- pieces that are copied whole -----------------------------------------------------------------


def test_a_piece_that_is_copied_whole_has_its_own_line_before_it_is_cut() -> None:
    command = "rovercheck graph oven --model 'a b.py'"
    text = f"It is an input of oven: {whole(command)} or nothing."
    assert plain(fitted(text, 30)) == f"It is an input of oven:\n{command}\nor nothing."
    assert fitted(text, 200) == text
    assert plain(filled(text, 62)) == f"It is an input of oven: {command}\nor nothing."
    assert plain(fitted("Of all, `rovercheck list interpretations` names some.", 24)) == (
        "Of all,\n`rovercheck list interpretations`\nnames some."
    )


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model in a folder with blanks in its name, which is beside the current one."""
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    (tmp_path / BLANKS).mkdir()
    shutil.copy(START / "heater.py", tmp_path / BLANKS)
    return Path("..") / BLANKS / "heater.py"


@pytest.mark.parametrize("columns", [40, 60, 80])
def test_a_command_in_a_message_is_one_line(own: Path, columns: int) -> None:
    state = at_terminal(columns, "graph", "On", "--model", str(own)).seen
    assert f"rovercheck graph Heater --model '{own}'" in state
    missing = at_terminal(columns, "certify", f"../{BLANKS}").seen
    assert f"../{BLANKS}" in missing and f"rovercheck check --certificates '../{BLANKS}'" in missing


@pytest.mark.parametrize("columns", [40, 60])
def test_a_path_in_a_message_is_one_line(own: Path, columns: int) -> None:
    made = at_terminal(columns, "init", f"{BLANKS} {columns}").seen
    assert f"{BLANKS} {columns}/heater.py\r\n" in made
    assert f"rovercheck check --model '{BLANKS} {columns}/heater.py'" in made
    again = at_terminal(columns, "init", f"{BLANKS} {columns}").seen
    assert f"{BLANKS} {columns}/baseline.toml" in again
    drawn = at_terminal(columns, "graph", "Heater", "--model", str(own), "-o", f"{BLANKS}.svg").seen
    assert f"{BLANKS}.svg\r\n" in drawn
    refused = at_terminal(columns, "graph", "Relay", "-o", f"{BLANKS}/of/all/relay.svg").seen
    assert f"{BLANKS}/of/all/relay.svg" in refused


def test_a_sentence_is_wrapped_before_the_command_at_its_end() -> None:
    shown = at_terminal(60, "graph", "give_b2_actuation").shown()
    assert shown[-1].startswith("rovercheck graph ")
    assert words("\n".join(shown)) == words(piped("graph", "give_b2_actuation"))


def test_what_can_be_projected_is_shown_in_whole_words() -> None:
    said = piped("graph", "relay")  # with what each variable is, where there is room
    for columns in (40, 60):
        terminal = at_terminal(columns, "graph", "relay", stderr=subprocess.DEVNULL)
        assert too_long(terminal.seen, columns) == [], columns
        assert words(terminal.seen) <= words(said), columns
        assert terminal.seen.count("--project") == said.count("--project"), columns


@pytest.mark.parametrize("columns", [40, 120])
def test_a_dumb_terminal_is_as_wide_as_it_is(columns: int) -> None:
    dumb = at_terminal(columns, "graph", "give_b2_actuation", TERM="dumb").shown()
    assert dumb == at_terminal(columns, "graph", "give_b2_actuation").shown()


def test_columns_say_how_wide_a_dumb_terminal_is_taken_for() -> None:
    narrow = at_terminal(120, "graph", "give_b2_actuation", TERM="dumb", COLUMNS="40").shown()
    assert narrow[:2] == at_terminal(40, "graph", "give_b2_actuation").shown()[:2]


@pytest.mark.parametrize("verb", ["", *app.commands])
def test_help_is_readable_at_any_width(verb: str) -> None:
    wide = said(verb, 80)
    for columns in (40, 50, 60):
        narrow = said(verb, columns)
        assert too_long(narrow, columns) == [], columns
        assert words(narrow) == words(wide), columns


def said(verb: str, columns: int) -> str:
    return CliRunner(env={"COLUMNS": str(columns)}).invoke(app, [*verb.split(), "--help"]).output


# --- lists and tables -----------------------------------------------------------------------------

LISTS = ("systems", "properties", "charts", "requirements", "repairs", "assumptions", "engines")


@pytest.mark.parametrize("what", LISTS)
def test_a_list_has_a_line_for_each_thing_in_a_pipe(what: str) -> None:
    items = json.loads(piped("list", what, "--json"))["items"]
    head, *lines = piped("list", what).splitlines()
    assert head.split()[0] in ("id", "name")
    assert [line.split()[0] for line in lines] == [item.get("id") or item["name"] for item in items]


@pytest.mark.parametrize("what", [("list", what) for what in LISTS] + [("requirements",)], ids=" ".join)
def test_a_list_is_readable_at_any_width(what: tuple[str, ...]) -> None:
    """No word is cut, nothing is left out, and no column is a letter wide."""
    said = piped(*what)
    rest = said.partition("\n")[2]  # where there are no columns, the first has no name
    letters = sum(map(len, said.split()))
    for columns in (30, 45, 60, 120):
        seen = at_terminal(columns, *what).seen
        assert too_long(seen, columns) == [], columns
        cut = {word.rstrip(":") for word in words(rest)} - {word.rstrip(":") for word in words(seen)}
        assert cut == set(), columns
        assert len(seen.splitlines()) < 5 * len(said.splitlines()) + 2 * letters / columns, columns


def test_traces_and_sessions_cut_no_name(tmp_path: Path) -> None:
    script = tmp_path / "script"
    script.write_text("why\nback 3\nstep 3\nhelp\n")
    for command in (
        ["trace", "PB1-15", "--quiet"],
        ["explore", "--trace", "PB1-15", "--script", str(script)],
    ):
        names = {w for w in words(piped(*command)) if "_" in w or "." in w}
        for columns in (30, 40):
            seen = at_terminal(columns, *command).seen
            assert too_long(seen, columns) == [], columns
            assert words(seen) >= names, columns


def test_doctor_shows_a_long_path_in_one_piece(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    place = tmp_path / "a-cache-with-so-long-a-name-that-no-line-about-it-fits-in"
    monkeypatch.setenv("ROVERCHECK_CACHE", str(place))
    assert f"{place}:" in words(at_terminal(60, "doctor").seen)


def test_doctor_is_quiet_about_what_works() -> None:
    quiet = piped("doctor", "--quiet")
    assert "✓" not in quiet and quiet.splitlines()[-1] in piped("doctor")
