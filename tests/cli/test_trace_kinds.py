"""Every run says what it is: a counterexample or a witness, a shortest run or not, of all runs or of some."""

from dataclasses import replace
from pathlib import Path

import pytest

from rovercheck.checker.commands.shared.codes import Exit
from rovercheck.checker.commands.shared.variant import pick_variant
from rovercheck.checker.commands.trace import run as tracing
from rovercheck.checker.commands.trace.examples import (
    TraceRequest,
    of_state,
    of_transition,
    trace_request,
)
from rovercheck.checker.commands.trace.explain import ExplanationOptions
from rovercheck.checker.commands.trace.formats import exit_written
from rovercheck.checker.commands.trace.run import TraceDisplay, trace
from rovercheck.checker.engines import Limits
from rovercheck.checker.render import renderers
from rovercheck.checker.render.ci import FindingLevel, of_trace
from rovercheck.checker.render.waves import outcome
from rovercheck.checker.results.format import Format, Option
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Reached, Run, Unknown, Violated
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.result import Result, result
from rovercheck.properties.expected import Expected
from rovercheck.properties.forms import Property, reachable
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.system import System
from tests.explain.test_others import CHART, ENDS, SYSTEM, first, left
from tests.traces import changed

PARTLESS = changed(first(), false_parts=(), parts=(), truths=())
"""Of a violated property of which no part is false after the last tick, such as one about several ticks."""
QUIET = ExplanationOptions(wanted=False)


def test_a_counterexample_without_a_false_part_is_one_in_every_exit() -> None:
    assert PARTLESS.property.violated and PARTLESS.breaks() and outcome(PARTLESS) == "violated"
    [finding] = of_trace(PARTLESS).findings
    assert (finding.word, finding.level) == ("violated", FindingLevel.FAILED)
    shown = {name: str(renderers("trace")[name].render(PARTLESS)) for name in ("junit", "sarif", "html")}
    assert 'failures="1"' in shown["junit"]
    assert '"kind": "fail"' in shown["sarif"]
    assert "<title>T-1: counterexample</title>" in shown["html"]


LEFT = tuple({"left": 1, "right": 0, "quick": 0} for _ in range(3))


def test_a_witness_is_no_counterexample() -> None:
    prop = reachable("T-2", "The end can be reached.", that=CHART.active("End"), covers=["R"], on="way")
    found = reached(Reached(Run({}, LEFT), shortest=True), prop)
    assert found.property.violated is False and not found.breaks() and outcome(found) == "reached"
    assert of_trace(found).findings[0].level is FindingLevel.PASSED
    assert "<title>T-2: witness</title>" in str(renderers("trace")["html"].render(found))


def reached(answer: Reached, prop: Property = ENDS) -> Trace:
    question = reduce(lowered(SYSTEM), [prop])
    found = result(question.system, question.goals[0], answer, "by hand").verdict
    assert not isinstance(found, Unknown) and isinstance(found.because, Trace)
    return found.because


@pytest.mark.parametrize("shortest", [True, False])
def test_a_trace_says_whether_it_is_known_to_be_shortest(shortest: bool) -> None:
    assert reached(Reached(Run({}, LEFT), shortest)).shortest is shortest


def test_an_example_that_may_not_be_shortest_says_so(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    for shortest in (True, False):
        found = Result(ENDS, Violated(replace(first(), shortest=shortest), ""), "way")
        monkeypatch.setattr(tracing, "results", lambda *_, found=found: [found])
        trace(example(ENDS), "bdd", Limits(), TraceDisplay(explaining=QUIET))
        assert ("Not known to be a shortest run" in capfd.readouterr().err) is not shortest


def example(prop: Property, system: System = SYSTEM) -> TraceRequest:
    return TraceRequest(prop, {"way": system}, lambda _: Expected(), example=True)


def test_what_only_some_runs_were_searched_for_is_said_to_be_so(capfd: pytest.CaptureFixture[str]) -> None:
    nowhere = reachable("state Way.Nowhere", "", that=left & ~left, covers=["R"], on="way")
    some = "way has only some of the runs there are: this says nothing of the others."
    for system in (SYSTEM, replace(SYSTEM, under=True)):
        assert trace(example(nowhere, system), "bdd", Limits(), TraceDisplay()) == Exit.AS_EXPECTED
        assert (some in capfd.readouterr().err) is system.under


def test_that_there_is_no_other_among_some_runs_is_no_word_on_the_rest(
    capfd: pytest.CaptureFixture[str],
) -> None:
    part = replace(SYSTEM, under=True)
    trace(example(ENDS, part), "bdd", Limits(), TraceDisplay(runs=3, explaining=QUIET))
    told = " ".join(capfd.readouterr().out.split())
    assert "No run 3" in told and "way has only some of the runs there are" in told


def test_several_runs_through_a_transition_are_shown_on_the_chart_as_drawn(
    capfd: pytest.CaptureFixture[str],
) -> None:
    wanted = of_transition("Way: Right -> End", {"way": SYSTEM}, None)
    assert trace(wanted, "bdd", Limits(), TraceDisplay(runs=2, explaining=QUIET)) == Exit.AS_EXPECTED
    told = capfd.readouterr().out
    assert "--- Run 1 ---" in told and "--- No run 2 ---" in told
    assert "goal" not in told


def test_what_a_property_does_not_depend_on_is_shown_by_exits_that_can(tmp_path: Path) -> None:
    asked_for: list[bool] = []

    class Whole:
        FORMAT = Format("whole", "trace", ".txt", "for this test", takes=frozenset({Option.EVERYTHING}))

        @staticmethod
        def render(_: Trace, /, everything: bool = False) -> str:
            asked_for.append(everything)
            return "shown"

    for everything in (True, False):
        exit_written(Whole(), first(), {}, tmp_path / "shown.txt", everything)
    exit_written(renderers("trace")["csv"], first(), {}, tmp_path / "shown.csv", everything=True)
    assert asked_for == [True, False]


@pytest.mark.parametrize(
    ("named", "again"),
    [
        (("PB1-15", None, None, None), "rovercheck trace PB1-15"),
        (
            (None, "Relay.B2_actuating", None, "relay"),
            "rovercheck trace --state Relay.B2_actuating --system relay",
        ),
    ],
)
def test_a_file_says_how_its_run_was_asked_for(named: tuple[str | None, ...], again: str) -> None:
    wanted = trace_request(pick_variant(["S43=AND"], None, []), *named)
    [finding] = of_trace(wanted.drawn(first())).findings
    assert finding.shown_with == f"{again} --interpret S43=AND"


def test_an_example_is_written_nowhere() -> None:
    """A reader of the run is not led to a line of the checker."""
    there = {"way": SYSTEM}
    for made in (of_state("Way.End", there, None), of_transition("Way: Right -> End", there, None)):
        assert made.property.place is None
