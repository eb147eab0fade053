"""Runs gone through as compiled Python: the same goals after the same ticks as by the reference semantics."""

from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.results.verdict import Run
from rovercheck.checker.verify.runs import known_runs
from rovercheck.checker.verify.runs.compiled_step import CompiledStep, TooDeep
from rovercheck.checker.verify.runs.known_runs import reached
from rovercheck.properties.forms import Property
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import admissible, step
from rovercheck.spec_model.lang.expr import Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.system import System, TransitionSystem
from tests.mutate.lamp import LIT, NEVER, lamps
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems
from tests.toys import GOAL, filling, relay


def plainly(
    system: TransitionSystem,
    wanted: Sequence[Var],
    frozen: Mapping[str, int],
    inputs: Sequence[dict[str, int]],
) -> dict[str, int]:
    found: dict[str, int] = {}
    at: Mapping[str, int] = {**system.init, **frozen}
    for number, tick in enumerate(inputs, start=1):
        if not admissible(system, at, tick):
            break
        after = step(system, at, tick)
        if any(after[check.name] for check, _ in system.checks):
            break
        for goal in wanted:
            if after[goal.name]:
                found.setdefault(goal.name, number)
        at = {n: v for n, v in after.items() if n not in tick}
    return found


@examples(80)
@given(st.data())
def test_the_same_goals_after_the_same_ticks(data: st.DataObject) -> None:
    system = data.draw(transition_systems())

    def values(variables: Sequence[Var]) -> dict[str, int]:
        return {v.name: data.draw(st.sampled_from(list(v.domain.values))) for v in variables}

    frozen, wanted = values(system.frozen), goals(system)
    inputs = [values(system.inputs) for _ in range(data.draw(st.integers(0, 6)))]
    assert CompiledStep(system, wanted).first(frozen, inputs) == plainly(system, wanted, frozen, inputs)


def test_a_run_ends_where_inputs_are_not_allowed() -> None:
    system = filling(2)
    full = system.var("full")
    held, refused = {"hold": 1, "noise": 5}, {"hold": 1, "noise": 3}
    compiled = CompiledStep(system, [full])
    assert compiled.first({}, [held, held]) == {"full": 2}
    assert compiled.first({}, [held, refused, held]) == {}
    assert compiled.first({}, [held, {"hold": 1, "noise": 4}, held]) == {}


def test_what_a_run_does_not_say_is_as_it_begins() -> None:
    assert CompiledStep(relay(), [relay().var("on")]).first({"nothing": 3}, [{}, {"critical": 1}]) == {
        "on": 2
    }


def test_a_frozen_value_outside_its_domain_is_no_run() -> None:
    phase = var("phase", integer(0, 3))
    system = TransitionSystem("phased", (), (phase,), (GOAL,), (), (Assign(GOAL, phase >= 2),))
    assert CompiledStep(system, [GOAL]).first({"phase": 2}, [{}]) == {"goal": 1}
    assert CompiledStep(system, [GOAL]).first({"phase": 7}, [{}]) == {}


def test_what_is_shared_and_nested_deeply_is_written_once() -> None:
    count = var("count", integer(0, 1))
    value: Expr = count
    for _ in range(300):  # as a tree, more operators than there are atoms
        value = ite(value == 1, value, 1 - value)
    system = TransitionSystem("nested", (), (), (count, GOAL), (), (Assign(GOAL, value == 1),))
    assert CompiledStep(system, [GOAL]).first({}, [{}]) == {"goal": 1}


def test_branches_beyond_all_measure_are_told() -> None:
    go = flag("go")
    program: tuple[Assign | If, ...] = (Assign(GOAL, go),)
    for _ in range(200):
        program = (If(go, program),)
    system = TransitionSystem("deep", (go,), (), (GOAL,), (), program)
    with pytest.raises(TooDeep):
        CompiledStep(system, [GOAL])


def test_what_only_compiled_code_finds_is_a_bug_of_ours(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("rovercheck.checker.verify.runs.known_runs._first", lambda _: lambda run: {"LIT": 1})
    with pytest.raises(AssertionError, match="LIT: a run of 1 ticks reaches it only as compiled"):
        reached(lamps, [LIT], [Run({}, ({"press": 0, "level": 0},))])


def test_a_long_run_on_record_is_not_confirmed_once_more(monkeypatch: pytest.MonkeyPatch) -> None:
    off, on = {"press": 0, "level": 0}, {"press": 1, "level": 2}
    run = Run({}, (off,) * known_runs.SHORT + (on,) * 4)
    confirmed, way = list[int](), known_runs.confirm

    def noted(system: System, prop: Property, reaching: Run) -> None:
        confirmed.append(len(reaching))
        way(system, prop, reaching)

    monkeypatch.setattr(known_runs, "confirm", noted)
    found = known_runs.reached_by(run, lamps, NEVER, confirmed=False)
    assert found is not None and len(found) > known_runs.SHORT and not confirmed
    assert known_runs.reached_by(run, lamps, NEVER) == found and confirmed == [len(found)]
