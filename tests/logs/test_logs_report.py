"""The page and the Markdown of a campaign of logs: all logs are there, no name in them becomes markup."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.render.test_page import Reader

EXAMPLES = Path(__file__).parents[2] / "examples" / "logs"
EVIL = "<img src=x onerror=alert(1)>|\x1b[31m.csv"


def ran(arguments: list[str]) -> int:
    verb = Path(sys.executable).with_name("rovercheck")
    return subprocess.run([verb, *arguments], check=False).returncode


@pytest.fixture(scope="module")
def reports(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, str]:
    folder = tmp_path_factory.mktemp("campaign")
    for log in EXAMPLES.glob("*.csv"):
        shutil.copy(log, folder)
    (folder / EVIL).write_text("a,b\n1,2\n")
    html, markdown = folder / "page.html", folder / "page.md"
    assert ran(["check-log", str(folder), "--html", str(html), "--markdown", str(markdown)]) == 1
    return html.read_text(), markdown.read_text()


def test_every_log_is_told_and_no_name_is_markup(reports: tuple[str, str]) -> None:
    html, markdown = reports
    assert "<img" not in html and "<img" not in markdown and "\x1b" not in html + markdown
    assert not [
        a for _, a in Reader(html).elements if "src" in a or not (a.get("href") or "#").startswith("#")
    ]
    for name in ("good.csv", "faults.csv", "not read"):
        assert name in html and name in markdown


def test_each_finding_has_its_first_and_worst_place_and_a_timeline(reports: tuple[str, str]) -> None:
    html, markdown = reports
    assert re.search(r"- worst: faults\.csv: \d+ ticks from tick \d+", markdown)
    assert html.count("<figure>") >= 1 and 'class="differs"' in html


def test_a_place_that_cannot_be_written_is_told_before_any_log_is_read(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    assert ran(["check-log", str(EXAMPLES), "--html", str(tmp_path / "no" / "page.html")]) == 4
    assert "Cannot write" in capfd.readouterr().err
    assert not (tmp_path / "no").exists()
