"""``rovercheck check --junit --sarif --annotations``: files for CI, whole whatever happens."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from junitparser import Error, Failure, JUnitXml

from rovercheck.checker.certify.outcome import Rejected
from rovercheck.checker.cli import run
from rovercheck.checker.commands.check import run as checking
from rovercheck.checker.commands.check.ci import finding, level
from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.render.ci import FindingLevel
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Proved, Unknown, Verdict, Violated
from rovercheck.checker.verify.checked import CheckedProperty
from rovercheck.checker.verify.finding_order import FindingOrder
from rovercheck.checker.verify.result import Result
from rovercheck.properties.catalogue import catalogue, expected
from rovercheck.properties.expected import Expected
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.rover import systems
from tests.render.exits_zoo import told
from tests.render.test_exits_ci import commands
from tests.render.zoo import long_trace

NAMES = ["PB1-11", "PB1-12", "PB1-14", "PB1-15"]
PROVED = Proved(Exhausted(154, 10, 3, ("x",)), "explicit")
OPEN = Unknown("out of time", 7, "bmc")


def trace(ticks: int = 8) -> Trace:
    return told(long_trace(ticks - 3))


def result(id: str, verdict: Verdict) -> Result:
    return Result(catalogue()[id], verdict, "relay")


AS_RECORDED = [
    result("PB1-11", PROVED),
    result("PB1-12", PROVED),
    result("PB1-14", PROVED),
    result("PB1-15", Violated(trace(), "bmc")),
]
CHANGED = [
    result("PB1-11", Violated(trace(5), "bmc")),
    result("PB1-12", OPEN),
    result("PB1-14", PROVED),
    result("PB1-15", PROVED),
]


class Written:
    """What a run of ``check`` wrote, its engines replaced by known results."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.junit, self.sarif, self.summary = folder / "j.xml", folder / "s.sarif", folder / "summary.md"
        self.patch = monkeypatch
        monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(self.summary))

    def check(self, found: list[Result], *options: str, end: BaseException | None = None) -> Exit:
        def results(*_: object) -> Iterator[Result]:
            yield from found
            if end is not None:
                raise end

        self.patch.setattr(checking, "results", results)
        asked = ["--junit", str(self.junit), "--sarif", str(self.sarif), "--annotations", "github"]
        return Exit(run(["check", *NAMES, *asked, *options]))

    @property
    def cases(self) -> dict[str, Any]:
        return {c.name: c for suite in JUnitXml.fromfile(str(self.junit)) for c in suite}

    @property
    def log(self) -> Any:
        return json.loads(self.sarif.read_text(encoding="utf-8"))["runs"][0]


@pytest.fixture
def written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Written:
    return Written(tmp_path, monkeypatch)


def test_all_as_on_record(written: Written, capsys: pytest.CaptureFixture[str]) -> None:
    assert written.check(AS_RECORDED) == Exit.AS_EXPECTED
    assert all(case.is_passed for case in written.cases.values())
    assert "as expected" in written.cases["PB1-15"].system_out
    assert [r["level"] for r in written.log["results"]] == ["note"]
    assert "::notice file=properties/areas/relay.py,line=" in capsys.readouterr().out
    assert "Every verdict is as expected." in written.summary.read_text(encoding="utf-8")


def test_what_changed_fails_with_the_explained_run(
    written: Written, capsys: pytest.CaptureFixture[str]
) -> None:
    assert written.check(CHANGED) == Exit.FAILED
    kinds = {name: [type(r) for r in case.result] for name, case in written.cases.items()}
    assert kinds == {"PB1-11": [Failure], "PB1-12": [Error], "PB1-14": [], "PB1-15": [Failure]}
    assert "Relay: Ours → Theirs (transition 1)" in written.cases["PB1-11"].result[0].text
    said = capsys.readouterr().out
    assert said.count("::error ") == 2 and said.count("::warning ") == 1
    assert "▸ Relay: Ours → Theirs" in said, "in the log"
    levels = {r["ruleId"]: (r["level"], r["baselineState"]) for r in written.log["results"]}
    assert levels == {"PB1-11": ("error", "new"), "PB1-12": ("none", "new"), "PB1-15": ("error", "updated")}
    [rule] = [r for r in written.log["tool"]["driver"]["rules"] if r["id"] == "PB1-11"]
    assert rule["help"]["text"].startswith("From step 2 on") and "B1-REL-02" in rule["properties"]["tags"]


