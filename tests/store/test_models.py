"""A model of a user's own: what an edit does not concern is not searched, and nothing is told otherwise."""

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.cache import entries
from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.verify import decide as deciding
from rovercheck.checker.verify.tasks import Task

pytestmark = pytest.mark.usefixtures("folder", "no_child")

HALL = """
from rovercheck import Block, Chart, State, always, assign, flag, implies, in_order, never, reachable, to

go, push, lit, rung = flag("go"), flag("push"), flag("lit"), flag("rung")
lamp = Chart(
    "Lamp",
    [
        State("Off", entry=[assign(lit, False)], transitions=[to("On", when=go)]),
        State("On", entry=[assign(lit, True)], transitions=[to("Off", when=~go)]),
    ],
    default="Off",
)
bell = Chart(
    "Bell",
    [
        State("Still", entry=[assign(rung, False)], transitions=[to("Rings", when=push)]),
        State("Rings", entry=[assign(rung, True)], transitions=[to("Still", when=~push)]),
    ],
    default="Still",
    text="Rings.",
)
hall = in_order("hall", lamp, bell, text="A hall.")
LIT = never("LIT", "Never lit.", that=lit, covers=["R1"], on=hall)
ON = always("ON", "Lit where it is on.", that=implies(lamp.active("On"), lit), covers=["R1"], on=hall)
RUNG = reachable("RUNG", "Rings.", that=rung, covers=["R2"], on=hall)
RUNG_ON = bell.active("Rings")
STILL = always("STILL", "Never still.", that=implies(rung & ~push, RUNG_ON), covers=["R2"], on=hall)
"""
LAMP, BELL = {"LIT", "ON"}, {"RUNG", "STILL"}
BASELINE = '[LIT]\\nverdict = "violated"\\nbecause = "It is a lamp."\\n'.replace("\\n", "\n")


@dataclass
class Hall:
    """A model in a file of its own, and which of its properties were searched."""

    file: Path
    searched: list[str] = field(default_factory=list)

    def check(self, *options: str) -> Exit:
        self.searched.clear()
        return Exit(run(["check", "--model", str(self.file), *options]))

    def edit(self, old: str, new: str) -> None:
        text = self.file.read_text(encoding="utf-8")
        assert old in text
        self.file.write_text(text.replace(old, new), encoding="utf-8")

    @property
    def asked(self) -> set[str]:
        return set(self.searched)


@pytest.fixture
def hall(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Hall]:
    file = tmp_path / "hall.py"
    file.write_text(HALL, encoding="utf-8")
    (tmp_path / "hall.baseline.toml").write_text(BASELINE, encoding="utf-8")
    made, decide = Hall(file), deciding.decide

    def counted(task: Task, *args: Any, **more: Any) -> Any:
        made.searched += [p.id for p in task.properties]
        return decide(task, *args, **more)

    monkeypatch.setattr(deciding, "decide", counted)
    yield made


def test_an_unchanged_model_is_searched_once(hall: Hall, capsys: pytest.CaptureFixture[str]) -> None:
    assert hall.check() is Exit.AS_EXPECTED
    assert LAMP | BELL <= hall.asked
    first = capsys.readouterr().out
    assert hall.check() is Exit.AS_EXPECTED and not hall.asked
    assert sorted(capsys.readouterr().out.splitlines()) == sorted(first.splitlines())


def test_after_an_edit_of_a_guard_only_what_depends_on_it_is_searched(hall: Hall) -> None:
    hall.check("--no-premises")
    hall.edit('to("Rings", when=push)', 'to("Rings", when=push & go)')
    assert hall.check("--no-premises") is Exit.AS_EXPECTED and hall.asked == BELL
    hall.edit('to("On", when=go)', 'to("On", when=go & push)')
    assert hall.check("--no-premises") is Exit.AS_EXPECTED and hall.asked == LAMP
    hall.edit('to("Rings", when=push & go)', 'to("Rings", when=push)')
    hall.edit('to("On", when=go & push)', 'to("On", when=go)')
    assert hall.check("--no-premises") is Exit.AS_EXPECTED and not hall.asked, "the old answers are back"


