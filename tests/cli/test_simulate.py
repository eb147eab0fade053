"""``rovercheck simulate``: the table, the plot, the logs, the examples, and everything that can go wrong."""

import csv
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.simulate.run import lanes
from rovercheck.supervisor.bench import judge, loads, simulate
from rovercheck.supervisor.bench.conditions import BOTH, CONDITIONS

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted((ROOT / "examples" / "scenarios").glob("*.toml"))
CUT = """
title = "Cut & <joined> $1$"
duration = "2 s"
phase = "13 ms"
[[event]]
at = "0.4 s"
stick_y = 1.0
[[event]]
at = "0.5 s"
for = "400 ms"
label = "the link is cut"
link = "cut"
"""
MET = CUT + '[[expect]]\nat = "0.62 s"\nsignal = "rover.relay"\nvalue = "BOARD_2"\n'
UNMET = CUT + '[[expect]]\nat = "0.6 s"\nsignal = "rover.relay"\nvalue = "BOARD_2"\n'


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cut.toml").write_text(MET, encoding="utf-8")
    return tmp_path


def texts(svg: bytes) -> list[str]:
    return [node.text or "" for node in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]


# --- the examples ------------------------------------------------------------------------------------


def test_there_are_examples() -> None:
    assert len(EXAMPLES) >= 6


@pytest.mark.parametrize("example", EXAMPLES, ids=[e.stem for e in EXAMPLES])
def test_every_example_is_explained_and_goes_as_expected(example: Path) -> None:
    scenario = loads(example.read_text(encoding="utf-8"))
    outcomes = judge(scenario, simulate(scenario))
    assert scenario.title and scenario.about and outcomes
    assert [outcome.said for outcome in outcomes if not outcome.met] == []


# --- what is told ------------------------------------------------------------------------------------


def test_the_table_tells_what_happened_in_80_columns(place: Path, capfd: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "cut.toml", "--no-plot"]) == Exit.AS_EXPECTED
    told = capfd.readouterr().out
    assert max(map(len, told.splitlines())) <= 80
    assert "Cut & <joined> $1$\n2 s; Board 2 starts 13 ms after Board 1; seed 0.\n" in told
    assert "     500 ms           ▸ 2: the link is cut\n" in told
    assert "     620 ms  Board 1  rx_status: OK → CRITICAL; give_b2_actuation: false → true\n" in told
    assert "     620 ms  rover    relay: BOARD_1 → BOARD_2\n" in told
    assert "     900 ms           ▸ 2 is over\n" in told
    assert "frames 1 to 2: 100 sent, 79 accepted\n" in told
    assert told.endswith("✓ expect[1]: rover.relay = BOARD_2 at 620 ms\n1 expectation: met.\n")


