"""The safety state while Board 2 drives."""

from rovercheck.supervisor.board2.safety import Safety
from rovercheck.supervisor.types import SafetyState


def test_the_first_authorised_step_is_degraded_whatever_the_masks() -> None:
    safety = Safety()
    assert safety.rover_safety_state is SafetyState.SAFETY_OK
    assert safety.step(emergency=True) is SafetyState.SAFETY_DEGRADED
    assert safety.step(emergency=True) is SafetyState.SAFETY_CRITICAL


def test_later_it_follows_the_emergency_without_delay() -> None:
    safety = Safety()
    safety.step(emergency=False)
    states = [safety.step(emergency) for emergency in (False, True, True, False, True)]
    assert [state is SafetyState.SAFETY_CRITICAL for state in states] == [False, True, True, False, True]
