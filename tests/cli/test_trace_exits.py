"""One violated property of the rover in every exit: each is taken by what reads it."""

import csv
import json
import os
import re
import subprocess
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from io import StringIO
from pathlib import Path
from xml.etree import ElementTree

import pytest
from jsonschema import validate
from markdown_it import MarkdownIt

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.verdicts import results
from rovercheck.checker.commands.trace.board_steps import concrete
from rovercheck.checker.commands.trace.formats import exit_written
from rovercheck.checker.commands.trace.run import TraceDisplay
from rovercheck.checker.render import renderers, trace_itf
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Violated
from rovercheck.properties.catalogue import catalogue
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.rover import systems
from tests.render.test_exits_ci import cases, commands, locations, valid
from tests.render.test_exits_data import VCDVCD, dumped
from tests.render.zoo import long_trace
from tests.schemas import published
from tests.traces import changed

ROOT = Path(__file__).parents[2]
BOARD_C = """
#include RUN
#include "sup_b1.h"

void reset(void) { sup_b1_initialize(); }
void set_inputs(const struct inputs *in)
{
    rtU.now_ms = in->now_ms;
    rtU.last_valid_b2_ms = in->last_valid_b2_ms;
    rtU.board2.data_last_valid_ms = in->b2_data_last_valid_ms;
    rtU.board2.critical_mask = (uint8_T)in->crit_mask_b2;
    rtU.board2.degraded_mask = (uint8_T)in->degr_mask_b2;
    rtU.board2.isMotionConsistent = in->isMotionConsistent;
    rtU.health.temperature_degC = in->temperature_degC;
    rtU.health.battery_pct = in->battery_pct;
    rtU.health.temp_last_valid_ms = in->temp_last_valid_ms;
    rtU.health.batt_last_valid_ms = in->batt_last_valid_ms;
}
void step(void) { sup_b1_step(); }
void get_outputs(struct outputs *out)
{
    out->critical_mask = rtY.critical_mask;
    out->degraded_mask = rtY.degraded_mask;
    out->give_b2_actuation = rtY.give_b2_actuation && !STUCK;
    out->b2_critical = rtY.b2_critical;
    out->b2_degraded = rtY.b2_degraded;
    out->rover_safety_state = rtY.rover_safety_state;
    out->temp_status = rtY.temp_status;
    out->batt_status = rtY.batt_status;
    out->b2_sup_status = rtY.b2_sup_status;
    out->rx_status = rtY.rx_status;
}
"""
"""The supervisor of the examples in the four functions; the outputs that it lacks stay 0 in this run."""
STUCK = '''
class Stuck:
    """Never gives the actuation away."""

    def step(self, inputs):
        return {"give_b2_actuation": False}
'''


@cache
def pb1_15() -> Trace:
    """Board 2 has the actuation although all is well, in the eighth tick."""
    [result] = results([catalogue()["PB1-15"]], systems())
    assert isinstance(result.verdict, Violated) and isinstance(result.verdict.because, Trace)
    return result.verdict.because


def written(name: str, folder: Path) -> Path:
    """The run in a format, as ``rovercheck trace --format NAME --output FILE`` writes it."""
    file = folder / f"run{renderers('trace')[name].FORMAT.suffix}"
    exit_written(renderers("trace")[name], TraceDisplay(name).cut(pb1_15()), systems(), file)
    return file


def text(file: Path) -> str:
    return file.read_bytes().decode()


# --- what reads each format; a failed assertion, or an error of the reader, is a file not accepted --------


def terminal(file: Path) -> None:
    assert max(map(len, text(file).splitlines())) <= 80


def markdown(file: Path) -> None:
    """The parser of rich and others, with the tables of GitHub."""
    kinds = Counter(token.type for token in MarkdownIt().enable("table").parse(text(file)))
    assert kinds["table_open"] == 1 and kinds["tr_open"] == 5, "a head, three events, a quiet stretch"


