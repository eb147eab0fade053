"""What a review page shows is not made again while it is as it was, and never kept where it is not."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from rovercheck.checker.cache import entries
from rovercheck.checker.cli import run
from rovercheck.checker.commands.report import graphs, kept_page
from rovercheck.checker.commands.report import rover as of_rover
from rovercheck.checker.commands.report import run as reviewing
from rovercheck.checker.commands.report.kept_page import PageKeeper
from rovercheck.checker.commands.shared import dependencies
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.told import ToldVerdict
from rovercheck.checker.engines import AUTO, Limits
from rovercheck.checker.explain import explanation
from rovercheck.checker.explain.unrolled_run import OutOfTime
from rovercheck.checker.results.verdict import Violated
from rovercheck.checker.store import parts
from rovercheck.checker.store.parts import UNKEPT
from rovercheck.checker.store.verdicts import store as store_of
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.result import Result
from rovercheck.properties.catalogue import catalogue
from rovercheck.properties.expected import Expected
from tests.render.zoo import long_trace

pytestmark = pytest.mark.usefixtures("folder", "no_child")
CHEAP = ["PB1-15", "PB1-11"]
BROKEN = Violated(long_trace(), "bmc")
FINDINGS = [CheckedProperty(Result(catalogue()["PB1-15"], BROKEN, "relay"), Expected())]


def page(folder: Path, *more: str) -> tuple[Exit, str]:
    """The exit code and the page."""
    file = folder / "page.html"
    file.unlink(missing_ok=True)
    code = run(["report", *CHEAP, "--no-repairs", "-o", str(file), *more])
    return code, file.read_text(encoding="utf-8")


@pytest.fixture
def counted(monkeypatch: pytest.MonkeyPatch) -> Callable[[object, str], list[object]]:
    """Counts the calls of a function."""

    def counting(where: Any, name: str) -> list[object]:
        calls: list[object] = []
        before = getattr(where, name)

        def called(*given: object, **more: object) -> object:
            calls.append(given)
            return before(*given, **more)

        monkeypatch.setattr(where, name, called)
        return calls

    return counting


def test_an_unchanged_page_is_not_made_again(
    tmp_path: Path, counted: Callable[..., list[object]], capsys: pytest.CaptureFixture[str]
) -> None:
    decided = counted(reviewing, "results")
    code, made = page(tmp_path)
    told = capsys.readouterr().out
    asked = len(decided)
    assert asked and (code, made) == page(tmp_path)
    assert len(decided) == asked and capsys.readouterr().out == told
    assert "Made on 2026-05-05" in page(tmp_path, "--date", "2026-05-05")[1]
    assert len(decided) > asked, "another page is another page"


def test_without_the_store_it_is_made_again(tmp_path: Path, counted: Callable[..., list[object]]) -> None:
    page(tmp_path)
    decided = counted(reviewing, "results")
    page(tmp_path, "--no-store")
    page(tmp_path, "--interpret", "S43=AND")
    page(tmp_path, "--certify")
    page(tmp_path, "--certify")
    assert len(decided) >= 4, "that proofs are checked again is no answer from a store"


def test_what_a_changed_page_shares_with_the_last_is_not_made_again(
    tmp_path: Path, counted: Callable[..., list[object]]
) -> None:
    _, made = page(tmp_path)
    drawn, asked = counted(graphs, "_state_graph"), counted(dependencies, "_of_rover")
    _, again = page(tmp_path, "--document", "B")
    assert drawn == asked == [] and again != made
    assert made.count("stategraph") == again.count("stategraph") > 0


@pytest.mark.parametrize(
    "kept", ["{}", "[]", '{"html": 1}', '{"html": "x", "told": [{}], "code": 0}', "[[", "3"]
)
def test_a_page_without_a_meaning_is_made_again(
    kept: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _, made = page(tmp_path)
    real = entries.read
    monkeypatch.setattr(entries, "read", lambda name, code=True: real(name) if code else kept.encode())
    assert page(tmp_path)[1] == made


def test_a_page_with_something_open_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    written: list[Sequence[ToldVerdict]] = []
    monkeypatch.setattr(PageKeeper, "write", lambda self, made: written.append(made.told))
    page(tmp_path, "--engine", "bmc", "--depth", "2")
    [told] = written
    monkeypatch.undo()
    keeper = PageKeeper("tree", f"{'0' * 64}-page-json")
    monkeypatch.setattr(kept_page, "tree_key", lambda: "tree")
    keeper.write(kept_page.KeptPage("x", told, Exit.AS_EXPECTED))
    assert keeper.read() is None


def test_code_that_changed_meanwhile_keeps_no_part(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(parts, "as_loaded", lambda: False)
    parts.code_key.cache_clear()
    store = parts.PartStore(store_of(AUTO, Limits()))
    assert store.name("graph", 1) is None
    monkeypatch.undo()
    parts.code_key.cache_clear()
    name = store.name("graph", 1)
    assert name is not None
    monkeypatch.setattr(parts, "as_loaded", lambda: False)
    store.write(name, "x")
    assert store.read(name) is None


def test_a_cause_that_was_not_found_in_time_is_not_looked_for_again_for_as_long(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[object] = []

    def late(*given: object) -> None:
        asked.append(given)
        raise OutOfTime("too long")

    monkeypatch.setattr(explanation, "explained", late)
    page(tmp_path)
    page(tmp_path, "--document", "B")
    assert len(asked) == 1
    page(tmp_path, "--document", "B", "--explain")
    assert len(asked) == 2, "as long as it takes is longer"


def test_repairs_are_not_decided_again_while_no_file_has_changed(
    tmp_path: Path, counted: Callable[..., list[object]]
) -> None:
    """Which is kept, whatever is asked of the page."""
    store = parts.PartStore(store_of(AUTO, Limits()))
    made = of_rover.kept_remedies(FINDINGS, store)
    decided = counted(of_rover, "remedies")
    assert of_rover.kept_remedies(FINDINGS, store) == made != ()
    assert not decided
    of_rover.kept_remedies(FINDINGS, UNKEPT)
    assert len(decided) == 1
