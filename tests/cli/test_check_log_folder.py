"""``rovercheck check-log`` of many logs and of hostile ones: each is judged on its own, and shown safely."""

import json
import os
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from rovercheck.checker.adapters.c_build import compiler
from rovercheck.checker.cli import run
from rovercheck.checker.commands.check_log import LogOptions, at_once
from rovercheck.checker.commands.check_log import request as conforming
from rovercheck.checker.commands.check_log.text import LogFault
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.logs import logs_in
from rovercheck.checker.commands.shared.options import VariantOptions
from rovercheck.checker.logs import LogResult, examine
from rovercheck.spec_model.abstraction import boards
from tests.logs.recorded import Row, copied, long_log, written
from tests.schemas import published

EXAMPLES = Path(__file__).parents[2] / "examples" / "logs"
SCHEMA: Any = published("conform-1")


def check_log(*arguments: str | Path) -> Exit:
    return run(["check-log", *map(str, arguments)])


def document(*arguments: str | Path, capsys: pytest.CaptureFixture[str]) -> Any:
    """What is printed as JSON: it is as described, and names the exit code."""
    capsys.readouterr()
    code = check_log(*arguments, "--json")
    found = json.loads(capsys.readouterr().out)
    Draft202012Validator.check_schema(SCHEMA)
    Draft202012Validator(SCHEMA).validate(found)
    assert found["exit"] == code
    return found


def rows() -> list[Row]:
    return copied(long_log("board1")[:50])


def good(folder: Path) -> None:
    written(folder, rows(), name="good.csv")


def deviating(folder: Path) -> None:
    changed = rows()
    changed[30]["temp_status"] = (int(changed[30]["temp_status"]) + 1) % 3
    written(folder, changed, name="odd.csv")


def with_a_wrong_cell(folder: Path) -> None:
    changed = rows()
    changed[30]["btn1"] = 2
    written(folder, changed, name="cell.csv")


def unusable(folder: Path) -> None:
    (folder / "cut.csv").write_text("now_ms,temp_status\n20\n40,0\n", encoding="utf-8")


def torn(folder: Path) -> None:
    (folder / "torn.csv").write_text("now_ms,temp_status\n20,0\n40\n", encoding="utf-8")


def undecided(folder: Path) -> None:
    inputs = [s.name for s in boards()["board1"].inputs if s.name != "now_ms"]
    written(folder, copied(long_log("board1")[:400]), inputs, name="open.csv")


def failing(folder: Path) -> None:
    written(folder, rows(), name="fails.csv")


@pytest.fixture
def a_fault_of_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    """Judging ``fails.csv`` raises what nobody expects."""

    def broken(path: Path, *rest: Any) -> LogResult:
        if path.name == "fails.csv":
            raise KeyError("prevDEG_B1")
        return examine(path, *rest)

    monkeypatch.setattr(conforming, "examine", broken)


