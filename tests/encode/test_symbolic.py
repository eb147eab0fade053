"""The functions that symbolic execution finds agree with running the step."""

import random

from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.encode.cone import cone, constants, folded, settled
from rovercheck.checker.encode.symbolic import transition
from rovercheck.checker.system.intervals import intervals, postorder
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import boolean, enumeration, integer
from rovercheck.spec_model.lang.evaluate import admissible, evaluate, step
from rovercheck.spec_model.lang.expr import TRUE, Var, flag, ite, var
from rovercheck.spec_model.lang.system import TransitionSystem
from rovercheck.spec_model.lang.walk import nodes
from rovercheck.spec_model.lang.words import minimum
from tests.naive import search, vectors
from tests.profiles import examples
from tests.strategies_ts import goals, transition_systems


def some(variables: tuple[Var, ...], seed: random.Random) -> dict[str, int]:
    return {v.name: seed.choice(list(v.domain.values)) for v in variables}


def made(variables: tuple[Var, ...], *program: Assign | If, inputs: tuple[Var, ...] = ()) -> TransitionSystem:
    return TransitionSystem("made", inputs, (), variables, (), program)


@examples(400)
@given(transition_systems(), st.randoms(use_true_random=False))
def test_next_functions_agree_with_the_step(system: TransitionSystem, seed: random.Random) -> None:
    found = transition(system)
    known = intervals(*found.next.values())
    for _ in range(5):
        before, inputs = some((*system.variables, *system.frozen), seed), some(system.inputs, seed)
        after, at = step(system, before, inputs), {**before, **inputs}
        for name, function in found.next.items():
            value = evaluate(function, at)
            assert value == after[name]
            assert value in known[id(function)] and value in found.terms.range(function)
        assert all(evaluate(e, at) for e in found.assume) == bool(evaluate(system.assume, at))


@examples(300)
@given(transition_systems(), st.randoms(use_true_random=False))
def test_the_cone_computes_its_goals_alone(system: TransitionSystem, seed: random.Random) -> None:
    part = cone(folded(transition(system)), [goals(system)[0].name])
    inside = {v.name for v in (*part.variables, *part.inputs, *part.frozen)}
    at = {**system.init, **some(system.frozen, seed)}
    mine = {n: x for n, x in at.items() if n in inside}
    for _ in range(4):
        inputs = some(system.inputs, seed)
        if not admissible(system, at, inputs):
            continue
        here = {n: x for n, x in inputs.items() if n in inside}
        mine = {**mine, **{n: evaluate(e, {**mine, **here}) for n, e in part.next.items()}}
        at = {n: x for n, x in step(system, at, inputs).items() if n not in inputs}
        assert all(at[n] == mine[n] for n in part.next)


def test_a_location_tested_on_the_way_in_is_a_constant() -> None:
    place = var("place", enumeration("Place", ["A", "B", "C"]))
    count = var("count", integer(0, 9))
    a, b, c = (place.domain.raw(n) for n in "ABC")
    assert (a, b, c) == (0, 1, 2)
    kept = Assign(count, ite(place == "C", 1, count) + 0)
    inner = If(place == "A", (Assign(count, count * 0 + 5),), (kept,))
    outer = If(place == "A", (inner,), (If(place == "B", (inner,), (inner,)),))
    found = transition(made((place, count), outer)).next["count"]
    assert len({id(n) for n in nodes(found)}) <= 10
    assert [evaluate(found, {"place": p, "count": 7}) for p in (a, b, c)] == [5, 7, 1]


def test_a_guarded_count_stays_in_its_domain() -> None:
    count, go = var("count", integer(0, 100)), flag("go")
    step_ = If(go & (count + 1 <= 100), (Assign(count, count + 1),), (Assign(count, minimum(count, 3)),))
    found = transition(made((count,), step_, inputs=(go,)))
    assert found.terms.range(found.next["count"]).high == 100


def test_what_never_changes_is_folded_away() -> None:
    still, also, count = var("still", integer(0, 5), 2), flag("also"), var("count", integer(0, 9))
    system = made(
        (still, also, count),
        If(also, (Assign(still, still + 1),), (Assign(still, minimum(still, 4)),)),
        Assign(also, (still == 3) & also),
        Assign(count, ite(also, 0, minimum(count + still, 9))),
    )
    assert constants(transition(system)) == {"still": 2, "also": 0}
    part = cone(folded(transition(system)), ["count"])
    assert [v.name for v in part.variables] == ["count"]


def test_assumptions_on_inputs_outside_the_cone_are_loose() -> None:
    a, b, c = flag("a"), flag("b"), flag("c")
    seen, state = flag("seen"), flag("state")
    system = TransitionSystem(
        "made",
        (a, b, c),
        (),
        (seen, state),
        (),
        (Assign(seen, a), Assign(state, ~state)),
        (b | c) & (a | state),
    )
    part = cone(folded(transition(system)), ["seen"])
    assert {v.name for v in part.inputs} == {"a"} and {v.name for v in part.variables} == {"seen", "state"}
    assert len(part.loose) == 1


def test_children_come_before_parents() -> None:
    expr = flag("a") & TRUE
    for _ in range(5000):
        expr = ~(expr & flag("b"))
    order = {id(node): i for i, node in enumerate(postorder(expr))}
    assert all(
        order[id(child)] < order[id(node)] for node in postorder(expr) for child in getattr(node, "args", ())
    )


# --- folding --------------------------------------------------------------------------------------


@examples(60)
@given(transition_systems())
def test_what_is_folded_away_never_changes(system: TransitionSystem) -> None:
    """On every reachable state, under the assumption, the folded formulas give what a tick gives."""
    whole = folded(transition(system))
    for state in sorted(search(system, ()).states)[:40]:
        at = dict(state)
        for inputs in vectors(system.inputs):
            if admissible(system, at, inputs):
                after = step(system, at, inputs)
                assert all(evaluate(e, {**at, **inputs}) == after[n] for n, e in whole.next.items())


def test_an_input_that_the_assumption_settles_is_folded_away() -> None:
    stops, interpretation, mode = flag("stops"), var("reading", integer(0, 9)), var("mode", integer(0, 3))
    runs, level, goal = var("runs", boolean, True), var("level", integer(0, 9)), flag("goal")
    steps = (
        Assign(runs, runs & ~stops),
        Assign(level, interpretation),
        Assign(goal, ~runs | (level == 4) | (mode > 2)),
    )
    assumed = ~stops & (interpretation == 5) & (mode != 0)
    system = TransitionSystem(
        "settled", (stops, interpretation, mode), (), (runs, level, goal), (), steps, assumed
    )
    whole = transition(system)
    assert settled(whole) == {"stops": 0, "reading": 5}
    assert constants(whole) == {"runs": 1}
    part = cone(folded(whole), ["goal"])
    assert [v.name for v in part.inputs] == ["mode"] and [v.name for v in part.variables] == ["goal"]
    assert {str(e) for e in part.loose} == {"!stops", "reading == 5"}
