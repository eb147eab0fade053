"""Every form of property against its definition, written out over finite runs."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.properties import forms
from rovercheck.properties.forms import Form, Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import Assign, assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import enumeration, fixed, integer
from rovercheck.spec_model.lang.errors import ModelError
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import Expr, Var, flag, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import TransitionSystem, in_order
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.words import after, held, once, previous, rising

p, q, r = flag("p"), flag("q"), flag("r")
x = flag("x")
FREE = TransitionSystem("free", (p, q, r), (), (x,), (), (Assign(x, p),))

Run = Sequence[Mapping[str, int]]
Broken = Callable[[Run, int, int], bool]
"""Whether the run's tick ``k`` (from 0) breaks the property, required from tick ``f`` (from 0) on."""


def _responds(n: int) -> Broken:
    return lambda u, k, f: (
        k - n >= f
        and any(u[j]["p"] and not any(u[i]["q"] for i in range(j, k + 1)) for j in range(f, k - n + 1))
    )


def _holds_after(n: int) -> Broken:
    return lambda u, k, f: k - n >= f and all(u[j]["p"] for j in range(k - n, k + 1)) and not u[k]["q"]


def _holds_for(n: int) -> Broken:
    def starts(u: Run, j: int) -> bool:
        return bool(u[j]["p"]) and not (j > 0 and u[j - 1]["p"])

    return lambda u, k, f: not u[k]["q"] and any(starts(u, j) for j in range(max(f, k - n), k + 1))


def _until(u: Run, k: int, f: int) -> bool:
    return not u[k]["q"] and any(
        u[j]["p"] and not any(u[i]["r"] for i in range(j, k + 1)) for j in range(f, k + 1)
    )


FORMS: dict[str, tuple[Form, Broken]] = {
    "always": (forms.Always(p | q), lambda u, k, f: k >= f and not (u[k]["p"] or u[k]["q"])),
    "never": (forms.Never(p & q), lambda u, k, f: k >= f and bool(u[k]["p"] and u[k]["q"])),
    "reachable": (forms.Reachable(p & q), lambda u, k, f: k >= f and bool(u[k]["p"] and u[k]["q"])),
    **{f"responds {n}": (forms.Responds(p, q, n * ticks), _responds(n)) for n in (0, 1, 3)},
    **{f"holds after {n}": (forms.HoldsAfter(p, n * ticks, q), _holds_after(n)) for n in (0, 1, 3)},
    **{f"holds for {n}": (forms.HoldsFor(p, q, n * ticks), _holds_for(n)) for n in (0, 1, 3)},
    "leaves only if": (
        forms.LeavesOnlyIf(p, q),
        lambda u, k, f: k >= max(f, 1) and bool(u[k - 1]["p"] and not u[k]["p"] and not u[k]["q"]),
    ),
    "enters only if": (
        forms.EntersOnlyIf(p, q),
        lambda u, k, f: k >= f and bool(u[k]["p"] and not (k > 0 and u[k - 1]["p"]) and not u[k]["q"]),
    ),
    "precedes": (
        forms.Precedes(q, p),
        lambda u, k, f: k >= f and bool(u[k]["p"]) and not any(u[j]["q"] for j in range(k + 1)),
    ),
    "until": (forms.Until(p, q, r), _until),
    "previous": (forms.Always(previous(p)), lambda u, k, f: k >= f and not (k > 0 and u[k - 1]["p"])),
    "rising": (
        forms.Never(rising(p)),
        lambda u, k, f: k >= max(f, 1) and bool(u[k]["p"] and not u[k - 1]["p"]),
    ),
    "once": (forms.Always(once(p)), lambda u, k, f: k >= f and not any(u[j]["p"] for j in range(k + 1))),
    "held": (
        forms.Never(held(p, 2 * ticks)),
        lambda u, k, f: k >= max(f, 2) and all(u[j]["p"] for j in range(k - 2, k + 1)),
    ),
    "previous of held": (
        forms.Never(previous(held(p, 1 * ticks))),
        lambda u, k, f: k >= max(f, 2) and bool(u[k - 1]["p"] and u[k - 2]["p"]),
    ),
}  # fmt: skip

values = st.fixed_dictionaries({"p": st.integers(0, 1), "q": st.integers(0, 1), "r": st.integers(0, 1)})
runs = st.lists(st.tuples(values, st.integers(1, 4)), min_size=1, max_size=6).map(
    lambda blocks: [v for v, n in blocks for _ in range(n)]
)


def _broken_at(prop: Property, run: Run) -> list[bool]:
    question = reduce(FREE, [prop])
    at = dict(question.system.init)
    found = []
    for inputs in run:
        after_tick = step(question.system, at, inputs)
        found.append(bool(after_tick[prop.id]))
        at = {n: v for n, v in after_tick.items() if n not in inputs}
    return found


@pytest.mark.parametrize("name", FORMS)
@given(run=runs, from_tick=st.integers(1, 3))
def test_a_form_is_broken_exactly_where_its_definition_says(name: str, run: Run, from_tick: int) -> None:
    form, broken = FORMS[name]
    prop = Property("P", "sentence", form, ("R",), "free", from_tick)
    found = _broken_at(prop, run)
    wanted = [broken(run, k, from_tick - 1) for k in range(len(run))]
    # A monitor may stay silent after its first alarm or repeat it; the first one must be right.
    assert _first(found) == _first(wanted)