def test_an_edit_that_changes_a_verdict_is_told(hall: Hall, capsys: pytest.CaptureFixture[str]) -> None:
    assert hall.check() is Exit.AS_EXPECTED
    hall.edit("[assign(rung, True)]", "[assign(rung, False)]")
    assert hall.check() is Exit.FAILED and hall.asked >= {"RUNG"}
    assert "RUNG is violated; expected: proved" in capsys.readouterr().out
    hall.edit(
        'entry=[assign(rung, False)], transitions=[to("Still"',
        'entry=[assign(rung, True)], transitions=[to("Still"',
    )
    assert hall.check() is Exit.AS_EXPECTED


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('text="Rings."', 'text="It rings when pushed."'),
        ('text="A hall."', 'text="A large hall."'),
        ('"Never lit."', '"It is never lit."'),
        ('covers=["R1"]', 'covers=["R1", "R2"]'),
        ("\ngo, push", "\n\n# moved down\n\n\ngo, push"),
        ("LIT = never", "LIGHT = never"),
    ],
    ids=["chart", "system", "property", "covers", "moved", "renamed"],
)
def test_an_edit_of_words_searches_nothing_and_tells_the_new_words(
    old: str, new: str, hall: Hall, capsys: pytest.CaptureFixture[str]
) -> None:
    hall.check()
    hall.edit(old, new)
    capsys.readouterr()
    assert hall.check("--json") is Exit.AS_EXPECTED and not hall.asked
    said = json.loads(capsys.readouterr().out)
    [lit] = [row for row in said["results"] if row["id"] == "LIT"]
    if "never lit" in new:
        assert lit["text"] == "It is never lit."
    if "covers" in new:
        assert lit["requirements"] == ["R1", "R2"]


def test_an_edited_property_is_searched(hall: Hall) -> None:
    hall.check("--no-premises")
    hall.edit("that=lit,", "that=lit & rung,")
    hall.check("--no-premises")
    assert hall.asked == {"LIT"}


def test_another_baseline_is_compared_with_the_same_verdicts(
    hall: Hall, capsys: pytest.CaptureFixture[str]
) -> None:
    assert hall.check() is Exit.AS_EXPECTED
    table = hall.file.with_name("hall.baseline.toml")
    table.write_text("", encoding="utf-8")
    assert hall.check() is Exit.FAILED and not hall.asked
    said = capsys.readouterr().out
    assert "LIT is violated; expected: proved" in said and "fired: " in said, "its run is replayed for that"
    table.write_text(BASELINE.replace("LIT", "RUNG"), encoding="utf-8")
    assert hall.check() is Exit.FAILED and not hall.asked
    table.write_text(BASELINE, encoding="utf-8")
    assert hall.check() is Exit.AS_EXPECTED and not hall.asked


def documents(hall: Hall, folder: Path, capsys: pytest.CaptureFixture[str], *options: str) -> list[str]:
    """What is printed and written, times left out."""
    junit, sarif = folder / "j.xml", folder / "s.json"
    hall.check("--json", "--junit", str(junit), "--sarif", str(sarif), *options)
    said = json.loads(capsys.readouterr().out)
    said["results"].sort(key=lambda row: row["id"])
    hall.check("--annotations", "github", *options)
    told = sorted(re.sub(r"(::)?[0-9a-f]{64}(::)?", "", capsys.readouterr().out).splitlines())
    timeless = re.sub(r'(time|timestamp)="[^"]*"', "", junit.read_text(encoding="utf-8"))
    cases = "\n".join(sorted(re.split(r"(?=<testcase)", timeless)))
    findings = json.loads(sarif.read_text(encoding="utf-8"))
    for one in findings["runs"]:
        one["results"].sort(key=lambda row: json.dumps(row, sort_keys=True))
    return [json.dumps(said, indent=1), "\n".join(told), cases, json.dumps(findings, indent=1)]


