"""The whole rover, step by step: both supervisors, both directions of the link, relay, motors, faults."""

from collections.abc import Callable, Mapping, Sequence
from functools import cache

from rovercheck.spec_model.ambiguity import under
from rovercheck.spec_model.board1 import SUPERVISOR as SUPERVISOR_1
from rovercheck.spec_model.board1 import references
from rovercheck.spec_model.board1.motion import motion_with_free_error
from rovercheck.spec_model.board2 import ACTUATION, supervisor
from rovercheck.spec_model.board2.heading import measured
from rovercheck.spec_model.board2.supervisor_systems import targetAngle
from rovercheck.spec_model.composition.link import all_frames_arrive, link
from rovercheck.spec_model.composition.motors import (
    board1_powered,
    faults,
    power_lost,
    relay_and_driver,
    runs_1,
    runs_2,
    started,
    stop_1,
    stop_2,
)
from rovercheck.spec_model.environment import board1 as env1
from rovercheck.spec_model.environment import board2 as env2
from rovercheck.spec_model.lang.action import assign
from rovercheck.spec_model.lang.chart import Block, Component, Enabled
from rovercheck.spec_model.lang.expr import Var, all_of, any_of, implies, ite
from rovercheck.spec_model.lang.system import Assumption, Note, System, in_order
from rovercheck.spec_model.records import arrival_window
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board2 as obstacles
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.system_table import SystemTable

SYNCHRONOUS = Note(
    "Both supervisors execute once per tick of 20 ms; what one writes is seen by the other one or two ticks "
    "later, chosen for each frame, in order (phases and latencies of the tasks in between).",
    brief="both boards in step",
)
ENVIRONMENT = (
    "Sonars, joystick, IMU, temperature, battery, wheels and encoder flags are arbitrary, on both sides of "
    "every limit; a datum changes only with its time stamp."
)
link12 = link(
    "B1-B2",
    [
        *((b1.wheel_speed_rpm[w], b2.wheel_speed_rpm[w]) for w in b1.WHEELS),
        (b1.critical_mask, b2.crit_mask_b1),
        (b1.degraded_mask, b2.degr_mask_b1),
    ],
    accepted=b2.RX.update,
    counter_changed=b2.SUP.update,
    executes=runs_1,
    transmits=board1_powered,
)

turning_command = ite(under("E31", "ZERO-TURN"), obstacles.x_sent, motion.bx_norm)

link21 = link(
    "B2-B1",
    [
        (obstacles.command, b1.cmd),
        (b2.critical_mask, b1.crit_mask_b2),
        (b2.degraded_mask, b1.degr_mask_b2),
        (b2.is_motion_consistent, b1.is_motion_consistent),
        (motion.yaw, b1.current_yaw),
        (turning_command, b1.x_norm),
        (motion.ay_norm, b1.y_norm),
        (motion.btn1, b1.btn1),
        (motion.btn2, b1.btn2),
    ],
    accepted=b1.rx_update,
    counter_changed=b1.heartbeat_update,
    executes=runs_2,
)

start = Block("Start", [assign(started, True)], text="Both boards are powered up in the first step.")

SENSORS = (b1.temp_update, b1.batt_update, b2.IMU.update, b2.BLE.update, b2.sonar_update)

A01 = Assumption(
    "A01",
    "The first valid temperature, battery, IMU and joystick data and the first scan are there in step 1.",
    implies(~started, all_of(*SENSORS)),
)
A02 = Assumption("A02", "No frame is lost or corrupted.", all_frames_arrive(link12, link21))
A03 = Assumption(
    "A03",
    "At most two frames in a row are lost or corrupted, in each direction.",
    link12.lost_at_most(2) & link21.lost_at_most(2),
)
A04 = Assumption(
    "A04", "Both supervisors execute in every step and Board 1 has power.", ~(stop_1 | stop_2 | power_lost)
)
FRESH = Assumption("FRESH", "Every sensor delivers a valid reading in every step.", all_of(*SENSORS))


@cache
def _records() -> tuple[Block, Block]:
    """The exact records of Board 1, which all systems share."""
    heartbeats = arrival_window("heartbeat", b1.heartbeat_update, moves=b1.heartbeat_moves)
    return arrival_window("rx", b1.rx_update), heartbeats