@pytest.mark.parametrize(
    ("end", "code", "case", "why"),
    [
        (KeyboardInterrupt(), Exit.INTERRUPTED, "interrupted", ""),
        (RuntimeError("a bug"), Exit.INTERNAL, "stopped", "Internal error: RuntimeError: a bug"),
        (ModelError("toy: x gives 4."), Exit.USAGE, "stopped", "toy: x gives 4. Incomplete:"),
    ],
)
def test_an_end_before_the_end_is_written_down(
    written: Written, end: BaseException, code: Exit, case: str, why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """A model that leaves a domain was told as an interruption, without a reason."""
    assert written.check(CHANGED[:1], end=end) == code
    assert set(written.cases) == {"PB1-11", case}
    assert why in written.cases[case].result[0].message
    assert f"::error title=rovercheck was {case}::{why}" in capsys.readouterr().out
    assert written.log["invocations"][0]["executionSuccessful"] is False
    assert "1 of 4 properties" in written.summary.read_text(encoding="utf-8")


def test_what_is_printed_commands_nothing(written: Written, capsys: pytest.CaptureFixture[str]) -> None:
    text = "::error::not meant ##[group]nor this"
    hostile = replace(CHANGED[0], property=replace(CHANGED[0].property, text=text))
    written.check([hostile, *CHANGED[1:]])
    said = capsys.readouterr().out
    assert f"\n  {text}\n" in said, "told to people before the annotations"
    assert [kind for kind, _, _ in commands(said)] == ["error", "error", "warning"]


def test_json_stays_json(written: Written, capsys: pytest.CaptureFixture[str]) -> None:
    written.check(CHANGED, "--json")
    said = capsys.readouterr()
    assert json.loads(said.out)["exit"] == Exit.FAILED and "::error" in said.err


def test_nothing_is_decided_for_a_place_that_cannot_be_written(
    written: Written, capsys: pytest.CaptureFixture[str]
) -> None:
    written.junit = written.junit.parent / "missing" / "j.xml"
    assert written.check([], end=AssertionError("asked")) == Exit.USAGE
    assert "is no folder" in capsys.readouterr().err


def test_levels_are_those_of_the_exit_codes() -> None:
    one = result("PB1-11", PROVED)
    rejected = replace(one, certificate=Rejected("step", "no"))
    violated = result("PB1-11", Violated(trace(), "bmc"))
    levels = [
        level(CheckedProperty(one, Expected())),
        level(CheckedProperty(rejected, Expected())),
        level(CheckedProperty(violated, Expected("violated", 8))),
        level(CheckedProperty(violated, Expected("violated", 9))),
        level(CheckedProperty(result("PB1-11", OPEN), Expected())),
        level(CheckedProperty(violated, Expected(), "with a repair")),
    ]
    assert levels == [
        FindingLevel.PASSED,
        FindingLevel.REJECTED,
        FindingLevel.KNOWN,
        FindingLevel.FAILED,
        FindingLevel.OPEN,
        FindingLevel.FAILED,
    ]


def test_a_finding_of_changed_charts_says_so() -> None:
    compared = CheckedProperty(
        result("PB1-11", Violated(trace(), "bmc")), expected("PB1-11"), "with repair X"
    )
    found = finding(compared, FindingOrder(systems=systems()), "--repair X")
    assert found.headline == "PB1-11 is violated with repair X; as specified it is proved"
    assert found.shown_with == "rovercheck trace PB1-11 --repair X"
    assert found.details == {"engine": "bmc", "ticks": "8"}
