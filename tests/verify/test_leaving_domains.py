"""A model that leaves a domain is refused, whatever is asked of it and by whom: nothing is proved of it.

It has no meaning from that tick on; what the lowered system does then is nobody's run.
"""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import get_args

import pytest

from rovercheck.checker.engines import ALL, AUTO, Engine, Limits, Progress, engines, explicit
from rovercheck.checker.explore.graphs.construction import made
from rovercheck.checker.results.graph import ProjectionKind
from rovercheck.checker.results.trace import Trace
from rovercheck.checker.results.verdict import (
    Answer,
    Exhausted,
    Open,
    Proved,
    Reached,
    Run,
    Unknown,
    Violated,
)
from rovercheck.checker.system.lowering_cache import lowered
from rovercheck.checker.verify.decide import Task, decide
from rovercheck.checker.verify.result import Result
from rovercheck.checker.verify.runs.domains import LeavesDomain, stray
from rovercheck.checker.verify.runs.minimise import minimise_inputs
from rovercheck.checker.verify.runs.replay import replay
from rovercheck.checker.verify.searches import SearchSettings, TaskEvent, searches
from rovercheck.properties import forms
from rovercheck.properties.forms import Form, Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import Assign, assign
from rovercheck.spec_model.lang.chart import Block, Chart, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.expr import Expr, Var, flag, ite, var
from rovercheck.spec_model.lang.system import System, TransitionSystem, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import minimum

X, Y, GO, PUSH = var("x", integer(0, 3)), var("y", integer(0, 7)), flag("go"), flag("push")
LAMP = Chart(
    "Lamp",
    [State("Off", transitions=[to("On", when=PUSH)]), State("On", transitions=[to("Off", when=~PUSH)])],
    default="Off",
)
ON = LAMP.active("On")
TWO = 2 * ticks


def model(name: str, change: Assign) -> System:
    return in_order(name, LAMP, Block("Count", [assign(Y, minimum(Y + 1, 7))]), Block("Change", [change]))


MODELS = {
    "in every run": model("every", assign(X, X + 1)),
    "in some runs": model("some", assign(X, ite(GO, X + 1, 0))),
    "late": model("late", assign(X, ite(Y == 7, X + 1, X))),
}
ASKED = {
    "of what leaves it": (X < 2, X == 3),
    "of what does not depend on it": (~ON, ON),
    "of what comes afterwards": (Y < 5, (Y >= 6) & ON),
}


def every_form(often: Expr, once: Expr) -> dict[str, Form]:
    return {
        "always": forms.Always(often),
        "never": forms.Never(once),
        "responds": forms.Responds(once, often, TWO),
        "holds after": forms.HoldsAfter(often, TWO, once),
        "holds for": forms.HoldsFor(often, once, TWO),
        "leaves only if": forms.LeavesOnlyIf(often, once),
        "enters only if": forms.EntersOnlyIf(often, once),
        "precedes": forms.Precedes(often, once),
        "until": forms.Until(often, ~once, once),
        "reachable": forms.Reachable(once),
        "leads to": forms.LeadsTo(often, once),
        "leads to within": forms.LeadsTo(often, once, TWO),
        "settles": forms.Settles(often, once),
        "settles within": forms.Settles(often, once, TWO),
        "recoverable": forms.Recoverable(often),
        "recoverable by": forms.Recoverable(often, ~PUSH, TWO),
    }


def test_every_form_is_asked() -> None:
    assert {type(form) for form in every_form(X > 0, X > 1).values()} == set(get_args(forms.Form))


def asked(system: System, form: Form, engine: str | Engine, limits: Limits) -> Result:
    found = decide(Task(system, (prop(system, form),)), {system.name: system}, engine, limits)
    return next(iter(found))


def prop(system: System, form: Form, id: str = "P") -> Property:
    return Property(id, "a property", form, ("R",), system.name)


@pytest.mark.usefixtures("engines_in_this_process")
@pytest.mark.parametrize("engine", [AUTO, ALL, *sorted(engines())])
@pytest.mark.parametrize(
    ("leaves", "about"),
    [
        ("in every run", "of what comes afterwards"),
        ("in some runs", "of what leaves it"),
        ("late", "of what does not depend on it"),
    ],
)
def test_it_is_refused_whatever_is_asked(leaves: str, about: str, engine: str) -> None:
    """``recoverable`` was proved: no engine was asked about the checks of the system."""
    limits = Limits(depth=20 if engine in ("bmc", ALL) else None)
    for name, form in every_form(*ASKED[about]).items():
        with pytest.raises(
            LeavesDomain, match=r"x := .* gives 4, outside integer in 0\.\.3, (first )?in tick"
        ):
            raise AssertionError((name, asked(MODELS[leaves], form, engine, limits)))


