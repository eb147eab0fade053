"""Properties about infinite runs against a naive search for fair cycles in the graph of all states."""

from collections.abc import Mapping, Sequence
from typing import NoReturn

import jsonschema
import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.engines import Limits, engines, quiet
from rovercheck.checker.process.faults import Fault, listening
from rovercheck.checker.render import renderers
from rovercheck.checker.render.trace_json import document
from rovercheck.checker.render.trace_table import render
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import Exhausted, Proved, Reached, Unknown, Unreachable, Violated
from rovercheck.checker.verify.decide import AUTO, Task, decide, tasks
from rovercheck.checker.verify.liveness import verdicts
from rovercheck.checker.verify.liveness import verdicts as recover
from rovercheck.checker.verify.liveness.loops import loop_query, looped
from rovercheck.checker.verify.liveness.verdicts import NO_LOOP, Trap, trapped
from rovercheck.checker.verify.result import Result
from rovercheck.properties import forms
from rovercheck.properties.forms import Form, LeadsTo, Property, Recoverable, Settles
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Chart, State, to
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import evaluate
from rovercheck.spec_model.lang.expr import Expr, flag
from rovercheck.spec_model.lang.system import System, TransitionSystem, in_order
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.words import after
from tests.naive import successors, vectors
from tests.profiles import examples
from tests.schemas import published
from tests.strategies_ts import booleans, transition_systems

At = Mapping[str, int]
Node = tuple[tuple[int, ...], bool]
"""A state, and whether a trigger is still without response."""


class Naive:
    """The reachable graph of a system; each tick is an edge with the state after it, inputs included."""

    def __init__(self, system: TransitionSystem, trigger: Expr, response: Expr) -> None:
        names = [v.name for v in (*system.frozen, *system.variables)]
        starts = [{**system.init, **frozen} for frozen in vectors(system.frozen)]
        queue: list[tuple[At, bool]] = [(at, False) for at in starts]
        self.edges: dict[Node, list[tuple[Node, At, bool]]] = {}
        while queue:
            at, waits = queue.pop()
            node = tuple(at[n] for n in names), waits
            if node in self.edges:
                continue
            self.edges[node] = []
            for then in successors(system, dict(at)):
                waiting = (waits or bool(evaluate(trigger, then))) and not evaluate(response, then)
                self.edges[node].append(((tuple(then[n] for n in names), waiting), then, waiting))
                queue.append((then, waiting))

    def breaks_leads_to(self, fair: Sequence[Expr]) -> bool:
        return self._cycle([(a, b, at) for a, b, at, waiting in self._all() if waiting], fair)

    def breaks_settles(self, premise: Expr, recurs: Sequence[Expr]) -> bool:
        return self._cycle([(a, b, at) for a, b, at, _ in self._all() if evaluate(premise, at)], recurs)

    def breaks_recoverable(self, to: Expr) -> bool:
        graph = nx.DiGraph([(a, b) for a, b, _, _ in self._all()])
        reached = {b for _, b, at, _ in self._all() if not evaluate(to, at)}
        good = {a for a, _, at, _ in self._all() if evaluate(to, at)}
        back = good.union(*(nx.ancestors(graph, a) for a in good))
        return bool(reached - back)

    def _all(self) -> list[tuple[Node, Node, At, bool]]:
        return [(a, b, at, waiting) for a, leaving in self.edges.items() for b, at, waiting in leaving]

    @staticmethod
    def _cycle(edges: list[tuple[Node, Node, At]], recurs: Sequence[Expr]) -> bool:
        graph = nx.DiGraph([(a, b) for a, b, _ in edges])
        for members in nx.strongly_connected_components(graph):
            inside = [at for a, b, at in edges if a in members and b in members]
            if inside and all(any(evaluate(c, at) for at in inside) for c in recurs):
                return True
        return False


def _prop(form: Form) -> Property:
    return Property("P-1", "sentence", form, ("R",), "random")


def _has_loop(system: TransitionSystem, form: Form, engine: str = "explicit") -> bool:
    question = reduce(system, [_prop(form)])
    asked = loop_query(question, question.goals[0])
    [goal] = [asked.lasso.goal]
    match engines()[engine].check(asked.lasso.system, [goal], Limits(), quiet)[goal.name]:
        case Reached(run):
            trace = looped(asked, run)
            assert trace.loop is not None and trace.loop < len(trace) == len(run)
            return True
        case Unreachable():
            return False
        case other:
            raise AssertionError(other)


