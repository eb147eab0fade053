"""Board 1 as its firmware sees it [spec §2.2, §2.3, Fig 13, Fig 14]."""

from rovercheck.spec_model.abstraction.board import Board
from rovercheck.spec_model.abstraction.interface import (
    BoardInterface,
    Carriage,
    Carried,
    InputRow,
    ModelAge,
    clock,
    produced,
    sample,
    stamped,
)
from rovercheck.spec_model.abstraction.signals import discrete, measured, outputs
from rovercheck.spec_model.board1 import SUPERVISOR
from rovercheck.spec_model.environment.board1 import check_stop
from rovercheck.spec_model.lang.expr import Var
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from rovercheck.spec_model.signals import board1 as b1
from rovercheck.spec_model.signals import board1_fine as fine

HEARTBEATS, FRAMES = "last_valid_b2_ms", "b2_data_last_valid_ms"
TEMPERATURE, BATTERY = "temp_last_valid_ms", "batt_last_valid_ms"
MEAN_MS = 40


def _watched(name: str, doc: str, age: Var, ms: Var, slow: Var) -> InputRow:
    """The stamp of a source of which the charts also watch the mean interval."""
    held = ModelAge(age, age.domain.high, ms)
    return stamped(name, doc, held, Carried(age, Carriage.AGE), Carried(slow, Carriage.SLOW, mean_ms=MEAN_MS))


def _aging(name: str, doc: str, age: Var) -> InputRow:
    """The stamp of a datum; the model stops counting 500 ms before the end of its age's domain (S09, S24)."""
    held = ModelAge(age, age.domain.high - 500 // TICK_MS)
    return stamped(name, doc, held, Carried(age, Carriage.AGE))


def _message(signal_of: Var, place: str = "") -> InputRow:
    """A field of the frames of Board 2 that is no number."""
    row = sample(discrete(signal_of), signal_of, FRAMES)
    return (row.at(place) if place else row).inside("payload")


def _number(var: Var, low: float, high: float) -> InputRow:
    """A field of the frames of Board 2 that is a number."""
    return sample(measured(var, low, high), var, FRAMES).inside("payload")


INPUTS = (
    clock(),
    _watched(HEARTBEATS, "when a new heartbeat of Board 2 was last seen",
             b1.heartbeat_age, fine.heartbeat_age_ms, b1.heartbeat_slow),
    _watched(FRAMES, "when a frame of Board 2 was last accepted", b1.rx_age, fine.rx_age_ms, b1.rx_slow),
    _aging(TEMPERATURE, "when the temperature was last read", b1.temp_age),
    _aging(BATTERY, "when the battery was last read", b1.batt_age),
    sample(measured(b1.temperature_degC, -100, 200), b1.temperature_degC, TEMPERATURE, rests_at=25)
    .at("temperature_degc"),
    sample(measured(b1.battery_pct, 0, 100), b1.battery_pct, BATTERY, rests_at=80),
    *(sample(measured(w, -200, 200), w).at(f"wheel_speed_rpm[{n}]")
      for n, w in enumerate(b1.wheel_speed_rpm.values())),
    *(sample(discrete(f), f).at(f"has_no_feedback[{n}]") for n, f in enumerate(b1.has_no_feedback.values())),
    _message(b1.cmd, "command"),
    _number(b1.x_norm, -1, 1),
    _number(b1.y_norm, -1, 1),
    _number(b1.current_yaw, 0, 359.99).at("payload.yaw"),
    _message(b1.btn1),
    _message(b1.btn2),
    _message(b1.is_motion_consistent, "is_motion_consistent"),
    _message(b1.crit_mask_b2, "critical_mask"),
    _message(b1.degr_mask_b2, "degraded_mask"),
)  # fmt: skip

references_given_up = b1.actuate_emergency_stop
"""During an emergency stop the user's references are not computed; no block reads them."""

OUTPUTS = produced((
    *outputs([
        b1.v_ref, b1.omega_ref, b1.critical_mask, b1.degraded_mask, b1.give_b2_actuation,
        b1.actuate_emergency_stop, b1.current_action, b1.temp_status, b1.batt_status,
        *b1.wheel_status.values(), b1.b2_sup_status, b1.rx_status, b1.b2_critical, b1.b2_degraded,
        b1.rover_safety_state, b1.backward_enabled, b1.invert_y, b1.is_rotating180,
        b1.estop_recover_enabled, b1.rover_is_stopped,
    ]),
    *outputs([b1.v_user, b1.omega_user], unless=references_given_up),
    *outputs([b1.targetAngle, b1.angle_err], unless=~b1.is_rotating180),
),
    b2_critical="stop_required",
    b2_degraded="degraded_required",
    roverIsStopped="rover_is_stopped",
    targetAngle180="target_angle",
    **{n: f"statuses.{n}" for n in ("temp_status", "batt_status", "b2_sup_status", "rx_status")},
    **{w.name: f"statuses.wheel_status[{n}]" for n, w in enumerate(b1.wheel_status.values())},
)  # fmt: skip

BOARD1 = Board(
    name="board1",
    system=in_order(
        "board1_charts",
        check_stop,
        *SUPERVISOR,
        text="The supervisor of Board 1 without environment: its inputs are what the snapshots hold.",
    ),
    interface=BoardInterface(INPUTS, OUTPUTS),
    grid_ms=1,
    supervisor="python:rovercheck.supervisor.board1:Board1",
)
