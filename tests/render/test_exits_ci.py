"""SARIF, JUnit and GitHub's annotations: valid for their consumers, and true to what was decided."""

import json
import re
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.etree import ElementTree

import pytest
from jsonschema import Draft4Validator
from junitparser import Error, Failure, JUnitXml, Skipped

from rovercheck.checker.render.ci import CiFinding, CiReport, FindingLevel, github, of_trace
from rovercheck.checker.render.ci.github import MOST, annotations, command, summary
from rovercheck.checker.render.ci.junit import junit
from rovercheck.checker.render.ci.sarif import LOCATIONS, RESULTS, document, sarif
from rovercheck.checker.results.trace import Trace
from rovercheck.spec_model.lang.place import Place
from tests.render.conformance import Suite
from tests.render.exits_zoo import TRACES, huge, lasso, odd, told, witness
from tests.render.xsd import Schema
from tests.render.zoo import long_trace

SCHEMAS = Path(__file__).parent / "schemas"
ESCAPE = {"%0A": "\n", "%0D": "\r", "%3A": ":", "%2C": ",", "%25": "%"}
COMMAND = re.compile(r"::(error|warning|notice) ([^:]*)::(.*)")


@cache
def sarif_schema() -> Any:
    return Draft4Validator(json.loads((SCHEMAS / "sarif-2.1.0-rtm.5.json").read_text(encoding="utf-8")))


@cache
def junit_schema() -> Schema:
    return Schema((SCHEMAS / "junit-10.xsd").read_text(encoding="utf-8"))


def finding(level: FindingLevel, number: int = 0, word: str = "violated", **more: Any) -> CiFinding:
    usual: dict[str, Any] = dict(text="It is so.", system="toy", evidence="as found", recorded="proved")
    return CiFinding(f"TOY-{number}", word=word, level=level, **{**usual, **more})


ALL = CiReport(
    (
        finding(FindingLevel.PASSED, 1, "proved"),
        finding(
            FindingLevel.KNOWN,
            2,
            recorded="violated",
            because="As the figure has it.",
            place=Place("m.py", 3),
        ),
        finding(FindingLevel.OPEN, 3, "unknown", evidence="out of time"),
        finding(
            FindingLevel.FAILED,
            4,
            trace=told(long_trace(2)),
            place=Place("m.py", 5),
            details={"engine": "bmc"},
        ),
        finding(FindingLevel.FAILED, 5, "proved", recorded="violated after 3 ticks", system="other"),
        finding(FindingLevel.REJECTED, 6, "proved", system="other"),
        finding(FindingLevel.KNOWN, 7, "unknown", recorded="unknown", system="other"),
    ),
    wanted=7,
)
PARTLY = replace(ALL, wanted=9)


class TraceSuite(Suite):
    KIND = "trace"
    ZOO = TRACES


# --- SARIF -----------------------------------------------------------------------------------------------


def valid(log: str) -> Any:
    """The one run of a log that the schema accepts."""
    found = json.loads(log)
    assert [f"{e.json_path}: {e.message}" for e in sarif_schema().iter_errors(found)] == []
    [run] = found["runs"]
    return run


def locations(result: Any) -> list[Any]:
    [flow] = result["codeFlows"]
    [thread] = flow["threadFlows"]
    found: list[Any] = thread["locations"]
    return found


