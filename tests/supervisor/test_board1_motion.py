"""``Motion_Supervision`` of Board 1 while it drives, dodges and avoids: every arc, every law."""

import pytest

from rovercheck.supervisor.board1.states import ACTIONS, MANOEUVRES, Motion
from rovercheck.supervisor.types import SupervisorCommand
from tests.supervisor.board1_motions import CARE, ESTOP, NORMAL, SAFE, STOP, manoeuvring, started, step


def test_the_first_execution_only_enters():
    motion = started(cmd=ESTOP, rover_status=STOP, x_norm=1.0, y_norm=-1.0)
    assert motion.state is Motion.NORMALE_MARCIA
    assert (motion.v_ref, motion.omega_ref, motion.emergency_stop) == (0, 0, False)
    assert motion.current_action is NORMAL
    assert started(y_norm=0.5).user.v_user == 0.5


@pytest.mark.parametrize(
    "y, backward, v_ref",
    [
        (1.0, False, 1.0),
        (0.1, False, 0.1),
        (0.0, False, 0),
        (-0.4, False, 0),
        (-0.4, True, -0.4),
        (-1.0, True, -1.0),
    ],
)
def test_speed_follows_the_joystick(y, backward, v_ref):
    assert step(started(), y_norm=y, x_norm=-0.3, backward_enabled=backward).v_ref == v_ref


@pytest.mark.parametrize("status, scale", [(SAFE, 1.0), (CARE, 0.5)])
def test_references_are_scaled_with_the_safety_state(status, scale):
    motion = step(started(), y_norm=0.4, x_norm=-0.6, rover_status=status)
    assert (motion.v_ref, motion.omega_ref) == (0.4 * scale, -0.6 * scale)


@pytest.mark.parametrize("cmd", SupervisorCommand)
def test_commands_while_driving_forward(cmd):
    motion = step(started(), cmd=cmd, y_norm=1.0)
    assert motion.state is MANOEUVRES.get(cmd, Motion.NORMALE_MARCIA)
    assert motion.current_action is ACTIONS[motion.state]
    assert motion.v_ref == (0.0 if cmd in MANOEUVRES else 1.0)  # a state just entered is not executed


@pytest.mark.parametrize("cmd", SupervisorCommand)
@pytest.mark.parametrize("y", [0.0, -0.4])
def test_commands_while_not_driving_forward(cmd, y):
    assert step(started(), cmd=cmd, y_norm=y).state is Motion.NORMALE_MARCIA


@pytest.mark.parametrize(
    "cmd, status, x, v_ref, omega_ref",
    [
        ("CMD_GO_LEFT", SAFE, 0.0, 0.8, 0.4),
        ("CMD_GO_LEFT", SAFE, 0.5, 0.8, 0.5),
        ("CMD_GO_LEFT", SAFE, -1.0, 0.8, 0.4),
        ("CMD_GO_LEFT", CARE, 0.0, 0.4, 0.2),
        ("CMD_GO_RIGHT", SAFE, 0.0, 0.8, -0.4),
        ("CMD_GO_RIGHT", SAFE, -0.5, 0.8, -0.5),
        ("CMD_GO_RIGHT", SAFE, 1.0, 0.8, -0.4),
        ("CMD_GO_RIGHT", CARE, 0.0, 0.4, -0.2),
        ("CMD_AVOID_RIGHT", SAFE, 0.5, 1.0, 0.5),
        ("CMD_AVOID_RIGHT", SAFE, -0.5, 1.0, 0.0),
        ("CMD_AVOID_LEFT", SAFE, 0.5, 1.0, 0.0),
        ("CMD_AVOID_LEFT", CARE, -0.5, 0.5, -0.25),
    ],
)
def test_laws_of_the_manoeuvres(cmd, status, x, v_ref, omega_ref):
    cmd = SupervisorCommand[cmd]
    motion = step(manoeuvring(cmd), cmd=cmd, y_norm=1.0, x_norm=x, rover_status=status)
    assert (motion.v_ref, motion.omega_ref) == (v_ref, omega_ref)


@pytest.mark.parametrize("y, v_ref", [(0.8, 0.8), (0.79, 0.79), (0.81, 0.8), (0.0, 0.0), (-1.0, -1.0)])
def test_a_dodge_limits_the_speed_only_forward(y, v_ref):
    cmd = SupervisorCommand.CMD_GO_LEFT
    assert step(manoeuvring(cmd), cmd=cmd, y_norm=y).v_ref == v_ref


@pytest.mark.parametrize("cmd", MANOEUVRES)
@pytest.mark.parametrize("following", SupervisorCommand)
def test_only_the_normal_command_or_a_stop_ends_a_manoeuvre(cmd, following):
    motion = step(manoeuvring(cmd), cmd=following, y_norm=1.0)
    ends = {NORMAL: Motion.NORMALE_MARCIA, ESTOP: Motion.IN_FRENATA_DI_EMERGENZA}
    assert motion.state is ends.get(following, MANOEUVRES[cmd])


def test_a_manoeuvre_ends_before_its_law_is_applied():
    motion = step(manoeuvring(SupervisorCommand.CMD_GO_LEFT), y_norm=1.0)
    assert (motion.v_ref, motion.omega_ref) == (0, 0)
