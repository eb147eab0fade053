"""Relay and motor driver: whose commands reach the motors when a supervisor stops."""

from rovercheck.spec_model.lang.interpret import Interpreter
from rovercheck.spec_model.rover import systems

COMMANDING = {"Board1.powered": True, "B2.sends_speeds": True, "rover.started": True}
TIME_OUT_STEPS = 15


def _motors(give_b2_actuation: bool, stops: str, steps: int) -> list[str]:
    """Whom the motors follow in each step, or "rest": the supervisor named stops in the second step."""
    system = systems()["motors"]
    rover, seen = Interpreter(system), []
    for step in range(steps):
        told = {**COMMANDING, "give_b2_actuation": give_b2_actuation, stops: step == 1}
        inputs = {n: v.domain.raw(told.get(n, False)) for n, v in system.inputs.items()}
        moving = {name: system.inputs[name].domain.raw(1) for name in ("v_ref", "B2.left_rpm")}
        rover.step({**inputs, **moving})
        followed = system.written["motors.followed"].domain.show(rover.data["motors.followed"])
        seen.append("rest" if rover.data["motors.zero"] else followed)
    return seen


def test_board_2_sends_in_the_activation_of_its_supervisor_and_no_more_when_that_stops() -> None:
    seen = _motors(True, "SUP2.stops", 2 + TIME_OUT_STEPS)
    assert seen == ["Board2", *["nobody"] * (TIME_OUT_STEPS - 1), "rest", "rest"]


def test_the_control_task_of_board_1_goes_on_sending_what_the_stopped_supervisor_left() -> None:
    assert _motors(False, "SUP1.stops", 40) == ["Board1"] * 40
