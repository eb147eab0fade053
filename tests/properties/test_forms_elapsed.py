"""Forms with a length in ms where ticks last unlike times, against their definition on random runs."""

from collections.abc import Callable, Sequence
from itertools import accumulate

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.properties import forms
from rovercheck.properties.english import sentence
from rovercheck.properties.forms import Form, Property
from rovercheck.properties.reduce import reduce
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.evaluate import step
from rovercheck.spec_model.lang.expr import flag, var
from rovercheck.spec_model.lang.lower import lower
from rovercheck.spec_model.lang.system import in_order
from rovercheck.spec_model.lang.time import ms, ticks
from rovercheck.spec_model.lang.words import held

p, q, x = flag("p"), flag("q"), flag("x")
passed = var("passed", integer(19, 21, "ms"), 20)
SYSTEM = in_order("measured", Block("B", [assign(x, p & q)]), elapsed=passed)

Tick = tuple[int, bool, bool]
"""How long a tick lasted, and p and q in it."""
Broken = Callable[[Sequence[int], Sequence[bool], Sequence[bool], int], bool]
"""Whether tick ``k`` of a run breaks the form; the first are the times at the ends of the ticks."""


def _held(t: Sequence[int], p: Sequence[bool], k: int, span: int) -> bool:
    return any(all(p[j : k + 1]) and t[k] - t[j] >= span for j in range(k + 1))


def _holds_for(t: Sequence[int], p: Sequence[bool], q: Sequence[bool], k: int) -> bool:
    starts = [j for j in range(k + 1) if p[j] and not (j and p[j - 1])]
    return not q[k] and any(t[k] - t[j] <= 60 for j in starts)


def _responds(t: Sequence[int], p: Sequence[bool], q: Sequence[bool], k: int) -> bool:
    """By this tick some trigger has had its 60 ms without a response in them."""
    return any(
        p[j] and t[k] - t[j] >= 60 and not any(q[i] for i in range(j, k + 1) if t[i] - t[j] <= 60)
        for j in range(k + 1)
    )


FORMS: dict[str, tuple[Form, Broken]] = {
    "holds after": (
        forms.HoldsAfter(p, 60 * ms, q), lambda t, p, q, k: _held(t, p, k, 60) and not q[k]
    ),
    "held": (forms.Never(held(p, 60 * ms)), lambda t, p, q, k: _held(t, p, k, 60)),
    "held for ticks": (
        forms.Never(held(p, 3 * ticks)), lambda t, p, q, k: k >= 3 and all(p[k - 3 : k + 1])
    ),
    "holds for": (forms.HoldsFor(p, q, 60 * ms), _holds_for),
    "responds": (forms.Responds(p, q, 60 * ms), _responds),
}  # fmt: skip


@pytest.mark.parametrize("name", FORMS)
@given(run=st.lists(st.tuples(st.sampled_from([19, 20, 21]), st.booleans(), st.booleans()), max_size=20))
def test_a_form_is_broken_first_where_its_definition_is(name: str, run: list[Tick]) -> None:
    form, broken = FORMS[name]
    question = reduce(lower(SYSTEM), [Property("P", "", form, ("R",), "measured")])
    at: dict[str, int] = dict(question.system.init)
    flags = []
    for length, now_p, now_q in run:
        at = {**step(question.system, at, {"passed": length, "p": int(now_p), "q": int(now_q)})}
        flags.append(bool(at["P"]))
    times = list(accumulate(length for length, _, _ in run))
    true_p, true_q = [one for _, one, _ in run], [one for _, _, one in run]
    wanted = [broken(times, true_p, true_q, k) for k in range(len(run))]
    assert (flags.index(True) if any(flags) else None) == (wanted.index(True) if any(wanted) else None)


@pytest.mark.parametrize("form, said", [
    (forms.HoldsAfter(p, 60 * ms, q),
     "Whenever in each of successive steps, the first and the last at least 60 ms apart, p is true, "
     "then in the last of them q is true."),
    (forms.HoldsFor(p, q, 60 * ms),
     "Whenever p becomes true, then in that step and each later one at most 60 ms after it q is true."),
    (forms.Responds(p, q, 60 * ms),
     "Whenever p is true, then in that step or a later one at most 60 ms after it q is true."),
    (forms.Never(held(p, 60 * ms)),
     "There is no step in which in each step of the last 60 ms, from one as long ago or longer on, "
     "p is true."),
    (forms.Never(held(p, 3 * ticks)),
     "There is no step in which in each of the last 4 steps (nominally 60 ms, ends included) p is true."),
])  # fmt: skip
def test_a_length_that_is_no_number_of_steps_is_said_in_ms(form: Form, said: str) -> None:
    assert sentence(Property("P", "", form, ("R",), "measured"), 20, measured=True) == said
