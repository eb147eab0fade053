"""A model of one's own beside an implementation, under stimuli that come from its formulas."""

import subprocess
import sys
from pathlib import Path

import pytest

from rovercheck import Chart, State, after, flag, in_order, integer, sec, to, var
from rovercheck.checker.adapters import python
from rovercheck.checker.adapters.implementation import Implementation
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare import cross_check, effort
from rovercheck.checker.compare.beside import rerun
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.model.load import load
from rovercheck.spec_model.abstraction.of_system import board_of
from rovercheck.spec_model.abstraction.stamps import NOW
from rovercheck.spec_model.lang.domain import chosen
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.system import Assumption
from tests.model_files.files import FIRMWARE, heater_files


@pytest.fixture
def firmware(tmp_path: Path) -> Path:
    """A folder with the model that ``init`` writes, and with firmwares of it."""
    return heater_files(tmp_path)


def running(folder: Path, name: str) -> Implementation:
    board = of_model(load(folder / "heater.py"))
    return python.start(f"{folder / 'firmware.py'}:{name}", board, isolated=False)


@pytest.mark.parametrize(
    ("name", "outputs"),
    [
        ("Heater", []),
        ("Hot", [{"heating", "Heater"}]),
        ("Brief", [{"Heater"}]),
        ("HotAndBrief", [{"Heater"}, {"heating", "Heater"}]),
    ],
)
def test_each_difference_is_told_once(firmware: Path, name: str, outputs: list[set[str]]) -> None:
    board = of_model(load(firmware / "heater.py"))
    result = cross_check(board, running(firmware, name), effort("ci", 0))
    assert len(result.coverage.taken) == 5 and result.conforms == (not outputs)
    told = sorted(({d.name for d in one.differences} for one in result.mismatches), key=len)
    assert told == outputs


@pytest.mark.parametrize(
    ("is_", "other"),
    [
        ("warm < 18", "warm < 17"),
        ("warm < 18", "warm < 16"),
        ("warm < 18", "warm < 19"),
        ("warm < 18 and not door", "warm < 18"),
        ("warm > self.limit", "warm > self.limit - 1"),
        ("warm > self.limit", "warm > self.limit + 1"),
        ("door or warm > self.limit", "warm > self.limit"),
        ("self.steps >= 500", "self.steps >= 501"),
        ("self.steps >= self.rest", "self.steps >= self.rest + 1"),
    ],
)
def test_every_limit_is_met_where_it_decides(firmware: Path, is_: str, other: str) -> None:
    """Without random runs: 17 °C was only tried with the door open or at rest, so ``< 17`` conformed."""
    file = firmware / "firmware.py"
    assert FIRMWARE.count(is_) == 1
    file.write_text(FIRMWARE.replace(is_, other), encoding="utf-8")
    result = cross_check(of_model(load(firmware / "heater.py")), running(firmware, "Heater"), effort("ci", 0))
    assert not result.conforms and result.mismatches


