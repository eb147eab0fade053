"""The page and the Markdown of a campaign of logs: all logs are there, no name in them becomes markup."""

import json
import os
import re
import shutil
import subprocess
import sys
from errno import ENOSPC
from html import unescape as html_unescape
from pathlib import Path
from typing import NamedTuple

import pytest
from jsonschema import validate

from rovercheck.checker.cli import run
from rovercheck.checker.commands.check_log.campaign import LogCampaign
from rovercheck.checker.commands.check_log.report import LogReport
from rovercheck.checker.commands.shared.logs import column_map
from rovercheck.checker.logs import examine
from rovercheck.checker.render.campaign import campaign_page
from rovercheck.checker.render.campaign.markdown import campaign_markdown
from tests.render.test_exits_ci import valid
from tests.render.test_page import Reader
from tests.schemas import published

EXAMPLES = Path(__file__).parents[2] / "examples" / "logs"
EVIL = "<img src=x onerror=alert(1)>|\x1b[31m.csv"


class Reports(NamedTuple):
    """The texts of the files that a campaign wrote."""

    html: str
    markdown: str
    sarif: str


def ran(arguments: list[str]) -> int:
    return subprocess.run([sys.executable, "-m", "rovercheck", *arguments], check=False).returncode


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> Reports:
    folder = tmp_path_factory.mktemp("campaign")
    for log in EXAMPLES.glob("*.csv"):
        shutil.copy(log, folder)
    (folder / EVIL).write_text("a,b\n1,2\n")
    html, markdown, sarif = folder / "page.html", folder / "page.md", folder / "page.sarif"
    files = ["--html", str(html), "--markdown", str(markdown), "--sarif", str(sarif)]
    assert ran(["check-log", str(folder), *files]) == 1
    return Reports(html.read_text(), markdown.read_text(), sarif.read_text())


def test_every_log_is_told_and_no_name_is_markup(reports: Reports) -> None:
    html, markdown, _ = reports
    assert "<img" not in html and "<img" not in markdown and "\x1b" not in html + markdown
    assert not [
        a for _, a in Reader(html).elements if "src" in a or not (a.get("href") or "#").startswith("#")
    ]
    for name in ("good.csv", "faults.csv", "not read"):
        assert name in html and name in markdown


def test_each_finding_has_its_first_and_worst_place_and_a_timeline(reports: Reports) -> None:
    html, markdown, _ = reports
    assert re.search(r"- worst: faults\.csv: \d+ ticks from tick \d+", markdown)
    assert html.count("<figure>") >= 1 and 'class="differs"' in html


def test_each_finding_is_a_result_at_the_line_of_its_log(reports: Reports) -> None:
    found = valid(reports.sarif)
    assert {r["ruleId"] for r in found["results"]} == {"deviation", "broken-property"}
    for result in found["results"]:
        [at] = result["locations"]
        uri, line = at["physicalLocation"]["artifactLocation"]["uri"], at["physicalLocation"]["region"]
        assert uri.endswith("/faults.csv") and f", line {line['startLine']}." in result["message"]["text"]
    prints = [r["partialFingerprints"]["rovercheckFinding/v1"] for r in found["results"]]
    assert len(set(prints)) == len(prints)
    [invocation] = found["invocations"]
    assert not invocation["executionSuccessful"]  # one log is none
    assert any(n["level"] == "error" for n in invocation["toolExecutionNotifications"])


def test_the_document_says_what_the_page_shows_and_each_tick_is_of_one_finding(
    reports: Reports, capfd: pytest.CaptureFixture[str]
) -> None:
    assert ran(["check-log", str(EXAMPLES), "--json"]) == 1
    document = json.loads(capfd.readouterr().out)
    validate(document, published("conform-1"))
    campaign, drawn = document["campaign"], 0
    seen: set[tuple[str, int]] = set()
    for finding in campaign["findings"]:
        assert finding["says"] in html_unescape(reports.html)
        for lane in finding["timeline"]:
            here = {(lane["output"], m["tick"]) for m in lane["moments"] if m["differs"] == "here"}
            drawn += len(here)
            assert not here & seen
            seen |= here
        ticks = {m["tick"] for lane in finding["timeline"] for m in lane["moments"] if m["differs"] == "here"}
        assert finding["kind"] == "property" or finding["first"]["tick"] in ticks
    lanes = [lane for finding in campaign["findings"] for lane in finding["timeline"]]
    other = any(moment["differs"] == "other" for lane in lanes for moment in lane["moments"])
    assert drawn > len(campaign["findings"]) and ('class="other"' in reports.html) == other
    [faults] = [r for r in campaign["recordings"] if r["name"] == "faults.csv"]
    assert faults["not_compared"] and faults["state"] == "deviates"


def test_a_log_that_is_gone_when_it_is_drawn_has_no_timeline_and_that_is_said(tmp_path: Path) -> None:
    log = tmp_path / "faults.csv"
    shutil.copy(EXAMPLES / "faults.csv", log)
    how = column_map(None)
    found = examine(log, how, "", None, False)
    log.unlink()
    record = LogReport({log.name: found}, LogCampaign([found]), tmp_path, how).record()
    deviations = [f for f in record.findings if f.kind == "deviation"]
    assert deviations and all(not f.lanes and "could not be read again" in f.undrawn for f in deviations)
    for text in (campaign_page(record), campaign_markdown(record)):
        assert "No timeline" in text


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a device that is always full")
@pytest.mark.parametrize("option", ["--html", "--markdown", "--sarif"])
def test_a_full_disk_is_one_message_after_the_results(option: str, capfd: pytest.CaptureFixture[str]) -> None:
    assert ran(["check-log", str(EXAMPLES / "faults.csv"), option, "/dev/full"]) == 2
    printed = capfd.readouterr()
    assert "faults.csv" in printed.out
    assert printed.err.splitlines()[-1].startswith("Cannot write /dev/full: No space left on device.")


def test_on_a_disk_that_fills_the_old_page_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = tmp_path / "page.html"
    page.write_text("the old one")

    def full(fd: int, mode: int) -> None:
        raise OSError(ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "chmod", full)  # what a write does last before it takes the place of the old one
    assert run(["check-log", str(EXAMPLES / "faults.csv"), "--html", str(page)]) == 2
    assert page.read_text() == "the old one" and list(tmp_path.iterdir()) == [page]


def test_a_place_that_cannot_be_written_is_told_before_any_log_is_read(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert ran(["check-log", str(EXAMPLES), "--html", str(tmp_path / "no" / "page.html")]) == 4
    assert "Cannot write" in capfd.readouterr().err
    assert not (tmp_path / "no").exists()
