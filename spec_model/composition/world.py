"""The world of the rover in a scene: what can fail, what the stick does, and what reaches the boards by that.

Each datum has its usual value, and the values that a fault or the user gives it.  Whatever a scene does not
name works, is as usual, and changes with nothing.
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

from rovercheck.spec_model.composition.link import ARRIVAL
from rovercheck.spec_model.composition.motors import connected, motors_zero, power_lost, stop_1, stop_2
from rovercheck.spec_model.composition.rover_ms import RX_1
from rovercheck.spec_model.composition.systems import link12, link21
from rovercheck.spec_model.environment import board2 as env2
from rovercheck.spec_model.lang.action import Action, Assign, assign
from rovercheck.spec_model.lang.domain import enumeration
from rovercheck.spec_model.lang.expr import Const, Expr, Var, flag, ite, member, var
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import SONARS


@dataclass(frozen=True)
class WorldFault:
    """Something that fails; ``ends`` if it may work again.

    ``ages``: the region of Board 2, or ``RX_1`` of Board 1, whose data grow old then.  The phase of all
    others is without effect, as their data come in every step.
    """

    name: str
    text: str
    ends: bool = True
    ages: str = ""


FAULTS = (
    WorldFault("joystick", "no joystick datum arrives", ages=b2.BLE.region),
    WorldFault("imu", "no IMU datum arrives", ages=b2.IMU.region),
    WorldFault("sonars", "no scan is published"),
    WorldFault("temperature", "no temperature is read"),
    WorldFault("battery", "no battery level is read"),
    WorldFault("link12", "no frame of Board 1 arrives at Board 2", ages=b2.RX.region),
    WorldFault("link21", "no frame of Board 2 arrives at Board 1", ages=RX_1),
    WorldFault("supervisor1", "the supervisor of Board 1 executes no more", ends=False),
    WorldFault("supervisor2", "the supervisor of Board 2 executes no more", ends=False),
    WorldFault("power", "Board 1 has no power", ends=False, ages=b2.RX.region),
    WorldFault("wheel", "one of the wheels gives no feedback"),
    WorldFault("hot", "64 °C are measured"),
    WorldFault("flat", "a battery level of 10 % is measured"),
    WorldFault("near", "one of the sonars measures 70 cm"),
)
BY_NAME: Mapping[str, WorldFault] = {fault.name: fault for fault in FAULTS}

There = Callable[[str], Expr]
"""Whether the fault of this name is there, in this step."""

late12 = flag("B1-B2.late", "every frame is seen two steps after it was sent, not one")
late21 = flag("B2-B1.late", "every frame is seen two steps after it was sent, not one")

which = {
    "wheel": var("failing_wheel", enumeration("Wheel", b1.WHEELS), doc="the wheel without feedback"),
    "near": var(
        "near_sonar", enumeration("Sonar", ["middle", "left", "right"]), doc="the sonar that measures 70 cm"
    ),
}
"""Of faults that strike one of several parts: which, by the name of the fault."""

stick = var(
    "stick", enumeration("Stick", ["forward", "left", "centre", "back"]), doc="where the user holds the stick"
)
turns = flag("turns", "the heading is another 45°, the way the motors turn the rover")

EIGHTH = 45
"""Degrees by which the heading changes: each limit of the charts lies between two multiples, or on one."""


def value(of: Var, number: int | float) -> Const:
    """A number as a value of a variable."""
    return Const(of.domain.raw(number), of.sort)


def world(there: There, free: Collection[Var] = (), any_part: Collection[str] = ()) -> list[Action]:
    """What reaches the boards in this step, by what has failed, but for what is ``free`` to be anything.

    Of several alike the faults named in ``any_part`` strike any, the others always the first.  What the user
    does, and where the rover heads, is apart.
    """

    def arrives(fault: str, late: Var) -> Expr:
        in_time = ite(late, member(ARRIVAL, "older"), member(ARRIVAL, "newest"))
        return ite(there(fault), member(ARRIVAL, "nothing"), in_time)

    def measures(datum: Var, failed: Expr, then: int, usual: int) -> Assign:
        return assign(datum, ite(failed, value(datum, then), value(datum, usual)))

    def strikes(fault: str, part: str) -> Expr:
        chosen = which[fault]
        struck = chosen if fault in any_part else Const(chosen.domain.low, chosen.sort)
        return there(fault) & (struck == part)

    reaches = [
        assign(b2.BLE.update, ~there("joystick")),
        assign(b2.IMU.update, ~there("imu")),
        assign(b2.sonar_update, ~there("sonars")),
        *(
            measures(env2.arriving(distance), strikes("near", part), 70, 301)
            for distance, part in zip(SONARS, ("left", "middle", "right"), strict=True)
        ),
        assign(b1.temp_update, ~there("temperature")),
        assign(b1.batt_update, ~there("battery")),
        measures(b1.temp_reading, there("hot"), 64, 25),
        measures(b1.batt_reading, there("flat"), 10, 80),
        assign(link12.arrives, arrives("link12", late12)),
        assign(link21.arrives, arrives("link21", late21)),
        assign(stop_1, there("supervisor1")),
        assign(stop_2, there("supervisor2")),
        assign(power_lost, there("power")),
        *(assign(missing, strikes("wheel", wheel)) for wheel, missing in b1.has_no_feedback.items()),
        *(measures(speed, motors_zero, 0, 60) for speed in b1.wheel_speed_rpm.values()),
        assign(env2.arriving(b2.gz_dps), 0),
        *(assign(env2.arriving(button), False) for button in (motion.btn1, motion.btn2)),
    ]
    return [action for action in reaches if action.var.name not in {one.name for one in free}]


def stick_forward() -> list[Action]:
    """The stick is pushed forward."""
    y, x = env2.arriving(motion.ay_norm), env2.arriving(motion.bx_norm)
    return [assign(y, value(y, 1)), assign(x, value(x, 0))]


def heading_constant() -> list[Action]:
    """The rover does not turn."""
    yaw = env2.arriving(motion.yaw)
    return [assign(yaw, value(yaw, 0))]


def stick_at_will() -> list[Action]:
    """The stick moves in any step."""
    y, x = env2.arriving(motion.ay_norm), env2.arriving(motion.bx_norm)
    return [
        assign(y, ite(stick == "forward", value(y, 1), ite(stick == "back", value(y, -1), value(y, 0)))),
        assign(x, ite(stick == "left", value(x, 1), value(x, 0))),
    ]


def heading_by_motors() -> list[Action]:
    """The IMU adds up how the motors turn the rover, in eighths of a circle, as quickly as it may be."""
    yaw, before = env2.arriving(motion.yaw), motion.yaw
    by_1, by_2 = connected == "Board1", connected == "Board2"
    to_left = (by_1 & (b1.omega_ref > 0)) | (by_2 & (b2.right_rpm > b2.left_rpm))
    to_right = (by_1 & (b1.omega_ref < 0)) | (by_2 & (b2.right_rpm < b2.left_rpm))
    left = ite(before < EIGHTH, before + (360 - EIGHTH), before - EIGHTH)
    right = ite(before >= 360 - EIGHTH, before - (360 - EIGHTH), before + EIGHTH)
    moves = turns & ~motors_zero
    return [assign(yaw, ite(moves & to_left, left, ite(moves & to_right, right, before)))]
