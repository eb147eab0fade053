"""Every form of property against its definition, written out over finite runs."""

from collections.abc import Callable, Mapping, Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st

from properties import forms
from properties.forms import Form, Property
from properties.reduce import reduce
from spec_model.lang.action import Assign
from spec_model.lang.errors import ModelError
from spec_model.lang.evaluate import step
from spec_model.lang.expr import Expr, flag
from spec_model.lang.system import TransitionSystem
from spec_model.lang.time import ms, ticks
from spec_model.lang.words import after, held, once, previous, rising

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
        (after(20 * ms) | p, r"A: `after\(20 ms\)` belongs to an arrow of a chart; in a property write"),
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