def test_properties_with_the_same_memory_share_one_variable() -> None:
    both = [
        forms.always("A", "a", that=previous(p) | q, covers=["R"], on="free"),
        forms.always("B", "b", that=previous(p) | r, covers=["R"], on="free"),
    ]
    question = reduce(FREE, both)
    assert [v.name for v in question.system.variables] == ["x", "previous(p)", "A", "B"]
    assert question.goals[0].memory == question.goals[1].memory == {"previous(p)"}


def test_the_false_conjuncts_of_a_property_are_its_parts() -> None:
    [goal] = reduce(FREE, [forms.always("A", "a", that=p & q, covers=["R"], on="free")]).goals
    assert [str(shown) for shown, _ in goal.parts] == ["p", "q"]


@pytest.mark.parametrize(
    ("that", "message"),
    [
        (flag("xx") | p, r"A reads xx, which system free does not have\. Did you mean 'x'"),
        (after(20 * ms) | p, r"A: `after\(20 ms\)` belongs to a transition of a chart; in a property write"),
        (held(p, 10**30 * ticks), r"`held\(p, 10{30} ticks\)`: 10{30} ticks is longer than any board counts"),
        (held(p, 30 * ms), r"30 ms is not a whole number of ticks of 20 ms; write a multiple"),
    ],
)
def test_a_property_without_meaning_says_what_to_write(that: Expr, message: str) -> None:
    with pytest.raises(ModelError, match=message):
        reduce(FREE, [forms.always("A", "a", that=that, covers=["R"], on="free")])


def test_a_property_covers_at_least_one_requirement() -> None:
    with pytest.raises(ModelError, match="A covers no requirement"):
        forms.always("A", "a", that=p, covers=[], on="free")


def _first(broken: list[bool]) -> int | None:
    return broken.index(True) if True in broken else None


MODE, EDOM = enumeration("Mode", ["STOP", "GO"]), enumeration("Mode", ["GO", "STOP"])
LEVEL = fixed(0, 10, 0.1, "m")


@pytest.mark.parametrize(
    ("written", "other"),
    [
        (var("y", LEVEL), var("y", integer(0, 1000, "cm")) <= 100),
        (var("y", LEVEL), var("y", fixed(0, 100, 0.1, "mm")) <= 1),
        (var("y", MODE), var("y", EDOM) == "GO"),
        (flag("y"), previous(var("y", integer(0, 3)) > 1)),
    ],
    ids=["another unit", "another scale", "members in another order", "a number for a boolean"],
)
def test_a_name_means_one_thing_in_a_property_and_its_system(written: Var, other: Expr) -> None:
    """``y`` in m never above 100 cm was proved: what is compared are raw values."""
    system = TransitionSystem("S", (), (), (written,), (), ())
    with pytest.raises(ModelError, match="P and system S: two variables are named y"):
        reduce(system, [Property("P", "a property", forms.Always(other), ("R",), "S")])


def test_what_monitors_remember_has_a_name_of_its_own() -> None:
    """An input was taken for the memory of a property, whatever it was called."""
    other = flag("previous(p)")
    system = replace(FREE, inputs=(*FREE.inputs, other))
    question = reduce(
        system, [Property("P", "a property", forms.Always(previous(p) | ~other), ("R",), "free")]
    )
    names = [v.name for v in (*question.system.variables, *question.system.inputs)]
    assert len(set(names)) == len(names) and sum(n.startswith("previous(p)") for n in names) == 2


@pytest.mark.parametrize("taken", ["x", "p", "Q", "Q.waiting"])
def test_an_id_is_the_name_of_no_variable(taken: str) -> None:
    """The monitor wrote that variable: properties that are false were proved beside it, and certified."""
    waiting = Property("Q", "another", forms.Responds(p, q, 3 * ticks), ("R",), "free")
    with pytest.raises(ModelError, match="its monitor has the name"):
        reduce(FREE, [waiting, Property(taken, "a property", forms.Always(p), ("R",), "free")])


def test_variables_of_a_system_have_names_of_their_own() -> None:
    """A flag named as the check of a domain switched it off."""
    n, check = var("n", integer(0, 3)), flag("n.out_of_domain")
    counting = Block("Count", [assign(n, n + 1), assign(check, False)])
    with pytest.raises(ModelError, match=r"S: two variables would be named n\.out_of_domain"):
        lower(in_order("S", counting))


def test_a_property_reads_the_variable_of_its_system() -> None:
    """With its domain: memories of a narrower twin would be too small."""
    system = TransitionSystem("S", (), (), (var("y", integer(0, 9)),), (), ())
    narrow = previous(var("y", integer(0, 3))) < 2
    [memory] = [
        v
        for v in reduce(
            system, [Property("P", "a property", forms.Always(narrow), ("R",), "S")]
        ).system.variables
        if v.name.startswith("previous")
    ]
    assert memory.domain == integer(0, 9)


@pytest.mark.parametrize(
    ("form", "argument"),
    [
        (forms.Responds(p, q, 10**30 * ticks), "within"),
        (forms.HoldsAfter(p, 10**30 * ticks, q), "for_"),
        (forms.HoldsFor(p, q, 10**30 * ticks), "for_"),
    ],
)
def test_a_time_that_nobody_counts_names_its_argument(form: Form, argument: str) -> None:
    """What was told was the size of a domain that nobody had written."""
    with pytest.raises(ModelError, match=f"^P: {argument}=10{{30}} ticks is longer than any board counts"):
        reduce(FREE, [Property("P", "", form, (), "free")])


def test_a_first_tick_that_nobody_counts_is_named() -> None:
    with pytest.raises(ModelError, match=r"^P: from_tick=10{20} is later than any board counts"):
        reduce(FREE, [Property("P", "", forms.Always(p), (), "free", from_tick=10**20)])
