"""The recipes of CONTRIBUTING, followed: the files that they name are written, and nothing is registered."""

import re
import subprocess
import sys
from pathlib import Path
from shutil import copytree, ignore_patterns

import pytest

ROOT = Path(__file__).parents[2]
BY_HAND = {
    "Add or change a chart": "the lift of examples/models is one, and tests/model_files adds charts",
    "Add a system": "tests/model lowers and runs every one",
    "Add an interpretation": "an ambiguous sentence: tests/interpretations runs each choice",
    "Add a field to a JSON document": "mypy compares record and code, tests/docs the schema",
    "Change what a board reads or produces": "tests/model/test_abstraction.py",
    "Add a word to the language": "two independent meanings, which tests/lang compares",
    "Add a form of properties": "a monitor and a sentence, which tests/properties compares",
    "Add an operator": "tests/lang/test_operator_tables.py names what is missing",
    "Add a rule of Simulink": "tests/simulink/test_rules.py names what a row lacks",
    "Add a dependency": "make lock asks the package index",
    "The licence": "is the owner's to choose; tests/packaging looks that none is named",
    "Habits": "tests/test_house_rules.py",
}
"""Sections that no test here follows, and where they are looked after."""
ALWAYS = """
from rovercheck.properties.forms import always
from rovercheck.spec_model.signals.board1 import temp_status

WARM = always(
    "TEMP-X", "A status is one of three.", that=temp_status != "TEMP_HEALTH_OK", covers=["B1-TEMP-01"],
    on="temperature",
)
"""
REPAIR = """
from rovercheck.spec_model.repairs import Repair

at_once = Repair("at-once", "The relay does not wait.", ("PB1-15",), interpretations={"S45": "IMMEDIATE"})
"""
ENGINE = '''
"""An engine that gives up at once."""

from rovercheck.checker.results.verdict import Open

NAME = "idle"
SUMMARY = "gives up at once"


def check(system, goals, limits, progress):
    return {goal.name: Open("no idea", 0) for goal in goals}
'''
RENDERER = '''
"""How long a run is."""

from rovercheck.checker.results.format import Format

FORMAT = Format("length", "trace", ".len", "the number of its ticks")


def render(trace):
    return f"{len(trace)} ticks of {trace.system.name}\\n"
'''
EXPORT = '''
"""The name of the problem."""

from rovercheck.checker.results.format import Format

FORMAT = Format("name", "problem", ".name", "its name, for whoever needs no more")


def export(problem):
    return "a problem\\n"
'''
ADAPTER = '''
"""An implementation that is not there."""

from rovercheck.checker.adapters.implementation import ImplementationError

KIND = "nowhere"
FORM = "nowhere:NAME"
SUMMARY = "an implementation that is not there"


def start(what, board, limits):
    raise ImplementationError(f"{what} is nowhere")
'''
VERB = '''
"""The verb ``greet``: a first word."""

import click

from rovercheck.checker.commands.shared.codes import Exit


@click.command(short_help="Say a first word.")
def greet() -> Exit:
    """Say a first word."""
    from rovercheck.checker.commands.greet.run import greet as run

    return run()
'''
GREETS = """
from rovercheck.checker.commands.shared.codes import Exit


def greet():
    print("good morning")
    return Exit.AS_EXPECTED
"""


@pytest.fixture
def house(tmp_path: Path) -> Path:
    """A copy of what is installed, which a contributor changes."""
    copytree(ROOT / "rovercheck", tmp_path / "rovercheck", ignore=ignore_patterns("__pycache__"))
    return tmp_path / "rovercheck"


def said(house: Path, *command: str, code: int = 0) -> str:
    """What a command prints there."""
    done = subprocess.run(
        [sys.executable, "-m", "rovercheck", *command], cwd=house.parent, capture_output=True, text=True,
        timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


def test_a_property(house: Path) -> None:
    area = house / "properties" / "areas" / "temperature.py"
    area.write_text(area.read_text(encoding="utf-8") + ALWAYS, encoding="utf-8")
    assert "TEMP-X is violated; expected: proved." in said(house, "check", "TEMP-X", code=1)


def test_a_repair(house: Path) -> None:
    (house / "spec_model" / "repairs" / "at_once.py").write_text(REPAIR, encoding="utf-8")
    assert re.search(r"PB1-15 +proved", said(house, "check", "PB1-15", "--repair", "at-once"))


def test_an_engine(house: Path) -> None:
    (house / "checker" / "engines" / "idle.py").write_text(ENGINE, encoding="utf-8")
    assert "gives up at once" in said(house, "list", "engines")
    assert "no idea" in said(house, "check", "PB1-11", "--engine", "idle", code=2)


def test_a_renderer(house: Path) -> None:
    (house / "checker" / "render" / "trace_length.py").write_text(RENDERER, encoding="utf-8")
    assert "8 ticks of board1" in said(house, "trace", "PB1-15", "--format", "length", "--no-explain")


def test_an_export_format(house: Path) -> None:
    (house / "checker" / "export" / "name.py").write_text(EXPORT, encoding="utf-8")
    assert "a problem" in said(house, "export", "PB1-11", "--format", "name")


def test_an_adapter(house: Path) -> None:
    (house / "checker" / "adapters" / "nowhere.py").write_text(ADAPTER, encoding="utf-8")
    assert "it is nowhere" in said(house, "crosscheck", "--system", "board1", "--impl", "nowhere:it", code=4)


def test_a_verb(house: Path) -> None:
    folder = house / "checker" / "commands" / "greet"
    folder.mkdir()
    (folder / "__init__.py").write_text(VERB, encoding="utf-8")
    (folder / "run.py").write_text(GREETS, encoding="utf-8")
    assert said(house, "greet") == "good morning\n"
    assert "Say a first word." in said(house, "--help")


FOLLOWED = {
    "Add a property", "Propose a repair", "Add an engine", "Add a renderer", "Add an export format",
    "Add an adapter", "Add a verb",
}  # fmt: skip


def test_every_recipe_is_followed_or_looked_after_elsewhere() -> None:
    sections = re.findall(r"^## (.*)$", (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8"), re.M)
    assert sorted(sections) == sorted([*FOLLOWED, *BY_HAND])