drawn = st.data()
few = examples(40)


def _conditions(data: st.DataObject, system: TransitionSystem, count: int) -> list[Expr]:
    scope = [*system.variables, *system.inputs]
    return [data.draw(st.composite(lambda draw: booleans(draw, scope, 1))()) for _ in range(count)]


@few
@given(transition_systems(most=2), drawn)
def test_a_loop_is_found_exactly_when_a_response_can_stay_away(
    system: TransitionSystem, data: st.DataObject
) -> None:
    trigger, response, *fair = _conditions(data, system, data.draw(st.integers(2, 4)))
    found = _has_loop(system, LeadsTo(trigger, response, fair=tuple(fair)))
    assert found == Naive(system, trigger, response).breaks_leads_to(fair)


@few
@given(transition_systems(most=2), drawn)
def test_a_loop_is_found_exactly_when_a_run_need_not_settle(
    system: TransitionSystem, data: st.DataObject
) -> None:
    premise, then, *fair = _conditions(data, system, data.draw(st.integers(2, 3)))
    found = _has_loop(system, Settles(premise, then, fair=tuple(fair)))
    assert found == Naive(system, premise, then).breaks_settles(premise, [~then, *fair])


@few
@given(transition_systems(most=2), drawn)
def test_a_trap_is_found_exactly_when_there_is_one(system: TransitionSystem, data: st.DataObject) -> None:
    [to] = _conditions(data, system, 1)
    question = reduce(system, [_prop(Recoverable(to))])
    found = trapped(question, question.goals[0].var, quiet)
    assert isinstance(found, Trap) == Naive(system, to, to).breaks_recoverable(to)


# --- charts, replayed by the interpreter -----------------------------------------------------------

go, stay, jam = flag("go"), flag("stay"), flag("jam")
busy = flag("busy")
PLANT = Chart("Plant", [
    State("Idle", entry=[assign(busy, False)], transitions=[to("Busy", when=go)]),
    State("Busy", entry=[assign(busy, True)], transitions=[
        to("Broken", when=jam), to("Idle", when=after(60 * ms) & ~stay),
    ]),
    State("Broken"),
], default="Idle")  # fmt: skip
SYSTEMS = {
    "plant": in_order("plant", PLANT),
    "calm": in_order("calm", PLANT, assume=~jam),
    "ready": in_order("ready", PLANT, assume=~jam & ~stay),
}


def _decided(form: Form, on: str) -> Result:
    prop = Property("P-1", "sentence", form, ("R",), on)
    [task] = tasks([prop], SYSTEMS)
    [result] = decide(task, SYSTEMS, AUTO, Limits(), quiet)
    return result


def test_a_loop_is_shown_with_its_start_and_its_timers() -> None:
    verdict = _decided(LeadsTo(busy, ~busy), "calm").verdict
    assert isinstance(verdict, Violated) and isinstance(verdict.because, Trace)
    trace = verdict.because
    assert trace.loop == len(trace) - 1, "the timer of Busy stands still at its bound"
    text = render(trace)
    assert "↻" in text and "this tick repeats for ever" in text and f"Loop: back to tick {trace.loop}" in text
    assert "repeats for ever" in renderers("trace")["markdown"].render(trace)
    jsonschema.validate(document(trace), published("trace-3"))
    assert document(trace)["loop"] == trace.loop


def test_a_bound_proves_more_than_was_asked() -> None:
    verdict = _decided(LeadsTo(busy, ~busy, bound=60 * ms), "ready").verdict
    assert isinstance(verdict, Proved) and verdict.claim == "even within 60 ms"


@pytest.mark.parametrize("bound", [None, 20 * ms])
def test_without_a_bound_that_holds_all_loops_are_excluded(bound: object) -> None:
    form = LeadsTo(busy, ~busy, bound=None if bound is None else 1 * ticks)
    verdict = _decided(form, "ready").verdict
    assert isinstance(verdict, Proved) and isinstance(verdict.because, Exhausted) and verdict.claim == NO_LOOP


def test_fairness_leaves_out_runs_that_are_stuck_by_choice() -> None:
    assert isinstance(_decided(LeadsTo(busy, ~busy), "calm").verdict, Violated)
    assert isinstance(_decided(LeadsTo(busy, ~busy, fair=(~stay,)), "calm").verdict, Proved)
    assert isinstance(_decided(Settles(~stay, ~busy), "calm").verdict, Violated)
    assert isinstance(_decided(Settles(~stay & ~go, ~busy), "calm").verdict, Proved)


