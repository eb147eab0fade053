"""Whether the case of a proof occurs: a recorded run is gone through again where that may have changed."""

from pathlib import Path

import pytest

from rovercheck.checker.cli import run
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.runs import known_runs
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.system import System
from tests.cli.test_report import EMPTY

pytestmark = pytest.mark.usefixtures("folder", "no_child")

BESIDE = EMPTY.replace(
    'hall = in_order("hall", chart,',
    """bell = flag("bell")
ringing = Chart("Bell", [State("Rings", during=[assign(bell, button)])], default="Rings")
hall = in_order("hall", chart, ringing,""",
)
"""A chart beside it, which the property does not see."""
INSIDE = EMPTY.replace('to("On", when=button)', 'to("On", when=button | lamp)')
"""Another guard, of no consequence."""


@pytest.fixture
def hall(tmp_path: Path, folder: Path) -> Path:
    """A model with a recorded run, of which nothing is kept."""
    file = tmp_path / "hall.py"
    file.write_text(EMPTY, encoding="utf-8")
    assert run(["check", "--model", str(file), "--record-premises", "FULL"]) == Exit.AS_EXPECTED
    for entry in folder.iterdir():
        entry.unlink()
    return file


@pytest.fixture
def gone_through(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The properties of which a recorded run is gone through."""
    found, way = list[str](), known_runs.reached_by

    def noted(run: Run, system: System, prop: Property, *, confirmed: bool) -> Run | None:
        found.append(prop.id)
        return way(run, system, prop, confirmed=confirmed)

    monkeypatch.setattr(known_runs, "reached_by", noted)
    return found


def test_only_where_the_slice_of_the_property_has_changed(hall: Path, gone_through: list[str]) -> None:
    assert len({EMPTY, BESIDE, INSIDE}) == 3
    for text, times in (
        (EMPTY, 1),
        (EMPTY, 0),
        (BESIDE, 0),
        (BESIDE, 0),
        (INSIDE, 1),
        (INSIDE, 0),
        (EMPTY, 0),
    ):
        hall.write_text(text, encoding="utf-8")
        assert run(["check", "--model", str(hall), "FULL"]) == Exit.AS_EXPECTED
        assert gone_through == ["FULL"] * times, text
        gone_through.clear()


def test_where_runs_are_to_be_recorded_or_nothing_is_believed(hall: Path, gone_through: list[str]) -> None:
    for option in ("--record-premises", "--recheck", "--no-store"):
        assert run(["check", "--model", str(hall), option, "FULL"]) == Exit.AS_EXPECTED
        assert gone_through == ["FULL"], option
        gone_through.clear()


def test_another_run_on_record_is_gone_through(hall: Path, gone_through: list[str]) -> None:
    kept = hall.with_name("premises.json")
    for times in (1, 0):
        assert run(["check", "--model", str(hall), "FULL"]) == Exit.AS_EXPECTED
        assert gone_through == ["FULL"] * times
        gone_through.clear()
    kept.write_text(kept.read_text(encoding="utf-8").replace('"button":1', '"button":0'), encoding="utf-8")
    assert run(["check", "--model", str(hall), "FULL"]) == Exit.AS_EXPECTED
    assert set(gone_through) == {"FULL"}