class TestSarif(TraceSuite):
    NAME = "sarif"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        run = valid(document)
        [result] = run["results"]
        assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"]

    def test_the_code_flow_goes_along_the_lines_of_the_transitions(self) -> None:
        [result] = valid(self.shown("lasso"))["results"]
        steps = locations(result)
        lines = [s["location"]["physicalLocation"]["region"]["startLine"] for s in steps]
        assert {10, 11} <= set(lines) and lines[-1] == 7, (
            "default transition, first transition, the property at the end"
        )
        uri = steps[0]["location"]["physicalLocation"]["artifactLocation"]["uri"]
        assert uri == "models/relay%20%26%20co.py" and unquote(uri) == "models/relay & co.py"
        assert [s["executionOrder"] for s in steps] == sorted(s["executionOrder"] for s in steps)
        assert any(step.get("state", {}).get("alarm") == {"text": "true"} for step in steps)

    def test_what_was_needed_is_essential(self) -> None:
        [result] = valid(self.shown("needed"))["results"]
        told = {s["location"]["message"]["text"]: s["importance"] for s in locations(result)}
        [text] = [text for text in told if "(needed)" in text]
        assert text.startswith("tick 2, 40 ms: level: 0 → 100 (needed)") and told[text] == "essential"

    def test_a_witness_is_no_problem(self) -> None:
        [result] = valid(self.shown("witness"))["results"]
        assert (result["kind"], result["level"]) == ("informational", "none")

    def test_a_long_run_says_what_is_left_out(self) -> None:
        [result] = valid(sarif(of_trace(huge(1_100)), witnesses=True))["results"]
        steps = locations(result)
        assert len(steps) == LOCATIONS
        assert "steps are left out of the code flow" in result["message"]["text"]
        assert sum("left out" in s["location"]["message"]["text"] for s in steps) == 1
        assert steps[-1]["executionOrder"] == 1_100, "the end is there"


def test_sarif_of_a_check() -> None:
    run = valid(sarif(ALL))
    levels = {r["ruleId"]: (r["level"], r["kind"], r["baselineState"]) for r in run["results"]}
    assert levels == {
        "TOY-2": ("note", "fail", "unchanged"),
        "TOY-3": ("none", "open", "new"),
        "TOY-4": ("error", "fail", "new"),
        "TOY-5": ("error", "fail", "updated"),
        "TOY-6": ("error", "fail", "new"),
        "TOY-7": ("none", "open", "unchanged"),
    }
    assert len(run["tool"]["driver"]["rules"]) == 7, "also what was proved is told"
    [notification] = run["invocations"][0]["toolExecutionNotifications"]
    assert "TOY-3 is unknown" in notification["message"]["text"]


def test_sarif_says_that_it_is_not_complete() -> None:
    [invocation] = valid(sarif(PARTLY))["invocations"]
    assert invocation["executionSuccessful"] is False
    assert "7 of 9" in invocation["toolExecutionNotifications"][0]["message"]["text"]


def test_fingerprints_stay_when_lines_move() -> None:
    moved = [replace(f, place=f.place and Place("elsewhere.py", f.place.line + 40)) for f in ALL.findings]
    before, after = ([r["partialFingerprints"] for r in document(r)["runs"][0]["results"]]
                     for r in (ALL, replace(ALL, findings=tuple(moved))))  # fmt: skip
    assert before == after
    assert len({f["primaryLocationLineHash"] for f in before}) == len(before)
    [other] = document(CiReport((finding(FindingLevel.FAILED, 2, "unknown"),), 1))["runs"][0]["results"]
    assert other["partialFingerprints"] not in before, "another verdict is another result"


def test_sarif_has_no_more_results_than_are_shown() -> None:
    many = tuple(finding(FindingLevel.KNOWN, n) for n in range(RESULTS + 2)) + (
        finding(FindingLevel.FAILED, 9_999),
    )
    run = document(CiReport(many, len(many)))["runs"][0]
    assert len(run["results"]) == RESULTS and run["results"][0]["ruleId"] == "TOY-9999", "the worst first"
    [told] = run["invocations"][0]["toolExecutionNotifications"]
    assert told["message"]["text"].startswith("3 of 5003 results are left out")


# --- JUnit -----------------------------------------------------------------------------------------------


def cases(text: str) -> dict[str, Any]:
    """The test cases of a report that the schema of Jenkins accepts, by name."""
    assert list(junit_schema().errors(ElementTree.fromstring(text))) == []
    return {case.name: case for suite in JUnitXml.fromstring(text.encode()) for case in suite}


