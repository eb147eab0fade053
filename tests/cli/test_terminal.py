"""What people see on a real terminal: results above the progress line, whole words, a clean end."""

import os
import pty
import re
import signal
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

from rovercheck.checker.commands.shared.codes import Exit
from tests.cli import conversation
from tests.cli.conversation import COMMANDS, MARK
from tests.cli.terminal import PATIENCE, Terminal

ROOT = Path(__file__).parents[2]
LIFT = ROOT / "examples/models/lift"
TALK = [sys.executable, "-m", conversation.__name__]
CHECK = [sys.executable, "-m", "rovercheck", "check", "--model", str(LIFT)]
SPINNER = re.compile(r"[\u2800-\u28ff]")
MOVES = re.compile(r"\x1b\[[0-9;?]*[A-GHJKhl]")
"""Whatever moves the cursor, erases or changes the terminal."""
COLOUR = re.compile(r"\x1b\[(?:\d+;)*(?:3[0-7]|9[0-7])m")
SAID = {
    "check": "so far",
    "trace": "so far",
    "requirements": "so far",
    "report": "so far",
    "certify": "file checked",
    "graph": "so far",
    "reports": "so far",
    "compare": "deviations",
    "check-log": "2 of 2 logs: good.csv",
    "simulate": " of 16 s",
    "generate-tests": "goals decided",
    "explore": "so far",
}
"""What the progress line of each verb says last."""


def parts(lines: list[str]) -> list[list[str]]:
    """What is shown of each command; the marks, which begin their lines, and the exit codes are checked."""
    at = [n for n, line in enumerate(lines) if line.startswith(MARK)]
    assert [lines[n].split()[1] for n in at[::2]] == [c.split()[0] for c in COMMANDS]
    assert {lines[n].split()[1] for n in at[1::2]} <= {"0", "1"}
    return [lines[a + 1 : b] for a, b in list(pairwise(at))[::2]]


