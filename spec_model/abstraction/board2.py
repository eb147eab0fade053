"""Board 2 as its firmware sees it [spec §3.1, Fig 4]."""

from collections.abc import Mapping

from rovercheck.spec_model.abstraction.board import Board, BoardSignal, Value, Values, computed, units
from rovercheck.spec_model.abstraction.gaps import advance, record_of_gaps
from rovercheck.spec_model.abstraction.signals import discrete, measured, outputs, stamp
from rovercheck.spec_model.abstraction.stamps import Stamp, Updates, age, since
from rovercheck.spec_model.board2 import ACTUATION, supervisor
from rovercheck.spec_model.board2.heading import measured as heading
from rovercheck.spec_model.environment_jitter import step_ms
from rovercheck.spec_model.lang.expr import Var, var
from rovercheck.spec_model.lang.system import TICK_MS, in_order
from rovercheck.spec_model.signals import board2_motion as motion
from rovercheck.spec_model.signals import board2_supervisor as b2
from rovercheck.spec_model.signals.board2 import DEG_B1, SONARS, B2Dec, command
from rovercheck.spec_model.signals.rotation import TARGET

SOURCES = {
    "last_valid_b1_ms": b2.SUP,
    "b1_data_last_valid_ms": b2.RX,
    "imu_last_valid_ms": b2.IMU,
    "ble_last_valid_ms": b2.BLE,
}
"""The monitored source of each stamp."""
AGES_MS = {name: b2.between_steps(source).age for name, source in SOURCES.items()}
"""The ages of systems in which a stamp may lie at any ms."""
COUNTED = (b2.SUP, b2.IMU)
"""Those whose updates the coherence counts in steps."""

SAMPLES: dict[BoardSignal, Var] = {
    **{measured(d, 0, 344, whole=True): d for d in SONARS},
    measured(motion.yaw, 0, 359.99): motion.yaw,
    measured(b2.gz_dps, -250, 250): b2.gz_dps,
    measured(motion.bx_norm, -1, 1): motion.bx_norm,
    measured(motion.ay_norm, -1, 1): motion.ay_norm,
    discrete(motion.btn1): motion.btn1,
    discrete(motion.btn2): motion.btn2,
    discrete(b2.crit_mask_b1): b2.crit_mask_b1,
    discrete(b2.degr_mask_b1): b2.degr_mask_b1,
    **{measured(w, -200, 200): w for w in b2.wheel_speed_rpm.values()},
}
now_ms = stamp("now_ms", "start of the step")
sonar_last_valid_ms = stamp("sonar_last_valid_ms", "when the last scan was published; no chart reads it")
STAMPS = (
    stamp("last_valid_b1_ms", "when a step last saw the alive counter of Board 1 change"),
    stamp("b1_data_last_valid_ms", "when a frame of Board 1 was last accepted"),
    stamp("imu_last_valid_ms", "when the IMU was last read"),
    stamp("ble_last_valid_ms", "when the joystick was last read"),
)


class Reader2:
    """Ages, updates and gaps in place of stamps, and the measurements as they are.

    A step sees an update whenever in the tick before it the stamp was set.  The coherence alone counts the
    time between updates in steps, as the model does: a stamp that jitters from tick to tick is seen there
    as one that does not.
    """

    def __init__(self) -> None:
        self._updates = {name: Updates() for name in SOURCES}

    def step(self, inputs: Values) -> dict[str, int]:
        now = int(inputs["now_ms"])
        at = {datum.name: signal.raw(inputs[signal.name]) for signal, datum in SAMPLES.items()}
        for name, source in SOURCES.items():
            latest = int(inputs[name])
            before = self._updates[name].step(latest)
            at[source.age.name] = age(now, latest)
            at[advance(source).name] = 0 if before is None else since(latest, before)
            if source in COUNTED:
                at[source.update.name] = int(before is not None)
        return computed(at)


class Writer2:
    """Stamps in place of ages; a step of the model is one of the board."""

    def __init__(self) -> None:
        self._now = 0
        self._stamps = {name: Stamp() for name in (*SOURCES, sonar_last_valid_ms.name)}

    def step(self, at: Mapping[str, int]) -> dict[str, Value]:
        self._now += at.get(step_ms.name, TICK_MS)
        ages = {name: source.age for name, source in SOURCES.items()}
        inputs: dict[str, Value] = {"now_ms": self._now}
        for name, old in {**ages, sonar_last_valid_ms.name: b2.sonar_age}.items():
            to_the_ms, grid = AGES_MS.get(name), TICK_MS
            if to_the_ms is not None and to_the_ms.name in at:
                old, grid = to_the_ms, 1
            inputs[name] = self._stamps[name].step(self._now, at.get(old.name, 0), old.domain.high, grid)
        for signal, datum in SAMPLES.items():
            known = datum.name in at
            inputs[signal.name] = units(datum.domain, at[datum.name]) if known else signal.initial
        return inputs


targetAngle = var("B2.targetAngle", TARGET, 0, "heading at which a deviation from an obstacle ends")

OUTPUTS = (
    *outputs([
        B2Dec, command, b2.critical_mask, b2.degraded_mask, b2.b1_sup_status, b2.esp_status, b2.imu_status,
        b2.rx_status, b2.b2_emergency, b2.b1_requests_switch, b2.b1_emergency, b2.autorized_to_send_command,
        b2.rover_safety_state, b2.cmd, motion.backward_enabled, motion.current_action,
        motion.v_ref_actuation, motion.omega_ref_actuation, motion.actuate_emergency_stop,
        b2.is_motion_consistent, DEG_B1, b2.stop_pin, b2.sends_speeds,
    ]),
    *outputs([b2.left_rpm, b2.right_rpm], unless=~b2.sends_speeds),
)  # fmt: skip

BOARD2 = Board(
    name="board2",
    system=in_order(
        "board2_charts",
        *supervisor(record_of_gaps, heading(motion.yaw, targetAngle)),
        ACTUATION,
        text="The supervisor of Board 2 without environment: its inputs are what the snapshots hold.",
    ),
    inputs=(now_ms, *STAMPS, sonar_last_valid_ms, *SAMPLES),
    outputs=OUTPUTS,
    reader=Reader2,
    writer=Writer2,
    grid_ms=TICK_MS,
)
