"""The files that ``compare`` writes: page, Markdown, SARIF, and the same in JSON."""

import json
import re
from collections.abc import Callable
from contextlib import redirect_stdout
from dataclasses import dataclass
from datetime import date
from functools import cache
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from jsonschema import validate

from rovercheck.checker.cli import run
from rovercheck.checker.commands.compare.places import ImplementationPlaces
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.compare.variants import of_model
from rovercheck.checker.model.load import load
from tests.model_files.files import FIRMWARE, heater_files
from tests.render.test_exits_ci import valid
from tests.render.test_page import Reader
from tests.schemas import published

CRASH = """

class Crash(Hot):
    def step(self, given):
        if given["temperature"] > 23 and given["door_open"]:
            raise ValueError("<img src=x onerror=alert(1)>")
        return super().step(given)
"""
IN_C = """\
#include "heater.h"
static int state, steps;
Out rtY;
In rtU;
static void turn(int to) { state = to; steps = 0; }
void heater_step(void) {
  steps++;
  if (state == 0) turn(1);
  else if (state == 1 && rtU.warm < 18 && !rtU.door) turn(2);
  else if (state == 2 && (rtU.door || rtU.warm > 25)) turn(1);
  else if (state == 2 && steps >= 500) turn(3);
  else if (state == 3 && steps >= 250) turn(1);
  rtY.on = (state == 2);
  rtY.state = state;
}
void heater_start(void) { state = steps = 0; }
"""
HEADER = """\
typedef struct { double warm; int door; } In;
typedef struct { int on; int state; } Out;
extern In rtU;
extern Out rtY;
void heater_step(void);
void heater_start(void);
"""
MAP = """\
header = "heater.h"
initialize = "heater_start"
step = "heater_step"
[inputs]
temperature = "rtU.warm"
door_open = "rtU.door"
[outputs]
heating = "rtY.on"
Heater = "rtY.state"
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("reports")
    heater_files(found, FIRMWARE + CRASH)
    (found / "c").mkdir()
    (found / "c" / "heater.c").write_text(IN_C, encoding="utf-8")
    (found / "c" / "heater.h").write_text(HEADER, encoding="utf-8")
    (found / "c" / "map.toml").write_text(MAP, encoding="utf-8")
    return found


def compare(folder: Path, impl: str, *more: str) -> Exit:
    model = str(folder / "heater.py")
    short = ("--examples", "3", "--mismatches", "0", "-o", str(folder))
    return run(["compare", "--model", model, "--impl", impl, *short, *more])


@dataclass(frozen=True)
class Reports:
    """What one comparison wrote."""

    html: str
    markdown: str
    sarif: str
    campaign: Any

    @property
    def results(self) -> Any:
        """The results of the SARIF file, which its schema accepts."""
        return valid(self.sarif)["results"]


Told = Callable[..., Reports]


@pytest.fixture(scope="module")
def told(folder: Path) -> Told:
    """All that a comparison writes; the same one is made once."""

    def reports(impl: str, *more: str) -> Reports:
        files = {name: folder / f"report.{name}" for name in ("html", "markdown", "sarif")}
        asked = [word for name, file in files.items() for word in (f"--{name}", str(file))]
        with redirect_stdout(StringIO()) as printed:
            compare(folder, impl, "--json", *more, *asked)
        found = json.loads(printed.getvalue())
        validate(found, published("crosscheck-1"))
        texts = {name: file.read_text(encoding="utf-8") for name, file in files.items()}
        return Reports(**texts, campaign=found["campaign"])

    return cache(reports)


def test_first_worst_expected_and_given_and_the_cause_are_in_every_file(folder: Path, told: Told) -> None:
    found = told(f"python:{folder / 'firmware.py'}:Hot", "--causes")
    [finding] = found.campaign["findings"]
    assert "with a limit of" in finding["cause"] and finding["word"] == "new"
    for text in (found.html, found.markdown, found.sarif):
        assert finding["says"].split(",")[0].partition(": ")[2] in text.replace("\\_", "_")
        assert "with a limit of" in text
        assert f"step {finding['first']['tick']}" in text
    [result] = found.results
    assert result["level"] == "error" and "suppressions" not in result
    assert 'class="differs"' in found.html and "✗ true" in found.html
    assert {lane["output"] for lane in finding["timeline"]} == {"heating", "Heater"}
    shown = {r["name"] for r in found.campaign["recordings"]}
    assert shown >= {finding[at]["recording"] for at in ("first", "worst")}


def test_the_timeline_is_that_of_the_run_in_which_the_finding_is_first(folder: Path, told: Told) -> None:
    """Several fixed runs have one name; what is shown differs in the very step that is named."""
    campaign = told(f"python:{folder / 'firmware.py'}:HotAndBrief").campaign
    assert len(campaign["findings"]) == 2
    for finding in campaign["findings"]:
        for lane in finding["timeline"]:
            here = [m for m in lane["moments"] if m["differs"] == "here"]
            assert here[0]["tick"] == finding["first"]["tick"]
            assert all(m["expected"] != m["recorded"] for m in here)
            assert all(m["expected"] in ("", m["recorded"]) for m in lane["moments"] if not m["differs"])


def test_a_run_that_is_not_survived_is_a_finding_and_what_it_says_no_markup(folder: Path, told: Told) -> None:
    found = told(f"python:{folder / 'firmware.py'}:Crash")
    assert not [tag for tag, _ in Reader(found.html).elements if tag == "img"]
    assert "<img" not in found.markdown
    rules = {r["ruleId"] for r in found.results}
    assert "no-answer" in rules
    assert "not survived" in found.html and "does not answer as it must" in found.markdown


def test_an_implementation_that_conforms_has_a_page_without_findings(folder: Path, told: Told) -> None:
    found = told(f"python:{folder / 'firmware.py'}:Heater")
    assert found.results == []
    assert "nothing deviates" in found.html and "All was read and compared." in found.html


def test_a_known_finding_is_a_suppressed_note_with_the_fingerprint_of_the_new_one(
    folder: Path, told: Told
) -> None:
    impl, known = f"python:{folder / 'firmware.py'}:Hot", folder / "known.toml"
    [new] = told(impl, "--write-known", str(known)).results
    text = known.read_text(encoding="utf-8")
    drawn = [one for one in re.split(r"\n(?=\[\[)", text) if "\nwith_causes" not in one]
    text = re.sub('to = "temperature [^"]*"', 'to = "temperature > 25"', "\n".join(drawn))
    reason, owner = 'reason = "agreed in review 12"', 'owner = "Ada"'
    text = re.sub("(?m)^reason = .*$", reason, re.sub("(?m)^owner = .*$", owner, text))
    [id] = re.findall('(?m)^id = "(.*)"$', text)
    assert text.count(f'"{id}"') == 2, "of the deviation, and in its cause"
    text = text.replace(f'"{id}"', '"renamed"')
    known.write_text(re.sub("(?m)^until = .*$", 'until = "never"', text), encoding="utf-8")
    found = told(impl, "--known", str(known))
    [result] = found.results
    assert result["level"] == "note"
    [suppressed] = result["suppressions"]
    assert suppressed["justification"] == "agreed in review 12"
    assert result["partialFingerprints"] == new["partialFingerprints"]
    assert "agreed in review 12; Ada" in found.markdown and "1 known" in found.html
    over = date(2020, 1, 1).isoformat()
    known.write_text(known.read_text().replace('until = "never"', f"until = {over}"), encoding="utf-8")
    [expired] = told(impl, "--known", str(known), "-q").results
    assert expired["level"] == "warning" and "suppressions" not in expired


def test_a_finding_leads_to_the_line_of_c_that_assigns_the_output(folder: Path, told: Told, cc: str) -> None:
    [result] = told(f"c:{folder / 'c'}").results
    at = [one["physicalLocation"] for one in (*result["locations"], *result["relatedLocations"])]
    named = {(one["artifactLocation"]["uri"].rpartition("/")[2], one["region"]["startLine"]) for one in at}
    lines = IN_C.splitlines()
    assert named == {("heater.c", n) for n, line in enumerate(lines, 1) if line.strip().startswith("rtY.")}


def test_without_such_a_line_it_leads_to_the_map_and_without_a_map_nowhere(folder: Path) -> None:
    board = of_model(load(folder / "heater.py"))
    elsewhere = folder / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "empty.c").write_text("int nothing;\n", encoding="utf-8")
    address = f"c:{elsewhere},map={folder / 'c' / 'map.toml'}"
    [place] = ImplementationPlaces(address, board).of(["heating"])
    assert place.file.endswith("map.toml")
    assert MAP.splitlines()[place.line - 1].startswith("heating")
    [place] = ImplementationPlaces(f"python:{folder / 'firmware.py'}:Hot", board).of(["heating"])
    assert (FIRMWARE + CRASH).splitlines()[place.line - 1].startswith("class Hot(")
    for address in ("command:./sup", f"c:{elsewhere}", "python:some.module:Hot"):
        assert ImplementationPlaces(address, board).of(["heating"]) == ()


@pytest.mark.parametrize("option", ["--html", "--markdown", "--sarif"])
def test_a_place_that_cannot_be_written_is_told_before_anything_runs(
    folder: Path, tmp_path: Path, option: str, capsys: pytest.CaptureFixture[str]
) -> None:
    impl = f"python:{folder / 'firmware.py'}:Hot"
    assert compare(folder, impl, option, str(tmp_path / "no" / "file")) == Exit.USAGE
    captured = capsys.readouterr()
    assert "Cannot write" in captured.err and "random runs" not in captured.out


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
def test_a_full_disk_is_one_message_after_the_results(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    impl = f"python:{folder / 'firmware.py'}:Hot"
    assert compare(folder, impl, "--html", "/dev/full") == Exit.INCONCLUSIVE
    captured = capsys.readouterr()
    assert "does not conform" in captured.out
    assert captured.err.splitlines()[-1].startswith("Cannot write /dev/full: No space left on device.")
