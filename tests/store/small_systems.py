"""Small systems of a chart or two, with edits and properties: small enough for a naive loop."""

from collections.abc import Callable, Sequence
from dataclasses import replace

from hypothesis import strategies as st
from hypothesis.strategies import DrawFn

from rovercheck.checker.mutate.mutants import mutants
from rovercheck.properties import forms
from rovercheck.properties.forms import Form, Property
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block, Chart, Component, Enabled, State, to
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Expr, Var, flag, implies, ite, var
from rovercheck.spec_model.lang.system import Assumption, System, in_order
from rovercheck.spec_model.lang.time import ticks
from rovercheck.spec_model.lang.words import after, held, minimum, previous

GO, PUSH, DIAL = flag("go"), flag("push"), var("dial", integer(0, 2))
LEFT, RIGHT, AGE, SUM = flag("left"), flag("right"), var("age", integer(0, 3)), var("sum", integer(0, 4))
CHOICE, SPARE = var("choice", integer(0, 1)), var("spare", integer(0, 2))
ELAPSED = var("elapsed", integer(20, 21, "ms"))
NAME = "Small"


def _guards(draw: DrawFn) -> Expr:
    return draw(
        st.sampled_from(
            [GO, ~GO, PUSH, GO & ~PUSH, DIAL >= 1, DIAL == 2, CHOICE == 1, after(2 * ticks),
             held(GO, 2 * ticks),
             LEFT, RIGHT & GO, AGE >= 2]
        )
    )  # fmt: skip


def _actions(draw: DrawFn, targets: Sequence[Var]) -> list[Action]:
    known: dict[str, list[Action]] = {
        "left": [assign(LEFT, GO), assign(LEFT, ~LEFT), assign(LEFT, True)],
        "right": [assign(RIGHT, PUSH & LEFT), assign(RIGHT, True), assign(RIGHT, False)],
        "age": [assign(AGE, minimum(AGE + 1, 3)), assign(AGE, 0), assign(AGE, AGE + 1), assign(AGE, DIAL)],
        "sum": [assign(SUM, minimum(SUM + DIAL, 4)), when(PUSH, [assign(SUM, 0)])],
    }
    return [draw(st.sampled_from(known[v.name])) for v in targets if draw(st.booleans())]


def _chart(draw: DrawFn, name: str, targets: Sequence[Var]) -> Chart:
    names = ["A", "B", "C"][: draw(st.integers(2, 3))]
    states = [
        State(
            one,
            entry=_actions(draw, targets),
            during=_actions(draw, targets) if draw(st.booleans()) else [],
            transitions=[
                *(
                    to(draw(st.sampled_from(names)), when=_guards(draw))
                    for _ in range(draw(st.integers(0, 1)))
                ),
                to(following, when=_guards(draw)),
            ],
        )
        for one, following in zip(names, (*names[1:], names[0]), strict=True)
    ]
    return Chart(name, states, default="A")


@st.composite
def small_systems(draw: DrawFn) -> System:
    """A system of one or two charts and a block, perhaps with an assumption that excludes all runs."""
    parts: list[Component] = [_chart(draw, "One", [LEFT, AGE]), _chart(draw, "Two", [RIGHT])]
    block = Block("Adding", _actions(draw, [SUM]) or [assign(SUM, SUM)])
    parts = parts[: draw(st.integers(1, 2))]
    parts.append(Enabled(GO | PUSH, block) if draw(st.integers(0, 3)) == 0 else block)
    kinds = [GO | PUSH, implies(DIAL == 2, ~GO), AGE <= 2, DIAL == SUM, implies(LEFT, GO), GO & ~GO, ~PUSH]
    assumed = [
        Assumption(f"A{n}", "", formula)
        for n, formula in enumerate(draw(st.lists(st.sampled_from(kinds), max_size=2)))
    ]
    return in_order(
        NAME,
        *parts,
        frozen=[CHOICE] if draw(st.booleans()) else [],
        assumptions=assumed,
        elapsed=ELAPSED if draw(st.integers(0, 4)) == 0 else None,
    )


Edit = Callable[[System], System]


def _wider(system: System) -> System:
    return replace(system, components=(*system.components, Block("Spare", [assign(flag("lit"), SPARE == 2)])))


EDITS: dict[str, Edit] = {
    "another name for readers": lambda s: replace(s, text="other"),
    "a block beside it": _wider,
    "one more assumption": lambda s: replace(s, assumptions=(*s.assumptions, Assumption("N", "", ~PUSH))),
    "an assumption that nothing meets": lambda s: replace(
        s, assumptions=(*s.assumptions, Assumption("N", "", SPARE > 2))
    ),
    "an assumption about what nothing reads": lambda s: replace(
        s, assumptions=(*s.assumptions, Assumption("N", "", SPARE >= 1))
    ),
    "no assumptions": lambda s: replace(s, assumptions=()),
    "longer ticks": lambda s: replace(s, tick_ms=25, step_ms=25),
    "longer steps": lambda s: replace(s, step_ms=40),
    "one more frozen variable": lambda s: replace(s, frozen=(*s.frozen, SPARE)),
    "no frozen variables": lambda s: replace(s, frozen=()),
    "more runs than it should": lambda s: replace(s, over=True),
    "fewer runs than it should": lambda s: replace(s, under=True),
    "a value outside a domain": lambda s: replace(
        s,
        components=(*s.components, Block("Over", [assign(var("top", integer(0, 2)), ite(GO, SPARE + 1, 0))])),
    ),
    "other order": lambda s: replace(s, components=s.components[::-1]),
}


@st.composite
def edits(draw: DrawFn, system: System) -> System:
    """The system with one edit: a mutant, or a change around the charts."""
    if draw(st.booleans()):
        made = mutants(system)
        if made:
            return draw(st.sampled_from(made)).system
    return EDITS[draw(st.sampled_from(sorted(EDITS)))](system)


FORMS: tuple[Form, ...] = (
    forms.Always(SUM <= 3), forms.Never(LEFT & GO), forms.Reachable(AGE == 3), forms.Reachable(SUM == 4),
    forms.Responds(GO, LEFT, 2 * ticks), forms.HoldsAfter(GO, 2 * ticks, LEFT),
    forms.HoldsFor(LEFT, ~PUSH, ticks),
    forms.LeavesOnlyIf(LEFT, GO), forms.EntersOnlyIf(AGE == 2, PUSH | GO), forms.Precedes(PUSH, AGE == 1),
    forms.Until(LEFT, AGE < 3, PUSH), forms.Always(DIAL <= 2), forms.Never(previous(GO) & (AGE == 3)),
)  # fmt: skip


def asked(system: System) -> list[Property]:
    """A property of each form that the system has the variables for."""
    known = {*system.written, *system.inputs, *(v.name for v in system.frozen)}
    props = [Property(f"P{n}", "", form, ("R",), system.name) for n, form in enumerate(FORMS)]
    return [p for p in props if {v for f in forms.formulas(p.form) for v in _names(f)} <= known]


def _names(formula: Expr) -> set[str]:
    from rovercheck.spec_model.lang.walk import variables

    return set(variables(formula))
