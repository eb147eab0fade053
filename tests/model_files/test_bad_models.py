"""What is wrong with a user's model gets one message with file and line, and no traceback."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from tests.model_files.files import BASELINE, HEATER, but, line_of

ENUM = """
from enum import StrEnum
from rovercheck.spec_model.lang.chart import Chart, State
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.domain import enumeration
from rovercheck.spec_model.lang.expr import var
class Mode(StrEnum):
    A = "A"
mode = var("mode", enumeration("Mode", [Mode.A]), "A")
chart = Chart("C", [State("S", entry=[assign(mode, "A")])], default="S")
"""
H1, H2 = line_of("HEAT_1 =", HEATER), line_of("HEAT_2 =", HEATER)
TO_PAUSE = line_of('to("Pause"', HEATER)

FILES = {
    "syntax": (
        but("heater = Chart(", "heater = Chart(("),
        "m.py:24: this is not Python: '(' was never closed.",
    ),
    "null byte": ("x = '\0'\n", "m.py: this is not Python: source code string cannot contain null bytes."),
    "nothing": ("x = 1\n", "m.py holds no chart and no system"),
    "no property": (
        HEATER[: HEATER.index("REQUIREMENTS")],
        "m.py holds no property: there is nothing to check.",
    ),
    "a crash": (
        f"{HEATER}\ndef f(n):\n    return 1 / n\nf(0)\n",
        f"m.py:{len(HEATER.splitlines()) + 3}: ZeroDivisionError: division by zero, in `return 1 / n`.",
    ),
    "an exit": ("import sys\nsys.exit(3)\n", "m.py:2: SystemExit: 3, in `sys.exit(3)`."),
    "an exception of its own": (
        'class B(BaseException): pass\nraise B("x")\n',
        'm.py:2: B: x, in `raise B("x")`.',
    ),
    "the end of a generator": ("raise GeneratorExit\n", "m.py:1: GeneratorExit, in `raise GeneratorExit`."),
    "a task that is cancelled": (
        "import asyncio\nraise asyncio.CancelledError\n",
        "m.py:2: CancelledError, in `raise asyncio.CancelledError`.",
    ),
    "a test that is skipped": (
        'import pytest\npytest.skip("no", allow_module_level=True)\n',
        'm.py:2: Skipped: no, in `pytest.skip("no", allow_module_level=True)`.',
    ),
    "an import": ("import no_such_thing\n", "m.py:1: ModuleNotFoundError: No module named 'no_such_thing'"),
    "a formula": (
        but("temperature < 18)", "temperature < door_open)"),
        f"m.py:{line_of('temperature < 18', HEATER)}: `temperature` is",
    ),
    "an argument": (
        but("that=implies", "thatt=implies"),
        f"m.py:{H1}: TypeError: always() got an unexpected",
    ),
    "a truth value": (
        but("(temperature < 18) & ~", "temperature < 18 and not "),
        "Write & | ~ for and, or, not",
    ),
    "an unknown system": (
        but('on="Heater"', 'on="Heatr"'),
        f"m.py:{H1}: HEAT-1 is about 'Heatr', no system of this model. Did you mean 'Heater'?",
    ),
    "two properties": (
        but('"HEAT-2"', '"HEAT-1"'),
        f"m.py:{H2}: the id HEAT-1 names two properties, here and in m.py:{H1}. Rename one.",
    ),
    "two systems": (
        f'{HEATER}\nother = Chart("Heater", [State("A")], default="A")\n',
        f"m.py:{len(HEATER.splitlines()) + 2}: the name 'Heater' is taken in "
        f"m.py:{line_of('Chart(', HEATER)}: two systems have it",
    ),
    "a transition to nowhere": (
        but('to("Pause"', 'to("Pausee"'),
        f"m.py:{TO_PAUSE}: Heater: transition 2 of On goes to 'Pausee', which is no state of "
        "this chart. Did you mean 'Pause'?",
    ),
    "an unknown variable": (
        but("implies(door_open", 'implies(flag("dor_open")'),
        f"m.py:{H1}: HEAT-1 reads dor_open, which system Heater does not have. Did you mean 'door_open'?",
    ),
    "an unknown requirement": (
        but('covers=["R2"]', 'covers=["R3"]'),
        f"m.py:{H2}: HEAT-2 covers 'R3', no requirement. Did you mean",
    ),
    "requirements in a list": (
        but("REQUIREMENTS = {", "REQUIREMENTS = []\nX = {"),
        f"m.py:{line_of('REQUIREMENTS', HEATER)}: REQUIREMENTS is no mapping",
    ),
    "a requirement that is none": (but('"The room is', '3, "R3": "The room is'), "the requirement R1 is 3;"),
    "a class of its own": (ENUM, "`Mode` is a class or function of its own"),
}

BASELINES = {
    "unknown": (
        '["HEAT-9"]\nverdict = "violated"\nbecause = "x"',
        "baseline.toml lists 'HEAT-9', which is no property.",
    ),
    "no TOML": ('["HEAT-3"\n', "baseline.toml is no TOML: Expected ']'"),
    "a slip": (f"{BASELINE}\ndepht = 4", "baseline.toml: HEAT-3 has no 'depht'. Did you mean 'depth'?"),
    "a text": (BASELINE.replace("4", '"4"'), "HEAT-3 has depth = '4'; write a whole number."),
    "no reason": ('["HEAT-3"]\nverdict = "violated"', "HEAT-3 needs because ="),
    "no exception": ('["HEAT-3"]\nverdict = "proved"\nbecause = "x"', "HEAT-3 needs because = and verdict ="),
    "no table": ('HEAT-3 = "violated"', "HEAT-3 needs because ="),
}

PATHS = {
    "": "Invalid value for '--model': the path is empty;",
    "nope.py": "There is no nope.py; a model is a .py file, a folder of them, a .slx, .scxml or",
    "text.txt": "text.txt is no Python file; a model is a .py file, a folder of them, a .slx, .scxml or",
    "empty": "empty holds no Python file; a model is a .py file, a folder of them, a .slx, .scxml or",
    "a.b.py": "a.b.py has a dot in its name, which no module can have; rename the file.",
}

OPTIONS = {
    "--interpret S43=AND": "--interpret changes the rover's charts, and m.py is a model of your own.",
    "--repair relay-timer": "--repair changes the rover's charts, and m.py is a model of your own.",
    "--without A1": "There is no assumption 'A1'.",
    "--system heater": "There is no system 'heater'. Did you mean 'Heater'?",
    "HEAT-4": "There is no property 'HEAT-4'. Did you mean 'HEAT-3'",
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refused(capfd: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert run([*arguments]) == Exit.USAGE
    said = capfd.readouterr()
    assert said.out == ""
    assert "Traceback" not in said.err and "Internal error" not in said.err
    return said.err


@pytest.mark.parametrize("wrong", FILES)
def test_a_model_without_meaning(wrong: str, here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text, message = FILES[wrong]
    (here / "m.py").write_text(text, encoding="utf-8")
    said = refused(capfd, "list", "properties", "--model", "m.py")
    assert message in said
    assert len(said.splitlines()) == 1


@pytest.mark.parametrize("wrong", BASELINES)
def test_a_baseline_without_meaning(wrong: str, here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    text, message = BASELINES[wrong]
    (here / "m.py").write_text(HEATER, encoding="utf-8")
    (here / "baseline.toml").write_text(text, encoding="utf-8")
    assert message in refused(capfd, "list", "properties", "--model", "m.py")


@pytest.mark.parametrize("path", PATHS)
def test_a_path_without_a_model(path: str, here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "empty").mkdir()
    for name in ("text.txt", "a.b.py"):
        (here / name).touch()
    assert PATHS[path] in refused(capfd, "trace", "X", "--model", path)


@pytest.mark.parametrize("option", OPTIONS)
def test_an_option_without_meaning(option: str, here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "m.py").write_text(HEATER, encoding="utf-8")
    assert OPTIONS[option] in refused(capfd, "check", "--model", "m.py", *option.split())


def test_an_interruption_stays_one(here: Path) -> None:
    (here / "m.py").write_text("raise KeyboardInterrupt\n")
    assert run(["check", "--model", "m.py"]) == Exit.INTERRUPTED


def test_an_error_in_a_neighbour_is_shown_there(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "signals.py").write_text("a = 1\nb = a / 0\n")
    (here / "m.py").write_text("from signals import b\n")
    said = refused(capfd, "check", "--model", "m.py")
    assert said == "signals.py:2: ZeroDivisionError: division by zero, in `b = a / 0`.\n"


def test_a_neighbour_with_the_name_of_a_package(here: Path, capfd: pytest.CaptureFixture[str]) -> None:
    (here / "click.py").write_text("limit = 1\n")
    (here / "m.py").write_text("from click import limit\n")
    said = refused(capfd, "check", "--model", "m.py")
    assert "An installed package is named click too: write `from .click import ...`" in said