class TestJunit(TraceSuite):
    NAME = "junit"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        assert len(cases(document)) == 1

    def test_a_counterexample_fails_with_the_run_and_a_witness_passes(self) -> None:
        [failed] = cases(self.shown("lasso")).values()
        assert [type(r) for r in failed.result] == [Failure]
        assert "Relay: Ours → Theirs (transition 1)" in failed.result[0].text
        assert "repeat for ever" in failed.result[0].text
        assert next(iter(cases(self.shown("witness")).values())).is_passed

    def test_what_xml_cannot_hold_is_replaced(self) -> None:
        assert "\x1b" not in self.shown("odd") and r"\x1b\x00" in self.shown("odd")
        odd = replace(finding(FindingLevel.FAILED, 1, "violated"), evidence="\x1b[2J")
        assert "\ufffd[2J" in junit(CiReport((odd,), 1))


def test_junit_of_a_check() -> None:
    found = cases(junit(ALL))
    results = {name: [type(r) for r in case.result] for name, case in found.items()}
    assert results == {
        "TOY-1": [], "TOY-2": [], "TOY-3": [Error], "TOY-4": [Failure], "TOY-5": [Failure],
        "TOY-6": [Error], "TOY-7": [Skipped],
    }  # fmt: skip
    assert "as expected" in found["TOY-2"].system_out and "As the figure has it." in found["TOY-2"].system_out
    assert "out of time" in found["TOY-3"].result[0].text
    assert found["TOY-5"].result[0].message == "TOY-5 is proved; expected: violated after 3 ticks"
    assert "engine: bmc" in found["TOY-4"].system_out
    suites = {
        s.name: (s.tests, s.failures, s.errors, s.skipped) for s in JUnitXml.fromstring(junit(ALL).encode())
    }
    assert suites == {"toy": (4, 1, 1, 0), "other": (3, 1, 1, 1)}


def test_junit_says_that_it_is_not_complete() -> None:
    case = cases(junit(PARTLY))["interrupted"]
    assert [type(r) for r in case.result] == [Error] and "7 of 9" in case.result[0].message


def test_the_schema_finds_faults() -> None:
    text = junit(ALL)
    for fault in (
        text.replace("<testcase ", '<testcase when="now" ', 1),
        text.replace(' errors="1"', ""),
        text.replace("<system-out>", "<output>", 1).replace("</system-out>", "</output>", 1),
        text.replace('<testsuite name="toy"', '<testsuite time="soon" name="toy"'),
    ):
        assert list(junit_schema().errors(ElementTree.fromstring(fault)))


# --- GitHub ----------------------------------------------------------------------------------------------


def plain(text: str) -> str:
    """What the runner shows of an escaped text."""
    return re.sub("|".join(ESCAPE), lambda m: ESCAPE[m[0]], text)


def told_to_the_runner(log: str) -> Iterator[str]:
    """The lines that the runner of GitHub takes for commands, as its ``ActionCommandManager`` finds them.

    Blanks before a command do not count, an older command may stand anywhere in a line, and none is obeyed
    between ``stop-commands`` and its token.
    """
    token = ""
    for line in re.split("\r\n|\r|\n", log):
        found = line.strip()
        if token:
            token = "" if found in (f"::{token}::", f"##[{token}]") else token
        elif found.startswith("::stop-commands::"):
            token = found.removeprefix("::stop-commands::")
        elif found.startswith("::") or "##[" in found:
            yield found
    assert not token, "commands are obeyed again"


def commands(log: str) -> Iterator[tuple[str, dict[str, str], str]]:
    """The annotations in a log as the runner reads them, groups being well formed."""
    inside = False
    for line in told_to_the_runner(log):
        if line.startswith("::group::"):
            assert not inside
            inside = True
        elif line == "::endgroup::":
            assert inside
            inside = False
        else:
            match = COMMAND.fullmatch(line)
            assert match and not inside, line
            pairs = (pair.split("=", 1) for pair in match[2].split(","))
            yield match[1], {name: plain(value) for name, value in pairs}, plain(match[3])
    assert not inside


