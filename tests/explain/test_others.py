"""Other runs to the same end, each by other transitions or for another reason, until there is none."""

from dataclasses import replace

from rovercheck.checker.engines import Limits
from rovercheck.checker.explain.explanation import explained, unexplained
from rovercheck.checker.explain.other_causes import OtherCauses
from rovercheck.checker.explain.other_runs import NoOtherRun, OtherRun, OtherRuns
from rovercheck.checker.render.reasons import in_reason
from rovercheck.checker.render.trace_table import render as table
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Reached, Run, Violated
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.result import result
from rovercheck.properties.forms import Property, never
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.expr import flag
from rovercheck.spec_model.lang.system import System, in_order

left, right, quick = flag("left"), flag("right"), flag("quick")

CHART = Chart(
    "Way",
    [
        State("Start", transitions=[to("Left", when=left), to("Right", when=right)]),
        State("Left", transitions=[to("End")]),
        State("Right", transitions=[to("End", when=quick)]),
        State("End"),
    ],
    default="Start",
)
SYSTEM = in_order("way", CHART)
ENDS = never("T-1", "The end is not reached.", that=CHART.active("End"), covers=["R"], on="way")


def first(system: System = SYSTEM, prop: Property = ENDS) -> Trace:
    """By the left way, in the fewest ticks."""
    question = reduce(lowered(system), [prop])
    given = {v.name: int(v.name == "left") for v in question.system.inputs}
    run = Run({v.name: 0 for v in question.system.frozen}, (given,) * 3)
    found = result(question.system, question.goals[0], Reached(run), "by hand").verdict
    assert isinstance(found, Violated) and isinstance(found.because, Trace)
    return found.because


def test_both_ways_are_found_and_that_there_is_no_third() -> None:
    others = OtherRuns(first(), ENDS, SYSTEM)
    second = others.next("bdd", Limits())
    assert isinstance(second, OtherRun)
    [difference] = second.differences
    assert difference == (
        "takes Way: Start -> Right (transition 2) [right], Way: Right -> End (transition 1) [quick]; "
        "does not take Way: Start -> Left (transition 1) [left], Way: Left -> End (transition 1)"
    )
    assert [a.target for t in second.trace.ticks for a in t.transitions] == ["Start", "Right", "End"]
    assert "goal" not in str(second.trace.ticks), "the run is replayed on the charts as drawn"
    third = others.next("bdd", Limits())
    assert isinstance(third, NoOtherRun) and third.proved and "reachable states" in third.reason


def test_a_search_that_gives_up_proves_nothing() -> None:
    others = OtherRuns(first(), ENDS, SYSTEM)
    assert others.next("bmc", Limits(depth=2)) == NoOtherRun(False, "none within 2 ticks")


def test_explained_by_the_inputs_that_decide_the_way() -> None:
    found = explained(first(), ENDS, SYSTEM)
    assert [(n.number, n.name, set(n.values)) for n in found.needed()] == [(2, "left", {1})]
    assert found.necessary is not None and found.necessary.minimal


def test_runs_without_an_end_are_left_as_they_are() -> None:
    for trace in (replace(first(), loop=1), replace(first(), trapped=1)):
        assert explained(trace, ENDS, SYSTEM) is trace
        assert unexplained(trace)


def way(*states: State) -> System:
    return in_order("way", Chart("Way", [*states, State("End")], default="Start"))


BOTH = way(
    State("Start", transitions=[to("Left", when=left), to("Right", when=right)]),
    State("Left", transitions=[to("End")]),
    State("Right", transitions=[to("End")]),
)


def test_another_reason_is_found_and_that_there_is_no_third() -> None:
    unlike, known = OtherCauses(ENDS, BOTH), [explained(first(BOTH), ENDS, BOTH)]
    second = unlike.next(known, "bdd", Limits())
    assert isinstance(second, Trace)
    known.append(explained(second, ENDS, BOTH))
    assert [(n.number, n.name, set(n.values)) for n in known[1].needed()] == [(2, "right", {1})]
    assert in_reason(known[1], known[0]) == "needs right; does not need left"
    third = unlike.next(known, "bdd", Limits())
    assert isinstance(third, NoOtherRun) and third.proved, "to wait for left or right is no other reason"
    assert in_reason(known[1], replace(known[1], ticks=known[1].ticks * 2)) == (
        "needs right in other ticks or with other values"
    )


def test_a_run_with_other_fixed_values_ends_for_another_reason() -> None:
    start = State("Start", transitions=[to("Left", when=left | quick), to("Right", when=left & quick)])
    left_and_right = [State(side, transitions=[to("End")]) for side in ("Left", "Right")]
    system = replace(way(start, *left_and_right), frozen=(quick,))
    known = [explained(first(system), ENDS, system)]
    other = OtherCauses(ENDS, system).next(known, "bdd", Limits())
    assert isinstance(other, Trace)
    told = in_reason(explained(other, ENDS, system), known[0])
    assert told == "begins with quick = true; does not need left"
    assert "fixed: quick = true" in table(other)
