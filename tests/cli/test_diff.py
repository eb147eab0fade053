"""Verdicts of two revisions beside each other: ``diff``, and ``check --changed``."""

import json
import subprocess
from collections.abc import Sequence
from pathlib import Path

import jsonschema
import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.diff.document import VerdictChange, changes, code
from rovercheck.checker.commands.diff.text import markdown, text
from rovercheck.checker.commands.shared.codes import Exit
from tests.schemas import published


def git(folder: Path, *words: str) -> None:
    who = ["-c", "user.name=somebody", "-c", "user.email=somebody@example.org"]
    subprocess.run(["git", "-C", str(folder), *who, *words], check=True, capture_output=True)


@pytest.fixture
def heater(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Path:
    """The model that ``init`` writes, committed."""
    assert run(["init", str(tmp_path / "heater")]) is Exit.AS_EXPECTED
    monkeypatch.chdir(tmp_path)
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", "-A")
    git(tmp_path, "commit", "-q", "-m", "as written")
    capsys.readouterr()
    return tmp_path / "heater" / "heater.py"


def said(words: Sequence[str], capsys: pytest.CaptureFixture[str], code: Exit) -> tuple[str, str]:
    assert run(list(words)) is code
    shown = capsys.readouterr()
    return shown.out, shown.err


def edit(file: Path, old: str, new: str) -> None:
    before = file.read_text(encoding="utf-8")
    assert old in before
    file.write_text(before.replace(old, new), encoding="utf-8")


def test_an_edit_that_breaks_a_property_is_worse_and_its_run_is_shown(
    heater: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    edit(heater, "door_open | (temperature > 22)", "temperature > 22")
    shown, _ = said(["diff", "HEAD", "--model", str(heater)], capsys, Exit.FAILED)
    assert "Worse:" in shown and "HEAT-1" in shown and "proved → violated in" in shown
    assert "The shortest new run:" in shown and "Heater: " in shown
    assert "to the working tree: 1 verdict is worse" in shown


def test_the_same_is_told_to_programs_and_to_a_pull_request(
    heater: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    edit(heater, "door_open | (temperature > 22)", "temperature > 22")
    git(tmp_path, "commit", "-q", "-am", "broken")
    words = ["diff", "HEAD~1", "HEAD", "--model", str(heater), "--quiet"]
    found = json.loads(said([*words, "--format", "json"], capsys, Exit.FAILED)[0])
    jsonschema.validate(found, published("diff-1"))
    [worse] = found["changes"]
    assert (worse["id"], worse["how"], worse["before"], worse["after"]) == (
        "HEAT-1", "worse", "proved", "violated",
    )  # fmt: skip
    assert found["before"] != found["after"] != "" and found["same"] == 2
    table, _ = said([*words, "--format", "markdown"], capsys, Exit.FAILED)
    assert "| HEAT-1 | proved → violated in" in table and "<details>" in table
    back, _ = said(["diff", "HEAD", "HEAD~1", "--model", str(heater), "--quiet"], capsys, Exit.AS_EXPECTED)
    assert "Better:" in back


def test_nothing_changed_is_said_so(heater: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shown, _ = said(["diff", "HEAD", "--model", str(heater)], capsys, Exit.AS_EXPECTED)
    assert "nothing changed; 3 verdicts are the same" in shown


@pytest.mark.parametrize(
    ("old", "new", "concerned"),
    [
        ("temperature > 22", "temperature > 23", "3 of 3 properties depend"),
        ("The room is not heated", "Nobody heats", "0 of 3 properties depend"),
        ("within=10 * sec", "within=11 * sec", "1 of 3 properties depends"),
    ],
)
def test_only_what_depends_on_the_edit_is_checked(
    heater: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, concerned: str
) -> None:
    edit(heater, old, new)
    code = run(["check", "--changed", "--model", str(heater)])
    shown = capsys.readouterr()
    assert f"{concerned} on what has changed since HEAD." in shown.err
    assert code in (Exit.AS_EXPECTED, Exit.FAILED)
    assert shown.out.count("HEAT-") >= int(concerned[0])


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["diff", "nowhere"], "git knows no revision 'nowhere'"),
        (["check", "--changed", "nowhere"], "git knows no revision 'nowhere'"),
        (["diff", "HEAD", "--output", "gone/page.md"], "is no folder"),
    ],
)
def test_what_has_no_meaning_is_said(
    heater: Path, capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    _, told = said([*words, "--model", str(heater)], capsys, Exit.USAGE)
    assert message in told.replace("\n", " ")


def test_a_model_in_no_repository_has_no_earlier_revision(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert run(["init", str(tmp_path / "heater")]) is Exit.AS_EXPECTED
    capsys.readouterr()
    words = ["diff", "HEAD", "--model", str(tmp_path / "heater" / "heater.py")]
    assert "is in no git repository" in said(words, capsys, Exit.USAGE)[1].replace("\n", " ")


def test_a_model_that_the_earlier_revision_does_not_have(
    heater: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    new = tmp_path / "new.py"
    new.write_text(heater.read_text(encoding="utf-8"), encoding="utf-8")
    assert (
        "new.py; write a revision that has it"
        in said(["diff", "HEAD", "--model", str(new)], capsys, Exit.USAGE)[1]
    )


def test_half_a_file_ends_the_comparison_with_its_mistake(
    heater: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    heater.write_text(heater.read_text(encoding="utf-8")[:400], encoding="utf-8")
    assert "see above" in said(["diff", "HEAD", "--model", str(heater)], capsys, Exit.USAGE)[1]


def row(id: str, verdict: str, ticks: int | None = None, in_part: bool = False) -> dict[str, object]:
    return {"id": id, "text": f"{id} is kept.", "verdict": verdict, "ticks": ticks, "in_part": in_part,
            "evidence": "as found"}  # fmt: skip


def compared(before: Sequence[object], after: Sequence[object]) -> list[VerdictChange]:
    return changes(before, after)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("before", "after", "how", "exit"),
    [
        (row("A", "proved"), row("A", "violated", 3), "worse", Exit.FAILED),
        (row("A", "proved"), row("A", "unknown"), "worse", Exit.FAILED),
        (row("A", "proved"), row("A", "proved", in_part=True), "worse", Exit.FAILED),
        (row("A", "violated", 3), row("A", "proved"), "better", Exit.AS_EXPECTED),
        (row("A", "violated", 3), row("A", "violated", 5), "other run", Exit.AS_EXPECTED),
        (row("A", "proved"), None, "gone", Exit.FAILED),
        (None, row("A", "violated", 3), "new", Exit.FAILED),
        (None, row("A", "proved"), "new", Exit.AS_EXPECTED),
    ],
)
def test_how_a_verdict_changed(
    before: dict[str, object] | None, after: dict[str, object] | None, how: str, exit: Exit
) -> None:
    [one] = found = compared(list(filter(None, [before])), list(filter(None, [after])))
    assert (one["how"], code(found)) == (how, exit)
    for written in (text, markdown):
        document = {"before": "1a2b3c", "after": "", "same": 2, "changes": found, "run": "", "exit": exit,
                    "schema": "rovercheck/diff/1"}  # fmt: skip
        assert "| A |" in written(document) or " A " in written(document)  # type: ignore[arg-type]


def test_what_is_the_same_is_no_change() -> None:
    same = [row("A", "violated", 3), row("B", "proved")]
    assert compared(same, same) == []
