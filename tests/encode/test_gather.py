"""Goals are searched together exactly when that adds few bits to what each needs alone."""

from hypothesis import given
from hypothesis import strategies as st

from rovercheck.checker.encode.gather import gathered
from rovercheck.spec_model.lang.domain import integer
from rovercheck.spec_model.lang.expr import Var, var

BYTES = [var(f"v{n}", integer(0, 255)) for n in range(6)]


def _part(*numbers: int) -> dict[str, Var]:
    return {BYTES[n].name: BYTES[n] for n in numbers}


def test_the_smallest_come_first_and_near_ones_share() -> None:
    parts = {"all": _part(0, 1, 2, 3), "few": _part(0), "near": _part(0, 1)}
    assert gathered(parts, 8) == [["few", "near"], ["all"]]


def test_unrelated_ones_stay_apart_however_small() -> None:
    assert gathered({"a": _part(0), "b": _part(1)}, 7) == [["a"], ["b"]]


@given(st.dictionaries(st.text(max_size=3), st.sets(st.integers(0, 5)), max_size=8), st.integers(0, 30))
def test_every_goal_is_in_one_group_that_adds_little_to_it(drawn: dict[str, set[int]], extra: int) -> None:
    parts = {goal: _part(*sorted(numbers)) for goal, numbers in drawn.items()}
    groups = gathered(parts, extra)
    assert sorted(goal for group in groups for goal in group) == sorted(parts)
    for group in groups:
        together = set().union(*(drawn[goal] for goal in group))
        assert all(8 * len(together) <= 8 * len(drawn[goal]) + extra * len(group) for goal in group)