@pytest.mark.usefixtures("engines_in_this_process")
@pytest.mark.parametrize("name", every_form(X > 0, X > 1))
def test_no_proof_without_having_looked_far_enough(name: str) -> None:
    """In eight ticks it is not found that the model leaves a domain, and nothing that needs it is proved."""
    form = every_form(~ON, ON)[name]
    for engine in (AUTO, *engines()):
        with suppress(LeavesDomain):  # some look further than they are asked to
            verdict = asked(MODELS["late"], form, engine, Limits(depth=8)).verdict
            witness = isinstance(verdict, Proved) and isinstance(verdict.because, Trace)
            assert isinstance(verdict, Unknown | Violated) or witness, (engine, verdict)


# --- runs through an exit -------------------------------------------------------------------------


@dataclass
class Deep:
    """The explicit engine, of whose answers some are found no time for; runs are as the ``runs`` say."""

    late: tuple[str, ...]
    runs: Mapping[str, Run]
    NAME: str = "deep"
    SUMMARY: str = "for tests"

    def check(
        self, system: TransitionSystem, goals: Sequence[Var], limits: Limits, progress: Progress
    ) -> Mapping[str, Answer]:
        found = dict(explicit.check(system, goals, limits, progress))
        found |= {g.name: Reached(self.runs[g.name], shortest=True) for g in goals if g.name in self.runs}
        return found | {n: Open("no time", 0) for n in found if n.startswith(self.late)}


def after(count: int) -> Run:
    return Run({}, ({"push": 1},) * count)


@pytest.mark.usefixtures("engines_in_this_process")
def test_a_run_through_an_exit_is_a_mistake_of_the_model() -> None:
    """It was told as an internal error when the engine had not come to the check, or found a longer run."""
    system = MODELS["in every run"]
    engine = Deep(("x.out_of_domain",), {"P": after(6)})
    expected = r"_domains\.py:\d+: every: x := x \+ 1 gives 4, outside integer in 0\.\.3, in tick 4 of a run"
    for form in (forms.Never((Y == 6) & ON), forms.Reachable((Y == 6) & ON)):
        with pytest.raises(LeavesDomain, match=expected):
            raise AssertionError(asked(system, form, engine, Limits()))


def test_replay_names_tick_and_assignment() -> None:
    question = reduce(lowered(MODELS["in every run"]), [prop(MODELS["in every run"], forms.Never(Y == 6))])
    with pytest.raises(LeavesDomain, match=r"x := x \+ 1 gives 4, outside integer in 0\.\.3, in tick 4"):
        replay(question.system, question.goals[0], after(6))


def test_a_run_is_not_calmed_into_an_exit() -> None:
    """At rest the input that makes ``x`` grow is the calmer one, and the run would then leave the domain."""
    stop = flag("stop")
    system = in_order(
        "stopped", LAMP, Block("Count", [assign(Y, minimum(Y + 1, 7)), assign(X, ite(stop, 0, X + 1))])
    )
    question = reduce(lowered(system), [prop(system, forms.Never((Y == 7) & ON))])
    run = Run({}, ({"push": 1, "stop": 1},) * 7)
    calm = minimise_inputs(question.system, question.goals[0].var, run)
    assert stray(question.system, calm) is None and stray(question.system, run) is None
    assert len(calm) == 7 and any(tick["stop"] for tick in calm.inputs)


def test_what_leaves_its_domain_first_is_told() -> None:
    """Two variables leave theirs in one tick: the assignment that is executed first is named."""
    z = var("z", integer(0, 3))
    lowered_ = lowered(in_order("two", Block("Both", [assign(z, z + 2), assign(X, X + 2)])))
    found = stray(lowered_, Run({}, ({},) * 5))
    assert found is not None
    assert (found.tick, found.assignment.var.name, found.value) == (2, "z", 4)


def test_the_first_of_several_is_told() -> None:
    """The checks were told in the order in which they are declared, and the run called first."""
    z, a, b = var("z", integer(0, 1)), flag("a"), flag("b")
    both = Block("Both", [assign(X, ite(a, X + 1, 0)), assign(z, ite(b, z + 1, 0))])
    system = in_order("two", both)
    for engine in (AUTO, "bdd", "bmc", "explicit"):
        with pytest.raises(LeavesDomain, match=r"z := .* gives 2, .*, first in tick 2"):
            raise AssertionError(asked(system, forms.Always(X < 4), engine, Limits(depth=20)))


