"""Every fault of a user's model has a file and a line, also where no transition and no state is at fault."""

import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.model.load import load
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.place import Place
from tests.model_files.test_kinds import FIRST, HEAD, always

ROOT = Path(__file__).parents[2]
FAULTS = {
    "components": (
        'S = in_order("S", oven, oven)',
        "S: two components are named 'Oven'; give each its own name.",
    ),
    "a tick": ('S = in_order("S", oven, tick_ms=0)', "S: tick_ms=0 is no length of time; write whole"),
    "steps": ('S = in_order("S", oven, step_ms=-5)', "S: step_ms=-5 is no length of time; write whole"),
    "frozen": ('S = in_order("S", oven, frozen=[on])', "S: on is frozen and is assigned by Oven; drop one"),
    "twins": (
        'S = in_order("S", oven, frozen=[var("hot", integer(0, 3))])',
        "S: two variables are named hot:",
    ),
    "an assumption": (
        'S = in_order("S", oven, assume=minutes)',
        "S: the assumption `minutes` is an integer in min; write a condition, such as a comparison.",
    ),
    "an enable": (
        'S = in_order(\n"S",\nEnabled(minutes, oven))',
        "S: the enable `minutes` is an integer in min; write a condition",
    ),
    "a word in a block": (
        'S = in_order(\n"S",\nBlock("B", [assign(on, after(3 * sec))]))',
        "B: `after(3 s)`: `after(3 s)` has no meaning outside a chart; compute it in one that runs before.",
    ),
    "a send in a block": (
        'S = in_order(\n"S",\nBlock("B", [send("a", "b")]))',
        "B: `send(a, b)`: a block has no",
    ),
    "a way back": (
        'P = recoverable(\n"P-1",\n"t", to=on, by=on, within=2 * ticks, covers=["R"], on="Oven")',
        "P-1: by = on must be a condition on inputs of Oven that can be met in every tick; leave",
    ),
    "a name": (
        'C = Chart("a\\nb", [State("A")], default="A")',
        "'a\\nb' has signs that cannot be shown, such as",
    ),
    "a property as it is": (
        'P = Property("P-1", "t", Always(flag("onn")), ("R",), "Oven")',
        "P-1 reads onn, which system Oven does not have. Did you mean 'on'?",
    ),
    "a system of the wrong kind": (
        'S = in_order("S", oven, tick_ms="x")',
        "System 'S': tick_ms is 'x', a text;",
    ),
    "a requirement": (
        'REQUIREMENTS = {\n"Q": "t",\n"R": 5}',
        "the requirement R is 5; write its sentence, or",
    ),
    "an id in it": ('REQUIREMENTS = {"R": {"id": "x"}}', "the requirement R has no 'id'. Did you mean"),
    "depth": (
        "for _ in range(20_000):\n    hot = ~hot\n" + always("hot"),
        "P-1: states or formulas are nested too deeply to be read; write fewer levels.",
    ),
    "depth of states": (
        's = State("A0")\nfor i in range(3000): s = State(f"A{i + 1}", states=[s], default=s.name)\n'
        'C = Chart("C", [s], default="A3000")',
        "C: states or formulas are nested too deeply to be read; write fewer levels.",
    ),
}


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def refused(text: str) -> list[str]:
    Path("m.py").write_text(f"{HEAD}{text}\n", encoding="utf-8")
    with pytest.raises(ModelError) as error:
        load(Path("m.py"))
    return str(error.value).splitlines()


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_has_its_line(fault: str) -> None:
    text, message = FAULTS[fault]
    third = (
        "an enable",
        "a word in a block",
        "a send in a block",
        "a requirement",
        "depth",
        "depth of states",
    )
    [told] = refused(text)
    assert told.startswith(f"m.py:{FIRST + 2 if fault in third else FIRST}: {message}")


def test_the_line_is_the_users_where_the_environment_is_in_her_folder(tmp_path: Path) -> None:
    """As `.venv` is beside the model of the tutorial: rovercheck's own files are in the folder, too."""
    library = tmp_path / ".venv" / "lib"
    library.mkdir(parents=True)
    (library / "rovercheck").symlink_to(ROOT / "rovercheck", target_is_directory=True)
    (tmp_path / "oven.py").write_text(HEAD + 'X = always(\n"X", "x", that=on and minutes, covers=["x"])\n')
    told = subprocess.run(
        [sys.executable, "-m", "rovercheck", "check", "--model", "oven.py"],
        cwd=tmp_path, env={**os.environ, "PYTHONPATH": str(library)}, capture_output=True, text=True,
        check=False,
    )  # fmt: skip
    assert told.returncode == Exit.USAGE
    assert told.stderr.startswith(f"oven.py:{HEAD.count(chr(10)) + 2}: `on` is a formula"), told.stderr


def test_a_name_that_is_taken_has_both_lines() -> None:
    [told] = refused('S = in_order("S", oven)\nT = in_order("S", oven)')
    assert told.startswith(f"m.py:{FIRST + 1}: the name 'S' is taken in m.py:{FIRST}: two systems")


def test_systems_that_lead_to_each_other_are_told() -> None:
    text = 'S = in_order("S", oven, concrete="T")\nT = in_order("T", oven, concrete="S")'
    assert [told.partition(" names")[0] for told in refused(text)] == [
        f"m.py:{FIRST}: S",
        f"m.py:{FIRST + 1}: T",
    ]


@pytest.mark.parametrize("deep", ["l = [oven]\nl.append(l)", "l = [oven]\nfor _ in range(20_000): l = [l]"])
def test_lists_may_be_deep_and_may_hold_themselves(deep: str) -> None:
    Path("m.py").write_text(f"{HEAD}{deep}\n", encoding="utf-8")
    assert list(load(Path("m.py")).systems) == ["Oven"]


def test_systems_and_blocks_know_their_lines_and_are_the_same_elsewhere() -> None:
    text = 'S = in_order(\n"S",\nEnabled(hot,\nBlock("B", [assign(on, minutes > 3)])),\n)'
    Path("m.py").write_text(f"{HEAD}{text}\n", encoding="utf-8")
    system = load(Path("m.py")).systems["S"]
    [enabled] = system.components
    places = [system.place, enabled.place, system.blocks[0].place]
    assert [place and place.line for place in places] == [FIRST, FIRST + 2, FIRST + 3]
    assert repr(system) == repr(replace(system, place=Place("other.py", 1)))
    assert system == replace(system, place=Place("other.py", 1))