class TestGithub(TraceSuite):
    NAME = "github"
    ZOO = TRACES

    def parse(self, document: str) -> None:
        [(kind, properties, message)] = commands(document)
        assert kind in ("error", "notice") and properties["title"] and message

    def test_odd_text_comes_back_whole(self) -> None:
        [(_, properties, message)] = commands(self.shown("odd"))
        assert properties["title"] == '"ODD"/1%\n is violated'
        assert message.startswith(odd().property.text)


def test_annotations_of_a_check() -> None:
    found = list(commands(annotations(ALL)))
    ids = [(kind, re.findall(r"TOY-\d", p["title"])[0]) for kind, p, _ in found]
    assert ids == [
        ("error", "TOY-6"), ("error", "TOY-4"), ("error", "TOY-5"), ("warning", "TOY-3"),
        ("notice", "TOY-2"), ("notice", "TOY-7"),
    ]  # fmt: skip
    assert found[1][1] == {"file": "m.py", "line": "5", "title": "TOY-4 is violated; expected: proved"}
    assert "Relay: Ours → Theirs" in annotations(ALL), "the explained run is in the log"


@pytest.mark.parametrize(("count", "shown"), [(MOST, MOST), (MOST + 1, MOST), (500, MOST)])
def test_no_annotation_is_lost_in_silence(count: int, shown: int) -> None:
    many = tuple(finding(FindingLevel.KNOWN, n) for n in range(count))
    found = list(commands(annotations(CiReport(many, count))))
    assert len(found) == shown
    if count > MOST:
        assert found[-1][1]["title"] == f"{count - MOST + 1} more of this kind"
    assert all(any(f.id in title["title"] + text for _, title, text in found) for f in many)


def test_an_interruption_is_an_error() -> None:
    assert list(commands(annotations(PARTLY)))[-1][0] == "error"


def test_marks_with_a_meaning_are_escaped() -> None:
    assert (
        command("error", "50%:\r\na, b", file="a,b:c%.py") == "::error file=a%2Cb%3Ac%25.py::50%25:%0D%0Aa, b"
    )


@pytest.mark.parametrize(
    "text",
    [
        "::error::not meant",
        "  ::add-mask::a",
        "so ##[group]nor this",
        "::endgroup::\r::stop-commands::pause",
        "a\r\n\u2028::error::b",
        "::stop-commands::" + sha256(b"::error::not meant").hexdigest(),
    ],
)
def test_the_log_holds_no_command_by_accident(text: str) -> None:
    failed = finding(FindingLevel.FAILED, because=f"as\n{text}", text=text, evidence=f"{text}\n::error::x")
    two = CiReport((failed, replace(failed, id="TOY-1")), 2)
    assert [kind for kind, _, _ in commands(annotations(two))] == ["error", "error"]
    assert text.splitlines()[-1].split()[-1] in annotations(two), "it is shown all the same"


def test_summary() -> None:
    shown = summary(PARTLY)
    assert "7 of 9" in shown and "| ❌ | TOY-4 | violated | proved | It is so. |" in shown
    assert "False since tick 5" in shown and "2 findings are as expected." in shown
    good = summary(CiReport((finding(FindingLevel.PASSED, 1, "proved"),), 1))
    assert "Every verdict is as expected." in good and "|" not in good


def test_a_long_summary_stays_below_the_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(github, "BUDGET", 3_000)
    shown = summary(
        CiReport(tuple(finding(FindingLevel.FAILED, n, trace=told(long_trace(2))) for n in range(9)), 9)
    )
    assert len(shown) < 6_000 and 0 < shown.count("<details>") < 9
    assert "The other runs are in the log." in shown
    assert shown.count("| ❌ |") == 9


def test_a_trace_is_its_own_report() -> None:
    def level(trace: Trace) -> FindingLevel:
        return of_trace(trace).findings[0].level

    assert level(lasso()) is FindingLevel.FAILED and level(witness()) is FindingLevel.PASSED