def waves(file: Path) -> None:
    """Two readers of value change dumps."""
    found = dumped(text(file))
    assert found["property.violated"] == {0: "0", 160: "1"}
    assert found["values.b2_sup_status"] == {0: "SUP_OK", 140: "SUP_CRITICAL", 160: "SUP_OK"}
    assert dict(VCDVCD(str(file))["property.violated"].tv) == {0: "0", 160: "1"}


def save_file(file: Path) -> None:
    """It names a dump beside it, and signals of that dump, all of them once."""
    [named] = re.findall(r'\[dumpfile\] "(.*)"', text(file))
    shown = [line for line in text(file).splitlines() if re.fullmatch(r"[a-z]+\..+", line)]
    assert sorted(shown) == sorted(VCDVCD(str(file.parent / named)).signals)


def spreadsheet(file: Path) -> None:
    rows = list(csv.DictReader(StringIO(text(file), newline="")))
    assert [r["give_b2_actuation"] for r in rows[-3:]] == ["false", "true", "true"]
    assert (rows[-1]["time_ms"], rows[-1]["rx_status"]) == ("160", "RX_OK")


def published_json(file: Path) -> None:
    found = json.loads(text(file))
    validate(found, published("trace-3"))
    assert (
        found["#meta"]["property"] == "PB1-15" and found["#meta"]["violated"] and found["#meta"]["shortest"]
    )


def trace_viewer(file: Path) -> None:
    """The format as its description has it."""
    found = json.loads(text(file))
    validate(found, trace_itf.SCHEMA)
    assert found["states"][8]["b2_sup_status"] == "SUP_OK" and found["states"][8]["give_b2_actuation"] is True


def code_scanning(file: Path) -> None:
    """The official schema; each step of the code flow leads to a line that holds what it says."""
    [result] = valid(text(file))["results"]
    for step in locations(result):
        place = step["location"]["physicalLocation"]
        lines = (ROOT / place["artifactLocation"]["uri"]).read_text(encoding="utf-8").splitlines()
        there = lines[place["region"]["startLine"] - 1]
        assert any(word in there for word in ("to(", "Chart(", "always(")), there


def build_server(file: Path) -> None:
    [case] = cases(text(file)).values()
    assert case.name == "PB1-15" and "Relay: B1_actuating → B2_actuating" in case.result[0].text


def workflow(file: Path) -> None:
    [(kind, shown, message)] = commands(text(file))
    assert (kind, shown["file"]) == ("error", "properties/areas/relay.py")
    assert message.endswith("Show it: rovercheck trace PB1-15")


def pytest_itself(file: Path) -> None:
    (file.parent / "stuck.py").write_text(STUCK, encoding="utf-8")
    assert "1 passed" in said_by_pytest(file, {})
    said = said_by_pytest(file, {"ROVERCHECK_IMPL": f"python:{file.parent / 'stuck.py'}:Stuck"})
    assert "step 7 (140 ms), output: (required, actual) {'give_b2_actuation': (True, False)}" in said


def said_by_pytest(file: Path, more: dict[str, str]) -> str:
    """What pytest says of a file, away from this project's own configuration."""
    command = [sys.executable, "-m", "pytest", "-q", "-c", os.devnull, "-p", "no:cacheprovider", str(file)]
    environment = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", **more}
    found = subprocess.run(
        command, capture_output=True, text=True, check=False, cwd=file.parent, env=environment
    )
    return found.stdout


def compiler(file: Path) -> None:
    """The C supervisor of the examples passes; one that never gives the actuation away differs."""
    example = ROOT / "examples" / "board1_c"
    (file.parent / "board.c").write_text(BOARD_C, encoding="utf-8")
    flags = ["-std=c99", "-Wall", "-Werror", f"-I{example}", f'-DRUN="{file.name}"']
    for stuck, said in (("0", "board1: 1 of 1 tests passed"),
                        ("1", "in PB1-15 at 140 ms")):  # fmt: skip
        sources = ["board.c", str(example / "sup_b1.c")]
        subprocess.run(
            ["cc", *flags, f"-DSTUCK={stuck}", *sources, "-o", "run", "-lm"], cwd=file.parent, check=True
        )
        found = subprocess.run([str(file.parent / "run")], capture_output=True, text=True, check=False)
        assert found.returncode == int(stuck) and said in found.stdout


