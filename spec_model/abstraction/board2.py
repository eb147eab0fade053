"""Board 2 as its firmware sees it [spec §3.1, Fig 4]."""

from dataclasses import replace

from rovercheck.spec_model.abstraction.board import Board
from rovercheck.spec_model.abstraction.gaps import advance, record_of_gaps
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
from rovercheck.spec_model.board2 import ACTUATION, supervisor
from rovercheck.spec_model.board2.heading import measured as heading
from rovercheck.spec_model.lang.expr import var
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import DEG_B1, SONARS, B2Dec, command
from rovercheck.spec_model.signals.rotation import TARGET

HEARTBEATS, FRAMES = "last_valid_b1_ms", "b1_data_last_valid_ms"
IMU, JOYSTICK, SCANS = "imu_last_valid_ms", "ble_last_valid_ms", "sonar_last_valid_ms"


def _monitored(name: str, doc: str, source: b2.SourceSignals, *, counted: bool = False) -> InputRow:
    """The stamp of a monitored source; of a ``counted`` one the coherence sees updates.

    The coherence alone counts the time between updates in steps, as the model does: a stamp that jitters
    from tick to tick is seen there as one that does not.
    """
    held = ModelAge(source.age, source.age.domain.high, b2.between_steps(source).age)
    update = [Carried(source.update, Carriage.UPDATE)] if counted else []
    carried = (Carried(source.age, Carriage.AGE), Carried(advance(source), Carriage.ADVANCE), *update)
    return stamped(name, doc, held, *carried)


INPUTS = (
    clock(),
    _monitored(HEARTBEATS, "when a step last saw the alive counter of Board 1 change", b2.SUP, counted=True),
    _monitored(FRAMES, "when a frame of Board 1 was last accepted", b2.RX),
    _monitored(IMU, "when the IMU was last read", b2.IMU, counted=True),
    _monitored(JOYSTICK, "when the joystick was last read", b2.BLE),
    stamped(SCANS, "when the last scan was published; no chart reads it",
            ModelAge(b2.sonar_age, b2.sonar_age.domain.high)),
    *(sample(measured(d, 0, 344, whole=True), d, SCANS, rests_at=301).at(f"dist_cm[{n}]")
      for n, d in enumerate(SONARS)),
    sample(measured(motion.yaw, 0, 359.99), motion.yaw, IMU),
    sample(measured(b2.gz_dps, -250, 250), b2.gz_dps, IMU),
    sample(measured(motion.bx_norm, -1, 1), motion.bx_norm, JOYSTICK).at("x_norm"),
    sample(measured(motion.ay_norm, -1, 1), motion.ay_norm, JOYSTICK).at("y_norm"),
    sample(discrete(motion.btn1), motion.btn1, JOYSTICK),
    sample(discrete(motion.btn2), motion.btn2, JOYSTICK),
    replace(sample(discrete(b2.crit_mask_b1), b2.crit_mask_b1, FRAMES), in_charge_at=4)
    .at("payload.critical_mask"),  # Board 1 asks for the references of Board 2
    sample(discrete(b2.degr_mask_b1), b2.degr_mask_b1, FRAMES).at("payload.degraded_mask"),
    *(sample(measured(w, -200, 200), w, FRAMES).at(f"payload.wheel_speed_rpm[{n}]")
      for n, w in enumerate(b2.wheel_speed_rpm.values())),
)  # fmt: skip

targetAngle = var("B2.targetAngle", TARGET, 0, "heading at which a deviation from an obstacle ends")

OUTPUTS = produced((
    *outputs([
        B2Dec, command, b2.critical_mask, b2.degraded_mask, b2.b1_sup_status, b2.esp_status, b2.imu_status,
        b2.rx_status, b2.b2_emergency, b2.b1_requests_switch, b2.b1_emergency, b2.autorized_to_send_command,
        b2.rover_safety_state, b2.cmd, motion.backward_enabled, motion.current_action,
        motion.v_ref_actuation, motion.omega_ref_actuation, motion.actuate_emergency_stop,
        b2.is_motion_consistent, DEG_B1, b2.stop_pin, b2.sends_speeds,
    ]),
    *outputs([b2.left_rpm, b2.right_rpm], unless=~b2.sends_speeds),
),
    B2Dec="b2_dec",
    isMotionConsistent="is_motion_consistent",
    DEG_B1="deg_b1",
    stop_pin="actuated.stop_pin",
    sends_speeds="actuated.motors?",
    left_rpm="actuated.motors.left_rpm",
    right_rpm="actuated.motors.right_rpm",
    **{n: f"statuses.{n}" for n in ("b1_sup_status", "esp_status", "imu_status", "rx_status")},
)  # fmt: skip

BOARD2 = Board(
    name="board2",
    system=in_order(
        "board2_charts",
        *supervisor(record_of_gaps, heading(motion.yaw, targetAngle)),
        ACTUATION,
        text="The supervisor of Board 2 without environment: its inputs are what the snapshots hold.",
    ),
    interface=BoardInterface(INPUTS, OUTPUTS),
    grid_ms=TICK_MS,
    supervisor="python:rovercheck.supervisor.board2.board:Board2",
)
