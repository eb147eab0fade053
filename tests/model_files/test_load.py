"""Charts, systems and properties are found in a file or a folder, wherever it is."""

import json
import sys
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.model import Model
from rovercheck.checker.model.load import load
from rovercheck.properties.expected import Expected
from rovercheck.spec_model.lang.errors import ModelError
from tests.model_files.files import BASELINE, HEATER, START, but

SIGNALS = """
from rovercheck.spec_model.lang.expr import flag
signal = flag("{name}")
print("said while it is read")
"""
CHART = """
{imports}
from rovercheck.properties.forms import always
from rovercheck.spec_model.lang.chart import Chart, State, to
chart = Chart("C", [State("A", transitions=[to("B", when=signal)]), State("B")], default="A")
properties = [always("C-1", "It stays.", that=chart.active("A"), covers=["a letter"], on="C")]
"""


def folder(place: Path, name: str = "signal", imports: str = "from signals import signal") -> Path:
    place.mkdir()
    (place / "signals.py").write_text(SIGNALS.format(name=name))
    (place / "chart.py").write_text(CHART.format(imports=imports))
    return place


def test_a_lone_chart_is_a_system_with_free_inputs() -> None:
    model = load(START / "heater.py")
    assert list(model.systems) == ["Heater"]
    assert set(model.systems["Heater"].inputs) == {"temperature", "door_open"}
    assert list(model.properties) == ["HEAT-1", "HEAT-2", "HEAT-3"]
    assert {p.area for p in model.properties.values()} == {"heater"}


def test_the_baseline_and_the_requirements_beside_it_are_read() -> None:
    model = load(START)
    assert model.expected("HEAT-1") == Expected()
    assert (model.expected("HEAT-3").verdict, model.expected("HEAT-3").depth) == ("violated", 4)
    assert model.requirements["R1"].text == "The room is not heated with the door open."


def test_a_baseline_for_one_file_comes_before_that_of_the_folder(tmp_path: Path) -> None:
    (tmp_path / "heater.py").write_text(HEATER)
    (tmp_path / "baseline.toml").write_text(BASELINE.replace("depth = 4", "depth = 40"))
    assert load(tmp_path / "heater.py").expected("HEAT-3").depth == 40
    (tmp_path / "heater.baseline.toml").write_text(BASELINE.replace("depth = 4", "depth = 3"))
    assert load(tmp_path / "heater.py").expected("HEAT-3").depth == 3


def test_requirements_may_be_a_file_or_nothing_but_words(tmp_path: Path) -> None:
    place = folder(tmp_path / "model")
    assert list(load(place).requirements) == ["a letter"]
    text = '["a letter"]\ntext = "It stays."\nsource = "the letter of May"\n'
    (place / "requirements.toml").write_text(text)
    assert load(place).requirements["a letter"].source == "the letter of May"


def test_what_is_in_a_system_is_no_system_of_its_own(tmp_path: Path) -> None:
    (tmp_path / "heater.py").write_text(
        but(
            "REQUIREMENTS",
            "from rovercheck import in_order\nroom = in_order('room', heater)\nREQUIREMENTS",
        ).replace('on="Heater"', 'on="room"')
    )
    assert list(load(tmp_path / "heater.py").systems) == ["room"]


@pytest.mark.parametrize("imports", ["from signals import signal", "from .signals import signal"])
def test_a_file_imports_its_neighbour(tmp_path: Path, imports: str) -> None:
    place = folder(tmp_path / "model", imports=imports)
    for path in (place, place / "chart.py"):
        assert list(load(path).systems["C"].inputs) == ["signal"]


def test_models_with_files_of_one_name_do_not_meet(tmp_path: Path) -> None:
    before, paths = set(sys.modules), list(sys.path)
    one, other = (folder(tmp_path / name, name) for name in ("one", "other"))
    assert [list(load(p).systems["C"].inputs) for p in (one, other, one)] == [["one"], ["other"], ["one"]]
    left = {name for name in set(sys.modules) - before if not name.startswith("<rovercheck model ")}
    assert left == set()
    assert sys.path == paths


