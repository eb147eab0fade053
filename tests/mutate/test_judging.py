"""The fate of every mutant of a small model, against a naive search of pairs of states."""

from dataclasses import replace
from functools import cache

import pytest

from rovercheck.checker.engines import Limits, quiet
from rovercheck.checker.mutate.fate import DOMAINS, Fate, MutantCase, MutantFate, judged
from rovercheck.checker.mutate.mutants import Mutant, mutants
from rovercheck.checker.mutate.observation import observable
from rovercheck.checker.mutate.plan import Plan, homes
from rovercheck.checker.mutate.relevance import as_it_is, cones
from rovercheck.checker.verify.decide import decide
from rovercheck.checker.verify.runs.known_runs import reached, run_of
from rovercheck.checker.verify.tasks import Task
from rovercheck.properties.forms import Reachable
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import assign, when
from rovercheck.spec_model.lang.chart import Block, Enabled
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import flag, ite, var
from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import System, in_order
from rovercheck.spec_model.lang.words import minimum
from tests.mutate.lamp import LIT, NEVER, NIGHT, QUIET, lamps
from tests.naive import search, vectors

PROPERTIES = (LIT, QUIET, NIGHT, NEVER)
PROVED = {"LIT": True, "QUIET": True, "NIGHT": True, "NEVER": False}
PLAN = Plan({"lamps": lamps}, PROPERTIES, dict[str, bool | None](PROVED), dict(PROVED))
MUTANTS = mutants(lamps)


@cache
def fate(mutant: Mutant) -> MutantFate:
    return judged(PLAN.own(mutant, "lamps").cases, Limits(), quiet)


def proved(system: System) -> dict[str, bool]:
    """The verdicts on a system by the naive search."""
    question = reduce(lower(system), PROPERTIES)
    reached = search(question.system, [g.var for g in question.goals]).reached
    return {g.property.id: (g.var.name in reached) == g.reach for g in question.goals}


def apart(original: System, mutant: System, names: set[str]) -> int | None:
    """After how many ticks the two can be told apart; None if they cannot."""
    one, other = lower(original), lower(mutant)
    frontier = [(one.init, other.init)]
    seen = {(tuple(one.init.items()), tuple(other.init.items()))}
    depth = 0
    while frontier:
        depth += 1
        following = []
        for ours, theirs in frontier:
            for inputs in vectors(one.inputs):
                after, beside = step(one, ours, inputs), step(other, theirs, inputs)
                if any(after[n] != beside[n] for n in names):
                    return depth
                pair = {n: after[n] for n in one.init}, {n: beside[n] for n in other.init}
                key = tuple(pair[0].items()), tuple(pair[1].items())
                if key not in seen:
                    seen.add(key)
                    following.append(pair)
        frontier = following
    return None


def test_the_naive_search_knows_the_original() -> None:
    assert proved(lamps) == PROVED
    assert apart(lamps, lamps, set(lamps.written)) is None


@pytest.mark.parametrize("mutant", MUTANTS, ids=lambda m: m.id)
def test_fates_agree_with_a_naive_search(mutant: Mutant) -> None:
    found = fate(mutant)
    try:
        lower(mutant.system)
    except ModelError:
        assert found.fate is Fate.NO_CHART
        return
    if found.killer == DOMAINS:
        return
    now = proved(mutant.system)
    killers = {id for id in now if PROVED[id] and not now[id]}
    if killers:
        assert found.fate is Fate.KILLED and found.killer in killers
        return
    if any(now[id] and not PROVED[id] for id in now):
        assert found.fate is Fate.NOTICED
        return
    names = observable(lamps, {"lit", "shade", "alarm"})
    ticks = apart(lamps, mutant.system, names)
    if ticks is None:
        assert found.fate in (Fate.EQUIVALENT, Fate.NO_CHANGE)
        return
    assert found.fate is Fate.SURVIVOR
    assert found.difference is not None
    assert len(found.difference) == ticks and found.difference.shortest


def test_every_kind_of_fate_occurs() -> None:
    fates = {fate(m).fate for m in MUTANTS}
    assert {Fate.KILLED, Fate.NOTICED, Fate.EQUIVALENT, Fate.SURVIVOR} <= fates


def raw(system: System, values: dict[str, str]) -> dict[str, int]:
    """Values as people write them, as the interpreter takes them."""
    table = {v.name: v for v in lower(system).inputs}
    return {
        n: next(r for r in table[n].domain.values if table[n].domain.show(r) == s) for n, s in values.items()
    }


def test_the_run_of_a_survivor_replays_on_the_interpreter() -> None:
    survivors = [m for m in MUTANTS if fate(m).fate is Fate.SURVIVOR]
    assert survivors
    for mutant in survivors:
        shown = fate(mutant).difference
        assert shown is not None
        one, other = Interpreter(lamps, {}), Interpreter(mutant.system, {})
        for inputs in shown.inputs:
            given = raw(lamps, dict(inputs))
            one.step(given)
            other.step(given)
        ours, theirs = one.data, other.data
        table = lamps.written
        assert {n: table[n].domain.show(ours[n]) for n in shown.original} == dict(shown.original)
        assert {n: table[n].domain.show(theirs[n]) for n in shown.mutant} == dict(shown.mutant)
        assert shown.original and all(ours[n] != theirs[n] for n in shown.original)