def test_an_unmet_expectation_is_exit_code_1(place: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (place / "cut.toml").write_text(UNMET, encoding="utf-8")
    assert run(["simulate", "cut.toml", "--no-plot"]) == Exit.FAILED
    told = " ".join(capfd.readouterr().out.split())
    assert "✗ expect[1]: rover.relay = BOARD_2 at 600 ms; it was BOARD_1 until 620 ms." in told
    assert told.endswith("1 expectation: 1 not met.")


def test_what_repeats_is_told_once(place: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text = 'duration = "7 s"\n[initial]\nobstacle_left = "50 cm"\n[[event]]\nat = "0.5 s"\nstick_y = 1.0\n'
    (place / "wall.toml").write_text(text, encoding="utf-8")
    assert run(["simulate", "wall.toml", "--no-plot"]) == Exit.AS_EXPECTED
    told = capfd.readouterr().out
    [times] = re.findall(r"^ {21}… the last 3 lines (\d) times more, until [\d,]+ ms$", told, re.M)
    assert told.count("current_action: CMD_ESTOP → CMD_STOP") == 1 and int(times) >= 3


# --- the plot ----------------------------------------------------------------------------------------


def test_the_plot_is_a_picture_with_all_lanes_the_same_every_time(place: Path) -> None:
    assert run(["simulate", "cut.toml"]) == Exit.AS_EXPECTED
    drawn = (place / "cut.svg").read_bytes()
    words = texts(drawn)
    for word in (
        "Cut & <joined> $1$",
        "v_ref, Board 1",
        "wheels in rpm",
        "heading in °",
        "70 stop",
        "300 degraded",
        "temperature in °C",
        "15 critical",
        "autorized_to_send_command",
        "CRITICAL",
        "relay",
        "Board 2",
        "1: at 0.4 s, stick_y 1",
        "2: at 0.5 s, the link is cut",
    ):
        assert word in words
    assert run(["simulate", "cut.toml", "-o", "again.svg"]) == Exit.AS_EXPECTED
    assert (place / "again.svg").read_bytes() == drawn
    assert not re.search(rb"dc:date|20\d\d-\d\d-\d\d", drawn)


@pytest.mark.parametrize(("name", "magic"), [("run.png", b"\x89PNG"), ("run.PDF", b"%PDF")])
def test_other_formats_go_by_the_suffix(name: str, magic: bytes, place: Path) -> None:
    assert run(["simulate", "cut.toml", "-o", name]) == Exit.AS_EXPECTED
    assert (place / name).read_bytes().startswith(magic)


def test_status_and_driver_are_bands_that_fill_the_run(place: Path) -> None:
    scenario = loads(CUT)
    picture = lanes(scenario, simulate(scenario), "cut")
    rows = {
        (lane.title, row.name): row for lane in picture.lanes if hasattr(lane, "rows") for row in lane.rows
    }
    for row in rows.values():
        ends = [0.0, *(band.end_s for band in row.bands)]
        assert [band.start_s for band in row.bands] == ends[:-1] and ends[-1] == 2.0
    relay = rows["relay", "relay"].bands
    assert [(b.start_s, b.label) for b in relay] == [(0.0, "Board 2"), (0.02, "Board 1"), (0.62, "Board 2")]


def test_without_matplotlib_everything_else_works(
    place: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert run(["simulate", "cut.toml"]) == Exit.AS_EXPECTED
    assert "No plot: A plot needs matplotlib, which is not installed: pip install 'rovercheck[plot]'." in (
        " ".join(capfd.readouterr().err.split())
    )
    assert run(["simulate", "cut.toml", "-o", "run.svg"]) == Exit.USAGE
    assert "run.svg: A plot needs matplotlib" in capfd.readouterr().err
    assert list(place.iterdir()) == [place / "cut.toml"]


# --- logs --------------------------------------------------------------------------------------------


def test_logs_hold_every_step_of_both_boards(place: Path) -> None:
    assert run(["simulate", "cut.toml", "--no-plot", "--log", "logs/new"]) == Exit.AS_EXPECTED
    with (place / "logs/new/board1.csv").open(newline="", encoding="utf-8") as file:
        one = list(csv.DictReader(file))
    with (place / "logs/new/board2.csv").open(newline="", encoding="utf-8") as file:
        two = list(csv.DictReader(file))
    assert [row["time_ms"] for row in one] == [str(ms) for ms in range(20, 2001, 20)]
    assert all(row["time_ms"] == row["now_ms"] for row in one + two)
    [lost] = [row for row in one if row["time_ms"] == "620"]
    assert (lost["rx_status"], lost["give_b2_actuation"], lost["v_ref"]) == ("2", "1", "1.0")
    assert {row["autorized_to_send_command"] for row in two} == {"0", "1"}


def test_the_motion_of_the_rover_as_a_table(place: Path) -> None:
    assert run(["simulate", "cut.toml", "-o", "motion.csv"]) == Exit.AS_EXPECTED
    with (place / "motion.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert float(rows[-1]["time_ms"]) == 2000.0 and float(rows[-1]["travelled"]) > 0.5


# --- what goes wrong ---------------------------------------------------------------------------------

WRONG = [
    (["missing.toml"], "Cannot read missing.toml: No such file or directory."),
    (["."], "Cannot read .: Is a directory."),
    (["bytes.toml"], "bytes.toml is no text in UTF-8, as TOML is"),
    (["no.toml"], "no.toml: This is no TOML: "),
    (["typo.toml"], "typo.toml: event[1].stik_y: there is no such condition. Did you mean 'stick_y'"),
    (
        ["cut.toml", "-o", "run.gif"],
        "run.gif: '.gif' is no format; write one of .svg, .png, .pdf",
    ),
    (["cut.toml", "-o", "none/run.svg"], "Cannot write none/run.svg: No such file or directory."),
    (["cut.toml", "--no-plot", "--log", "cut.toml"], "Cannot write into cut.toml: File exists."),
    (["cut.toml", "--no-plot", "-o", "run.svg"], "--no-plot and --output run.svg exclude each other"),
    (["cut.toml", "--plott"], "No such option"),
    ([], "Missing argument 'SCENARIO'."),
]


@pytest.mark.parametrize(("arguments", "message"), WRONG, ids=[m for _, m in WRONG])
def test_a_slip_gets_one_message_and_leaves_nothing(
    arguments: list[str], message: str, place: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    (place / "bytes.toml").write_bytes(b'title = "\xff"')
    (place / "no.toml").write_text("duration =", encoding="utf-8")
    (place / "typo.toml").write_text('duration = "2 s"\n[[event]]\nat = "1 s"\nstik_y = 1', encoding="utf-8")
    there = set(place.rglob("*"))
    assert run(["simulate", *arguments]) == Exit.USAGE
    said = capfd.readouterr().err
    assert message in " ".join(said.split()) and "bug" not in said
    assert set(place.rglob("*")) == there


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
def test_a_full_disk_is_no_verdict(place: Path) -> None:
    with Path("/dev/full").open("wb") as full:
        command = [sys.executable, "-m", "rovercheck", "simulate", "cut.toml", "--no-plot"]
        shown = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert shown.returncode == Exit.INCONCLUSIVE and "No space left on device" in shown.stderr


def test_the_document_names_every_condition() -> None:
    written = (ROOT / "docs" / "simulate.md").read_text(encoding="utf-8")
    stems = {re.sub(r"_(FL|FR|RL|RR|b1_b2|b2_b1|left|centre|right)$", "", name) for name in CONDITIONS}
    assert [name for name in sorted({*stems, *BOTH}) if f"`{name}" not in written] == []
