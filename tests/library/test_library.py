"""rovercheck as a library: the public names, checks from a script, what a notebook shows."""

import doctest
import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from shutil import copy
from types import ModuleType

import pytest

import rovercheck
from rovercheck import language, library
from rovercheck.checker.certify.outcome import Rejected
from rovercheck.spec_model.lang.errors import ModelError
from tests.model_files.files import START

HEATER = START / "heater.py"


@pytest.mark.parametrize("module", [rovercheck, language, library], ids=lambda m: m.__name__)
def test_examples_say_what_happens(module: ModuleType) -> None:
    assert doctest.testmod(module).failed == 0


def test_every_public_name_is_there_once() -> None:
    names = [*language.__all__, *library.__all__]
    assert len(names) == len(set(names))
    assert set(names) <= set(dir(rovercheck))
    assert all(getattr(rovercheck, name) is not None for name in names)
    words = [n for n in names if n not in ("Action", "TRUE", "FALSE")]
    undocumented = [n for n in words if not getattr(getattr(rovercheck, n), "__doc__", None)]
    assert undocumented == []


def test_what_is_not_public_is_not_there() -> None:
    with pytest.raises(AttributeError, match="module 'rovercheck' has no attribute 'chart'"):
        rovercheck.chart


def test_a_model_is_checked_by_its_path() -> None:
    found = rovercheck.check(HEATER)
    assert [one.result.property.id for one in found] == ["HEAT-1", "HEAT-2", "HEAT-3"]
    assert found.as_expected and found["HEAT-3"].word == "violated" and found[0].word == "proved"
    assert "HEAT-1 proved (explicit: all " in str(found)
    assert "<td>HEAT-3</td><td>violated</td>" in found._repr_html_()
    assert [one.word for one in found[1:]] == ["proved", "violated"]
    assert rovercheck.check(HEATER, "HEAT-1", certify=True)[0].result.certificate is not None


def test_a_limit_is_no_proof() -> None:
    assert rovercheck.check(HEATER, "HEAT-2", engine="bmc", depth=5)[0].word == "unknown"


@pytest.mark.parametrize(
    ("ids", "engine", "said"), [(("HEAT-9",), "auto", "HEAT-9"), ((), "expl", "'expl'")], ids=str
)
def test_a_name_without_meaning_is_refused(ids: tuple[str, ...], engine: str, said: str) -> None:
    with pytest.raises(ModelError, match=said):
        rovercheck.check(HEATER, *ids, engine=engine)


def test_a_run_is_looked_at(tmp_path: Path) -> None:
    run = rovercheck.trace(HEATER, "HEAT-3")
    assert "4 ticks of 20 ms" in str(run)
    assert run._repr_html_().startswith("<iframe srcdoc=")
    assert len(json.loads(run.write(tmp_path / "run.json").read_text())["states"]) == 4
    with pytest.raises(ModelError, match="no suffix of a format"):
        run.write(tmp_path / "run.docx")
    with pytest.raises(ModelError, match="no trace format 'docx'"):
        run.write(tmp_path / "run.docx", "docx")
    assert "<svg" in run.write(tmp_path / "run.txt", "svg").read_text()


def test_what_is_proved_has_no_run() -> None:
    with pytest.raises(rovercheck.NoTrace, match="HEAT-1 is proved and has no trace: explicit: all "):
        rovercheck.trace(HEATER, "HEAT-1")


def test_a_chart_is_a_picture(tmp_path: Path) -> None:
    chart = rovercheck.load(str(HEATER)).charts["Heater"]
    drawn = rovercheck.picture(chart)
    assert drawn._repr_html_().startswith("<svg") and "Pause" in drawn._repr_html_()
    assert drawn.write(str(tmp_path / "heater.dot")).read_text().startswith("digraph")


def test_the_rover_is_a_model_too() -> None:
    assert rovercheck.check(rovercheck.rover(), "PB1-11").as_expected


def test_a_notebook_says_what_is_wrong_with_what_it_made() -> None:
    lamp = rovercheck.flag("lamp")
    said = rovercheck.always("LAMP-1", "It shines.", that=lamp, covers=["R1"], on="lamp")
    with pytest.raises(ModelError, match="LAMP-1"):
        rovercheck.model(said)


def test_a_script_needs_no_guard_against_its_own_processes(tmp_path: Path) -> None:
    """Searches run in processes of their own, which do not run the script again."""
    script = tmp_path / "script.py"
    script.write_text(
        "from rovercheck import Chart, State, always, check, flag, implies, model, to\n"
        "key, on = flag('key'), flag('on')\n"
        "lamp = Chart('Lamp', [State('Off', transitions=[to('On', when=key)]), State('On')], default='Off')\n"
        "said = implies(lamp.active('Off'), ~key)\n"
        "lit = always('LIT', 'On needs the key.', that=said, covers=['R'], on='Lamp')\n"
        "print(check(model(lamp, lit)))\n"
    )
    done = subprocess.run(
        [sys.executable, str(script)], capture_output=True, text=True, timeout=120, check=True
    )
    assert done.stdout.startswith("LIT ") and done.stdout.count("\n") == 1


def test_the_page_is_true(tmp_path: Path) -> None:
    """Its blocks, one after the other as a script, in a folder with the model of ``rovercheck init``."""
    page = (Path(__file__).parents[2] / "docs" / "library.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
    assert len(blocks) == 3
    for file in START.iterdir():
        copy(file, tmp_path)
    (tmp_path / "page.py").write_text("\n".join(blocks), encoding="utf-8")
    command = [sys.executable, "page.py"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("HEAT-1 proved\nHEAT-2 proved\nHEAT-3 violated\nWhy: Only Pause waits")
    assert "\nHeater: 4 ticks" in done.stdout
    assert "\nLAMP-1 proved (" in done.stdout
    assert {"heat-3.html", "lamp.svg"} <= {file.name for file in tmp_path.iterdir()}


def test_a_rejected_proof_is_not_as_expected() -> None:
    found = rovercheck.check(HEATER, "HEAT-1")
    [one] = found
    rejected = replace(one.result, certificate=Rejected("consecution", "a state"))
    assert found.as_expected and not rovercheck.Results((replace(one, result=rejected),)).as_expected


def test_nothing_to_check_is_no_pass() -> None:
    chart = rovercheck.Chart("Lamp", [rovercheck.State("Off")], default="Off")
    dark = chart.active("Off")
    said = rovercheck.reachable("LAMP-1", "It is dark.", that=dark, covers=["R1"], on=chart)
    costly = rovercheck.model(chart, rovercheck.costly(said))
    with pytest.raises(ModelError, match="Nothing to check"):
        rovercheck.check(costly)