def test_a_mutant_that_leaves_a_domain_is_killed_without_a_property() -> None:
    go, n = flag("go"), var("n", integer(0, 3))
    system = in_order("count", Block("Count", [assign(n, ite(go & (n < 3), n + 1, 0))]))
    [wrong] = [m for m in mutants(system) if m.operator == "comparison"]
    found = judged([MutantCase(system, wrong.system, wrong.parts, (), {})], Limits(), quiet)
    assert (found.fate, found.killer) == (Fate.KILLED, DOMAINS)
    assert "outside integer in 0..3" in found.why


def test_only_properties_that_depend_on_the_part_are_asked() -> None:
    by_id = {c.property.id: c for c in cones(lamps, PROPERTIES)}
    assert "alarm" in by_id["QUIET"].written and "alarm" not in by_id["LIT"].written
    of = {m.part: {p.id for p in PLAN.own(m, "lamps").cases[0].properties} for m in MUTANTS}
    assert of == {"Lamp": {"LIT", "QUIET", "NIGHT", "NEVER"}, "Alarm": {"QUIET"}}


def test_a_time_that_is_over_makes_unknown() -> None:
    [one] = [m for m in MUTANTS if m.id == "Alarm/data/seen/initial"]
    found = judged(PLAN.own(one, "lamps").cases, Limits(seconds=1e-9), quiet)
    assert found.fate is Fate.UNKNOWN and "time" in found.why


def test_a_part_is_made_faulty_in_its_smallest_system() -> None:
    small = in_order("small", lamps.charts[0])
    assert homes({"lamps": lamps, "small": small}, ["lamps", "small"]) == {
        "lamps": ["Alarm"],
        "small": ["Lamp"],
    }
    assert homes({"lamps": lamps, "small": small}, ["lamps", "small"], ["Alarm"])["small"] == []
    assert homes({"lamps": lamps, "small": small}, ["lamps"]) == {"lamps": ["Lamp", "Alarm"]}


def test_a_part_is_made_faulty_where_most_runs_are() -> None:
    """What changes nothing in fewer runs is not equivalent."""
    fewer = in_order("fewer", lamps.charts[0], under=True)
    given = {"fewer": fewer, "lamps": lamps}
    assert homes(given, given) == {"fewer": [], "lamps": ["Lamp", "Alarm"]}


def test_runs_of_the_original_settle_only_what_a_search_finds_too() -> None:
    """What a known run still reaches has the verdict of the original."""
    results = decide(Task(as_it_is(lamps), PROPERTIES), {"lamps": lamps}, "auto", Limits())
    runs = {r.property.id: run for r in results if (run := run_of(r.verdict)) is not None}
    tried, forms = list(runs.values()), {p.id: p.form for p in PROPERTIES}
    assert runs and runs.keys() <= reached(lamps, PROPERTIES, tried).keys()
    settled = 0
    for mutant in MUTANTS:
        try:
            lower(mutant.system)
        except ModelError:
            continue
        verdicts = proved(mutant.system)
        for id in reached(mutant.system, PROPERTIES, tried):
            settled += 1
            assert verdicts[id] == isinstance(forms[id], Reachable), (mutant.id, id)
    assert settled


def test_a_fault_that_never_computes_anything_else_is_equivalent() -> None:
    n, twice = var("n", integer(0, 9)), var("twice", integer(0, 9))
    count = Block("Count", [assign(twice, minimum(n + n, 9)), assign(n, ite(n < 3, n + 1, 0))])
    system = in_order("count", count)
    [wrong] = [m for m in mutants(system) if m.operator == "limit-down" and "`9`" in m.text]
    found = judged([MutantCase(system, wrong.system, wrong.parts, (), {})], Limits(), quiet)
    assert found.fate is Fate.EQUIVALENT and found.why.startswith("the fault never computes anything else")


def test_a_wire_is_seen_by_what_its_readers_make_of_it() -> None:
    """What a slot begins with is not read: it is full only after it was written twice."""
    filled, full = flag("filled"), flag("full")
    newest, slot, seen, fresh = (var(name, integer(0, 3)) for name in ("newest", "slot", "seen", "fresh"))
    read = Block("Read", [when(full, [assign(seen, slot)])])
    fill = Block(
        "Fill", [assign(slot, newest), assign(full, filled), assign(newest, fresh), assign(filled, True)]
    )
    system = in_order("slots", read, fill)
    [wrong] = [m for m in mutants(system) if m.id == "Fill/data/newest/initial"]
    case = MutantCase(system, wrong.system, wrong.parts, (), {})
    found = judged([case], Limits(), quiet)
    assert found.fate is Fate.EQUIVALENT and found.why != ""
    for slot_matters in (
        replace(case, named=frozenset({"slot"})),
        replace(case, abroad=frozenset({"slot"})),
    ):
        assert judged([slot_matters], Limits(), quiet).fate is Fate.SURVIVOR


def test_what_is_written_before_others_read_it_has_no_initial_value_to_be_wrong() -> None:
    go, limit, seen, fresh = flag("go"), *(var(name, integer(0, 3)) for name in ("limit", "seen", "fresh"))
    write, read = Block("Write", [assign(limit, fresh)]), Block("Read", [assign(seen, limit)])
    together = in_order("together", Enabled(go, write, read))
    apart = in_order("apart", Enabled(go, write), read)
    initial = [{m.id for m in mutants(s) if m.operator == "initial"} for s in (together, apart)]
    assert initial == [{"Read/data/seen/initial"}, {"Write/data/limit/initial"}]