def test_a_neighbour_hides_nothing_that_is_installed(tmp_path: Path) -> None:
    place = folder(tmp_path / "model", imports="from signals import signal\nimport json\njson.dumps(1)")
    for name in ("json", "properties", "numpy"):
        (place / f"{name}.py").write_text("raise AssertionError\n" if name != "json" else "")
    assert "C" in load(place / "chart.py").systems
    import numpy

    assert hasattr(numpy, "array")


def test_a_changed_file_is_read_anew_and_nothing_is_written_beside_it(tmp_path: Path) -> None:
    place = folder(tmp_path / "model", name="one")
    assert list(load(place).systems["C"].inputs) == ["one"]
    (place / "signals.py").write_text(SIGNALS.format(name="two"))  # of the same length, in the same second
    assert list(load(place).systems["C"].inputs) == ["two"]
    assert sorted(p.name for p in place.iterdir()) == ["chart.py", "signals.py"]


def test_what_a_model_prints_is_no_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    load(folder(tmp_path / "model"))
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "said while it is read\n")


def test_what_a_model_prints_commands_no_terminal(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """It was printed raw."""
    text = "import sys, warnings\nprint('a\\x1b[2Jb')\nprint('c\\rd', file=sys.stderr, flush=True)\n"
    (tmp_path / "heater.py").write_text(text + HEATER)
    load(tmp_path / "heater.py")
    said = capsys.readouterr()
    assert (said.out, said.err) == ("", "a\\x1b[2Jb\nc\\rd\n")


def test_json_stays_json_whatever_a_model_and_its_programs_print(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    text = "import os\nprint('{')\nos.write(1, b'written\\n')\nos.system('echo from a program')\n"
    (tmp_path / "heater.py").write_text(text + HEATER)
    (tmp_path / "baseline.toml").write_text(BASELINE)
    run(["check", "HEAT-2", "--json", "--model", str(tmp_path / "heater.py")])
    said = capfd.readouterr()
    assert [row["id"] for row in json.loads(said.out)["results"]] == ["HEAT-2"]
    assert all(text in said.err for text in ("{\n", "written\n", "from a program\n"))


def test_a_path_is_meant_from_where_one_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder(tmp_path / "model")
    monkeypatch.chdir(tmp_path / "model")
    found = [load(Path(p)) for p in (".", "chart.py", "../model/chart.py")]
    assert all(isinstance(m, Model) and list(m.properties) == ["C-1"] for m in found)
    assert found[1].options == "--model chart.py"


def test_a_folder_is_read_without_its_tests(tmp_path: Path) -> None:
    place = folder(tmp_path / "model")
    for name in ("conftest.py", "test_chart.py"):
        (place / name).write_text("raise AssertionError\n")
    assert list(load(place).properties) == ["C-1"]


def test_a_model_without_properties_can_be_drawn_but_not_checked(tmp_path: Path) -> None:
    (tmp_path / "heater.py").write_text(HEATER[: HEATER.index("REQUIREMENTS")])
    model = load(tmp_path / "heater.py")
    assert list(model.charts) == ["Heater"]
    with pytest.raises(ModelError, match="holds no property"):
        model.stated()


def test_properties_in_a_file_of_its_own_are_read_with_the_folder(tmp_path: Path) -> None:
    """As ``import --write`` writes them."""
    begins = HEATER.index("REQUIREMENTS")
    (tmp_path / "heater.py").write_text(HEATER[:begins])
    (tmp_path / "heater_properties.py").write_text(f"from heater import *\n{HEATER[begins:]}")
    with pytest.raises(ModelError, match=rf"heater_properties.py .* with the folder, --model {tmp_path}"):
        load(tmp_path / "heater.py").stated()
