"""Keys made of parts: equal for systems that are written alike, and for no others."""

import pickle
from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.system import digest
from rovercheck.checker.system.digest import PartDigests
from rovercheck.checker.system.text import SystemText
from rovercheck.spec_model.lang.action import Assign, If
from rovercheck.spec_model.lang.domain import boolean, integer
from rovercheck.spec_model.lang.expr import Var, flag, var
from rovercheck.spec_model.lang.system import TransitionSystem
from tests.profiles import examples
from tests.strategies_ts import transition_systems
from tests.toys import relay


def text(system: TransitionSystem) -> str:
    made = SystemText()
    made.system(system)
    return made.digest


@examples(80)
@given(st.data())
def test_as_the_text_of_the_whole_says(data: st.DataObject) -> None:
    systems = [data.draw(transition_systems()) for _ in range(3)]
    systems += [pickle.loads(pickle.dumps(one)) for one in systems]
    systems += [replace(one, step=one.step[1:]) for one in systems[:3]]
    shared = PartDigests()
    for a in systems:
        assert shared.system(a) == PartDigests().system(a)
        for b in systems:
            assert (shared.system(a) == shared.system(b)) == (text(a) == text(b))


a, b, n = flag("a"), flag("b"), var("n", integer(0, 3))
BASE = relay()
OTHERS = {
    "a variable of another kind": replace(BASE, temps=BASE.variables, variables=()),
    "an initial value": replace(BASE, variables=(*BASE.variables, Var("x", boolean, 1))),
    "another initial value": replace(BASE, variables=(*BASE.variables, Var("x", boolean, 0))),
    "another domain": replace(BASE, variables=(*BASE.variables, Var("x", integer(0, 1), 0))),
    "another name": replace(BASE, variables=(*BASE.variables, Var("x\nvar 'y' 0", boolean, 0))),
    "an assumption": replace(BASE, assume=BASE.assume & a),
    "another order": replace(BASE, step=tuple(reversed(BASE.step))),
    "a branch": replace(BASE, step=(If(a, (Assign(b, b),), ()), *BASE.step)),
    "the other branch": replace(BASE, step=(If(a, (), (Assign(b, b),)), *BASE.step)),
    "behind the branch": replace(BASE, step=(If(a, (), ()), Assign(b, b), *BASE.step)),
    "two branches": replace(BASE, step=(If(a, (Assign(b, b),), (Assign(b, b),)), *BASE.step)),
    "a value": replace(BASE, step=(Assign(n, n + 1), *BASE.step)),
    "another value": replace(BASE, step=(Assign(n, n + 2), *BASE.step)),
}


@pytest.mark.parametrize("what", OTHERS)
def test_each_part_of_a_system_counts(what: str) -> None:
    shared = PartDigests()
    keys = {name: shared.system(one) for name, one in {"none": BASE, **OTHERS}.items()}
    assert [name for name, key in keys.items() if key == keys[what]] == [what]


def test_what_is_forgotten_is_looked_at_again(monkeypatch: pytest.MonkeyPatch) -> None:
    shared, fresh = PartDigests(), PartDigests()
    before = shared.system(BASE)
    monkeypatch.setattr(digest, "_KEPT", 0)
    assert shared.system(BASE) == before == fresh.system(BASE)
