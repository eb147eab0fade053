"""What sensors, link and clock may do to Board 2: ages of the four stamps, and data that change with them.

As in ``environment.board1``: an update seen in a step carries the time of that step (20 ms grid), time 0 is
power-up with all stamps 0, and the first step is at 20 ms.  A datum changes only with its stamp.
"""

from collections.abc import Sequence

from rovercheck.spec_model.ambiguity import under
from rovercheck.spec_model.environment import milliseconds
from rovercheck.spec_model.environment.board1 import clock
from rovercheck.spec_model.lang.action import Action, assign, when
from rovercheck.spec_model.lang.chart import Block
from rovercheck.spec_model.lang.expr import Const, Var, implies
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import SONARS


def clocks_of(sources: Sequence[b2.SourceSignals]) -> tuple[Block, ...]:
    """The ages of monitored stamps."""
    return tuple(
        clock(f"{s.region}.age", s.update, s.age)
        if s.phase is None
        else milliseconds.clock(f"{s.region}.age", s.update, s.phase, s.age)
        for s in sources
    )


clocks = clocks_of(b2.SOURCES)
"""The ages of the four monitored stamps, on the grid."""

heartbeat_travels_in_frames = implies(b2.SUP.update, b2.RX.update)
"""A new alive counter of Board 1 can only come with an accepted frame, which carries it."""


def arriving(published: Var) -> Var:
    """What an update brings for a datum of a snapshot."""
    return Var(f"new_{published.name}", published.domain, published.init, f"{published.name} of the update")


def snapshot(name: str, update: Var, data: Sequence[Var], otherwise: Sequence[Action] = ()) -> Block:
    """Data of a snapshot: an update replaces them, all together."""
    return Block(
        name,
        [when(update, [assign(datum, arriving(datum)) for datum in data], otherwise)],
        text=f"Data of {name}, kept until {update.name}.",
    )


_stick = (motion.ay_norm, motion.bx_norm, motion.btn1, motion.btn2)
_let_go = when(under("E28", "NEUTRAL"), [assign(datum, Const(0, datum.sort)) for datum in _stick])
joystick = snapshot("BLE", b2.BLE.update, _stick, [_let_go])
inertial = snapshot("IMU", b2.IMU.update, (motion.yaw, b2.gz_dps))
masks_of_board1 = snapshot("Board1_Data.masks", b2.RX.update, (b2.crit_mask_b1, b2.degr_mask_b1))
wheels_of_board1 = snapshot("Board1_Data.wheels", b2.RX.update, tuple(b2.wheel_speed_rpm.values()))
sonars = snapshot("Sonars", b2.sonar_update, SONARS)
sonar_clock = clock("Sonars.age", b2.sonar_update, b2.sonar_age)

SNAPSHOTS = (joystick, inertial, masks_of_board1, wheels_of_board1, sonars)
"""Everything that reaches Board 2 by a snapshot."""