@pytest.mark.parametrize("expected", [BASELINE, ""], ids=["as expected", "changed"])
def test_all_documents_are_the_same_with_and_without_the_store(
    expected: str, hall: Hall, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hall.file.with_name("hall.baseline.toml").write_text(expected, encoding="utf-8")
    without = documents(hall, tmp_path, capsys, "--no-store")
    assert hall.asked
    first = documents(hall, tmp_path, capsys)
    again = documents(hall, tmp_path, capsys)
    assert not hall.asked
    assert without == first == again


def test_recheck_tells_the_same_and_shows_every_proof_again(
    hall: Hall, capsys: pytest.CaptureFixture[str]
) -> None:
    hall.check("--json")
    first = {row["id"]: row["verdict"] for row in json.loads(capsys.readouterr().out)["results"]}
    assert hall.check("--json", "--recheck") is Exit.AS_EXPECTED
    again = {row["id"]: row["verdict"] for row in json.loads(capsys.readouterr().out)["results"]}
    assert first == again


EMPTY = """
from rovercheck import Block, always, assign, flag, implies, in_order

go, lit = flag("go"), flag("lit")
hall = in_order("hall", Block("Light", [assign(lit, go)]))
NONE = always("NONE", "Nothing.", that=implies(lit & ~go, go), covers=["R"], on=hall)
SOME = always("SOME", "Something.", that=implies(lit, go), covers=["R"], on=hall)
"""


def test_vacuous_proofs_are_told_the_same(hall: Hall, capsys: pytest.CaptureFixture[str]) -> None:
    hall.file.with_name("hall.baseline.toml").unlink()
    hall.file.write_text(EMPTY, encoding="utf-8")
    said = list[list[str]]()
    for options in (["--no-store"], [], []):
        assert hall.check("--strict", *options) is Exit.FAILED
        said.append(sorted(capsys.readouterr().out.splitlines()))
    assert said[0] == said[1] == said[2] and not hall.asked
    assert any("Vacuous proofs" in line for line in said[0])


def test_no_store_neither_uses_nor_keeps(hall: Hall, folder: Path) -> None:
    hall.check("--no-store")
    assert not list(folder.glob("*-verdict-json.o"))
    hall.check()
    hall.check("--no-store")
    assert LAMP | BELL <= hall.asked


def test_another_engine_depth_or_timers_are_asked_anew(hall: Hall) -> None:
    hall.check("--no-premises")
    for options in (["--engine", "bmc", "--depth", "4"], ["--depth", "9"], ["--timers", "free"]):
        hall.check("--no-premises", *options)
        assert LAMP & hall.asked, options
    hall.check("--no-premises")
    assert not hall.asked


def test_a_trace_of_what_is_kept_searches_nothing(hall: Hall, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["trace", "LIT", "--model", str(hall.file), "--format", "json"]
    run([*command, "--no-store"])
    without = capsys.readouterr().out
    hall.check()
    hall.searched.clear()
    capsys.readouterr()
    for _ in range(2):
        run(command)
        assert json.loads(capsys.readouterr().out) == json.loads(without) and not hall.asked


def test_a_model_that_leaves_a_domain_is_refused_every_time(
    hall: Hall, capsys: pytest.CaptureFixture[str]
) -> None:
    assert hall.check() is Exit.AS_EXPECTED
    hall.edit("hall = in_order(", "x = var('x', integer(0, 2))\nhall = in_order(")
    hall.edit(
        'in_order("hall", lamp, bell,', "in_order(\"hall\", lamp, bell, Block('Over', [assign(x, x + 1)]),"
    )
    hall.edit("reachable, to", "reachable, to, var, integer")
    capsys.readouterr()
    for _ in range(2):
        code = hall.check()
        said = capsys.readouterr()
        assert code is not Exit.AS_EXPECTED and "outside" in said.err, said
        assert "proved" not in said.out


def test_an_assumption_that_excludes_all_runs_is_refused_every_time(
    hall: Hall, capsys: pytest.CaptureFixture[str]
) -> None:
    assert hall.check() is Exit.AS_EXPECTED
    capsys.readouterr()
    hall.edit('text="A hall.")', 'text="A hall.", assume=go & ~go)')
    for _ in range(2):
        code = hall.check()
        said = capsys.readouterr()
        assert code is not Exit.AS_EXPECTED and "allows no first tick" in said.err, said


def test_a_forged_entry_is_found_by_recheck_with_exit_code_3(
    hall: Hall, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    hall.check("--no-premises")
    proofs, violations = list[bytes](), list[str]()
    for file in folder.glob("*-verdict-json.o"):
        contents = entries.read(file.stem, code=False) or b""
        found = json.loads(contents) if contents.startswith(b"{") else {}
        if found.get("word") == "proved" and "run" not in found["because"]:
            proofs.append(json.dumps({**found, "together": ["LIT"]}).encode())
        if found.get("word") == "violated":
            violations.append(file.stem)
    assert proofs and len(violations) == 3, "under the question, the slice, and as an earlier run"
    for name in violations:
        entries.write(name, proofs[0])
    capsys.readouterr()
    assert hall.check("--no-premises") is Exit.FAILED, "a plain check believes the seal"
    assert "LIT is proved; expected: violated" in capsys.readouterr().out
    assert hall.check("--no-premises", "--recheck") is Exit.INTERNAL
    assert "LIT is kept as proved, and decided anew it is violated" in capsys.readouterr().err
    assert hall.check("--no-premises") is Exit.AS_EXPECTED, "it is kept no longer"