def words(lines: list[str]) -> set[str]:
    return {word for line in lines for word in line.split()}


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Compiled searches, which all commands here share."""
    return str(tmp_path_factory.mktemp("cache"))


@pytest.mark.long
def test_every_verb_shows_at_any_width_what_it_says_into_a_pipe(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, cache: str
) -> None:
    """Nothing is glued to the progress line, no word is cut, and nothing is left of the line."""
    known = {"PYTHONPATH": str(ROOT), "ROVERCHECK_CACHE": cache, "ROVERCHECK_STORE": ""}
    folders = [tmp_path / name for name in ("pipe", "60", "120")]
    for folder in folders:
        folder.mkdir()
        (folder / "examples").symlink_to(ROOT / "examples")
        (folder / "lift").symlink_to(LIFT)
    piped = subprocess.run(
        TALK, cwd=folders[0], env={**os.environ, **known}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, check=True, timeout=300,
    ).stdout  # fmt: skip
    for folder in folders[1:]:
        monkeypatch.chdir(folder)
        with Terminal(TALK, int(folder.name), environment=known) as terminal:
            assert terminal.ended() == 0
        assert terminal.clean
        live = terminal.seen.split(MARK)[1::2]
        for command, shown, said, raw in zip(
            COMMANDS, parts(terminal.shown()), parts(piped.splitlines()), live, strict=True
        ):
            at = f"{command}, {folder.name} columns"
            assert SAID[command.split()[0]] in raw, f"{at}: no progress is shown"
            assert not [line for line in shown if SPINNER.search(line) or "so far" in line], at
            assert words(shown) == words(said), at


# --- where results and messages go ----------------------------------------------------------------


def summary_of(text: str) -> str:
    """What a check of the lift prints, its verdicts in order."""
    return "\n".join(sorted(line for line in text.splitlines() if line))


@pytest.fixture(scope="module")
def lift() -> str:
    """What a check of the lift prints into a pipe."""
    done = subprocess.run(CHECK, capture_output=True, text=True, check=True, timeout=PATIENCE)
    assert done.stderr == ""
    return summary_of(done.stdout)


def test_results_go_into_a_file_and_progress_to_the_terminal(lift: str, tmp_path: Path) -> None:
    with (tmp_path / "results").open("w+") as file:
        with Terminal(CHECK, stdout=file.fileno()) as terminal:
            assert terminal.ended() == Exit.AS_EXPECTED
        file.seek(0)
        assert summary_of(file.read()) == lift
    assert "so far" in terminal.seen and terminal.shown() == [""] and terminal.clean


def test_results_go_to_the_terminal_and_messages_into_a_file(lift: str, tmp_path: Path) -> None:
    with (tmp_path / "messages").open("w+") as file:
        with Terminal(CHECK, stderr=file.fileno()) as terminal:
            assert terminal.ended() == Exit.AS_EXPECTED
        file.seek(0)
        assert file.read() == ""
    assert summary_of("\n".join(terminal.shown())) == lift
    assert not MOVES.search(terminal.seen)


def test_both_go_into_one_file_in_order(lift: str, tmp_path: Path) -> None:
    with (tmp_path / "all").open("w+") as file:
        subprocess.run(CHECK, stdout=file, stderr=subprocess.STDOUT, check=True, timeout=PATIENCE)
        file.seek(0)
        assert summary_of(file.read()) == lift


def test_results_may_name_the_terminal_otherwise(lift: str) -> None:
    """``rovercheck check > /dev/tty``: it is the same terminal."""
    command = ["sh", "-c", f"{' '.join(CHECK)} > /dev/tty"]
    with Terminal(command) as terminal:
        assert terminal.ended() == Exit.AS_EXPECTED
    assert "so far" in terminal.seen
    assert summary_of("\n".join(terminal.shown())) == lift


def test_a_second_terminal_gets_results_alone(lift: str) -> None:
    ours, theirs = pty.openpty()
    with Terminal(CHECK, stdout=theirs) as terminal:
        assert terminal.ended() == Exit.AS_EXPECTED
    os.close(theirs)
    read = b""
    while (more := _read(ours)) != b"":
        read += more
    os.close(ours)
    assert "so far" in terminal.seen and terminal.shown() == [""]
    assert not MOVES.search(read.decode()) and summary_of(read.decode().replace("\r", "")) == lift


def _read(end: int) -> bytes:
    try:
        return os.read(end, 4096)
    except OSError:  # the other end is closed
        return b""


def test_colours_that_are_forced_move_no_cursor_in_a_pipe() -> None:
    done = subprocess.run(
        CHECK, env={**os.environ, "FORCE_COLOR": "1"}, capture_output=True, text=True, check=True,
        timeout=PATIENCE,
    )  # fmt: skip
    assert not MOVES.search(done.stdout + done.stderr)


@pytest.mark.parametrize("value", ["dumb", "unknown"])
def test_a_dumb_terminal_gets_plain_lines(lift: str, value: str) -> None:
    with Terminal(CHECK, environment={"TERM": value}) as terminal:
        assert terminal.ended() == Exit.AS_EXPECTED
    assert "\x1b" not in terminal.seen
    assert summary_of("\n".join(terminal.shown())) == lift


def test_no_color_leaves_the_progress_line() -> None:
    with Terminal(CHECK, environment={"NO_COLOR": "1"}) as terminal:
        assert terminal.ended() == Exit.AS_EXPECTED
    assert "so far" in terminal.seen and not COLOUR.search(terminal.seen)


# --- the end, however it comes --------------------------------------------------------------------

LONG = [
    sys.executable,
    "-m",
    "rovercheck",
    "check",
    "PSY-17b",
    "REACH-B2-TURN",
    "--engine",
    "explicit",
    "--full",
]
RAISING = f"""
import sys
from rovercheck.checker.cli import main
from rovercheck.checker.commands.check import run as check, text
def broken(compared): raise {{error}}
text.line = broken
sys.argv[1:] = {CHECK[3:]}
main()
"""


def test_ctrl_c_leaves_the_screen_clean() -> None:
    with Terminal(LONG) as terminal:
        terminal.until("so far")
        terminal.type("\x03")
        assert terminal.ended() == Exit.INTERRUPTED
    assert terminal.clean
    assert terminal.shown()[-1].startswith("Interrupted: ")
    assert not SPINNER.search("".join(terminal.shown()))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_signal_leaves_the_screen_clean(number: signal.Signals) -> None:
    with Terminal(LONG) as terminal:
        terminal.until("so far")
        terminal.send(number)
        assert terminal.ended() == Exit.INTERRUPTED
    assert terminal.clean
    assert terminal.shown()[-1].startswith("Interrupted: ")
    assert not SPINNER.search("".join(terminal.shown()))


def test_a_program_that_is_killed_or_stopped_has_hidden_no_cursor() -> None:
    with Terminal(LONG) as terminal:
        terminal.until("so far")
        terminal.send(signal.SIGKILL)
        assert terminal.ended() == -signal.SIGKILL
    assert not terminal.cursor_hidden


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        ("RuntimeError('nothing')", Exit.INTERNAL, "Internal error: RuntimeError: nothing."),
        ("MemoryError", Exit.INCONCLUSIVE, "Out of memory."),
        ("KeyboardInterrupt", Exit.INTERRUPTED, "Interrupted: 1 of 4 properties decided."),
    ],
)
def test_an_error_in_the_middle_leaves_the_screen_clean(error: str, code: Exit, said: str) -> None:
    """While a result is printed, too: the progress line is gone before the message comes."""
    with Terminal([sys.executable, "-c", RAISING.format(error=error)]) as terminal:
        assert terminal.ended() == code
    assert terminal.clean and terminal.shown()[0].startswith(said)
    assert not SPINNER.search("".join(terminal.shown()))


def test_what_was_decided_is_a_document_in_its_file_when_a_result_is_interrupted(tmp_path: Path) -> None:
    """And not on the terminal, where the progress line was."""
    program = RAISING.format(error="KeyboardInterrupt").replace(
        "text.line = broken", "check.CheckedProperty = broken"
    )
    program = program.replace("def broken(compared)", "def broken(*_)").replace(
        "'check',", "'check', '--json',"
    )
    with (tmp_path / "out.json").open("w+") as file:
        with Terminal([sys.executable, "-c", program], stdout=file.fileno()) as terminal:
            terminal.ended()
        file.seek(0)
        assert file.read().startswith("{")
    assert "{" not in terminal.seen


def test_a_letter_that_comes_in_two_pieces_is_seen_whole() -> None:
    pieces = "import os, time; os.write(1, b'100\\xe2'); time.sleep(0.1); os.write(1, b'\\x80\\x93300')"
    with Terminal([sys.executable, "-c", pieces]) as terminal:
        terminal.ended()
    assert "100–300" in terminal.seen