def in_turn(
    board1: Sequence[Component], board2: Sequence[Component],
    reception: Block = env1.reception_clock, clocks: Sequence[Block] = env2.clocks,
) -> tuple[Component, ...]:  # fmt: skip
    """What happens in one instant, in order: receive, sensors, supervisors, motor commands, transmit.

    ``reception`` and ``clocks`` are what tells Board 1 and Board 2 how old their data are.
    """
    return (
        faults,
        link12.receive,
        link21.receive,
        env1.temperature_readings,
        env1.battery_readings,
        reception,
        env1.heartbeat_clock,
        *_records(),
        env1.check_stop,
        Enabled(runs_1, *board1, name="Board 1"),
        env2.joystick,
        env2.inertial,
        env2.sonars,
        *clocks,
        Enabled(runs_2, *board2, ACTUATION, name="Board 2"),
        relay_and_driver,
        link12.send,
        link21.send,
        start,
    )


@cache
def _parts() -> tuple[Component, ...]:
    """Both boards, as drawn."""
    return in_turn(SUPERVISOR_1, supervisor(heading=measured(motion.yaw, targetAngle)))


PLAIN: Mapping[Var, bool | int] = {
    **dict.fromkeys(SENSORS, True),
    b1.temp_reading: 25,
    b1.batt_reading: 80,
    **dict.fromkeys(b1.has_no_feedback.values(), False),
    **dict.fromkeys(b1.wheel_speed_rpm.values(), 60),
    **dict.fromkeys(map(env2.arriving, (motion.yaw, b2.gz_dps)), 0),
    **dict.fromkeys(map(env2.arriving, (motion.btn1, motion.btn2)), False),
}
"""A scene with few runs: sensors that always deliver, nothing out of range, straight on, no buttons."""

SCENE = (
    "Temperature 25 °C, battery 80 %, wheels turning at 60 rpm with feedback, heading constant, no buttons, "
    "every sensor delivers in every step; links, joystick axes and distances are free."
)


Listed = tuple[str, Callable[[], System]]


def _rover(name: str, text: str, *assumptions: Assumption) -> Listed:
    notes = (SYNCHRONOUS, ENVIRONMENT)
    return name, lambda: in_order(name, *_parts(), text=text, notes=notes, assumptions=assumptions)


def _plain(name: str, text: str, *assumptions: Assumption) -> Listed:
    """The rover in one scene: what is violated there is violated."""
    notes = (SYNCHRONOUS, SCENE)

    def built() -> System:
        scene = all_of(*(v == value for v, value in PLAIN.items()))
        return in_order(
            name, *_parts(), text=text, assume=scene, notes=notes, under=True, assumptions=assumptions
        )

    return name, built


motors = in_order(
    "motors",
    faults,
    relay_and_driver,
    text="Relay and motor driver for any outputs of both boards.",
    notes=("What both boards command is arbitrary in every step (more runs).",),
    over=True,
    concrete="rover_failing",
)

references_commanded = in_order(
    "references_commanded",
    references(motion_with_free_error),
    text="The references of Board 1 for the commands that Board 2 can give.",
    assume=any_of(*(b1.cmd == known for known in ("CMD_NORMAL", "CMD_GO_LEFT", "CMD_GO_RIGHT", "CMD_ESTOP"))),
    notes=("The received command is one of four (PSY-20a); all else is free in every step (more runs).",),
    over=True,
    concrete="rover",
)

arrives12, arrives21 = link12.arrives, link21.arrives
lost12, lost21 = link12.lost_in_a_row, link21.lost_in_a_row

links = in_order(
    "links",
    link12.receive,
    link21.receive,
    link12.send,
    link21.send,
    text="The frames of both directions; what the boards put into them is free.",
    notes=[SYNCHRONOUS],
)

SYSTEMS = SystemTable(
    _rover("rover", "Both boards with the link, whose frames may be lost, corrupted or late.", A04),
    _rover("rover_no_loss", "Both boards with a link that loses nothing.", A02, A04),
    _rover("rover_few_losses", "Both boards with a link that loses at most two frames in a row.", A03, A04),
    _rover("rover_healthy", "Both boards, sensors and link without any fault.", A01, FRESH, A02, A04),
    _rover("rover_failing", "Both boards, each of which may fail, and a link that may fail."),
    _plain("rover_plain", "The rover in a plain scene; frames may be lost, corrupted or late.", A04),
    _plain("rover_plain_no_loss", "The rover in a plain scene with a link that loses nothing.", A02, A04),
    _plain("rover_plain_failing", "The rover in a plain scene; boards and link may fail."),
    links,
    motors,
    references_commanded,
)
