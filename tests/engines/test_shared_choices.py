"""Where there are thousands of choices they call one function: what is found is the same."""

from collections.abc import Callable

import pytest
from hypothesis import given

from rovercheck.checker.encode.native import NativeTask, assembly, layout, search
from rovercheck.checker.engines import Timers
from rovercheck.checker.system.slice import sliced
from rovercheck.spec_model.lang.system import TransitionSystem
from tests import naive
from tests.engines.compared import Group, compare, long, many, mixed, overflowing, wide
from tests.engines.test_explicit import agrees
from tests.engines.test_stages import sonars
from tests.strategies_stages import staged_systems
from tests.strategies_ts import goals, transition_systems


@pytest.fixture(autouse=True, scope="module")
def shared() -> object:
    """Choices share their code however few they are."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(search, "MANY_CHOICES", 0)
        yield


@pytest.mark.parametrize("made", [long, many, mixed, overflowing, wide, sonars])
def test_groups_are_searched_as_by_the_naive_search(made: Callable[[], Group]) -> None:
    for timers in (Timers.EXACT, Timers.SKIP):
        compare(made, timers)


@given(transition_systems())
def test_random_systems(system: TransitionSystem) -> None:
    agrees(system, goals(system), naive.search(system, goals(system)))


@given(staged_systems())
def test_random_systems_in_stages(system: TransitionSystem) -> None:
    agrees(system, goals(system), naive.search(system, goals(system)))


def test_the_code_is_shared() -> None:
    system, wanted = mixed()
    part = sliced(system, wanted)
    text = assembly("search", NativeTask(part, layout((*part.frozen, *part.variables)), wanted))
    assert text.count("define internal i32 @") == 1
    assert "call i32 @" in text