@pytest.mark.usefixtures("a_fault_of_ours")
@pytest.mark.parametrize(
    ("logs", "code"),
    [
        ([good], 0),
        ([good, undecided], 2),
        ([good, torn], 2),
        ([good, undecided, unusable], 4),
        ([good, undecided, unusable, deviating], 1),
        ([good, unusable, with_a_wrong_cell], 1),
        ([good, undecided, unusable, deviating, failing], 3),
        ([failing, good], 3),
    ],
)
def test_the_gravest_log_decides_and_every_log_is_told(
    logs: list[Callable[[Path], None]], code: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for make in logs:
        make(tmp_path)
    assert check_log(tmp_path) == code
    printed = " ".join(capsys.readouterr().out.split())
    for file in tmp_path.iterdir():
        assert file.name in printed
    if torn in logs:
        assert "torn.csv: judged up to what cannot be read: line 3: the row has 1 cells" in printed
    if failing in logs:
        assert (
            "fails.csv: not judged: Internal error: KeyError: 'prevDEG_B1'. "
            "This is a bug of rovercheck" in printed
        )
        assert "1 not judged for an internal error" in printed
    found = document(tmp_path, capsys=capsys)
    assert [log["log"] for log in found["logs"]] == sorted(f.name for f in tmp_path.iterdir())
    assert [log["log"] for log in found["logs"] if log.get("internal")] == ["fails.csv"] * (failing in logs)


@pytest.mark.usefixtures("a_fault_of_ours")
def test_a_fault_of_ours_on_a_single_log(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    failing(tmp_path)
    assert check_log(tmp_path / "fails.csv") is Exit.INTERNAL
    assert "This is a bug of rovercheck" in capsys.readouterr().err


def test_a_log_for_which_there_is_no_room_leaves_the_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    good(tmp_path)

    def no_room(*_: Any) -> LogResult:
        raise MemoryError

    monkeypatch.setattr(conforming, "examine", no_room)
    assert check_log(tmp_path) is Exit.USAGE
    assert "good.csv: not read: takes more memory than there is" in capsys.readouterr().out


def test_a_wrong_cell_is_told_and_counted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with_a_wrong_cell(tmp_path)
    assert check_log(tmp_path / "cell.csv") is Exit.FAILED
    printed = " ".join(capsys.readouterr().out.split())
    assert "Cells: 1 cell without meaning, taken as not logged. ✗ btn1: 2 is outside boolean" in printed
    assert "tick 31, line 32" in printed and "a run of the charts" in printed
    [cell] = document(tmp_path / "cell.csv", capsys=capsys)["invalid_cells"]
    assert (cell["column"], cell["value"], cell["first_tick"], cell["first_line"], cell["rows"]) == (
        "btn1", "2", 31, 32, 1,
    )  # fmt: skip
    check_log(tmp_path)
    assert "1 log: none deviates, 1 with cells without meaning." in capsys.readouterr().out


@pytest.mark.parametrize("log", ["good.csv", "faults.csv"])
def test_the_examples_as_json(log: str, capsys: pytest.CaptureFixture[str]) -> None:
    how: list[str | Path] = ["--map", EXAMPLES / "map.toml"] if log == "faults.csv" else []
    document(EXAMPLES / log, *how, capsys=capsys)


# --- texts from outside -----------------------------------------------------------------------------

HOSTILE = "\x1b]0;owned\x07\x1b[31m:1234: :smile: [red]\x9b2J\u202e"
SHOWN = r"\x1b]0;owned\x07\x1b[31m:1234: :smile: [red]\x9b2J\u202e"


def harmless(text: str) -> bool:
    return all(c.isprintable() or c in "\n\t\xa0" for c in text)


def hostile(folder: Path, name: str = "log.csv") -> Path:
    """A log with an odd column of its own and an odd cell."""
    changed = [{**row, HOSTILE: 0} for row in rows()]
    file = written(folder, changed, name=name)
    lines = file.read_text("utf-8").splitlines()
    place = lines[0].split(",").index("btn1")
    cells = lines[5].split(",")
    lines[5] = ",".join([*cells[:place], HOSTILE, *cells[place + 1 :]])
    file.write_text("\n".join(lines), encoding="utf-8")
    return file


@pytest.mark.parametrize("option", ["--verbose", "--json"])
def test_names_of_columns_and_cells_are_printed_as_they_are(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert check_log(hostile(tmp_path), option) is Exit.FAILED
    printed = capsys.readouterr().out
    assert harmless(printed)
    assert option == "--json" or SHOWN in printed.replace("\n", " ").replace("               ", "")
    assert option != "--json" or json.loads(printed)["ignored_columns"] == [HOSTILE]


@pytest.mark.parametrize("option", ["--quiet", "--json"])
def test_names_of_files_are_printed_as_they_are(
    option: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    good(tmp_path)
    os.rename(tmp_path / "good.csv", os.fsencode(tmp_path) + b"/\x1b[31m\xff:12:.csv")
    assert check_log(tmp_path, option) is Exit.AS_EXPECTED
    printed = capsys.readouterr().out
    assert harmless(printed)
    assert (r"\x1b[31m\udcff:12:.csv" if option == "--quiet" else r"\u001b[31m\udcff:12:.csv") in printed


@pytest.mark.parametrize(
    "arguments",
    [
        ["check-log", "NAME"],
        ["check-log", "LOG", "--map", "NAME"],
        ["check-log", "LOG", "--system", "NAME"],
        ["check-log", "LOG", "--interpret", "NAME"],
        ["compare", "--impl", "NAME"],
        ["compare", "--system", "board1", "--impl", "command:NAME"],
        ["check", "NAME"],
        ["check", "--model", "NAME"],
        ["trace", "NAME"],
        ["graph", "NAME"],
        ["list", "NAME"],
        ["certify", "NAME"],
        ["simulate", "NAME"],
        ["export", "NAME"],
        ["explore", "NAME"],
        ["NAME"],
    ],
)
def test_what_was_written_is_told_harmlessly_by_every_verb(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    given = [a.replace("NAME", HOSTILE).replace("LOG", str(EXAMPLES / "good.csv")) for a in arguments]
    assert run(given) in (Exit.USAGE, Exit.NOTHING)
    printed = capsys.readouterr()
    assert harmless(printed.out + printed.err) and "Internal error" not in printed.err
    assert ":1234: :smile: [red]" in " ".join(printed.err.split())


def test_messages_of_a_compiler_are_printed_as_they_are(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if compiler() is None:
        pytest.skip("there is no C compiler on this machine (cc, gcc, clang)")
    (tmp_path / "sup.c").write_text('#include "sup.h"\n', encoding="utf-8")
    lines = ["void go(void);", *[""] * 1232, '#error ":smile: [red]\x1b[31m"']
    (tmp_path / "sup.h").write_text("\n".join(lines), encoding="utf-8")
    (tmp_path / "map.toml").write_text(
        'header = "sup.h"\nstep = "go"\n[inputs]\nbtn1 = "a"\n[outputs]\nv_ref = "b"\n', encoding="utf-8"
    )
    assert run(["compare", "--system", "board1", "--impl", f"c:{tmp_path}"]) is Exit.USAGE
    printed = capsys.readouterr().err
    assert harmless(printed) and ":1234:" in printed and ":smile: [red]" in printed


# --- several processes -------------------------------------------------------------------------


@pytest.fixture
def several(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of logs that several processes share, however short the logs are."""
    for number, made in enumerate((good, deviating, with_a_wrong_cell, unusable, deviating)):
        made(tmp_path)
        for log in [one for one in tmp_path.iterdir() if not one.name.startswith("log")]:
            log.rename(tmp_path / f"log{number}{log.suffix}")
    monkeypatch.setattr(at_once, "SMALL", 0)
    return tmp_path


@pytest.mark.parametrize(
    "options",
    [(), ("--json",), ("--interpret", "S43=AND"), ("--system", "board1"), ("--known", "known.toml")],
    ids=lambda options: " ".join(options) or "plain",
)
def test_several_processes_say_what_one_says(
    options: tuple[str, ...], several: Path, tmp_path_factory: pytest.TempPathFactory,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    known = tmp_path_factory.mktemp("known") / "known.toml"
    assert check_log(several, "--jobs", "1", "--write-known", known) is Exit.FAILED
    capsys.readouterr()
    given = [known if one == "known.toml" else one for one in options]
    codes, said = [], []
    for jobs in ("1", "3"):
        codes.append(check_log(several, "--jobs", jobs, *given))
        said.append(capsys.readouterr().out)
    assert codes[0] == codes[1] and said[0] == said[1]
    assert said[0].index("log0") < said[0].index("log4")


def test_a_log_over_which_a_process_dies_leaves_the_others(several: Path) -> None:
    logs, others = logs_in(several), _children()
    events = at_once.at_once(logs, VariantOptions(), LogOptions(), False, 2)
    found = [next(events)]
    for child in _children() - others:
        os.kill(child, signal.SIGKILL)
    found += events
    assert sorted(log for log, _ in found) == logs, "each is told once"
    faults = [outcome for _, outcome in found if isinstance(outcome, LogFault)]
    assert 1 <= len(faults) <= 2 and all("SIGKILL" in fault.message for fault in faults)


def test_whoever_ends_it_in_the_middle_ends_every_process(several: Path) -> None:
    others = _children()
    events = at_once.at_once(logs_in(several), VariantOptions(), LogOptions(), False, 2)
    next(events)
    assert len(_children() - others) == 2
    events.close()
    assert _children() <= others


def _children() -> set[int]:
    """The processes that this one has started and that still run."""
    found = set[int]()
    for status in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            state, parent, *_ = status.read_text("utf-8").rpartition(")")[2].split()
            if int(parent) == os.getpid() and state != "Z":
                found.add(int(status.parent.name))
    return found