def test_a_trap_is_a_run_into_it_and_what_it_leads_to() -> None:
    verdict = _decided(Recoverable(PLANT.active("Idle")), "plant").verdict
    assert isinstance(verdict, Violated) and isinstance(verdict.because, Trace)
    assert verdict.because.trapped == 1 and verdict.because.ticks[-1].transitions[-1].target == "Broken"
    assert "No way back" in render(verdict.because)
    jsonschema.validate(document(verdict.because), published("trace-3"))
    assert isinstance(_decided(Recoverable(PLANT.active("Idle")), "calm").verdict, Proved)


def test_inputs_that_lead_back_prove_the_way_back() -> None:
    back = Recoverable(PLANT.active("Idle"), by=~stay & ~go, within=80 * ms)
    verdict = _decided(back, "calm").verdict
    assert isinstance(verdict, Proved) and verdict.claim == "even within 80 ms"


@pytest.mark.parametrize("by", [jam, busy, go & ~go])
def test_a_way_back_must_be_open_everywhere(by: Expr) -> None:
    with pytest.raises(ModelError, match="must be a condition on inputs of calm that can be met"):
        _decided(Recoverable(PLANT.active("Idle"), by=by, within=80 * ms), "calm")


def test_a_way_back_needs_both_its_parts() -> None:
    with pytest.raises(ModelError, match="A gives only one of by= and within="):
        forms.recoverable("A", "a", to=busy, by=go, covers=["R"], on="plant")


def test_an_over_approximation_has_ways_back_that_the_charts_lack() -> None:
    loose = System("plant", (PLANT,), over=True, concrete="exact")
    over = {"plant": loose, "exact": in_order("exact", PLANT)}
    prop = Property("P-1", "sentence", Recoverable(PLANT.active("Idle")), ("R",), "plant")
    [result] = decide(Task(over["plant"], (prop,)), over, AUTO, Limits(), quiet)
    assert isinstance(result.verdict, Unknown) and "over-approximation" in result.verdict.reason


@pytest.mark.parametrize(("concrete", "word"), [("calm", "violated"), ("ready", "proved")])
def test_a_loop_of_an_over_approximation_must_exist_in_the_system_it_stands_for(
    concrete: str, word: str
) -> None:
    known = {**SYSTEMS, "loose": System("loose", (PLANT,), over=True, concrete=concrete)}
    prop = Property("P-1", "sentence", LeadsTo(busy, ~busy), ("R",), "loose")
    [result] = decide(Task(known["loose"], (prop,)), known, AUTO, Limits(), quiet)
    assert result.system == concrete and result.verdict.word == word


def test_loops_are_not_proved_absent_when_the_search_is_cut_short() -> None:
    prop = Property("P-1", "sentence", LeadsTo(busy, ~busy, fair=(~stay,)), ("R",), "calm")
    [result] = decide(Task(SYSTEMS["calm"], (prop,)), SYSTEMS, AUTO, Limits(depth=4), quiet)
    assert isinstance(result.verdict, Unknown) and result.verdict.depth == 4


def _faulty(*_: object) -> NoReturn:
    raise AssertionError("of ours")


def _heard(*forms_: Form) -> tuple[list[Result], list[Fault]]:
    """What comes of properties of ``plant``, and the faults that are told."""
    props = tuple(Property(f"P-{n}", "sentence", form, ("R",), "plant") for n, form in enumerate(forms_))
    faults: list[Fault] = []
    with listening(faults.append):
        return list(decide(Task(SYSTEMS["plant"], props), SYSTEMS, AUTO, Limits(), quiet)), faults


def test_a_search_for_a_way_back_that_fails_costs_no_other_verdict(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recover, "trapped", _faulty)
    (back, leads), faults = _heard(Recoverable(PLANT.active("Idle")), LeadsTo(busy, ~busy))
    assert isinstance(back.verdict, Unknown) and "AssertionError: of ours" in back.verdict.reason
    assert isinstance(leads.verdict, Violated)
    assert [(f.who, f.system) for f in faults] == [("the search about P-0", "plant")]


def test_random_runs_that_fail_leave_the_engines_their_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(verdicts, "repeating_loop", _faulty)
    monkeypatch.setattr(verdicts, "_vast", lambda _: True)
    [leads], faults = _heard(LeadsTo(busy, ~busy))
    assert isinstance(leads.verdict, Violated) and [f.who for f in faults] == [verdicts.SETTLING]
