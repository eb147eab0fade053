"""``Motion_Supervision`` of Board 1 in each of its states, for the tests."""

from dataclasses import replace

from rovercheck.supervisor.board1.motion import MotionSupervision
from rovercheck.supervisor.board1.states import MANOEUVRES, Motion, MotionInputs
from rovercheck.supervisor.types import SafetyState, SupervisorCommand

SAFE, CARE, STOP = SafetyState.SAFETY_OK, SafetyState.SAFETY_DEGRADED, SafetyState.SAFETY_CRITICAL
NORMAL, ESTOP = SupervisorCommand.CMD_NORMAL, SupervisorCommand.CMD_ESTOP
NOMINAL = MotionInputs(NORMAL, 0.0, 0.0, 0.0, (0.0,) * 4, SAFE, False)
MOVING = (60.0,) * 4


def step(motion, **changes):
    motion.step(replace(NOMINAL, **changes))
    return motion


def started(**changes):
    return step(MotionSupervision(), **changes)


def manoeuvring(cmd, **changes):
    motion = step(started(), cmd=cmd, y_norm=1.0, **changes)
    assert motion.state is MANOEUVRES[cmd]
    return motion


def rotating(yaw=0.0):
    motion = step(started(), y_norm=-1.0, yaw=yaw)
    assert motion.state is Motion.RETROMARCIA_180
    return motion


def braking(wheels=MOVING):
    """Braking since the step before, and critical until released."""
    motion = step(started(), rover_status=STOP, wheel_speed_rpm=wheels)
    assert motion.state is Motion.IN_FRENATA_DI_EMERGENZA
    return motion
