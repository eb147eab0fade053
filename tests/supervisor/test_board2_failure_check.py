"""When Board 2 may send commands: at once when Board 1 fails, 3.02 s after it works again no longer."""

from functools import partial

import pytest

from rovercheck.supervisor.board2.failure_check import FailureCheck
from rovercheck.supervisor.types import Level

FAILED = (
    (True, Level.OK, Level.OK),
    (False, Level.CRITICAL, Level.OK),
    (False, Level.OK, Level.CRITICAL),
    (True, Level.CRITICAL, Level.CRITICAL),
)
SOUND = (False, Level.DEGRADED, Level.DEGRADED)


def authorised() -> FailureCheck:
    check = FailureCheck()
    check.step(*SOUND)
    assert check.step(*FAILED[0])
    return check


@pytest.mark.parametrize("failed", FAILED)
def test_each_failure_authorises_in_its_step_but_not_in_the_first(
    failed: tuple[bool, Level, Level],
) -> None:
    check = FailureCheck()
    assert not check.step(*failed)
    assert check.step(*failed)


def test_degraded_is_no_failure() -> None:
    check = FailureCheck()
    assert not any(check.step(*SOUND) for _ in range(400))


def test_the_authorisation_ends_151_steps_after_the_failure() -> None:
    step = partial(authorised().step, *SOUND)
    # the failure lasted to the end of its step: the first sound step is the one after it
    assert [step() for _ in range(153)] == [True] * 151 + [False] * 2


@pytest.mark.parametrize("sound_steps", (1, 149, 150, 151))
def test_a_failure_in_between_begins_the_time_anew(sound_steps: int) -> None:
    check = authorised()
    assert [check.step(*SOUND) for _ in range(sound_steps)] == [True] * sound_steps
    assert check.step(*FAILED[1])
    assert [check.step(*SOUND) for _ in range(152)] == [True] * 151 + [False]


def test_a_failure_in_the_step_after_the_return_authorises_again() -> None:
    check = authorised()
    assert not [check.step(*SOUND) for _ in range(152)][-1]
    assert check.step(*FAILED[2])
