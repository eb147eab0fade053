"""What is wrong on the command line gets one clear message, the documented code, and no traceback."""

import json
import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit

WRONG = [
    (["check", "PB1-111"], Exit.USAGE, "There is no property 'PB1-111'. Did you mean 'PB1-11"),
    (["trace", "PB9-99"], Exit.USAGE, "There is no property 'PB9-99'."),
    (["check", "--system", "relais"], Exit.USAGE, "There is no system 'relais'. Did you mean 'relay'"),
    (["check", "--engine", "explicite"], Exit.USAGE, "no engine 'explicite'. Did you mean 'explicit'"),
    (["graph", "Relais"], Exit.USAGE, "There is no chart or system 'Relais'. Did you mean"),
    (["graph", "relay", "--project", "giv_b2_actuation"], Exit.USAGE, "Did you mean 'give_b2_actuation'"),
    (["graph", "Relay", "--format", "svgg"], Exit.USAGE, "Did you mean 'svg'"),
    (["trace", "PB1-15", "--format", "vdc"], Exit.USAGE, "Did you mean 'vcd'"),
    (["check", "--depth", "deep"], Exit.USAGE, "'deep' is not a valid int"),
    (["check", "--depth", "0"], Exit.USAGE, "0 is not in the range"),
    (["check", "--timeout", "soon"], Exit.USAGE, "'soon' is not a valid float"),
    (["check", "--timeout", "-1"], Exit.USAGE, "-1.0 is not in the range"),
    (["check", "--timeout", "nan"], Exit.USAGE, "'nan' is not a number"),
    (["check", "--timeout", "inf"], Exit.USAGE, "inf is not in the range"),
    (["check", "--memory", "nan"], Exit.USAGE, "'nan' is not a number"),
    (["check", "--memory", "1e30"], Exit.USAGE, "1e+30 is not in the range"),
    (["check", "--all-engines", "--engine", "bmc"], Exit.USAGE, "--engine bmc asks one engine"),
    (["check", "--all-engines", "--engine", "bcm"], Exit.USAGE, "There is no engine 'bcm'"),
    (["check", "--jobs", "0"], Exit.USAGE, "0 is not in the range"),
    (["check", "--memory", "0"], Exit.USAGE, "0.0 is not in the range"),
    (["list", "everything"], Exit.USAGE, "'everything' is not one of"),
    (["chekc"], Exit.USAGE, "No such command 'chekc'"),
    (["check", "PB1-15", "--system", "battery"], Exit.NOTHING, "Nothing to check"),
]


@pytest.mark.parametrize(("arguments", "code", "message"), WRONG, ids=[" ".join(a) for a, _, _ in WRONG])
def test_a_slip_gets_one_message_and_its_code(
    arguments: list[str], code: Exit, message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    assert run(arguments) == code
    shown = capfd.readouterr()
    assert message in " ".join((shown.out + shown.err).split())
    assert "Traceback" not in shown.out + shown.err


@pytest.mark.parametrize("place", ["missing/folder/x.svg", "."])
def test_an_unwritable_place_leaves_nothing_behind(
    place: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    target = tmp_path / place
    assert run(["graph", "Relay", "--output", str(target)]) == Exit.USAGE
    assert f"Cannot write {target}" in " ".join(capfd.readouterr().err.split())
    assert list(tmp_path.iterdir()) == []


def left_behind(mark: str) -> list[str]:
    """The processes whose environment has a mark (none where the system does not tell)."""
    found = []
    for process in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if mark.encode() in (process / "environ").read_bytes():
                found.append(process.name)
    return found


@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_whoever_ends_it_in_the_middle_gets_what_was_found(number: signal.Signals) -> None:
    mark = f"ROVERCHECK_TEST_{os.getpid()}_{time.monotonic_ns()}"
    child = subprocess.Popen(
        [sys.executable, "-m", "rovercheck", "check", "--engine", "bmc", "--depth", "100000", "--json"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True,
        env={**os.environ, "MARK": mark},
    )  # fmt: skip
    assert child.stderr is not None
    said = next(line for line in child.stderr if "so far" in line)
    os.killpg(child.pid, number)
    shown, rest = child.communicate(timeout=60)
    said += rest
    assert child.returncode == Exit.INTERRUPTED
    assert "Interrupted:" in said
    assert "Traceback" not in said
    assert json.loads(shown)["complete"] is False
    assert left_behind(mark) == []