def picture(file: Path) -> None:
    """XML, as every viewer of SVG wants it; Chromium opens it in tests/browser/test_exits.py."""
    root = ElementTree.fromstring(text(file))
    assert root.tag == "{http://www.w3.org/2000/svg}svg" and "PB1-15" in root.itertext()


def web_page(file: Path) -> None:
    """One file that loads nothing; Chromium opens it in tests/browser/test_exits.py."""
    assert text(file).startswith("<!doctype html>") and "PB1-15" in text(file)
    assert not re.search(r"(src|href)=.?https?:", text(file))


READERS: dict[str, Callable[[Path], None]] = {
    "table": terminal, "markdown": markdown, "html": web_page, "svg": picture, "sequence": picture,
    "play": web_page, "vcd": waves, "gtkw": save_file, "csv": spreadsheet, "json": published_json,
    "itf": trace_viewer, "sarif": code_scanning, "junit": build_server, "github": workflow,
    "pytest": pytest_itself, "c": compiler,
}  # fmt: skip


def test_every_exit_has_a_reader() -> None:
    assert READERS.keys() == renderers("trace").keys()


@pytest.mark.parametrize("name", READERS)
def test_every_exit_is_taken_by_what_reads_it(name: str, tmp_path: Path) -> None:
    READERS[name](written(name, tmp_path))


def test_the_dump_lies_beside_its_save_file(tmp_path: Path) -> None:
    [beside] = exit_written(renderers("trace")["gtkw"], pb1_15(), systems(), tmp_path / "run.gtkw")
    assert beside == tmp_path / "run.vcd" and "$enddefinitions" in beside.read_text(encoding="utf-8")
    assert '[dumpfile] "run.vcd"' in (tmp_path / "run.gtkw").read_text(encoding="utf-8")
    [other] = exit_written(renderers("trace")["gtkw"], pb1_15(), systems(), tmp_path / "odd.vcd")
    assert other == tmp_path / "odd.vcd.vcd", "never the file itself"


def test_the_concrete_run_is_that_of_the_board() -> None:
    [one] = concrete(pb1_15(), systems()["board1"]).concrete
    assert (one.board.name, len(one.steps)) == ("board1", 8)
    assert [s.outputs["give_b2_actuation"] for s in one.steps] == [False] * 6 + [True] * 2
    beats = [s.inputs["last_valid_b2_ms"] for s in one.steps]
    assert beats == [0] * 7 + [one.steps[-1].inputs["now_ms"]], "one heartbeat, in the end"


def test_why_a_run_cannot_be_given_to_a_supervisor() -> None:
    known = systems()
    fine = next(s for s in known.values() if s.tick_ms != 20)
    with pytest.raises(ModelError, match=r"advances by 1 ms.*cannot be given to one\. The run can"):
        concrete(changed(long_trace(1), name=fine.name), fine)
    bare = replace(known["relay"], name="bare", components=())
    with pytest.raises(ModelError, match="executes no chart and no block of a board"):
        concrete(changed(long_trace(1), name="bare"), bare)
    with pytest.raises(ModelError, match="Nothing of what PB1-15 depends on is computed by board1"):
        concrete(changed(pb1_15(), relevant=frozenset()), known["board1"])
    at = pb1_15().ticks[6]
    other = replace(at, after={**at.after, "give_b2_actuation": 0})
    forged = replace(pb1_15(), ticks=(*pb1_15().ticks[:6], other))
    with pytest.raises(ModelError, match="in tick 7 give_b2_actuation is false there, and true when"):
        concrete(forged, known["board1"])


def test_a_format_that_is_none_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["trace", "PB1-15", "--format", "gtkv"]) == Exit.USAGE
    assert "gtkw" in capsys.readouterr().err
