"""``report --pdf``: the page printed by a real Chromium, with page numbers; clear words without one."""

import os
import re
import sys
from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.report import run as reviewing
from rovercheck.checker.commands.report.pdf import pages_of, printed, with_pages
from rovercheck.checker.commands.shared.codes import Exit, UsageError
from rovercheck.checker.render.review import render
from tests.chromium import chromium
from tests.render.toy_review import review


def test_a_page_is_printed_with_the_numbers_of_its_pages(tmp_path: Path) -> None:
    if chromium() is None:
        pytest.skip("No Chromium is installed.")
    page, file = tmp_path / "page.html", tmp_path / "page.pdf"
    page.write_text(render(review()), encoding="utf-8")
    printed(page, file)
    document = file.read_bytes()
    pages = pages_of(document)
    assert document.startswith(b"%PDF-") and b"/Outlines" in document
    assert pages["section-cover"] == 1 and pages["section-summary"] == 2
    places = [pages[f"section-{name}"] for name in ("findings", "requirements", "charts", "making")]
    assert places == sorted(set(places))
    assert {file.name for file in tmp_path.iterdir()} == {"page.html", "page.pdf"}


def test_the_contents_name_the_pages() -> None:
    plain = render(review())
    shown = with_pages(plain, {"section-findings": 7})
    assert '<span class="page-number" data-of="section-findings">7</span>' in shown
    assert re.sub(r'(data-of="section-findings">)7', r"\1", shown) == plain


def test_of_another_file_no_pages_are_told() -> None:
    assert pages_of(b"") == pages_of(b"%PDF-1.7\n1 0 obj\n<</Type /ObjStm>>\nendobj\n") == {}


def test_without_a_chromium_it_is_said_before_anything_is_searched(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(reviewing, "results", None)
    asked = ["report", "PB1-15", "-o", str(tmp_path / "x.html"), "--pdf", str(tmp_path / "x.pdf")]
    monkeypatch.setenv("CHROMIUM", str(tmp_path / "none"))
    assert run(asked) == Exit.USAGE
    assert "none is no program" in capsys.readouterr().err
    monkeypatch.delenv("CHROMIUM")
    monkeypatch.setenv("PATH", str(tmp_path))
    assert run(asked) == Exit.USAGE
    assert "apt install chromium" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_what_the_browser_says_is_passed_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program = tmp_path / "chromium"
    program.write_text(f"#!{sys.executable}\nimport sys\nsys.exit('no room for a page')\n", encoding="utf-8")
    os.chmod(program, 0o755)
    monkeypatch.setenv("CHROMIUM", str(program))
    page, file = tmp_path / "page.html", tmp_path / "page.pdf"
    page.write_text("<p>", encoding="utf-8")
    with pytest.raises(UsageError, match="no room for a page"):
        printed(page, file)
    assert not file.exists()