def test_an_over_approximation_is_refused_before_all_else() -> None:
    """``recoverable`` was unknown, for an over-approximation has more ways back than the charts."""
    system = replace(MODELS["in every run"], over=True)
    for form in (forms.Recoverable(ON), forms.LeadsTo(ON, ~ON)):
        with pytest.raises(LeavesDomain, match="first in tick 4"):
            raise AssertionError(asked(system, form, AUTO, Limits()))


# --- no proof is printed that is then taken back --------------------------------------------------


def real_and_larger() -> tuple[System, System]:
    """A system that leaves a domain in every run, and a sound one with more runs that stands for it."""
    larger = in_order("larger", LAMP, Block("Noise", [assign(Y, var("noise", integer(0, 7)))]), over=True)
    return MODELS["in every run"], replace(larger, concrete="every")


def test_a_run_of_an_over_approximation_is_no_run_of_a_model_that_has_no_meaning() -> None:
    real, larger = real_and_larger()
    task = Task(larger, (prop(larger, forms.Reachable(ON)),))
    with pytest.raises(LeavesDomain, match=r"every: x := .* first in tick 4"):
        raise AssertionError(list(decide(task, {s.name: s for s in (real, larger)}, AUTO, Limits())))


def test_a_proof_waits_for_the_searches_of_the_system_that_it_is_about() -> None:
    """It was printed, for it had been searched for in another system."""
    real, larger = real_and_larger()
    witness, other = prop(larger, forms.Reachable(ON), "A"), prop(real, forms.Never(Y == 8), "B")
    todo = [Task(larger, (witness,)), Task(real, (other,))]
    engine = Deep(("x.out_of_domain",), {"B": after(12)})
    results: list[Result] = []
    with pytest.raises(ModelError, match=r"every: x := .* in tick 4 of a run"):
        for one in searches(
            todo, {s.name: s for s in (real, larger)}, SearchSettings(engine, Limits(memory=1 << 30), 1)
        ):
            results += [one] if isinstance(one, Result) else []
    assert not results


def heard(system: System, engine: Engine, *properties: Property) -> Iterator[TaskEvent]:
    todo = [Task(system, (p,)) for p in properties]
    yield from searches(todo, {system.name: system}, SearchSettings(engine, Limits(memory=1 << 30), 1))


def test_a_proof_waits_for_the_other_searches_of_its_system() -> None:
    """The first search has a witness and no time for the check, the second finds that the model is wrong."""
    system = MODELS["late"]
    witness, other = prop(system, forms.Reachable(ON), "A"), prop(system, forms.Never(Y == 8), "B")
    engine = Deep(("x.out_of_domain",), {"B": after(12)})
    results: list[Result] = []
    with pytest.raises(ModelError, match="in tick 10 of a run"):
        results += [one for one in heard(system, engine, witness, other) if isinstance(one, Result)]
    assert not results


def test_a_witness_counts_where_nothing_is_found_out() -> None:
    system = MODELS["late"]
    first, second = (prop(system, forms.Reachable(ON), id) for id in "AB")
    engine = Deep(("x.out_of_domain",), {})
    found = [one for one in heard(system, engine, first, second) if isinstance(one, Result)]
    assert [type(one.verdict) for one in found] == [Proved, Proved]


# --- graphs ---------------------------------------------------------------------------------------


def test_a_graph_does_not_go_on_after_an_exit() -> None:
    with pytest.raises(LeavesDomain, match=r"gives 4, outside integer in 0\.\.3, first in tick 4"):
        made(lowered(MODELS["in every run"]), ["x"])


def test_a_graph_that_does_not_look_at_a_domain_is_not_exact() -> None:
    """Its paths go on where the runs of the model may end."""
    graph = made(lowered(MODELS["in every run"]), ["Lamp"]).graph
    assert graph.kind is ProjectionKind.OVER
    assert graph.because == ("whether x may leave the domain, where a run ends, was not looked into",)


def test_checks_are_no_variables_to_project_on() -> None:
    [(check, _)] = lowered(MODELS["late"]).checks
    assert check.hidden


def test_valuations_are_counted_without_the_flag_of_the_property() -> None:
    """The lamp has three states, none yet, off and on; with the flag of the property there were four."""
    system = in_order("lamp", LAMP)
    verdict = asked(system, forms.Recoverable(ON & PUSH), AUTO, Limits()).verdict
    assert isinstance(verdict, Proved) and isinstance(verdict.because, Exhausted)
    assert verdict.because.states == 3 and verdict.because.variables == ("Lamp",)
    assert verdict.because.depth == 2, "ticks to its own states"
