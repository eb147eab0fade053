"""One violated property of the rover in every exit: each is taken by what reads it."""

import csv
import json
import os
import subprocess
import sys
from dataclasses import replace
from functools import cache
from io import StringIO
from pathlib import Path

import pytest

from checker.cli import run
from checker.commands.check import results
from checker.commands.codes import Exit
from checker.commands.concrete import concrete
from checker.commands.exits import exit_written
from checker.decide import AUTO
from checker.engine import Limits
from checker.render import renderers
from checker.trace import Trace
from checker.verdict import Violated
from properties.catalogue import catalogue
from spec_model.lang.errors import ModelError
from spec_model.rover import systems
from tests.render.zoo import long_trace

ROOT = Path(__file__).parents[2]
STUCK = '''
class Stuck:
    """Never gives the actuation away."""

    def step(self, inputs):
        return {"give_b2_actuation": False}
'''


@cache
def pb1_15() -> Trace:
    """Board 2 has the actuation although all is well, in the eighth tick."""
    [result] = results([catalogue()["PB1-15"]], systems(), AUTO, Limits())
    assert isinstance(result.verdict, Violated) and isinstance(result.verdict.because, Trace)
    return result.verdict.because


@pytest.mark.parametrize("name", renderers("trace"))
def test_every_exit_shows_a_run_of_the_rover(name: str, tmp_path: Path) -> None:
    renderer = renderers("trace")[name]
    file = tmp_path / f"run{renderer.SUFFIX}"
    exit_written(renderer, pb1_15(), systems(), file)
    shown = file.read_bytes().decode()
    assert "Relay" in shown or "give_b2_actuation" in shown


def test_the_dump_lies_beside_its_save_file(tmp_path: Path) -> None:
    [beside] = exit_written(renderers("trace")["gtkw"], pb1_15(), systems(), tmp_path / "run.gtkw")
    assert beside == tmp_path / "run.vcd" and "$enddefinitions" in beside.read_text(encoding="utf-8")
    assert '[dumpfile] "run.vcd"' in (tmp_path / "run.gtkw").read_text(encoding="utf-8")
    [other] = exit_written(renderers("trace")["gtkw"], pb1_15(), systems(), tmp_path / "odd.vcd")
    assert other == tmp_path / "odd.vcd.vcd", "never the file itself"


def test_the_code_flow_leads_to_the_lines_of_the_charts(tmp_path: Path) -> None:
    exit_written(renderers("trace")["sarif"], pb1_15(), systems(), tmp_path / "run.sarif")
    [result] = json.loads((tmp_path / "run.sarif").read_text(encoding="utf-8"))["runs"][0]["results"]
    steps = result["codeFlows"][0]["threadFlows"][0]["locations"]
    for step in steps:
        place = step["location"]["physicalLocation"]
        lines = (ROOT / place["artifactLocation"]["uri"]).read_text(encoding="utf-8").splitlines()
        written = lines[place["region"]["startLine"] - 1]
        assert any(word in written for word in ("to(", "Chart(", "always(")), written


def test_the_table_of_ticks_ends_where_the_property_breaks(tmp_path: Path) -> None:
    exit_written(renderers("trace")["csv"], pb1_15(), systems(), tmp_path / "run.csv")
    rows = list(csv.DictReader(StringIO((tmp_path / "run.csv").read_text(encoding="utf-8"))))
    assert [r["give_b2_actuation"] for r in rows[-3:]] == ["false", "true", "true"]
    assert (rows[-1]["time_ms"], rows[-1]["rx_status"]) == ("160", "RX_OK")


def test_the_pytest_file_runs_by_itself(tmp_path: Path) -> None:
    file = tmp_path / "test_pb1_15.py"
    exit_written(renderers("trace")["pytest"], pb1_15(), systems(), file)
    (tmp_path / "stuck.py").write_text(STUCK, encoding="utf-8")
    assert "1 passed" in said_by_pytest(file, {})
    said = said_by_pytest(file, {"ROVERCHECK_IMPL": f"python:{tmp_path / 'stuck.py'}:Stuck"})
    assert "step 7 (140 ms), output: (required, actual) {'give_b2_actuation': (True, False)}" in said


def said_by_pytest(file: Path, more: dict[str, str]) -> str:
    """What pytest says of a file, away from this project's own configuration."""
    command = [sys.executable, "-m", "pytest", "-q", "-c", os.devnull, "-p", "no:cacheprovider", str(file)]
    environment = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", **more}
    found = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=file.parent, env=environment
    )
    return found.stdout


def test_the_concrete_run_is_that_of_the_board() -> None:
    [one] = concrete(pb1_15(), systems()["board1"]).concrete
    assert (one.board, len(one.steps)) == ("board1", 8)
    assert [s.outputs["give_b2_actuation"] for s in one.steps] == [False] * 6 + [True] * 2
    assert [s.inputs["last_valid_b2_ms"] for s in one.steps] == [None] * 7 + [0], "one heartbeat, in the end"


def test_why_a_run_cannot_be_given_to_a_supervisor() -> None:
    known = systems()
    fine = next(s for s in known.values() if s.tick_ms != 20)
    with pytest.raises(ModelError, match=r"advances by 1 ms.*cannot be given to one\. The run can"):
        concrete(replace(long_trace(1), system=fine.name), fine)
    bare = replace(known["relay"], name="bare", components=())
    with pytest.raises(ModelError, match="executes no chart and no block of a board"):
        concrete(replace(long_trace(1), system="bare"), bare)
    with pytest.raises(ModelError, match="Nothing of what PB1-15 depends on is computed by board1"):
        concrete(replace(pb1_15(), relevant=frozenset()), known["board1"])
    at = pb1_15().ticks[6]
    other = replace(at, after={**at.after, "give_b2_actuation": 0})
    forged = replace(pb1_15(), ticks=(*pb1_15().ticks[:6], other))
    with pytest.raises(ModelError, match="in tick 7 give_b2_actuation is false there, and true when"):
        concrete(forged, known["board1"])


def test_a_format_that_is_none_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["trace", "PB1-15", "--format", "gtkv"]) == Exit.USAGE
    assert "gtkw" in capsys.readouterr().err