def test_the_command_writes_a_test_that_runs_the_model(
    firmware: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(firmware)
    asked = ["compare", "--model", "heater.py", "--examples", "0"]
    assert run([*asked, "--impl", "python:firmware.py:Heater"]) is Exit.AS_EXPECTED
    assert run([*asked, "--impl", "python:firmware.py:Hot"]) is Exit.FAILED
    assert "Heater is On instead of\n  Off." in capsys.readouterr().out
    [file] = firmware.glob("crosscheck_Heater_*.py")
    for name, code in (("Hot", 1), ("Heater", 0)):
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", file.name]
        given = {"ROVERCHECK_IMPL": f"python:firmware.py:{name}"}
        monkeypatch.setenv("ROVERCHECK_IMPL", given["ROVERCHECK_IMPL"])
        assert subprocess.run(command, capture_output=True, check=False).returncode == code


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((), "comes with no implementation; write --impl"),
        (("--impl", "python:firmware.py:Heater", "--system", "Heatr"), "Did you mean 'Heater'"),
        (
            ("--impl", "python:firmware.py:Heater", "--interpret", "S43=AND"),
            "--interpret changes the rover's",
        ),
    ],
)
def test_mistakes(
    firmware: Path,
    words: tuple[str, ...],
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(firmware)
    assert run(["compare", "--model", "heater.py", *words]) is Exit.USAGE
    assert said in " ".join(capsys.readouterr().err.split())


def logged(folder: Path, name: str) -> Path:
    """A log of a firmware: the room cools, warms up and cools again, with the door opened now and then."""
    running_one = running(folder, name)
    running_one.reset()
    rows = ["now_ms,temperature,door_open,heating"]
    for step in range(1, 3001):
        warm = (20, 17, 20, 23, 24, 19, 10, 10)[step // 100 % 8]
        given = {"now_ms": 20 * step, "temperature": warm, "door_open": step % 700 < 3}
        heating = running_one.step(given)["heating"]
        rows.append(f"{20 * step},{warm},{int(given['door_open'])},{int(heating)}")
    file = folder / f"{name}.csv"
    file.write_text("\n".join(rows) + "\n", encoding="utf-8")
    return file


def test_a_log_is_checked_against_it(
    firmware: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(firmware)
    for name, code, said in (
        ("Heater", Exit.AS_EXPECTED, "a run of the charts"),
        ("Hot", Exit.FAILED, "Heater: On → Off (transition 1) [door_open || temperature > 22]"),
    ):
        assert run(["check-log", str(logged(firmware, name)), "--model", "heater.py"]) is code
        assert said in capsys.readouterr().out
    assert run(["check-log", "Hot.csv", "--model", "heater.py", "--system", "Heate"]) is Exit.USAGE
    assert "Did you mean 'Heater'" in capsys.readouterr().err


def test_tests_that_cover_it_find_what_is_otherwise(
    firmware: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(firmware)
    asked = ["generate-tests", "--model", "heater.py", "--format", "pytest", "-o", "made"]
    assert run([*asked, "--kept"]) is Exit.USAGE
    assert run([*asked, "--cover", "transitions", "--cover", "boundaries"]) is Exit.AS_EXPECTED
    capsys.readouterr()
    for name, code in (("Heater", 0), ("Hot", 1), ("Brief", 1)):
        monkeypatch.setenv("ROVERCHECK_IMPL", f"python:{firmware / 'firmware.py'}:{name}")
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "made"]
        assert subprocess.run(command, capture_output=True, check=False).returncode == code, name


# --- what a system stands for ------------------------------------------------------------------------

warm = var("sensor.warm", integer(0, 9, "°C"))
far = var("far", chosen([0, 10, 100]))
door = flag("left.door"), flag("right.door")
fan = Chart(
    "Fan",
    [
        State("Still", transitions=[to("Turning", when=(warm > 5) & ~door[0] & ~door[1] & (far > 9))]),
        State("Turning", transitions=[to("Still", when=after(1 * sec))]),
    ],
    default="Still",
)


def test_signals_have_short_names_unless_two_would_have_the_same() -> None:
    board = board_of(in_order("fan", fan))
    assert [s.name for s in board.inputs] == ["now_ms", "warm", "left.door", "right.door", "far"]
    assert [o.name for o in board.outputs] == ["Fan"]
    by_name = {s.name: s for s in board.inputs}
    assert by_name["far"].raw(55) == 55, "firmware may hold what lies between the values of the model"
    with pytest.raises(ModelError, match="outside"):
        by_name["warm"].raw(10)


def test_steps_are_as_long_as_those_of_the_model() -> None:
    clocked = Clocked()
    result = cross_check(board_of(in_order("fan", fan, tick_ms=10), "here"), clocked, effort("ci", 0))
    assert result.conforms and clocked.apart == {10}


class Clocked:
    """Answers what the clock says that the fan does, and notes how far apart its steps are."""

    def __init__(self) -> None:
        self.apart: set[int] = set()

    def reset(self) -> None:
        self.now, self.since = None, None

    def step(self, given: object) -> dict[str, int]:
        at = dict(given)  # type: ignore[call-overload]
        if self.now is not None:
            self.apart.add((at["now_ms"] - self.now) % (1 << 32))
        first, self.now = self.now is None, at["now_ms"]
        on = at["warm"] > 5 and not at["left.door"] and not at["right.door"] and at["far"] > 9
        if self.since is not None and (self.now - self.since) % (1 << 32) >= 1000:
            self.since = None
        elif self.since is None and on and not first:
            self.since = self.now
        return {"Fan": 1 if self.since is None else 2}

    def close(self) -> None: ...


def test_what_a_model_takes_not_to_come_is_not_given() -> None:
    calm = Assumption("CALM", "It is warm only with a door closed.", ~((warm > 5) & door[0] & door[1]))
    seen = Noting()
    cross_check(board_of(in_order("fan", fan, assumptions=(calm,)), "here"), seen, effort("ci", 5))
    hot = {"now_ms": 20, "warm": 9, "left.door": True, "right.door": True, "far": 0}
    with pytest.raises(ModelError, match="assumes"):  # nor is a mismatch made small in a run that has them
        rerun(board_of(in_order("fan", fan, assumptions=(calm,)), "here"), [hot])
    assert seen.given and not any(g["warm"] > 5 and g["left.door"] and g["right.door"] for g in seen.given)


class Noting:
    """Has no outputs, and notes what it is given."""

    def __init__(self) -> None:
        self.given: list[dict[str, float]] = []

    def reset(self) -> None: ...

    def step(self, given: object) -> dict[str, float]:
        self.given.append(dict(given))  # type: ignore[call-overload]
        return {}

    def close(self) -> None: ...


def test_what_no_implementation_can_be_beside_is_refused() -> None:
    with pytest.raises(ModelError, match="write a constant"):
        board_of(in_order("fan", fan, frozen=(far,)))
    clocked = Chart("C", [State("A", transitions=[to("A", when=flag("now_ms"))])], default="A")
    with pytest.raises(ModelError, match="the time of the step"):
        board_of(in_order("c", clocked))


def test_a_mismatch_is_made_small_within_what_a_model_assumes() -> None:
    calm = Assumption("CALM", "It is warm only with a door closed.", ~((warm > 5) & door[0] & door[1]))
    board = board_of(in_order("fan", fan, assumptions=(calm,)), "here")
    result = cross_check(board, Still(), effort("ci", 5))
    assert result.mismatches and result.small
    for one in result.mismatches:
        rerun(board, [step.inputs for step in one.steps])  # refuses what is assumed not to come


class Still(Noting):
    """A fan that never turns."""

    def step(self, given: object) -> dict[str, float]:
        return {"Fan": 1}


@pytest.mark.parametrize("length", [10, 100])
def test_runs_of_a_system_become_inputs_in_steps_of_its_length(length: int) -> None:
    board = board_of(in_order("fan", fan, tick_ms=length))
    moments = [dict.fromkeys(board.system.inputs, 0)] * 3
    assert [at[NOW] for at in board.run(iter(moments))] == [length, 2 * length, 3 * length]
